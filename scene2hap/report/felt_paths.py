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
from scene2hap.propagation.exponential_plate import ExponentialPlate, PathCosts, PreparedLaw
from scene2hap.propagation.paths.live_law import LiveLaw
from scene2hap.propagation.paths.traced_paths import TracedPaths
from scene2hap.propagation.protocol import Body, ContactNetwork, Excitation
from scene2hap.report.surface_points import Patch
from scene2hap.scene.objects import Contact
from scene2hap.session.present_scene.network import body_of

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
        self.contacts: tuple[Contact, ...] = ContactGraph(bundle.snapshot).contacts
        self._bodies = {key: body for key, haptics in bundle.objects.items() if (body := body_of(haptics)) is not None}
        self._sources = tuple(bundle.loops)
        self._traced: dict[ExponentialPlate, TracedPaths] = {}

    def traced(self, law: ExponentialPlate) -> TracedPaths:
        """Return the cheapest paths from all sources by a law."""
        if law not in self._traced:
            costs = PathCosts.of(law, self._bodies, self.contacts)
            self._traced[law] = TracedPaths(
                costs.cost_per_m, self.contacts, costs.crossing_cost, self._sources, costs.max_hops
            )
        return self._traced[law]

    def of(self, model: object, patches: Sequence[Patch]) -> dict[str, SourcePaths] | None:
        """Return the paths by source; None for models in which a source arrives over all paths at once."""
        if not isinstance(model, ExponentialPlate | NoPropagation | FullPropagation):
            return None
        traced = self.traced(model if isinstance(model, ExponentialPlate) else ExponentialPlate())
        none = np.empty((len(self._sources), 0), np.intp)
        entered = np.concatenate(
            [none, *(traced.entered(patch.object_id, patch.points_m) for patch in patches)], axis=1
        )
        number = {patch.object_id: k for k, patch in enumerate(patches)}
        of_points = np.repeat(np.arange(len(patches)), [len(patch.points_m) for patch in patches])
        return {
            source: _numbered(traced, source, sides, of_points, number.get(source, -1))
            for source, sides in zip(self._sources, entered, strict=True)
        }


def _numbered(
    traced: TracedPaths, source: str, sides: NDArray[np.intp], patches: NDArray[np.intp], own: int
) -> SourcePaths:
    """Number the paths of a source, patch by patch.

    Parameters: sides, patches (n_points,) : the side over which the source enters each point's object, -1 without a
    path, and the number of its patch; own : that of the source's patch, -1 without one.
    """
    n_each = int(sides.max(initial=0)) + 2
    used, place = np.unique(patches * n_each + sides + 1, return_inverse=True)
    on_source = (used // n_each == own).tolist()
    ways = traced.objects(source, (used % n_each - 1).tolist())
    numbers: dict[Path, int] = {}
    codes = [
        numbers.setdefault((source,) if is_own else way, len(numbers)) + 1 if way or is_own else 0
        for way, is_own in zip(ways, on_source, strict=True)
    ]
    return SourcePaths(tuple(numbers), np.array(codes, np.uint32)[place.reshape(-1)])


@dataclass(frozen=True)
class SearchedPlate:
    """An `ExponentialPlate` whose prepared fields share one search of the scene's paths."""

    law: ExponentialPlate
    paths: ScenePaths

    def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands) -> PreparedLaw:
        """See `ExponentialPlate`; the network must be that of the paths."""
        arrivals = self.paths.traced(self.law).arrivals([item.source_id for item in excitations])
        return self.law.over(arrivals, network, excitations, bands)

    def live(
        self, graph: ContactGraph, bodies: Mapping[str, Body], excitations: Sequence[Excitation], bands: Bands
    ) -> LiveLaw:
        """See `ExponentialPlate`."""
        return self.law.live(graph, bodies, excitations, bands)
