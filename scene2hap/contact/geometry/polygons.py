"""Convex polygons in the level plane: edges, containment, clipping and distance.

u, v : coordinates [m]; n : unit normal of an edge, pointing inwards
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from scene2hap.compiled import compiled
from scene2hap.contact.geometry.vectors import Triple

Point = tuple[float, float]

_ROUNDING_M = 1e-9


PolygonGap = tuple[float, Point, list[Point]]
"""The distance of two outlines [m], the vector from the first to the second between the nearest points [m], and points
half way between them at all places that are about as near."""


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
def clipped(outline: Sequence[Point], du: float, dv: float, edges: Sequence[Triple]) -> list[Point]:
    """Clip an outline, moved by (du, dv), to the inside of all edges.

    Source: I. E. Sutherland, G. W. Hodgman, Reentrant polygon clipping, Comm. ACM 17 (1974) 32.
    """
    ring = [(u + du, v + dv) for u, v in outline]
    for nu, nv, offset in edges:
        inside = [nu * u + nv * v - offset for u, v in ring]
        cut: list[Point] = []
        for k, here in enumerate(inside):
            before = inside[k - 1]
            if (here < 0) != (before < 0):
                (u1, v1), (u2, v2), share = ring[k - 1], ring[k], before / (before - here)
                cut.append((u1 + share * (u2 - u1), v1 + share * (v2 - v1)))
            if here >= 0:
                cut.append(ring[k])
        ring = cut
    return ring


@compiled
def polygon_gap(
    x: Sequence[Point], y: Sequence[Point], rise_m: float, within_m: float, slack_m: float
) -> PolygonGap | None:
    """Return distance, direction and facing points of two disjoint convex polygons; None if they overlap.

    Beyond `within_m` the distance is inf, without points.

    Parameters: x, y : corners in order, at most 8 [m]; rise_m : vertical distance between the two, which is combined
    with every level distance; slack_m : facing points may be this much farther apart than the nearest ones.
    """
    strip = _strip_m(x, y, within_m)
    if strip < -_ROUNDING_M:
        return None
    nearest = _nearest(x, y) + [(q, p) for p, q in _nearest(y, x)] if strip <= within_m else []
    lengths = [_length((q[0] - p[0], q[1] - p[1])) for p, q in nearest]
    least, (p, q) = min(zip(lengths, nearest, strict=True), default=(math.inf, ((0.0, 0.0), (0.0, 0.0))))
    distance = _length((least, rise_m))
    if distance > within_m:
        return math.inf, (0.0, 0.0), []
    ends = [
        pair for pair, apart in zip(nearest, lengths, strict=True) if _length((apart, rise_m)) <= distance + slack_m
    ]
    return distance, (q[0] - p[0], q[1] - p[1]), [((p[0] + q[0]) / 2, (p[1] + q[1]) / 2) for p, q in ends]


def _length(way: Point) -> float:
    return math.sqrt(way[0] * way[0] + way[1] * way[1])


def _nearest(corners: Sequence[Point], ring: Sequence[Point]) -> list[tuple[Point, Point]]:
    """Return, for each corner and each edge of the ring, the corner and the nearest point of the edge."""
    found = []
    for u, v in corners:
        for (u1, v1), (u2, v2) in zip(ring, [*ring[1:], ring[0]], strict=True):
            eu, ev = u2 - u1, v2 - v1
            t = min(max(((u - u1) * eu + (v - v1) * ev) / (eu * eu + ev * ev), 0.0), 1.0)
            found.append(((u, v), (u1 + t * eu, v1 + t * ev)))
    return found


def _strip_m(x: Sequence[Point], y: Sequence[Point], enough: float) -> float:
    """Return the largest gap of two outlines along the normals of their edges [m] (separating axes), negative if they
    overlap. It is at most their distance. The first gap above `enough` is returned at once."""
    widest = -math.inf
    for ring, other in ((x, y), (y, x)):
        for nu, nv, offset in edges_of(ring):
            widest = max(widest, -max([nu * u + nv * v - offset for u, v in other]))
            if widest > enough:
                return widest
    return widest
