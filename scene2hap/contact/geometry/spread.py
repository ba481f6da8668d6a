"""Farthest-point sampling: reduce many contact points to a few that are far from each other.

The first is the point farthest from a middle. Each further one is the farthest from those chosen before.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from scene2hap.compiled import compiled
from scene2hap.contact.geometry.vectors import Floats, Triple, dot

MAX_POINTS = 4
"""Most contact points of one pair: the corners of a patch, few enough for a dense solve over a scene (assumed)."""

_SPREAD_M = 0.005  # Points of a pair nearer than this count as one (assumed: the width of a chair's foot).
_TIE_M = 1e-6  # Lengths this near count as equal, so that rounding does not choose between the corners of a square.


def spread(points: Floats, middle: Triple | None = None) -> list[int]:
    """Return the columns of at most `MAX_POINTS` of the points (3, n) [m] that are far from each other.

    Parameters: middle : the place from which the first is the farthest [m]; their mean if None.
    """
    if not points.size:
        return []
    chosen = [_first(points, _apart(points, points.mean(axis=1) if middle is None else np.array(middle)))]
    apart = _apart(points, points[:, chosen[0]])
    while len(chosen) < MAX_POINTS and apart.max() > _SPREAD_M:
        chosen.append(_first(points, apart))
        apart = np.minimum(apart, _apart(points, points[:, chosen[-1]]))
    return chosen


def _apart(points: Floats, place: Floats) -> Floats:
    """Return the distances (n,) of points (3, n) from a place (3,)."""
    away = points - place[:, None]
    squares = dot(away, away)
    return np.sqrt(squares, out=squares)


@compiled
def spread_few(points: Sequence[tuple[float, ...]]) -> list[int]:
    """Return the rows of the chosen points, as `spread`, for a few points in 2-D or 3-D, without numpy's call costs."""
    n = len(points)
    middle = [sum(ends) / n for ends in zip(*points, strict=True)]
    apart = [_distance(p, middle) for p in points]
    chosen = [_first_of_few(points, apart)]
    apart = [_distance(p, points[chosen[0]]) for p in points]
    while len(chosen) < MAX_POINTS and max(apart) > _SPREAD_M:
        chosen.append(_first_of_few(points, apart))
        apart = [min(old, _distance(p, points[chosen[-1]])) for p, old in zip(points, apart, strict=True)]
    return chosen


def _distance(one: Sequence[float], other: Sequence[float]) -> float:
    return math.sqrt(sum([(a - b) * (a - b) for a, b in zip(one, other, strict=True)]))


def _first(points: Floats, apart: Floats) -> int:
    """Return the column with the largest distance `apart`. Ties, up to rounding, go to the least x, then y, then z."""
    columns = np.flatnonzero(apart >= apart.max() - _TIE_M)
    if len(columns) == 1:
        return int(columns[0])
    return _least(columns.tolist(), points.take(columns, axis=1).tolist())


def _first_of_few(points: Sequence[tuple[float, ...]], apart: Sequence[float]) -> int:
    limit = max(apart) - _TIE_M
    rows = [row for row, length in enumerate(apart) if length >= limit]
    return rows[0] if len(rows) == 1 else _least(rows, list(zip(*[points[row] for row in rows], strict=True)))


def _least(names: Sequence[int], axes: Sequence[Sequence[float]]) -> int:
    """Return the name with the least first coordinate, up to rounding, then the least second, and so on.

    Points that remain tied are compared exactly, so that the result does not depend on their order.
    """
    left = list(range(len(names)))
    for values in axes:
        limit = min([values[k] for k in left]) + _TIE_M
        left = [k for k in left if values[k] <= limit]
    return names[min(left, key=lambda k: [values[k] for values in axes])]
