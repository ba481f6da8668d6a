"""A few points that stand for many, far from each other: farthest-point sampling.

First the point farthest from the middle of all, then ever the one farthest from those taken.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from scene2hap.compiled import compiled
from scene2hap.contact.vectors import Floats, Indices, Marks, dot

MAX_POINTS = 4
"""Contact points of one pair: the corners of a patch, few enough for a dense solve over a scene (assumed)."""

_SPREAD_M = 0.005  # Points of a pair nearer than this are one (assumed: the width of a chair's foot).
_TIE_M = 1e-6  # Lengths this near are equal, so that rounding does not choose between the corners of a square.
# Weighs coordinates so that no two corners of a plain shape are equally far along it.
_ASKEW = (0.6180339887, 0.2879190313)


def spread(points: Floats) -> list[int]:
    """Columns of at most `MAX_POINTS` of the points (3, n) [m], far from each other."""
    if not points.size:
        return []
    chosen = [_first(points, _apart(points, points.mean(axis=1)))]
    apart = _apart(points, points[:, chosen[0]])
    while len(chosen) < MAX_POINTS and apart.max() > _SPREAD_M:
        chosen.append(_first(points, apart))
        apart = np.minimum(apart, _apart(points, points[:, chosen[-1]]))
    return chosen


def _apart(points: Floats, place: Floats) -> Floats:
    """How far points (3, n) are from a place (3,)."""
    away = points - place[:, None]
    squares = dot(away, away)
    return np.sqrt(squares, out=squares)


@compiled
def spread_few(points: Sequence[tuple[float, ...]]) -> list[int]:
    """The same for a handful of points, in space or in a plane, without numpy's cost per call."""
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
    """Of the points that are farthest apart, up to rounding, the one with the least x, then y, then z, likewise."""
    columns = np.flatnonzero(apart >= apart.max() - _TIE_M)
    if len(columns) == 1:
        return int(columns[0])
    return _least(columns.tolist(), points.take(columns, axis=1).tolist())


def _first_of_few(points: Sequence[tuple[float, ...]], apart: Sequence[float]) -> int:
    limit = max(apart) - _TIE_M
    rows = [row for row, length in enumerate(apart) if length >= limit]
    return rows[0] if len(rows) == 1 else _least(rows, list(zip(*[points[row] for row in rows], strict=True)))


def _least(names: Sequence[int], axes: Sequence[Sequence[float]]) -> int:
    """The name with the least of the first coordinates, up to rounding, then of the second, and so on.

    Exact ties are decided to the last bit, so that the result does not depend on the order of the names.
    """
    left = list(range(len(names)))
    for values in axes:
        limit = min([values[k] for k in left]) + _TIE_M
        left = [k for k in left if values[k] <= limit]
    return names[min(left, key=lambda k: [values[k] for values in axes])]


def spread_each(points: Floats, counts: Marks) -> tuple[Indices, Marks]:
    """The same for many sets at once: points (3, k, n) [m], of which those count that are marked (k, n).

    Rows (`MAX_POINTS`, n) of the points taken, and which of these rows are any. The middle is that of the box around
    the points, since a sum would depend on how many sets there are.
    """
    columns, every = np.arange(points.shape[2]), points.reshape(3, -1)
    low, high = np.where(counts, points, np.inf).min(axis=1), np.where(counts, points, -np.inf).max(axis=1)
    some = counts.any(axis=0)
    middle = np.where(some, low, 0.0) / 2 + np.where(some, high, 0.0) / 2
    key = points[0] + _ASKEW[0] * points[1] + _ASKEW[1] * points[2]
    rows, kept = np.zeros((MAX_POINTS, len(columns)), dtype=np.intp), np.zeros((MAX_POINTS, len(columns)), dtype=bool)
    # What does not count is nearer than everything.
    apart = np.where(counts, _distances(points, middle), -1.0)
    farthest, more = apart.max(axis=0), some
    for k in range(MAX_POINTS):
        rows[k] = np.where(apart >= farthest - _TIE_M, key, np.inf).argmin(axis=0)
        kept[k] = more
        if k + 1 == MAX_POINTS or not more.any():
            break
        away = _distances(points, every.take(rows[k] * len(columns) + columns, axis=1))
        apart = np.minimum(apart, away) if k else np.where(counts, away, -1.0)
        farthest = apart.max(axis=0)
        more = more & (farthest > _SPREAD_M)
    return rows, kept


def _distances(points: Floats, places: Floats) -> Floats:
    away = points - places[:, None]
    away *= away
    lengths: Floats = away[0]
    lengths += away[1]
    lengths += away[2]
    return np.sqrt(lengths, out=lengths)
