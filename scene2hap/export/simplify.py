"""Simplify a curve: keep the few points with the largest distance from straight lines between their neighbours.

The order is that of Ramer (1972) and Douglas and Peucker (1973): begin with a line from end to end, then repeatedly add
the point with the largest error. The largest error of the whole curve comes first, so a bound on points keeps the most
important ones.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats


def simplified(
    times_s: Floats,
    values: Floats,
    measure: Callable[[Floats], Floats],
    tolerance: float,
    *,
    per_second: float,
    kept: Iterable[int] = (),
) -> NDArray[np.intp]:
    """Return the indices of points of a curve (n,) between which straight lines stay within a tolerance of it.

    Parameters: measure : function from values to the compared quantity, such as decibels; per_second : most points in
        each second, proportionally fewer in an incomplete last second; the ends and the `kept` points count. If this
        bound leaves too few points, the error exceeds the tolerance.
    """
    measured = measure(values)
    chosen = sorted({0, len(values) - 1, *kept})
    room = np.floor(per_second * np.clip(times_s[-1] - np.arange(int(times_s[-1]) + 1), 0.0, 1.0))
    blocks = np.minimum(times_s.astype(int), len(room) - 1)
    np.subtract.at(room, blocks[chosen], 1.0)
    for second in range(len(room) - 1, 0, -1):  # the last second of a curve may be too short for a point of its own
        room[second - 1] += min(room[second], 0.0)
    # (minus the error, index of the point, first and last point of the line)
    waiting: list[tuple[float, int, int, int]] = []

    def look(first: int, last: int) -> None:
        if last - first < 2:
            return
        between = slice(first + 1, last)
        share = (times_s[between] - times_s[first]) / (times_s[last] - times_s[first])
        line = values[first] + share * (values[last] - values[first])
        missed = np.abs(measure(line) - measured[between])
        missed[room[blocks[between]] < 1.0] = 0.0
        worst = int(missed.argmax())
        if missed[worst] > tolerance:
            heapq.heappush(waiting, (-float(missed[worst]), first + 1 + worst, first, last))

    for first, last in pairwise(chosen):
        look(first, last)
    while waiting:
        _, index, first, last = heapq.heappop(waiting)
        if room[blocks[index]] < 1.0:
            look(first, last)  # another second of the line may still have room
            continue
        room[blocks[index]] -= 1.0
        chosen.append(index)
        look(first, index)
        look(index, last)
    return np.array(sorted(chosen), dtype=np.intp)
