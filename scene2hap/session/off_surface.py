"""Touches far from the surface of their object: counted, and a warning once per hand.

Almost always the point is in other units, in the object's own frame, or from another frame of the game.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from scene2hap.contact.mesh_distance import surface_distance
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.contact.vectors import Triple
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


class _Judged(NamedTuple):
    """Whether a touch is off: true while its point, in the object's frame, moves by at most `slack_m`."""

    item: SceneObject
    shape: Shape
    own_m: Triple
    slack_m: float
    is_off: bool


class OffSurface:
    """Count the touches of a scene that are more than `FAR_M` from the surface of their object, as `n_touches`."""

    def __init__(self, state: SceneState) -> None:
        self._state = state
        self._judged: dict[tuple[str, str], _Judged] = {}
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
        key, item = (touch.hand, touch.object_id), self._state.objects[touch.object_id]
        own_m = _to_own(self._state.graph.pose(touch.object_id), touch.point_m)
        judged = self._judged.get(key)
        if judged is None or judged.item is not item or math.dist(judged.own_m, own_m) > judged.slack_m:
            shape = shape_of(item.geometry.mesh) if judged is None or judged.item is not item else judged.shape
            # Twice as far as it takes, so that a point that is off has some slack too.
            distance_m = _distance_m(shape, own_m, 2 * FAR_M)
            slack_m = FAR_M if distance_m is None else abs(FAR_M - distance_m)
            judged = _Judged(item, shape, own_m, slack_m, distance_m is None or distance_m > FAR_M)
            self._judged[key] = judged
        return judged.is_off

    def _warn(self, touch: Touch) -> None:
        self._warned.add(touch.hand)
        item, pose = self._state.objects[touch.object_id], self._state.graph.pose(touch.object_id)
        distance = _distance_m(shape_of(item.geometry.mesh), _to_own(pose, touch.point_m), _ANYWHERE_M)
        point = ", ".join(f"{x:g}" for x in touch.point_m)
        warn_of(
            f"hand {touch.hand!r} touches {touch.object_id!r} at ({point}), {distance or 0.0:.3g} m from its surface, "
            f"more than {FAR_M} m; point_m is in the world [m], where the object is in this frame. "
            "`session.stats.touches_off_surface` counts such touches."
        )


def _distance_m(shape: Shape, own_m: Triple, within_m: float) -> float | None:
    """How far a point of an object's own frame is from its surface [m], None if it is more than `within_m`."""
    return 0.0 if shape.triangles.shape[2] > MOST_TRIANGLES else surface_distance(shape, own_m, within_m)


def _to_own(pose: Pose, point_m: Triple) -> Triple:
    """`Pose.to_own` of one point, without numpy's cost per call."""
    (u, v, w), (a, b, c), (x, y, z, s) = point_m, pose.position_m, pose.rotation_xyzw
    u, v, w = u - a, v - b, w - c
    # v + 2 s (v x q) + 2 (v x q) x q, the turn by the conjugate.
    p, q, r = 2 * (v * z - w * y), 2 * (w * x - u * z), 2 * (u * y - v * x)
    return u + s * p + q * z - r * y, v + s * q + r * x - p * z, w + s * r + p * y - q * x
