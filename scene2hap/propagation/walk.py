"""A walk over contacts from where it starts to wherever it comes, the cheapest ways first (Dijkstra)."""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import NamedTuple

from scene2hap.compiled import compiled
from scene2hap.propagation.entries import Entries, Triple, is_within

_NOWHERE: Entries = []
_ROUNDED_UP = 1 + 1e-9


@compiled
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


class Ends(NamedTuple):
    """The ends that a walk has yet to meet; what is met is taken out.

    at_most : what a way to each may cost, its limit at first, and less once a way is known; balls : a middle and a
    radius [m] around all doors of each; least_price_per_m : that of the cheapest of all objects.
    """

    at_most: dict[str, float]
    balls: dict[str, tuple[Triple, float]]
    least_price_per_m: float


@compiled
def walked(
    starts: Sequence[tuple[float, Door]],
    exits: Callable[[str], Collection[Exit]],
    price_per_m: Mapping[str, float],
    limit: float,
    ends: Ends | None = None,
) -> list[tuple[float, str, Triple]]:
    """Arrivals at points of objects up to a limit, the cheapest first.

    With `ends`, no way goes on from where it comes to none of them in time, and nothing is looked for behind the last.
    """
    dist, inf = math.dist, math.inf
    at_most = {} if ends is None else ends.at_most
    arrivals = []
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
        known = entries.setdefault(here, [])
        if price is not None and is_within(known, price, place, cost):
            continue
        arrivals.append((cost, here, place))
        if ends is not None:
            ends.balls.pop(here, None)
            if at_most.pop(here, None) is not None and not at_most:
                break
        if price is None or (ends is not None and not _may_lead_to(ends, place, cost)):
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
    return arrivals


def _may_lead_to(ends: Ends, place: Triple, cost: float) -> bool:
    """Whether a way on from a place may lead to any of them in time."""
    at_most, balls, price = ends
    for x, (middle, radius_m) in balls.items():
        # What rounding leaves of a way that costs the same must not cut it off.
        if cost + price * (math.dist(place, middle) - radius_m) <= at_most[x] * _ROUNDED_UP:
            return True
    return False
