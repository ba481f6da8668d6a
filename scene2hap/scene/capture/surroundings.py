"""Spatial relations of the objects of a `RenderScene`: supports, neighbours, containers, walls and rooms.

All relations but supports are computed from AABBs, in milliseconds and without a renderer.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats, Floats32
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.copies import copy_key
from scene2hap.scene.geometry import distances, heights_at
from scene2hap.scene.objects import VERTICAL, SceneObject

# Least extent of a shell, greatest thickness of a wall by its height, and greatest distance of a wall from the scene's
# boundary. The first and last are shares of the scene's extent (assumed).
_SHELL_SPAN, _THIN, _RIM = 0.6, 0.15, 0.1
# A container holds at least this share of an object's box, like a cabinet around plates (assumed).
_CONTAINED = 0.9
# Supports are searched below a grid of this many points a side, with this margin in the footprint (assumed).
_FEET, _INSET = 5, 0.1
# An object may be sunk into its support by this share of its height (assumed; in real scenes overlaps are as frequent
# as gaps).
_SUNK = 0.2


def shells(scene: RenderScene) -> frozenset[int]:
    """Return walls, floors, ceilings and rooms.

    A shell spans `_SHELL_SPAN` of the scene along two axes, or is a piece of wall. A piece of wall spans this share of
    the scene's height, is thin, and is at the scene's boundary.
    """
    up = VERTICAL[scene.up_axis]
    low, high = scene.box_m
    extent = np.maximum(high - low, 1e-12)
    found = set()
    for number, item in enumerate(scene.objects):
        size = np.ptp(item.box_m, axis=0)
        is_spanning = size >= _SHELL_SPAN * extent
        is_thin = size <= _THIN * size[up]
        is_at_rim = (item.box_m[1] <= low + _RIM * extent) | (item.box_m[0] >= high - _RIM * extent)
        is_at_rim[up] = False
        if is_spanning.sum() >= 2 or (is_spanning[up] and (is_thin & is_at_rim).any()):
            found.add(number)
    return frozenset(found)


def near(scene: RenderScene, target: int, share: float) -> frozenset[int]:
    """Return the objects whose box is within `share` of the target's diagonal from the target's box."""
    reach = share * scene.objects[target].diagonal_m
    return frozenset(np.flatnonzero(distances(scene.boxes_m, scene.boxes_m[target]) <= reach).tolist()) - {target}


def containers(scene: RenderScene, target: int) -> frozenset[int]:
    """Return the objects whose box contains nearly all of the target's box."""
    low, high = scene.boxes_m[target]
    common = np.minimum(scene.boxes_m[:, 1], high) - np.maximum(scene.boxes_m[:, 0], low)
    # Along an axis without extent, a flat target is either inside or outside.
    extent = high - low
    share = np.where(extent > 0, common / np.where(extent > 0, extent, 1.0), common >= 0)
    return frozenset(np.flatnonzero(np.clip(share, 0.0, 1.0).prod(axis=1) >= _CONTAINED).tolist()) - {target}


class _Faces(NamedTuple):
    """Triangles (m, 3, 3) of an object, with two level coordinates and the height, and their boxes (m, 3)."""

    triangles: Floats32
    low: Floats32
    high: Floats32

    def heights_under(self, feet: Floats, below: float) -> Floats:
        """Return the highest point at or below `below` at each foot (n, 2), -inf if there is none."""
        reaches = (self.high[:, :2] >= feet.min(axis=0)) & (self.low[:, :2] <= feet.max(axis=0))
        near = self.triangles[reaches.all(axis=1) & (self.low[:, 2] <= below)]
        heights = heights_at(feet, near.astype(np.float64))
        highest: Floats = np.where(heights <= below, heights, -np.inf).max(axis=1, initial=-np.inf)
        return highest


def supports(scene: RenderScene) -> tuple[int | None, ...]:
    """Return the support of each object: the first object below most of its footprint; None for none."""
    up = VERTICAL[scene.up_axis]
    order = [*(axis for axis in range(3) if axis != up), up]
    turned = [item.triangles_m[:, :, order] for item in scene.objects]
    faces = [_Faces(each, each.min(axis=1), each.max(axis=1)) for each in turned]
    boxes = scene.boxes_m[:, :, order]
    return tuple(_support(faces, boxes, number) for number in range(len(faces)))


def _support(faces: Sequence[_Faces], boxes: Floats, number: int) -> int | None:
    low, high = boxes[number]
    part = np.linspace(_INSET, 1 - _INSET, _FEET)
    size = high - low
    # One side is a little shorter, so that no point is on the diagonal of an authored quad.
    u, v = np.meshgrid(low[0] + 0.993 * part * size[0], low[1] + part * size[1])
    feet = np.stack((u.ravel(), v.ravel()), axis=1)
    below = low[2] + _SUNK * size[2]
    is_under = (boxes[:, 1, :2] >= low[:2]).all(axis=1) & (boxes[:, 0, :2] <= high[:2]).all(axis=1)
    is_under &= boxes[:, 0, 2] <= below
    is_under[number] = False
    best, met = np.full(len(feet), -np.inf), np.full(len(feet), -1)
    for other in np.flatnonzero(is_under).tolist():
        heights = faces[other].heights_under(feet, below)
        met = np.where(heights > best, other, met)
        best = np.maximum(heights, best)
    found = met[met >= 0]
    return int(np.bincount(found).argmax()) if len(found) else None


def holders(scene: RenderScene, below: Sequence[int | None], share: float) -> tuple[frozenset[int], ...]:
    """Return, for each object that does not stand on its support, the objects near it (`near`); else none.

    A picture frame hangs on one of these, and the floor far below it says nothing about where it hangs.
    """
    beside = (near(scene, number, share) for number in range(len(scene.objects)))
    return tuple(frozenset() if under in by else by for under, by in zip(below, beside, strict=True))


class Copies:
    """The groups of objects that share pictures.

    Objects of one `instance_key` share isolated images, even if their names differ. The first object in scene order is
    rendered, at its rotation. A *context class* is the kind of an object (`copy_key`) together with the kind of its
    support (`supports`) and the kinds of what may hold it (`holders`). Objects of one class share the context images of
    their first object, with its surroundings. An object without a key has pictures of its own.
    """

    def __init__(
        self,
        objects: Sequence[SceneObject],
        below: Sequence[int | None],
        held_by: Sequence[frozenset[int]],
        share: bool,
    ) -> None:
        keys = [item.instance_key if share and item.instance_key else f"id {item.id}" for item in objects]
        kinds = [copy_key(item) if share else ("id", item.id) for item in objects]
        classes = [
            (kind, None if under is None else kinds[under], frozenset(kinds[other] for other in beside))
            for kind, under, beside in zip(kinds, below, held_by, strict=True)
        ]
        first_of_key: dict[str, str] = {}
        first_of_class: dict[Hashable, str] = {}
        for item, key, among in zip(objects, keys, classes, strict=True):
            first_of_key.setdefault(key, item.id)
            first_of_class.setdefault(among, item.id)
        self.isolated: dict[str, str] = {item.id: first_of_key[key] for item, key in zip(objects, keys, strict=True)}
        self.context: dict[str, str] = {
            item.id: first_of_class[among] for item, among in zip(objects, classes, strict=True)
        }
