"""A few points that stand for many, far from each other: farthest-point sampling.

First the point farthest from the middle of all, then ever the one farthest from those taken.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

MAX_POINTS = 4
"""Contact points of one pair: the corners of a patch, few enough for a dense solve over a scene (assumed)."""

_SPREAD_M = 0.005  # Points of a pair nearer than this are one (assumed: the width of a chair's foot).
_TIE_M = 1e-6  # Lengths this near are equal, so that rounding does not choose between the corners of a square.


def spread(points: NDArray[np.float64]) -> list[int]:
    """Rows of at most `MAX_POINTS` of the points (n, 3) [m], far from each other."""
    if not len(points):
        return []
    apart = np.linalg.norm(points - points.mean(axis=0), axis=1)
    chosen = [_first(points, apart >= apart.max() - _TIE_M)]
    apart = np.linalg.norm(points - points[chosen[0]], axis=1)
    while len(chosen) < MAX_POINTS and apart.max() > _SPREAD_M:
        chosen.append(_first(points, apart >= apart.max() - _TIE_M))
        apart = np.minimum(apart, np.linalg.norm(points - points[chosen[-1]], axis=1))
    return chosen


def spread_few(points: Sequence[tuple[float, float]]) -> list[int]:
    """The same for a handful of points in a plane, without numpy's cost per call."""
    n = len(points)
    middle = (math.fsum(p[0] for p in points) / n, math.fsum(p[1] for p in points) / n)
    apart = [math.dist(p, middle) for p in points]
    chosen = [_first_of_few(points, apart)]
    apart = [math.dist(p, points[chosen[0]]) for p in points]
    while len(chosen) < MAX_POINTS and max(apart) > _SPREAD_M:
        chosen.append(_first_of_few(points, apart))
        apart = [min(old, math.dist(p, points[chosen[-1]])) for p, old in zip(points, apart, strict=True)]
    return chosen


def _first(points: NDArray[np.float64], tied: NDArray[np.bool_]) -> int:
    """Of the tied points the one with the least x, then y, then z, each up to rounding."""
    rows = np.flatnonzero(tied)
    for axis in range(3):
        values = points[rows, axis]
        rows = rows[values <= values.min() + _TIE_M]
    return int(rows[0])


def _first_of_few(points: Sequence[tuple[float, float]], apart: Sequence[float]) -> int:
    limit = max(apart) - _TIE_M
    rows = [row for row, length in enumerate(apart) if length >= limit]
    for axis in (0, 1):
        limit = min(points[row][axis] for row in rows) + _TIE_M
        rows = [row for row in rows if points[row][axis] <= limit]
    return rows[0]
