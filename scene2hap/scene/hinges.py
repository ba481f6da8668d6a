"""The play of hinges, hinges from the joints of engines and files, which give any point of the axis, and chains."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.objects import Hinge, SceneObject

HINGE_PLAY_M = 0.01
"""Distance of a hinge's two points, and of the boxes of its two objects, at which it ceases to hold [m] (assumed: doors
have gaps of 2 to 5 mm, and engines keep the points of joints within millimetres)."""

_FAR = 0.1
"""Distance of a pivot from an object's box, as a share of the box's diagonal, beyond which the joint is not one that
holds there (assumed): a pendulum of a mechanism that was not modelled."""


def hinge_at(
    item: SceneObject, other: SceneObject, anchor_m: NDArray[np.float64], axis: NDArray[np.float64] | None
) -> Hinge | None:
    """Return the hinge of an object on another, None if its pivot is far from one of the two.

    The pivot is moved along the axis to the middle of the stretch along which both objects extend: the middle of a
    door's edge, the bearing of a robot's link.

    Parameters: anchor_m : (3,) a point of the axis in the world [m]; axis : (3,) its unit vector, None for a ball.
    """
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


def welded_at(item: SceneObject, other: SceneObject) -> Hinge | None:
    """Return the hinge of an object that is fixed to another, in the middle of the space that is in both their boxes;
    None if the boxes are apart."""
    corners, others = other.pose.to_own(item.pose.to_world(item.geometry.mesh.corners_m)), other.geometry.mesh.corners_m
    low, high = np.maximum(corners.min(axis=0), others.min(axis=0)), np.minimum(corners.max(axis=0), others.max(axis=0))
    if (low - high).max() >= HINGE_PLAY_M:
        return None
    middle = (low + high) / 2
    return Hinge(other.id, item.pose.to_own(other.pose.to_world([middle]))[0].tolist(), middle.tolist())


class KinematicChain(NamedTuple):
    """Objects that hinges join, directly or by others: their ids in scene order, and the number of objects of its
    longest series, in which each is held on the one before."""

    ids: tuple[str, ...]
    n_in_series: int


def kinematic_chains(objects: Sequence[SceneObject]) -> dict[str, KinematicChain]:
    """Return the chain of each object that is held by a hinge or holds another, by the object's id."""
    before = series({item.id: item.hinge.to for item in objects if item.hinge is not None})
    members = dict[str, list[str]]()
    for item in objects:
        first, _ = before.get(item.id, (item.id, 0))
        members.setdefault(first, []).append(item.id)
    found = dict[str, KinematicChain]()
    for together in members.values():
        if len(together) > 1:
            chain = KinematicChain(tuple(together), max(before[x][1] for x in together if x in before) + 1)
            found.update(dict.fromkeys(together, chain))
    return found


def series(on: Mapping[str, str]) -> dict[str, tuple[str, int]]:
    """Return of each held object, by its id, the id of the first object of its chain, and the number of objects before
    it, each held on the one before. Objects that hold each other have the least id of their ring.

    Parameters: on : the id of the object that holds each held object.
    """
    found: dict[str, tuple[str, int]] = {}
    for x in on:
        passed: dict[str, None] = {}
        while x in on and x not in passed and x not in found:
            passed[x] = None
            x = on[x]
        way = list(passed)
        if x in passed:
            ring = way[way.index(x) :]
            found.update(dict.fromkeys(ring, (min(ring), len(ring) - 1)))
            way = way[: -len(ring)]
        first, n = found.get(x, (x, 0))
        found.update((held, (first, n + k)) for k, held in enumerate(reversed(way), 1))
    return found


def _from_box(item: SceneObject, point: NDArray[np.float64]) -> float:
    """Return the distance of a point of an object's frame from its box, as a share of the box's diagonal."""
    corners = item.geometry.mesh.corners_m
    low, high = corners.min(axis=0), corners.max(axis=0)
    return float(np.linalg.norm(np.maximum(np.maximum(low - point, point - high), 0.0)) / np.linalg.norm(high - low))
