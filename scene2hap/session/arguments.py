"""Conversion of a session's arguments: accept an unexpected type if its meaning is clear, else raise.

`frame` converts touches, and `config` settings. An ordinary frame runs nothing of this module but `given_stamp`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle
from scene2hap.common import checks
from scene2hap.common.arrays import Floats, floats
from scene2hap.common.counted import first_of
from scene2hap.devices.whole_frames import MAX_RENDERED_FRAMES
from scene2hap.errors import BundleError, SceneError, SessionError
from scene2hap.haptics import ObjectHaptics
from scene2hap.scene.objects import Contact, SceneObject
from scene2hap.scene.pose import Pose, how_to_write
from scene2hap.session.frame import HapticFrame, Touch, given_touches
from scene2hap.session.impacts.felt_impacts import KNOCK_M_S, Strike
from scene2hap.session.present_scene.scene_state import SceneState
from scene2hap.session.unknown_names import require_hand

MAX_POINTS = 1024
"""Most tracked points of a hand; assumed: 26 joints, or a few hundred points of a glove."""

MAX_AHEAD_S = 3600
"""Longest time of `at_sample` ahead of the rendered samples [s]; assumed: a longer one is in other units."""


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
        "Touches go by name: update(touches=[Touch(hand, object_id, point_m)])."
    )


def given_gains(gains: object, sources: tuple[str, ...], n_bands: int) -> Floats:
    """Return gains (..., n_sources, n_bands), also those of a frame. Raises: SessionError: another shape or sources."""
    if isinstance(gains, HapticFrame):
        if gains.sources != sources:
            raise SessionError(
                f"the frame has other sources ({first_of(gains.sources, 5)}) than the session now "
                f"({first_of(sources, 5)}). Give it before a source is added or removed, or take the next update's."
            )
        gains = gains.gains
    given = floats("gains", gains, "-", error=SessionError)
    if given.shape[-2:] != (len(sources), n_bands):
        raise SessionError(
            f"gains has shape {given.shape}; its last two axes must be the {len(sources)} sources and {n_bands} bands "
            "of the session, as in frame.gains and in the result of `would_feel`."
        )
    return given


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


def require_pose(object_id: str, pose: object) -> None:
    """Require a Pose. Raises: SceneError: another type; the message says how to write it as a Pose."""
    if isinstance(pose, Pose):
        return
    how = "write its .pose" if isinstance(pose, SceneObject) else how_to_write(pose)
    raise SceneError(f"the pose of {object_id!r} is {checks.represented(pose)}; it must be a Pose: {how}.")


def require_moves(moved: Mapping[str, object], state: SceneState) -> None:
    """Require poses of objects in the scene. Raises: UnknownObject; SceneError: another type than a Pose."""
    for object_id, pose in moved.items():
        state.require(object_id)
        require_pose(object_id, pose)


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
