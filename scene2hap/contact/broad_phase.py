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
from scene2hap.contact.geometry.boxes import Boxes, box_pairs
from scene2hap.contact.geometry.vectors import AABB

SKIN_M = 0.06
"""Distance an object may move before its neighbours are searched again (assumed: a hand's path in four or five frames).
"""

# How much of the old box a new one keeps beyond its skin: level, and vertically (assumed: how high objects are lifted
# to look at them).
_MEMORY_M = (SKIN_M, 0.3)


class BroadPhase:
    """The fat boxes of all bodies, and `neighbours`: the ids of each body's neighbours, by id.

    Parameters: margins_m : returns how far a body's fat box extends beyond its inner box on all sides, and how much
    farther down [m].
    """

    def __init__(self, up_axis: int, margins_m: Callable[[Body], tuple[float, float]]) -> None:
        self._up_axis, self._margins_m = up_axis, margins_m
        self.neighbours: dict[str, set[str]] = {}
        self._inner_boxes: dict[str, AABB] = {}
        # Fat boxes in columns, in the order of `_ids`.
        self._fat_boxes = Boxes(np.empty((3, 0)), np.empty((3, 0)))
        self._ids: list[str] = []
        self._columns: dict[str, int] = {}

    def inner_box(self, object_id: str) -> AABB:
        """Return the box in which a body may move without a new neighbour list [m]."""
        return self._inner_boxes[object_id]

    def remove(self, object_id: str) -> set[str]:
        """Remove a body. Returns its neighbours."""
        column, last, (low, high) = self._columns.pop(object_id), self._ids.pop(), self._fat_boxes
        if last != object_id:
            self._ids[column], self._columns[last] = last, column
            low[:, column], high[:, column] = low[:, -1], high[:, -1]
        self._fat_boxes = Boxes(low[:, :-1], high[:, :-1])
        del self._inner_boxes[object_id]
        neighbours = self.neighbours.pop(object_id)
        for other in neighbours:
            self.neighbours[other].discard(object_id)
        return neighbours

    def update(self, bodies: Sequence[Body]) -> dict[str, set[str]]:
        """Insert or move bodies. Returns, for each body that left its inner box, the neighbours it lost.

        If two moved bodies lose each other, only one of them reports it.
        """
        left: dict[str, set[str]] = {}
        moved = [body for body in bodies if not self._is_in_inner_box(body)]
        if new := [body.id for body in moved if body.id not in self._columns]:
            self._add_columns(new)
        for body in moved:
            self._place(body)
        found = self._found_neighbours([body.id for body in moved])
        for object_id, now in found.items():
            before = self.neighbours.get(object_id, set())
            self.neighbours[object_id] = now
            for other in before - now:
                self.neighbours[other].discard(object_id)
            for other in now - before:
                self.neighbours.setdefault(other, set()).add(object_id)
            left[object_id] = before - now
        return left

    def _is_in_inner_box(self, body: Body) -> bool:
        box = self._inner_boxes.get(body.id)
        if box is None:
            return False
        ((a, b, c), (d, e, f)), low, high = box, body.low, body.high
        return low[0] >= a and low[1] >= b and low[2] >= c and high[0] <= d and high[1] <= e and high[2] <= f

    def _place(self, body: Body) -> None:
        """Compute the boxes of a body. The inner box of a new body has no margin."""
        before = self._inner_boxes.get(body.id)
        low, high = self._inner_boxes[body.id] = (body.low, body.high) if before is None else self._wider(body, before)
        column, (side_m, down_m) = self._columns[body.id], self._margins_m(body)
        self._fat_boxes.low[:, column] = [x - side_m for x in low]
        self._fat_boxes.high[:, column] = [x + side_m for x in high]
        self._fat_boxes.low[self._up_axis, column] -= down_m

    def _wider(self, body: Body, before: AABB) -> AABB:
        """Return a box with the skin as margin, extended into the old box as far as `_MEMORY_M` allows."""
        lows, highs = [0.0] * 3, [0.0] * 3
        for k in range(3):
            far_m = SKIN_M + _MEMORY_M[k == self._up_axis]
            lows[k] = max(min(body.low[k] - SKIN_M, before[0][k]), body.low[k] - far_m)
            highs[k] = min(max(body.high[k] + SKIN_M, before[1][k]), body.high[k] + far_m)
        return (lows[0], lows[1], lows[2]), (highs[0], highs[1], highs[2])

    def _add_columns(self, ids: Sequence[str]) -> None:
        self._columns.update(zip(ids, range(len(self._ids), len(self._ids) + len(ids)), strict=True))
        self._ids += ids
        room = np.zeros((3, len(ids)))
        self._fat_boxes = Boxes(*(np.concatenate([ends, room], axis=1) for ends in self._fat_boxes))

    def _found_neighbours(self, ids: Sequence[str]) -> dict[str, set[str]]:
        """Return the ids of the bodies whose fat boxes overlap those of some bodies, touching included."""
        found = {x: set[str]() for x in ids}
        columns = np.array([self._columns[x] for x in ids], dtype=np.intp)
        for i, j in box_pairs(self._fat_boxes.some(columns), self._fat_boxes):
            for x, y in zip(i.tolist(), j.tolist(), strict=True):
                found[ids[x]].add(self._ids[y])
        for x in ids:
            found[x].discard(x)
        return found
