"""The cheapest ways over a contact graph that changes while one asks.

`cheapest_arrivals` searches a whole scene; a frame of a game asks for two touches, and moves a few contacts. Over at
most two contacts a way is source, at most one object between, touched object, so that what arrives is put together from
the few junctions on it when asked for; what a junction that did not move contributes is kept from frame to frame.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.graph import ContactGraph
from scene2hap.contact.junction import Junction
from scene2hap.contact.profile import Triple
from scene2hap.propagation.paths import Arrivals, cheapest_arrivals

_Entries = list[tuple[Triple, float]]
_Gathered = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.intp], list[int]]


class _Way:
    """A way from a source (row) into an object: by its first junction `out[via]`, and, if `via` is another object, by
    its second `into[via]`; and its entries as they were told for these, each where it comes in and at what cost."""

    __slots__ = ("entries", "first", "into", "out", "row", "second", "via")

    def __init__(self, row: int, via: str, out: Mapping[str, Junction], into: Mapping[str, Junction]) -> None:
        self.row, self.via, self.out, self.into = row, via, out, into
        self.first: Junction | None = None
        self.second: Junction | None = None
        self.entries: _Entries = []


class LivePaths:
    """What the cheapest way from each source to a touch costs, over a graph as it is now.

    Parameters: graph : read whenever asked, never copied; price_per_m : what a metre through an object costs, >= 0, no
    entry where it carries nothing on; crossing_cost : what a contact of some weight costs; max_hops : contacts that a
    way may cross, None for any number. Ways of more than two contacts are searched anew for the whole scene whenever a
    contact changed.
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
        self._crossing_cost = lru_cache(maxsize=1024)(crossing_cost)
        self._source_ids = tuple(source_ids)
        self._max_hops = max_hops
        self._plans: dict[str, tuple[int, list[_Way]]] = {}
        self._gathered: dict[str, tuple[int, _Gathered | None]] = {}
        self._arrivals: tuple[int, dict[str, Arrivals]] = (-1, {})

    def costs(self, object_id: str, point_m: Triple) -> list[float]:
        """Price of the cheapest way from each source to a point of an object: 0 on the source itself, inf for none."""
        if object_id not in self._price_per_m or object_id not in self._beside:
            return [0.0 if source_id == object_id else math.inf for source_id in self._source_ids]
        # A few dozen entries: plain numbers are faster than numpy's calls.
        if self._max_hops not in (1, 2):
            return self._by_array(object_id, point_m, self._graph.version)
        price, dist = self._price_per_m[object_id], math.dist
        found = [math.inf] * len(self._source_ids)
        for way in self._plan(object_id):
            # A junction that moved is another object: what follows from it is told anew.
            if way.first is not way.out[way.via] or (way.second is not None and way.second is not way.into[way.via]):
                self._tell(way, object_id)
            least = min([cost + price * dist(place, point_m) for place, cost in way.entries])
            if least < found[way.row]:
                found[way.row] = least
        if object_id in self._source_ids:
            found[self._source_ids.index(object_id)] = 0.0
        return found

    def _by_array(self, object_id: str, point_m: Triple, version: int) -> list[float]:
        at, gathered = self._gathered.get(object_id, (-1, None))
        if at != version:
            gathered = self._gather(object_id, version)
            self._gathered[object_id] = (version, gathered)
        found = [math.inf] * len(self._source_ids)
        if gathered is not None:
            points, costs, starts, rows = gathered
            apart = points - point_m
            lengths = np.sqrt(np.einsum("ij,ij->i", apart, apart))
            lengths *= self._price_per_m[object_id]
            lengths += costs
            for row, least in zip(rows, np.minimum.reduceat(lengths, starts).tolist(), strict=True):
                found[row] = least
        if object_id in self._source_ids:
            found[self._source_ids.index(object_id)] = 0.0
        return found

    def _gather(self, object_id: str, version: int) -> _Gathered | None:
        """All ways to an object as one list: where they come in (n, 3), what they cost up to there (n,), where each
        source's begin, and which sources these are."""
        points: list[Triple] = []
        costs: list[float] = []
        starts, rows = [], []
        for row, source_id in enumerate(self._source_ids):
            if source_id != object_id:
                entries = [entry for entry in self._searched(row, object_id, version) if entry[1] < math.inf]
            else:
                entries = []
            if entries:
                starts.append(len(points))
                rows.append(row)
                points += [place for place, _ in entries]
                costs += [cost for _, cost in entries]
        return (np.array(points), np.array(costs), np.array(starts), rows) if rows else None

    def _searched(self, row: int, object_id: str, version: int) -> _Entries:
        if self._arrivals[0] != version:
            contacts = self._graph.contacts
            crossing = [self._crossing_cost(contact.weight) for contact in contacts]
            found = cheapest_arrivals(self._price_per_m, contacts, crossing, self._source_ids, self._max_hops)
            self._arrivals = (version, found)
        arrived = self._arrivals[1].get(object_id)
        if arrived is None:
            return []
        points = [(x, y, z) for x, y, z in arrived.points_m.tolist()]
        return list(zip(points, arrived.costs[row].tolist(), strict=True))

    def _plan(self, object_id: str) -> list[_Way]:
        """All ways of at most two contacts into an object; other ones only once a contact has come or gone."""
        topology = self._graph.topology
        known = self._plans.get(object_id)
        if known is not None and known[0] == topology:
            return known[1]
        into = self._beside.get(object_id, {})
        plan = []
        for row, source_id in enumerate(self._source_ids):
            out = self._beside.get(source_id)
            if not out or source_id == object_id:
                continue
            if object_id in out:
                plan.append(_Way(row, object_id, out, into))
            if self._max_hops == 2:
                fewer, more = (out, into) if len(out) <= len(into) else (into, out)
                plan += [_Way(row, via, out, into) for via in fewer if via in more and via in self._price_per_m]
        self._plans[object_id] = (topology, plan)
        return plan

    def _tell(self, way: _Way, object_id: str) -> None:
        """Tell the entries of a way over its junctions as they are now."""
        first = way.out[way.via]
        second = None if way.via == object_id else way.into[way.via]
        crossing = self._crossing_cost
        entries = [(place, crossing(weight)) for place, weight in zip(first.points_m, first.weights, strict=True)]
        if second is not None:
            price, dist = self._price_per_m[way.via], math.dist
            entries = [
                (there, crossing(weight) + min([cost + price * dist(here, there) for here, cost in entries]))
                for there, weight in zip(second.points_m, second.weights, strict=True)
            ]
        way.first, way.second, way.entries = first, second, entries
