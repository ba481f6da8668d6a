"""The cheapest paths of `prepared_paths`, contact by contact, for reports that name the objects on them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.paths.prepared_paths import (
    WITHIN,
    Arrivals,
    ContactSides,
    arrivals_of,
    costs_by_hops,
    distances_m,
    least_costs,
    nearest_entries,
)
from scene2hap.scene.objects import Contact

Point = tuple[float, float, float]
_TOUCH = "\0touch"
"""Id of a point that is searched from; no object has it."""


class TracedPath(NamedTuple):
    """Objects from a source to a touch, and of each object after the source the entry point [m] and the cost up to it.

    A path may return to an object, as over a bar of steel on a rug.
    """

    objects: tuple[str, ...]
    entries_m: tuple[Point, ...]
    costs: tuple[float, ...]


class Leg(NamedTuple):
    """One object on a path after the source: where the path enters and leaves it [m], and the cost up to leaving it."""

    object_id: str
    enter_m: Point
    leave_m: Point
    cost: float


class TracedPaths:
    """The cheapest paths from sources over contacts; of equal ones, those with the fewest contacts.

    Parameters: see `cheapest_arrivals`.
    """

    def __init__(
        self,
        cost_per_m: Mapping[str, float],
        contacts: Sequence[Contact],
        crossing_cost: Sequence[float],
        source_ids: Sequence[str],
        max_hops: int | None,
    ) -> None:
        self._cost_per_m, self._rows = cost_per_m, {source_id: row for row, source_id in enumerate(source_ids)}
        self._sides = ContactSides.of(contacts, crossing_cost)
        if max_hops is None:
            self._costs, hops, self._side_before = least_costs(cost_per_m, self._sides, source_ids)
            # The number of contacts before each side on the cheapest path to it.
            self._n_before: NDArray[np.intp] = hops - 1
        else:
            self._by_hops = list(costs_by_hops(cost_per_m, self._sides, source_ids, max_hops))
            self._costs = self._by_hops[-1]
            self._n_before = np.argmax([costs <= self._costs * (1.0 + WITHIN) for costs in self._by_hops], axis=0)
        self._is_limited = max_hops is not None

    def arrivals(self, source_ids: Sequence[str]) -> dict[str, Arrivals]:
        """Return the arrivals of some sources at every object that has a cost per metre."""
        rows = [self._rows[source_id] for source_id in source_ids]
        return arrivals_of(self._cost_per_m, self._sides, self._costs[rows])

    def entered(self, object_id: str, points_m: NDArray[np.floating]) -> NDArray[np.intp]:
        """Return the side over which each source arrives at points (n_points, 3) [m] of an object, -1 without a path.

        Returns: (n_sources, n_points). A source is on itself without a path.
        """
        if object_id in self._sides.by_object and object_id in self._cost_per_m:
            return self._cheapest(object_id, points_m.astype(np.float64), self._cost_per_m[object_id])
        return np.full((len(self._rows), len(points_m)), -1, dtype=np.intp)

    def _cheapest(self, object_id: str, points_m: NDArray[np.float64], cost_per_m: float) -> NDArray[np.intp]:
        """Return the side (n_sources, n_points) over which each source arrives at points of an object, -1 for none."""
        own = self._sides.by_object[object_id]
        found = np.empty((len(self._rows), len(points_m)), dtype=np.intp)
        costs, n_before = self._costs.take(own, axis=1), self._n_before.take(own, axis=1)
        nearest_entries(
            points_m, self._sides.points_m[own // 2], cost_per_m, costs, n_before, found, np.empty(found.shape)
        )
        return np.where(found >= 0, own[found], -1)

    def path_to(self, source_id: str, object_id: str) -> TracedPath | None:
        """Return the cheapest path from a source to any point of an object, None without one."""
        if object_id not in self._sides.by_object:
            return None
        side = int(self._cheapest(object_id, np.zeros((1, 3)), 0.0)[self._rows[source_id], 0])
        return self.path(source_id, side) if side >= 0 else None

    def path(self, source_id: str, side: int) -> TracedPath:
        """Return the cheapest path from a source to the object that it enters over a side."""
        sides, n_before = np.array([*self._back(source_id, side)][::-1]).T
        owner, _, points_m, _ = self._sides
        entries_m = tuple((x, y, z) for x, y, z in points_m[sides // 2].tolist())
        row = self._rows[source_id]
        if self._is_limited:
            costs = [self._by_hops[n][row, one] for one, n in zip(sides, n_before, strict=True)]
        else:
            costs = self._costs[row, sides].tolist()
        return TracedPath((source_id, *(owner[one] for one in sides)), entries_m, tuple(map(float, costs)))

    def objects(self, source_id: str, sides: Iterable[int]) -> list[tuple[str, ...]]:
        """Return the objects from a source to each of some sides, without those between an object and a return to it.

        Empty for -1.
        """
        owner = self._sides.owner
        known: dict[tuple[int, int], tuple[str, ...]] = {}
        found: list[tuple[str, ...]] = []
        for side in sides:
            passed: tuple[str, ...] = ()
            if side >= 0:
                pending, passed = [], (source_id,)
                for node in self._back(source_id, side):
                    if node in known:
                        passed = known[node]
                        break
                    pending.append(node)
                for node in reversed(pending):
                    here = owner[node[0]]
                    passed = passed[: passed.index(here) + 1] if here in passed else (*passed, here)
                    known[node] = passed
            found.append(passed)
        return found

    def _back(self, source_id: str, side: int) -> Iterator[tuple[int, int]]:
        """Yield the sides on the cheapest path from a side back to a source, each with the contacts before it."""
        row = self._rows[source_id]
        n_before = int(self._n_before[row, side])
        yield side, n_before
        while (behind := self._sides.owner[side ^ 1]) != source_id:
            if self._is_limited:
                side, n_before = self._entry(row, side, behind, n_before), n_before - 1
            else:
                side = int(self._side_before[row, side])
                n_before = int(self._n_before[row, side])
            yield side, n_before

    def _entry(self, row: int, side: int, behind: str, n_hops: int) -> int:
        """Return the side over which the cheapest path over at most `n_hops` contacts enters the object behind one."""
        entries, points_m = self._sides.by_object[behind], self._sides.points_m
        through_m = distances_m(points_m[[side // 2]], points_m[entries // 2])[0]
        return int(entries[(self._by_hops[n_hops - 1][row, entries] + self._cost_per_m[behind] * through_m).argmin()])


class PathsToPoint:
    """The cheapest paths from all objects to one point, as if each were a source.

    A path costs the same in both directions, so that one search from the point finds all. Parameters: see
    `cheapest_arrivals`; object_id, point_m : a point of an object [m].
    """

    def __init__(
        self,
        cost_per_m: Mapping[str, float],
        contacts: Sequence[Contact],
        crossing_cost: Sequence[float],
        max_hops: int | None,
        object_id: str,
        point_m: Point,
    ) -> None:
        hops = None if max_hops is None else max_hops + 1
        touch = Contact(_TOUCH, object_id, point_m)
        self._traced = TracedPaths(cost_per_m, [*contacts, touch], [*crossing_cost, 0.0], (_TOUCH,), hops)
        self._object_id = object_id

    def legs(self, source_id: str) -> tuple[Leg, ...] | None:
        """Return the cheapest path from a source to the point, object by object after the source; None without one."""
        if source_id == self._object_id:
            return ()
        found = self._traced.path_to(_TOUCH, source_id)
        if found is None:
            return None
        _, *objects, _ = found.objects
        *costs, whole = found.costs
        rows = zip(objects, found.entries_m[1:], found.entries_m[:-1], costs, strict=True)
        return tuple(Leg(object_id, enter, leave, whole - cost) for object_id, enter, leave, cost in rows)[::-1]
