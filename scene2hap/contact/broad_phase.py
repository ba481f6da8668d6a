"""Broad phase: a neighbour list for every body, wide enough to last while bodies move a little.

Every body has a fat box: its AABB, enlarged by all that the body may touch, fall onto or hang from. Bodies whose fat
boxes overlap are neighbours. The fat box of a body that moves is drawn `SKIN_M` wider, and drawn again only once the
body has left it (Verlet's lists). It keeps some of where the body was, so that a body that goes to and fro, or is
lifted and put down, keeps its list. A list that is too long costs time and decides nothing.

Source: L. Verlet, Computer experiments on classical fluids I, Phys. Rev. 159 (1967) 98.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from scene2hap.contact.body import Body
from scene2hap.contact.broad import Boxes, box_pairs
from scene2hap.contact.vectors import AABB, Triple

SKIN_M = 0.06
"""How far a thing may move before its neighbours are searched again (assumed: a hand's way in four or five frames)."""

# As far beyond that where it was before: as much again level, and as far as one lifts a thing to look at it (assumed).
_MEMORY_M = (SKIN_M, 0.3)

# From so many bodies at once on, sorting all is cheaper than asking for each.
_MANY = 16


class BroadPhase:
    """Bodies by id, and the neighbours of each.

    Parameters: margins_m : how far a body's fat box reaches beyond it to all sides, and how much farther down [m].
    """

    def __init__(self, up_axis: int, margins_m: Callable[[Body], tuple[float, float]]) -> None:
        self._margins_m = margins_m
        self._boxes = FatBoxes(up_axis, SKIN_M, _MEMORY_M)
        self._ids: list[str] = []
        self._rows: dict[str, int] = {}
        self._free: list[int] = []
        self.neighbours: dict[str, set[str]] = {}

    def room(self, object_id: str) -> AABB:
        """The box in which a body may move and keep its list [m]."""
        return self._boxes.room(self._rows[object_id])

    def remove(self, object_id: str) -> set[str]:
        """Remove a body. Returns its neighbours."""
        row = self._rows.pop(object_id)
        self._boxes.clear(row)
        self._free.append(row)
        neighbours = self.neighbours.pop(object_id)
        for other in neighbours:
            self.neighbours[other].discard(object_id)
        return neighbours

    def update(self, bodies: Sequence[Body]) -> dict[str, set[str]]:
        """Insert or move bodies. Returns, for each body that left its fat box, the neighbours it lost; two that lose
        each other are reported once."""
        left: dict[str, set[str]] = {}
        drawn, rows, boxes = [], self._rows, self._boxes
        for body in bodies:
            row = rows.get(body.id)
            if row is None:
                row = self._row(body.id)
            elif boxes.holds(row, body.low, body.high):
                continue
            boxes.draw(row, body.low, body.high, *self._margins_m(body))
            drawn.append(body.id)
        if not drawn:
            return left
        found = self._neighbours(drawn)
        for object_id in drawn:
            before, now = self.neighbours.get(object_id, set()), found[object_id]
            self.neighbours[object_id] = now
            for other in before - now:
                self.neighbours[other].discard(object_id)
            for other in now - before:
                self.neighbours.setdefault(other, set()).add(object_id)
            left[object_id] = before - now
        return left

    def _row(self, object_id: str) -> int:
        """A row for a new body."""
        ids = self._ids
        row = self._rows[object_id] = self._free.pop() if self._free else len(ids)
        ids[row : row + 1] = [object_id]
        return row

    def _neighbours(self, ids: Sequence[str]) -> dict[str, set[str]]:
        if len(ids) < _MANY:
            return {x: self._meeting(x) for x in ids}
        found: dict[str, set[str]] = {x: set() for x in ids}
        rows, every = np.array([self._rows[x] for x in ids]), np.array(list(self._rows.values()))
        boxes = Boxes(self._boxes.low, self._boxes.high)
        for i, j in box_pairs(boxes.some(rows), boxes.some(every)):
            for x, y in zip(rows[i].tolist(), every[j].tolist(), strict=True):
                if x != y:
                    found[self._ids[x]].add(self._ids[y])
        return found

    def _meeting(self, object_id: str) -> set[str]:
        ids = self._ids
        return {ids[row] for row in self._boxes.meeting(self._rows[object_id])}


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
