"""The speed at which a moving object meets another one, from where it was in the frames before.

Its mean speed over these frames is that in their middle: a fall from 3 cm ends a third faster. To extrapolate needs the
acceleration, and that of a few frames is uncertain. So the acceleration is that of gravity if the positions agree with
it. If they do not, a hand or a motor moves the object, which may slow down before it meets anything. Its mean speed is
then the better estimate.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from scene2hap.scene.geometry import Vector
from scene2hap.session.impacts.motion_track import MOST_STEPS
from scene2hap.session.impacts.relative_motion import RelativeMotion

GRAVITY_M_S2 = 9.81
FALL_S = 0.11
"""Time over which a motion is compared with a free fall: three whole steps at 30 Hz. In half of this time, a short
stroke of a hand looks like a fall."""
NOISE_M = 0.0005
"""Standard deviation of a position where the positions do not show it; assumed, of a tracker."""
PRIOR = 2
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
        runs: tuple[Sequence[tuple[int, float]], Sequence[tuple[int, float]]],
        onward_m: float,
        time_s: float,
    ) -> float:
        """Return the larger speed [m/s] over two runs, of which the second lacks the last step. Each is that of a free
        fall as far as its positions agree with gravity, and the mean over the run for the rest.

        Parameters: onward_m, time_s : the partial step after the runs, and its end.
        """
        motion, track = self._motion, self._motion.tracks[object_id]
        # Each without its last step, since a stall of the game may be as long as all of these.
        falls = [track.run(n_without, FALL_S, 2 * MOST_STEPS) for n_without in range(len(runs))]
        begins, last = min(falls[1][0][0], runs[1][0][0]), falls[0][-1][0]
        path = motion.middle_path_m(object_id, other, point_m, normal, begins, last)
        meets_m, pull = path[last] + max(0.0, onward_m), -GRAVITY_M_S2 * normal[self._up_axis]
        fastest = 0.0
        for fall, run in zip(falls, runs, strict=True):
            # The first step of a motion counts only alone, since a part of it was rest, or the motion before.
            if len(run) > 2 and run[0][0] == track.since:
                run = run[1:]
            lasts_s, stands_still = self._lasts_s(run)
            of_middle = (path[run[-1][0]] - path[run[0][0]]) / lasts_s
            # The chord of a fast turn is no measure of its speed: the bottom of a spinning ball was lately its top.
            turned_m = motion.turned_m(object_id, point_m, normal, run[0][0], run[-1][0])
            speed = of_middle + turned_m / lasts_s
            if len(fall) > 2 and fall[0][0] == track.since:
                fall = fall[1:]
            times, came = [end_s for _, end_s in fall], [path[update] for update, _ in fall]
            if len(fall) > 1 and times[0] < times[-1] and not stands_still:
                at_end, likely = fall_speed(times, came, meets_m, time_s, pull)
                speed += likely * (at_end - of_middle)
            fastest = max(fastest, speed)
        return fastest

    def _lasts_s(self, run: Sequence[tuple[int, float]]) -> tuple[float, bool]:
        """Return the duration of a run [s], and whether the clock stands still."""
        (first, begin_s), (last, end_s) = run[0], run[-1]
        n_updates, elapsed_s = last - first, end_s - begin_s
        stands_still = elapsed_s <= 0 or (len(run) > 2 and run[1][1] == end_s)
        return self._period_s * n_updates if stands_still else elapsed_s, stands_still


class Parabola(NamedTuple):
    """A parabola through places (n,) by least squares, as orthogonal parts: its mean [m] at the mean time [s], the
    slope of the line and half the acceleration that is left of gravity.

    bend2 : sum of the squares of the part that is no line [s^4], 0 if the times are only two different ones, so that
    they show no acceleration; residual_m2 : sum of the squares of the distances.
    """

    n: int
    middle_s: float
    mean_m: float
    slope_m_s: float
    bent_m_s2: float
    bend2: float
    residual_m2: float

    def bent_error2(self) -> float:
        """Return the variance of `bent_m_s2`, with a few assumed places where the given ones do not show it."""
        return (PRIOR * NOISE_M**2 + self.residual_m2) / (PRIOR + self.n - 3) / self.bend2


def parabola(times_s: Sequence[float], places_m: Sequence[float], pull_m_s2: float = 0.0) -> Parabola:
    """Fit a parabola to places less pull t^2 / 2, with t from the mean time; the times are not all equal."""
    n, middle_s, first_m = len(times_s), sum(times_s) / len(times_s), places_m[0]
    # Sums in one loop: with numpy, or a sum at a time, they take twice as long.
    t2 = t3 = t4 = y1 = ty = t2y = y2 = 0.0
    for time_s, place_m in zip(times_s, places_m, strict=True):
        t = time_s - middle_s
        square = t * t
        y = place_m - first_m - pull_m_s2 * square / 2
        t2, t3, t4 = t2 + square, t3 + t * square, t4 + square * square
        y1, ty, t2y, y2 = y1 + y, ty + t * y, t2y + square * y, y2 + y * y
    mean_m, slope = y1 / n, ty / t2
    residual, bent = y2 - y1 * mean_m - slope**2 * t2, 0.0
    # What is left of a parabola, orthogonal to any line.
    bend2 = t4 - t3 * t3 / t2 - t2 * t2 / n
    if bend2 > _TWO_TIMES * t2 * t2:
        bent = (t2y - ty * t3 / t2 - y1 * t2 / n) / bend2
        residual -= bent**2 * bend2
    else:
        bend2 = 0.0
    return Parabola(n, middle_s, first_m + mean_m, slope, bent, bend2, max(residual, 0.0))


def fall_speed(
    times_s: Sequence[float], came_m: Sequence[float], meets_m: float, until_s: float, pull_m_s2: float
) -> tuple[float, float]:
    """Return the speed [m/s] of a free fall where it meets something, and the probability of a free fall, 0 to 1.

    A line is fitted to the positions less pull t^2 / 2 by least squares.
    Parameters: times_s, came_m : two or more times, not all equal, and the travel until then; meets_m : the travel
    where it meets something; until_s : latest time of that; pull_m_s2 : gravity along the travel.
    """
    fitted = parabola(times_s, came_m, pull_m_s2)
    middle_s, mean_m, speed = fitted.middle_s, fitted.mean_m, fitted.slope_m_s
    z2 = fitted.bent_m_s2**2 / fitted.bent_error2() if fitted.bend2 else 0.0
    likely = 1 / (1 + z2 / DOUBT**2)
    end = times_s[-1] - middle_s
    speed += pull_m_s2 * end
    left_m = meets_m - (mean_m + (speed - pull_m_s2 * end / 2) * end)
    met = speed * speed + 2 * pull_m_s2 * left_m
    if met <= 0 or speed + met**0.5 <= 0:
        return speed, likely
    later_s = min(max(2 * left_m / (speed + met**0.5), 0.0), until_s - times_s[-1])
    return speed + pull_m_s2 * later_s, likely
