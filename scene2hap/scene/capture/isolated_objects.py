"""Scenes of one object, upright at the origin, so that equal objects of all scenes give equal pictures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from scene2hap.scene.objects import VERTICAL, SceneObject, UpAxis
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot

SUBJECT = "object"
"""The id of the object in a scene of its own."""

_DIGITS = 6
"""Decimals of rotations. Rotations of one mesh in two scenes may differ in the last digits, so they are rounded."""


def by_itself(item: SceneObject, up_axis: UpAxis) -> SceneSnapshot:
    """Return a scene of one object at the origin. Only its rotation about the vertical is undone."""
    # The grey of an object without looks depends on these two fields.
    unnamed = replace(item, id=SUBJECT, instance_key=item.instance_key if item.appearance else "")
    return SceneSnapshot("object", up_axis, (replace(unnamed, pose=_upright(item.pose, up_axis), images=None),))


def _upright(pose: Pose, up_axis: UpAxis) -> Pose:
    """Return the smallest rotation that leaves the same side of the object up."""
    vertical = VERTICAL[up_axis]
    up = np.eye(3)[vertical]
    side = pose.rotation.T @ up
    # Quaternion from `side` to `up`, not normalised. For opposite vectors, any perpendicular axis is right.
    quaternion = np.array([*np.cross(side, up), 1.0 + side @ up])
    if quaternion[3] < 10.0**-_DIGITS:
        quaternion = np.array([1.0, 0.0, 0.0, 0.0])
    x, y, z, w = (np.round(quaternion / np.linalg.norm(quaternion), _DIGITS) + 0.0).tolist()
    return Pose((0.0, 0.0, 0.0), (x, y, z, w))
