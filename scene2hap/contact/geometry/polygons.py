"""Convex polygons in the level plane: edges, containment and clipping.

u, v : coordinates [m]; n : unit normal of an edge, pointing inwards
"""

from __future__ import annotations

import math
from collections.abc import Sequence

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
