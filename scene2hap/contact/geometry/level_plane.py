"""The level plane: convex polygons and footprints in it, and the planes that separate bodies and bound their regions.

A footprint is the projection of a body onto the level plane: the oriented rectangle of its box or a circle, whichever
is narrower along a direction. Separating planes are vertical walls, along the direction in which two footprints are
farthest apart, and level roofs and floors. If a wall separates two bodies, neither can fall onto the other, and the gap
is a lower bound of their distance.

    u, v : the world's level axes [m]; n : a direction in the level plane, of length 1; that of an edge points inwards

Source: C. Ericson, Real-Time Collision Detection (2005), section 4.4 (separating-axis test).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from scene2hap.compiled import compiled
from scene2hap.contact.geometry.vectors import Triple

Point = tuple[float, float]


@compiled
def turned_outline(corners_m: Sequence[Triple], row_u: Triple, row_v: Triple) -> tuple[Point, ...]:
    """Project corners onto the level plane, with the two level rows of a rotation matrix."""
    (a, b, c), (d, e, f) = row_u, row_v
    return tuple([(a * x + b * y + c * z, d * x + e * y + f * z) for x, y, z in corners_m])


@compiled
def edges_of(outline: Sequence[Point]) -> tuple[Triple, ...]:
    """Return (n_u, n_v, offset) of each edge of a convex outline: inside where n_u u + n_v v >= offset."""
    mu, mv = 0.0, 0.0
    for u, v in outline:
        mu, mv = mu + u, mv + v
    mu, mv, edges = mu / len(outline), mv / len(outline), []
    for k, (u1, v1) in enumerate(outline):
        u2, v2 = outline[(k + 1) % len(outline)]
        nu, nv = v1 - v2, u2 - u1
        length = math.sqrt(nu * nu + nv * nv)
        if length == 0:
            continue
        nu, nv = nu / length, nv / length
        offset = nu * u1 + nv * v1
        if nu * mu + nv * mv < offset:
            nu, nv, offset = -nu, -nv, -offset
        edges.append((nu, nv, offset))
    return tuple(edges)


@compiled
def inside_edges(outline: Sequence[Point], du: float, dv: float, edges: Sequence[Triple]) -> tuple[float, float]:
    """Return how far the corners of an outline, moved by (du, dv), are inside all edges [m].

    The first is the least over all corners and edges, that of the outermost corner. The second is the least over the
    edges of the innermost corner's distance; it is negative if an edge separates the outline from the polygon.
    """
    outermost = innermost = math.inf
    for nu, nv, offset in edges:
        inside = [nu * (u + du) + nv * (v + dv) - offset for u, v in outline]
        outermost, innermost = min(outermost, min(inside)), min(innermost, max(inside))
    return outermost, innermost


@compiled
def clipped(outline: Sequence[Point], du: float, dv: float, edges: Sequence[Triple], slack_m: float) -> list[Point]:
    """Clip an outline, moved by (du, dv), to the inside of all edges; corners up to `slack_m` outside an edge are kept.

    Without the slack, two sides that nearly coincide would cross anywhere along them, as rounding decides.
    Source: I. E. Sutherland, G. W. Hodgman, Reentrant polygon clipping, Comm. ACM 17 (1974) 32.
    """
    ring = [(u + du, v + dv) for u, v in outline]
    for nu, nv, offset in edges:
        inside = [nu * u + nv * v - offset for u, v in ring]
        cut: list[Point] = []
        for k, here in enumerate(inside):
            before = inside[k - 1]
            is_in, was_in = here >= -slack_m, before >= -slack_m
            if is_in != was_in and (here < 0) != (before < 0):
                (u1, v1), (u2, v2), share = ring[k - 1], ring[k], before / (before - here)
                cut.append((u1 + share * (u2 - u1), v1 + share * (v2 - v1)))
            if is_in:
                cut.append(ring[k])
        ring = cut
    return ring


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
