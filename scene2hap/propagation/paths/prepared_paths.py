"""The cheapest path from each source over contacts to each object of a scene, for prepared fields.

A path runs from contact to contact. Crossing a contact leads from one object to the next; between two contacts it runs
straight through the object that has both, at that object's cost per metre. Inside the source's own body distance is
free, since the source vibrates as a whole.

The paper collects all paths by depth-first search, with one object between source and hand. Here the cheapest path is
enough, since it is the loudest one. Without a limit on the number of contacts, one search from each source finds it
(Dijkstra's algorithm). With a limit, rounds lower the cost of arriving over
each contact (Bellman-Ford, vectorised over sources and contacts): after n rounds all paths over at most n contacts are
known.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.compiled import compiled
from scene2hap.propagation.points import object_points
from scene2hap.scene.objects import Contact

WITHIN = 1e-12
"""Relative error within which two sums of the same costs are equal."""


_AT_ONCE = 256
"""Points of one array over points and contacts: a map of a floor with a thousand objects would need gigabytes."""


class ContactSides(NamedTuple):
    """The two sides of each contact, numbered 2 i on its object a and 2 i + 1 on b: side ^ 1 is the one across.

    owner : the object of each side; by_object : the sides of each object; points_m (n_contacts, 3) [m]; crossing
    (n_contacts,) : cost of crossing each contact.
    """

    owner: list[str]
    by_object: dict[str, NDArray[np.intp]]
    points_m: NDArray[np.float64]
    crossing: NDArray[np.float64]

    @classmethod
    def of(cls, contacts: Sequence[Contact], crossing_cost: Sequence[float]) -> ContactSides:
        """Number the sides of contacts."""
        owner = [object_id for contact in contacts for object_id in (contact.a, contact.b)]
        points_m = np.array([contact.point_m for contact in contacts], dtype=np.float64).reshape(-1, 3)
        by_object = _by_object(owner, np.arange(len(owner)))
        return cls(owner, by_object, points_m, np.asarray(crossing_cost, dtype=np.float64))


@dataclass(frozen=True)
class Arrivals:
    """Costs at which the sources reach one object.

    `points_m` (n_contacts, 3) [m] : its contacts over which a source enters it; `costs` (n_sources, n_contacts) : cost
    of the cheapest path up to that contact, infinite without one.
    """

    points_m: NDArray[np.float64]
    costs: NDArray[np.float64]


def cheapest_arrivals(
    cost_per_m: Mapping[str, float],
    contacts: Sequence[Contact],
    crossing_cost: Sequence[float],
    source_ids: Sequence[str],
    max_hops: int | None,
) -> dict[str, Arrivals]:
    """Compute the arrivals at every object that has a cost per metre.

    Parameters: cost_per_m : cost of a metre through an object, >= 0; an object without one passes nothing on (it may
    be a source); crossing_cost : cost of each contact, >= 0; max_hops : contacts that a path may cross, None for any
    number.
    """
    sides = ContactSides.of(contacts, crossing_cost)
    if max_hops is None:
        costs = least_costs(cost_per_m, sides, source_ids).costs
    else:
        (costs,) = deque(costs_by_hops(cost_per_m, sides, source_ids, max_hops), maxlen=1)
    return arrivals_of(cost_per_m, sides, costs)


def arrivals_of(
    cost_per_m: Mapping[str, float], sides: ContactSides, costs: NDArray[np.float64]
) -> dict[str, Arrivals]:
    """Return the arrivals at every object with a cost per metre, from the costs (n_sources, n_sides) over all sides."""
    # Contacts that every source reaches from within the object are never on a cheapest path into it. On a floor with a
    # thousand objects these are most contacts.
    with np.errstate(invalid="ignore"):  # a contact of weight 0 costs inf, and inf - inf is nan
        within = costs[:, np.arange(costs.shape[1]) ^ 1] - sides.crossing.repeat(2)
        is_entered: NDArray[np.bool_] = np.any(~(within < costs * (1.0 - WITHIN)), axis=0)
    arrivals = {}
    for object_id, own in sides.by_object.items():
        if object_id in cost_per_m:
            entered = own[is_entered[own]]
            arrivals[object_id] = Arrivals(sides.points_m[entered // 2], costs[:, entered])
    return arrivals


def arrivals_at(
    arrivals: Mapping[str, Arrivals],
    cost_per_m: Mapping[str, float],
    source_ids: Sequence[str],
    object_id: str,
    points_m: ArrayLike,
) -> NDArray[np.float64]:
    """Cost of the cheapest path from each source to each point (n_points, n_sources): 0 on the source itself, infinite
    without a path."""
    points = object_points(object_id, points_m)
    costs = np.full((len(points), len(source_ids)), np.inf)
    if object_id in arrivals:
        arrived, least = arrivals[object_id], np.empty((len(source_ids), len(points)))
        entry = np.empty(least.shape, dtype=np.intp)
        hops = np.zeros(arrived.costs.shape, dtype=np.intp)
        nearest_entries(points, arrived.points_m, cost_per_m[object_id], arrived.costs, hops, entry, least)
        costs = np.ascontiguousarray(least.T)
    for column, source_id in enumerate(source_ids):
        if source_id == object_id:
            costs[:, column] = 0.0
    return costs


class CheapestPaths(NamedTuple):
    """The cheapest paths from each source over each side; of paths of equal cost, those with the fewest contacts.

    costs (n_sources, n_sides) : infinite without a path; hops (n_sources, n_sides) : contacts on the path, 0 without
    one; before (n_sources, n_sides) : the side entered before, meaningless for the first on a path.
    """

    costs: NDArray[np.float64]
    hops: NDArray[np.intp]
    before: NDArray[np.intp]


def least_costs(cost_per_m: Mapping[str, float], sides: ContactSides, source_ids: Sequence[str]) -> CheapestPaths:
    """Return the cheapest path from each source over each side."""
    shape, network = (len(source_ids), len(sides.owner)), Network.of(cost_per_m, sides)
    found = CheapestPaths(np.full(shape, np.inf), np.zeros(shape, dtype=np.intp), np.zeros(shape, dtype=np.intp))
    for row, source_id in enumerate(source_ids):
        if source_id in sides.by_object:
            search(network, sides.by_object[source_id], *(values[row] for values in found))
    return found


class Network(NamedTuple):
    """The sides of contacts as arrays.

    owner (n_sides,) : number of the object of each side; own (n_sides,) : the sides of all objects, one object after
    the other; first (n_objects + 1,) : where each object's begin in `own`; cost_per_m (n_objects,) : infinite where no
    path leads through; leads_on (n_sides,) : whether a path may be cheaper that enters over this side and goes on;
    points_m, crossing : see `ContactSides`.
    """

    owner: NDArray[np.intp]
    own: NDArray[np.intp]
    first: NDArray[np.intp]
    cost_per_m: NDArray[np.float64]
    leads_on: NDArray[np.bool_]
    points_m: NDArray[np.float64]
    crossing: NDArray[np.float64]

    @classmethod
    def of(cls, cost_per_m: Mapping[str, float], sides: ContactSides) -> Network:
        """Number the objects of sides."""
        number = {object_id: k for k, object_id in enumerate(sides.by_object)}
        owner = np.array([number[object_id] for object_id in sides.owner], dtype=np.intp)
        per_m = np.array([cost_per_m.get(object_id, np.inf) for object_id in sides.by_object], dtype=np.float64)
        own = np.concatenate([*sides.by_object.values(), np.empty(0, dtype=np.intp)])
        first = np.cumsum([0, *map(len, sides.by_object.values())], dtype=np.intp)
        # An object that touches only the object that a path comes from, and is not cheaper, leads nowhere new.
        n_beside = np.array([len(set(owner[its ^ 1].tolist())) for its in sides.by_object.values()], dtype=np.intp)
        behind = owner[np.arange(len(owner)) ^ 1]
        leads_on = np.isfinite(per_m[owner]) & ((n_beside[owner] > 1) | (per_m[owner] < per_m[behind]))
        return cls(owner, own, first, per_m, leads_on, sides.points_m, sides.crossing)


@compiled
def search(
    network: Network,
    out: NDArray[np.intp],
    costs: NDArray[np.float64],
    hops: NDArray[np.intp],
    before: NDArray[np.intp],
) -> None:
    """Enter the cheapest paths from one source into a row of `CheapestPaths`, which is infinite and 0 before.

    Parameters: out : the sides of the source.
    """
    owner, own_sides, first, cost_per_m, leads_on, points_m, crossing = network
    costs[out ^ 1], hops[out ^ 1] = crossing[out // 2], 1
    waiting = np.where(leads_on, costs, np.inf)
    with np.errstate(invalid="ignore"):  # a contact of weight 0 costs inf, and inf - inf is nan
        while len(waiting) and (least := float(waiting.min())) < np.inf:
            near = np.flatnonzero(waiting <= least * (1.0 + WITHIN))
            side = int(near[hops[near].argmin()])
            waiting[side] = np.inf
            here = owner[side]
            own = own_sides[first[here] : first[here + 1]]
            across, crossed = own ^ 1, crossing[own // 2]
            within = costs[side] + cost_per_m[here] * distances_m(points_m[[side // 2]], points_m[own // 2])[0]
            onward, n_hops = within + crossed, hops[side] + 1
            is_equal = onward <= costs[across] * (1.0 + WITHIN)
            is_better = (onward < costs[across] * (1.0 - WITHIN)) | (is_equal & (n_hops < hops[across]))
            # A point that is cheaper to reach from within leads nowhere new: a straight line is never longer than a
            # line through another point. Otherwise a floor with a thousand objects would be searched from each.
            waiting[own[is_better & (within < costs[own] * (1.0 - WITHIN))]] = np.inf
            better = across[is_better]
            costs[better], hops[better], before[better] = onward[is_better], n_hops, side
            is_useful = leads_on[better] & ~(costs[better ^ 1] - crossed[is_better] <= costs[better])
            waiting[better[is_useful]] = costs[better[is_useful]]


@compiled
def nearest_entries(
    points_m: NDArray[np.float64],
    entries_m: NDArray[np.float64],
    cost_per_m: float,
    costs: NDArray[np.float64],
    hops: NDArray[np.intp],
    found: NDArray[np.intp],
    least: NDArray[np.float64],
) -> None:
    """Find the entry into an object on the cheapest path from each source to each point of it.

    Parameters: points_m (n_points, 3), entries_m (n_entries, 3) [m]; costs, hops (n_sources, n_entries) : of the
    cheapest path to each entry; found, least (n_sources, n_points) : set to the entry, -1 without a path, and to the
    cost of the path, infinite without one. Of paths of equal cost, that with the fewest contacts counts.
    """
    found[:], least[:] = -1, np.inf
    for start in range(0, len(points_m) if len(entries_m) else 0, _AT_ONCE):
        part = slice(start, start + _AT_ONCE)
        within = cost_per_m * distances_m(points_m[part], entries_m)
        for row in range(len(found)):
            total = within + costs[row]
            least[row, part] = lowest = total.min(axis=1)
            best = np.where(total <= lowest[:, None] * (1.0 + WITHIN), hops[row], np.inf).argmin(axis=1)
            found[row, part] = np.where(np.isfinite(lowest), best, -1)


def costs_by_hops(
    cost_per_m: Mapping[str, float], sides: ContactSides, source_ids: Sequence[str], max_hops: int
) -> Iterator[NDArray[np.float64]]:
    """Yield the cost (n_sources, n_sides) of arriving over each side with at most 1, 2, ... contacts, up to the last
    round that may lower a cost."""
    owner, by_object, points_m, crossing = sides
    costs = np.full((len(source_ids), len(owner)), np.inf)
    for row, source_id in enumerate(source_ids):
        if source_id in by_object:
            out = by_object[source_id]
            costs[row, out ^ 1] = crossing[out // 2]
    yield costs
    hops, entered = 1, np.flatnonzero(np.isfinite(costs).any(axis=0))
    while len(entered) and hops < max_hops:
        improved = costs.copy()
        for object_id, rows in _by_object(owner, entered[_useful(costs, crossing, entered)]).items():
            if object_id in cost_per_m:
                own = by_object[object_id]
                way = cost_per_m[object_id] * distances_m(points_m[rows // 2], points_m[own // 2]) + crossing[own // 2]
                onward = (costs[:, rows, None] + way).min(axis=1)
                improved[:, own ^ 1] = np.minimum(improved[:, own ^ 1], onward)
        entered = np.flatnonzero((improved < costs).any(axis=0))
        hops, costs = hops + 1, improved
        yield costs


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


def distances_m(from_m: NDArray[np.float64], to_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distances (n, m) of points (n, 3) from points (m, 3) [m]."""
    # Explicit differences, since the Gram-matrix shortcut loses half the digits for close points; axis by axis, since
    # numpy is slow along an axis of three.
    x, y, z = (np.subtract.outer(a, b) for a, b in zip(from_m.T, to_m.T, strict=True))
    distances: NDArray[np.float64] = np.sqrt(x * x + y * y + z * z)
    return distances
