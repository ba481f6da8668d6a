"""Input of propagation models from a scene and its bundle: bodies, their poses, and excitations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle.override import USER
from scene2hap.haptics import ObjectHaptics
from scene2hap.propagation.plate import Plate, RigidBody
from scene2hap.propagation.protocol import Body, Excitation
from scene2hap.scene.geometry import Vector
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import DominantSurface
from scene2hap.scene.surface.outline import Outline

UNKNOWN_MASS_KG = 1.0
"""Mass of a source without known mass and material."""

UNKNOWN_DENSITY_KG_M3 = 200.0
"""Mass over volume of the box around a striking object of unknown mass and material: a chair has some 60, a mug 500, a
phone 2,000; assumed."""
LEAST_MASS_KG = 1e-3
"""Mass of a striking sheet, whose box has no volume: a feather or a card; assumed."""

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
    """Whether an object is furniture whose material no person chose; a chosen material keeps its loss factor."""
    head = haptics.object_category.lower().rpartition(" ")[2]
    return head in HEAD_NOUNS and haptics.provenance.get("material") != USER


def body_of(haptics: ObjectHaptics | None, surface: DominantSurface | None = None) -> Plate | None:
    """The plate of an object whose material and thickness are known, within the outline of its surface, if given.

    Furniture gets at least the loss factor of assembled furniture, unless a person chose its material.
    """
    if haptics is None or haptics.material is None or not all(edge > 0 for edge in haptics.estimated_size_m):
        return None
    material = haptics.material
    if material.loss_factor < ASSEMBLED_LOSS and is_assembled(haptics):
        material = replace(material, loss_factor=ASSEMBLED_LOSS)
    length_m, width_m, thickness_m = haptics.estimated_size_m
    if surface is None or surface.outline is None:
        plate = Plate(length_m, width_m, thickness_m, material)
    else:
        # A correction of the rectangle's size holds for the outline as well.
        scale = length_m / surface.length_m, width_m / surface.width_m
        plate = Plate.of_outline(_scaled(surface.outline, scale), thickness_m, material)
    is_estimate = haptics.provenance.get("mass_kg", USER) not in _WEIGHED
    mass_kg = haptics.mass_kg
    if mass_kg is not None and is_estimate and haptics.provenance.get("estimated_size_m") == USER:
        mass_kg = max(mass_kg, plate.mass_kg)  # A person's thickness outranks an estimate of the mass.
    return replace(plate, object_mass_kg=mass_kg, mass_is_estimate=is_estimate, feet=haptics.feet)


@lru_cache(maxsize=1024)
def _scaled(outline: Outline, scale: tuple[float, float]) -> Outline:
    return outline if scale == (1.0, 1.0) else outline.placed(scale, (0.0, 0.0))


Corners = dict[str, tuple[Pose, SceneObject, Body, Pose]]
"""By object: its pose, object and body when the corner of its plate was computed, and the pose of that corner."""


class PlatePoses(Mapping[str, Pose]):
    """Poses of the corners of the objects' plates, each computed on first access.

    A model needs few of them, in its own thread. `corners` is a cache for several scene states: the corner of an object
    that did not move is not computed again. Threads may share it, since each entry states the pose that it is for.
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


class BoxCentres(Mapping[str, Vector]):
    """Centres of the boxes around all objects [m], world, each computed on access."""

    def __init__(self, objects: Mapping[str, SceneObject], poses: Mapping[str, Pose]) -> None:
        self._objects, self._poses = objects, poses

    def __getitem__(self, object_id: str) -> Vector:
        ((x, y, z),) = self._poses[object_id].to_world([own_middle_m(self._objects[object_id])]).tolist()
        return x, y, z

    def __iter__(self) -> Iterator[str]:
        return iter(self._objects)

    def __len__(self) -> int:
        return len(self._objects)


def own_middle_m(item: SceneObject) -> Vector:
    """Middle of the box around an object, in its own frame [m]."""
    (a, b, c), (d, e, f) = item.geometry.mesh.bounds_m.tolist()
    return (a + d) / 2, (b + e) / 2, (c + f) / 2


def own_half_m(item: SceneObject) -> Vector:
    """Half the sides of the box around an object along the axes of its own frame [m]."""
    (a, b, c), (d, e, f) = item.geometry.mesh.bounds_m.tolist()
    return (d - a) / 2, (e - b) / 2, (f - c) / 2


@lru_cache(maxsize=4096)
def _corner(surface: DominantSurface, length_m: float, width_m: float, *, has_outline: bool = False) -> Pose:
    """Pose of a plate's corner. A plate of corrected size keeps the middle of the measured surface or outline."""
    x, y = surface.length_m, surface.width_m
    if has_outline and surface.outline is not None:
        x0, y0, x1, y1 = surface.outline.box_m
        x, y = x0 + x1, y0 + y1
    return surface.pose.compose(Pose(((x - length_m) / 2, (y - width_m) / 2, 0.0)))


def rigid_body_of(item: SceneObject, haptics: ObjectHaptics | None) -> RigidBody:
    """The body in an impact of an object of unknown material: as heavy as it is known to be, or as its box suggests.

    A feather is no hammer, also if nobody says what it is made of.
    """
    known_kg = item.mass_kg if haptics is None or haptics.mass_kg is None else haptics.mass_kg
    if known_kg is not None:
        return RigidBody(known_kg)
    low, high = item.geometry.mesh.bounds_m
    return RigidBody(max(UNKNOWN_DENSITY_KG_M3 * float(np.prod(high - low)), LEAST_MASS_KG))


def excitations_of(
    loops: Iterable[tuple[str, HapticLoop]], bodies: Mapping[str, Body], haptics: Mapping[str, ObjectHaptics]
) -> tuple[Excitation, ...]:
    """One excitation per loop, each given with the id of its source, in their order."""
    return tuple(
        [
            _excitation(x, loop.frequency_raw_hz, loop.frequency_tactile_hz, _mass_kg(bodies.get(x), haptics.get(x)))
            for x, loop in loops
        ]
    )


def _mass_kg(body: Body | None, haptics: ObjectHaptics | None) -> float:
    if body is not None:
        return body.moving_mass_kg
    return UNKNOWN_MASS_KG if haptics is None or haptics.mass_kg is None else haptics.mass_kg


# Cached: adding or removing a source does not change the others, and making an excitation checks its numbers.
_excitation = lru_cache(maxsize=1024)(Excitation)
