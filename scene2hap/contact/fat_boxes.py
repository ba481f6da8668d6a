"""Enlarged AABBs as columns of arrays, with an overlap query."""

from __future__ import annotations

import numpy as np

from scene2hap.contact.vectors import Triple

AABB = tuple[Triple, Triple]
"""Lowest and highest corners [m] of a box around a body, which it has not left."""


class FatBoxes:
    """For each row a room, and around that a fat box: `low` and `high`, both (3, n) [m].

    Parameters: skin_m : how much too wide the room of what has moved is drawn; memory_m : by how much more it may go on
    to hold where the thing was before, level and upwards or downwards.
    """

    def __init__(self, up_axis: int, skin_m: float, memory_m: tuple[float, float]) -> None:
        self._up_axis, self._skin_m, self._memory_m = up_axis, skin_m, memory_m
        self._rooms: list[AABB | None] = [None] * 64
        self.low, self.high = np.full((3, 64), np.inf), np.full((3, 64), -np.inf)

    def draw(self, row: int, low: Triple, high: Triple, side_m: float, down_m: float) -> None:
        """Draw the room of a row around a box, which fits it at first and is too wide from then on; the fat box reaches
        so far beyond it, and so much farther down. A new row follows the last."""
        if row == len(self._rooms):
            self._rooms += [None] * row
            self.low = np.concatenate([self.low, np.full((3, row), np.inf)], axis=1)
            self.high = np.concatenate([self.high, np.full((3, row), -np.inf)], axis=1)
        before = self._rooms[row]
        if before is not None:
            low, high = self._wider(low, high, before)
        self._rooms[row] = (low, high)
        self.low[:, row] = [x - side_m for x in low]
        self.high[:, row] = [x + side_m for x in high]
        self.low[self._up_axis, row] -= down_m

    def _wider(self, low: Triple, high: Triple, before: AABB) -> AABB:
        lows, highs = [0.0] * 3, [0.0] * 3
        for k in range(3):
            near = self._skin_m
            far = near + self._memory_m[k == self._up_axis]
            lows[k] = max(min(low[k] - near, before[0][k]), low[k] - far)
            highs[k] = min(max(high[k] + near, before[1][k]), high[k] + far)
        return (lows[0], lows[1], lows[2]), (highs[0], highs[1], highs[2])

    def clear(self, row: int) -> None:
        """Have nothing in a row."""
        self._rooms[row] = None
        self.low[:, row], self.high[:, row] = np.inf, -np.inf

    def room(self, row: int) -> AABB:
        """The room of a row that has one."""
        room = self._rooms[row]
        assert room is not None
        return room

    def holds(self, row: int, low: Triple, high: Triple) -> bool:
        """Whether a box is within the room of a row."""
        lowest, highest = self.room(row)
        return all(a >= b for a, b in zip(low, lowest, strict=True)) and all(
            a <= b for a, b in zip(high, highest, strict=True)
        )

    def meeting(self, row: int) -> list[int]:
        """The other rows whose fat boxes meet that of a row, touching included."""
        x, y, z = (self.low <= self.high[:, row, None]) & (self.high >= self.low[:, row, None])
        found: list[int] = np.flatnonzero(x & y & z).tolist()
        if row in found:
            found.remove(row)
        return found
