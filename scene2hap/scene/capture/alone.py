"""Objects by themselves, upright at the origin, so that equal objects of any scenes give equal pictures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from scene2hap.scene.objects import SceneObject, UpAxis
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot

SUBJECT = "object"
"""The id of the object in a scene of its own."""

_DIGITS = 6
"""Decimals to which rotations are rounded, since those of one mesh in two scenes may differ in the last digits."""


def by_itself(item: SceneObject, up_axis: UpAxis) -> SceneSnapshot:
    """A scene of one object at the origin, turned back about the vertical; it stands or lies as it did."""
    # Without looks, an object's grey is chosen by these two.
    unnamed = replace(item, id=SUBJECT, instance_key=item.instance_key if item.appearance else "")
    return SceneSnapshot("object", up_axis, (replace(unnamed, pose=_upright(item.pose, up_axis), images=None),))


def _upright(pose: Pose, up_axis: UpAxis) -> Pose:
    """The smallest rotation that leaves the same side of the object up."""
    vertical = {"y": 1, "z": 2}[up_axis]
    up = np.eye(3)[vertical]
    side = pose.rotation.T @ up
    # Half of a turn about an axis between both; where they are opposite, about any axis across.
    quaternion = np.array([*np.cross(side, up), 1.0 + side @ up])
    if quaternion[3] < 10.0**-_DIGITS:
        quaternion = np.array([1.0, 0.0, 0.0, 0.0])
    x, y, z, w = (np.round(quaternion / np.linalg.norm(quaternion), _DIGITS) + 0.0).tolist()
    return Pose((0.0, 0.0, 0.0), (x, y, z, w))
