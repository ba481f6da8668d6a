"""Warnings of valid input that is most likely a mistake.

- Loops that were made for another actuator than the session's.
- First poses whose quaternions begin with w: an upright object, (1, 0, 0, 0) with w first, is upside down with w last.
- Touches far from the surface of their object. Almost always the point is in other units, in the object's own frame,
  or from another frame of the game.
- Added objects that will not be felt, a scene in which nothing vibrates, a user's profile for other hands.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import islice
from typing import NamedTuple

import numpy as np

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle
from scene2hap.contact.geometry.vectors import Triple
from scene2hap.contact.mesh_distance import surface_distance
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.haptics import ActuatorProfile, ObjectHaptics
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.scene_warning import warn_of
from scene2hap.session.frame import Touch
from scene2hap.session.hand_gains import Felt
from scene2hap.session.network import body_of
from scene2hap.session.scene_state import SceneState

FAR_M = 0.05
"""A finger tip is 2 cm thick, and a tracked hand is off by as much again; assumed."""

MOST_TRIANGLES = 20_000
"""Touches of larger meshes are not judged: sorting their triangles for the first touch would cost frames."""

MOST_NAMED = 10
"""Further silent objects of a session are not named: a game may spawn thousands, and Python keeps each text."""

_ANYWHERE_M = 1e9

_MOST_POSES = 100
# |cos| of half of 150 and of 30 degrees: no game turns things by more in a frame (assumed).
_FLIPS, _STAYS = 0.26, 0.966


class OtherActuatorWarning(UserWarning):
    """A session's actuator is another one than that which the bundle's loops were made for."""


class _Judged(NamedTuple):
    """Whether a touch is off: true while its point, in the object's frame, moves by at most `slack_m`."""

    item: SceneObject
    shape: Shape
    own_m: Triple
    slack_m: float
    is_off: bool


class LikelyMistakes:
    """Warns of likely mistakes in the input of a session, each kind once or a few times.

    `n_touches_off` counts the touches that are more than `FAR_M` from the surface of their object.
    """

    def __init__(self, state: SceneState) -> None:
        self._state = state
        self._judged: dict[tuple[str, str], _Judged] = {}
        self._hands_named: set[str] = set()
        self._n_silent_named = 0
        self._has_moved = self._is_silence_named = False
        self.n_touches_off = 0

    def in_moves(self, moved: Mapping[str, Pose]) -> None:
        """Warn if the first poses turn all objects over, and hardly would if their quaternions began with w.

        Call it before the objects move. Warns: SceneWarning.
        """
        if self._has_moved or not moved:
            return
        self._has_moved = True
        known, pose = self._state.objects, self._state.graph.pose
        some = [(x, new) for x, new in islice(moved.items(), _MOST_POSES) if x in known and isinstance(new, Pose)]
        if not some:
            return
        before = np.array([pose(x).rotation_xyzw for x, _ in some])
        after = np.array([new.rotation_xyzw for _, new in some])
        as_given = np.abs((before * after).sum(axis=1))
        with_w_first = np.abs((before * np.roll(after, -1, axis=1)).sum(axis=1))
        if (as_given < _FLIPS).all() and (with_w_first > _STAYS).all():
            x, new = some[0]
            parts = ", ".join(f"{part:g}" for part in new.rotation_xyzw)
            warn_of(
                f"the first poses turn all {len(some)} moved objects over, as quaternions do that begin with w: "
                f"rotation_xyzw of {x!r} is ({parts}). Make poses by Pose.from_wxyz(position_m, rotation_wxyz)."
            )

    def in_touches(self, felt: Felt) -> None:
        """Count the touches that are off, and warn of the first of each hand. Warns: SceneWarning."""
        for touches in felt.values():
            for touch in touches:
                if self._is_off(touch):
                    self.n_touches_off += 1
                    if touch.hand not in self._hands_named:
                        self._hands_named.add(touch.hand)
                        self._warn_of_touch(touch)

    def in_sources(self, source_ids: Sequence[str]) -> None:
        """Warn once if nothing vibrates. Warns: SceneWarning."""
        if not source_ids and not self._is_silence_named:
            self._is_silence_named = True
            warn_of(
                f"of {len(self._state.objects)} objects none vibrates, so that nothing but impacts will be felt; add "
                "one with loops, or bundle.override(id, vibrates=True) and rebake(bundle)."
            )

    def in_added(self, object_id: str, haptics: ObjectHaptics | None, loops: Mapping[str, HapticLoop]) -> None:
        """Warn of an added object that neither vibrates nor carries vibration, or that vibrates without loops.

        Warns: SceneWarning.
        """
        if loops or self._n_silent_named == MOST_NAMED:
            return
        if haptics is not None and haptics.vibrates:
            why, what = "of which the haptics say that it vibrates", "stays silent"
        elif body_of(haptics) is None:
            why = "of which nothing is known" if haptics is None else "of unknown material"
            what = "neither vibrates nor carries vibration"
        else:
            return
        self._n_silent_named += 1
        last = " Further silent objects are not named." if self._n_silent_named == MOST_NAMED else ""
        warn_of(
            f"{object_id!r}, {why}, is added without loops: it {what}; give haptics= and loops=, as a bundle has "
            f"them, or bake it by bake_object and add it by session.spawn.{last}"
        )

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

    def _warn_of_touch(self, touch: Touch) -> None:
        item, pose = self._state.objects[touch.object_id], self._state.graph.pose(touch.object_id)
        distance = _distance_m(shape_of(item.geometry.mesh), _to_own(pose, touch.point_m), _ANYWHERE_M)
        point = ", ".join(f"{x:g}" for x in touch.point_m)
        warn_of(
            f"hand {touch.hand!r} touches {touch.object_id!r} at ({point}), {distance or 0.0:.3g} m from its surface, "
            f"more than {FAR_M} m; point_m is in the world [m], where the object is in this frame. "
            "`session.stats.touches_off_surface` counts such touches."
        )


def warn_if_other_actuator(bundle: HapticBundle, actuator: ActuatorProfile) -> None:
    """Warn if the loops of a bundle were made for an actuator of another response.

    Limits of amplitude and power do not count: they are the safety layer's, and no loop is made by them. A bundle
    without a record of its actuator, or without loops, fits any. Warns: OtherActuatorWarning.
    """
    made_for = getattr(getattr(bundle, "made_with", None), "actuator", None)
    if not bundle.loops or not isinstance(made_for, ActuatorProfile) or _response(made_for) == _response(actuator):
        return
    warnings.warn(
        f"the bundle's loops were made for the actuator {made_for.name!r}, and this session plays on "
        f'{actuator.name!r}: give SessionConfig(actuator=...) the one in use, or rebake(bundle, {{"actuator": ...}}).',
        OtherActuatorWarning,
        stacklevel=4,
    )


def warn_if_other_hands(named: Sequence[str], own: Sequence[str]) -> None:
    """Warn if a user's profile names hands, and none of the session's. Warns: SceneWarning."""
    if named and not set(named) & set(own):
        theirs, ours = (", ".join(map(repr, hands)) for hands in (named, own))
        warn_of(f"the user's profile is for the hands {theirs}; this session has {ours}. Rename one of them.")


def _response(actuator: ActuatorProfile) -> ActuatorProfile:
    """The parts of an actuator that decide how loops are made: band and response."""
    plain = ActuatorProfile()
    return replace(
        actuator,
        name=plain.name,
        max_amplitude=plain.max_amplitude,
        max_rms=plain.max_rms,
        rms_window_s=plain.rms_window_s,
    )


def _distance_m(shape: Shape, own_m: Triple, within_m: float) -> float | None:
    """Distance of a point of an object's own frame from its surface [m], None if it is more than `within_m`."""
    return 0.0 if shape.triangles.shape[2] > MOST_TRIANGLES else surface_distance(shape, own_m, within_m)


def _to_own(pose: Pose, point_m: Triple) -> Triple:
    """`Pose.to_own` of one point, without numpy's cost per call."""
    (u, v, w), (a, b, c), (x, y, z, s) = point_m, pose.position_m, pose.rotation_xyzw
    u, v, w = u - a, v - b, w - c
    # v + 2 s (v x q) + 2 (v x q) x q, the turn by the conjugate.
    p, q, r = 2 * (v * z - w * y), 2 * (w * x - u * z), 2 * (u * y - v * x)
    return u + s * p + q * z - r * y, v + s * q + r * x - p * z, w + s * r + p * y - q * x
