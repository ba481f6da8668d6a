"""Doors on cabinets that clients write: where their pivots are, and what a hand on the open door feels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from scene2hap import HapticBundle, HapticSession, Pose, SceneObject, SceneSnapshot, Touch
from scenes import haptics, tone_loop

OPEN_RAD = 1.2


def check_door(scene: SceneSnapshot, pivot_m: Sequence[float], door: str = "door", cabinet: str = "cabinet") -> None:
    """Check that a door is hinged on its cabinet at a world point, and that vibration passes there when it is open."""
    held, other = scene.object(door), scene.object(cabinet)
    assert held.hinge is not None
    assert held.hinge.to == cabinet
    for item, point_m in ((held, held.hinge.point_m), (other, held.hinge.other_point_m)):
        np.testing.assert_allclose(item.pose.to_world([point_m])[0], pivot_m, rtol=0, atol=1e-5)
    loose = replace(held, hinge=None)
    expected = _gain(scene, loose.hinged_on(other, pivot_m), other, pivot_m)
    assert expected > 0.0
    np.testing.assert_allclose(_gain(scene, held, other, pivot_m), expected, rtol=1e-3)
    assert abs(_gain(scene, loose, other, pivot_m) / expected - 1.0) > 0.1  # so that the gain shows the hinge


def _gain(scene: SceneSnapshot, door: SceneObject, cabinet: SceneObject, pivot_m: Sequence[float]) -> float:
    """The gain of the humming cabinet at a hand in the middle of the door, which is opened about its pivot."""
    snapshot = SceneSnapshot.build([cabinet, door], up_axis=scene.up_axis)
    objects = {
        cabinet.id: haptics("plywood", tuple(np.ptp(cabinet.bounds_m, axis=0)), "humming"),
        door.id: haptics("plywood", tuple(np.ptp(door.bounds_m, axis=0))),
    }
    bundle = HapticBundle(snapshot, "room", objects, {cabinet.id: {"humming": tone_loop(120)}})
    turn = Pose.from_yaw(pivot_m, OPEN_RAD, up_axis=scene.up_axis)
    pose = turn.compose(Pose(np.subtract(door.pose.position_m, pivot_m), door.pose.rotation_xyzw))
    hand_m = turn.to_world([door.bounds_m.mean(axis=0) - pivot_m])[0]
    with HapticSession(snapshot, bundle, sink="memory") as session:
        session.update({door.id: pose}, [Touch("left", door.id, hand_m)])
        return session.update({door.id: pose}, [Touch("left", door.id, hand_m)]).gain("left", cabinet.id)
