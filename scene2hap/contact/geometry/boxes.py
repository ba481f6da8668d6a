"""Axis-aligned boxes, and which overlap."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats, Indices
from scene2hap.contact.geometry.vectors import highest, lowest

_ROWS = 64  # Boxes that are compared at once with all near them; neighbours in a mesh mostly are neighbours in space.
_CHUNK = 1 << 13  # Most pairs in a chunk; of triangles: some 20 MB.


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
    if not a.low.size or not b.low.size:
        return
    rows = a.meeting(b.hull())
    for first in range(0, len(rows), _ROWS):
        some = rows[first : first + _ROWS]
        one = a.some(some)
        columns = b.meeting(one.hull())
        other = b.some(columns)
        x, y, z = (one.low[..., None] <= other.high[:, None]) & (one.high[..., None] >= other.low[:, None])
        i, j = np.nonzero(x & y & z)
        for k in range(0, len(i), _CHUNK):
            yield some[i[k : k + _CHUNK]], columns[j[k : k + _CHUNK]]
