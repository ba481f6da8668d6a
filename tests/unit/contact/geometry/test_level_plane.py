"""Separating lines of footprints, against projections of the corners."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap.contact.geometry.level_plane import Footprint, reach_along, separation

ANGLES, HALVES, PLACES = st.floats(0.0, 7.0), st.floats(0.0, 0.5), st.floats(-1.0, 1.0)


def rectangle(angle: float, half_1: float, half_2: float) -> Footprint:
    return Footprint(math.cos(angle), math.sin(angle), half_1, half_2, math.hypot(half_1, half_2))


def corners(footprint: Footprint, u: float, v: float) -> np.ndarray:
    """The corners of a footprint's rectangle at (u, v), as (4, 2)."""
    first = np.array([footprint.a_u, footprint.a_v])
    second = np.array([-footprint.a_v, footprint.a_u])
    signs = ((1, 1), (1, -1), (-1, -1), (-1, 1))
    return np.array([(u, v) + i * footprint.half_1 * first + j * footprint.half_2 * second for i, j in signs])


@given(ANGLES, HALVES, HALVES, ANGLES, HALVES, HALVES, PLACES, PLACES)
@settings(max_examples=200)
def test_a_separating_line_divides_two_rectangles_by_its_gap(
    a1: float, h1: float, k1: float, a2: float, h2: float, k2: float, u: float, v: float
) -> None:
    one, other = rectangle(a1, h1, k1), rectangle(a2, h2, k2)
    n_u, n_v, gap_m, one_m, other_m = separation(one, 0.2, -0.1, other, u, v)
    first, second = corners(one, 0.2, -0.1), corners(other, u, v)
    assert math.hypot(n_u, n_v) == pytest.approx(1.0)
    assert (first @ (n_u, n_v)).max() == pytest.approx(one_m, abs=1e-12)
    assert (second @ (n_u, n_v)).min() == pytest.approx(other_m, abs=1e-12)
    assert other_m - one_m == pytest.approx(gap_m, abs=1e-12)
    for angle in (a1, a1 + math.pi / 2, a2, a2 + math.pi / 2):
        for way in (np.array([math.cos(angle), math.sin(angle)]), -np.array([math.cos(angle), math.sin(angle)])):
            assert gap_m >= (second @ way).min() - (first @ way).max() - 1e-12


def test_round_footprints_are_apart_by_their_circles() -> None:
    round_ = Footprint(1.0, 0.0, 0.1, 0.1, 0.1)
    n_u, n_v, gap_m, *_ = separation(round_, 0.0, 0.0, round_, 0.3, 0.4)
    assert (n_u, n_v, gap_m) == pytest.approx((0.6, 0.8, 0.3))
    assert reach_along(round_, 0.6, 0.8) == pytest.approx(0.1)


def test_equal_places_have_no_direction_through_their_middles() -> None:
    square = rectangle(0.0, 0.1, 0.1)
    assert separation(square, 0.0, 0.0, square, 0.0, 0.0)[2] == pytest.approx(-0.2)
