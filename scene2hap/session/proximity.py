"""Touches of tracked points, such as finger tips, for a game that has no collisions of its own.

A point touches every object whose surface is near it. Tracked hands pass through virtual objects, so a point behind a
face, inside the object, may be farther from it than a point in front. A touch ends at a greater distance than that at
which it begins. Otherwise a trembling finger would touch in every other frame. Toolkits do the same: MRTK's
`DebounceThreshold`, the on and off thresholds of OpenXR's `XR_VALVE_analog_threshold`.

The box around an object leaves few objects to search for each point, and the tree over its triangles few triangles.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats, Indices
from scene2hap.contact.geometry.boxes import Boxes
from scene2hap.contact.geometry.triangle_tree import ALL, meeting
from scene2hap.contact.geometry.triangles import nearest_points
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.session.frame import Touch

RELEASE = 1.5
"""Distance at which a touch ends, as a multiple of that at which it begins; assumed: at 1 cm a margin of 5 mm, several
times the noise of trackers."""
_EQUAL = 1e-9
"""Distances that differ by less than this share are those of faces with a common nearest edge or corner."""


class _Near(NamedTuple):
    """A point in the frame of an object near it [m], the numbers of both, the largest multiple of the given distances
    at which it touches the object, and the columns of the triangles near it."""

    point: int
    item: int
    own_point: Floats
    release: float
    columns: Indices


class Proximity:
    """Finds the objects near points. Keeps the shapes, boxes and poses of all objects between calls."""

    def __init__(self) -> None:
        self._objects: Mapping[str, SceneObject] = {}
        self._ids: tuple[str, ...] = ()
        self._numbers: dict[str, int] = {}
        self._shapes: list[Shape] = []
        self._poses: list[Pose | None] = []
        self._boxes, self._rotations, self._positions = np.empty((2, 0, 3)), np.empty((0, 3, 3)), np.empty((0, 3))

    def touches(
        self,
        points_m: Mapping[str, Floats],
        objects: Mapping[str, SceneObject],
        poses: Mapping[str, Pose],
        within_m: float,
        depth_m: float,
        held: Mapping[str, Iterable[Touch]],
    ) -> list[Touch]:
        """Return the touches of the points (n, 3) [m] of each hand with objects at these poses.

        A point touches a surface that is up to `within_m` away, or up to `depth_m` if it lies behind the face there.
        Parameters: held : the present touches of each hand, which end at `RELEASE` times these distances.
        """
        self._follow(objects, poses)
        hands = [hand for hand, points in points_m.items() for _ in points]
        if not hands:
            return []
        points = np.concatenate([*points_m.values()])
        near = self._near(points, max(within_m, depth_m), self._releases(hands, held))
        if not near:
            return []
        counts = np.array([len(one.columns) for one in near])
        triangles = [self._shapes[one.item].triangles.take(one.columns, axis=2) for one in near]
        own_points = np.repeat(np.array([one.own_point for one in near]).T, counts, axis=1)
        points, distances, heights = nearest_points(own_points, np.concatenate(triangles, axis=2))
        found = []
        for one, first, n in zip(near, (np.cumsum(counts) - counts).tolist(), counts.tolist(), strict=True):
            least = float(distances[first : first + n].min())
            # Of the faces at an edge or a corner, the one that looks most towards the point or away from it decides.
            equal = first + np.flatnonzero(distances[first : first + n] <= least * (1.0 + _EQUAL))
            k = equal[np.abs(heights[equal]).argmax()]
            if least <= one.release * (depth_m if heights[k] < 0.0 else within_m):
                object_id = self._ids[one.item]
                (touched,) = poses[object_id].to_world(points[:, k][None]).tolist()
                found.append(Touch(hands[one.point], object_id, touched))
        return found

    def _releases(self, hands: Sequence[str], held: Mapping[str, Iterable[Touch]]) -> Floats:
        """Return the multiple of a distance at which each point touches each object (n_points, n_objects)."""
        releases = np.ones((len(hands), len(self._ids)))
        for hand, touches in held.items():
            rows = [i for i, its in enumerate(hands) if its == hand]
            for object_id in {touch.object_id for touch in touches}:
                releases[rows, self._numbers[object_id]] = RELEASE
        return releases

    def _near(self, points: Floats, reach_m: float, releases: Floats) -> list[_Near]:
        """Return the points (n, 3) [m] that are within `reach_m` times their release of the boxes around triangles, for
        each object."""
        own_points = np.einsum("kij,nki->nkj", self._rotations, points[:, None] - self._positions)
        low, high = self._boxes
        reaches = reach_m * releases[:, :, None]
        is_near = ((own_points >= low - reaches) & (own_points <= high + reaches)).all(axis=2)
        found = []
        for i, k in np.argwhere(is_near).tolist():
            release = float(releases[i, k])
            columns = _columns_near(self._shapes[k], own_points[i, k], release * reach_m)
            if columns.size:
                found.append(_Near(i, k, own_points[i, k], release, columns))
        return found

    def _follow(self, objects: Mapping[str, SceneObject], poses: Mapping[str, Pose]) -> None:
        """Take over the objects that were added or removed since the last call, and the poses that changed."""
        if objects is not self._objects:
            self._objects, self._ids, n = objects, tuple(objects), len(objects)
            self._numbers = {object_id: k for k, object_id in enumerate(objects)}
            self._shapes = [shape_of(item.geometry.mesh) for item in objects.values()]
            self._boxes = np.array([item.geometry.mesh.bounds_m for item in objects.values()]).reshape(n, 2, 3)
            self._boxes = np.ascontiguousarray(self._boxes.transpose(1, 0, 2))
            self._poses, self._rotations, self._positions = [None] * n, np.empty((n, 3, 3)), np.empty((n, 3))
        for k, object_id in enumerate(self._ids):
            pose = poses[object_id]
            if pose is not self._poses[k]:
                self._poses[k], self._rotations[k], self._positions[k] = pose, pose.rotation, pose.position_m


def _columns_near(shape: Shape, own_point: Floats, reach_m: float) -> Indices:
    """Return the columns of the triangles whose boxes are within `reach_m` of a point in the shape's frame [m]."""
    if not shape.is_prepared:
        # To build the tree would delay this frame, by 0.4 s for 100,000 triangles.
        return shape.boxes.meeting(Boxes(own_point[:, None] - reach_m, own_point[:, None] + reach_m))
    x, y, z = own_point.tolist()
    low, high = (x - reach_m, y - reach_m, z - reach_m), (x + reach_m, y + reach_m, z + reach_m)
    return meeting(shape.tree, low, high, ALL)
