"""The path of each source to each surface point, as a list of objects, as `HapticSession.explain` reports it.

A path has the least loss by the paper's law, from the same costs as the gains. Models that resonate have no paths,
since a source arrives over all paths at once.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.bundle import HapticBundle
from scene2hap.propagation.controls import FullPropagation, NoPropagation
from scene2hap.propagation.exponential_plate import ExponentialPlate, price_per_m
from scene2hap.propagation.paths.prepared_paths import Arrivals, cheapest_arrivals
from scene2hap.report.surface_points import Patch
from scene2hap.scene.objects import Contact
from scene2hap.session.network import body_of

Path = tuple[str, ...]
_WITHIN = 1e-12
"""Relative error within which two sums of the same costs are equal."""


@dataclass(frozen=True, eq=False)
class SourcePaths:
    """Paths of a source, each from the source to an object, and the path to each point.

    `of_points` (n_points,) uint32 over all patches in order: 0 without a path, else the path's index + 1.
    """

    objects: tuple[Path, ...]
    of_points: NDArray[np.uint32]


def paths_of(
    bundle: HapticBundle, model: object, contacts: Sequence[Contact], patches: Sequence[Patch]
) -> dict[str, SourcePaths] | None:
    """Return the paths by source; None for models in which a source arrives over all paths at once."""
    if not isinstance(model, ExponentialPlate | NoPropagation | FullPropagation):
        return None
    law = model if isinstance(model, ExponentialPlate) else ExponentialPlate()
    search = _Search(bundle, law, contacts)
    n_points = sum(len(patch.points_m) for patch in patches)
    found = {source: (dict[Path, int](), np.zeros(n_points, np.uint32)) for source in bundle.loops}
    start = 0
    for patch in patches:
        end = start + len(patch.points_m)
        for source, entered in search.entered(patch).items():
            numbers, of_points = found[source]
            sides, place = np.unique(entered, return_inverse=True)
            ways = [() if side < 0 else search.path(source, side, patch.object_id) for side in sides.tolist()]
            codes = [numbers.setdefault(way, len(numbers)) + 1 if way else 0 for way in ways]
            of_points[start:end] = np.array(codes, np.uint32)[place.reshape(-1)]
        start = end
    return {source: SourcePaths(tuple(numbers), of_points) for source, (numbers, of_points) in found.items()}


class _Search:
    """Search for the cheapest paths over contacts, by the number of crossed contacts.

    A contact has two sides: side 2 i is on its object a, side 2 i + 1 on b, as in `propagation.paths.prepared_paths`.
    """

    def __init__(self, bundle: HapticBundle, law: ExponentialPlate, contacts: Sequence[Contact]) -> None:
        self._sources = tuple(bundle.loops)
        bodies = {key: body_of(haptics) for key, haptics in bundle.objects.items()}
        self._price = {key: price_per_m(body) for key, body in bodies.items() if body is not None}
        self._contacts = contacts
        self._owner = [owner for contact in contacts for owner in (contact.a, contact.b)]
        self._sides: dict[str, list[int]] = defaultdict(list)
        for side, owner in enumerate(self._owner):
            self._sides[owner].append(side)
        crossing = [law.crossing_cost(contact.weight) for contact in contacts]
        self._by_hops = self._searched(crossing, law.max_hops)
        final = self._by_hops[-1] * (1.0 + _WITHIN)
        self._hops: NDArray[np.intp] = np.argmax([costs <= final for costs in self._by_hops], axis=0)
        """Number of contacts crossed before each side (n_sources, n_sides), on the cheapest path to it."""
        self._chains: dict[tuple[int, int, int], Path] = {}

    def _searched(self, crossing: Sequence[float], max_hops: int | None) -> list[NDArray[np.float64]]:
        """Return the cost (n_sources, n_sides) of arriving over each side with at most 1, 2, ... contacts.

        The list ends when no cost decreases any more.
        """
        found: list[NDArray[np.float64]] = []
        while max_hops is None or len(found) < max_hops:
            arrivals = cheapest_arrivals(self._price, self._contacts, crossing, self._sources, len(found) + 1)
            costs = self._by_side(arrivals)
            if found and np.array_equal(found[-1], costs):
                break
            found.append(costs)
        return found

    def _by_side(self, arrivals: Mapping[str, Arrivals]) -> NDArray[np.float64]:
        costs = np.full((len(self._sources), len(self._owner)), np.inf)
        for object_id, arriving in arrivals.items():
            costs[:, self._sides[object_id]] = arriving.costs
        return costs

    def entered(self, patch: Patch) -> dict[str, NDArray[np.int64]]:
        """Return, for each source, the side over which it arrives at each point (n_points,); -1 if it does not."""
        n_points = len(patch.points_m)
        none = np.full(n_points, -1, np.int64)
        sides = np.array(self._sides.get(patch.object_id, ()), np.int64)
        if patch.object_id not in self._price or not len(sides):
            return dict.fromkeys(self._sources, none) | self._own(patch)
        points_m = np.array([self._contacts[side // 2].point_m for side in sides])
        apart_m = np.linalg.norm(patch.points_m[:, None, :].astype(np.float64) - points_m, axis=2)
        within = self._price[patch.object_id] * apart_m
        found = {}
        for row, source in enumerate(self._sources):
            total = within + self._by_hops[-1][row, sides]
            least = total.min(axis=1, keepdims=True)
            # Several contacts may be at one point: among paths of equal cost, take the one with the fewest contacts.
            best = np.where(total <= least * (1.0 + _WITHIN), self._hops[row, sides], np.inf).argmin(axis=1)
            found[source] = np.where(np.isfinite(least[:, 0]), sides[best], -1)
        return found | self._own(patch)

    def _own(self, patch: Patch) -> dict[str, NDArray[np.int64]]:
        """Return side 0 for a source on itself, where it needs no contact; the value has no further meaning."""
        return {x: np.zeros(len(patch.points_m), np.int64) for x in self._sources if x == patch.object_id}

    def path(self, source: str, side: int, object_id: str) -> Path:
        """Return the objects from a source to the object that it enters over a side. If a path returns to an object,
        the objects in between are left out."""
        if source == object_id:
            return (source,)
        row = self._sources.index(source)
        merged: list[str] = []
        for passed in self._chain(row, side, int(self._hops[row, side])):
            merged = merged[: merged.index(passed)] if passed in merged else merged
            merged.append(passed)
        return tuple(merged)

    def _chain(self, row: int, side: int, hops: int) -> Path:
        """Return the objects up to the owner of a side, with at most `hops` contacts before the last one."""
        key = row, side, hops
        if key not in self._chains:
            behind, here = self._owner[side ^ 1], self._owner[side]
            before: Path = (behind,)
            if behind != self._sources[row]:
                sides = np.array(self._sides[behind])
                leave = np.array(self._contacts[side // 2].point_m)
                entries = np.array([self._contacts[one // 2].point_m for one in sides])
                way = self._price[behind] * np.linalg.norm(entries - leave, axis=1)
                best = int((self._by_hops[hops - 1][row, sides] + way).argmin())
                before = self._chain(row, int(sides[best]), hops - 1)
            self._chains[key] = (*before, here)
        return self._chains[key]
