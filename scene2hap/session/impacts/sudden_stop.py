"""Tell a sudden stop, by something that is in the way, from a hand that brakes.

A hand loses a bounded speed in a given time. The clock of a game is no exact measure of this time: frames are late, and
physics runs at a rate of its own. So only the last two changes of speed count, where an object stops. The noise of the
places is their distance from a parabola in the steps before. It does not count for an object that falls freely until
its last step, since no hand stops such an object.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from statistics import median

from scene2hap.scene.geometry import Vector, dot
from scene2hap.scene.pose import in_world
from scene2hap.session.impacts.closing_speed import GRAVITY_M_S2, parabola
from scene2hap.session.impacts.motion_track import MOST_STEPS, SLOW_STEP_S, MotionTrack
from scene2hap.session.impacts.relative_motion import RelativeMotion

BRAKES_M_S2, BRAKES_M_S, STALL = 10.0, 0.2, 2.5
"""Largest deceleration by a hand that carries, lowers or shakes an object [m/s2], and largest loss of speed by a hand
from one step to the next [m/s]; assumed. Below 50 Hz the latter is the smaller bound, since a short fall lasts for few
frames. A step of more than `STALL` usual ones is a stall of the game (assumed), in which a hand may brake throughout.
There the latter bound holds for falls alone."""
TREMBLES, TREMBLES_M_S = 3.5, 0.25
"""Largest loss of speed by noise, as standard deviations of a place per step, and in m/s. With 3 more false landings
are found, with 5 no fall from 1 cm is."""
WHOLE = 1.5
"""Slowest landing, as a multiple of this loss. One that is slower would be found or not by the time in a frame at which
the objects meet."""
SMOOTH_S, LEAST_SMOOTH = 0.11, 5
"""Time over which a motion is a parabola but for noise [s], and fewest steps that show this noise; assumed."""
FALLS_M_S2, SURE = GRAVITY_M_S2 / 2, 1.5
"""Least acceleration of a fall [m/s2], and by how many standard errors a measured one must exceed it; assumed."""


class SuddenStop:
    """Finds whether moving objects stop suddenly.

    Parameters: period_s : time between updates where the clock shows none.
    """

    def __init__(self, motion: RelativeMotion, period_s: float) -> None:
        self._motion, self._period_s = motion, period_s

    def is_sudden(
        self, object_id: str, other: str, point_m: Vector, normal: Vector, run: Sequence[tuple[int, float]]
    ) -> bool:
        """Whether an object lost more speed towards another than by a hand: with one of the last two steps, or from the
        last whole step until it stood still, half a step of this and the partial one after it.

        Parameters: run : update and time of the steps until now, the last one included.
        """
        track = self._motion.tracks[object_id]
        steps = self._steps(object_id, other, point_m, normal, run)
        fastest, stands_still = max(speed for speed, _ in steps[:-1]), steps[-1][0] == 0
        usual_s = min(lasts_s for _, lasts_s in steps)
        for i, ((speed, lasted_s), (now, lasts_s)) in enumerate(pairwise(steps[-3:]), max(0, len(steps) - 3)):
            between_s = (lasted_s + lasts_s) / 2
            is_last_whole = i == len(steps) - 3 and stands_still
            loss = min(fastest / WHOLE, max(speed - now, speed / WHOLE if is_last_whole else 0.0))
            brakes = BRAKES_M_S2 * between_s
            least = min(brakes, BRAKES_M_S)
            if loss <= least:
                continue
            most = brakes if max(lasted_s, lasts_s) > STALL * usual_s else least
            if loss > most + TREMBLES_M_S:
                return True
            noise_m, falls = _noise(track, normal)
            if falls or loss > most + min(TREMBLES * noise_m / between_s, TREMBLES_M_S):
                return True
        return False

    def _steps(
        self, object_id: str, other: str, point_m: Vector, normal: Vector, run: Sequence[tuple[int, float]]
    ) -> list[tuple[float, float]]:
        """Speed [m/s] and duration [s] of each step of a run."""
        travels = [
            (end_s - begin_s if end_s > begin_s else (until - since) * self._period_s, since, until)
            for (since, begin_s), (until, end_s) in pairwise(run)
        ]
        # A step of slower physics may be shown in a frame that is shorter; a longer step is a stall.
        is_slow = self._motion.tracks[object_id].gap > 1.0
        least_s = min(median(x for x, _, _ in travels[:-1]), SLOW_STEP_S) if is_slow else 0.0
        steps: list[tuple[float, float]] = []
        for duration_s, since, until in travels:
            lasts_s = max(duration_s, least_s)
            came_m = dot(self._motion.nearing_m(object_id, other, point_m, since, until), normal)
            steps.append((came_m / lasts_s, lasts_s))
        return steps


def _noise(track: MotionTrack, normal: Vector) -> tuple[float, bool]:
    """Return the standard deviation of an object's place from a parabola [m], and whether it clearly falls freely
    along a normal; both over the steps before the last one.

    Neither gravity nor an impact moves it across the normal, so across it all steps count, and along it those of the
    present motion. The noise is 0 with too few steps, or a clock that stands still.
    """
    latest = track.steps[-1 - MOST_STEPS : -1]
    since_s = latest[-1][1] - SMOOTH_S if latest else 0.0
    latest = [step for step in latest if step[1] > since_s]
    if len(latest) < 3 or latest[0][1] == latest[-1][1]:
        return 0.0, False
    times, places = [time_s for _, time_s, _ in latest], [in_world(track.own_m, pose) for _, _, pose in latest]
    along = [dot(place, normal) for place in places]
    variance = 0.0
    if (n := len(times)) >= LEAST_SMOOTH:
        across = ([place[i] - x * normal[i] for place, x in zip(places, along, strict=True)] for i in range(3))
        variance = sum(parabola(times, x).residual_m2 for x in across) / (2 * (n - 3))
    begin = next((i for i, (update, _, _) in enumerate(latest) if update >= track.since), n)
    times, along = times[begin:], along[begin:]
    if (n := len(times)) < 3 or times[0] == times[-1]:
        return math.sqrt(variance), False
    falls: list[bool] = []
    # A late frame shows a step late, but seldom leaves one out: evenly spaced times may be nearer to the true ones.
    even = [times[0] + (times[-1] - times[0]) * i / (n - 1) for i in range(n)]
    is_stall = max(b - a for a, b in pairwise(times)) > STALL * (times[-1] - times[0]) / (n - 1)
    for i, axis in enumerate((times,) if is_stall else (times, even)):
        fitted = parabola(axis, along)
        if i == 0 and n >= LEAST_SMOOTH:
            variance = max(variance, fitted.residual_m2 / (n - 3))
        if not fitted.bend2:
            return math.sqrt(variance), False
        falls.append(fitted.bent_m_s2 - FALLS_M_S2 / 2 > SURE * math.sqrt(fitted.bent_error2()))
    return math.sqrt(variance), True in falls
