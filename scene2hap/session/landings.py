"""Find landings: a moved object stops suddenly while it touches the object that it moved towards.

A new contact alone is no landing: contacts reach across gaps of centimetres, since resting objects hover in real
scenes. Gently putting down an object is no landing either, since the hand slows over many frames. An object has landed
if it approached another one for some millimetres, and its next step is less than a third of the step before.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

from scene2hap.contact.graph import ContactGraph
from scene2hap.contact.junction import Junction
from scene2hap.scene.pose import Pose

WINDOW_S, MOST_STEPS = 0.05, 8
"""Time and number of updates over which a speed is measured."""
LEAST_TRAVEL_M = 0.004
"""Shortest fall in one direction: an object that jitters by a millimetre along three axes never moves so far."""
LEAST_SPEED_M_S = 0.1
"""Least speed of a landing: a cup put down more slowly is hardly felt, and jitter of trackers is as fast."""
FASTEST_M_S = 10.0
"""A faster motion is no fall (5 m): the game has moved the object elsewhere."""
LEFT = 0.3
"""Largest share of its speed that an object keeps when it lands."""
HEAD_ON = 0.5
"""Smallest share of the travel that is along the contact normal: an object that slides does not land."""
_SUDDEN = ((1 - LEFT) * HEAD_ON) ** 2
MOST_MOVING = 100
"""Most objects that are tracked at once; among so many moving objects a single landing is not noticed."""

Vector = tuple[float, float, float]


class Landing(NamedTuple):
    """An object that met another at a point [m], world, at a speed [m/s]."""

    object_id: str
    onto: str
    point_m: Vector
    speed_m_s: float


class _Track:
    """A moving object: its latest steps, the start of its present motion in one direction, and its last step.

    steps : number of the update, time [s] and pose of each step; stride : updates from one step to the next.
    """

    __slots__ = ("n_steps", "origin_m", "position_m", "since", "step_m", "steps", "stride")

    def __init__(self, update: int, time_s: float, pose: Pose) -> None:
        self.steps, self.stride = [(update, time_s, pose)], 1
        self.turn(update, pose.position_m)

    def turn(self, update: int, position_m: Vector) -> None:
        """Begin a motion in another direction."""
        self.since, self.n_steps, self.origin_m = update, 0, position_m
        self.position_m, self.step_m = position_m, (0.0, 0.0, 0.0)

    @property
    def is_falling(self) -> bool:
        """Whether it moved far enough in one direction, in more than one step; a single step may be a teleport."""
        return self.n_steps > 1 and math.dist(self.origin_m, self.position_m) >= LEAST_TRAVEL_M

    def is_sudden(self, onward: Vector) -> bool:
        """Whether an object's motion changed abruptly since the last frame. Runs for every moved object."""
        (x, y, z), (u, v, w) = onward, self.step_m
        x, y, z = x - u, y - v, z - w
        return x * x + y * y + z * z >= _SUDDEN * (u * u + v * v + w * w) and self.is_falling

    def follow(self, update: int, time_s: float, pose: Pose, onward: Vector) -> None:
        """Add a step."""
        steps = self.steps
        last = steps[-1][0]
        (x, y, z), (u, v, w) = onward, self.step_m
        if x * u + y * v + z * w <= 0:
            self.since, self.n_steps, self.origin_m = last, 0, self.position_m
        self.position_m, self.step_m, self.stride = pose.position_m, onward, update - last or 1
        self.n_steps += 1
        steps.append((update, time_s, pose))
        if len(steps) > 4 * MOST_STEPS:
            del steps[:-MOST_STEPS]

    def run(self) -> list[tuple[int, float]]:
        """Numbers and times [s] of the latest steps in one direction."""
        latest = [(update, time_s) for update, time_s, _ in self.steps[-MOST_STEPS:]]
        end_s = latest[-1][1]
        kept = [(update, time_s) for update, time_s in latest if update >= self.since and end_s - time_s <= WINDOW_S]
        return kept if len(kept) > 1 else latest[-2:]

    def pose_at(self, update: int) -> Pose:
        """Pose of the object after an update, or the first known pose after that."""
        return next((pose for later, _, pose in self.steps if later >= update), self.steps[-1][2])


class Landings:
    """Follows moving objects, and finds those that land.

    Parameters: graph : the contacts, read at each `look`; middle_m : returns the middle of an object's box, in its own
    frame [m]; period_s : usual time between updates, used while the clock does not advance.
    """

    def __init__(self, graph: ContactGraph, middle_m: Callable[[str], Vector], period_s: float) -> None:
        self._graph, self._middle_m, self._period_s = graph, middle_m, period_s
        self._tracks: dict[str, _Track] = {}
        self._n_updates = 0

    @property
    def follow_any(self) -> bool:
        """True if an object has moved lately."""
        return bool(self._tracks)

    def begin(self, moved: Mapping[str, Pose], time_s: float) -> None:
        """Store the poses of the objects that are about to move. Call it before the graph is updated."""
        tracks = self._tracks
        for object_id in moved:
            if object_id not in tracks and len(tracks) < MOST_MOVING and object_id in self._graph:
                pose = self._graph.pose(object_id)
                tracks[object_id] = _Track(self._n_updates, time_s - self._period_s, pose)

    def look(self, moved: Mapping[str, Pose], time_s: float) -> list[Landing]:
        """Find the objects that landed in this update. Call it after the graph was updated."""
        self._n_updates = now = self._n_updates + 1
        moving: list[tuple[_Track, Pose, Vector]] = []
        stopped: list[str] = []
        found: list[Landing] = []
        rests: list[str] = []
        beside = self._graph.beside  # an object without contacts has not landed
        for object_id, track in self._tracks.items():
            pose = moved.get(object_id)
            if pose is not None and pose.position_m != track.position_m:
                (x, y, z), (a, b, c) = pose.position_m, track.position_m
                onward = (x - a, y - b, z - c)
                moving.append((track, pose, onward))
                if beside.get(object_id) and track.is_sudden(onward):
                    stopped.append(object_id)
                continue
            late = now - track.steps[-1][0]
            if late == track.stride and beside.get(object_id) and track.is_falling:
                stopped.append(object_id)
            elif late > track.stride:
                rests.append(object_id)
        for object_id in stopped:
            found += self._landing(object_id, self._tracks[object_id])
        for track, pose, onward in moving:
            track.follow(now, time_s, pose, onward)
        for landing in found:
            track = self._tracks[landing.object_id]
            track.turn(now, track.position_m)
        for object_id in rests:
            del self._tracks[object_id]
        return found

    def _landing(self, object_id: str, track: _Track) -> list[Landing]:
        """The landing on the touched object that was approached the fastest; empty if there is none."""
        run = track.run()
        (first, begin_s), (before, _), (last, end_s) = run[0], run[-2], run[-1]
        best, most_m, now = None, LEAST_TRAVEL_M, self._n_updates
        for other, junction in self._graph.beside.get(object_id, {}).items():
            point = _middle(junction)
            normal = self._normal(object_id, other, point, junction)
            came = self._nearing(object_id, other, point, first, last)
            closing = _dot(came, normal)
            if closing > most_m and closing >= HEAD_ON * math.hypot(*came):
                step = _dot(self._nearing(object_id, other, point, before, last), normal)
                if _dot(self._nearing(object_id, other, point, last, now), normal) <= LEFT * step:
                    best, most_m = (other, point), closing
        if best is None:
            return []
        n_updates, elapsed_s = last - first, end_s - begin_s
        stands_still = elapsed_s <= 0 or (n_updates > 1 and run[1][1] == end_s)
        speed = most_m / (n_updates * self._period_s if stands_still else elapsed_s)
        return [Landing(object_id, *best, speed)] if LEAST_SPEED_M_S <= speed <= FASTEST_M_S else []

    def _nearing(self, object_id: str, other: str, point_m: Vector, since: int, until: int) -> Vector:
        """Displacement of a point of an object between two updates, relative to another object [m]."""
        x, y, z = self._went(object_id, point_m, since, until)
        a, b, c = self._went(other, point_m, since, until)
        return x - a, y - b, z - c

    def _went(self, object_id: str, point_m: Vector, since: int, until: int) -> Vector:
        track, pose = self._tracks.get(object_id), self._graph.pose(object_id)
        if track is None:
            return 0.0, 0.0, 0.0
        begin, end = track.pose_at(since), pose if until >= self._n_updates else track.pose_at(until)
        if begin.rotation_xyzw == end.rotation_xyzw == pose.rotation_xyzw:
            (a, b, c), (x, y, z) = begin.position_m, end.position_m
            return x - a, y - b, z - c
        own = pose.to_own([point_m])
        x, y, z = (end.to_world(own) - begin.to_world(own))[0].tolist()
        return x, y, z

    def _normal(self, object_id: str, other: str, point_m: Vector, junction: Junction) -> Vector:
        """Normal from the object to the other; without one, the direction from the object's middle to the contact."""
        for normal in junction.normals:
            if normal is not None:
                x, y, z = normal
                return normal if object_id < other else (-x, -y, -z)
        middle = self._graph.pose(object_id).to_world([self._middle_m(object_id)])[0]
        x, y, z = (np.array(point_m) - middle).tolist()
        length = math.hypot(x, y, z)
        return (x / length, y / length, z / length) if length > 0 else (0.0, 0.0, 0.0)


def _middle(junction: Junction) -> Vector:
    x, y, z = (sum(axis) / len(junction.points_m) for axis in zip(*junction.points_m, strict=True))
    return x, y, z


def _dot(one: Vector, other: Vector) -> float:
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
