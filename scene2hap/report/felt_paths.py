"""The path of each source to each surface point, as a list of objects, as `HapticSession.explain` reports it.

A path has the least loss by the paper's law, from the same costs as the gains. Models that resonate have no paths,
since a source arrives over all paths at once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.bundle import HapticBundle
from scene2hap.contact.graph import ContactGraph
from scene2hap.haptics import Bands
from scene2hap.propagation.controls import FullPropagation, NoPropagation
from scene2hap.propagation.exponential_plate import ExponentialField, ExponentialPlate, PathCosts
from scene2hap.propagation.paths.live_law import LiveLaw
from scene2hap.propagation.paths.traced_paths import TracedPaths
from scene2hap.propagation.protocol import Body, ContactNetwork, Excitation
from scene2hap.report.surface_points import Patch
from scene2hap.session.network import body_of

Path = tuple[str, ...]


@dataclass(frozen=True, eq=False)
class SourcePaths:
    """Paths of a source, each from the source to an object, and the path to each point.

    `of_points` (n_points,) uint32 over all patches in order: 0 without a path, else the path's index + 1.
    """

    objects: tuple[Path, ...]
    of_points: NDArray[np.uint32]


class ScenePaths:
    """The cheapest paths of a bundle's scene, searched once for each law: for levels in all bands, and as objects."""

    def __init__(self, bundle: HapticBundle) -> None:
        self.contacts = ContactGraph(bundle.snapshot).contacts
        self._bodies = {key: body for key, haptics in bundle.objects.items() if (body := body_of(haptics)) is not None}
        self._sources = tuple(bundle.loops)
        self._traced: dict[ExponentialPlate, TracedPaths] = {}

    def traced(self, law: ExponentialPlate) -> TracedPaths:
        """Return the cheapest paths from all sources by a law."""
        if law not in self._traced:
            costs = PathCosts.of(law, self._bodies, self.contacts)
            self._traced[law] = TracedPaths(
                costs.price_per_m, self.contacts, costs.crossing_cost, self._sources, costs.max_hops
            )
        return self._traced[law]

    def of(self, model: object, patches: Sequence[Patch]) -> dict[str, SourcePaths] | None:
        """Return the paths by source; None for models in which a source arrives over all paths at once."""
        if not isinstance(model, ExponentialPlate | NoPropagation | FullPropagation):
            return None
        traced = self.traced(model if isinstance(model, ExponentialPlate) else ExponentialPlate())
        numbers: dict[str, dict[Path, int]] = {source: {} for source in self._sources}
        codes: dict[str, list[NDArray[np.uint32]]] = {source: [] for source in self._sources}
        for patch in patches:
            for source, entered in zip(self._sources, traced.entered(patch.object_id, patch.points_m), strict=True):
                sides, place = np.unique(entered, return_inverse=True)
                ways: list[Path] = [(source,)] * len(sides)
                if source != patch.object_id:
                    ways = [_merged(traced.way(source, side).objects) if side >= 0 else () for side in sides.tolist()]
                known = numbers[source]
                of_sides = [known.setdefault(way, len(known)) + 1 if way else 0 for way in ways]
                codes[source].append(np.array(of_sides, np.uint32)[place.reshape(-1)])
        none = np.empty(0, np.uint32)
        return {
            source: SourcePaths(tuple(numbers[source]), np.concatenate([none, *codes[source]]))
            for source in self._sources
        }


@dataclass(frozen=True)
class SearchedPlate:
    """An `ExponentialPlate` whose prepared fields share one search of the scene's paths."""

    law: ExponentialPlate
    paths: ScenePaths

    def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands) -> ExponentialField:
        """See `ExponentialPlate`; the network must be that of the paths."""
        arrivals = self.paths.traced(self.law).arrivals([item.source_id for item in excitations])
        return self.law.over(arrivals, network, excitations, bands)

    def live(
        self, graph: ContactGraph, bodies: Mapping[str, Body], excitations: Sequence[Excitation], bands: Bands
    ) -> LiveLaw:
        """See `ExponentialPlate`."""
        return self.law.live(graph, bodies, excitations, bands)


def _merged(objects: Path) -> Path:
    """Leave out the objects between an object and a return to it."""
    merged: list[str] = []
    for passed in objects:
        merged = merged[: merged.index(passed)] if passed in merged else merged
        merged.append(passed)
    return tuple(merged)
