"""Rise of a recording's level from quiet to steady running, found by a fit of a smooth monotonic rise.

    P(t) = S a(x)^2 + N,   a(x) = (1 - (1 - x)^p)^q,   x = (t - t_0) / T within 0..1

P [-] is the power in the felt band, S that of steady running, N that of the room. The family includes the usual rises,
or near approximations: linear (p = q = 1), half a cosine (1.5, 1.6), a motor that approaches its speed with the force
of an unbalance (2, 2), and a reversed coast-down (1, 4). The fit finds t_0 and T even where the room's noise hides the
beginning and the end has no corner. It uses the same bins of 10 ms and window of 90 ms as the measured power, so that
the window does not lengthen a short rise. Deviations of the recording from the family, such as a bend, are added to the
fit as a residual.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import scipy

from scene2hap.audio.recorded_runs.speed_track import SpeedTrack
from scene2hap.audio.spectra.windows import hann
from scene2hap.audio.threshold import TACTILE_RANGE_HZ
from scene2hap.common.arrays import Floats

BIN_S = 0.010
LEAST_RISE_DB = 12.0
"""Least rise from the room's level to steady running [dB]: a sound that was turned up a little is no start."""
SHORTEST_S, LONGEST_S = 0.2, 10.0
"""Shortest and longest start [s]. Cut files are faded over some 50 ms; a slower rise is a change of load."""
MIN_STEADY_S = 1.0
"""Least steady running from which a loop can be cut [s]."""
MOST_SPREAD_DB = 6.0
"""Largest range of the level of steady running over 100 ms, from its 2nd to its 98th percentile [dB]. Recorded hums, a
fan and a washing machine have 1.2 to 3.5, pink noise 3.4, revved chainsaws 8.7 and 19, ticks and speech above 50."""
MOST_RESIDUAL_DB = 2.5
"""Largest rms residual of the fit over the rise [dB] (assumed); it excludes rises with steps or dips."""

_WINDOW = hann(9) / hann(9).sum()
_SHORT, _LONG = 10, 50
"""Numbers of bins over which a level is averaged: the short mean resolves single notes and strokes, the long one
smooths them."""
_USUAL_PERCENTILE = 75.0
"""Percentile that estimates the level of steady running, even if start and stop take three quarters of a recording."""
_NEAR_DB = 3.0
_QUIET_DB = 6.0
"""How far the room's level may vary above its minimum before the rise [dB]; levels 12 dB below the machine are always
allowed."""
_FLOOR = 1e-6
"""Floor of the power, as a share of that of steady running, since digital silence has no level."""
_SHAPES = ((1.0, 1.0), (2.0, 2.0), (1.0, 3.0), (1.5, 1.0))
"""Exponents p, q at which the search for the fit begins."""
_LEAST_EXPONENTS, _MOST_EXPONENTS, _MOST_OF_SPEED = (0.8, 0.8), (2.2, 5.0), (2.2, 2.2)
_BEFORE = 0.2
"""Longest time by which a rise may begin before the recording, as a share of the recording [-]."""
_SPEED_ERROR = 0.008
"""Error of a tracked speed [-] that weighs as much in the fit as 1 dB of a level. The track has steps of 0.01."""
_POINTS_PER_S, _FEWEST_POINTS = 20, 17


class Steady(NamedTuple):
    """Bins [first, end) of steady running, and its power [-]."""

    first: int
    end: int
    power: float


class Rise(NamedTuple):
    """A rise: begin and end [s] in the recording, amplitude (n_points,) [-] between them, and speed at the same times
    (n_points,) [-], None if it was not tracked."""

    begin_s: float
    end_s: float
    amplitude: Floats
    speed: Floats | None = None


def felt_power(samples: Floats, sample_rate_hz: float) -> Floats:
    """Return the power (n_bins,) [-] of a recording (n,) in the felt band, in whole bins of `BIN_S`; empty if it is too
    short, or its sample rate too low."""
    size, high = round(BIN_S * sample_rate_hz), min(TACTILE_RANGE_HZ[1], 0.45 * sample_rate_hz)
    n_bins = len(samples) // max(1, size)
    if size < 1 or high < 2 * TACTILE_RANGE_HZ[0] or n_bins * BIN_S < MIN_STEADY_S + SHORTEST_S:
        return np.zeros(0)
    sos = scipy.signal.butter(2, (TACTILE_RANGE_HZ[0], high), "bandpass", fs=sample_rate_hz, output="sos")
    felt = scipy.signal.sosfiltfilt(sos, samples - np.median(samples))
    return np.asarray((felt[: n_bins * size].reshape(n_bins, size) ** 2).mean(axis=1))


def steady_part(power: Floats) -> Steady | None:
    """Return steady running, from the first to the last bin near the usual level; None if it is short or not steady."""
    if not power.size or power.max() <= 0.0:
        return None
    slow, level = _db(_smoothed(power, _LONG)), _db(_smoothed(power, _SHORT))
    near = np.flatnonzero(slow >= np.percentile(slow, _USUAL_PERCENTILE) - _NEAR_DB)
    first, end = int(near[0]), int(near[-1]) + 1
    if (end - first) * BIN_S < MIN_STEADY_S:
        return None
    low, high = np.percentile(level[first:end], (2, 98))
    if high - low > MOST_SPREAD_DB:
        return None
    return Steady(first, end, float(np.median(_smoothed(power, _SHORT)[first:end])))


def find_rise(power: Floats, steady: Steady, track: SpeedTrack | None = None) -> Rise | None:
    """Return the rise at the beginning of a recording with this power (n_bins,), None if there is none.

    Parameters: track : the tracked speed, which shows the beginning where the room's noise hides the level.
    """
    level = _smoothed(power, _SHORT)
    if steady.first < 2:
        return None
    quiet = int(np.argmin(level[: steady.first]))
    noise = float(level[quiet]) / steady.power
    quiet_db = _db(level[: quiet + 1] / steady.power)
    if _db(noise) > -LEAST_RISE_DB or quiet_db.max() > max(_db(noise) + _QUIET_DB, -LEAST_RISE_DB):
        return None
    n = min(steady.end, steady.first + max(_LONG, steady.first - quiet))
    fit = _Fit(power[:n] / steady.power, track)
    found = fit.best(quiet, steady.first, max(noise, _FLOOR))
    t0, length, lift, noise_db = found[:4]
    is_within = t0 + length > 1.0 and (steady.end - t0 - length) * BIN_S >= MIN_STEADY_S
    if not is_within or not SHORTEST_S <= length * BIN_S <= LONGEST_S:
        return None
    residual_db = fit.residual_db(found)
    if np.sqrt(np.mean(residual_db[max(0, math.floor(t0)) : math.ceil(t0 + length)] ** 2)) > MOST_RESIDUAL_DB:
        return None
    x = np.linspace(0.0, 1.0, max(_FEWEST_POINTS, round(length * BIN_S * _POINTS_PER_S) + 1))
    at = t0 + x * length
    a = _rising(x, *found[4:6])
    of_machine = a**2 / (a**2 + 10 ** ((noise_db - lift) / 10))
    off_db = np.interp(at, np.arange(n), _smoothed(residual_db, _SHORT)) * of_machine
    amplitude = _pinned(a * 10 ** (off_db / 20))
    speed = None if track is None else fit.speed(found, x)
    return Rise((t0 + 0.5) * BIN_S, (t0 + length + 0.5) * BIN_S, amplitude, speed)


class _Fit:
    """Least-squares fit of a rise: begin and length [bins], levels of steady running and of the room [dB], exponents of
    the amplitude, and of the speed if it was tracked."""

    def __init__(self, relative: Floats, track: SpeedTrack | None) -> None:
        self._n = len(relative)
        self._at, self._edge = np.arange(self._n, dtype=np.float64), np.convolve(np.ones(self._n), _WINDOW, "same")
        self._level_db = _db(np.convolve(relative, _WINDOW, "same") / self._edge + _FLOOR)
        self._speed_at = np.zeros(0) if track is None else track.at_s / BIN_S - 0.5
        self._speed = np.zeros(0) if track is None else track.speed

    def best(self, quiet: int, steady: int, noise: float) -> Floats:
        """Return the best of several fits, whose searches begin at different shapes."""
        length, noise_db, n_pairs = max(2.0, 1.2 * (steady - quiet)), float(_db(noise)), 1 + bool(self._speed.size)
        low = [-_BEFORE * self._n, 2.0, -3.0, noise_db - 10.0, *_LEAST_EXPONENTS * n_pairs]
        high = [self._n, 2.0 * self._n, 3.0, noise_db + 10.0, *_MOST_EXPONENTS, *_MOST_OF_SPEED][: 4 + 2 * n_pairs]
        begins = [
            [max(0.0, steady - length), length, 0.0, noise_db, *shape, 1.2, 1.2][: 4 + 2 * n_pairs] for shape in _SHAPES
        ]
        scale = [10.0, 10.0, 1.0, 1.0, *(0.3, 0.5) * n_pairs]
        fits = [
            scipy.optimize.least_squares(
                self._residuals, begin, bounds=(low, high), x_scale=scale, loss="soft_l1", max_nfev=60
            )
            for begin in begins
        ]
        return np.asarray(min(fits, key=lambda one: one.cost).x)

    def residual_db(self, found: Floats) -> Floats:
        """Return measured minus fitted level (n_bins,) [dB]."""
        t0, length, lift, noise_db, p, q = found[:6]
        a = _rising((self._at - t0) / length, p, q)
        power = np.convolve(10 ** (lift / 10) * a**2 + 10 ** (noise_db / 10), _WINDOW, "same") / self._edge
        return np.asarray(self._level_db - _db(power + _FLOOR))

    def speed(self, found: Floats, x: Floats) -> Floats:
        """Return the speed [-] at shares x (n,) of the rise: as tracked, and before the track as fitted."""
        t0, length = found[:2]
        fitted = _rising(x, *found[6:8])
        off = self._speed - _rising((self._speed_at - t0) / length, *found[6:8])
        return _pinned(fitted + np.interp(t0 + x * length, self._speed_at, off, left=0.0, right=0.0))

    def _residuals(self, found: Floats) -> Floats:
        level_db = self.residual_db(found)
        if not self._speed.size:
            return level_db
        off = self._speed - _rising((self._speed_at - found[0]) / found[1], *found[6:8])
        return np.concatenate([level_db, off / _SPEED_ERROR])


def _rising(x: Floats, p: float, q: float) -> Floats:
    return np.asarray((1.0 - (1.0 - np.clip(x, 0.0, 1.0)) ** p) ** q)


def _pinned(values: Floats) -> Floats:
    """Return the values made monotonic, from 0 to 1."""
    rising = np.clip(np.maximum.accumulate(values), 0.0, 1.0)
    rising[0], rising[-1] = 0.0, 1.0
    return np.asarray(rising)


def _smoothed(values: Floats, n: int) -> Floats:
    """Return the running mean over n bins, over fewer at the ends."""
    n = min(n, len(values))
    return np.asarray(np.convolve(values, np.ones(n), "same") / np.convolve(np.ones(len(values)), np.ones(n), "same"))


def _db(power: Floats | float) -> Floats:
    return np.asarray(10.0 * np.log10(np.maximum(power, 1e-300)))
