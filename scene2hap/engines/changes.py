"""Which poses of an engine a session has not been handed yet."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.engines.motion import AT_REST_M, AT_REST_RAD, moved
from scene2hap.scene.pose import Pose
from scene2hap.scene.pose_table import PoseTable
from scene2hap.session.given import require_pose

Floats = NDArray[np.float64]
_COS_AT_REST = math.cos(AT_REST_RAD / 2)


class Changes:
    """Compares poses with those last handed on, so that slow motion adds up; tables as arrays, mappings one by one."""

    def __init__(self) -> None:
        self._followed: frozenset[str] = frozenset()
        self._known: dict[str, Pose] = {}
        self._ids: tuple[str, ...] = ()
        self._is_followed: NDArray[np.bool_] = np.empty(0, dtype=bool)
        self._positions: Floats = np.empty((0, 3))
        self._rotations: Floats = np.empty((0, 4))

    def of(self, poses: Mapping[str, Pose], followed: frozenset[str]) -> dict[str, Pose]:
        """The poses of the objects `followed` that moved, or that are followed anew.

        Raises: SceneError: a value is no Pose.
        """
        return self._of_table(poses, followed) if isinstance(poses, PoseTable) else self._of_mapping(poses, followed)

    def _of_mapping(self, poses: Mapping[str, Pose], followed: frozenset[str]) -> dict[str, Pose]:
        if followed is not self._followed:
            self._known = {object_id: pose for object_id, pose in self._known.items() if object_id in followed}
            self._followed = followed
        try:
            changed = {key: pose for key, pose in moved(poses, self._known).items() if key in followed}
        except AttributeError:  # of something that is no Pose
            for object_id, pose in poses.items():
                require_pose(object_id, pose)
            raise
        self._known.update(changed)
        return changed

    def _of_table(self, table: PoseTable, followed: frozenset[str]) -> dict[str, Pose]:
        if table.ids != self._ids:
            self._ids, self._positions = table.ids, table.positions_m.copy()
            self._rotations, self._followed = np.zeros_like(table.rotations_xyzw), frozenset()
        if followed is not self._followed:
            self._is_followed = np.array([object_id in followed for object_id in self._ids], dtype=bool)
            # No rotation is 0, so an object that comes back counts as moved.
            self._rotations[~self._is_followed] = 0.0
            self._followed = followed
        way = ((table.positions_m - self._positions) ** 2).sum(axis=1)
        # |q . p| = cos(angle / 2); either sign of a quaternion is the same rotation.
        turn = np.abs((table.rotations_xyzw * self._rotations).sum(axis=1))
        rows = np.flatnonzero(self._is_followed & ((way > AT_REST_M**2) | (turn < _COS_AT_REST)))
        positions, rotations = table.positions_m[rows], table.rotations_xyzw[rows]
        self._positions[rows], self._rotations[rows] = positions, rotations
        moves = zip(rows.tolist(), positions.tolist(), rotations.tolist(), strict=True)
        return {self._ids[row]: Pose((x, y, z), (a, b, c, d)) for row, (x, y, z), (a, b, c, d) in moves}
