"""Which boxes meet: sort and sweep along the axis that separates best.

Used for objects and, inside a pair of objects, for triangles; memory stays bounded by handing pairs out in chunks.

Source: C. Ericson, Real-Time Collision Detection (2005), section 7.5 (sort and sweep).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

# Pairs that overlap along the sweep axis and are looked at together: some 10 MB.
_CHUNK = 1 << 17
# So few that sorting costs more than comparing all with all.
_FEW = 1 << 12


class Boxes(NamedTuple):
    """Axis-parallel boxes by their lowest and highest corners, both (n, 3) [m]."""

    low: Floats
    high: Floats

    def grown(self, margin_m: float) -> Boxes:
        """The boxes with `margin_m` added on every side."""
        return Boxes(self.low - margin_m, self.high + margin_m)

    def swept(self, travel_m: Floats) -> Boxes:
        """The boxes that hold these on their whole way along `travel_m` (3,)."""
        return Boxes(self.low + np.minimum(travel_m, 0.0), self.high + np.maximum(travel_m, 0.0))

    def rows(self, rows: Indices) -> Boxes:
        """Some of the boxes."""
        return Boxes(self.low[rows], self.high[rows])

    def hull(self) -> Boxes:
        """The one box (1, 3) around all of them; at least one there must be."""
        return Boxes(self.low.min(axis=0, keepdims=True), self.high.max(axis=0, keepdims=True))

    def common(self, other: Boxes) -> Boxes:
        """What lies both in one of the boxes and in its counterpart, or in the other's only one; they must meet."""
        return Boxes(np.maximum(self.low, other.low), np.minimum(self.high, other.high))

    def meeting(self, one: Boxes, among: NDArray[np.bool_] | None = None) -> Indices:
        """Rows of the boxes that meet the single box `one`, touching included, among those marked (n,) or all."""
        near = (self.low[:, 0] <= one.high[0, 0]) & (self.high[:, 0] >= one.low[0, 0])
        rows = np.flatnonzero(near if among is None else near & among)
        for axis in (1, 2):
            low, high = self.low[rows, axis], self.high[rows, axis]
            rows = rows[(low <= one.high[0, axis]) & (high >= one.low[0, axis])]
        return rows


def box_pairs(a: Boxes, b: Boxes) -> Iterator[tuple[Indices, Indices]]:
    """All (i, j) with a[i] and b[j] meeting, touching included, in chunks; each pair once."""
    if len(a.low) * len(b.low) <= _FEW:
        apart = (a.low[:, None] > b.high) | (a.high[:, None] < b.low)
        i, j = np.nonzero(~(apart[..., 0] | apart[..., 1] | apart[..., 2]))
        yield i, j
    else:
        sweeps = [_Sweep(a, b, axis) for axis in range(3)]
        yield from min(sweeps, key=lambda sweep: sweep.n_pairs).pairs(a, b)


class _Sweep:
    """The pairs that overlap along one axis, as ranges in sorted order.

    Either b starts within a, or a starts within b (ties go to the latter).
    """

    def __init__(self, a: Boxes, b: Boxes, axis: int) -> None:
        low_a, high_a, low_b, high_b = a.low[:, axis], a.high[:, axis], b.low[:, axis], b.high[:, axis]
        self.order_a, self.order_b = np.argsort(low_a, kind="stable"), np.argsort(low_b, kind="stable")
        sorted_a, sorted_b = low_a[self.order_a], low_b[self.order_b]
        self.b_in_a = (np.searchsorted(sorted_b, low_a, "right"), np.searchsorted(sorted_b, high_a, "right"))
        self.a_in_b = (np.searchsorted(sorted_a, low_b, "left"), np.searchsorted(sorted_a, high_b, "right"))
        self.n_pairs = sum(int((stop - start).sum()) for start, stop in (self.b_in_a, self.a_in_b))

    def pairs(self, a: Boxes, b: Boxes) -> Iterator[tuple[Indices, Indices]]:
        for i, place in _expanded(*self.b_in_a):
            yield _meeting(a, b, i, self.order_b[place])
        for j, place in _expanded(*self.a_in_b):
            yield _meeting(a, b, self.order_a[place], j)


def _expanded(start: Indices, stop: Indices) -> Iterator[tuple[Indices, Indices]]:
    """(row, place) for every place in the rows' ranges, in chunks of whole rows."""
    count = stop - start
    total = np.cumsum(count)
    row = 0
    while row < len(count):
        done = int(total[row - 1]) if row else 0
        end = max(row + 1, int(np.searchsorted(total, done + _CHUNK, "right")))
        n = count[row:end]
        rows = np.repeat(np.arange(row, end), n)
        first = np.repeat(start[row:end] - (total[row:end] - n - done), n)
        if len(rows):
            yield rows, first + np.arange(len(rows))
        row = end


def _meeting(a: Boxes, b: Boxes, i: Indices, j: Indices) -> tuple[Indices, Indices]:
    meets = (a.low[i] <= b.high[j]) & (a.high[i] >= b.low[j])
    every = meets[:, 0] & meets[:, 1] & meets[:, 2]
    return i[every], j[every]
