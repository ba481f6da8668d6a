"""The start and the stop of a machine in a recording, and the steady running between them.

A recording that begins with the start of a machine shows how long the start takes, and its amplitude and pitch over
time. The loop is cut from the steady part alone. A stop is analysed as a reversed start.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.audio.recorded_runs.level_rise import (
    BIN_S,
    MIN_STEADY_S,
    Rise,
    Steady,
    felt_power,
    find_rise,
    steady_part,
)
from scene2hap.audio.recorded_runs.speed_track import track_speed
from scene2hap.audio.run_curve import RunCurve
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.errors import AudioError


class RecordedRuns(NamedTuple):
    """The curves of start and stop, None if the recording has none, and the samples [first, end) of steady running."""

    start_up: RunCurve | None
    wind_down: RunCurve | None
    first: int
    end: int


def recorded_runs(samples: ArrayLike, sample_rate_hz: float, loop: tuple[int, int] | None = None) -> RecordedRuns:
    """Look for a start and a stop in a recording (n,). With a marked loop [first, end), this is the steady running, and
    a start or a stop that reaches into it does not count.

    A start rises from the room's level by at least 12 dB, within 0.2 to 10 s and without falling. The level that it
    reaches is steady for at least one second. Raises: AudioError: the samples are not one channel, (n,), n >= 1.
    """
    if loop is not None:
        found, (first, end) = recorded_runs(samples, sample_rate_hz), loop
        start_up = found.start_up if found.first <= first else None
        return RecordedRuns(start_up, found.wind_down if end <= found.end else None, first, end)
    rate = checks.number("sample_rate_hz", sample_rate_hz, "Hz", above=0.0, error=AudioError)
    x = np.asarray(samples, dtype=np.float64)
    if x.ndim != 1 or x.size == 0:
        raise AudioError(f"samples has shape {x.shape}; a recording has one channel of at least one sample, (n,).")
    power = felt_power(x, rate)
    steady = steady_part(power)
    if steady is None:
        return RecordedRuns(None, None, 0, len(x))
    n = len(power)
    up = _rise(x, rate, power, steady)
    length = round(n * BIN_S * rate)
    down = _rise(x[:length][::-1], rate, power[::-1], Steady(n - steady.end, n - steady.first, steady.power))
    first = 0 if up is None else round(up.end_s * rate)
    end = len(x) if down is None else length - round(down.end_s * rate)
    if (end - first) < MIN_STEADY_S * rate:
        return RecordedRuns(None, None, 0, len(x))
    return RecordedRuns(
        None if up is None else _curve(up, backwards=False),
        None if down is None else _curve(down, backwards=True),
        first,
        end,
    )


def _rise(x: Floats, rate: float, power: Floats, steady: Steady) -> Rise | None:
    rise = find_rise(power, steady)
    if rise is None:
        return None
    track = track_speed(x, rate, (rise.begin_s, rise.end_s), (rise.end_s, steady.end * BIN_S))
    if track is None:
        return rise
    if track.is_constant:
        return rise._replace(speed=np.ones(len(rise.amplitude)))
    return find_rise(power, steady, track) or rise


def _curve(rise: Rise, *, backwards: bool) -> RunCurve:
    step = -1 if backwards else 1
    speed = () if rise.speed is None else tuple(rise.speed[::step].round(4).tolist())
    return RunCurve(round(rise.end_s - rise.begin_s, 3), tuple(rise.amplitude[::step].round(4).tolist()), speed)
