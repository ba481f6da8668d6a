"""Detection of moved objects, without jitter."""

from __future__ import annotations

import math

import pytest

from scene2hap import Pose
from scene2hap.engines.changes import moved

HOME = Pose((1, 2, 3), (0, 0, math.sin(0.1), math.cos(0.1)))


def turned(angle_rad: float) -> Pose:
    """HOME, rotated further about z by an angle."""
    half = 0.1 + angle_rad / 2
    return Pose((1, 2, 3), (0, 0, math.sin(half), math.cos(half)))


@pytest.mark.parametrize(
    ("pose", "is_moved"),
    [
        (HOME, False),
        (Pose((1, 2, 3), (0, 0, -math.sin(0.1), -math.cos(0.1))), False),  # the same rotation by its other quaternion
        (Pose((1, 2, 3.00009), HOME.rotation_xyzw), False),
        (Pose((1, 2, 3.00011), HOME.rotation_xyzw), True),
        (turned(0.9e-3), False),
        (turned(1.1e-3), True),
        (turned(math.pi), True),
    ],
)
def test_jitter_is_not_motion(pose: Pose, is_moved: bool) -> None:
    assert moved({"a": pose}, {"a": HOME}) == ({"a": pose} if is_moved else {})


def test_new_objects_count_as_moved_and_missing_objects_do_not() -> None:
    assert moved({"a": HOME, "b": HOME}, {"a": HOME, "c": HOME}) == {"b": HOME}


def test_slow_motion_is_detected_against_the_last_reported_pose() -> None:
    known, n_moves = {"a": Pose()}, 0
    for step in range(100):
        changed = moved({"a": Pose((step * 3e-5, 0, 0))}, known)
        known.update(changed)
        n_moves += bool(changed)
    assert n_moves == 24  # every fourth step of 0.03 mm is beyond 0.1 mm
    assert known["a"].position_m[0] == pytest.approx(96 * 3e-5)
