"""Comparison of an engine's poses with a session's: only motion beyond numerical noise counts.

Objects at rest tremble in a simulation, and each moved pose makes the contact graph search for contacts again.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from operator import mul

import numpy as np

from scene2hap.common.arrays import Bools, Floats
from scene2hap.scene.pose import Pose
from scene2hap.scene.pose_table import PoseTable
from scene2hap.session import HapticSession
from scene2hap.session.arguments import require_pose

AT_REST_M, AT_REST_RAD = 1e-4, 1e-3
"""Largest motion and rotation of an object at rest. Assumed: 0.1 mm, and 0.1 mm at 10 cm from the pivot; contacts are
found to millimetres."""

# |q . p| = cos(angle / 2), since q and -q are the same rotation.
_COS_AT_REST = math.cos(AT_REST_RAD / 2)
_NOWHERE = Pose()  # placeholder for objects that only the engine has


def moved(now: Mapping[str, Pose], before: Mapping[str, Pose]) -> dict[str, Pose]:
    """Return the poses in `now` that are new, or differ from `before` by more than an object at rest moves.

    Add them to the next `before`, so that slow motion adds up.
    """
    return {
        object_id: pose
        for object_id, pose in now.items()
        if (old := before.get(object_id)) is not pose
        and (
            old is None
            or math.dist(pose.position_m, old.position_m) > AT_REST_M
            or abs(sum(map(mul, pose.rotation_xyzw, old.rotation_xyzw))) < _COS_AT_REST
        )
    }


class Changes:
    """Find the engine's poses that differ from the last ones passed to the session, so that slow motion adds up.

    Tables are compared as arrays, mappings one by one. The session's poses are read again whenever objects were added
    or removed, and after `forget`.
    """

    def __init__(self, session: HapticSession) -> None:
        self._session = session
        self._followed: frozenset[str] = frozenset()
        self._known: dict[str, Pose] = {}
        self._ids: tuple[str, ...] = ()
        self._is_followed: Bools = np.empty(0, dtype=bool)
        self._positions: Floats = np.empty((0, 3))
        self._rotations: Floats = np.empty((0, 4))

    def forget(self) -> None:
        """Read the session's poses again. Call this after a refused update, since the session may have applied a part
        of it."""
        self._followed, self._ids = frozenset(), ()

    def of(self, poses: Mapping[str, Pose]) -> dict[str, Pose]:
        """Return the moved poses of the session's objects.

        Raises: SceneError: a value is no Pose.
        """
        return self._of_table(poses) if isinstance(poses, PoseTable) else self._of_mapping(poses)

    def _of_mapping(self, poses: Mapping[str, Pose]) -> dict[str, Pose]:
        followed = self._session.object_ids
        if followed is not self._followed:
            self._followed, self._known = followed, dict(self._session.poses)
        try:
            changed = {key: pose for key, pose in moved(poses, self._known).items() if key in followed}
        except AttributeError:  # a value is no Pose
            for object_id, pose in poses.items():
                require_pose(object_id, pose)
            raise
        self._known.update(changed)
        return changed

    def _of_table(self, table: PoseTable) -> dict[str, Pose]:
        followed = self._session.object_ids
        if table.ids != self._ids or followed is not self._followed:
            self._ids, self._followed = table.ids, followed
            self._is_followed = np.array([object_id in followed for object_id in table.ids], dtype=bool)
            known = [self._session.poses.get(object_id, _NOWHERE) for object_id in table.ids]
            self._positions = np.array([pose.position_m for pose in known]).reshape(-1, 3)
            self._rotations = np.array([pose.rotation_xyzw for pose in known]).reshape(-1, 4)
        way = ((table.positions_m - self._positions) ** 2).sum(axis=1)
        turn = np.abs((table.rotations_xyzw * self._rotations).sum(axis=1))
        rows = np.flatnonzero(self._is_followed & ((way > AT_REST_M**2) | (turn < _COS_AT_REST)))
        self._positions[rows], self._rotations[rows] = table.positions_m[rows], table.rotations_xyzw[rows]
        return table.poses(rows)
