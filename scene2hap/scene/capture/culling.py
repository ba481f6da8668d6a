"""Removal of objects that hide the target of a picture.

The paper casts a ray to the object and removes all objects that the ray meets. The paper calls this a flaw, since the
object's support and neighbours, its context, may be removed as well. Here rays go to all of the target's silhouette, on
a coarse grid. An object between the eye and the target is

1. *opened*, if it is a shell (`surroundings.shells`: walls, floor, ceiling, a room in one piece). It loses only the
   faces whose plane separates the eye from the target's middle, and so keeps floor and far walls. All shells are opened
   if they hide more than `_UNCOVERED` of the other objects in the picture. So walls do not hide the room from outside,
   and the floor does not hide objects from below;
2. *kept*, if it is the target's support or near it (`surroundings.near`), and all kept objects together hide at most
   `hidden_share` of the silhouette. The support is tried first, then the objects that hide least;
3. *opened* like a shell, if rule 2 would keep it but it hides too much, and it contains the target: a cabinet around
   plates;
4. *culled*, that is left out, in all other cases: distant objects, and objects that hide too much even when opened. For
   distant objects the bound is `_REMAINDER`.

Scene pictures have no target. As in the paper, objects on the ray from the eye to the middle of the scene are culled.
Objects whose box contains that middle are kept; shells are opened by rule 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scene2hap.common.arrays import Bools, Floats
from scene2hap.scene.capture.config import CaptureConfig
from scene2hap.scene.capture.protocol import Ids, Renderer, Selection
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.surroundings import containers, near, shells
from scene2hap.scene.capture.views import Camera
from scene2hap.scene.geometry import Vector, vector

_GRID_PX = 64
"""Rays along each side of the picture, or of the target's frame, that find hiding objects (tuned: 1 ms a view)."""

_UNCOVERED = 0.05
_REMAINDER = 0.02
# Most layers of hiding objects that are searched; a target behind more layers stays hidden (assumed).
_MAX_LAYERS = 64


@dataclass(frozen=True)
class Culler:
    """Selection of the objects of each picture of a `RenderScene`; `below` : the scene's `supports`."""

    scene: RenderScene
    renderer: Renderer
    config: CaptureConfig
    below: tuple[int | None, ...]

    @cached_property
    def shells(self) -> frozenset[int]:
        """Walls, floors, ceilings and rooms."""
        return shells(self.scene)

    def around(self, target: int, close: Camera, wide: Camera) -> Selection:
        """Select the objects of the context picture `wide`; `close` has the same eye and frames only the target."""
        aim = _Aim(self, target, close.resized(_GRID_PX))
        opened = self._hiding_shells(self.shells - {target}, wide, aim.focus_m)
        blockers = aim.blockers(opened)
        beside = near(self.scene, target, self.config.near_share) | {self.below[target]}
        holders = containers(self.scene, target)
        kept, hidden = self.scene.everyone - blockers, np.zeros_like(aim.is_target)
        candidates = blockers & (self.shells | beside)
        for number in sorted(candidates, key=lambda k: (k != self.below[target], aim.hidden_by(k, False).sum(), k)):
            ways = [True] if number in self.shells else [False, True] if number in holders else [False]
            spared = self.config.hidden_share * aim.is_target.sum()
            limit = spared if number in beside else hidden.sum() + _REMAINDER * aim.is_target.sum()
            for is_opened in ways:
                together = hidden | aim.hidden_by(number, is_opened)
                if together.sum() <= limit:
                    kept, hidden = kept | {number}, together
                    opened |= {number} if is_opened else frozenset()
                    break
        return Selection(kept, opened & kept, aim.focus_m)

    def overview(self, wide: Camera) -> Selection:
        """Select the objects of a picture of the whole scene."""
        low, high = self.scene.box_m
        focus = vector((low + high) / 2)
        opened = self._hiding_shells(self.shells, wide, focus)
        culled = self._on_the_way(wide, np.asarray(focus)) - self.shells
        return Selection(self.scene.everyone - culled, opened, focus)

    def _hiding_shells(self, shells: frozenset[int], wide: Camera, focus: Vector) -> frozenset[int]:
        """Return the shells, if opening them uncovers much of the other objects in the picture; else none."""
        if not shells:
            return shells
        coarse, everyone = wide.resized(_GRID_PX), self.scene.everyone
        closed = self.renderer.identify(coarse, Selection(everyone))
        opened = self.renderer.identify(coarse, Selection(everyone, shells, focus))
        things = ~np.isin(opened, [*shells, -1])
        uncovered = things & np.isin(closed, list(shells))
        return shells if uncovered.sum() > _UNCOVERED * things.sum() else frozenset()

    def _on_the_way(self, wide: Camera, middle: Floats) -> frozenset[int]:
        """Return objects that the ray from the eye meets before the middle, except those around the middle."""
        pixel, _ = wide.project(middle[None])
        spot = wide.at_pixel(pixel[0])
        found = set()
        for number in self.scene.everyone:
            low, high = self.scene.objects[number].box_m
            if (low <= middle).all() and (middle <= high).all():
                continue
            is_on_ray = _segment_meets(low, high, wide.eye_m, middle)
            if is_on_ray and self.renderer.identify(spot, Selection(frozenset({number})))[0, 0] == number:
                found.add(number)
        return frozenset(found)


class _Aim:
    """A target in its frame, and the objects that hide its silhouette from the eye."""

    def __init__(self, culler: Culler, target: int, close: Camera) -> None:
        self._culler, self._target, self._close = culler, target, close
        self.focus_m = vector(culler.scene.objects[target].box_m.mean(axis=0))
        self.is_target = self._ids(frozenset({target})) == target
        self._masks: dict[tuple[int, bool], Bools] = {}

    def blockers(self, opened: frozenset[int]) -> frozenset[int]:
        """Return all objects between the eye and the silhouette, found layer by layer."""
        everyone = self._culler.scene.everyone
        found: frozenset[int] = frozenset()
        for _ in range(_MAX_LAYERS):
            ids = self._ids(everyone - found, opened)
            layer = frozenset(np.unique(ids[self.is_target & (ids != self._target) & (ids >= 0)]).tolist())
            if not layer:
                break
            found |= layer
        return found

    def hidden_by(self, number: int, is_opened: bool) -> Bools:
        """Return the part of the silhouette that one object alone hides."""
        key = (number, is_opened)
        if key not in self._masks:
            ids = self._ids(frozenset({number, self._target}), frozenset({number} if is_opened else ()))
            self._masks[key] = self.is_target & (ids == number)
        return self._masks[key]

    def _ids(self, shown: frozenset[int], opened: frozenset[int] = frozenset()) -> Ids:
        return self._culler.renderer.identify(self._close, Selection(shown, opened, self.focus_m))


def _segment_meets(low: Floats, high: Floats, start: Floats, end: Floats) -> bool:
    """Return True if the segment from start to end passes through a box (slab method)."""
    way = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        to_low, to_high = (low - start) / way, (high - start) / way
    enters, leaves = np.fmin(to_low, to_high).max(), np.fmax(to_low, to_high).min()
    return bool(enters <= min(leaves, 1.0) and leaves >= 0.0)
