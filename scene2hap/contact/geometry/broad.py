"""Overlap of axis-aligned boxes: sort and sweep along the axis with the fewest overlaps.

It serves objects and, within a pair of objects, triangles. Pairs are yielded in chunks, which bounds the memory.

Source: C. Ericson, Real-Time Collision Detection (2005), section 7.5 (sort and sweep).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from scene2hap.contact.geometry.vectors import Floats, Indices

# Pairs that overlap along the sweep axis and are compared at once: some 10 MB.
_CHUNK = 1 << 17
# Up to this many pairs, sorting costs more than comparing all with all.
_FEW = 1 << 12


class Boxes(NamedTuple):
    """Axis-aligned boxes by their lowest and highest corners, both (3, n) [m]."""

    low: Floats
    high: Floats

    def grown(self, margin_m: float) -> Boxes:
        """Return the boxes with `margin_m` added on every side."""
        return Boxes(self.low - margin_m, self.high + margin_m)

    def some(self, columns: Indices) -> Boxes:
        """Return the boxes of these columns."""
        return Boxes(self.low.take(columns, axis=1), self.high.take(columns, axis=1))

    def hull(self) -> Boxes:
        """Return the one box (3, 1) around all boxes, of which there must be at least one."""
        low: Floats = np.minimum.reduce(self.low, axis=1, keepdims=True)
        high: Floats = np.maximum.reduce(self.high, axis=1, keepdims=True)
        return Boxes(low, high)

    def meeting(self, one: Boxes) -> Indices:
        """Return the columns of boxes that overlap the box `one`, touching included."""
        x, y, z = (self.low <= one.high) & (self.high >= one.low)
        return np.flatnonzero(x & y & z)


def box_pairs(a: Boxes, b: Boxes) -> Iterator[tuple[Indices, Indices]]:
    """Yield all (i, j) whose boxes a[i] and b[j] overlap, touching included, in chunks; each pair once."""
    if len(a.low[0]) * len(b.low[0]) <= _FEW:
        meets = (a.low[..., None] <= b.high[:, None]) & (a.high[..., None] >= b.low[:, None])
        i, j = np.nonzero(meets[0] & meets[1] & meets[2])
        yield i, j
    else:
        sweeps = [_Sweep(a, b, axis) for axis in range(3)]
        yield from min(sweeps, key=lambda sweep: sweep.n_pairs).pairs(a, b)


class _Sweep:
    """The pairs that overlap along one axis, as ranges in sorted order.

    Either b starts within a, or a starts within b. Equal starts count as the latter.
    """

    def __init__(self, a: Boxes, b: Boxes, axis: int) -> None:
        low_a, high_a, low_b, high_b = a.low[axis], a.high[axis], b.low[axis], b.high[axis]
        self.others = [other for other in range(3) if other != axis]
        self.order_a, self.order_b = np.argsort(low_a, kind="stable"), np.argsort(low_b, kind="stable")
        sorted_a, sorted_b = low_a[self.order_a], low_b[self.order_b]
        self.b_in_a = (np.searchsorted(sorted_b, low_a, "right"), np.searchsorted(sorted_b, high_a, "right"))
        self.a_in_b = (np.searchsorted(sorted_a, low_b, "left"), np.searchsorted(sorted_a, high_b, "right"))
        self.n_pairs = sum(int((stop - start).sum()) for start, stop in (self.b_in_a, self.a_in_b))

    def pairs(self, a: Boxes, b: Boxes) -> Iterator[tuple[Indices, Indices]]:
        for i, place in _expanded(*self.b_in_a):
            yield self._overlapping(a, b, i, self.order_b[place])
        for j, place in _expanded(*self.a_in_b):
            yield self._overlapping(a, b, self.order_a[place], j)

    def _overlapping(self, a: Boxes, b: Boxes, i: Indices, j: Indices) -> tuple[Indices, Indices]:
        """Return the pairs that also overlap along the other axes."""
        for axis in self.others:
            meets = (a.low[axis].take(i) <= b.high[axis].take(j)) & (a.high[axis].take(i) >= b.low[axis].take(j))
            i, j = i[meets], j[meets]
        return i, j


def _expanded(start: Indices, stop: Indices) -> Iterator[tuple[Indices, Indices]]:
    """Yield (row, place) for every place in each row's range, in chunks of whole rows."""
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
