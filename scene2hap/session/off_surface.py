"""Touches far from the surface of their object: counted, and a warning once per hand.

Almost always the point is in other units, in the object's own frame, or from another frame of the game.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from scene2hap.contact.mesh_distance import closest_points
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.contact.vectors import Rows, Triple
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.scene_warning import warn_of
from scene2hap.session.frame import Touch
from scene2hap.session.hand_gains import Felt
from scene2hap.session.scene_state import SceneState

FAR_M = 0.05
"""A finger tip is 2 cm thick, and a tracked hand is off by as much again; assumed."""

MOST_TRIANGLES = 20_000
"""Touches of larger meshes are not judged: sorting their triangles for the first touch would cost frames."""

_ANYWHERE_M = 1e9
_POINT = Shape(np.zeros((3, 3, 1)), np.zeros((1, 3)))  # a triangle without extent
_NOT_TURNED: Rows = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


class _Seen(NamedTuple):
    """What was found of a touch: it holds while the object stays and the point moves by less than `slack_m`."""

    item: SceneObject
    pose: Pose
    point_m: Triple
    slack_m: float
    is_off: bool


class OffSurface:
    """Count the touches of a scene that are more than `FAR_M` from the surface of their object, as `n_touches`."""

    def __init__(self, state: SceneState) -> None:
        self._state = state
        self._seen: dict[tuple[str, str], _Seen] = {}
        self._warned: set[str] = set()
        self.n_touches = 0

    def look(self, felt: Felt) -> None:
        """Count the touches of a frame, and warn of the first of a hand. Warns: SceneWarning."""
        for touches in felt.values():
            for touch in touches:
                if self._is_off(touch):
                    self.n_touches += 1
                    if touch.hand not in self._warned:
                        self._warn(touch)

    def _is_off(self, touch: Touch) -> bool:
        key, item, point = (touch.hand, touch.object_id), self._state.objects[touch.object_id], touch.point_m
        pose = self._state.graph.pose(touch.object_id)
        seen = self._seen.get(key)
        if seen is None or not (
            seen.item is item and seen.pose is pose and math.dist(seen.point_m, point) <= seen.slack_m
        ):
            distance = _distance_m(item, pose, point, FAR_M)
            slack = 0.0 if distance is None else FAR_M - distance
            seen = self._seen[key] = _Seen(item, pose, point, slack, distance is None)
        return seen.is_off

    def _warn(self, touch: Touch) -> None:
        self._warned.add(touch.hand)
        item, pose = self._state.objects[touch.object_id], self._state.graph.pose(touch.object_id)
        distance = _distance_m(item, pose, touch.point_m, _ANYWHERE_M)
        point = ", ".join(f"{x:g}" for x in touch.point_m)
        warn_of(
            f"hand {touch.hand!r} touches {touch.object_id!r} at ({point}), {distance or 0.0:.3g} m from its surface, "
            f"more than {FAR_M} m; point_m is in the world [m], where the object is in this frame. "
            "`session.stats.touches_off_surface` counts such touches."
        )


def _distance_m(item: SceneObject, pose: Pose, point_m: Triple, within_m: float) -> float | None:
    """The distance of a point from the surface of an object [m], None if it is more than `within_m`."""
    if len(item.geometry.mesh.faces) > MOST_TRIANGLES:
        return 0.0
    x, y, z = pose.to_own([point_m])[0].tolist()
    found = closest_points(shape_of(item.geometry.mesh), _POINT, _NOT_TURNED, (x, y, z), within_m)
    return None if found is None else found[0]
