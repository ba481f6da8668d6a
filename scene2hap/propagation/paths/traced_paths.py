"""The cheapest paths of `prepared_paths`, contact by contact, for reports that name the objects on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.paths.prepared_paths import (
    WITHIN,
    Arrivals,
    Sides,
    arrivals_of,
    costs_by_hops,
    distances_m,
    least_costs,
)
from scene2hap.scene.objects import Contact

Point = tuple[float, float, float]
_TOUCH = "\0touch"
"""Id of a point that is searched from; no object has it."""


class Way(NamedTuple):
    """Objects from a source to a touch, and the entry point of each object after the source [m].

    A way may return to an object, as over a bar of steel on a rug.
    """

    objects: tuple[str, ...]
    entries_m: tuple[Point, ...] = ()


class TracedPaths:
    """The cheapest paths from sources over contacts; of equal ones, those with the fewest contacts.

    Parameters: see `cheapest_arrivals`.
    """

    def __init__(
        self,
        price_per_m: Mapping[str, float],
        contacts: Sequence[Contact],
        crossing_cost: Sequence[float],
        source_ids: Sequence[str],
        max_hops: int | None,
    ) -> None:
        self._price_per_m, self._rows = price_per_m, {source_id: row for row, source_id in enumerate(source_ids)}
        self._sides = Sides.of(contacts, crossing_cost)
        self._by_hops: list[NDArray[np.float64]] | None = None
        # The number of contacts before each side on the cheapest path to it.
        self._before: NDArray[np.intp]
        if max_hops is None:
            self._costs, hops = least_costs(price_per_m, self._sides, source_ids)
            self._before = hops - 1
        else:
            self._by_hops = list(costs_by_hops(price_per_m, self._sides, source_ids, max_hops))
            self._costs = self._by_hops[-1]
            self._before = np.argmax([costs <= self._costs * (1.0 + WITHIN) for costs in self._by_hops], axis=0)
        self._ways: dict[tuple[int, int, int], Way] = {}

    def arrivals(self, source_ids: Sequence[str]) -> dict[str, Arrivals]:
        """Return the arrivals of some sources at every object that has a price."""
        rows = [self._rows[source_id] for source_id in source_ids]
        return arrivals_of(self._price_per_m, self._sides, self._costs[rows])

    def entered(self, object_id: str, points_m: NDArray[np.floating]) -> NDArray[np.intp]:
        """Return the side over which each source arrives at points (n_points, 3) [m] of an object, -1 without a path.

        Returns: (n_sources, n_points). A source is on itself without a path.
        """
        own = self._sides.by_object.get(object_id)
        found = np.full((len(self._rows), len(points_m)), -1, dtype=np.intp)
        if own is None or object_id not in self._price_per_m:
            return found
        apart_m = distances_m(points_m.astype(np.float64), self._sides.points_m[own // 2])
        within = self._price_per_m[object_id] * apart_m
        for row in range(len(found)):
            found[row] = self._cheapest(row, own, within)
        return found

    def _cheapest(self, row: int, own: NDArray[np.intp], within: NDArray[np.float64]) -> NDArray[np.intp]:
        """Return which of an object's sides is the cheapest, given costs (n, n_sides) beyond each; -1 for none."""
        total = within + self._costs[row, own]
        least = total.min(axis=1, keepdims=True)
        best = np.where(total <= least * (1.0 + WITHIN), self._before[row, own], np.inf).argmin(axis=1)
        return np.where(np.isfinite(least[:, 0]), own[best], -1)

    def way_to(self, source_id: str, object_id: str) -> Way | None:
        """Return the cheapest way from a source to any point of an object, None without one."""
        own = self._sides.by_object.get(object_id)
        if own is None:
            return None
        (side,) = self._cheapest(self._rows[source_id], own, np.zeros((1, len(own)))).tolist()
        return self.way(source_id, side) if side >= 0 else None

    def way(self, source_id: str, side: int) -> Way:
        """Return the cheapest way from a source to the object that it enters over a side."""
        row = self._rows[source_id]
        return self._way(row, source_id, side, int(self._before[row, side]))

    def _way(self, row: int, source_id: str, side: int, n_before: int) -> Way:
        """Return the way to the owner of a side with at most `n_before` contacts before the last one."""
        owner, by_object, points_m, _ = self._sides
        pending: list[tuple[int, int]] = []
        while (row, side, n_before) not in self._ways:
            pending.append((side, n_before))
            behind = owner[side ^ 1]
            if behind == source_id:
                break
            entries = by_object[behind]
            through_m = distances_m(points_m[[side // 2]], points_m[entries // 2])[0]
            costs = self._costs_before(row, entries, n_before) + self._price_per_m[behind] * through_m
            side, n_before = int(entries[costs.argmin()]), n_before - 1
        way = self._ways.get((row, side, n_before), Way((source_id,)))
        for side, n_before in reversed(pending):
            x, y, z = points_m[side // 2].tolist()
            way = self._ways[row, side, n_before] = Way((*way.objects, owner[side]), (*way.entries_m, (x, y, z)))
        return way

    def _costs_before(self, row: int, sides: NDArray[np.intp], n_hops: int) -> NDArray[np.float64]:
        """Return the cost of arriving over sides with at most `n_hops` contacts, infinite without such a path."""
        costs: NDArray[np.float64]
        if self._by_hops is not None:
            costs = self._by_hops[n_hops - 1][row, sides]
        else:
            costs = np.where(self._before[row, sides] < n_hops, self._costs[row, sides], np.inf)
        return costs


class PathsToPoint:
    """The cheapest paths from all objects to one point, as if each were a source.

    A path costs the same in both directions, so that one search from the point finds all. Parameters: see
    `cheapest_arrivals`; object_id, point_m : a point of an object [m].
    """

    def __init__(
        self,
        price_per_m: Mapping[str, float],
        contacts: Sequence[Contact],
        crossing_cost: Sequence[float],
        max_hops: int | None,
        object_id: str,
        point_m: Point,
    ) -> None:
        hops = None if max_hops is None else max_hops + 1
        touch = Contact(_TOUCH, object_id, point_m)
        self._traced = TracedPaths(price_per_m, [*contacts, touch], [*crossing_cost, 0.0], (_TOUCH,), hops)
        self._object_id = object_id

    def way(self, source_id: str) -> Way | None:
        """Return the cheapest way from a source to the point, None without one."""
        if source_id == self._object_id:
            return Way((source_id,))
        found = self._traced.way_to(_TOUCH, source_id)
        return None if found is None else Way(found.objects[:0:-1], found.entries_m[:0:-1])
