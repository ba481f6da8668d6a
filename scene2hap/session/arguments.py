"""Conversion of a session's arguments: accept an unexpected type if its meaning is clear, else raise.

An ordinary frame runs only `given_stamp`, `touches_by_hand` and `given_frames`, each on its shortest way.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NoReturn

import numpy as np

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle
from scene2hap.common import checks
from scene2hap.common.arrays import Floats, floats
from scene2hap.devices.protocol import ActuatorSink
from scene2hap.devices.whole_frames import MAX_RENDERED_FRAMES
from scene2hap.errors import BundleError, ConfigError, SceneError, SessionError, UnknownObject
from scene2hap.haptics import ObjectHaptics
from scene2hap.scene.objects import Contact, SceneObject
from scene2hap.scene.pose import Pose, how_to_write
from scene2hap.session.frame import Touch, require_hand, unknown_hand
from scene2hap.session.hand_gains import Felt
from scene2hap.session.impacts.felt_impacts import KNOCK_M_S, Strike
from scene2hap.session.scene_state import SceneState

MAX_POINTS = 1024
"""Most tracked points of a hand; assumed: 26 joints, or a few hundred points of a glove."""

MAX_AHEAD_S = 3600
"""Longest time of `at_sample` ahead of the rendered samples [s]; assumed: a longer one is in other units."""

_TOUCH = "Touch(hand, object_id, point_m)"


def require_settings(config: object) -> None:
    """Raise a ConfigError if another argument of a session (hands, sink) is given as settings."""
    if isinstance(config, ActuatorSink):
        raise ConfigError(f"config is {checks.described(config)}; write HapticSession(..., sink=sink).")
    for name in ("hands", "sink"):
        if isinstance(config, Mapping) and name in config:
            value = checks.represented(config[name])
            raise ConfigError(f"{name} is an argument, no setting; write HapticSession(..., {name}={value}).")


def given_frame(moved: object, touches: Any) -> tuple[Mapping[str, Pose] | None, Any]:
    """Return the poses and touches of an update whose first argument is no dict: accepts `update([Touch(...)])`.

    Other mappings become dicts, since a `PoseTable` makes a pose at each access.
    Raises: SessionError: the first argument is neither poses by id nor touches.
    """
    is_touches = isinstance(moved, Touch) or (
        isinstance(moved, list | tuple) and all(isinstance(one, Touch) for one in moved)
    )
    if is_touches and (touches is None or (isinstance(touches, list | tuple) and not touches)):
        return None, given_touches(moved)
    return given_poses(moved), touches


def given_poses(moved: object) -> dict[str, Pose]:
    """Return moved objects as a dict, without a check of their poses. Raises: SessionError: it is no mapping."""
    if isinstance(moved, Mapping):
        return dict(moved)
    raise SessionError(
        f"moved is {checks.described(moved)}; it must be a mapping of object ids to poses, as {{'mug': Pose(...)}}. "
        f"Touches go by name: update(touches=[{_TOUCH}])."
    )


def given_touches(touches: object) -> list[Touch]:
    """Convert touches that are no sequence of Touch: a single one, None, or (hand, object id, point).

    Raises: SessionError: anything else, such as a mapping or a text.
    """
    if touches is None:
        return []
    if isinstance(touches, Touch):
        return [touches]
    if isinstance(touches, str | Mapping):
        _refuse_touches("is", touches)
    try:
        found = list(touches)  # type: ignore[call-overload]  # if it cannot, see below
    except Exception:  # an object of another type may raise any error
        _refuse_touches("is", touches)
    return [_given_touch(one) for one in found]


def _given_touch(touch: object) -> Touch:
    if isinstance(touch, tuple) and len(touch) == 3:
        touch = Touch(*touch)
    if not isinstance(touch, Touch):
        _refuse_touches("has", touch)
    if not isinstance(touch.hand, str):
        raise SessionError(f"hand is {checks.described(touch.hand)}; it must be a name. A touch is {_TOUCH}.")
    if not isinstance(touch.object_id, str):
        raise SessionError(f"object_id is {checks.described(touch.object_id)}; it must be an id. A touch is {_TOUCH}.")
    return touch


def _refuse_touches(verb: str, given: object) -> NoReturn:
    wrong = f"{checks.represented(given)} ({type(given).__name__})"
    raise SessionError(f"touches {verb} {wrong}; it must be a list of Touch, as [{_TOUCH}].")


def given_points(points_m: object, hands: Sequence[str]) -> dict[str, Floats]:
    """Return the tracked points (n, 3) [m] of each hand. A hand may have one point, and none while it is not tracked.

    Raises: SessionError: an unknown hand; points of another shape, not finite, or more than `MAX_POINTS`.
    """
    if not isinstance(points_m, Mapping):
        how = "it must be a mapping of hands to points, as {'left': (0.1, 0.8, 0.2)}"
        raise SessionError(f"points_m is {checks.described(points_m)}; {how}.")
    found = {}
    for hand, given in points_m.items():
        require_hand(hand, hands)
        if given is None:
            continue
        name = f"points_m[{hand!r}]"
        points = np.atleast_2d(floats(name, given, "m", error=SessionError))
        if np.shape(given) == (0,):
            continue  # a list of the tracked points that none is in
        if points.ndim != 2 or points.shape[1] != 3 or len(points) > MAX_POINTS:
            raise SessionError(f"{name} has shape {np.shape(given)}; it must be (3,) or (n, 3) [m], n <= {MAX_POINTS}.")
        if not np.isfinite(points).all():
            raise SessionError(f"{name} has a number that is not finite; leave out the points that are not tracked.")
        found[hand] = points
    return found


def touches_by_hand(touches: Any, hands: Sequence[str], state: SceneState) -> Felt:
    """Group touches, in any form that `given_touches` accepts, by their hand.

    Raises: UnknownObject: an object is not in the scene; SessionError: an unknown hand, or another type.
    """
    if type(touches) is not list and type(touches) is not tuple:
        touches = given_touches(touches)
    try:
        by_hand = _grouped(touches, hands, state)
    except UnknownObject:
        raise
    except Exception:  # an object of another type may raise any error
        by_hand = _grouped(given_touches(touches), hands, state)
    for hand in by_hand:
        if hand not in hands:
            raise SessionError(unknown_hand(hand, hands))
    return {hand: by_hand[hand] for hand in hands if hand in by_hand}


def _grouped(touches: Sequence[Touch], hands: Collection[str], state: SceneState) -> dict[str, list[Touch]]:
    by_hand: dict[str, list[Touch]] = {}
    for touch in touches:
        if touch.object_id not in state.objects:
            state.require(touch.object_id, _swapped_hint(touch, hands))
        by_hand.setdefault(touch.hand, []).append(touch)
    return by_hand


def _swapped_hint(touch: Touch, hands: Collection[str]) -> str:
    """Return a hint if a touch has hand and object swapped."""
    is_hand = isinstance(touch.object_id, str) and touch.object_id in hands
    return f" {touch.object_id!r} is a hand; a touch is {_TOUCH}." if is_hand else ""


def require_pose(object_id: str, pose: object) -> None:
    """Require a Pose. Raises: SceneError: another type; the message says how to write it as a Pose."""
    if isinstance(pose, Pose):
        return
    how = "write its .pose" if isinstance(pose, SceneObject) else how_to_write(pose)
    raise SceneError(f"the pose of {object_id!r} is {checks.represented(pose)}; it must be a Pose: {how}.")


def given_contacts(contacts: object) -> Sequence[Contact]:
    """Return contacts of an engine. Raises: SessionError: another type."""
    wanted = "a list, as [Contact('mug', 'table', point_m)]"
    return checks.instances("contacts", contacts, Contact, wanted, error=SessionError)


def given_strike(
    object_id: str, point_m: object, with_object: str | None, speed_m_s: object, impulse_n_s: object
) -> Strike:
    """Return a strike; a knock without speed and impulse. Raises: SessionError: numbers that are out of bounds."""
    x, y, z = checks.vector("point_m", point_m, "m", size=3, error=SessionError)
    if with_object == object_id:
        raise SessionError(
            f"with_object is {checks.represented(with_object)}, the struck object itself; give the object that strikes "
            "it, or leave it out for a finger."
        )
    if speed_m_s is not None and impulse_n_s is not None:
        raise SessionError("speed_m_s and impulse_n_s are both given; give one of them.")
    if impulse_n_s is not None:
        impulse = checks.number("impulse_n_s", impulse_n_s, "N s", above=0.0, at_most=1e6, error=SessionError)
        return Strike(object_id, (x, y, z), with_object, impulse_n_s=impulse)
    given = KNOCK_M_S if speed_m_s is None else speed_m_s
    speed = checks.number("speed_m_s", given, "m/s", above=0.0, at_most=1e4, error=SessionError)
    return Strike(object_id, (x, y, z), with_object, speed)


def require_addable(item: object, haptics: object, loops: object) -> None:
    """Raise a SessionError unless these are valid arguments of `HapticSession.add`."""
    if not isinstance(item, SceneObject):
        raise SessionError(
            f"object is {checks.described(item)}; it must be one SceneObject, as `scene.object(id)` gives and "
            "`SceneObject(id, name, pose, geometry, surface)` makes."
        )
    if haptics is not None and not isinstance(haptics, ObjectHaptics):
        raise SessionError(
            f"haptics of {item.id!r} is {checks.described(haptics)}; it must be an ObjectHaptics, as `bundle.objects` "
            "has."
        )
    if loops is not None and not isinstance(loops, Mapping):
        raise SessionError(
            f"loops of {item.id!r} is {checks.described(loops)}; it must be a mapping of states to HapticLoop, as "
            "`bundle.loops` has."
        )
    for state, loop in (loops or {}).items():
        if not isinstance(loop, HapticLoop):
            what, hint = checks.described(loop), ""
            if isinstance(loop, Mapping):
                hint = f" Give the loops of one source, as bundle.loops[{state!r}]."
            raise SessionError(f"loops[{state!r}] of {item.id!r} is {what}; it must be a HapticLoop.{hint}")
        if not isinstance(state, str):
            raise SessionError(f"loops of {item.id!r} has the state {checks.represented(state)}; it must be a text.")


def given_frames(n_frames: object) -> int:
    """A number of frames to render. Raises: SessionError: out of bounds."""
    if type(n_frames) is int and 0 <= n_frames <= MAX_RENDERED_FRAMES:
        return n_frames
    hint = "For a time give seconds: `render_s`, or `pull_s` of a sink."
    bounds = {"at_least": 0, "at_most": MAX_RENDERED_FRAMES}
    return checks.whole("n_frames", n_frames, "-", **bounds, error=SessionError, hint=hint)


def given_stamp(at_sample: object, last: int, position: int, sample_rate_hz: int) -> int:
    """Return the sample of an update that follows an update at `last`, while `render` is at `position`.

    Raises: SessionError: it is before the last update, or too far ahead.
    """
    sample = at_sample
    if type(sample) is not int:
        sample = checks.whole("at_sample", at_sample, "-", at_least=0, at_most=2**62, error=SessionError)
    if sample > max(position, last) + MAX_AHEAD_S * sample_rate_hz:
        raise SessionError(
            f"at_sample is {checks.represented(sample)}, more than {MAX_AHEAD_S} s ahead of `position`, {position}; it "
            "must be a number of samples on the clock of `render`. Leave it out for now."
        )
    if sample < last:
        raise SessionError(
            f"at_sample is {checks.represented(sample)}; the last update was at {last}, and time cannot go back. Give "
            "updates in the order in which they happen."
        )
    return sample


def require_prefab(prefab: object, pose: object) -> None:
    """Raise a SessionError unless a bundle of one object and its pose are given."""
    if not isinstance(prefab, HapticBundle):
        raise SessionError(
            f"prefab is {checks.shown(prefab)}; it must be a HapticBundle of one object: bake_object(...) or "
            "HapticBundle.load(folder)."
        )
    if len(prefab.snapshot.objects) != 1:
        raise SessionError(
            f"prefab has {len(prefab.snapshot.objects)} objects; it must have one. Bake each object alone, in "
            "Python by `bake_object`."
        )
    if not isinstance(pose, Pose):
        raise SessionError(f"pose is {checks.shown(pose)}; it must be a Pose.")


def require_correction(bundle: object, before: HapticBundle) -> None:
    """Raise a BundleError unless a bundle has the same objects as the one before."""
    if not isinstance(bundle, HapticBundle):
        raise BundleError(f"bundle is {checks.described(bundle)}; it must be a HapticBundle.")
    if other := set(bundle.objects) ^ set(before.objects):
        raise BundleError(
            f"the bundle is of another scene: only one of it and the bundle in use has {min(other)!r}. Make another "
            "session for another scene."
        )
