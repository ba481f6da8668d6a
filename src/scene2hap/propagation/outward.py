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
Beside = Mapping[str, Mapping[str, "Junction"]]
Entries = list[tuple[Triple, float]]
"""Points at which an object is entered, each with what the way there costs."""


def cheapest_outward(
    object_id: str,
    point_m: Triple,
    beside: Beside,
    price_per_m: Mapping[str, float],
    crossing: Mapping[float, float],
    row: Mapping[str, int],
    limit: float = math.inf,
) -> list[float]:
    """Price of the cheapest way from each source to a point of an object, inf for none up to a limit.

    Parameters: beside, price_per_m : as in `LivePaths`; crossing : what a contact of each weight costs; row : where in
    the answer each source stands.
    """
    found = [math.inf] * len(row)
    wanted = {source_id for source_id in row if beside.get(source_id)}
    if wanted:
        for cost, here, _ in _walk([(0.0, (object_id, point_m))], beside, price_per_m, crossing, limit):
            if here in wanted:
                found[row[here]] = cost
                wanted.remove(here)
                if not wanted:
                    break
    return found


def entries_around(
    source_id: str,
    beside: Beside,
    price_per_m: Mapping[str, float],
    crossing: Mapping[float, float],
    limit: float,
) -> dict[str, Entries]:
    """Where all objects are entered from a source, up to a limit, without what leads nowhere new; else as above."""
    starts = [
        (crossing[weight], (other, place))
        for other, junction in beside.get(source_id, {}).items()
        for place, weight in zip(junction.points_m, junction.weights, strict=True)
    ]
    entries: dict[str, Entries] = {}
    for cost, here, place in _walk(starts, beside, price_per_m, crossing, limit):
        entries.setdefault(here, []).append((place, cost))
    return entries


def _walk(
    starts: Iterable[tuple[float, tuple[str, Triple]]],
    beside: Beside,
    price_per_m: Mapping[str, float],
    crossing: Mapping[float, float],
    limit: float,
) -> Iterator[tuple[float, str, Triple]]:
    """Arrivals at points of objects, the cheapest first."""
    dist, inf = math.dist, math.inf
    entries: dict[str, Entries] = {}
    waiting = [start for start in starts if start[0] <= limit]
    heapq.heapify(waiting)
    least: dict[tuple[str, Triple], float] = {}
    for cost, start in waiting:
        least[start] = min(cost, least.get(start, inf))
    while waiting:
        cost, arrived = heapq.heappop(waiting)
        if cost > least[arrived]:
            continue
        here, place = arrived
        price = price_per_m.get(here)
        if price is None:
            yield cost, here, place
            continue
        known = entries.setdefault(here, [])
        if any(there_cost + price * dist(there, place) <= cost for there, there_cost in known):
            continue
        yield cost, here, place
        known.append((place, cost))
        for other, junction in beside[here].items():
            beyond, price_beyond = entries.get(other, ()), price_per_m.get(other, 0.0)
            for there, weight in zip(junction.points_m, junction.weights, strict=True):
                further, onward = cost + price * dist(place, there) + crossing[weight], (other, there)
                if further > limit or further >= least.get(onward, inf):
                    continue
                # A straight way through an object is never longer than one by another point: what was entered more
                # cheaply elsewhere leads nowhere new.
                for entered, entered_cost in beyond:
                    if entered_cost + price_beyond * dist(entered, there) <= further:
                        break
                else:
                    least[onward] = further
                    heapq.heappush(waiting, (further, onward))
