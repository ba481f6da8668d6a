"""Find landings: a moved object stops suddenly while it touches the object that it moved towards.

A new contact alone is no landing: contacts reach across gaps of centimetres, since resting objects hover in real
scenes. A hand that puts something down gently makes none, since it slows over many frames. An object has landed if it
approached another one for some millimetres, and moves on by less than a third as far and as fast from one frame to the
next. Where physics runs more slowly than the frames, a frame without a step is no stop: the longest of the latest gaps
between steps has to pass. A motion is that of an object's middle, since its origin may lie on a hinge.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from itertools import pairwise
from types import MappingProxyType
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
"""A cup put down more slowly is as good as not felt, and trackers shake as fast."""
FASTEST_M_S = 10.0
"""A faster motion is no fall (5 m): the game has moved the object elsewhere."""
LEFT = 0.3
"""Largest share of its speed that an object keeps after it landed."""
HEAD_ON = 0.5
"""Smallest share of its travel along the normal of a contact: an object that slides along does not land."""
BRAKES_M_S2, BRAKES_M_S = 10.0, 0.2
"""Largest deceleration of an object that a hand carries, lowers or shakes, and the largest loss of speed from one step
to the next that is taken for one; assumed. Below 50 Hz the latter counts, since a short fall lasts for few frames."""
ROLLS = 0.25
"""Share of the closing of a turning object's part that its middle takes part in: that of one that rolls keeps its
distance, while each part of its rim comes down."""
LONGEST_GAP_S, MOST_GAP = 0.12, 12
"""Longest time, and number of updates, from one step of a motion to the next: physics at 10 Hz; assumed."""
GAP_DECAYS = 0.1
"""By how many updates a remembered gap shrinks with each step: 50 Hz in 60 Hz leaves a frame out in every sixth."""
_SUDDEN = ((1 - LEFT) * HEAD_ON) ** 2
MOST_MOVING = 100
"""Objects followed at once; among so many moving objects a single landing is not noticed."""

Vector = tuple[float, float, float]
NOWHERE = (0.0, 0.0, 0.0)
NOTHING: Mapping[str, Junction] = MappingProxyType({})


class Landing(NamedTuple):
    """An object that met another at a point [m], world, at a speed [m/s]."""

    object_id: str
    onto: str
    point_m: Vector
    speed_m_s: float


class _Track:
    """A moving object: its latest steps, the start of its present motion in one direction, and its last step.

    pose : the latest; own_m, middle_m : the middle of its box in its own frame, and at the latest pose in the world
    [m]; steps : number of the update, time [s] and pose, for every moved object in every frame; gap : updates from one
    step to the next, the longest lately; stopped_m : its last step before it landed without a further step; goes_on :
    such a landing was a pause; near : what it touched before the present update, while it falls.
    """

    __slots__ = (
        "gap",
        "goes_on",
        "middle_m",
        "n_steps",
        "near",
        "origin_m",
        "own_m",
        "pose",
        "since",
        "step_m",
        "steps",
        "stopped_m",
    )

    def __init__(self, update: int, time_s: float, pose: Pose, own_m: Vector) -> None:
        self.steps, self.pose = [(update, time_s, pose)], pose
        self.own_m, self.middle_m = own_m, _turned(own_m, pose)
        self.gap, self.goes_on, self.stopped_m = 1.0, False, NOWHERE
        self.near: Mapping[str, Junction] = NOTHING
        self.turn(update)

    def turn(self, update: int) -> None:
        """Begin a motion in another direction."""
        self.since, self.n_steps, self.origin_m, self.step_m = update, 0, self.middle_m, NOWHERE

    def stop(self, update: int) -> None:
        """Begin again after a landing without a further step."""
        stopped_m = self.step_m
        self.turn(update)
        self.stopped_m = stopped_m

    @property
    def is_falling(self) -> bool:
        """Whether it moved far enough in one direction; in a single step the game has moved it elsewhere."""
        return self.n_steps > 1 and not self.goes_on and math.dist(self.origin_m, self.middle_m) >= LEAST_TRAVEL_M

    def has_stopped(self, update: int) -> bool:
        """Whether a step is missing since exactly this update."""
        return self.steps[-1][0] + math.ceil(self.gap) == update

    def is_at_rest(self, update: int) -> bool:
        """Whether no further step of this motion is to be expected."""
        return update - self.steps[-1][0] > MOST_GAP

    def turns(self, onward: Vector) -> bool:
        """Whether an object bounces off: a fast one has left what it met by the next frame."""
        return _dot(onward, self.step_m) < 0

    def is_sudden(self, onward: Vector) -> bool:
        """Whether an object's motion changed abruptly since the last frame. Runs for every moved object."""
        (x, y, z), (u, v, w) = onward, self.step_m
        x, y, z = x - u, y - v, z - w
        return x * x + y * y + z * z >= _SUDDEN * (u * u + v * v + w * w) and self.is_falling

    def follow(self, update: int, time_s: float, pose: Pose, onward: Vector, middle_m: Vector) -> None:
        """Add a step."""
        steps = self.steps
        last, last_s, _ = steps[-1]
        (x, y, z), (u, v, w) = onward, self.step_m
        waited = update - last
        if waited > 1 and time_s - last_s > LONGEST_GAP_S:
            self.turn(last)
            self.gap, self.goes_on = 1.0, False
        else:
            self.gap = max(1.0, waited, self.gap - GAP_DECAYS)
            if x * u + y * v + z * w <= 0:
                stopped = self.stopped_m
                self.turn(last)
                self.goes_on = stopped is not NOWHERE and _dot(onward, stopped) > LEFT * _dot(stopped, stopped)
        self.stopped_m = NOWHERE
        self.pose, self.middle_m, self.step_m = pose, middle_m, onward
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
        """Pose of the object after an update, or the first known one after it."""
        return next((pose for later, _, pose in self.steps if later >= update), self.steps[-1][2])


class Landings:
    """Follows moving objects, and finds those that land.

    Parameters: graph : the contacts, read at each `look`; middle_m : of an object's box, in its own frame [m];
    period_s : usual time between updates, for a clock that stands still.
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
        """Keep the poses of the objects that are about to move. Call it before the graph moves."""
        tracks, beside = self._tracks, self._graph.beside
        for object_id, moves_to in moved.items():
            track = tracks.get(object_id)
            if track is not None:
                near = beside.get(object_id)
                track.near = dict(near) if near and track.is_falling else NOTHING
            elif len(tracks) < MOST_MOVING and object_id in self._graph:
                pose = self._graph.pose(object_id)
                # Some games give the poses of all objects in every frame. The graph refuses what is no pose.
                if isinstance(moves_to, Pose) and pose != moves_to:
                    own_m = self._middle_m(object_id)
                    tracks[object_id] = _Track(self._n_updates, time_s - self._period_s, pose, own_m)

    def look(self, moved: Mapping[str, Pose], time_s: float) -> list[Landing]:
        """Find the objects that landed in this update. Call it after the graph moved."""
        self._n_updates = now = self._n_updates + 1
        moving: list[tuple[_Track, Pose, Vector, Vector]] = []
        stopped: list[str] = []
        found: list[Landing] = []
        rests: list[str] = []
        beside = self._graph.beside  # what touches nothing has not landed
        for object_id, track in self._tracks.items():
            pose = moved.get(object_id)
            before = track.pose
            if pose is not None and (
                pose.position_m != before.position_m or pose.rotation_xyzw != before.rotation_xyzw
            ):
                (a, b, c) = track.middle_m
                if pose.rotation_xyzw == before.rotation_xyzw:
                    (x, y, z), (u, v, w) = pose.position_m, before.position_m
                    onward = (x - u, y - v, z - w)
                    middle_m = (a + onward[0], b + onward[1], c + onward[2])
                else:
                    x, y, z = middle_m = _turned(track.own_m, pose)
                    onward = (x - a, y - b, z - c)
                moving.append((track, pose, onward, middle_m))
                if track.is_sudden(onward) and (beside.get(object_id) or (track.near and track.turns(onward))):
                    stopped.append(object_id)
            elif track.has_stopped(now) and beside.get(object_id) and track.is_falling:
                stopped.append(object_id)
            elif track.is_at_rest(now):
                rests.append(object_id)
        for object_id in stopped:
            found += self._landing(object_id, self._tracks[object_id], time_s)
        for track, pose, onward, middle_m in moving:
            track.follow(now, time_s, pose, onward, middle_m)
        for landing in found:
            track = self._tracks[landing.object_id]
            if track.steps[-1][0] == now:
                track.turn(now)
            else:
                track.stop(now)
        for object_id in rests:
            del self._tracks[object_id]
        met = {(one.object_id, one.onto) for one in found}
        # Two objects that met each other landed once.
        return [x for x in found if (x.onto, x.object_id) not in met or x.object_id < x.onto]

    def _landing(self, object_id: str, track: _Track, time_s: float) -> list[Landing]:
        """The landing on the object that was approached the fastest, of all that it touches; empty if there is none."""
        run = track.run()
        (first, begin_s), (before, _), (last, end_s) = run[0], run[-2], run[-1]
        best, most_m, now = None, LEAST_TRAVEL_M, self._n_updates
        # After a long frame the next step is short, without being slow. A clock that stands still tells nothing.
        lasted_s, lasts_s = end_s - run[-2][1], time_s - end_s
        slower = min(1.0, lasts_s / lasted_s) if lasted_s > 0 and lasts_s > 0 else 1.0
        for other, junction in (self._graph.beside.get(object_id) or track.near).items():
            point = _middle(junction)
            normal = self._normal(object_id, other, point, junction)
            came = self._nearing(object_id, other, point, first, last)
            closing = _dot(came, normal)
            if closing > most_m and closing >= HEAD_ON * math.hypot(*came):
                step = _dot(self._nearing(object_id, other, point, before, last), normal)
                onward = _dot(self._nearing(object_id, other, point, last, now), normal)
                if onward > LEFT * step * slower or self._rolls(object_id, track, normal, closing):
                    continue
                if self._is_stopped(object_id, other, point, normal, [*run, (now, time_s)]):
                    best, most_m = (other, point), closing
        if best is None:
            return []
        n_updates, elapsed_s = last - first, end_s - begin_s
        stands_still = elapsed_s <= 0 or (n_updates > 1 and run[1][1] == end_s)
        speed = most_m / (n_updates * self._period_s if stands_still else elapsed_s)
        return [Landing(object_id, *best, speed)] if LEAST_SPEED_M_S <= speed <= FASTEST_M_S else []

    def _is_stopped(
        self, object_id: str, other: str, point_m: Vector, normal: Vector, run: list[tuple[int, float]]
    ) -> bool:
        """Whether an object lost more speed towards another than a hand takes off, from one step to the next."""
        speed, lasted_s = -math.inf, 0.0
        for (since, begin_s), (until, end_s) in pairwise(run):
            lasts_s = end_s - begin_s if end_s > begin_s else (until - since) * self._period_s
            now = _dot(self._nearing(object_id, other, point_m, since, until), normal) / lasts_s
            if speed - now > min(BRAKES_M_S2 * (lasted_s + lasts_s) / 2, BRAKES_M_S):
                return True
            speed, lasted_s = now, lasts_s
        return False

    def _rolls(self, object_id: str, track: _Track, normal: Vector, closing_m: float) -> bool:
        """Whether an object turned without its middle coming nearer. The others' motion is left out."""
        begin, end = track.pose_at(track.run()[0][0]), self._graph.pose(object_id)
        if begin.rotation_xyzw == end.rotation_xyzw:
            return False
        (x, y, z), (u, v, w) = _turned(track.own_m, end), _turned(track.own_m, begin)
        return _dot((x - u, y - v, z - w), normal) < ROLLS * closing_m

    def _nearing(self, object_id: str, other: str, point_m: Vector, since: int, until: int) -> Vector:
        """Travel of a point of an object between two updates, relative to another object [m]."""
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


def _turned(own_m: Vector, pose: Pose) -> Vector:
    """A point in the world, from an object's own frame, as `Pose.to_world`; runs for every object that turns."""
    (a, b, c), (u, v, w) = own_m, pose.position_m
    if not (a or b or c):
        return u, v, w
    x, y, z, s = pose.rotation_xyzw
    d, e, f = 2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)
    return u + a + s * d + y * f - z * e, v + b + s * e + z * d - x * f, w + c + s * f + x * e - y * d


def _dot(one: Vector, other: Vector) -> float:
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
