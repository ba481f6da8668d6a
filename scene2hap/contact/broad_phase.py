"""Broad phase: a neighbour list for every body, which stays valid while bodies move a little.

Every body has an inner box around its AABB, and a fat box: the inner box, enlarged by the distances at which the body
can touch, fall onto or hang from others. Bodies whose fat boxes overlap are neighbours. The inner box of a moving body
is `SKIN_M` wider than its AABB. Both boxes are computed again only when the AABB leaves the inner box (Verlet lists).
The new boxes also cover part of the old ones. So a body that moves back and forth, or is lifted and put down, keeps its
list. Too long a list costs time but changes no result.

Source: L. Verlet, Computer experiments on classical fluids I, Phys. Rev. 159 (1967) 98.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from scene2hap.contact.body import Body
from scene2hap.contact.geometry.broad import Boxes, box_pairs
from scene2hap.contact.geometry.vectors import AABB, Triple

SKIN_M = 0.06
"""Distance an object may move before its neighbours are searched again (assumed: a hand's path in four or five frames).
"""

# How much of the old box a new one keeps beyond its skin: level, and vertically (assumed: how high objects are lifted
# to look at them).
_MEMORY_M = (SKIN_M, 0.3)

# From this many bodies on, one sort is cheaper than one query for each body.
_MANY = 16


class BroadPhase:
    """The fat boxes of all bodies, and `neighbours`: the ids of each body's neighbours, by id.

    Parameters: margins_m : returns how far a body's fat box extends beyond its inner box on all sides, and how much
    farther down [m].
    """

    def __init__(self, up_axis: int, margins_m: Callable[[Body], tuple[float, float]]) -> None:
        self._margins_m = margins_m
        self._boxes = FatBoxes(up_axis, SKIN_M, _MEMORY_M)
        self._ids: list[str] = []
        self._rows: dict[str, int] = {}
        self._free: list[int] = []
        self.neighbours: dict[str, set[str]] = {}

    def inner_box(self, object_id: str) -> AABB:
        """Return the box in which a body may move without a new neighbour list [m]."""
        return self._boxes.inner_box(self._rows[object_id])

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
        """Insert or move bodies. Returns, for each body that left its inner box, the neighbours it lost.

        If two moved bodies lose each other, only one of them reports it.
        """
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
        """Reserve a row for a new body."""
        ids = self._ids
        row = self._rows[object_id] = self._free.pop() if self._free else len(ids)
        ids[row : row + 1] = [object_id]
        return row

    def _neighbours(self, ids: Sequence[str]) -> dict[str, set[str]]:
        """Return the neighbours of bodies, by id."""
        if len(ids) < _MANY:
            return {x: self._overlapping(x) for x in ids}
        found: dict[str, set[str]] = {x: set() for x in ids}
        rows, every = np.array([self._rows[x] for x in ids]), np.array(list(self._rows.values()))
        boxes = Boxes(self._boxes.low, self._boxes.high)
        for i, j in box_pairs(boxes.some(rows), boxes.some(every)):
            for x, y in zip(rows[i].tolist(), every[j].tolist(), strict=True):
                if x != y:
                    found[self._ids[x]].add(self._ids[y])
        return found

    def _overlapping(self, object_id: str) -> set[str]:
        ids = self._ids
        return {ids[row] for row in self._boxes.meeting(self._rows[object_id])}


class FatBoxes:
    """Fat boxes in columns of `low` and `high`, both (3, n) [m], and the inner box of each.

    Parameters: skin_m : margin of a moved body's inner box around its AABB [m]; memory_m : how much of the old inner
    box a new one may keep beyond that margin, level and vertically [m].
    """

    def __init__(self, up_axis: int, skin_m: float, memory_m: tuple[float, float]) -> None:
        self._up_axis, self._skin_m, self._memory_m = up_axis, skin_m, memory_m
        self._inner_boxes: list[AABB | None] = [None] * 64
        self.low, self.high = np.full((3, 64), np.inf), np.full((3, 64), -np.inf)

    def draw(self, row: int, low: Triple, high: Triple, side_m: float, down_m: float) -> None:
        """Compute inner box and fat box of a row from an AABB; the latter extends `side_m` farther, down `down_m` more.

        The first inner box of a row has no margin. A new row follows the last.
        """
        if row == len(self._inner_boxes):
            self._inner_boxes += [None] * row
            self.low = np.concatenate([self.low, np.full((3, row), np.inf)], axis=1)
            self.high = np.concatenate([self.high, np.full((3, row), -np.inf)], axis=1)
        before = self._inner_boxes[row]
        if before is not None:
            low, high = self._wider(low, high, before)
        self._inner_boxes[row] = (low, high)
        self.low[:, row] = [x - side_m for x in low]
        self.high[:, row] = [x + side_m for x in high]
        self.low[self._up_axis, row] -= down_m

    def _wider(self, low: Triple, high: Triple, before: AABB) -> AABB:
        """Return a box with the skin as margin, extended into the old box as far as `memory_m` allows."""
        lows, highs = [0.0] * 3, [0.0] * 3
        for k in range(3):
            near = self._skin_m
            far = near + self._memory_m[k == self._up_axis]
            lows[k] = max(min(low[k] - near, before[0][k]), low[k] - far)
            highs[k] = min(max(high[k] + near, before[1][k]), high[k] + far)
        return (lows[0], lows[1], lows[2]), (highs[0], highs[1], highs[2])

    def clear(self, row: int) -> None:
        """Empty a row, so that it overlaps nothing."""
        self._inner_boxes[row] = None
        self.low[:, row], self.high[:, row] = np.inf, -np.inf

    def inner_box(self, row: int) -> AABB:
        """Return the inner box of a row that is in use."""
        found = self._inner_boxes[row]
        assert found is not None
        return found

    def holds(self, row: int, low: Triple, high: Triple) -> bool:
        """Return True if a box is within the inner box of a row."""
        (a, b, c), (d, e, f) = self.inner_box(row)
        return low[0] >= a and low[1] >= b and low[2] >= c and high[0] <= d and high[1] <= e and high[2] <= f

    def meeting(self, row: int) -> list[int]:
        """Return the other rows whose fat boxes overlap that of a row, touching included."""
        x, y, z = (self.low <= self.high[:, row, None]) & (self.high >= self.low[:, row, None])
        found: list[int] = np.flatnonzero(x & y & z).tolist()
        if row in found:
            found.remove(row)
        return found
