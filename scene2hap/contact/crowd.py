"""Who may matter to whom: a list of neighbours for every body, wide enough to last while things move a little.

Every body has a zone, all that it may touch, fall onto or hang from; two whose zones meet are neighbours. The zone of
what moves is drawn `SKIN_M` too wide, and drawn anew only when it has left it (Verlet's lists); then some of where it
came from is kept, so that what goes to and fro, or is lifted and put down again, does not leave it over and over. Who
stands on such a list too much does no harm: the list saves looking and decides nothing.

Source: L. Verlet, Computer experiments on classical fluids I, Phys. Rev. 159 (1967) 98.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from scene2hap.contact.body import Body
from scene2hap.contact.broad import Boxes, box_pairs
from scene2hap.contact.zones import Room, Zones

SKIN_M = 0.06
"""How far a thing may move before its neighbours are looked for anew (assumed: a hand's way in four or five frames)."""

# As far beyond that where it was before: as much again level, and as far as one lifts a thing to look at it (assumed).
_MEMORY_M = (SKIN_M, 0.3)

# From so many bodies at once on, sorting all is cheaper than asking for each.
_MANY = 16


class Crowd:
    """The bodies' zones as columns of numbers.

    Parameters: margins_m : how far a body's zone reaches beyond it to all sides, and how much farther down [m].
    """

    def __init__(self, up_axis: int, margins_m: Callable[[Body], tuple[float, float]]) -> None:
        self._margins_m = margins_m
        self._zones = Zones(up_axis, SKIN_M, _MEMORY_M)
        self._ids: list[str] = []
        self._rows: dict[str, int] = {}
        self._free: list[int] = []
        self.near: dict[str, set[str]] = {}

    def room(self, object_id: str) -> Room:
        """Where a body may move without another list."""
        return self._zones.room(self._rows[object_id])

    def take_out(self, object_id: str) -> set[str]:
        """Forget a body; who were its neighbours."""
        row = self._rows.pop(object_id)
        self._zones.clear(row)
        self._free.append(row)
        neighbours = self.near.pop(object_id)
        for other in neighbours:
            self.near[other].discard(object_id)
        return neighbours

    def put(self, bodies: Sequence[Body]) -> dict[str, set[str]]:
        """Place bodies, new ones or ones that moved; by id of those that left their zone, who has ceased to be a
        neighbour; two that left each other at once are told once."""
        left: dict[str, set[str]] = {}
        drawn, rows, zones = [], self._rows, self._zones
        for body in bodies:
            row = rows.get(body.id)
            if row is None:
                row = self._row(body.id)
            elif zones.holds(row, body.low, body.high):
                continue
            zones.draw(row, body.low, body.high, *self._margins_m(body))
            drawn.append(body.id)
        if not drawn:
            return left
        found = self._neighbours(drawn)
        for object_id in drawn:
            before, now = self.near.get(object_id, set()), found[object_id]
            self.near[object_id] = now
            for other in before - now:
                self.near[other].discard(object_id)
            for other in now - before:
                self.near.setdefault(other, set()).add(object_id)
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
        boxes = Boxes(self._zones.low, self._zones.high)
        for i, j in box_pairs(boxes.some(rows), boxes.some(every)):
            for x, y in zip(rows[i].tolist(), every[j].tolist(), strict=True):
                if x != y:
                    found[self._ids[x]].add(self._ids[y])
        return found

    def _meeting(self, object_id: str) -> set[str]:
        ids = self._ids
        return {ids[row] for row in self._zones.meeting(self._rows[object_id])}
