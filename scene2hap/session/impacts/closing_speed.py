"""The speed at which a moving object meets another one, from where it was in the frames before.

Its mean speed over these frames is that in their middle: a fall from 3 cm ends a third faster. To extrapolate needs the
acceleration, and that of a few frames is uncertain. So the acceleration is that of gravity if the positions agree with
it. If they do not, a hand or a motor moves the object, which may slow down before it meets anything. Its mean speed is
then the better estimate.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

from scene2hap.scene.geometry import Vector, dot
from scene2hap.session.impacts.motion_track import MOST_STEPS
from scene2hap.session.impacts.relative_motion import RelativeMotion

GRAVITY_M_S2 = 9.81
FALL_S = 0.11
"""Time over which a motion is compared with a free fall: three whole steps at 30 Hz. In half of this time, a short
stroke of a hand looks like a fall."""
NOISE_M = 0.0005
"""Standard deviation of a position where the positions do not show it; assumed, of a tracker."""
_PRIOR = 2
"""Number of positions for which this assumption counts."""
DOUBT = 2.0
"""Standard deviations between the measured acceleration and that of gravity at which either is as likely."""

_TWO_TIMES = 1e-9
"""Share below which the times are only two different ones, of a coarse clock or of two positions."""


class ClosingSpeed:
    """Speed of an object towards another where they meet.

    Parameters: period_s : time between updates where the clock shows none; up_axis : number of the vertical axis.
    """

    def __init__(self, motion: RelativeMotion, period_s: float, up_axis: int) -> None:
        self._motion, self._period_s, self._up_axis = motion, period_s, up_axis

    def speed(
        self,
        object_id: str,
        other: str,
        point_m: Vector,
        normal: Vector,
        runs: Iterable[Sequence[tuple[int, float]]],
        onward_m: float,
        time_s: float,
    ) -> float:
        """Return the larger speed [m/s] over two runs, of which the second lacks the last step. Each is that of a free
        fall as far as its positions agree with gravity, and the mean over the run for the rest.

        Parameters: onward_m, time_s : the partial step after the runs, and its end.
        """
        motion, track = self._motion, self._motion.tracks[object_id]
        fall = track.run(0, FALL_S, 2 * MOST_STEPS)
        times = [end_s for _, end_s in fall]
        came = [motion.middle_nearing_m(object_id, other, point_m, normal, fall[0][0], update) for update, _ in fall]
        meets_m, pull = came[-1] + max(0.0, onward_m), -GRAVITY_M_S2 * normal[self._up_axis]
        fastest = 0.0
        for n_without, run in enumerate(runs):
            speed, of_middle = self._mean(object_id, other, point_m, normal, run)
            end = len(fall) - n_without
            # The first step of a motion counts only alone, since a part of it was rest, or the motion before.
            begin = int(end > 2 and fall[0][0] == track.since)
            if end - begin > 1 and times[begin] < times[end - 1] and of_middle is not None:
                falls, likely = fall_speed(times[begin:end], came[begin:end], meets_m, time_s, pull)
                speed += likely * (falls - of_middle)
            fastest = max(fastest, speed)
        return fastest

    def _mean(
        self, object_id: str, other: str, point_m: Vector, normal: Vector, run: Sequence[tuple[int, float]]
    ) -> tuple[float, float | None]:
        """Mean speed over a run [m/s], of the object's middle and of its turns in each step, and that of its middle
        alone, None if the clock stands still.

        The chord of a fast turn is no measure of its speed: the bottom of a spinning ball was lately its top.
        """
        motion = self._motion
        if len(run) > 2 and run[0][0] == motion.tracks[object_id].since:
            run = run[1:]
        (first, begin_s), (last, end_s) = run[0], run[-1]
        n_updates, elapsed_s = last - first, end_s - begin_s
        stands_still = elapsed_s <= 0 or (n_updates > 1 and run[1][1] == end_s)
        lasts_s = self._period_s * n_updates if stands_still else elapsed_s
        came_m = motion.middle_nearing_m(object_id, other, point_m, normal, first, last)
        turns = (motion.spin_m(object_id, point_m, since, until) for (since, _), (until, _) in pairwise(run))
        turned_m = sum(dot(turn, normal) for turn in turns)
        return (came_m + turned_m) / lasts_s, None if stands_still else came_m / lasts_s


def fall_speed(
    times_s: Sequence[float], came_m: Sequence[float], meets_m: float, until_s: float, pull_m_s2: float
) -> tuple[float, float]:
    """Return the speed [m/s] of a free fall where it meets something, and the probability of a free fall, 0 to 1.

    A line is fitted to the positions less pull t^2 / 2 by least squares.
    Parameters: times_s, came_m : two or more times, not all equal, and the travel until then; meets_m : the travel
    where it meets something; until_s : latest time of that; pull_m_s2 : gravity along the travel.
    """
    n = len(times_s)
    middle_s = sum(times_s) / n
    t = [x - middle_s for x in times_s]
    y = [s - pull_m_s2 * x * x / 2 for x, s in zip(t, came_m, strict=True)]
    t2 = sum(x * x for x in t)
    mean_m, speed = sum(y) / n, sum(x * s for x, s in zip(t, y, strict=True)) / t2
    # What is left of a parabola, orthogonal to any line.
    skew, level = sum(x**3 for x in t) / t2, t2 / n
    bend = [x * x - skew * x - level for x in t]
    bend2 = sum(x * x for x in bend)
    likely = 1.0
    if bend2 > _TWO_TIMES * t2 * t2:
        bent = sum(x * s for x, s in zip(bend, y, strict=True)) / bend2
        residual = sum((s - mean_m) ** 2 for s in y) - speed**2 * t2 - bent**2 * bend2
        variance = (_PRIOR * NOISE_M**2 + max(residual, 0.0)) / (_PRIOR + n - 3)
        likely = 1 / (1 + bent**2 * bend2 / variance / DOUBT**2)
    end = t[-1]
    speed += pull_m_s2 * end
    left_m = meets_m - (mean_m + (speed - pull_m_s2 * end / 2) * end)
    met = speed * speed + 2 * pull_m_s2 * left_m
    if met <= 0 or speed + met**0.5 <= 0:
        return speed, likely
    later_s = min(max(2 * left_m / (speed + met**0.5), 0.0), until_s - times_s[-1])
    return speed + pull_m_s2 * later_s, likely
