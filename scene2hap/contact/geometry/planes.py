"""Planes that separate bodies and bound the region of a body: vertical walls, level roofs and floors.

Walls are found in the level plane, along the direction in which two footprints are farthest apart. A footprint is the
projection of a body onto the level plane: the oriented rectangle of its box or a circle, whichever is narrower along a
direction. If a vertical plane separates two bodies, neither can fall onto the other, and the gap is a lower bound of
their distance.

    u, v : the world's level axes; n : a direction in the level plane, of length 1

Source: C. Ericson, Real-Time Collision Detection (2005), section 4.4 (separating-axis test).
"""

from __future__ import annotations

import math
from typing import NamedTuple


class Footprint(NamedTuple):
    """A body projected onto the level plane, relative to the middle of its box.

    (a_u, a_v) : first axis of a rectangle, the second is (-a_v, a_u); half_1, half_2 : its half edges [m]; radius : of
    a circle around the body [m].
    """

    a_u: float
    a_v: float
    half_1: float
    half_2: float
    radius: float


Separation = tuple[float, float, float, float, float]
"""(n_u, n_v, gap, one, other): unit direction from one body to the other, their gap along it [m], and the coordinates
of their facing ends along it [m]."""

Plane = tuple[float, float, float, float, bool]
"""(n_u, n_v, n_h, most_m, is_square): every point p of the body must satisfy n p <= most_m [m].

For a level direction, the body is its footprint: the rectangle if `is_square`, else the narrower of rectangle and
circle along n.
"""


def reach_along(footprint: Footprint, n_u: float, n_v: float) -> float:
    """Return how far a footprint extends from its middle along a direction [m]."""
    a_u, a_v, half_1, half_2, radius = footprint
    return min(radius, abs(n_u * a_u + n_v * a_v) * half_1 + abs(n_v * a_u - n_u * a_v) * half_2)


def separation(
    one: Footprint, one_u: float, one_v: float, other: Footprint, other_u: float, other_v: float
) -> Separation:
    """Return the separation with the largest gap, among the axes of both rectangles and the line through the middles.

    Parameters: one_u, one_v, other_u, other_v : the middles of the footprints [m].
    """
    du, dv = other_u - one_u, other_v - one_v
    away = math.sqrt(du * du + dv * dv)
    directions = [(one.a_u, one.a_v), (-one.a_v, one.a_u), (other.a_u, other.a_v), (-other.a_v, other.a_u)]
    if away > 0:
        directions.append((du / away, dv / away))
    best: Separation = (1.0, 0.0, -math.inf, 0.0, 0.0)
    for n_u, n_v in directions:
        along = n_u * du + n_v * dv
        if along < 0:
            n_u, n_v, along = -n_u, -n_v, -along
        one_m, other_m = reach_along(one, n_u, n_v), reach_along(other, n_u, n_v)
        gap_m = along - one_m - other_m
        if gap_m > best[2]:
            here = n_u * one_u + n_v * one_v
            best = (n_u, n_v, gap_m, here + one_m, here + along - other_m)
    return best


def wall_at(n_u: float, n_v: float, most_m: float, *, is_square: bool = False) -> Plane:
    """Return a vertical plane that keeps the body where n_u u + n_v v <= most_m."""
    return (n_u, n_v, 0.0, most_m, is_square)


def roof_at(height_m: float) -> Plane:
    """Return a level plane above the body."""
    return (0.0, 0.0, 1.0, height_m, False)


def floor_at(height_m: float) -> Plane:
    """Return a level plane below the body."""
    return (0.0, 0.0, -1.0, -height_m, False)
