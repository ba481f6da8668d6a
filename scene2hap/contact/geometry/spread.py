"""Farthest-point sampling: reduce many contact points to a few that are far from each other.

The first is the point farthest from a middle. Each further one is the farthest from those chosen before.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import reduce
from operator import add

from scene2hap.compiled import compiled

MAX_POINTS = 4
"""Most contact points of one pair: the corners of a patch, few enough for a dense solve over a scene (assumed)."""

_SPREAD_M = 0.005  # Points of a pair nearer than this count as one (assumed: the width of a chair's foot).
_TIE_M = 1e-6  # Lengths this near count as equal, so that rounding does not choose between the corners of a square.


@compiled
def spread(points: Sequence[tuple[float, ...]], middle: Sequence[float] | None = None) -> list[int]:
    """Return the rows of at most `MAX_POINTS` of some points in 2-D or 3-D [m] that are far from each other.

    Parameters: middle : the place from which the first is the farthest [m]; their mean if None.
    """
    if middle is None:
        middle = [_sum(ends) / len(points) for ends in zip(*points, strict=True)]
    chosen = [_farthest(points, [_distance(point, middle) for point in points])]
    apart = [math.inf] * len(points)
    while len(chosen) < MAX_POINTS:
        apart = [min(old, _distance(point, points[chosen[-1]])) for point, old in zip(points, apart, strict=True)]
        if max(apart) <= _SPREAD_M:
            break
        chosen.append(_farthest(points, apart))
    return chosen


def _distance(one: Sequence[float], other: Sequence[float]) -> float:
    return math.sqrt(_sum([(a - b) * (a - b) for a, b in zip(one, other, strict=True)]))


def _sum(numbers: Iterable[float]) -> float:
    # From Python 3.12 on, `sum` corrects rounding errors, which the kernel does not.
    return reduce(add, numbers)


def _farthest(points: Sequence[tuple[float, ...]], apart: Sequence[float]) -> int:
    """Return the row with the largest distance `apart`.

    Ties, up to rounding, go to the least first coordinate, then the second, and so on. Points that remain tied are
    compared exactly, so that the result does not depend on their order.
    """
    limit = max(apart) - _TIE_M
    left = [row for row, length in enumerate(apart) if length >= limit]
    for axis in range(len(points[0])):
        limit = min([points[row][axis] for row in left]) + _TIE_M
        left = [row for row in left if points[row][axis] <= limit]
    return min(left, key=lambda row: points[row])
