"""Constructors of poses: quaternions with w first, angles, and targets."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from scene2hap import Pose
from scene2hap.errors import SceneError

AT = (0.1, 0.2, 0.3)
angles = st.floats(-10, 10)


def test_from_wxyz_takes_w_first() -> None:
    pose = Pose.from_wxyz(AT, (0.5, 0.1, -0.7, 0.5))
    expected = Rotation.from_quat([0.1, -0.7, 0.5, 0.5]).as_matrix()
    np.testing.assert_allclose(pose.rotation, expected, atol=1e-12)
    assert pose.position_m == AT


@pytest.mark.parametrize(("up_axis", "front"), [("y", (1.0, 0.0, 0.0)), ("z", (0.0, 1.0, 0.0))])
def test_a_quarter_turn_about_the_vertical(up_axis: str, front: tuple[float, float, float]) -> None:
    """Counter-clockwise from above: z turns to x if y is up, and x turns to y if z is up."""
    pose = Pose.from_yaw(AT, math.pi / 2, up_axis=up_axis)
    own = (0.0, 0.0, 1.0) if up_axis == "y" else (1.0, 0.0, 0.0)
    np.testing.assert_allclose(pose.rotation @ own, front, atol=1e-12)


@given(
    order=st.sampled_from(["xyz", "ZYX", "zxz", "YXZ", "XZX", "zy", "X"]),
    values=st.lists(angles, min_size=3, max_size=3),
)
def test_from_euler_equals_scipy(order: str, values: list[float]) -> None:
    given_rad = values[: len(order)]
    expected = Rotation.from_euler(order, given_rad if len(order) > 1 else given_rad[0]).as_matrix()
    np.testing.assert_allclose(Pose.from_euler(AT, given_rad, order=order).rotation, expected, atol=1e-9)


@given(target=st.tuples(*[st.floats(-5, 5)] * 3), up_axis=st.sampled_from(["y", "z"]))
def test_look_at_points_the_front_at_the_target_without_roll(target: tuple[float, float, float], up_axis: str) -> None:
    up = {"y": 1, "z": 2}[up_axis]
    way = np.array(target) - AT
    if np.linalg.norm(np.delete(way, up)) < 1e-3:
        return
    pose = Pose.look_at(AT, target, up_axis=up_axis)
    front, side = ((0, 0, 1), (1, 0, 0)) if up_axis == "y" else ((1, 0, 0), (0, 1, 0))
    np.testing.assert_allclose(pose.rotation @ front, way / np.linalg.norm(way), atol=1e-9)
    assert abs((pose.rotation @ side)[up]) < 1e-9
    assert pose.rotation[up, up] >= -1e-12
    assert np.linalg.det(pose.rotation) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Pose.from_euler(AT, (0, 0, 0), order="xxy"), "order is 'xxy'"),
        (lambda: Pose.from_euler(AT, (0, 0, 0), order="xYz"), "order is 'xYz'"),
        (lambda: Pose.from_euler(AT, (0, 0), order="xyz"), "angles_rad"),
        (lambda: Pose.from_yaw(AT, math.nan), "yaw_rad"),
        (lambda: Pose.from_yaw(AT, 0.1, up_axis="x"), "up_axis is 'x'"),
        (lambda: Pose.from_wxyz(AT, (1, 0, 0)), "rotation_wxyz"),
        (lambda: Pose.look_at(AT, (0.1, 5.0, 0.3)), "straight above"),
        (lambda: Pose.look_at(AT, AT), "is at or straight above"),
    ],
)
def test_invalid_rotations_are_refused(make: object, words: str) -> None:
    with pytest.raises(SceneError, match=words):
        make()
