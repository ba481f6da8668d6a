"""Simplification of curves to few points within a tolerance."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings, strategies as st

from scene2hap.export.simplify import simplified


def plain(values: np.ndarray) -> np.ndarray:
    return values


def test_a_line_needs_its_ends_and_a_corner_one_more() -> None:
    t = np.linspace(0.0, 1.0, 101)
    assert simplified(t, 2 * t, plain, 1e-6, per_second=40).tolist() == [0, 100]
    assert simplified(t, np.abs(t - 0.3), plain, 1e-6, per_second=40).tolist() == [0, 30, 100]


@settings(max_examples=50)
@given(st.integers(0, 10_000), st.sampled_from([0.05, 0.2, 1.0]), st.floats(0.3, 4.0))
def test_no_point_is_missed_by_more_than_the_tolerance(seed: int, tolerance: float, duration_s: float) -> None:
    rng = np.random.default_rng(seed)
    t = np.linspace(0.0, duration_s, max(3, int(duration_s * 200)))
    values = np.cumsum(rng.standard_normal(len(t))) * 0.1
    chosen = simplified(t, values, plain, tolerance, per_second=1e6)
    missed = np.abs(np.interp(t, t[chosen], values[chosen]) - values)
    assert missed.max() <= tolerance + 1e-12


@settings(max_examples=50)
@given(st.integers(0, 10_000), st.integers(4, 60), st.floats(0.5, 4.0))
def test_no_second_has_more_points_than_allowed(seed: int, per_second: int, duration_s: float) -> None:
    rng = np.random.default_rng(seed)
    t = np.linspace(0.0, duration_s, int(duration_s * 200))
    chosen = simplified(t, rng.random(len(t)), plain, 1e-3, per_second=per_second)
    counts = np.bincount(t[chosen].astype(int))
    assert counts.max() <= per_second
    assert len(chosen) <= max(per_second * duration_s, 2)
    assert chosen[0] == 0
    assert chosen[-1] == len(t) - 1


def test_points_that_are_to_be_kept_are_kept() -> None:
    t = np.linspace(0.0, 1.0, 201)
    assert {0, 17, 40, 200} <= set(simplified(t, np.zeros(201), plain, 1.0, per_second=40, kept=[17, 40]).tolist())
