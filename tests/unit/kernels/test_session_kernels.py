"""Kernels of `session`: each compiled kernel gives the results of its plain twin."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given, strategies as st

from kernels import both, seeds, steady
from scene2hap import Pose


@steady
@given(seed=seeds, n=st.integers(0, 3))
def test_kernels_select_the_same_sources_within_the_cut_off(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    costs = rng.choice([0.0, 1.0, 2.0, math.inf], (n, 5)).tolist()
    cutoff = rng.choice([-1.0, 0.0, 1.5, math.inf], 5).tolist()
    sought = [frozenset(rng.choice(5, int(rng.integers(0, 5)), replace=False).tolist()) for _ in range(n)]
    plain, twin = both("session.gains.audibility.within")
    assert twin(costs, cutoff, sought) == plain(costs, cutoff, sought)


@steady
@given(seed=seeds, n=st.integers(0, 3))
def test_kernels_silence_the_same_bands(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    least = rng.choice([0.0, 0.5, np.inf], (4, 5)).astype(np.float32)
    columns = None if rng.random() < 0.3 else sorted(rng.choice(4, int(rng.integers(0, 5)), replace=False).tolist())
    gains = rng.choice([0.0, 0.4, 0.5, 0.6, np.nan], (n, 4 if columns is None else len(columns), 5)).astype(np.float32)
    plain, twin = both("session.gains.audibility.silence")
    told, compiled = gains.copy(), gains.copy()
    assert twin(compiled, least, columns) == plain(told, least, columns)
    np.testing.assert_array_equal(compiled, told)


@steady
@given(seed=seeds, n=st.integers(0, 3), m=st.integers(0, 4), has_peaks=st.booleans(), has_least=st.booleans())
def test_kernels_select_the_same_audible_sources(seed: int, n: int, m: int, has_peaks: bool, has_least: bool) -> None:
    rng = np.random.default_rng(seed)
    gains = rng.choice([0.0, 1e-9, 0.1, 0.5], (n, m, 5), p=[0.6, 0.1, 0.2, 0.1]).astype(np.float32)
    peaks = rng.uniform(0, 2, (m, 5)).astype(np.float32) if has_peaks else None
    least = rng.choice([0.0, 0.2, np.inf], (m, 5)).astype(np.float32) if has_least else None
    told, compiled = (kind(gains, peaks, 0.3, least) for kind in both("session.gains.audibility.sifted"))
    np.testing.assert_array_equal(compiled[0], told[0])
    assert compiled[0].flags.c_contiguous
    assert compiled[1:] == told[1:]


@steady
@given(seed=seeds, n=st.integers(0, 4), n_theirs=st.integers(0, 5))
def test_kernels_answer_alike_from_the_last_field(seed: int, n: int, n_theirs: int) -> None:
    rng = np.random.default_rng(seed)
    own = [rows.tolist() for rows in np.split(rng.permutation(n), sorted(rng.integers(0, n + 1, 2)))]
    answers = [rng.uniform(0, 2, (len(rows), n_theirs, 3)) for rows in own]
    n_shared = int(rng.integers(0, min(n_theirs, 4) + 1))
    columns = (rng.permutation(4)[:n_shared], rng.permutation(n_theirs)[:n_shared])
    among = [None if rng.random() < 0.3 else frozenset(np.flatnonzero(rng.random(4) < 0.6).tolist()) for _ in range(n)]
    told, compiled = (
        kind(answers, own, columns, among, (4, 3)) for kind in both("session.fields.prepared.put_together")
    )
    assert told.shape == (n, 4, 3)
    np.testing.assert_array_equal(compiled, told)


@steady
@given(seed=seeds, turns=st.booleans(), is_aside=st.booleans())
def test_kernels_follow_a_motion_alike(seed: int, turns: bool, is_aside: bool) -> None:
    rng = np.random.default_rng(seed)
    own_m = (0.1, -0.2, 0.05) if is_aside else (0.0, 0.0, 0.0)
    plain, twin = (kind(0, 0.0, Pose((1.0, 2.0, 3.0)), own_m) for kind in both("session.impacts.motion_track.Motion"))
    time_s, at_m, rotation, step_m = 0.0, np.array([1.0, 2.0, 3.0]), (0.0, 0.0, 0.0, 1.0), np.zeros(3)
    for update in range(1, 80):
        time_s += rng.choice([0.0, 1 / 90, 1 / 30, 0.1], p=[0.05, 0.7, 0.2, 0.05])
        # Steps go on, fall, stop, turn back, or jump.
        step_m = rng.choice([1.0, 1.0, 0.2, 0.0, -0.6, 20.0]) * step_m + rng.choice([0.0, 0.001, 0.01]) * rng.normal(
            size=3
        )
        step_m *= min(1.0, 0.5 / max(math.hypot(*step_m), 1e-9))
        at_m = at_m + step_m
        if turns and rng.random() < 0.3:
            rotation = tuple(rng.normal(size=4).tolist())
        pose = None if rng.random() < 0.1 else Pose(at_m.tolist(), rotation)
        change = plain.look(pose)
        assert twin.look(pose) == change
        assert twin.next_m == plain.next_m
        if change:
            plain.follow(update, time_s)
            twin.follow(update, time_s)
        if rng.random() < 0.1:
            call = str(rng.choice(["land", "meet"]))
            getattr(plain, call)(update)
            getattr(twin, call)(update)
        for name in ("steps", "pose", "step_m", "since", "n_steps", "far_m2", "gap", "goes_on"):
            assert getattr(twin, name) == getattr(plain, name), name
