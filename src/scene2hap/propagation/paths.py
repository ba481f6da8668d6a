"""The cheapest way from each source over contacts to each object.

A way runs from contact to contact. Crossing a contact leads from one object to the next; between two contacts it runs
straight through the object that has both, at that object's price per metre. Inside the source's own body distance
is free, since the source vibrates as a whole.

The paper collects all paths by depth-first search and knows one object between source and hand. The cheapest path is
the loudest one, so a search that settles each contact once (Dijkstra) gives the same answer over any number of hops.
"""

from __future__ import annotations

import heapq
import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.snapshot import Contact


@dataclass(frozen=True)
class Arrivals:
    """How the sources reach one object.

    `points_m` (n_contacts, 3) [m] : the contacts by which they come in; `costs` (n_sources, n_contacts) : price of the
    cheapest way up to that contact, infinite where there is none.
    """

    points_m: NDArray[np.float64]
    costs: NDArray[np.float64]


def cheapest_arrivals(
    price_per_m: Mapping[str, float],
    contacts: Sequence[Contact],
    crossing_cost: Sequence[float],
    source_ids: Sequence[str],
    max_hops: int | None,
) -> dict[str, Arrivals]:
    """Arrivals at every object that has a price.

    Parameters: price_per_m : what a metre through an object costs, >= 0; an object without a price carries nothing on
    (it may be a source); crossing_cost : what each contact costs, >= 0; max_hops : contacts that a way may cross,
    None for any number.
    """
    points = np.array([contact.point_m for contact in contacts], dtype=np.float64).reshape(-1, 3)
    contacts_of: dict[str, list[int]] = defaultdict(list)
    for i, contact in enumerate(contacts):
        contacts_of[contact.a].append(i)
        contacts_of[contact.b].append(i)
    rank = {
        object_id: {contact: position for position, contact in enumerate(own)} for object_id, own in contacts_of.items()
    }
    between = {
        object_id: price_per_m[object_id] * _distances(points[own])
        for object_id, own in contacts_of.items()
        if object_id in price_per_m
    }
    arrivals = {
        object_id: Arrivals(points[own], np.full((len(source_ids), len(own)), np.inf))
        for object_id, own in contacts_of.items()
        if object_id in price_per_m
    }
    for row, source_id in enumerate(source_ids):
        # (cost so far, hops, contact just crossed, object entered by it)
        front: list[tuple[float, int, int, str]] = []
        for i in contacts_of.get(source_id, ()):
            _push(front, crossing_cost[i], 1, i, _across(contacts[i], source_id), source_id, price_per_m, max_hops)
        fewest_hops: dict[tuple[int, str], int] = {}
        while front:
            cost, hops, i, here = heapq.heappop(front)
            # Ways come in order of cost, so a later one to the same place matters only if it crossed fewer contacts.
            if hops >= fewest_hops.get((i, here), math.inf):
                continue
            if (i, here) not in fewest_hops:
                arrivals[here].costs[row, rank[here][i]] = cost
            fewest_hops[i, here] = hops if max_hops is not None else 0
            for j, step in zip(contacts_of[here], between[here][rank[here][i]], strict=True):
                if j != i:
                    onward = cost + float(step) + crossing_cost[j]
                    _push(front, onward, hops + 1, j, _across(contacts[j], here), source_id, price_per_m, max_hops)
    return arrivals


def _push(
    front: list[tuple[float, int, int, str]],
    cost: float,
    hops: int,
    contact: int,
    entered: str,
    source_id: str,
    price_per_m: Mapping[str, float],
    max_hops: int | None,
) -> None:
    reachable = entered in price_per_m and entered != source_id and math.isfinite(cost)
    if reachable and (max_hops is None or hops <= max_hops):
        heapq.heappush(front, (cost, hops, contact, entered))


def _across(contact: Contact, here: str) -> str:
    return contact.b if contact.a == here else contact.a


def _distances(points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    # hypot over explicit differences: the Gram-matrix shortcut loses half the digits for close points.
    distances: NDArray[np.float64] = np.linalg.norm(points_m[:, None, :] - points_m[None, :, :], axis=2)
    return distances
