"""The cheapest ways from a touch outward to the sources, over a contact graph as it is.

A way costs the same in both directions, so that where a contact moves in every frame it is enough to walk outward from
the few points that are touched until all sources are met (Dijkstra), instead of searching a whole scene from each
source (`paths`).
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scene2hap.contact.junction import Junction

Triple = tuple[float, float, float]


def cheapest_outward(
    object_id: str,
    point_m: Triple,
    beside: Mapping[str, Mapping[str, Junction]],
    price_per_m: Mapping[str, float],
    crossing: Mapping[float, float],
    row: Mapping[str, int],
) -> list[float]:
    """Price of the cheapest way from each source to a point of an object, inf for none.

    Parameters: beside, price_per_m : as in `LivePaths`; crossing : what a contact of each weight costs; row : where in
    the answer each source stands.
    """
    dist, inf = math.dist, math.inf
    found = [inf] * len(row)
    wanted = {source_id for source_id in row if beside.get(source_id)}
    entries: dict[str, list[tuple[Triple, float]]] = {}
    start = (object_id, point_m)
    least = {start: 0.0}
    waiting = [(0.0, start)]
    while waiting and wanted:
        cost, arrived = heapq.heappop(waiting)
        if cost > least[arrived]:
            continue
        here, place = arrived
        if here in wanted:
            wanted.remove(here)
            found[row[here]] = cost
        price = price_per_m.get(here)
        if price is None:
            continue
        # A straight way through an object is never longer than one by another point: what was entered more cheaply
        # elsewhere leads nowhere new.
        known = entries.setdefault(here, [])
        for there, there_cost in known:
            if there_cost + price * dist(there, place) <= cost:
                break
        else:
            known.append((place, cost))
            for other, junction in beside[here].items():
                for there, weight in zip(junction.points_m, junction.weights, strict=True):
                    further, onward = cost + price * dist(place, there) + crossing[weight], (other, there)
                    if further < least.get(onward, inf):
                        least[onward] = further
                        heapq.heappush(waiting, (further, onward))
    return found
