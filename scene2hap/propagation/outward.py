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


_NEVER: tuple[int, dict[str, Junction], list[Exit]] = (-1, {}, [])
_NEVER_TO_ENDS: tuple[int, list[Exit], int, list[Exit]] = (-1, [], -1, [])


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
        self._known: dict[str, dict[str, tuple[Junction, list[Door]]]] = {}
        self._balls: dict[str, tuple[list[Junction], Triple, float]] = {}
        self._version = -1
        # The version of the graph in which they were last looked at, and what they were made of.
        self._exits: dict[str, tuple[int, dict[str, Junction], list[Exit]]] = {}
        self._exits_to_ends: dict[str, tuple[int, list[Exit], int, list[Exit]]] = {}

    def has(self, object_id: str) -> bool:
        """Whether an object touches any."""
        return bool(self._beside.get(object_id))

    def look_again(self) -> None:
        """Take in what has changed; to be called before a walk."""
        self._version = self._graph.version

    def exits(self, object_id: str) -> list[Exit]:
        """The ways out of an object; the same list as long as nothing about them has changed."""
        version, last, found = self._exits.get(object_id, _NEVER)
        if version == self._version:
            return found
        now = self._beside.get(object_id, {})
        if last != now or version < 0:
            price, doors = self.price_per_m, self._doors_of(object_id)
            last, found = dict(now), [Exit(x, price.get(x, 0.0), several) for x, (_, several) in doors.items()]
        self._exits[object_id] = (self._version, last, found)
        return found

    def exits_to_ends(self, object_id: str) -> list[Exit]:
        """The same without those that lead to no end, nor back more cheaply: into a cup that stands on this alone."""
        version, last, then, found = self._exits_to_ends.get(object_id, _NEVER_TO_ENDS)
        if version == self._version:
            return found
        every, topology = self.exits(object_id), self._graph.topology
        if last is not every or then != topology:
            price, price_here, beside = self.price_per_m, self.price_per_m.get(object_id, 0.0), self._beside
            found = [
                x
                for x in every
                if x.into in self._ends
                or (x.into in price and (len(beside[x.into]) > 1 or (x.price < price_here and len(x.doors) > 1)))
            ]
        self._exits_to_ends[object_id] = (self._version, every, topology, found)
        return found

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

    def _doors_of(self, object_id: str) -> dict[str, tuple[Junction, list[Door]]]:
        """The doors out of an object into each other, with the junctions that they are of; kept as long as these."""
        before, now = self._known.get(object_id, {}), {}
        for other, junction in self._beside.get(object_id, {}).items():
            last = before.get(other)
            if last is None or last[0] is not junction:
                points = zip(junction.points_m, junction.weights, strict=True)
                last = junction, [Door(object_id, other, place, self._crossing[weight]) for place, weight in points]
            now[other] = last
        self._known[object_id] = now
        return now


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
