"""Convex polygons in the level plane: their edges, what of one is inside edges, and how far two are apart.

u, v : coordinates [m]; n : the normal of an edge, of length 1 and pointing inwards
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from scene2hap.compiled import compiled
from scene2hap.contact.vectors import Triple

Point = tuple[float, float]

_ROUNDING_M = 1e-9


PolygonGap = tuple[float, Point, list[Point]]
"""How far two outlines are apart [m], the way from the first to the second there, and points half way between them
where they are little farther apart."""


@compiled
def turned_outline(corners_m: Sequence[Triple], row_u: Triple, row_v: Triple) -> tuple[Point, ...]:
    """Corners seen from above, by the two level rows of a rotation."""
    (a, b, c), (d, e, f) = row_u, row_v
    return tuple([(a * x + b * y + c * z, d * x + e * y + f * z) for x, y, z in corners_m])


@compiled
def edges_of(outline: Sequence[Point]) -> tuple[Triple, ...]:
    """(n_u, n_v, offset) of each edge of a convex outline, the normal of length 1 and pointing inwards."""
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
    """How far inside all edges the corners of an outline moved by (du, dv) are [m]: the outermost corner, and the
    innermost one at the edge that it is least inside of."""
    outermost = innermost = math.inf
    for nu, nv, offset in edges:
        inside = [nu * (u + du) + nv * (v + dv) - offset for u, v in outline]
        outermost, innermost = min(outermost, min(inside)), min(innermost, max(inside))
    return outermost, innermost


@compiled
def clipped(outline: Sequence[Point], du: float, dv: float, edges: Sequence[Triple]) -> list[Point]:
    """What of an outline moved by (du, dv) lies inside all edges.

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
    """Distance, direction and facing points of two disjoint convex polygons; a distance of inf and no points beyond
    `within_m`, None where they overlap.

    Parameters: x, y : their corners, at most 8, in a row [m]; rise_m : how much higher one is than the other, which
    adds to every distance; slack_m : how much farther apart counts as little.
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
    """For each corner and each edge of the ring, the corner and the edge's point nearest to it."""
    found = []
    for u, v in corners:
        for (u1, v1), (u2, v2) in zip(ring, [*ring[1:], ring[0]], strict=True):
            eu, ev = u2 - u1, v2 - v1
            t = min(max(((u - u1) * eu + (v - v1) * ev) / (eu * eu + ev * ev), 0.0), 1.0)
            found.append(((u, v), (u1 + t * eu, v1 + t * ev)))
    return found


def _strip_m(x: Sequence[Point], y: Sequence[Point], enough: float) -> float:
    """How wide a strip along an edge of either is between two outlines, below 0 where they overlap: the widest, or the
    first that is more than enough. No more than their distance."""
    widest = -math.inf
    for ring, other in ((x, y), (y, x)):
        for nu, nv, offset in edges_of(ring):
            widest = max(widest, -max([nu * u + nv * v - offset for u, v in other]))
            if widest > enough:
                return widest
    return widest
