"""The cheapest ways over a contact graph that changes while one asks.

`cheapest_arrivals` searches a whole scene; a frame of a game asks for two touches, and moves a few contacts. Over at
most two contacts a way is source, at most one object between, touched object, so that what arrives is put together from
the few junctions on it when asked for; what a junction that did not move contributes is kept from frame to frame. Over
more contacts one searches outward from the touch while things move, and once for all touches when they have come to
rest: from one source at a question, as far as anything matters, so that no question waits for the others.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from scene2hap.propagation.entries import Entries, Triple, is_within, least_cost
from scene2hap.propagation.outward import Doors, cheapest_outward, entries_around
from scene2hap.propagation.paths import Arrivals, cheapest_over
from scene2hap.propagation.short_way import WaysInto

if TYPE_CHECKING:
    from scene2hap.contact.graph import ContactGraph

_MOST_WEIGHTS = 1024
_MOVING = 8  # As long as no more is asked between two changes of a contact, things move, and a search would not last.
_SELDOM = 20  # From here on one search of the whole scene is cheaper than one outward from each touch.


class _Crossing(dict[float, float]):
    """What a contact of each weight costs, worked out when it is first met."""

    def __init__(self, cost: Callable[[float], float]) -> None:
        self._cost = cost

    def __missing__(self, weight: float) -> float:
        if len(self) >= _MOST_WEIGHTS:
            self.clear()
        found = self[weight] = self._cost(weight)
        return found


class LivePaths:
    """What the cheapest way from each source to a touch costs, over a graph as it is now.

    Parameters: graph : read whenever asked, never copied; price_per_m : what a metre through an object costs, >= 0, no
    entry where it carries nothing on; crossing_cost : what a contact of some weight costs; max_hops : contacts that a
    way may cross, None for any number.
    """

    def __init__(
        self,
        graph: ContactGraph,
        price_per_m: Mapping[str, float],
        crossing_cost: Callable[[float], float],
        source_ids: Sequence[str],
        max_hops: int | None,
    ) -> None:
        self._graph = graph
        self._beside = graph.beside
        self._price_per_m = price_per_m
        self._crossing = _Crossing(crossing_cost)
        self._source_ids = tuple(source_ids)
        self._row = {source_id: row for row, source_id in enumerate(source_ids)}
        self._doors = Doors(graph, price_per_m, self._crossing, self._row)
        self._max_hops = max_hops
        # What leads into each object over at most two contacts, and in what topology of the graph.
        self._ways: dict[str, tuple[int, WaysInto]] = {}
        self._entries: dict[str, tuple[int, list[tuple[int, Entries]]]] = {}
        self._arrivals: tuple[int, dict[str, Arrivals]] = (-1, {})
        self._asked_of, self._n_asked = -1, 0
        # What comes into objects from the first `_n_around` sources up to some limits, in what version of the graph.
        self._around_of: tuple[int, Sequence[float]] = (-1, ())
        self._around: dict[str, list[tuple[int, Entries]]] = {}
        self._n_around = 0

    def costs(self, object_id: str, point_m: Triple, limits: Sequence[float] | None = None) -> list[float]:
        """Price of the cheapest way from each source to a point of an object: 0 on the source itself, inf for none.

        Parameters: limits : for each source, a price above which it may as well be inf.
        """
        return self.least_costs([(object_id, point_m)], limits)

    def least_costs(
        self,
        touched: Iterable[tuple[str, Triple]],
        limits: Sequence[float] | None = None,
        among: Collection[int] | None = None,
    ) -> list[float]:
        """The same for the nearest of several points, each with its object; inf for no point.

        Parameters: among : the rows of the sources that hang together with any of the points, None if that is not
        known; no other is looked for.
        """
        found = [math.inf] * len(self._source_ids)
        for object_id, point_m in touched:
            if object_id in self._price_per_m and object_id in self._beside:
                self._lower(found, object_id, point_m, limits, among)
            if object_id in self._row:
                found[self._row[object_id]] = 0.0
        return found

    def _lower(
        self,
        found: list[float],
        object_id: str,
        point_m: Triple,
        limits: Sequence[float] | None,
        among: Collection[int] | None,
    ) -> None:
        """Take in what is cheaper from another point."""
        if self._max_hops in (1, 2):
            self._ways_into(object_id).lower(found, point_m, limits)
        elif self._max_hops is None and self._is_outward_quicker(limits):
            outward = cheapest_outward(object_id, point_m, self._doors, self._row, limits, among)
            found[:] = [min(pair) for pair in zip(found, outward, strict=True)]
        else:
            is_all = limits is None or self._max_hops is not None
            ways = self._searched(object_id) if is_all else self._around.get(object_id, ())
            price = self._price_per_m[object_id]
            for row, entries in ways:  # the cheapest first
                if entries[0][1] < found[row]:
                    found[row] = min(found[row], least_cost(entries, price, point_m))

    def _is_outward_quicker(self, limits: Sequence[float] | None) -> bool:
        """Whether too little was asked since a contact changed for a search from all sources to be worth it."""
        if self._asked_of != self._graph.version:
            self._asked_of, self._n_asked = self._graph.version, 0
        self._n_asked += 1
        if limits is None:
            return self._n_asked <= _SELDOM
        return self._n_asked <= _MOVING or not self._are_all_around(limits)

    def _are_all_around(self, limits: Sequence[float]) -> bool:
        """Search around one more source; true once all of them are done."""
        version, known = self._around_of
        if version != self._graph.version or (known is not limits and list(known) != list(limits)):
            self._around_of, self._around, self._n_around = (self._graph.version, limits), {}, 0
        row = self._n_around
        if row == len(self._source_ids):
            return True
        found = entries_around(self._source_ids[row], self._doors, limits[row])
        for object_id, entries in found.items():
            self._around.setdefault(object_id, []).append((row, entries))
        self._n_around = row + 1
        return False

    def _searched(self, object_id: str) -> list[tuple[int, Entries]]:
        """Ways over any number of contacts: for each source that comes, where it comes in."""
        version = self._graph.version
        at, known = self._entries.get(object_id, (-1, []))
        if at != version:
            arrived = self._arrivals_at(version).get(object_id)
            known = [] if arrived is None else self._gather(object_id, arrived)
            self._entries[object_id] = (version, known)
        return known

    def _gather(self, object_id: str, arrived: Arrivals) -> list[tuple[int, Entries]]:
        places = [(x, y, z) for x, y, z in arrived.points_m.tolist()]
        price, found = self._price_per_m[object_id], []
        for row, costs in enumerate(arrived.costs.tolist()):
            entries = [(place, cost) for place, cost in zip(places, costs, strict=True) if cost < math.inf]
            if entries:
                found.append((row, _worth_entering(entries, price)))
        return found

    def _arrivals_at(self, version: int) -> dict[str, Arrivals]:
        if self._arrivals[0] != version:
            junctions = sorted(self._graph.junctions.items())
            pairs = [pair for pair, junction in junctions for _ in junction.points_m]
            points = [place for _, junction in junctions for place in junction.points_m]
            crossing = [self._crossing[weight] for _, junction in junctions for weight in junction.weights]
            found = cheapest_over(self._price_per_m, pairs, points, crossing, self._source_ids, self._max_hops)
            self._arrivals = (version, found)
        return self._arrivals[1]

    def _ways_into(self, object_id: str) -> WaysInto:
        """All ways of at most two contacts into an object, as they are now."""
        topology = self._graph.topology
        then, ways = self._ways.get(object_id, (topology, None))
        if ways is None:
            beside, price_per_m, is_through = self._beside, self._price_per_m, self._max_hops == 2
            ways = WaysInto(object_id, self._row, beside, price_per_m, self._crossing, is_through=is_through)
        elif then == topology:
            return ways
        else:
            ways.follow(self._graph.turned_since(then))
        self._ways[object_id] = (topology, ways)
        return ways


def _worth_entering(entries: Entries, price: float) -> Entries:
    """The entries without those that are reached more cheaply through the object from another one."""
    worthy: Entries = []
    for place, cost in sorted(entries, key=lambda entry: entry[1]):
        if not is_within(worthy, price, place, cost):
            worthy.append((place, cost))
    return worthy
