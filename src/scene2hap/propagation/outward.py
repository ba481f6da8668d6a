"""The cheapest ways outward from a touch or a source, over a contact graph as it is.

A way costs the same in both directions. Where a contact moves in every frame it is enough to walk outward from the few
points that are touched until all sources are met (Dijkstra), instead of searching a whole scene from each source
(`paths`). Where nothing farther than a limit matters, no walk goes beyond it; and none goes on from where even a
straight way through the cheapest of all objects would come to a source too late: the feet of a cup are a short cut over
a dear table, but to few places.

Source of the latter: P. E. Hart, N. J. Nilsson, B. Raphael, IEEE Trans. Systems Science and Cybernetics 4 (1968) 100.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from scene2hap.propagation.entries import Entries, Triple, is_within

if TYPE_CHECKING:
    from scene2hap.contact.graph import ContactGraph
    from scene2hap.contact.junction import Junction

_NOWHERE: Entries = []
_ROUNDED_UP = 1 + 1e-9


class Door:
    """A point of a contact as one goes through it: out of what, into what, where, and what going through costs."""

    __slots__ = ("crossing", "into", "out_of", "place")

    def __init__(self, out_of: str, into: str, place: Triple, crossing: float) -> None:
        self.out_of, self.into, self.place, self.crossing = out_of, into, place, crossing


class Exit(NamedTuple):
    """The doors out of an object into one other, through which a metre costs `price`, 0 if nothing goes on there."""

    into: str
    price: float
    doors: list[Door]


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
        self._exits: dict[str, list[Exit]] = {}
        self._exits_to_ends: dict[str, list[Exit]] = {}

    def has(self, object_id: str) -> bool:
        """Whether an object touches any."""
        return bool(self._beside.get(object_id))

    def look_again(self) -> None:
        """Take in what has changed; to be called before a walk."""
        if self._version != self._graph.version:
            self._version = self._graph.version
            self._exits.clear()
            self._exits_to_ends.clear()

    def exits(self, object_id: str) -> list[Exit]:
        """The ways out of an object."""
        found = self._exits.get(object_id)
        if found is None:
            price, doors = self.price_per_m, self._doors_of(object_id)
            found = self._exits[object_id] = [Exit(x, price.get(x, 0.0), several) for x, (_, several) in doors.items()]
        return found

    def exits_to_ends(self, object_id: str) -> list[Exit]:
        """The same without those that lead to no end, nor back more cheaply: into a cup that stands on this alone."""
        found = self._exits_to_ends.get(object_id)
        if found is None:
            price, price_here = self.price_per_m, self.price_per_m.get(object_id, 0.0)
            found = self._exits_to_ends[object_id] = [
                x
                for x in self.exits(object_id)
                if x.into in self._ends
                or (x.into in price and (len(self._beside[x.into]) > 1 or (x.price < price_here and len(x.doors) > 1)))
            ]
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


class _Ends:
    """The ends that a walk has yet to meet.

    Parameters: at_most : what a way to each may cost, its limit at first, and less once a way is known.
    """

    def __init__(self, doors: Doors, at_most: dict[str, float]) -> None:
        self.at_most = at_most
        self._price_per_m = doors.least_price_per_m
        self._balls = {x: doors.ball(x) for x in at_most if doors.has(x)}

    def met(self, object_id: str) -> bool:
        """Note that the walk has come to an object; true if that is an end which it had not met."""
        self._balls.pop(object_id, None)
        return self.at_most.pop(object_id, None) is not None

    def may_follow(self, place: Triple, cost: float) -> bool:
        """Whether a way on from a place may lead to any of them in time."""
        price, dist, at_most = self._price_per_m, math.dist, self.at_most
        for x, (middle, radius_m) in self._balls.items():
            # What rounding leaves of a way that costs the same must not cut it off.
            if cost + price * (dist(place, middle) - radius_m) <= at_most[x] * _ROUNDED_UP:
                return True
        return False


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
    ends = _Ends(
        doors,
        {
            x: math.inf if limits is None else limits[k]
            for x, k in row.items()
            if (among is None or k in among) and (x == object_id or doors.has(x))
        },
    )
    limit = max(ends.at_most.values(), default=0.0)
    starts = [(0.0, Door("", object_id, point_m, 0.0))]
    for cost, here, _ in _walk(starts, doors.exits_to_ends, doors.price_per_m, limit, ends):
        if ends.met(here):
            found[row[here]] = cost
            if not ends.at_most:
                break
    return found


def entries_around(source_id: str, doors: Doors, limit: float) -> dict[str, Entries]:
    """Where all objects are entered from a source, up to a limit, without what leads nowhere new; else as above."""
    doors.look_again()
    starts = [(door.crossing, door) for out in doors.exits(source_id) for door in out.doors]
    entries: dict[str, Entries] = {}
    for cost, here, place in _walk(starts, doors.exits, doors.price_per_m, limit):
        entries.setdefault(here, []).append((place, cost))
    return entries


def _walk(
    starts: Iterable[tuple[float, Door]],
    exits: Callable[[str], list[Exit]],
    price_per_m: Mapping[str, float],
    limit: float,
    ends: _Ends | None = None,
) -> Iterator[tuple[float, str, Triple]]:
    """Arrivals at points of objects up to a limit, the cheapest first.

    With `ends`, no way goes on from where it comes to none of them in time.
    """
    dist, inf = math.dist, math.inf
    at_most = {} if ends is None else ends.at_most
    entries: dict[str, Entries] = {}
    # The number keeps doors of one cost apart.
    waiting = [(cost, n, door) for n, (cost, door) in enumerate(starts) if cost <= limit]
    heapq.heapify(waiting)
    least = {door: cost for cost, _, door in waiting}
    n_pushed = len(waiting)
    while waiting:
        cost, _, arrived = heapq.heappop(waiting)
        if cost > least[arrived]:
            continue
        here, place = arrived.into, arrived.place
        price = price_per_m.get(here)
        if price is None:
            yield cost, here, place
            continue
        known = entries.setdefault(here, [])
        if is_within(known, price, place, cost):
            continue
        yield cost, here, place
        if ends is not None and not ends.may_follow(place, cost):
            continue
        known.append((place, cost))
        for other, price_beyond, doors in exits(here):
            if other == arrived.out_of and price >= price_beyond:
                continue  # straight on there would have been no dearer
            beyond = entries.get(other, _NOWHERE)
            for door in doors:
                before = least.get(door, inf)
                if before <= cost:
                    continue
                there = door.place
                further = cost + price * dist(place, there) + door.crossing
                if further > limit or further >= before:
                    continue
                if not is_within(beyond, price_beyond, there, further):
                    least[door] = further
                    n_pushed += 1
                    heapq.heappush(waiting, (further, n_pushed, door))
                    if further < at_most.get(other, 0.0):
                        at_most[other] = further
