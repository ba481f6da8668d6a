"""Poses: translation and unit quaternion in glTF order, without scale."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.common import checks
from scene2hap.common.arrays import Floats, floats
from scene2hap.common.calls import clear_construction
from scene2hap.common.json_fields import Real
from scene2hap.common.warning import warn_of
from scene2hap.errors import SceneError
from scene2hap.scene.geometry import Vector, frozen, vector

# A quaternion this close to unit length is kept unchanged, so that JSON round trips are bit-identical. One shorter than
# `LEAST_LENGTH` is no rotation.
UNIT_TOLERANCE, LEAST_LENGTH = 1e-9, 1e-12
# Values rounded to one decimal have a smaller error, and so has the mean of two rotations 50 degrees apart.
_FAR_FROM_UNIT = 0.1
# Angles in radians that are a multiple of this are probably degrees.
_DEGREES = 15.0
_LAST_ROW = 1e-6
_LEAST_SLANT = 1e-9  # below this sine, a target is straight above or below, and its heading is undefined
_QUATERNION = "It is a quaternion (x, y, z, w); Pose.from_euler takes angles."


@clear_construction
@dataclass(frozen=True)
class Pose:
    """A rigid placement: x_world = R x_own + position.

    Parameters: position_m : three numbers [m]; rotation_xyzw : quaternion (x, y, z, w), normalised if it is not.
    Raises: SceneError: a component is not finite or the quaternion is zero.
    Warns: SceneWarning: the length of the quaternion is far from 1.
    """

    position_m: tuple[Real, Real, Real] = (0.0, 0.0, 0.0)
    rotation_xyzw: tuple[Real, Real, Real, Real] = (0.0, 0.0, 0.0, 1.0)

    if TYPE_CHECKING:

        def __init__(
            self, position_m: Iterable[float] = (0.0, 0.0, 0.0), rotation_xyzw: Iterable[float] = (0.0, 0.0, 0.0, 1.0)
        ) -> None: ...

    def __post_init__(self) -> None:
        position = checks.vector("position_m", self.position_m, "m", size=3, error=SceneError)
        rotation = checks.vector("rotation_xyzw", self.rotation_xyzw, "-", size=4, error=SceneError, hint=_QUATERNION)
        length = math.hypot(*rotation)
        if length < LEAST_LENGTH:
            raise SceneError("rotation_xyzw has length 0; a rotation is a unit quaternion. Use (0, 0, 0, 1) for none.")
        if abs(length - 1.0) > _FAR_FROM_UNIT:
            _warn_of_length(rotation, length)
        if abs(length - 1.0) > UNIT_TOLERANCE:
            rotation = tuple(component / length for component in rotation)
        object.__setattr__(self, "position_m", position)
        object.__setattr__(self, "rotation_xyzw", rotation)

    def __repr__(self) -> str:
        is_turned = self.rotation_xyzw != (0.0, 0.0, 0.0, 1.0)
        return f"Pose({self.position_m}, {self.rotation_xyzw})" if is_turned else f"Pose({self.position_m})"

    @classmethod
    def of_checked(cls, position_m: tuple[float, float, float], rotation_xyzw: tuple[float, ...]) -> Pose:
        """Return a pose of checked numbers, such as those of a `PoseTable`: finite floats, a unit quaternion."""
        pose = object.__new__(cls)
        object.__setattr__(pose, "position_m", position_m)
        object.__setattr__(pose, "rotation_xyzw", rotation_xyzw)
        return pose

    @cached_property
    def rotation(self) -> Floats:
        """Rotation matrix (3, 3) [-], own axes in its columns. Read-only."""
        x, y, z, w = self.rotation_xyzw
        rows = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
        return frozen(np.array(rows))

    @cached_property
    def _position(self) -> Floats:
        return np.array(self.position_m)

    def to_world(self, points_own_m: ArrayLike) -> Floats:
        """Transform points (n, 3) [m] from the own frame to the world."""
        points = _points("points_own_m", points_own_m)
        moved: Floats = points @ self.rotation.T + self._position
        return moved

    def to_own(self, points_m: ArrayLike) -> Floats:
        """Transform points (n, 3) [m] from the world to the own frame."""
        points = _points("points_m", points_m)
        own: Floats = (points - self._position) @ self.rotation
        return own

    def compose(self, inner: Pose) -> Pose:
        """Return the world pose of `inner`, a pose given in this pose's frame."""
        if not isinstance(inner, Pose):
            raise SceneError(f"inner is {checks.represented(inner)}; it must be a Pose, as Pose(position_m).")
        ax, ay, az, aw = self.rotation_xyzw
        bx, by, bz, bw = inner.rotation_xyzw
        quaternion = (
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        )
        position = self.to_world(np.asarray(inner.position_m))
        return Pose(vector(position), quaternion)

    def inverse(self) -> Pose:
        """Return the pose of the world in this frame: `frame.inverse().compose(pose)` is a pose seen from a frame."""
        x, y, z, w = self.rotation_xyzw
        return Pose((-self.rotation.T @ self.position_m).tolist(), (-x, -y, -z, w))

    @classmethod
    def from_wxyz(cls, position_m: Iterable[float], rotation_wxyz: Iterable[float]) -> Pose:
        """Return the pose of a quaternion that begins with w, as in MuJoCo, Blender and PyTorch3D."""
        w, x, y, z = checks.vector("rotation_wxyz", rotation_wxyz, "-", size=4, error=SceneError)
        return cls(_given(position_m), (x, y, z, w))

    @classmethod
    def from_yaw(cls, position_m: Iterable[float], yaw_rad: float, *, up_axis: Literal["y", "z"] = "y") -> Pose:
        """Return the pose of an object rotated about the vertical, counter-clockwise seen from above."""
        half = checks.number("yaw_rad", yaw_rad, "rad", error=SceneError) / 2
        _warn_of_degrees("yaw_rad", yaw_rad)
        return cls(_given(position_m), _about(vertical(up_axis), half))

    @classmethod
    def from_euler(cls, position_m: Iterable[float], angles_rad: Iterable[float], *, order: str = "xyz") -> Pose:
        """Return the pose of successive rotations about the axes of the world, in the order of the letters.

        Parameters: order : one to three of the letters x, y, z, without two equal neighbours; capitals rotate about the
            object's own axes as they are after each rotation. angles_rad : one angle for each letter.
        Raises: SceneError: the order or the number of angles is invalid.
        """
        letters = order.lower() if isinstance(order, str) else ""
        if (
            not 1 <= len(letters) <= 3
            or set(letters) - set("xyz")
            or any(a == b for a, b in pairwise(letters))
            or order not in (letters, letters.upper())
        ):
            raise SceneError(
                f"order is {checks.represented(order)}; it must be letters such as 'xyz' (world) or 'ZYX' (own axes)."
            )
        angles = checks.vector("angles_rad", angles_rad, "rad", size=len(order), error=SceneError)
        for angle in angles:
            _warn_of_degrees("angles_rad", angle)
        turned = cls()
        for letter, angle in zip(letters, angles, strict=True):
            turn = cls(rotation_xyzw=_about("xyz".index(letter), angle / 2))
            turned = turned.compose(turn) if order.isupper() else turn.compose(turned)
        return cls(_given(position_m), turned.rotation_xyzw)

    @classmethod
    def look_at(
        cls, position_m: Iterable[float], target_m: Iterable[float], *, up_axis: Literal["y", "z"] = "y"
    ) -> Pose:
        """Return the pose of an object whose front points at a target, with its upper side as far up as possible.

        The front is the own axis z if y is up, as in glTF, and x if z is up, as in ROS (REP 103).
        Raises: SceneError: the target is at the object's position, or straight above or below it.
        """
        up, at = vertical(up_axis), np.array(_given(position_m))
        target = np.array(checks.vector("target_m", target_m, "m", size=3, error=SceneError))
        front, upwards = target - at, np.eye(3)[up]
        side = np.cross(upwards, front)
        if np.linalg.norm(side) <= _LEAST_SLANT * np.linalg.norm(front):
            raise SceneError(
                f"target_m {tuple(target.tolist())} is at or straight above or below position_m {tuple(at.tolist())}; "
                "no side is up then. Give a rotation instead."
            )
        front, side = front / np.linalg.norm(front), side / np.linalg.norm(side)
        over = np.cross(front, side)
        columns = (side, over, front) if up == 1 else (front, side, over)
        return cls(vector(at), _quaternion(np.stack(columns, axis=1)))

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> Pose:
        """Return the pose of a rigid (4, 4) matrix, with the position in its last column.

        Raises: SceneError: the upper left 3 x 3 block is not a rotation, or the last row is not (0, 0, 0, 1).
        """
        m = floats("matrix", matrix, "-", error=SceneError)
        if m.shape != (4, 4) or not np.isfinite(m).all():
            raise SceneError(f"matrix is not rigid: its shape is {m.shape}; it must be (4, 4) and finite.")
        r = m[:3, :3]
        if np.abs(r).max() > 2.0 or not np.allclose(r @ r.T, np.eye(3), atol=1e-6) or np.linalg.det(r) < 0:
            lengths = ", ".join(f"{math.hypot(*column):.4g}" for column in r.T.tolist())
            raise SceneError(
                f"matrix is not rigid: its columns have the lengths {lengths}, are not at right angles, or mirror. "
                "Bake scale, shear and mirroring into the mesh first. A matrix that is only scaled is then made rigid "
                "by matrix[:3, :3] /= np.linalg.norm(matrix[:3, :3], axis=0)."
            )
        if np.abs(m[3] - (0.0, 0.0, 0.0, 1.0)).max() > _LAST_ROW:
            raise SceneError(
                f"matrix has {tuple(m[3].tolist())} in its last row; it must be (0, 0, 0, 1), with the position [m] in "
                "the last column. Give matrix.T if the position stands in the last row."
            )
        return cls(vector(m[:3, 3]), _quaternion(r))


def in_world(own_m: Vector, pose: Pose) -> Vector:
    """Return a point of an object's own frame in the world [m], as `Pose.to_world`, but quickly for a single point."""
    (a, b, c), (u, v, w) = own_m, pose.position_m
    if not (a or b or c):
        return u, v, w
    x, y, z, s = pose.rotation_xyzw
    d, e, f = 2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)
    return u + a + s * d + y * f - z * e, v + b + s * e + z * d - x * f, w + c + s * f + x * e - y * d


def in_own(point_m: Vector, pose: Pose) -> Vector:
    """Return a point of the world in an object's own frame [m], as `Pose.to_own`, but quickly for a single point."""
    (a, b, c), (u, v, w) = point_m, pose.position_m
    a, b, c = a - u, b - v, c - w
    x, y, z, s = pose.rotation_xyzw
    d, e, f = 2 * (z * b - y * c), 2 * (x * c - z * a), 2 * (y * a - x * b)
    return a + s * d + z * e - y * f, b + s * e + x * f - z * d, c + s * f + y * d - x * e


def how_to_write(given: object) -> str:
    """The words that say how to write something else as a Pose."""
    if getattr(given, "shape", None) == (4, 4):
        return "write Pose.from_matrix(matrix)"
    return "write Pose(position_m), or Pose(position_m, rotation_xyzw) with w last"


def _warn_of_length(rotation: Iterable[float], length: float) -> None:
    parts = ", ".join(f"{component:g}" for component in rotation)
    warn_of(
        f"rotation_xyzw is ({parts}), of length {length:.3g}; a rotation is a unit quaternion (x, y, z, w), so that "
        "this one was divided by its length. For angles write Pose.from_euler(position_m, angles_rad), for a "
        "quaternion that begins with w Pose.from_wxyz(position_m, rotation_wxyz)."
    )


def _warn_of_degrees(name: str, angle_rad: float) -> None:
    if angle_rad != 0.0 and angle_rad % _DEGREES == 0.0:
        warn_of(
            f"{angle_rad:g} rad in {name} are {abs(angle_rad) / math.tau:.1f} turns, and look like degrees; for "
            f"degrees write math.radians({angle_rad:g})."
        )


def _given(position_m: Iterable[float]) -> tuple[float, float, float]:
    return vector(checks.vector("position_m", position_m, "m", size=3, error=SceneError))


def vertical(up_axis: object) -> int:
    """Return the index of the vertical coordinate. Raises: SceneError: the axis is neither "y" nor "z"."""
    if not isinstance(up_axis, str) or up_axis not in ("y", "z"):
        raise SceneError(f"up_axis is {checks.represented(up_axis)}; it must be 'y' or 'z'.")
    return "xyz".index(up_axis)


def _about(axis: int, half_rad: float) -> tuple[float, float, float, float]:
    """Return the quaternion of a rotation by twice an angle."""
    found = [0.0, 0.0, 0.0, math.cos(half_rad)]
    found[axis] = math.sin(half_rad)
    return (found[0], found[1], found[2], found[3])


def _points(name: str, value: ArrayLike) -> Floats:
    points = floats(name, value, "m", error=SceneError)
    if points.shape[-1:] != (3,):
        raise SceneError(f"{name} has shape {points.shape}; it must be (n, 3) [m].")
    return points


def _quaternion(r: Floats) -> tuple[float, float, float, float]:
    """Return the unit quaternion (x, y, z, w) of a rotation matrix, with w of at least 0. The largest component is
    computed first, to avoid cancellation.

    Source: S. W. Shepperd, Quaternion from rotation matrix, J. Guidance and Control 1 (1978) 223.
    """
    trace = float(np.trace(r))
    candidates = np.array([r[0, 0], r[1, 1], r[2, 2], trace])
    i = int(np.argmax(candidates))
    q = np.empty(4)
    if i == 3:
        q[:] = (r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], 1 + trace)
    else:
        j, k = (i + 1) % 3, (i + 2) % 3
        q[i] = 1 + 2 * r[i, i] - trace
        q[j] = r[j, i] + r[i, j]
        q[k] = r[k, i] + r[i, k]
        q[3] = r[k, j] - r[j, k]
    q /= np.linalg.norm(q)
    if q[3] < 0:
        q = -q
    return (float(q[0]), float(q[1]), float(q[2]), float(q[3]))
