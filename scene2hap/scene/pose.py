"""Where a thing is: translation and unit quaternion in glTF order, without scale."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap import checks
from scene2hap.errors import SceneError

# A quaternion this close to unit length is kept to the last bit, so that JSON round trips are exact.
_UNIT_TOLERANCE = 1e-9


@dataclass(frozen=True)
class Pose:
    """A rigid placement: x_world = R x_own + position.

    Parameters: position_m : three numbers [m]; rotation_xyzw : quaternion (x, y, z, w), normalised if it is not.
    Raises: SceneError: a component is not finite or the quaternion is zero.
    """

    position_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rotation_xyzw: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)

    def __post_init__(self) -> None:
        position = checks.vector("position_m", self.position_m, "m", size=3, error=SceneError)
        rotation = checks.vector("rotation_xyzw", self.rotation_xyzw, "-", size=4, error=SceneError)
        length = math.hypot(*rotation)
        if length < 1e-12:
            raise SceneError("rotation_xyzw has length 0; a rotation is a unit quaternion. Use (0, 0, 0, 1) for none.")
        if abs(length - 1.0) > _UNIT_TOLERANCE:
            rotation = tuple(component / length for component in rotation)
        object.__setattr__(self, "position_m", position)
        object.__setattr__(self, "rotation_xyzw", rotation)

    @cached_property
    def rotation(self) -> NDArray[np.float64]:
        """Rotation matrix (3, 3) [-], own axes in its columns."""
        x, y, z, w = self.rotation_xyzw
        return np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        )

    @cached_property
    def _position(self) -> NDArray[np.float64]:
        return np.array(self.position_m)

    def to_world(self, points_own_m: ArrayLike) -> NDArray[np.float64]:
        """Points (n, 3) [m] of the own frame, in the world."""
        points = _points("points_own_m", points_own_m)
        moved: NDArray[np.float64] = points @ self.rotation.T + self._position
        return moved

    def to_own(self, points_m: ArrayLike) -> NDArray[np.float64]:
        """Points (n, 3) [m] of the world, in the own frame."""
        points = _points("points_m", points_m)
        own: NDArray[np.float64] = (points - self._position) @ self.rotation
        return own

    def compose(self, inner: Pose) -> Pose:
        """The pose whose frame is `inner`, given in the frame of this one."""
        ax, ay, az, aw = self.rotation_xyzw
        bx, by, bz, bw = inner.rotation_xyzw
        quaternion = (
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        )
        position = self.to_world(np.asarray(inner.position_m))
        return Pose((float(position[0]), float(position[1]), float(position[2])), quaternion)

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> Pose:
        """The pose of a rigid (4, 4) matrix.

        Raises: SceneError: the upper left 3 x 3 block is not a rotation.
        """
        m = checks.floats("matrix", matrix, "-", error=SceneError)
        if m.shape != (4, 4) or not np.isfinite(m).all():
            raise SceneError(f"matrix is not rigid: its shape is {m.shape}; it must be (4, 4) and finite.")
        r = m[:3, :3]
        if np.abs(r).max() > 2.0 or not np.allclose(r @ r.T, np.eye(3), atol=1e-6) or np.linalg.det(r) < 0:
            raise SceneError("matrix is not rigid: bake its scale or mirroring into the mesh first.")
        return cls(_triple(m[:3, 3]), _quaternion(r))


def _points(name: str, value: ArrayLike) -> NDArray[np.float64]:
    points = checks.floats(name, value, "m", error=SceneError)
    if points.shape[-1:] != (3,):
        raise SceneError(f"{name} has shape {points.shape}; it must be (n, 3) [m].")
    return points


def _triple(values: Sequence[float] | NDArray[np.float64]) -> tuple[float, float, float]:
    return (float(values[0]), float(values[1]), float(values[2]))


def _quaternion(r: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """Unit quaternion (x, y, z, w) of a rotation matrix, from its largest component so that nothing cancels.

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
