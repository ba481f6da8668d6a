"""Poses, against rotations computed by hand and by scipy."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.spatial.transform import Rotation

from scene2hap.common.warning import SceneWarning
from scene2hap.errors import SceneError
from scene2hap.scene.pose import Pose, in_own, in_world

coordinates = st.floats(-100, 100)
directions = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: math.hypot(*q) > 1e-3)
poses = st.builds(Pose, st.tuples(coordinates, coordinates, coordinates), directions)
point_lists = st.lists(st.tuples(coordinates, coordinates, coordinates), min_size=1, max_size=5)
QUARTER_ABOUT_Z = (0.0, 0.0, 0.5**0.5, 0.5**0.5)


def test_quarter_turn_about_z_maps_x_to_y() -> None:
    moved = Pose((1.0, 2.0, 3.0), QUARTER_ABOUT_Z).to_world([[1.0, 0.0, 0.0]])
    np.testing.assert_allclose(moved, [[1.0, 3.0, 3.0]], atol=1e-15)


def test_default_pose_is_the_identity() -> None:
    points = np.array([[1.0, -2.0, 3.5]])
    np.testing.assert_array_equal(Pose().to_world(points), points)


@given(poses)
@settings(max_examples=50)
def test_rotation_is_that_of_scipy(pose: Pose) -> None:
    np.testing.assert_allclose(pose.rotation, Rotation.from_quat(pose.rotation_xyzw).as_matrix(), atol=1e-12)


@given(poses, point_lists)
@settings(max_examples=50)
def test_to_own_inverts_to_world(pose: Pose, points: list[tuple[float, float, float]]) -> None:
    np.testing.assert_allclose(pose.to_own(pose.to_world(points)), points, atol=1e-10)


@given(poses, point_lists)
@settings(max_examples=50)
def test_single_points_are_those_of_arrays(pose: Pose, points: list[tuple[float, float, float]]) -> None:
    for point in points:
        np.testing.assert_allclose(in_world(point, pose), pose.to_world([point])[0], atol=1e-10)
        np.testing.assert_allclose(in_own(point, pose), pose.to_own([point])[0], atol=1e-10)


@given(poses, poses, point_lists)
@settings(max_examples=50)
def test_compose_applies_inner_then_outer(outer: Pose, inner: Pose, points: list[tuple[float, float, float]]) -> None:
    together = outer.compose(inner).to_world(points)
    np.testing.assert_allclose(together, outer.to_world(inner.to_world(points)), atol=1e-9)


@given(poses, point_lists)
@settings(max_examples=50)
def test_inverse_maps_the_world_into_the_frame(pose: Pose, points: list[tuple[float, float, float]]) -> None:
    np.testing.assert_allclose(pose.inverse().to_world(points), pose.to_own(points), atol=1e-9)


@given(poses)
@settings(max_examples=100)
def test_from_matrix_restores_the_pose(pose: Pose) -> None:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = pose.rotation, pose.position_m
    again = Pose.from_matrix(matrix)
    assert again.position_m == pose.position_m
    # q and -q are one rotation. A pose keeps a quaternion whose length is within 1e-9 of 1, so divide by its length.
    cosine = abs(np.dot(again.rotation_xyzw, pose.rotation_xyzw)) / math.hypot(*pose.rotation_xyzw)
    assert cosine == pytest.approx(1.0, abs=1e-12)
    assert again.rotation_xyzw[3] >= 0.0


@pytest.mark.parametrize("axis", ["x", "y", "z"])
@pytest.mark.parametrize("angle_deg", [0, 90, 179.999, 180, 270])
def test_from_matrix_is_exact_at_half_turns(axis: str, angle_deg: float) -> None:
    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_euler(axis, angle_deg, degrees=True).as_matrix()
    np.testing.assert_allclose(Pose.from_matrix(matrix).rotation, matrix[:3, :3], atol=1e-12)


def test_a_long_quaternion_is_normalised() -> None:
    assert Pose(rotation_xyzw=(0.0, 0.0, 0.0, 2.0)).rotation_xyzw == (0.0, 0.0, 0.0, 1.0)


def test_unit_quaternion_is_kept_bit_exactly() -> None:
    quaternion = (0.1, 0.2, 0.3, math.sqrt(1 - 0.14))
    assert Pose(rotation_xyzw=quaternion).rotation_xyzw == quaternion


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"position_m": (0.0, math.nan, 0.0)}, r"position_m\[1\] is nan m; it must be finite \[m\]"),
        ({"position_m": (0.0, 0.0)}, r"position_m is \(0.0, 0.0\); it must be 3 numbers \[m\]"),
        ({"position_m": 7}, r"position_m is 7; it must be 3 numbers"),
        ({"rotation_xyzw": (0.0, 0.0, 0.0, 0.0)}, r"length 0.*Use \(0, 0, 0, 1\)"),
        ({"rotation_xyzw": ("a", 0.0, 0.0, 1.0)}, r"rotation_xyzw\[0\] is 'a'; it must be a number"),
    ],
)
def test_invalid_pose_is_refused(arguments: dict[str, object], sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        Pose(**arguments)


@pytest.mark.parametrize("matrix", [2 * np.eye(4), np.diag([-1.0, 1.0, 1.0, 1.0]), np.eye(3)])
def test_a_matrix_that_is_not_rigid_is_refused(matrix: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> None:
    with pytest.raises(SceneError, match="not rigid"):
        Pose.from_matrix(matrix)


@pytest.mark.parametrize("rotation", [(0.0, 90.0, 0.0, 0.0), (0.0, 0.0, 0.0, 2.0), (0.1, 0.2, 0.1, 0.3)])
def test_quaternion_far_from_unit_length_is_normalised_with_a_warning(
    rotation: tuple[float, float, float, float],
) -> None:
    with pytest.warns(SceneWarning, match=r"of length .*from_euler.*from_wxyz") as caught:
        pose = Pose((0.0, 0.0, 0.0), rotation)
    assert caught[0].filename == __file__
    assert math.hypot(*pose.rotation_xyzw) == pytest.approx(1.0)


@pytest.mark.filterwarnings("error::scene2hap.SceneWarning")
def test_rounded_quaternion_is_normalised_without_a_warning() -> None:
    assert math.hypot(*Pose(rotation_xyzw=(0.7, 0.0, 0.0, 0.7)).rotation_xyzw) == pytest.approx(1.0)


@pytest.mark.parametrize(
    "make",
    [
        lambda: Pose.from_yaw((0, 0, 0), 90),
        lambda: Pose.from_euler((0, 0, 0), (0, -45.0, 0)),
        lambda: Pose.from_euler((0, 0, 0), (0, 0, 360)),
    ],
)
def test_angles_that_look_like_degrees_warn(make: Callable[[], Pose]) -> None:
    with pytest.warns(SceneWarning, match=r"^\S+ rad in \w+_rad are .* turns, .*degrees; for degrees write math"):
        make()


@pytest.mark.filterwarnings("error::scene2hap.SceneWarning")
def test_angles_in_radians_do_not_warn() -> None:
    for k in range(-20, 21):
        Pose.from_yaw((0, 0, 0), k * math.pi / 12)


def test_a_transposed_matrix_and_one_with_perspective_are_refused() -> None:
    matrix = np.eye(4)
    matrix[3, :3] = (1.0, 2.0, 3.0)
    with pytest.raises(SceneError, match=r"\(1.0, 2.0, 3.0, 1.0\) in its last row.*Give matrix.T"):
        Pose.from_matrix(matrix)
    assert Pose.from_matrix(matrix.T).position_m == (1.0, 2.0, 3.0)
    with pytest.raises(SceneError, match=r"\(0.0, 0.0, 0.5, 1.0\) in its last row"):
        Pose.from_matrix([*np.eye(4)[:3], (0.0, 0.0, 0.5, 1.0)])


def test_angles_for_a_quaternion_are_explained() -> None:
    with pytest.raises(SceneError, match=r"must be 4 numbers. It is a quaternion .*; Pose.from_euler takes angles"):
        Pose((0.0, 0.0, 0.0), (0.0, 90.0, 0.0))
