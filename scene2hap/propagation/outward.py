"""The cheapest ways outward from a touch or a source, over a contact graph as it is.

A way costs the same in both directions. Where a contact moves in every frame it is enough to walk outward from the few
points that are touched until all sources are met (Dijkstra), instead of searching a whole scene from each source
(`paths`). Where nothing farther than a limit matters, no walk goes beyond it; and none goes on from where even a
straight way through the cheapest of all objects would come to a source too late: the feet of a cup are a short cut over
a dear table, but to few places.

Source of the latter: P. E. Hart, N. J. Nilsson, B. Raphael, IEEE Trans. Systems Science and Cybernetics 4 (1968) 100.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from scene2hap.propagation.entries import Entries, Triple
from scene2hap.propagation.walk import Door, Ends, Exit, walked

if TYPE_CHECKING:
    from scene2hap.contact.graph import ContactGraph
    from scene2hap.contact.junction import Junction


class Doors:
    """The doors of a contact graph as it is, kept as long as their junctions: a step of a walk asks for a few dozen.

    Parameters: price_per_m, crossing : as in `LivePaths`; ends : objects to which ways are looked for.
    """

    def __init__(
        self,
        graph: ContactGraph,
        price_per_m: Mapping[str, float],
        crossing: Mapping[float, float],
        ends: Collection[str],
    ) -> None:
        self._graph, self._beside = graph, graph.beside
        self._crossing, self._ends = crossing, ends
        self.price_per_m = price_per_m
        self.least_price_per_m = min(price_per_m.values(), default=0.0)
        self._balls: dict[str, tuple[list[Junction], Triple, float]] = {}
        self._version = -1
        # Neighbours of the objects that a walk came to so far, as of that version; below, those that may lead to ends.
        self._exits: dict[str, dict[str, Exit]] = {}
        self._exits_to_ends: dict[str, dict[str, Exit]] = {}

    def has(self, object_id: str) -> bool:
        """Whether an object touches any."""
        return bool(self._beside.get(object_id))

    def look_again(self) -> None:
        """Take in the pairs that changed since the last walk; to be called before a walk."""
        if self._version == self._graph.version:
            return
        changed = self._graph.changed_since(self._version)
        self._version = self._graph.version
        if changed is None:
            self._exits.clear()
            self._exits_to_ends.clear()
            return
        for a, b in changed:
            self._renew(a, b)
            self._renew(b, a)
        for pair in changed:
            for x in pair:
                # Whether an object leads on depends on whether it has one neighbour or more.
                around = self._beside.get(x, {})
                if len(around) <= 2:
                    for y in around:
                        self._judge(y, x)

    def exits(self, object_id: str) -> Collection[Exit]:
        """The neighbours of an object, with the doors into each."""
        found = self._exits.get(object_id)
        if found is None:
            around = self._beside.get(object_id, {})
            found = self._exits[object_id] = {x: self._exit(object_id, x, junction) for x, junction in around.items()}
        return found.values()

    def exits_to_ends(self, object_id: str) -> Collection[Exit]:
        """The same without those that lead to no end, nor back more cheaply: into a cup that stands on this alone."""
        found = self._exits_to_ends.get(object_id)
        if found is None:
            found = {x.into: x for x in self.exits(object_id) if self._leads_on(object_id, x)}
            self._exits_to_ends[object_id] = found
        return found.values()

    def _renew(self, object_id: str, other: str) -> None:
        """Take in how two touch now, seen from one of them."""
        exits, around = self._exits.get(object_id), self._beside.get(object_id)
        if exits is None:
            return
        if not around:
            # It may have left the scene for good.
            del self._exits[object_id]
            self._exits_to_ends.pop(object_id, None)
            return
        junction = around.get(other)
        if junction is None:
            exits.pop(other, None)
        else:
            exits[other] = self._exit(object_id, other, junction)
        self._judge(object_id, other)

    def _judge(self, object_id: str, other: str) -> None:
        """Take in whether a neighbour may lead to an end."""
        to_ends, exits = self._exits_to_ends.get(object_id), self._exits.get(object_id)
        if to_ends is None or exits is None:
            return
        found = exits.get(other)
        if found is not None and self._leads_on(object_id, found):
            to_ends[other] = found
        else:
            to_ends.pop(other, None)

    def _leads_on(self, object_id: str, x: Exit) -> bool:
        if x.into in self._ends:
            return True
        if x.into not in self.price_per_m:
            return False
        is_cheaper = x.price < self.price_per_m.get(object_id, 0.0)
        return len(self._beside[x.into]) > 1 or (is_cheaper and len(x.doors) > 1)

    def _exit(self, object_id: str, other: str, junction: Junction) -> Exit:
        points = zip(junction.points_m, junction.weights, strict=True)
        doors = [Door(object_id, other, place, self._crossing[weight]) for place, weight in points]
        return Exit(other, self.price_per_m.get(other, 0.0), doors)

    def ball(self, object_id: str) -> tuple[Triple, float]:
        """A ball around all doors of an object that touches others: its middle, and its radius [m]."""
        junctions = list(self._beside[object_id].values())
        known = self._balls.get(object_id)
        if known is None or known[0] != junctions:
            places = [place for junction in junctions for place in junction.points_m]
            x, y, z = (sum(axis) / len(places) for axis in zip(*places, strict=True))
            radius_m = max([math.dist((x, y, z), place) for place in places])
            known = self._balls[object_id] = (junctions, (x, y, z), radius_m)
        return known[1:]


def cheapest_outward(
    object_id: str,
    point_m: Triple,
    doors: Doors,
    row: Mapping[str, int],
    limits: Sequence[float] | None = None,
    among: Collection[int] | None = None,
) -> list[float]:
    """Price of the cheapest way from each source to a point of an object, inf for none up to its limit.

    Parameters: row : where in the answer each source stands, which are the `ends` of the doors; limits : for each of
    these, None for none; among : the rows of those that may arrive, None for all.
    """
    doors.look_again()
    found = [math.inf] * len(row)
    at_most = {
        x: math.inf if limits is None else limits[k]
        for x, k in row.items()
        if (among is None or k in among) and (x == object_id or doors.has(x))
    }
    ends = Ends(at_most, {x: doors.ball(x) for x in at_most if doors.has(x)}, doors.least_price_per_m)
    limit = max(at_most.values(), default=0.0)
    starts = [(0.0, Door("", object_id, point_m, 0.0))]
    met: set[str] = set()
    for cost, here, _ in walked(starts, doors.exits_to_ends, doors.price_per_m, limit, ends):
        if here in row and here not in met:
            met.add(here)
            found[row[here]] = cost
    return found


def entries_around(source_id: str, doors: Doors, limit: float) -> dict[str, Entries]:
    """Where all objects are entered from a source, up to a limit, without what leads nowhere new; else as above."""
    doors.look_again()
    starts = [(door.crossing, door) for out in doors.exits(source_id) for door in out.doors]
    entries: dict[str, Entries] = {}
    for cost, here, place in walked(starts, doors.exits, doors.price_per_m, limit):
        entries.setdefault(here, []).append((place, cost))
    return entries
