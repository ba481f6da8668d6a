"""The motion of one object, as steps between the frames of a game.

The motion is that of the middle of the object's box, since its origin may be on a hinge. Physics may run more slowly
than the frames, so that some frames have no step. A motion has stopped only if the longest of its latest gaps between
two steps has passed without a further step. An object that is held still before it falls leaves a gap too, but begins
with another step than its last one.
"""

from __future__ import annotations

import math

from scene2hap.compiled import compiled
from scene2hap.scene.geometry import Vector, dot
from scene2hap.scene.pose import Pose, in_world

WINDOW_S, MOST_STEPS = 0.05, 8
"""Time and number of steps over which a speed is measured."""
LEAST_TRAVEL_M = 0.004
"""Shortest fall in one direction: an object that jitters by a millimetre along three axes never moves so far."""
LEFT = 0.3
"""Largest share of its speed that an object keeps after it landed."""
LONGEST_GAP_S, MOST_GAP = 0.12, 12
"""Longest time, and number of updates, from one step of a motion to the next: physics at 10 Hz; assumed."""
GAP_DECAYS = 0.1
"""Decrease of the remembered gap with each step [updates]: at 60 Hz, physics at 50 Hz misses every sixth frame."""
UNEVEN = 3
"""Largest ratio of two gaps of slow physics: at 60 Hz, physics at 30 Hz has a step in every second frame, or after one
and three if these are uneven. A longer gap was a hold."""

SLOW_STEP_S = 0.025
"""Longest step of slower physics whose rate is not known [s]: 40 Hz; assumed."""
JUMP, JUMP_M_S2 = 10.0, 30.0
"""A step that is so many times as long as the one before, by more than such an acceleration, or as the one after, is a
jump: a teleport between the trembling of a tracker. A fall in two or three frames also has steps of very unequal
length, but by gravity alone; this is three times gravity, since clocks of games are uneven."""
HEAD_ON = 0.5
"""Smallest share of the travel that is along the contact normal: an object that slides does not land."""
SUDDEN = ((1 - LEFT) * HEAD_ON) ** 2
LEAST_CHANGE = SUDDEN * (LEAST_TRAVEL_M / MOST_STEPS) ** 2
"""Square of the smallest change of a step at a landing: as a share of the step before, and [m2], since the steps of a
fall are not shorter."""
NO_STEP, STEADY, CHANGED, ABRUPT = range(4)
"""How a step differs from the one before: there is none, by less than at a landing, by more, by more of its share."""

STILL: Vector = (0.0, 0.0, 0.0)
"""The step of an object that does not move [m]."""


@compiled
class Motion:
    """The latest steps of an object, its last step, and the start of its present motion in one direction.

    steps : number of the update, time [s] and pose of each step; pose : the latest; own_m : the middle of the box in
    the object's own frame [m]; step_m, next_m : the last step, and the one of `look`, which is not followed yet [m];
    since, n_steps : update in which the present motion began, and its steps since; far_m2 : square of the largest
    distance from the place where it began [m2]; gap : updates from one step to the next, the longest of late; goes_on :
    the object did not land when it seemed to, but paused.
    """

    __slots__ = (
        "_middle_m",
        "_next",
        "_origin_m",
        "_stopped_m",
        "far_m2",
        "gap",
        "goes_on",
        "n_steps",
        "next_m",
        "own_m",
        "pose",
        "since",
        "step_m",
        "steps",
    )

    def __init__(self, update: int, time_s: float, pose: Pose, own_m: Vector) -> None:
        self.steps: list[tuple[int, float, Pose]] = [(update, time_s, pose)]
        self.pose: Pose = pose
        self.own_m: Vector = own_m
        self.gap: float = 1.0
        self.goes_on: bool = False
        self.next_m: Vector = STILL
        self._middle_m = in_world(own_m, pose)
        # The last step before a landing that no further step confirmed, None if one did.
        self._stopped_m: Vector | None = None
        self.turn(update)

    def turn(self, update: int) -> None:
        """Begin a motion in another direction."""
        self.since: int = update
        self.n_steps: int = 0
        self.far_m2: float = 0.0
        self.step_m: Vector = STILL
        self._origin_m = self._middle_m

    def land(self, update: int) -> None:
        """Begin another motion after a landing, which the last step confirms or a missing one."""
        stopped_m = None if self.steps[-1][0] == update else self.step_m
        self.turn(update)
        self._stopped_m = stopped_m

    def meet(self, update: int) -> None:
        """Begin another motion after another object landed on this one, which may go on."""
        step_m = self.step_m
        self.turn(update)
        self.step_m = step_m

    def look(self, pose: Pose | None) -> int:
        """Look at the step to another pose, which `follow` then adds. Returns how it differs from the last step."""
        self.next_m = STILL
        if pose is None:
            return NO_STEP
        before, (a, b, c), (u, v, w) = self.pose, self._middle_m, self.step_m
        if pose.rotation_xyzw != before.rotation_xyzw:
            x, y, z = middle_m = in_world(self.own_m, pose)
            x, y, z = x - a, y - b, z - c
        else:
            (x, y, z), (d, e, f) = pose.position_m, before.position_m
            x, y, z = x - d, y - e, z - f
            if not (x or y or z):
                return NO_STEP
            middle_m = (a + x, b + y, c + z)
        self.next_m, self._next = (x, y, z), (pose, middle_m)
        x, y, z = x - u, y - v, z - w
        change = x * x + y * y + z * z
        if change < LEAST_CHANGE:
            return STEADY
        return ABRUPT if change >= SUDDEN * (u * u + v * v + w * w) else CHANGED

    def follow(self, update: int, time_s: float) -> None:
        """Add the step of `look`."""
        step_m, (pose, middle_m) = self.next_m, self._next
        last, last_s, _ = self.steps[-1]
        waited = update - last
        if waited > 1 and time_s - last_s > LONGEST_GAP_S:
            self.turn(last)
            self.gap, self.goes_on = 1.0, False
        else:
            (x, y, z), (u, v, w) = step_m, self.step_m
            onward, before = x * u + y * v + z * w, u * u + v * v + w * w
            gap = self.gap - GAP_DECAYS
            if LEFT * before < onward < before / LEFT:
                gap = min(max(gap, waited), UNEVEN * waited)
            self.gap = gap if gap > 1.0 else 1.0
            here = x * x + y * y + z * z
            jumps = here > JUMP * JUMP * before and self._jumps(here, before, time_s - last_s)
            jumped = self.n_steps == 1 and JUMP * onward < before
            if onward <= 0 or jumps or jumped:
                stopped_m = self._stopped_m
                self.turn(last)
                self.goes_on = stopped_m is not None and dot(step_m, stopped_m) > LEFT * dot(stopped_m, stopped_m)
        self._stopped_m = None
        self.pose, self._middle_m, self.step_m = pose, middle_m, step_m
        self.n_steps += 1
        (x, y, z), (u, v, w) = middle_m, self._origin_m
        x, y, z = x - u, y - v, z - w
        self.far_m2 = max(self.far_m2, x * x + y * y + z * z)
        self.steps.append((update, time_s, pose))
        if len(self.steps) > 4 * MOST_STEPS:
            del self.steps[: -2 * MOST_STEPS]

    def _jumps(self, here: float, before: float, lasts_s: float) -> bool:
        """Whether a step is a jump, by its square, that of the step before [m2] and its duration."""
        lasted_s = self.steps[-1][1] - self.steps[-2][1] if len(self.steps) > 1 else 0.0
        longer = JUMP * max(1.0, lasts_s / lasted_s) if lasted_s > 0 else JUMP
        jump_m = JUMP_M_S2 * lasts_s * lasts_s
        return here > longer * longer * before and here > jump_m * jump_m > 0


class MotionTrack(Motion):
    """The motion of one object, and its steps in a time."""

    __slots__ = ()

    @property
    def is_falling(self) -> bool:
        """Whether it moved far enough in one direction, in more than one step; a single step may be a teleport.

        A bounce that drifts sideways is one motion up and down, and ends near its beginning.
        """
        return self.n_steps > 1 and not self.goes_on and self.far_m2 >= LEAST_TRAVEL_M**2

    def has_stopped(self, update: int) -> bool:
        """Whether the next step is missing since exactly this update."""
        return self.steps[-1][0] + math.ceil(self.gap) == update

    def still_stands(self, update: int, before_s: float, time_s: float) -> bool:
        """Whether the next step is missing since an earlier update, and slower physics would have made it since exactly
        this one; before_s, time_s : times of the update before and of this one."""
        first, since_s = self.steps[-1][0] + math.ceil(self.gap), self.steps[-1][1] + SLOW_STEP_S
        return update > first and time_s >= since_s and (update == first + 1 or before_s < since_s)

    def is_at_rest(self, update: int) -> bool:
        """Whether the motion has ended: no further step can belong to it."""
        return update - self.steps[-1][0] > MOST_GAP

    def run(self, n_without: int = 0, window_s: float = WINDOW_S, most: int = MOST_STEPS) -> list[tuple[int, float]]:
        """Return the numbers and times [s] of the latest steps in one direction, at least two, without the last few."""
        end = len(self.steps) - n_without
        latest = [(update, time_s) for update, time_s, _ in self.steps[max(0, end - most) : end]]
        end_s = latest[-1][1]
        kept = [(update, time_s) for update, time_s in latest if update >= self.since and end_s - time_s <= window_s]
        return kept if len(kept) > 1 else latest[-2:]

    def between(self, since: int, until: int) -> list[tuple[int, Pose]]:
        """Return update and pose of the steps from one to another, both included."""
        return [(update, pose) for update, _, pose in self.steps if since <= update <= until]

    def pose_at(self, update: int) -> Pose:
        """Return the pose after an update, or the first known pose after it."""
        steps = self.steps
        # Most objects have a step in each update.
        place = len(steps) - 1 - (steps[-1][0] - update)
        if 0 <= place < len(steps) and steps[place][0] == update:
            return steps[place][2]
        found = self.pose
        for later, _, pose in reversed(self.steps):
            if later < update:
                break
            found = pose
        return found
