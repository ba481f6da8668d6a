"""The cheapest paths of `prepared_paths`, contact by contact, for reports that name the objects on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.paths.prepared_paths import Sides, costs_by_hops
from scene2hap.scene.objects import Contact

Point = tuple[float, float, float]
_WITHIN = 1e-12
"""Relative error within which two sums of the same costs are equal."""


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
        self._by_hops = list(costs_by_hops(price_per_m, self._sides, source_ids, max_hops))
        final = self._by_hops[-1] * (1.0 + _WITHIN)
        # The round in which the cheapest path to each side is known: the number of contacts before that side.
        self._before: NDArray[np.intp] = np.argmax([costs <= final for costs in self._by_hops], axis=0)
        self._ways: dict[tuple[int, int, int], Way] = {}

    def entered(self, object_id: str, points_m: NDArray[np.floating]) -> NDArray[np.intp]:
        """Return the side over which each source arrives at points (n_points, 3) [m] of an object, -1 without a path.

        Returns: (n_sources, n_points). A source is on itself without a path.
        """
        own = self._sides.by_object.get(object_id)
        found = np.full((len(self._rows), len(points_m)), -1, dtype=np.intp)
        if own is None or object_id not in self._price_per_m:
            return found
        apart_m = np.linalg.norm(points_m[:, None].astype(np.float64) - self._sides.points_m[own // 2], axis=2)
        within = self._price_per_m[object_id] * apart_m
        for row in range(len(found)):
            total = within + self._by_hops[-1][row, own]
            least = total.min(axis=1, keepdims=True)
            best = np.where(total <= least * (1.0 + _WITHIN), self._before[row, own], np.inf).argmin(axis=1)
            found[row] = np.where(np.isfinite(least[:, 0]), own[best], -1)
        return found

    def way(self, source_id: str, side: int) -> Way:
        """Return the cheapest way from a source to the object that it enters over a side."""
        row = self._rows[source_id]
        return self._way(row, source_id, side, int(self._before[row, side]))

    def _way(self, row: int, source_id: str, side: int, n_before: int) -> Way:
        """Return the way to the owner of a side with at most `n_before` contacts before the last one."""
        key = row, side, n_before
        if key not in self._ways:
            owner, by_object, points_m, _ = self._sides
            behind, before = owner[side ^ 1], Way((source_id,))
            if behind != source_id:
                entries = by_object[behind]
                through_m = np.linalg.norm(points_m[entries // 2] - points_m[side // 2], axis=1)
                costs = self._by_hops[n_before - 1][row, entries] + self._price_per_m[behind] * through_m
                before = self._way(row, source_id, int(entries[costs.argmin()]), n_before - 1)
            x, y, z = points_m[side // 2].tolist()
            self._ways[key] = Way((*before.objects, owner[side]), (*before.entries_m, (x, y, z)))
        return self._ways[key]
