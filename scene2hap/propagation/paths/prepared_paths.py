"""The cheapest path from each source over contacts to each object of a scene, for prepared fields.

A path runs from contact to contact. Crossing a contact leads from one object to the next; between two contacts it runs
straight through the object that has both, at that object's price per metre. Inside the source's own body distance is
free, since the source vibrates as a whole.

The paper collects all paths by depth-first search, with one object between source and hand. Here the cheapest path is
enough, since it is the loudest one. Rounds lower the cost of arriving over each contact (Bellman-Ford, vectorised over
sources and contacts): after n rounds all paths over at most n contacts are known, and when a round improves nothing,
all paths are.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.objects import Contact


@dataclass(frozen=True)
class Arrivals:
    """Costs at which the sources reach one object.

    `points_m` (n_contacts, 3) [m] : its contacts; `costs` (n_sources, n_contacts) : cost of the cheapest path up to
    that contact, infinite without one.
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
    """Compute the arrivals at every object that has a price.

    Parameters: price_per_m : cost of a metre through an object, >= 0; an object without a price passes nothing on (it
    may be a source); crossing_cost : cost of each contact, >= 0; max_hops : contacts that a path may cross, None for
    any number.
    """
    pairs = [(contact.a, contact.b) for contact in contacts]
    points_m = [contact.point_m for contact in contacts]
    return cheapest_over(price_per_m, pairs, points_m, crossing_cost, source_ids, max_hops)


def cheapest_over(
    price_per_m: Mapping[str, float],
    pairs: Sequence[tuple[str, str]],
    points_m: Sequence[tuple[float, float, float]],
    crossing_cost: Sequence[float],
    source_ids: Sequence[str],
    max_hops: int | None,
) -> dict[str, Arrivals]:
    """Compute `cheapest_arrivals` for contacts given as pairs of objects and points [m]."""
    # A contact has two sides, numbered 2 i on its object a and 2 i + 1 on b: side ^ 1 is the one across.
    owner = [object_id for pair in pairs for object_id in pair]
    sides_of: dict[str, list[int]] = defaultdict(list)
    for side, object_id in enumerate(owner):
        sides_of[object_id].append(side)
    sides = {object_id: np.array(own) for object_id, own in sides_of.items()}
    points = np.array(points_m, dtype=np.float64).reshape(-1, 3)
    crossing = np.asarray(crossing_cost, dtype=np.float64)
    costs = np.full((len(source_ids), 2 * len(pairs)), np.inf)
    for row, source_id in enumerate(source_ids):
        if source_id in sides:
            out = sides[source_id]
            costs[row, out ^ 1] = crossing[out // 2]
    hops, entered = 1, np.flatnonzero(np.isfinite(costs).any(axis=0))
    while len(entered) and (max_hops is None or hops < max_hops):
        improved = costs.copy()
        for object_id, rows in _by_object(owner, entered[_useful(costs, crossing, entered)]).items():
            if object_id in price_per_m:
                own = sides[object_id]
                way = price_per_m[object_id] * _distances(points[rows // 2], points[own // 2]) + crossing[own // 2]
                onward = (costs[:, rows, None] + way).min(axis=1)
                improved[:, own ^ 1] = np.minimum(improved[:, own ^ 1], onward)
        entered = np.flatnonzero((improved < costs).any(axis=0))
        hops, costs = hops + 1, improved
    return {
        object_id: Arrivals(points[own // 2], costs[:, own])
        for object_id, own in sides.items()
        if object_id in price_per_m
    }


def _useful(costs: NDArray[np.float64], crossing: NDArray[np.float64], entered: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Mask of the entered sides that are cheaper to enter than to reach from within their object.

    The other sides lead nowhere new: a straight line is never longer than a line through another point. Otherwise a
    floor with a thousand objects on it would be searched from each of them.
    """
    with np.errstate(invalid="ignore"):  # a contact of weight 0 costs inf, and inf - inf is nan
        within = costs[:, entered ^ 1] - crossing[entered // 2]
    useful: NDArray[np.bool_] = np.any(~(within <= costs[:, entered]), axis=0)
    return useful


def _by_object(owner: Sequence[str], rows: NDArray[np.intp]) -> dict[str, NDArray[np.intp]]:
    grouped: dict[str, list[int]] = defaultdict(list)
    for row in rows.tolist():
        grouped[owner[row]].append(row)
    return {object_id: np.array(own, dtype=np.intp) for object_id, own in grouped.items()}


def _distances(from_m: NDArray[np.float64], to_m: NDArray[np.float64]) -> NDArray[np.float64]:
    # The norm of explicit differences: the Gram-matrix shortcut loses half the digits for close points.
    distances: NDArray[np.float64] = np.linalg.norm(from_m[:, None, :] - to_m[None, :, :], axis=2)
    return distances
