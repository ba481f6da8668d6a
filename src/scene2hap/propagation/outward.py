"""The cheapest ways outward from a touch or a source, over a contact graph as it is.

A way costs the same in both directions. Where a contact moves in every frame it is enough to walk outward from the few
points that are touched until all sources are met (Dijkstra), instead of searching a whole scene from each source
(`paths`); and where nothing farther than a limit matters, no walk goes beyond it.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scene2hap.contact.junction import Junction

Triple = tuple[float, float, float]
Entries = list[tuple[Triple, float]]
"""Points at which an object is entered, each with what the way there costs."""
_NOWHERE: Entries = []


class Door:
    """A point of a contact as one goes through it: out of what, into what, where, and what going through costs."""

    __slots__ = ("crossing", "into", "out_of", "place")

    def __init__(self, out_of: str, into: str, place: Triple, crossing: float) -> None:
        self.out_of, self.into, self.place, self.crossing = out_of, into, place, crossing


class Doors:
    """The doors of a contact graph, kept as long as their junctions: a step of a walk asks for a few dozen.

    Parameters: beside : as in `LivePaths`; crossing : what a contact of each weight costs.
    """

    def __init__(self, beside: Mapping[str, Mapping[str, Junction]], crossing: Mapping[float, float]) -> None:
        self._beside, self._crossing = beside, crossing
        self._known: dict[str, dict[str, tuple[Junction, list[Door]]]] = {}

    def has(self, object_id: str) -> bool:
        """Whether an object touches any."""
        return bool(self._beside.get(object_id))

    def out_of(self, object_id: str) -> Iterator[list[Door]]:
        """The doors out of an object, those into one other together."""
        known = self._known.setdefault(object_id, {})
        for other, junction in self._beside.get(object_id, {}).items():
            last = known.get(other)
            if last is None or last[0] is not junction:
                points = zip(junction.points_m, junction.weights, strict=True)
                doors = [Door(object_id, other, place, self._crossing[weight]) for place, weight in points]
                last = known[other] = (junction, doors)
            yield last[1]


def cheapest_outward(
    object_id: str,
    point_m: Triple,
    doors: Doors,
    price_per_m: Mapping[str, float],
    row: Mapping[str, int],
    limit: float = math.inf,
) -> list[float]:
    """Price of the cheapest way from each source to a point of an object, inf for none up to a limit.

    Parameters: price_per_m : as in `LivePaths`; row : where in the answer each source stands.
    """
    found = [math.inf] * len(row)
    wanted = {source_id for source_id in row if source_id == object_id or doors.has(source_id)}
    for cost, here, _ in _walk([(0.0, Door("", object_id, point_m, 0.0))], doors, price_per_m, limit):
        if here in wanted:
            found[row[here]] = cost
            wanted.remove(here)
            if not wanted:
                break
    return found


def entries_around(source_id: str, doors: Doors, price_per_m: Mapping[str, float], limit: float) -> dict[str, Entries]:
    """Where all objects are entered from a source, up to a limit, without what leads nowhere new; else as above."""
    starts = [(door.crossing, door) for several in doors.out_of(source_id) for door in several]
    entries: dict[str, Entries] = {}
    for cost, here, place in _walk(starts, doors, price_per_m, limit):
        entries.setdefault(here, []).append((place, cost))
    return entries


def _walk(
    starts: Iterable[tuple[float, Door]], doors: Doors, price_per_m: Mapping[str, float], limit: float
) -> Iterator[tuple[float, str, Triple]]:
    """Arrivals at points of objects, the cheapest first."""
    dist, inf = math.dist, math.inf
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
        if _is_within(known, place, price, cost):
            continue
        yield cost, here, place
        known.append((place, cost))
        for several in doors.out_of(here):
            other = several[0].into
            beyond, price_beyond = entries.get(other, _NOWHERE), price_per_m.get(other, 0.0)
            if other == arrived.out_of and price >= price_beyond:
                continue  # straight on there would have been no dearer
            for door in several:
                before = least.get(door, inf)
                if before <= cost:
                    continue
                there = door.place
                further = cost + price * dist(place, there) + door.crossing
                if further > limit or further >= before:
                    continue
                if not _is_within(beyond, there, price_beyond, further):
                    least[door] = further
                    n_pushed += 1
                    heapq.heappush(waiting, (further, n_pushed, door))


def _is_within(entries: Entries, place: Triple, price: float, cost: float) -> bool:
    """Whether a point of an object costs no more from one of its entries.

    A straight way through an object is never longer than one by another point, so that such a one leads nowhere new.
    """
    dist = math.dist
    for entered, entered_cost in entries:  # noqa: SIM110  # `any` takes twice as long
        if entered_cost + price * dist(entered, place) <= cost:
            return True
    return False
