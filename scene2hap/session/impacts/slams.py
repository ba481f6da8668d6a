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
from scene2hap.scene.geometry import Vector, vector
from scene2hap.scene.hinges import HINGE_PLAY_M
from scene2hap.scene.objects import Hinge, SceneObject
from scene2hap.scene.pose import Pose, in_own, in_world
from scene2hap.scene.shapes import Box
from scene2hap.session.present_scene.network import own_middle_m

CLOSED_M = 0.005
"""Greatest distance of a closed drawer from its place in the scene [m]; assumed: physics engines let it rebound."""
_ENDS = tuple(product((0, 1), repeat=3))
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
        # Plain numbers, since a robot that flails has many of these in each frame.
        spans_m: list[list[float]] = item.geometry.mesh.bounds_m.T.tolist()
        _, before, now = way
        corners = map(vector, product(*spans_m))
        travels_m = [math.dist(_place(corner, before), _place(corner, now)) for corner in corners]
        axis, end = max(
            product(range(3), (0, 1)),
            key=lambda side: sum(x for x, ends in zip(travels_m, _ENDS, strict=True) if ends[side[0]] == side[1]),
        )
        far, lengths_m = [(low + high) / 2 for low, high in spans_m], [high - low for low, high in spans_m]
        half = [*far]
        far[axis] = spans_m[axis][end]
        half[axis] = (half[axis] + far[axis]) / 2
        lengths_m[axis] /= 2
        self.edge_m: Vector = vector(far)
        self._far_half = vector(half), vector(lengths_m)
        self._travel_m = max(travels_m)

    def meets(self) -> bool:
        """Whether the holder is in the way of the far half. Finding it takes a millisecond."""
        return self._meets

    def misses(self) -> bool:
        """Whether the way of the far half is free."""
        return not self._meets

    @cached_property
    def _meets(self) -> bool:
        middle_m, sizes_m = self._far_half
        half, at = _box(sizes_m), Pose(middle_m)
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


def may_enclose(holder: SceneObject, item: SceneObject, poses: tuple[Pose, Pose]) -> bool:
    """Return False if an object is clearly not in another one at the poses of both: the middle of its box is not in the
    other's."""
    low, high = holder.geometry.mesh.bounds_m.tolist()
    at_m = _place(own_middle_m(item), poses)
    return all(a <= x <= b for a, x, b in zip(low, at_m, high, strict=True))


def is_filled(holder: SceneObject) -> bool:
    """Return True if an object fills more than half of its box, as a solid cabinet; a crate or a room does not."""
    mesh = holder.geometry.mesh
    return mesh.volume_m3 > float(np.ptp(mesh.bounds_m, axis=0).prod()) / 2


def is_closed(item: SceneObject, holder: SceneObject, way: RelativePoses, now: tuple[Pose, Pose], up_axis: int) -> bool:
    """Return True if a drawer is in a larger object as it is in the scene, or was within its last step and rebounds.

    Parameters: now : the poses after the step in which it stopped or turned, if that is no step of `way`.
    """
    origin = (0.0, 0.0, 0.0)
    authored, before, last, present = (_place(origin, poses) for poses in ((item.pose, holder.pose), *way[-2:], now))
    travel_m = 0.0 if present == last else math.dist(before, last)
    if math.dist(last, authored) > CLOSED_M + travel_m:
        return False
    poses = way[-1]
    drawer, carcass = (
        Body("", shape_of(x.geometry.mesh), at, up_axis) for x, at in zip((item, holder), poses, strict=True)
    )
    return drawer.size_m < carcass.size_m and enclosed(drawer, carcass)[0] > 0


def _place(own_m: Vector, poses: tuple[Pose, Pose]) -> Vector:
    """Return a point of an object in the other's frame [m]."""
    pose, its = poses
    return in_own(in_world(own_m, pose), its)


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
