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
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from scene2hap.contact.junction import Junction
from scene2hap.scene.geometry import Vector, difference, dot
from scene2hap.scene.pose import Pose
from scene2hap.session.impacts.approaches import NO_JUNCTIONS, Approach, Approaches
from scene2hap.session.impacts.closing_speed import ClosingSpeed
from scene2hap.session.impacts.motion_track import (
    ABRUPT,
    CHANGED,
    HEAD_ON,
    LEAST_CHANGE,
    LEAST_TRAVEL_M,
    LEFT,
    LONGEST_GAP_S,
    NO_STEP,
    STILL,
    SUDDEN,
    MotionTrack,
)
from scene2hap.session.impacts.relative_motion import RelativeMotion
from scene2hap.session.impacts.sudden_stop import SuddenStop
from scene2hap.session.present_scene.scene_state import SceneState

LEAST_SPEED_M_S = 0.1
"""A cup put down more slowly is as good as not felt, and trackers shake as fast."""
FASTEST_M_S = 10.0
"""A faster motion is no fall (5 m): the game has moved the object elsewhere."""
ROLLS = 0.25
"""Smallest share of an object's middle in the approach of its part at the contact: the middle of a rolling object does
not approach the floor."""
MOST_MOVING = 100
"""Objects followed at once; among so many moving objects a single landing is not noticed."""
SHORTEST_S, MOST_UPDATES = 0.0045, 16
"""Shortest time from one step to the next, and most updates in it. A game may update after each step of its physics: a
contact of an engine is soft, so that at 500 Hz an object takes several steps to stop. The updates at one time of the
clock are one step too, unless it stands still."""


class Landing(NamedTuple):
    """An object that met another at a point [m], world, at a speed [m/s]."""

    object_id: str
    onto: str
    point_m: Vector
    speed_m_s: float


class Landings:
    """Follows moving objects, and finds those that land.

    Parameters: state : the scene, read at each `look`; period_s : usual time between updates, where the clock shows
    none.
    """

    def __init__(self, state: SceneState, period_s: float) -> None:
        self._state, self._graph, self._period_s = state, state.graph, period_s
        self._motion = RelativeMotion(state.graph)
        self._closing = ClosingSpeed(self._motion, period_s, state.up_axis)
        self._stop = SuddenStop(self._motion, period_s)
        self._approaches = Approaches(state, self._motion)
        self._near: dict[str, dict[str, Junction]] = {}
        """Contacts of each moving object before the present step, and in all of its updates but the last."""
        self._moved: dict[str, None] = {}
        self._looked_s, self._before_s = 0.0, 0.0
        self._n_waiting, self._clock_runs = 0, False

    def forget(self) -> None:
        """Forget all motions. Call it after a pause: the clock stood still, so that their speeds are unknown."""
        self._motion.tracks.clear()
        self._near.clear()
        self._moved.clear()

    def begin(self, moved: Mapping[str, Pose], time_s: float) -> None:
        """Store poses and contacts of the objects that are about to move. Call it before the graph is updated."""
        motion, beside = self._motion, self._graph.beside
        tracks = motion.tracks
        # The objects were still at rest at the last look, unless that is long ago: then the time of a step is unknown.
        since_s = self._looked_s if 0 < time_s - self._looked_s <= LONGEST_GAP_S else time_s - self._period_s
        for object_id in moved.keys() & tracks.keys() & beside.keys():
            self._near.setdefault(object_id, {}).update(beside[object_id])
        for object_id in [x for x in moved if x not in tracks]:
            if len(tracks) < MOST_MOVING and object_id in self._graph:
                pose, moves_to = self._graph.pose(object_id), moved[object_id]
                # Some games give the poses of all objects in every frame. The graph refuses other types than poses.
                if isinstance(moves_to, Pose) and pose != moves_to:
                    own_m = self._state.middle_m(object_id)
                    tracks[object_id] = MotionTrack(motion.n_updates, since_s, pose, own_m)

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
        self._n_waiting, self._clock_runs = 0, since_s > 0
        self._before_s, self._looked_s = self._looked_s, time_s
        return False

    def _look(self, moved: Mapping[str, Pose], time_s: float) -> list[Landing]:
        self._motion.n_updates = now = self._motion.n_updates + 1
        tracks = self._motion.tracks
        moving: list[MotionTrack] = []
        stopped: list[str] = []
        changed: list[str] = []
        at_rest: list[str] = []
        beside = self._graph.beside  # an object without contacts has not landed
        for object_id, track in tracks.items():
            change = track.look(moved.get(object_id))
            if change != NO_STEP:
                moving.append(track)
                # Few objects pass these checks, which run for all moved ones in every frame.
                if (
                    change >= CHANGED
                    and (object_id in beside or object_id in self._near)
                    and (change == ABRUPT or not tracks.keys().isdisjoint(self._met(object_id)))
                ):
                    changed.append(object_id)
            elif (
                (track.has_stopped(now) or track.still_stands(now, self._before_s, time_s))
                and beside.get(object_id)
                and track.is_falling
            ):
                stopped.append(object_id)
            elif track.is_at_rest(now):
                at_rest.append(object_id)
        stopped += [x for x in changed if tracks[x].is_falling and self._is_sudden(x)]
        found = [one for object_id in stopped for one in self._landing(object_id, tracks[object_id], time_s)]
        for track in moving:
            track.follow(now, time_s)
        for object_id in at_rest:
            del tracks[object_id]
        if not found:
            return found
        for landing in found:
            tracks[landing.object_id].land(now)
            # Else the other one, which moves too, as in a vehicle, would land on this one in one of the next updates.
            if (other := tracks.get(landing.onto)) is not None:
                other.meet(now)
        # Two objects that met each other landed once.
        met = {(one.object_id, one.onto) for one in found}
        return [one for one in found if (one.onto, one.object_id) not in met or one.object_id < one.onto]

    def _met(self, object_id: str) -> Mapping[str, Junction]:
        """Return the present contacts of an object, and those with present objects that ended in this step."""
        near, beside = self._near.get(object_id, NO_JUNCTIONS), self._graph.beside.get(object_id, NO_JUNCTIONS)
        if near.keys() <= beside.keys():
            return beside
        return {**beside, **{x: near[x] for x in near if x not in beside and x in self._graph}}

    def _is_sudden(self, object_id: str) -> bool:
        """Whether a fall changes abruptly with this step, relative to a neighbour: both may be in a vehicle."""
        track = self._motion.tracks[object_id]
        beside = self._graph.beside.get(object_id, NO_JUNCTIONS)
        for other in self._met(object_id):
            theirs, their_m, their_next_m = self._motion.tracks.get(other), STILL, STILL
            if theirs is not None:
                their_next_m = theirs.next_m
                if theirs.steps[-1][0] == track.steps[-1][0]:
                    their_m = theirs.step_m
            now, before = difference(track.next_m, their_next_m), difference(track.step_m, their_m)
            change = difference(now, before)
            # Without a contact now, only an object that turned back may have met the other one.
            if (other in beside or dot(now, before) < 0) and dot(change, change) >= max(
                LEAST_CHANGE, SUDDEN * dot(before, before)
            ):
                return True
        return False

    def _landing(self, object_id: str, track: MotionTrack, time_s: float) -> list[Landing]:
        """The landing on the touched object that was approached the fastest, of equal ones the first by id; empty if
        there is none. A drawer is one only if no contact shows what it met."""
        runs = track.run(), track.run(1)  # the two may have met early in the last step
        met, between = self._met(object_id), (runs[1][0][0], runs[0][-1][0])
        found = self._fastest(object_id, track, runs, time_s, self._approaches.at_contacts(object_id, met, between))
        if found is None:
            found = self._fastest(object_id, track, runs, time_s, self._approaches.in_holders(object_id, between))
        if found is None:
            return []
        return [found] if LEAST_SPEED_M_S <= found.speed_m_s <= FASTEST_M_S else []

    def _fastest(
        self,
        object_id: str,
        track: MotionTrack,
        runs: tuple[Sequence[tuple[int, float]], Sequence[tuple[int, float]]],
        time_s: float,
        approaches: Iterable[Approach],
    ) -> Landing | None:
        """The fastest of several approaches at which an object met another."""
        steps = sorted({*runs[0], *runs[1]})
        (first, _), (before, before_s), (last, end_s) = steps[0], steps[-2], steps[-1]
        best, most_m, now = None, LEAST_TRAVEL_M, self._motion.n_updates
        # The step after a long frame is short, without being slow. The ratio is unknown if the clock stands still.
        lasted_s, lasts_s = end_s - before_s, time_s - end_s
        shorter = min(1.0, lasts_s / lasted_s) if lasted_s > 0 and lasts_s > 0 else 1.0
        beside = self._graph.beside.get(object_id, NO_JUNCTIONS)
        has_just_stopped = self._graph.pose(object_id) == track.pose and track.has_stopped(now)
        for one in approaches:
            other, point, came, normal = one[:4]
            if best is not None and not (other in beside and one.is_contact):
                continue
            closing = dot(came, normal)
            if closing > most_m and closing >= HEAD_ON * math.hypot(*came):
                # Physics may be slower than the frames, and miss one: has it stopped in mid air?
                if has_just_stopped and not (one.is_seen and self._approaches.is_reached(object_id, point, normal)):
                    continue
                step = dot(self._motion.nearing_m(object_id, other, point, before, last), normal)
                onward = dot(self._motion.nearing_m(object_id, other, point, last, now), normal)
                most = LEFT * step * shorter if other in beside else 0.0
                middle_m = self._motion.middle_path_m(object_id, other, point, normal, first, last)[last]
                if onward > most or middle_m < ROLLS * closing:
                    continue
                if not self._stop.is_sudden(object_id, other, point, normal, [*steps, (now, time_s)]):
                    continue
                if one.meets():
                    speed = self._closing.speed(object_id, other, point, normal, runs, onward, time_s)
                    best, most_m = Landing(object_id, other, point, speed), closing
        return best
