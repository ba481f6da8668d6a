"""Distance of two disjoint convex polygons in a plane, and the points where they face each other.

The corners of either against the edges of the other.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from scene2hap.compiled import compiled
from scene2hap.contact.stance import Point, edges_of

_ROUNDING_M = 1e-9


PolygonGap = tuple[float, Point, list[Point]]
"""How far two outlines are apart [m], the way from the first to the second there, and points half way between them
where they are little farther apart."""


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
        for nu, nv, offset in edges_of(tuple(ring)):
            widest = max(widest, -max([nu * u + nv * v - offset for u, v in other]))
            if widest > enough:
                return widest
    return widest
