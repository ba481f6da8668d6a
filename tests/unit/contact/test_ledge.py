"""Ledges of a mesh and their rims, against known outlines."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from numpy.typing import NDArray

from contact_scenes import house, level, quads
from scene2hap.contact.body import Body
from scene2hap.contact.geometry.boxes import boxes_of
from scene2hap.contact.ledge import Flat, Ledges, VerticalAxis
from scene2hap.contact.shape import shape_of

UP = VerticalAxis(1, 1, 0, 2)
WIDE = (-5.0, -5.0, 5.0, 5.0)


def ledges(triangles: NDArray[np.float64], upright: VerticalAxis = UP) -> Ledges:
    """The ledges of triangles (n, 3, 3), whose rows are corners."""
    axes_first = triangles.transpose(2, 1, 0)
    return Ledges(axes_first, boxes_of(axes_first), upright, 2e-4)


def triangles_of(*corners: list[tuple[float, float, float]]) -> NDArray[np.float64]:
    mesh = quads(*corners)
    return mesh.vertices_m[mesh.faces]


def stretched(found: Ledges, number: int, foot: Flat, most: Flat) -> Flat | None:
    return found.stretch(number, foot, most) if found.covers(number, foot) else None


def inside_l(x: float, z: float) -> bool:
    return abs(x) <= 1.5 and abs(z) <= 1.5 and not (x > 0.5 and z > 0.5)


PLACES = st.tuples(st.floats(-1.7, 1.7), st.floats(-1.7, 1.7), st.floats(0.0, 1.2), st.floats(0.0, 1.2))


@given(PLACES)
@settings(max_examples=200)
def test_a_stretch_of_an_l_is_found_where_there_is_one_and_holds_the_foot(
    place: tuple[float, float, float, float],
) -> None:
    u0, v0, width, depth = place
    foot = (u0, v0, u0 + width, v0 + depth)
    shape = shape_of(house().geometry.mesh)
    found = shape.ledges(UP)
    number = found.heights.index(0.0)
    assume(min(abs(abs(edge) - rim) for edge in foot for rim in (0.5, 1.5)) > 1e-5)
    # An L contains a rectangle if it contains the four corners; no such rectangle can span the notch.
    is_covered = all(inside_l(u, v) for u in foot[::2] for v in foot[1::2])
    stretch = stretched(found, number, foot, WIDE)
    assert (stretch is not None) == is_covered
    if stretch is not None:
        assert all(inside_l(u, v) for u in stretch[::2] for v in stretch[1::2])
        assert stretch[0] <= foot[0]
        assert stretch[1] <= foot[1]
        assert stretch[2] >= foot[2]
        assert stretch[3] >= foot[3]


def test_a_stretch_ends_at_the_rim_or_at_its_limit() -> None:
    found = shape_of(house().geometry.mesh).ledges(UP)
    stretch = stretched(found, found.heights.index(0.0), (-0.1, -0.1, 0.1, 0.1), (-0.3, -9.0, 9.0, 9.0))
    assert stretch is not None
    assert stretch[:2] == pytest.approx((-0.3, -1.5), abs=0.01)
    assert sorted(stretch[2:]) == pytest.approx([0.5, 1.5], abs=0.01)


def test_faces_drawn_from_both_sides_with_other_diagonals_have_a_rim() -> None:
    a, b, c, d = level(0.0, 0.0, 1.0, 1.0, 0.3)
    both = np.array([[a, b, c], [a, c, d], [b, a, d], [b, d, c]])
    found = ledges(both)
    assert stretched(found, 0, (0.4, 0.4, 0.6, 0.6), WIDE) == pytest.approx((0.0, 0.0, 1.0, 1.0), abs=0.01)
    assert stretched(found, 0, (0.4, 0.4, 1.1, 0.6), WIDE) is None
    assert stretched(found, 0, (1.1, 0.4, 1.2, 0.6), WIDE) is None


def test_a_hole_is_no_ledge() -> None:
    ring = [level(0, 0, 3, 1, 0.0), level(0, 1, 1, 2, 0.0), level(2, 1, 3, 2, 0.0), level(0, 2, 3, 3, 0.0)]
    found = ledges(triangles_of(*ring))
    assert stretched(found, 0, (1.2, 1.2, 1.8, 1.8), WIDE) is None
    assert stretched(found, 0, (0.5, 0.5, 2.5, 2.5), WIDE) is None
    assert stretched(found, 0, (0.2, 0.2, 0.8, 0.8), WIDE) is not None


@given(st.floats(0.0, 1.1), st.floats(-math.pi, math.pi), st.floats(0.01, 0.3))
@settings(max_examples=100)
def test_a_stretch_of_a_round_table_is_in_its_circle(away: float, bearing: float, half: float) -> None:
    angles = 2 * np.pi * np.arange(64) / 64
    ring = np.stack([np.cos(angles), np.zeros(64), np.sin(angles)], axis=1)
    found = ledges(np.stack([np.zeros((64, 3)), ring, np.roll(ring, -1, axis=0)], axis=1))
    u, v = away * math.cos(bearing), away * math.sin(bearing)
    foot = (u - half, v - half, u + half, v + half)
    stretch = stretched(found, 0, foot, WIDE)
    farthest = math.hypot(abs(u) + half, abs(v) + half)
    if stretch is None:
        assert farthest > math.cos(math.pi / 64) - 1e-9
    else:
        assert farthest <= 1 + 1e-9
        assert math.hypot(max(-stretch[0], stretch[2]), max(-stretch[1], stretch[3])) <= 1 + 1e-9


def test_heights_are_along_the_vertical_axis() -> None:
    shape = shape_of(house().geometry.mesh)
    assert shape.ledges(UP).heights == pytest.approx([0.0, 0.12, 0.88, 0.9, 2.4])
    assert shape.ledges(VerticalAxis(1, -1, 0, 2)).heights == pytest.approx([-2.4, -0.9, -0.88, -0.12, 0.0])
    # With x up, the walls are level.
    assert shape.ledges(VerticalAxis(0, 1, 1, 2)).heights == pytest.approx([-1.5, -0.7, 0.5, 1.5])
    assert Body.of(house((0.5, 0.5, 0.5, 0.5)), 1).stance.lean is not None


def test_faces_less_apart_than_uneven_are_one_ledge() -> None:
    found = ledges(triangles_of(level(0, 0, 1, 1, 0.0), level(1, 0, 2, 1, 0.00015), level(2, 0, 3, 1, 0.001)))
    assert found.heights == pytest.approx([0.00015, 0.001])
    across: Flat = (0.5, 0.4, 1.5, 0.6)
    assert stretched(found, 0, across, WIDE) is not None
    assert stretched(found, 1, (2.5, 0.4, 3.5, 0.6), WIDE) is None
