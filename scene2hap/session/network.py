"""Input of propagation models from a scene and its bundle: bodies, their poses, and excitations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

from scene2hap.bundle.override import USER
from scene2hap.haptics import ObjectHaptics
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import Body, Excitation
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import DominantSurface
from scene2hap.scene.surface.outline import Outline
from scene2hap.session.sources import LoopRow

UNKNOWN_MASS_KG = 1.0
"""Mass of a source without known mass and material."""

ASSEMBLED_LOSS = 0.04
"""Loss factor of assembled furniture, 0.03 to 0.06; assumed."""

_HEAD_NOUNS = (
    "armchair bed bench bookcase bookshelf cabinet chair closet commode cot counter couch crib cupboard desk door "
    "drawer dresser island locker nightstand rack recliner shelf shelves sideboard sofa stand stool table vanity "
    "wardrobe workbench"
)
HEAD_NOUNS = frozenset(_HEAD_NOUNS.split())
"""The last words of categories that are furniture."""

_WEIGHED = frozenset({USER, "scene"})
"""Origins of a mass that is no estimate."""


def is_assembled(haptics: ObjectHaptics) -> bool:
    """Whether an object is furniture whose material no person chose; a chosen material keeps its own loss."""
    head = haptics.object_category.lower().rpartition(" ")[2]
    return head in HEAD_NOUNS and haptics.provenance.get("material") != USER


def body_of(haptics: ObjectHaptics | None, surface: DominantSurface | None = None) -> Plate | None:
    """The plate of an object whose material and thickness are known, within the outline of its surface, if given.

    Furniture loses as much as assembled furniture does, unless a person chose its material.
    """
    if haptics is None or haptics.material is None or not all(edge > 0 for edge in haptics.estimated_size_m):
        return None
    material = haptics.material
    if material.loss_factor < ASSEMBLED_LOSS and is_assembled(haptics):
        material = replace(material, loss_factor=ASSEMBLED_LOSS)
    length_m, width_m, thickness_m = haptics.estimated_size_m
    others: dict[str, Any] = {
        "object_mass_kg": haptics.mass_kg,
        "mass_is_estimate": haptics.provenance.get("mass_kg", USER) not in _WEIGHED,
        "feet": haptics.feet,
    }
    if surface is None or surface.outline is None:
        return Plate(length_m, width_m, thickness_m, material, **others)
    # A correction of the rectangle's size holds for the outline as well.
    scale = length_m / surface.length_m, width_m / surface.width_m
    outline = _scaled(surface.outline, scale)
    return Plate.of_outline(outline, thickness_m, material, **others)


@lru_cache(maxsize=1024)
def _scaled(outline: Outline, scale: tuple[float, float]) -> Outline:
    return outline if scale == (1.0, 1.0) else outline.placed(scale, (0.0, 0.0))


Corners = dict[str, tuple[Pose, SceneObject, Body, Pose]]
"""By object: its pose, object and body when the corner of its plate was computed, and the pose of that corner."""


class PlatePoses(Mapping[str, Pose]):
    """Poses of the corners of the objects' plates, each computed on first access.

    A model needs a few of many, in its own thread. `corners` is kept from state to state: the corner of an object that
    did not move is not computed again. Threads may share it, since each entry states the pose that it holds for.
    """

    def __init__(
        self,
        objects: Mapping[str, SceneObject],
        bodies: Mapping[str, Body],
        poses: Mapping[str, Pose],
        corners: Corners | None = None,
    ) -> None:
        self._objects, self._bodies, self._poses = objects, bodies, poses
        self._known: dict[str, Pose] = {}
        self._corners = {} if corners is None else corners

    def __getitem__(self, object_id: str) -> Pose:
        found = self._known.get(object_id)
        if found is None:
            body = self._bodies[object_id]
            if not isinstance(body, Plate):
                raise KeyError(object_id)
            pose, item, last = self._poses[object_id], self._objects[object_id], self._corners.get(object_id)
            if last is None or last[0] is not pose or last[1] is not item or last[2] is not body:
                corner = _corner(item.surface, body.length_m, body.width_m, has_outline=body.outline is not None)
                last = self._corners[object_id] = (pose, item, body, pose.compose(corner))
            found = self._known[object_id] = last[3]
        return found

    def __contains__(self, object_id: object) -> bool:
        return isinstance(object_id, str) and isinstance(self._bodies.get(object_id), Plate)

    def __iter__(self) -> Iterator[str]:
        return (object_id for object_id, body in self._bodies.items() if isinstance(body, Plate))

    def __len__(self) -> int:
        return sum(1 for _ in self)


@lru_cache(maxsize=4096)
def _corner(surface: DominantSurface, length_m: float, width_m: float, *, has_outline: bool = False) -> Pose:
    """Pose of a plate's corner. A plate of corrected size keeps the middle of the measured surface or outline."""
    x, y = surface.length_m, surface.width_m
    if has_outline and surface.outline is not None:
        x0, y0, x1, y1 = surface.outline.box_m
        x, y = x0 + x1, y0 + y1
    return surface.pose.compose(Pose(((x - length_m) / 2, (y - width_m) / 2, 0.0)))


def excitations_of(
    rows: Iterable[LoopRow], bodies: Mapping[str, Body], haptics: Mapping[str, ObjectHaptics]
) -> tuple[Excitation, ...]:
    """One excitation per source, in their order."""
    return tuple(
        [
            _excitation(
                row.source_id,
                row.loop.frequency_raw_hz,
                row.loop.frequency_tactile_hz,
                _mass_kg(bodies.get(row.source_id), haptics.get(row.source_id)),
            )
            for row in rows
        ]
    )


def _mass_kg(body: Body | None, haptics: ObjectHaptics | None) -> float:
    if body is not None:
        return body.moving_mass_kg
    return UNKNOWN_MASS_KG if haptics is None or haptics.mass_kg is None else haptics.mass_kg


# Sources that come and go one by one leave the others as they were, and an excitation checks its numbers.
_excitation = lru_cache(maxsize=1024)(Excitation)
