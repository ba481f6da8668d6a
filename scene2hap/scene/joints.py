"""The joints of files and engines as hinges of objects.

A body that turns on another is held there, and so is one that is fixed to one that moves. Bodies that do not move have
the contacts that geometry finds, such as all of a shelf's on its wall. Files and engines give any point of an axis, so
the hinge is moved to the middle of the stretch along which both objects extend: the middle of a door's edge, the
bearing of a robot's link.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Literal, NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.scene.geometry import distances
from scene2hap.scene.hinges import HINGE_PLAY_M
from scene2hap.scene.objects import Hinge, SceneObject
from scene2hap.scene.tree import AuthoredPivot

Motion = Literal["fixed", "turns", "other"]
"""How a joint lets a body move: not at all, about an axis or a point, or otherwise, such as along a slide."""

_FAR = 0.1
"""Distance of a pivot from an object's box, as a share of the box's diagonal, beyond which the joint is not one that
holds there (assumed): a pendulum of a mechanism that was not modelled."""


class Joint(NamedTuple):
    """The joint by which a body is on another, given by its key: how it moves there, a point (3,) of its axis in the
    unit of the scene, and the axis (3,) of length 1, None for a ball."""

    on: str
    motion: Motion
    anchor: Floats | None = None
    axis: Floats | None = None


def pivots(joints: Mapping[str, Joint], drawn: Collection[str]) -> Iterator[AuthoredPivot]:
    """Yield the pivots between bodies that have geometry, also across bodies without it that are fixed.

    Parameters: joints : the joint of each body that has one, by the body's key, without rings. A body without a joint
    does not move. drawn : the keys of the bodies with geometry.
    """
    for key, joint in joints.items():
        on = joint.on
        while on not in drawn and on in joints and joints[on].motion == "fixed":
            on = joints[on].on
        if joint.motion == "fixed" and _moves(on, joints):
            yield AuthoredPivot(key, on)
        elif joint.motion == "turns":
            yield AuthoredPivot(key, on, joint.anchor, joint.axis)


def hinges(by_key: Mapping[str, SceneObject], pivots: Iterable[AuthoredPivot], unit_m: float) -> dict[str, Hinge]:
    """Return the hinges of objects, by the id of the held one, at pivots in a unit of `unit_m` metres.

    Parameters: by_key : the objects by the keys of their bodies. A pivot far from one of its two objects, or of a body
    that is no object, makes no hinge.
    """
    found = {}
    for pivot in pivots:
        item, other = by_key.get(pivot.key), by_key.get(pivot.on)
        if item is None or other is None:
            continue
        anchor = pivot.anchor
        hinge = _fixed(item, other) if anchor is None else _turning(item, other, anchor * unit_m, pivot.axis)
        if hinge is not None:
            found[item.id] = hinge
    return found


def _turning(item: SceneObject, other: SceneObject, anchor_m: Floats, axis: Floats | None) -> Hinge | None:
    """Return the hinge of an object that turns on another; None if its pivot is far from one of the two."""
    both = (item, other)
    if axis is not None:
        along = [(one.pose.to_world(one.geometry.mesh.corners_m) - anchor_m) @ axis for one in both]
        first, last = max(each.min() for each in along), min(each.max() for each in along)
        anchor_m = anchor_m + (first + last) / 2 * axis
    points = [one.pose.to_own(anchor_m[None])[0] for one in both]
    if any(_from_box(one, point) > _FAR for one, point in zip(both, points, strict=True)):
        return None
    here, there = (tuple(point.tolist()) for point in points)
    return Hinge(other.id, here, there)


def _fixed(item: SceneObject, other: SceneObject) -> Hinge | None:
    """Return the hinge of an object that is fixed to another, in the middle of the space that is in both their boxes;
    None if the boxes are apart."""
    low, high = other.geometry.mesh.bounds_m
    corners = other.pose.to_own(item.pose.to_world(item.geometry.mesh.corners_m))
    low, high = np.maximum(corners.min(axis=0), low), np.minimum(corners.max(axis=0), high)
    if (low - high).max() >= HINGE_PLAY_M:
        return None
    middle = (low + high) / 2
    return Hinge(other.id, item.pose.to_own(other.pose.to_world([middle]))[0].tolist(), middle.tolist())


def _from_box(item: SceneObject, point: Floats) -> float:
    """Return the distance of a point of an object's frame from its box, as a share of the box's diagonal."""
    box = item.geometry.mesh.bounds_m
    return float(distances(np.stack((point, point)), box) / np.linalg.norm(np.ptp(box, axis=0)))


def _moves(body: str, joints: Mapping[str, Joint]) -> bool:
    while body in joints and joints[body].motion == "fixed":
        body = joints[body].on
    return body in joints
