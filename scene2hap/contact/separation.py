"""Separating lines: the level direction along which two bodies are farthest apart.

Each body is seen from above, as the oriented rectangle of its own box and a circle around it, whichever is narrower in
a direction. Two that a vertical plane divides share no fall, and are no nearer than that plane says.

    u, v : the world's level axes; n : a direction in the level plane, of length 1

Source: C. Ericson, Real-Time Collision Detection (2005), section 4.4 (separating-axis test).
"""

from __future__ import annotations

import math
from typing import NamedTuple


class Footprint(NamedTuple):
    """A body seen from above, around the middle of its box: the first axis (a_u, a_v) of a rectangle, the second being
    (-a_v, a_u), half of its edges, and the radius of a circle around it [m]."""

    a_u: float
    a_v: float
    half_1: float
    half_2: float
    radius: float


Separation = tuple[float, float, float, float, float]
"""The direction from one body to another, as n_u and n_v, the gap along it [m], and how far each reaches along it from
the origin: one forwards, the other backwards [m]."""


def reach_along(footprint: Footprint, n_u: float, n_v: float) -> float:
    """How far a footprint reaches from its middle along a direction [m]."""
    a_u, a_v, half_1, half_2, radius = footprint
    return min(radius, abs(n_u * a_u + n_v * a_v) * half_1 + abs(n_v * a_u - n_u * a_v) * half_2)


def separation(
    one: Footprint, one_u: float, one_v: float, other: Footprint, other_u: float, other_v: float
) -> Separation:
    """The best of the directions along the edges of both rectangles and through both middles, which are at (u, v)."""
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
