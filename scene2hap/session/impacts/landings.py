"""Find landings: a moved object stops suddenly while it touches the object that it moved towards.

A new contact alone is no landing: contacts reach across gaps of centimetres, since resting objects hover in real
scenes. An object has landed if it approached another one for some millimetres, and its next step is less than a third
of the step before, in length and in speed. These motions are no landings:

- an object that a hand puts down or shakes over a table: it slows down as fast as a hand can;
- an object that slides: most of its travel is across the contact's normal;
- an object that rolls: its rim comes down on the floor, while its middle keeps its distance.

Doors and drawers meet their cabinet where no contact shows it (`slams`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from scene2hap.contact.graph import ContactGraph
from scene2hap.contact.junction import Junction
from scene2hap.contact.rule import TOUCH_M
from scene2hap.scene.geometry import Vector, cross, dot
from scene2hap.scene.pose import Pose, in_own, in_world
from scene2hap.session.impacts.motion_track import (
    LEAST_TRAVEL_M,
    LEFT,
    LONGEST_GAP_S,
    MOST_STEPS,
    STILL,
    MotionTrack,
)
from scene2hap.session.impacts.slams import RelativePoses, Slam

LEAST_SPEED_M_S = 0.1
"""A cup put down more slowly is as good as not felt, and trackers shake as fast."""
FASTEST_M_S = 10.0
"""A faster motion is no fall (5 m): the game has moved the object elsewhere."""
HEAD_ON = 0.5
"""Smallest share of the travel that is along the contact normal: an object that slides does not land."""
BRAKES_M_S2, BRAKES_M_S = 10.0, 0.2
"""Largest deceleration by a hand that carries, lowers or shakes an object, and largest loss of speed by a hand from one
step to the next; assumed. Below 50 Hz the latter is the smaller bound, since a short fall lasts for few frames."""
WHOLE = 1.5
"""Slowest landing, as a multiple of this loss. One that is slower would be found or not by the time in a frame at which
the objects meet."""
ROLLS = 0.25
"""Smallest share of an object's middle in the approach of its part at the contact: the middle of a rolling object does
not approach the floor."""
MOST_MOVING = 100
"""Objects followed at once; among so many moving objects a single landing is not noticed."""
SHORTEST_S, MOST_UPDATES = 0.0045, 16
"""Shortest time from one step to the next, and most updates in it. A game may update after each step of its physics: a
contact of an engine is soft, so that at 500 Hz an object takes several steps to stop. The updates at one time of the
clock are one step too, unless it stands still."""
_SUDDEN = ((1 - LEFT) * HEAD_ON) ** 2
_LEAST_CHANGE = _SUDDEN * (LEAST_TRAVEL_M / MOST_STEPS) ** 2
"""Square of the smallest change of a step at a landing [m2]: the steps of a fall are not shorter."""
_PLANE_POINTS, _LEAST_WIDTH_M, _FLAT = 3, 0.003, 0.1
"""Fewest points of a contact that span a plane, their least width, and their largest thickness relative to it."""
_NOTHING: Mapping[str, Junction] = MappingProxyType({})


class Landing(NamedTuple):
    """An object that met another at a point [m], world, at a speed [m/s]."""

    object_id: str
    onto: str
    point_m: Vector
    speed_m_s: float


class _Approach(NamedTuple):
    """A point at which an object came nearer to another one: travel there [m], and the normal towards the other.

    meets : tells whether the two meet there, which may take a millisecond; None for sure. is_contact : False for the
    edge of a door, and for a drawer; is_seen : False where nothing at the point shows that the object is there.
    """

    other: str
    point_m: Vector
    came_m: Vector
    normal: Vector
    meets: Callable[[], bool] | None = None
    is_contact: bool = True
    is_seen: bool = True


class Landings:
    """Follows moving objects, and finds those that land.

    Parameters: graph : the contacts, read at each `look`; middle_m : the middle of an object's box, in its own frame
    [m]; half_m : half the sides of this box [m]; slam : what an object on a hinge may slam against; is_closed :
    whether an object is a closed drawer of another; period_s : usual time between updates, where the clock shows
    none.
    """

    def __init__(
        self,
        graph: ContactGraph,
        middle_m: Callable[[str], Vector],
        half_m: Callable[[str], Vector],
        slam: Callable[[str, Callable[[str], RelativePoses]], Slam | None],
        is_closed: Callable[[str, str, RelativePoses], bool],
        period_s: float,
    ) -> None:
        self._graph, self._middle_m, self._half_m = graph, middle_m, half_m
        self._slam, self._is_closed = slam, is_closed
        self._period_s = period_s
        self._tracks: dict[str, MotionTrack] = {}
        self._near: dict[str, dict[str, Junction]] = {}
        """Contacts of each moving object before the present step, and in all of its updates but the last."""
        self._n_updates = 0
        self._moved: dict[str, None] = {}
        self._n_waiting, self._looked_s, self._clock_runs = 0, 0.0, False

    def forget(self) -> None:
        """Forget all motions. Call it after a pause: the clock stood still, so that their speeds are unknown."""
        self._tracks.clear()
        self._near.clear()
        self._moved.clear()

    def begin(self, moved: Mapping[str, Pose], time_s: float) -> None:
        """Store poses and contacts of the objects that are about to move. Call it before the graph is updated."""
        tracks, beside = self._tracks, self._graph.beside
        # The objects were still at rest at the last look, unless that is long ago: then the time of a step is unknown.
        since_s = self._looked_s if 0 < time_s - self._looked_s <= LONGEST_GAP_S else time_s - self._period_s
        for object_id, moves_to in moved.items():
            track = tracks.get(object_id)
            if track is not None:
                if near := beside.get(object_id):
                    self._near.setdefault(object_id, {}).update(near)
            elif len(tracks) < MOST_MOVING and object_id in self._graph:
                pose = self._graph.pose(object_id)
                # Some games give the poses of all objects in every frame. The graph refuses other types than poses.
                if isinstance(moves_to, Pose) and pose != moves_to:
                    own_m = self._middle_m(object_id)
                    tracks[object_id] = MotionTrack(self._n_updates, since_s, pose, own_m)

    def look(self, moved: Mapping[str, Pose], time_s: float) -> list[Landing]:
        """Find the objects that landed in this update. Call it in each one, after the graph is updated."""
        if self._is_within_step(time_s):
            self._moved.update(dict.fromkeys(moved))
            return []
        if self._moved:
            self._moved.update(dict.fromkeys(moved))
            moved = {object_id: self._graph.pose(object_id) for object_id in self._moved if object_id in self._graph}
            self._moved.clear()
        found = self._look(moved, time_s)
        self._near.clear()
        return found

    def _is_within_step(self, time_s: float) -> bool:
        """Whether the next update belongs to the same step of all motions as this one."""
        since_s = time_s - self._looked_s
        self._n_waiting += 1
        if self._clock_runs and since_s < SHORTEST_S and self._n_waiting < MOST_UPDATES:
            return True
        self._n_waiting, self._looked_s, self._clock_runs = 0, time_s, since_s > 0
        return False

    def _look(self, moved: Mapping[str, Pose], time_s: float) -> list[Landing]:
        self._n_updates = now = self._n_updates + 1
        moving: list[tuple[str, MotionTrack, Pose, tuple[Vector, Vector]]] = []
        stopped: list[str] = []
        changed: list[str] = []
        at_rest: list[str] = []
        beside = self._graph.beside  # an object without contacts has not landed
        for object_id, track in self._tracks.items():
            pose = moved.get(object_id)
            step = track.step_to(pose)
            if pose is not None and step is not None:
                moving.append((object_id, track, pose, step))
                # Few objects pass these checks, which run for all moved ones in every frame.
                before = track.step_m
                change = _change(step[0], before)
                if (
                    change >= _LEAST_CHANGE
                    and (object_id in beside or object_id in self._near)
                    and (
                        change >= _SUDDEN * dot(before, before)
                        or not self._tracks.keys().isdisjoint(self._met(object_id))
                    )
                ):
                    changed.append(object_id)
            elif (track.has_stopped(now) or track.has_stopped(now - 1)) and beside.get(object_id) and track.is_falling:
                stopped.append(object_id)
            elif track.is_at_rest(now):
                at_rest.append(object_id)
        if changed:
            steps_m = {object_id: step_m for object_id, _, _, (step_m, _) in moving}
            stopped += [x for x in changed if self._tracks[x].is_falling and self._is_sudden(x, steps_m)]
        found = [one for object_id in stopped for one in self._landing(object_id, self._tracks[object_id], time_s)]
        for _, track, pose, (step_m, middle_m) in moving:
            track.follow(now, time_s, pose, step_m, middle_m)
        for object_id in at_rest:
            del self._tracks[object_id]
        if not found:
            return found
        for landing in found:
            self._tracks[landing.object_id].land(now)
            # Else the other one, which moves too, as in a vehicle, would land on this one in one of the next updates.
            if (other := self._tracks.get(landing.onto)) is not None:
                other.meet(now)
        # Two objects that met each other landed once.
        met = {(one.object_id, one.onto) for one in found}
        return [one for one in found if (one.onto, one.object_id) not in met or one.object_id < one.onto]

    def _met(self, object_id: str) -> Mapping[str, Junction]:
        """Return the present contacts of an object, and those that ended in this step."""
        near, beside = self._near.get(object_id, _NOTHING), self._graph.beside.get(object_id, _NOTHING)
        if near.keys() <= beside.keys():
            return beside
        return {**beside, **{x: near[x] for x in near if x not in beside}}

    def _is_sudden(self, object_id: str, steps_m: Mapping[str, Vector]) -> bool:
        """Whether a fall changes abruptly with this step, relative to a neighbour: both may be in a vehicle.

        Parameters: steps_m : of all objects that moved in this update.
        """
        track = self._tracks[object_id]
        beside = self._graph.beside.get(object_id, _NOTHING)
        for other in self._met(object_id):
            theirs, their_m = self._tracks.get(other), STILL
            if theirs is not None and theirs.steps[-1][0] == track.steps[-1][0]:
                their_m = theirs.step_m
            now = _difference(steps_m[object_id], steps_m.get(other, STILL))
            before = _difference(track.step_m, their_m)
            # Without a contact now, only an object that turned back may have met the other one.
            if (other in beside or dot(now, before) < 0) and _change(now, before) >= max(
                _LEAST_CHANGE, _SUDDEN * dot(before, before)
            ):
                return True
        return False

    def _landing(self, object_id: str, track: MotionTrack, time_s: float) -> list[Landing]:
        """The landing on the touched object that was approached the fastest, of equal ones the first by id; empty if
        there is none. A drawer is one only if no contact shows what it met."""
        runs = track.run(), track.run(1)  # the two may have met early in the last step
        met, between = self._met(object_id), (runs[1][0][0], runs[0][-1][0])
        found = self._fastest(object_id, track, runs, time_s, self._at_contacts(object_id, track, met, between))
        if found is None:
            found = self._fastest(object_id, track, runs, time_s, self._in_holders(object_id, track, between))
        if found is None:
            return []
        return [found] if LEAST_SPEED_M_S <= found.speed_m_s <= FASTEST_M_S else []

    def _fastest(
        self,
        object_id: str,
        track: MotionTrack,
        runs: tuple[Sequence[tuple[int, float]], Sequence[tuple[int, float]]],
        time_s: float,
        approaches: Iterable[_Approach],
    ) -> Landing | None:
        """The fastest of several approaches at which an object met another."""
        steps = sorted({*runs[0], *runs[1]})
        (first, _), (before, before_s), (last, end_s) = steps[0], steps[-2], steps[-1]
        best, most_m, now = None, LEAST_TRAVEL_M, self._n_updates
        # The step after a long frame is short, without being slow. The ratio is unknown if the clock stands still.
        lasted_s, lasts_s = end_s - before_s, time_s - end_s
        shorter = min(1.0, lasts_s / lasted_s) if lasted_s > 0 and lasts_s > 0 else 1.0
        beside = self._graph.beside.get(object_id, _NOTHING)
        has_just_stopped = self._graph.pose(object_id) == track.pose and track.has_stopped(now)
        for one in approaches:
            other, point, came, normal = one[:4]
            if best is not None and not (other in beside and one.is_contact):
                continue
            closing = dot(came, normal)
            if closing > most_m and closing >= HEAD_ON * math.hypot(*came):
                # Physics may be slower than the frames, and miss one: has it stopped in mid air?
                if has_just_stopped and not (one.is_seen and self._is_at(object_id, track, point, normal)):
                    continue
                step = dot(self._nearing(object_id, other, point, before, last), normal)
                onward = dot(self._nearing(object_id, other, point, last, now), normal)
                most = LEFT * step * shorter if other in beside else 0.0
                middle_m = self._middle_nearing_m(object_id, other, point, normal, first, last)
                if onward > most or middle_m < ROLLS * closing:
                    continue
                if not self._stops_suddenly(object_id, other, point, normal, [*steps, (now, time_s)]):
                    continue
                if one.meets is None or one.meets():
                    speed = max(self._speed(object_id, other, point, normal, run) for run in runs)
                    best, most_m = Landing(object_id, other, point, speed), closing
        return best

    def _at_contacts(
        self, object_id: str, track: MotionTrack, met: Mapping[str, Junction], between: tuple[int, int]
    ) -> Iterator[_Approach]:
        """Approaches at the present and former contacts of an object, and at its edge if a hinge holds it.

        Present contacts come first, a contact at a hinge last among these, since a contact elsewhere shows where the
        two objects meet. Sorted, since the graph's order depends on the hashes of ids, which differ in each run of
        Python.
        """
        beside, pose = self._graph.beside.get(object_id, _NOTHING), self._graph.pose(object_id)
        slam = self._slam(object_id, partial(self._way, track))
        holder = None if slam is None else slam.holder
        for other in sorted(met, key=lambda x: (x not in beside, x == holder, x)):
            meets: Callable[[], bool] | None = None
            if slam is not None and other == holder:
                point = in_world(slam.edge_m, pose)
                came = self._nearing(object_id, other, point, *between)
                yield _Approach(other, point, came, _direction(came), slam.meets, is_contact=False)
                meets = slam.misses
            for side in _sides(met[other]):
                point = _middle(side)
                came = self._nearing(object_id, other, point, *between)
                yield _Approach(other, point, came, self._normal(object_id, other, point, side, between[0]), meets)

    def _in_holders(self, object_id: str, track: MotionTrack, between: tuple[int, int]) -> Iterator[_Approach]:
        """Approaches of a drawer to what encloses it."""
        beside = self._graph.beside.get(object_id, _NOTHING)
        for other in sorted(beside):
            point = _middle(beside[other])
            came = self._nearing(object_id, other, point, *between)
            closed = partial(self._is_drawer_of, object_id, track, other)
            yield _Approach(other, point, came, _direction(came), closed, is_contact=False, is_seen=False)

    def _is_drawer_of(self, object_id: str, track: MotionTrack, other: str) -> bool:
        return self._is_closed(object_id, other, self._way(track, other))

    def _is_at(self, object_id: str, track: MotionTrack, point_m: Vector, normal: Vector) -> bool:
        """Whether an object reaches a contact.

        The point of a contact is half way between the two surfaces. The box around the object reaches at least as far
        as its own.
        """
        own_normal: list[float] = (np.array(normal) @ self._graph.pose(object_id).rotation).tolist()
        reach_m = sum(abs(part) * half for part, half in zip(own_normal, self._half_m(object_id), strict=True))
        return 2 * (dot(_difference(point_m, track.middle_m), normal) - reach_m) <= TOUCH_M

    def _speed(
        self, object_id: str, other: str, point_m: Vector, normal: Vector, run: Sequence[tuple[int, float]]
    ) -> float:
        """Mean speed of an object towards another over a run [m/s], of its middle and of its turns in each step.

        The chord of a fast turn is no measure of its speed: the bottom of a spinning ball was lately its top. The first
        step of a motion counts only alone, since a part of it was rest, or the motion before.
        """
        if len(run) > 2 and run[0][0] == self._tracks[object_id].since:
            run = run[1:]
        (first, begin_s), (last, end_s) = run[0], run[-1]
        n_updates, elapsed_s = last - first, end_s - begin_s
        stands_still = elapsed_s <= 0 or (n_updates > 1 and run[1][1] == end_s)
        period_s = self._period_s if stands_still else elapsed_s / n_updates
        came_m = self._middle_nearing_m(object_id, other, point_m, normal, first, last)
        turned_m = sum(
            dot(self._spin(object_id, point_m, since, until), normal) for (since, _), (until, _) in pairwise(run)
        )
        return (came_m + turned_m) / n_updates / period_s

    def _way(self, track: MotionTrack, other: str) -> RelativePoses:
        theirs, its = self._tracks.get(other), self._graph.pose(other)
        (before, *_), (last, *_) = track.steps[-2:]
        begin = max(track.since, track.steps[0][0], theirs.steps[0][0] if theirs is not None else 0)
        updates = (begin, before, last)
        return [(track.pose_at(x), theirs.pose_at(x) if theirs is not None else its) for x in updates]

    def _stops_suddenly(
        self, object_id: str, other: str, point_m: Vector, normal: Vector, run: list[tuple[int, float]]
    ) -> bool:
        """Whether an object lost more speed towards another than by a hand: from one step to the next, or from the last
        whole step until it stood still, half a step of this and the partial one after it."""
        steps: list[tuple[float, float]] = []
        for (since, begin_s), (until, end_s) in pairwise(run):
            lasts_s = end_s - begin_s if end_s > begin_s else (until - since) * self._period_s
            steps.append((dot(self._nearing(object_id, other, point_m, since, until), normal) / lasts_s, lasts_s))
        fastest, stands_still = 0.0, steps[-1][0] == 0
        for i, ((speed, lasted_s), (now, lasts_s)) in enumerate(pairwise(steps), 3):
            most = min(BRAKES_M_S2 * (lasted_s + lasts_s) / 2, BRAKES_M_S)
            fastest = max(fastest, speed)
            is_last_whole = i == len(steps) and stands_still
            if fastest > WHOLE * most and (speed - now > most or (is_last_whole and speed > WHOLE * most)):
                return True
        return False

    def _middle_nearing_m(
        self, object_id: str, other: str, point_m: Vector, normal: Vector, since: int, until: int
    ) -> float:
        """Travel of an object's middle between two updates along a normal, relative to another object [m]."""
        track = self._tracks[object_id]
        begin, end = in_world(track.own_m, track.pose_at(since)), in_world(track.own_m, track.pose_at(until))
        return dot(_difference(_difference(end, begin), self._travel(other, point_m, since, until)), normal)

    def _spin(self, object_id: str, point_m: Vector, since: int, until: int) -> Vector:
        """Product of the sine of the turn between two updates and the arm from the object's middle to a point [m]."""
        track = self._tracks[object_id]
        begin, end = track.pose_at(since), track.pose_at(until)
        if begin.rotation_xyzw == end.rotation_xyzw:
            return STILL
        turn = end.rotation @ begin.rotation.T
        arm_m = np.subtract(point_m, in_world(track.own_m, self._graph.pose(object_id)))
        x, y, z = ((turn - turn.T) / 2 @ arm_m).tolist()
        return x, y, z

    def _nearing(self, object_id: str, other: str, point_m: Vector, since: int, until: int) -> Vector:
        """Travel of a point of an object between two updates, relative to another object [m]."""
        x, y, z = self._travel(object_id, point_m, since, until)
        a, b, c = self._travel(other, point_m, since, until)
        return x - a, y - b, z - c

    def _travel(self, object_id: str, point_m: Vector, since: int, until: int) -> Vector:
        """Travel between two updates [m] of the part of an object that is now at a point."""
        track, pose = self._tracks.get(object_id), self._graph.pose(object_id)
        if track is None:
            return STILL
        begin, end = track.pose_at(since), pose if until >= self._n_updates else track.pose_at(until)
        if begin.rotation_xyzw == end.rotation_xyzw == pose.rotation_xyzw:
            (a, b, c), (x, y, z) = begin.position_m, end.position_m
            return x - a, y - b, z - c
        own_m = in_own(point_m, pose)
        return _difference(in_world(own_m, end), in_world(own_m, begin))

    def _normal(self, object_id: str, other: str, point_m: Vector, junction: Junction, since: int) -> Vector:
        """Normal from the object to the other: the contact's, else that of its points if they span a plane, else the
        direction from the object's middle to the contact.

        Engines let small objects sink into others. Once the middle of an object is below the surface, the contact seems
        to be on its other side. The side from which the object came, since an update, is then the right one.
        """
        middle_m = in_world(self._tracks[object_id].own_m, self._graph.pose(object_id))
        outward = _difference(point_m, middle_m)
        normal = _given_normal(object_id, other, outward, junction)
        came = self._nearing(object_id, other, middle_m, since, self._n_updates)
        outside = dot(outward, normal)
        if outside > 0 > outside + dot(came, normal):
            return -normal[0], -normal[1], -normal[2]
        return normal


def _given_normal(object_id: str, other: str, outward: Vector, junction: Junction) -> Vector:
    for normal in junction.normals:
        if normal is not None:
            x, y, z = normal
            return normal if object_id < other else (-x, -y, -z)
    across = _normal_of_plane(junction.points_m)
    if across is not None and (height := dot(across, outward)):
        x, y, z = across
        return across if height > 0 else (-x, -y, -z)
    return _direction(outward)


def _direction(way: Vector) -> Vector:
    """The unit vector along a way, zero for none."""
    length = math.hypot(*way)
    return (way[0] / length, way[1] / length, way[2] / length) if length > 0 else STILL


def _normal_of_plane(points_m: Sequence[Vector]) -> Vector | None:
    """Unit normal, of either sign, of the plane through three of three or more points that are far apart; None if these
    lie on a line, or another one does not lie on the plane."""
    if len(points_m) < _PLANE_POINTS:
        return None
    ways = [_difference(point, points_m[0]) for point in points_m]
    longest = max(ways, key=lambda way: dot(way, way))
    across = max((cross(longest, way) for way in ways), key=lambda area: dot(area, area))
    width_m = math.hypot(*across) / (math.hypot(*longest) or 1.0)
    normal = _direction(across)
    heights = [dot(normal, way) for way in ways]
    return normal if width_m > _LEAST_WIDTH_M and max(heights) - min(heights) < _FLAT * width_m else None


def _difference(one: Vector, other: Vector) -> Vector:
    return one[0] - other[0], one[1] - other[1], one[2] - other[2]


def _change(one: Vector, other: Vector) -> float:
    """Square of the distance of two vectors."""
    (x, y, z), (u, v, w) = one, other
    x, y, z = x - u, y - v, z - w
    return x * x + y * y + z * z


def _sides(junction: Junction) -> list[Junction]:
    """Split a contact by its normals, as of an object that slides on a tray and meets its rim."""
    if len(set(junction.normals)) < 2:
        return [junction]
    sides: dict[tuple[float, ...] | None, list[int]] = {}
    for row, normal in enumerate(junction.normals):
        # Engines round the normals of one face differently.
        side = None if normal is None else tuple(round(x, 1) for x in normal)
        sides.setdefault(side, []).append(row)
    points_m, weights, normals = junction.points_m, junction.weights, junction.normals
    return [
        Junction(tuple(points_m[row] for row in rows), tuple(weights[row] for row in rows), (normals[rows[0]],))
        for rows in sides.values()
    ]


def _middle(junction: Junction) -> Vector:
    x, y, z = (sum(axis) / len(junction.points_m) for axis in zip(*junction.points_m, strict=True))
    return x, y, z
