"""The path of each source to each surface point, as a list of objects, as `HapticSession.explain` reports it.

A path has the least loss by the paper's law, from the same costs as the gains. Models that resonate have no paths,
since a source arrives over all paths at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.bundle import HapticBundle
from scene2hap.propagation.controls import FullPropagation, NoPropagation
from scene2hap.propagation.exponential_plate import ExponentialPlate, PathCosts
from scene2hap.propagation.paths.traced_paths import TracedPaths
from scene2hap.report.surface_points import Patch
from scene2hap.scene.objects import Contact
from scene2hap.session.network import body_of

Path = tuple[str, ...]


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
    sources = tuple(bundle.loops)
    bodies = {key: body for key, haptics in bundle.objects.items() if (body := body_of(haptics)) is not None}
    costs = PathCosts.of(model, bodies, contacts)
    traced = TracedPaths(costs.price_per_m, contacts, costs.crossing_cost, sources, costs.max_hops)
    numbers: dict[str, dict[Path, int]] = {source: {} for source in sources}
    codes: dict[str, list[NDArray[np.uint32]]] = {source: [] for source in sources}
    for patch in patches:
        for source, entered in zip(sources, traced.entered(patch.object_id, patch.points_m), strict=True):
            sides, place = np.unique(entered, return_inverse=True)
            ways: list[Path] = [(source,)] * len(sides)
            if source != patch.object_id:
                ways = [_merged(traced.way(source, side).objects) if side >= 0 else () for side in sides.tolist()]
            known = numbers[source]
            of_sides = [known.setdefault(way, len(known)) + 1 if way else 0 for way in ways]
            codes[source].append(np.array(of_sides, np.uint32)[place.reshape(-1)])
    none = np.empty(0, np.uint32)
    return {source: SourcePaths(tuple(numbers[source]), np.concatenate([none, *codes[source]])) for source in sources}


def _merged(objects: Path) -> Path:
    """Leave out the objects between an object and a return to it."""
    merged: list[str] = []
    for passed in objects:
        merged = merged[: merged.index(passed)] if passed in merged else merged
        merged.append(passed)
    return tuple(merged)
