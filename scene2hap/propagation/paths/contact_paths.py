"""Cheapest paths over contacts from touched points to sources (Dijkstra's algorithm, pruned).

A path runs from contact to contact: a straight line through an object has a cost per metre, and each contact costs
something to cross. A path costs the same in both directions, so one search from the touched points finds all sources.

`ContactPaths` keeps the network of contacts and updates only the pairs that changed. Four rules prune the search, and
none of them changes a result:

- A point that another entry into the same object reaches at no higher cost leads nowhere new, since a straight line
  through an object is never longer than a line through another point.
- An object that is no source, and touches only the object that the search comes from, leads nowhere.
- With one contact left only sources are entered, and with two only their neighbours.
- A path ends where even a straight line at the lowest cost per metre reaches no source at a useful cost (A*).

Source of A*: P. E. Hart, N. J. Nilsson, B. Raphael, IEEE Trans. Systems Science and Cybernetics 4 (1968) 100.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import reduce
from operator import add
from typing import TYPE_CHECKING

from scene2hap.compiled import compiled

if TYPE_CHECKING:
    from scene2hap.contact.junction import Junction, Pair

Triple = tuple[float, float, float]
_ROUNDED_UP = 1 + 1e-9
_MOST_HOPS = 2**31 - 1


class ContactEdge:
    """A contact point as an edge from one object into another; equal only to itself."""

    __slots__ = ("crossing_cost", "into", "out_of", "point_m")

    def __init__(self, out_of: str, into: str, point_m: Triple, crossing_cost: float) -> None:
        self.out_of: str = out_of
        self.into: str = into
        self.point_m: Triple = point_m
        self.crossing_cost: float = crossing_cost


class Target:
    """A source that a search has not reached at its lowest cost yet.

    at_most : the highest cost of a path that still improves the result; middle_m, radius_m : a ball around all contact
    points of the source.
    """

    __slots__ = ("at_most", "middle_m", "radius_m", "row")

    def __init__(self, row: int, at_most: float, ball: tuple[Triple, float]) -> None:
        self.row: int = row
        self.at_most: float = at_most
        self.middle_m: Triple
        self.radius_m: float
        self.middle_m, self.radius_m = ball


@compiled
class ContactPaths:
    """A network of contacts, and the cheapest paths over it.

    Parameters: cost_per_m : cost of a metre through each object, >= 0; objects without one pass nothing on; rows :
    index of each source in the results; crossing_costs : cost of crossing a contact, by its weight; max_hops : number
    of contacts that a path may cross, None for any number.
    """

    def __init__(
        self,
        cost_per_m: Mapping[str, float],
        rows: Mapping[str, int],
        crossing_costs: Mapping[float, float],
        max_hops: int | None,
    ) -> None:
        self._crossing_costs, self._max_hops = crossing_costs, max_hops
        self._edges: dict[str, dict[str, list[ContactEdge]]] = {}
        # Of these, the neighbours through which a path may lead on.
        self._onward: dict[str, dict[str, list[ContactEdge]]] = {}
        self._balls: dict[str, tuple[Triple, float]] = {}
        self.use(cost_per_m, rows)

    def use(self, cost_per_m: Mapping[str, float], rows: Mapping[str, int]) -> None:
        """Use other costs per metre and sources over the same contacts."""
        self._cost_per_m: Mapping[str, float] = cost_per_m
        self._rows: Mapping[str, int] = rows
        self._least_cost_per_m: float = min(cost_per_m.values(), default=0.0)
        for here, neighbours in self._edges.items():
            for other in neighbours:
                self._sort_in(here, other)

    def update(self, pairs: Iterable[Pair] | None, beside: Mapping[str, Mapping[str, Junction]]) -> None:
        """Read the contacts of changed pairs, None for all, from `ContactGraph.beside`."""
        if pairs is None:
            for known in (self._edges, self._onward, self._balls):
                known.clear()
            pairs = [(a, b) for a, around in beside.items() for b in around if a < b]
        for a, b in pairs:
            junction = beside.get(a, {}).get(b)
            for x, y in ((a, b), (b, a)):
                self._balls.pop(x, None)
                neighbours = self._edges.setdefault(x, {})
                neighbours.pop(y, None)
                if junction is not None:
                    contacts = zip(junction.points_m, junction.weights, strict=True)
                    neighbours[y] = [ContactEdge(x, y, point, self._crossing_costs[w]) for point, w in contacts]
                elif not neighbours:
                    del self._edges[x]
            for x, y in ((a, b), (b, a)):
                self._sort_in(x, y)
                # Whether an object leads on depends on whether it has one neighbour or more.
                if len(self._edges.get(x, ())) <= 2:
                    for other in self._edges.get(x, ()):
                        self._sort_in(other, x)

    def _sort_in(self, here: str, other: str) -> None:
        """Add a neighbour to those through which a path may lead on, or remove it from them."""
        if here not in self._edges:
            self._onward.pop(here, None)
            return
        onward, across = self._onward.setdefault(here, {}), self._edges[here].get(other)
        per_m, leads_on = self._cost_per_m.get(other), False
        if across is not None and per_m is not None:
            is_cheaper = per_m < self._cost_per_m.get(here, 0.0)
            leads_on = len(self._edges[other]) > 1 or (is_cheaper and len(across) > 1)
        if across is not None and leads_on:
            onward[other] = across
        else:
            onward.pop(other, None)

    def cheapest(
        self,
        touched: Iterable[tuple[str, Triple]],
        limits: Sequence[float] | None = None,
        among: Collection[int] | None = None,
    ) -> list[float]:
        """Cost of the cheapest path from each source to the nearest of several touched points.

        Parameters: touched : objects, each with a point [m]; limits : for each source, the highest cost of interest;
        among : rows of the sources to look for, None for all.
        Returns: one cost per source: 0 on a touched source, infinity without a path up to the limit.
        """
        rows, cost_per_m, edges = self._rows, self._cost_per_m, self._edges
        found = [math.inf] * len(rows)
        waiting: list[tuple[float, int, int, ContactEdge]] = []
        for object_id, point_m in touched:
            if object_id in rows:
                found[rows[object_id]] = 0.0
            if object_id in cost_per_m and object_id in edges:
                waiting.append((0.0, len(waiting), 0, ContactEdge("", object_id, point_m, 0.0)))
        targets = {
            x: Target(row, math.inf if limits is None else limits[row], self._ball(x))
            for x, row in rows.items()
            if found[row] > 0.0 and (among is None or row in among) and x in edges
        }
        n_labels = len(waiting)
        best: dict[ContactEdge, tuple[float, int]] = {}
        entries: dict[str, list[tuple[Triple, float, int]]] = {}
        while waiting and targets:
            cost, _, hops, edge = heapq.heappop(waiting)
            here, point = edge.into, edge.point_m
            per_m, known = cost_per_m[here], entries.setdefault(here, [])
            if _is_dominated(known, per_m, point, cost, hops):
                continue
            targets = {x: t for x, t in targets.items() if cost <= t.at_most and cost < found[t.row]}
            if not self._may_reach(targets, point, cost):
                continue
            known.append((point, cost, hops))
            for other, target in targets.items():
                for onward in edges[here].get(other, ()):
                    further = cost + per_m * math.dist(point, onward.point_m) + onward.crossing_cost
                    if further < found[target.row] and further <= target.at_most:
                        found[target.row] = target.at_most = further
            limit = max([target.at_most for target in targets.values()])
            onward_hops = 0 if self._max_hops is None else hops + 1
            for other, across in self._neighbours_onward(here, onward_hops):
                if other == edge.out_of and per_m >= cost_per_m[other]:
                    continue
                beyond, per_m_beyond = entries.get(other, []), cost_per_m[other]
                for onward in across:
                    further = cost + per_m * math.dist(point, onward.point_m) + onward.crossing_cost
                    least, least_hops = best.get(onward, (math.inf, _MOST_HOPS))
                    if further > limit or further == math.inf or (further >= least and onward_hops >= least_hops):
                        continue
                    if _is_dominated(beyond, per_m_beyond, onward.point_m, further, onward_hops):
                        continue
                    if further <= least and onward_hops <= least_hops:
                        best[onward] = (further, onward_hops)
                    n_labels += 1
                    heapq.heappush(waiting, (further, n_labels, onward_hops, onward))
        return found

    def _neighbours_onward(self, here: str, hops: int) -> Iterable[tuple[str, list[ContactEdge]]]:
        """The neighbours of an object through which a path may lead to a source, after `hops` contacts."""
        onward = self._onward.get(here, {}).items()
        if self._max_hops is None or hops + 1 < self._max_hops:
            return onward
        if hops + 1 > self._max_hops:
            return ()
        return [(other, across) for other, across in onward if any(x in self._rows for x in self._edges[other])]

    def _ball(self, source_id: str) -> tuple[Triple, float]:
        """Middle and radius [m] of a ball around all contact points of a source."""
        found = self._balls.get(source_id)
        if found is None:
            points_m = [edge.point_m for across in self._edges[source_id].values() for edge in across]
            # Not `sum`, which rounds otherwise from Python 3.12 on.
            x, y, z = (reduce(add, axis) / len(points_m) for axis in zip(*points_m, strict=True))
            found = self._balls[source_id] = ((x, y, z), max([math.dist((x, y, z), point) for point in points_m]))
        return found

    def _may_reach(self, targets: Mapping[str, Target], point_m: Triple, cost: float) -> bool:
        """Whether a path on from a point may reach a target at a useful cost."""
        per_m = self._least_cost_per_m
        for target in targets.values():
            # Rounding must not prune a path of equal cost: its last digit would depend on the order of the search.
            if cost + per_m * (math.dist(point_m, target.middle_m) - target.radius_m) <= target.at_most * _ROUNDED_UP:
                return True
        return False


def _is_dominated(
    entries: Iterable[tuple[Triple, float, int]], cost_per_m: float, point_m: Triple, cost: float, hops: int
) -> bool:
    """Whether another entry into the object reaches a point at no higher cost and over no more contacts."""
    for entry_m, entry_cost, entry_hops in entries:  # `any` takes twice as long
        if entry_hops <= hops and entry_cost + cost_per_m * math.dist(entry_m, point_m) <= cost:
            return True
    return False
