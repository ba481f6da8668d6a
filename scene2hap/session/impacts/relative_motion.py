"""Motions of objects relative to each other, between two updates of a session."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.geometry import Vector, difference, dot
from scene2hap.scene.pose import in_own, in_world
from scene2hap.session.impacts.motion_track import MotionTrack
from scene2hap.session.impacts.slams import RelativePoses


class RelativeMotion:
    """The tracks of the objects that moved of late, and the travel of points of these objects.

    tracks : by id; an object without a track is at rest. n_updates : the number of the present update, in which the
    graph has the poses. Parts of objects are named by the point in the world at which they are now [m].
    """

    def __init__(self, graph: ContactGraph) -> None:
        self._graph = graph
        self.tracks: dict[str, MotionTrack] = {}
        self.n_updates: int = 0

    def nearing_m(self, object_id: str, other: str, point_m: Vector, since: int, until: int) -> Vector:
        """Return the travel of a point of an object between two updates, relative to another object."""
        came_m = self._travel_m(object_id, point_m, since, until)
        return difference(came_m, self._travel_m(other, point_m, since, until)) if other in self.tracks else came_m

    def middle_path_m(
        self, object_id: str, other: str, point_m: Vector, normal: Vector, since: int, until: int
    ) -> dict[int, float]:
        """Return the travel of an object's middle along a normal, relative to a point of another object, from one step
        to each of those until another one, by update."""
        track, is_moving = self.tracks[object_id], other in self.tracks
        path: dict[int, float] = {}
        begin = 0.0
        for update, pose in track.between(since, until):
            along = dot(in_world(track.own_m, pose), normal)
            if not path:
                begin = along
            if is_moving:
                along -= dot(self._travel_m(other, point_m, since, update), normal)
            path[update] = along - begin
        return path

    def turned_m(self, object_id: str, point_m: Vector, normal: Vector, since: int, until: int) -> float:
        """Return the sum over the steps of an object of its turn's sine times the arm from its middle to a point, along
        a normal."""
        track = self.tracks[object_id]
        turned_m, arm_m = 0.0, None
        for (_, begin), (_, end) in pairwise(track.between(since, until)):
            if begin.rotation_xyzw == end.rotation_xyzw:
                continue
            if arm_m is None:
                arm_m = np.subtract(point_m, in_world(track.own_m, self._graph.pose(object_id)))
            turn = end.rotation @ begin.rotation.T
            turned_m += dot(((turn - turn.T) / 2 @ arm_m).tolist(), normal)
        return turned_m

    def poses(self, object_id: str, other: str) -> RelativePoses:
        """Return the poses of both at the start of the object's motion, before its last step and after it."""
        track, theirs, its = self.tracks[object_id], self.tracks.get(other), self._graph.pose(other)
        (before, *_), (last, *_) = track.steps[-2:]
        begin = max(track.since, track.steps[0][0], theirs.steps[0][0] if theirs is not None else 0)
        updates = (begin, before, last)
        return [(track.pose_at(x), theirs.pose_at(x) if theirs is not None else its) for x in updates]

    def _travel_m(self, object_id: str, point_m: Vector, since: int, until: int) -> Vector:
        """Return the travel of a point of an object with a track between two updates."""
        track, pose = self.tracks[object_id], self._graph.pose(object_id)
        begin, end = track.pose_at(since), pose if until >= self.n_updates else track.pose_at(until)
        if begin.rotation_xyzw == end.rotation_xyzw == pose.rotation_xyzw:
            return difference(end.position_m, begin.position_m)
        own_m = in_own(point_m, pose)
        return difference(point_m if end is pose else in_world(own_m, end), in_world(own_m, begin))
