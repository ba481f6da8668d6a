"""The period of a sound's level, as of a ringing phone: a loop of whole periods keeps the beat."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike

from scene2hap.audio.loops.curve_peaks import at_whole_samples, peaks
from scene2hap.common.arrays import Bools, Floats

_LEVEL_STEP_S, _SHORTEST_PERIOD_S = 0.01, 0.2
"""Time resolution of the level, and shortest period of it [s]. Shorter periods fit into the compared stretches."""
_LEAST_DEPTH, _LEAST_CORRELATION, _TIE = 0.3, 0.8, 0.05
"""Bounds of a periodic level [-], assumed: least standard deviation over mean; least autocorrelation at one period;
largest difference from the best autocorrelation, up to which a shorter period is chosen."""
_TOLERANCE = 0.02
"""Largest difference from a whole number of periods [periods]. Touch notices a change of rate by 0.18."""


def level_period(x: Floats, rate: float) -> float | None:
    """Return the period of the level of a sound (n,) [samples]; None if the level is not periodic."""
    step = max(1, round(_LEVEL_STEP_S * rate))
    level = np.sqrt((x[: len(x) // step * step].reshape(-1, step) ** 2).mean(axis=1))
    n, shortest = len(level), round(_SHORTEST_PERIOD_S * rate / step)
    if n <= 4 * shortest or level.std() <= _LEAST_DEPTH * level.mean():
        return None
    level -= level.mean()
    products = scipy.fft.irfft(np.abs(scipy.fft.rfft(level, 2 * n)) ** 2)[: n // 2]
    energies = np.concatenate([[0.0], np.cumsum(level**2)])
    shifts = np.arange(n // 2)
    correlation = 2.0 * products / (energies[n - shifts] + energies[n] - energies[shifts])
    repeats = peaks(correlation[shortest:-1]) + shortest
    repeats = repeats[correlation[repeats] >= max(_LEAST_CORRELATION, correlation[repeats].max(initial=0.0) - _TIE)]
    if repeats.size == 0:
        return None
    _, after = at_whole_samples(correlation, repeats, 0, step)
    # The last repetition measures the period most exactly.
    return float(after[-1] / round(after[-1] / after[0]))


def are_whole_periods(lengths: ArrayLike, period: float) -> Bools:
    """Return a mask of the lengths that are whole numbers of a period."""
    periods = np.asarray(lengths) / period
    return np.asarray(np.abs(periods - np.round(periods)) <= _TOLERANCE)
