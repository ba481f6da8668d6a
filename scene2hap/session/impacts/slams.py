"""Find what a door, a lid or a drawer slams against, where contacts do not show it.

A hinge is the only contact of a door or lid. It has met what it hangs on if the half of its box far from its axis was
clear of it when the motion began, and would pass through it with one more step like the last. Links of a robot that
moves are near each other all the time. So nothing slams against what moves on a hinge itself.

A drawer slides along its contacts, and models lack the stops behind it. It has met what encloses it if it is where the
scene has it: scenes are authored with their drawers closed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property, lru_cache
from itertools import product

import numpy as np

from scene2hap.contact.body import Body
from scene2hap.contact.enclosure import enclosed
from scene2hap.contact.geometry.boxes import Boxes
from scene2hap.contact.mesh_distance import MeshPair
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.scene.geometry import Vector
from scene2hap.scene.hinges import HINGE_PLAY_M
from scene2hap.scene.objects import Hinge, SceneObject
from scene2hap.scene.pose import Pose, in_own, in_world
from scene2hap.scene.shapes import Box

CLOSED_M = 0.005
"""Greatest distance of a closed drawer from its place in the scene [m]; assumed: physics engines let it rebound."""
_ENDS = np.array(list(product((0, 1), repeat=3)))
"""The end of a box along each axis at which each of its corners is."""


RelativePoses = Sequence[tuple[Pose, Pose]]
"""Poses of an object and of another one at the start of the motion, a step ago, and now."""


class Slam:
    """What a door or a lid may slam against with its far edge.

    holder : id of what the hinge holds it on; edge_m : the middle of its far side, in its own frame [m].
    """

    def __init__(self, item: SceneObject, holder: SceneObject, way: RelativePoses) -> None:
        self.holder: str = holder.id
        self._shape_of_holder, self._way = shape_of(holder.geometry.mesh), way
        before, now = _relative(way[1]), _relative(way[2])
        low, high = item.geometry.mesh.bounds_m
        corners_m = np.where(_ENDS, high, low)
        travels_m = np.linalg.norm(now.to_world(corners_m) - before.to_world(corners_m), axis=1)
        axis, end = max(product(range(3), (0, 1)), key=lambda side: travels_m[_ENDS[:, side[0]] == side[1]].sum())
        far = np.where(np.arange(3) == axis, (low, high)[end], (low + high) / 2)
        x, y, z = far.tolist()
        self.edge_m: Vector = (x, y, z)
        self._far_half = (far + (low + high) / 2) / 2, np.where(np.arange(3) == axis, 0.5, 1.0) * (high - low)
        self._travel_m = float(travels_m.max())

    def meets(self) -> bool:
        """Whether the holder is in the way of the far half. Finding it takes a millisecond."""
        return self._meets

    def misses(self) -> bool:
        """Whether the way of the far half is free."""
        return not self._meets

    @cached_property
    def _meets(self) -> bool:
        middle_m, sizes_m = self._far_half
        half, at = _box(tuple(sizes_m.tolist())), Pose(tuple(middle_m))
        begin, before, now = (_relative(poses).compose(at) for poses in self._way)
        # Steps of twice the play cannot pass through the holder: what is within the play on either side counts as met.
        shares = np.linspace(0, 1, 1 + math.ceil(self._travel_m / (2 * HINGE_PLAY_M))).tolist()
        poses = (begin, *(_onward(before, now, share) for share in shares))
        first, *onward = (Body("", half, pose, 1) for pose in poses)
        on = _near(self._shape_of_holder, [first, *onward])
        return on is not None and not _meet(first, on) and any(_meet(one, on) for one in onward)


def slam_of(item: SceneObject, hinge: Hinge, holder: SceneObject, way: RelativePoses) -> Slam | None:
    """Return what a door or lid on a hinge may slam against; None if the hinge does not hold, or if the holder moves on
    a hinge itself."""
    if holder.hinge is not None and way[0][1] != way[-1][1]:
        return None
    pose, its = way[-1]
    if math.dist(in_own(in_world(hinge.point_m, pose), its), hinge.other_point_m) >= HINGE_PLAY_M:
        return None
    return Slam(item, holder, way)


def is_closed(item: SceneObject, holder: SceneObject, way: RelativePoses, now: tuple[Pose, Pose], up_axis: int) -> bool:
    """Return True if a drawer is in a larger object as it is in the scene, or was within its last step and rebounds.

    Parameters: now : the poses after the step in which it stopped or turned, if that is no step of `way`.
    """
    authored, before, last, present = map(_place, ((item.pose, holder.pose), *way[-2:], now))
    travel_m = 0.0 if present == last else math.dist(before, last)
    if math.dist(last, authored) > CLOSED_M + travel_m:
        return False
    poses = way[-1]
    drawer, carcass = (
        Body("", shape_of(x.geometry.mesh), at, up_axis) for x, at in zip((item, holder), poses, strict=True)
    )
    return drawer.size_m < carcass.size_m and enclosed(drawer, carcass)[0] > 0


def _place(poses: tuple[Pose, Pose]) -> Vector:
    """Return the position of an object in the other's frame [m], as that of `_relative`, but quickly."""
    pose, its = poses
    return in_own(pose.position_m, its)


def _relative(poses: tuple[Pose, Pose]) -> Pose:
    pose, its = poses
    return its.inverse().compose(pose)


@lru_cache(64)
def _box(sizes_m: Vector) -> Shape:
    return shape_of(Box(sizes_m).mesh)


def _near(shape: Shape, bodies: Sequence[Body]) -> Body | None:
    """Return a shape without the triangles that are clear of all bodies, None if none is left."""
    low, high = np.min([one.low for one in bodies], axis=0), np.max([one.high for one in bodies], axis=0)
    columns = shape.boxes.meeting(Boxes(low[:, None], high[:, None]).grown(HINGE_PLAY_M))
    if not len(columns):
        return None
    # With contacts of an engine no search tree is ready. That of a detailed mesh would delay a frame; one of at most
    # twice as many triangles is rather kept.
    if not shape.is_prepared and 2 * len(columns) < shape.triangles.shape[2]:
        triangles = shape.triangles[:, :, columns]
        shape = Shape(triangles, triangles.reshape(3, -1).T)
    return Body("", shape, Pose(), 1)


def _meet(one: Body, other: Body) -> bool:
    return MeshPair(one, other).gap(HINGE_PLAY_M) is not None


def _onward(before: Pose, now: Pose, share: float) -> Pose:
    """Return the pose after a share of one more step like the last."""
    was, rotation = np.array(before.rotation_xyzw), np.array(now.rotation_xyzw)
    rotation = rotation + share * (rotation - math.copysign(1.0, was @ rotation) * was)
    position_m = np.array(now.position_m) + share * np.subtract(now.position_m, before.position_m)
    return Pose.of_checked(tuple(position_m.tolist()), tuple((rotation / np.linalg.norm(rotation)).tolist()))
