"""Kernels of `session`: each compiled kernel gives the results of its plain twin."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given, strategies as st

from kernels import both, seeds, steady


@steady
@given(seed=seeds, n=st.integers(0, 3))
def test_kernels_select_the_same_sources_within_the_cut_off(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    costs = rng.choice([0.0, 1.0, 2.0, math.inf], (n, 5)).tolist()
    cutoff = rng.choice([-1.0, 0.0, 1.5, math.inf], 5).tolist()
    sought = [frozenset(rng.choice(5, int(rng.integers(0, 5)), replace=False).tolist()) for _ in range(n)]
    plain, twin = both("session.audibility.within")
    assert twin(costs, cutoff, sought) == plain(costs, cutoff, sought)


@steady
@given(seed=seeds, n=st.integers(0, 3))
def test_kernels_silence_the_same_bands(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    least = rng.choice([0.0, 0.5, np.inf], (4, 5)).astype(np.float32)
    columns = None if rng.random() < 0.3 else sorted(rng.choice(4, int(rng.integers(0, 5)), replace=False).tolist())
    gains = rng.choice([0.0, 0.4, 0.5, 0.6, np.nan], (n, 4 if columns is None else len(columns), 5)).astype(np.float32)
    plain, twin = both("session.audibility.silence")
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
    told, compiled = (kind(gains, peaks, 0.3, least) for kind in both("session.audibility.sifted"))
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
