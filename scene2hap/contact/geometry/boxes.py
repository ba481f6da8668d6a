"""Axis-aligned boxes, and which overlap: sort and sweep along the axis with the fewest overlaps.

It serves objects and, within a pair of objects, triangles. Pairs are yielded in chunks, which bounds the memory.

Source: C. Ericson, Real-Time Collision Detection (2005), section 7.5 (sort and sweep).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats, Indices
from scene2hap.contact.geometry.vectors import highest, lowest

# Pairs that overlap along the sweep axis and are compared at once; of triangles: some 20 MB.
_CHUNK = 1 << 13
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


def boxes_of(triangles: Floats) -> Boxes:
    """Return the bounding boxes of triangles (3, 3, m)."""
    corners = triangles.transpose(1, 0, 2)
    return Boxes(lowest(corners), highest(corners))


def box_pairs(a: Boxes, b: Boxes) -> Iterator[tuple[Indices, Indices]]:
    """Yield all (i, j) whose boxes a[i] and b[j] overlap, touching included, in chunks; each pair once."""
    if len(a.low[0]) * len(b.low[0]) <= _FEW:
        meets = (a.low[..., None] <= b.high[:, None]) & (a.high[..., None] >= b.low[:, None])
        i, j = np.nonzero(meets[0] & meets[1] & meets[2])
        yield i, j
    else:
        sweeps = [(_starts_in(a, b, axis, "right"), _starts_in(b, a, axis, "left")) for axis in range(3)]
        in_a, in_b = min(sweeps, key=lambda sweep: sum(int((one.stop - one.start).sum()) for one in sweep))
        for i, place in _expanded(in_a.start, in_a.stop):
            yield _overlapping(a, b, i, in_a.order[place])
        for j, place in _expanded(in_b.start, in_b.stop):
            yield _overlapping(a, b, in_b.order[place], j)


class _Starts(NamedTuple):
    """Boxes in the `order` of their lower ends along an axis, and for each of other boxes the range (start, stop) of
    those that start within it."""

    order: Indices
    start: Indices
    stop: Indices


def _starts_in(others: Boxes, boxes: Boxes, axis: int, equal: Literal["left", "right"]) -> _Starts:
    """Return which boxes start within each of the others; equal starts count if `equal` is "left"."""
    order = np.argsort(boxes.low[axis], kind="stable")
    starts = boxes.low[axis][order]
    start, stop = np.searchsorted(starts, others.low[axis], equal), np.searchsorted(starts, others.high[axis], "right")
    return _Starts(order, start, stop)


def _overlapping(a: Boxes, b: Boxes, i: Indices, j: Indices) -> tuple[Indices, Indices]:
    """Return those of the pairs that overlap along all axes."""
    for axis in range(3):
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
