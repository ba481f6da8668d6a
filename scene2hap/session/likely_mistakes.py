"""Warnings about valid input that is most likely a mistake.

- Loops that were made for another actuator than the session's, corrections that wait for a `rebake`.
- First poses whose quaternions begin with w: (1, 0, 0, 0) is upright with w first, and upside down with w last.
- Contacts of an engine whose normals point from `b` to `a`: nothing would land.
- Touches, strikes and points of `would_feel` far from the box around their object. Almost always the point is in other
  units, in the object's own frame, or from another frame of the game.
- Added objects that will not be felt, a scene in which nothing vibrates, a user's profile for other hands.
- A sink that is never started, or has no device.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import islice

import numpy as np

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle
from scene2hap.bundle.pending_corrections import (
    objects_with_other_loops,
    objects_without_loops,
    objects_without_states,
    renamed_objects,
)
from scene2hap.common.counted import counted, first_of
from scene2hap.common.warning import warn_of
from scene2hap.haptics import ActuatorProfile, ObjectHaptics
from scene2hap.scene.geometry import Vector
from scene2hap.scene.objects import Contact
from scene2hap.scene.plausibility.contact_normals import are_reversed
from scene2hap.scene.pose import Pose, in_own
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session.frame import Touch, TouchesByHand
from scene2hap.session.mix.output import NOT_STARTED
from scene2hap.session.present_scene.network import body_of
from scene2hap.session.present_scene.scene_state import SceneState

FAR_M = 0.05
"""A finger tip is 2 cm thick, and the tracking error of a hand is as large; assumed."""

LOOKED_AT = 16
"""Number of first updates with touches that are checked. Later, one in this many is checked, since a game that gives
wrong points continues to do so."""

MOST_NAMED = 10
"""Most objects that a session names: a game may spawn thousands, and Python stores the text of each warning."""

UNPLAYED = 50
"""Updates with touches before a sink that was never started is named: a second of a slow game. A game may update a few
times before it starts the sink."""

_MOST_POSES = 100
# |cos| of half of 150 and of 30 degrees: no game rotates objects by more in a frame (assumed).
_FLIPS, _STAYS = 0.26, 0.966


class OtherActuatorWarning(UserWarning):
    """The bundle's loops were made for another actuator than the session's."""


class LikelyMistakes:
    """Warns of likely mistakes in the input of a session, each kind once or a few times.

    `n_touches_off` counts the checked touches that are more than `FAR_M` off the box around their object.
    """

    def __init__(self, state: SceneState) -> None:
        self._state = state
        self._hands_named: set[str] = set()
        self._n_updates = 0
        self._n_silent_named = 0
        self._n_unplayed = 0
        self._has_moved = self._is_silence_named = self._knows_normals = self._is_strike_named = False
        self._is_sink_named = self._is_point_named = False
        self.n_touches_off: int = 0

    def in_moves(self, moved: Mapping[str, Pose]) -> None:
        """Warn if the first poses turn all objects over, but hardly rotate them if read with w first.

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
                f"rotation_xyzw of {x!r} is ({parts}). Put w last; Python's "
                "`Pose.from_wxyz` takes position_m and rotation_wxyz, with w first."
            )

    def in_contacts(self, contacts: Sequence[Contact]) -> None:
        """Warn if the normals of the first contacts point the wrong way. Call it after the objects have moved.

        Warns: SceneWarning.
        """
        if self._knows_normals:
            return
        is_wrong = are_reversed(contacts, self._state.objects, self._state.graph.pose)
        self._knows_normals = is_wrong is not None
        if is_wrong:
            one = next(contact for contact in contacts if contact.normal is not None)
            warn_of(
                f"all normals of {counted(len(contacts), 'contact')} point from b to a, such as that of {one.a!r} and "
                f"{one.b!r}; a normal points from a to b. Swap a and b, or no object lands."
            )

    def in_frame(
        self, touches: TouchesByHand, source_ids: Sequence[str], sink_problem: str | None, *, is_unplayed: bool
    ) -> None:
        """Warn of mistakes that an update shows; call it once for each.

        Parameters: sink_problem : why the sink plays nothing, None if it plays; is_unplayed : the session's sink was
        never started, and nothing was rendered. Warns: SceneWarning.
        """
        if sink_problem is not None:
            self.in_sink(sink_problem)
        if touches:
            self.in_sources(source_ids)
            self.in_touches(touches)
            if is_unplayed:
                self.in_output()

    def in_touches(self, touches_by_hand: TouchesByHand) -> None:
        """Count touches that are too far off, and warn about the first one of each hand. Warns: SceneWarning."""
        self._n_updates = n = self._n_updates + 1
        if n > LOOKED_AT and n % LOOKED_AT:
            return
        for touches in touches_by_hand.values():
            for touch in touches:
                off_m = self._off_m(touch.object_id, touch.point_m)
                if off_m > FAR_M:
                    self.n_touches_off += 1
                    if touch.hand not in self._hands_named:
                        self._hands_named.add(touch.hand)
                        self._warn_of_touch(touch, off_m)

    def in_points(self, touches: Sequence[Touch]) -> None:
        """Warn about the first point of `would_feel` that is too far off. Warns: SceneWarning."""
        if self._is_point_named:
            return
        for touch in touches[:LOOKED_AT]:
            off_m = self._off_m(touch.object_id, touch.point_m)
            if off_m > FAR_M:
                self._is_point_named = True
                warn_of(f"would_feel is given {_far(touch.object_id, touch.point_m, off_m)} Others are not named.")
                return

    def in_output(self) -> None:
        """Warn once of a sink that was never started. Call it for each update with touches until then.

        Warns: SceneWarning.
        """
        self._n_unplayed += 1
        if self._n_unplayed == UNPLAYED:
            warn_of(f"{UNPLAYED} updates had touches, and the sink of the session was never started. {NOT_STARTED}")

    def in_sink(self, problem: str) -> None:
        """Warn once that the sink plays nothing. Warns: SceneWarning."""
        if not self._is_sink_named:
            self._is_sink_named = True
            warn_of(f"{problem} Give the sink an `on_event` to get such messages yourself.")

    def in_strike(self, object_id: str, point_m: Vector) -> None:
        """Warn about the first strike that is too far off. Warns: SceneWarning."""
        if self._is_strike_named:
            return
        off_m = self._off_m(object_id, point_m)
        if off_m > FAR_M:
            self._is_strike_named = True
            warn_of(f"a strike of {_far(object_id, point_m, off_m)} Further strikes are not checked.")

    def in_sources(self, source_ids: Sequence[str]) -> None:
        """Warn once if nothing vibrates. Warns: SceneWarning."""
        if not source_ids and not self._is_silence_named:
            self._is_silence_named = True
            warn_of(
                f"of {len(self._state.objects)} objects none vibrates, so that nothing but impacts will be felt; add "
                "one with loops, or give one `vibrates` true by `override` of the bundle, then `rebake` the bundle."
            )

    def in_added(self, object_id: str, haptics: ObjectHaptics | None, loops: Mapping[str, HapticLoop]) -> None:
        """Warn about an added object that neither vibrates nor carries vibration, or that vibrates without loops.

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
            f"{object_id!r}, {why}, is added without loops: it {what}; give its `haptics` and `loops`, as a "
            f"bundle has them, or bake it alone, in Python by `bake_object`, and add it by `spawn`.{last}"
        )

    def _off_m(self, object_id: str, point_m: Vector) -> float:
        """Distance of a point from the box around an object [m]. Searching the surface would take too long."""
        state = self._state
        own_m = in_own(point_m, state.graph.pose(object_id))
        rows = zip(own_m, state.middle_m(object_id), state.half_m(object_id), strict=True)
        return math.hypot(*(max(abs(x - middle) - half, 0.0) for x, middle, half in rows))

    def _warn_of_touch(self, touch: Touch, off_m: float) -> None:
        warn_of(
            f"hand {touch.hand!r} touches {_far(touch.object_id, touch.point_m, off_m)} "
            "`stats.touches_off_surface` counts such touches."
        )


def _far(object_id: str, point_m: Vector, off_m: float) -> str:
    point = ", ".join(f"{x:g}" for x in point_m)
    return (
        f"{object_id!r} at ({point}), {off_m:.3g} m off the box around it, more than {FAR_M} m; point_m is in the "
        "world [m], where the object is in this frame."
    )


def warn_if_other_actuator(bundle: HapticBundle, actuator: ActuatorProfile) -> None:
    """Warn if the loops of a bundle were made for an actuator of another response.

    Limits of amplitude and power are not compared: only the safety layer uses them, and loops do not depend on them. A
    bundle without a record of its actuator, or without loops, fits any actuator. Warns: OtherActuatorWarning.
    """
    made_for = bundle.actuator
    if not bundle.loops or made_for is None or _response(made_for) == _response(actuator):
        return
    warn_of(
        f"the bundle's loops were made for the actuator {made_for.name!r}, and this session plays on "
        f"{actuator.name!r}: set `actuator` of the session's settings to the one in use, or `rebake` the bundle with "
        "that `actuator`.",
        OtherActuatorWarning,
    )


def warn_if_not_baked(scene: SceneSnapshot, bundle: HapticBundle) -> None:
    """Warn of objects that the bundle does not have, as after a bake of an earlier scene. Warns: SceneWarning."""
    new = [item.id for item in scene.objects if item.id not in bundle.objects]
    if new:
        objects = counted(len(scene.objects), "object")
        warn_of(
            f"the bundle lacks {len(new)} of {objects} of the scene, such as {new[0]!r}. What it lacks neither "
            "vibrates nor carries vibration. Bake the scene again; `bake` keeps corrections if it gets "
            "the `overrides` of the bundle."
        )


def warn_of_pending_corrections(bundle: HapticBundle) -> None:
    """Warn of corrections that nobody feels before the next `rebake`. Warns: SceneWarning."""
    pending = [(key, "name") for key in renamed_objects(bundle)]
    pending += [(key, "vibrates") for key in [*objects_without_states(bundle), *objects_without_loops(bundle)]]
    pending += [(key, "sound, intensity or pitch") for key in objects_with_other_loops(bundle)]
    if pending:
        named = first_of([f"{field} of {key!r}" for key, field in pending], MOST_NAMED)
        warn_of(
            f"corrections of the bundle are not baked yet, and change nothing: {named}. Write bundle = rebake(bundle), "
            "or `scene2hap edit BUNDLE rebake`."
        )


def warn_if_other_hands(named: Sequence[str], own: Sequence[str]) -> None:
    """Warn if a user's profile names hands, but no hand of the session. Warns: SceneWarning."""
    if named and not set(named) & set(own):
        theirs, ours = (", ".join(map(repr, hands)) for hands in (named, own))
        warn_of(f"the user's profile is for the hands {theirs}; this session has {ours}. Rename one of them.")


def _response(actuator: ActuatorProfile) -> ActuatorProfile:
    """The parts of an actuator on which loops depend: band and response."""
    plain = ActuatorProfile()
    return replace(
        actuator,
        name=plain.name,
        max_amplitude=plain.max_amplitude,
        max_rms=plain.max_rms,
        rms_window_s=plain.rms_window_s,
    )
