"""Judge whether the seam of a loop differs from random positions of the sound that the loop was cut from.

Four statistics at a position p of a sound x (n,): the level [dB] of the 100 ms around p; the largest of the four steps
between the five samples around p; the mean distance [dB] between the third-octave levels of the 100 ms before p and of
the 100 ms after p; and the difference [dB] of these two levels. Each is compared with percentiles of its values at
random positions. The largest of 200 values would let nearly everything pass in a sound that varies.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.fft
from numpy.typing import NDArray

WINDOW_S = 0.1
N_POSITIONS = 200
PERCENTILE = 98.0
LEVEL_SLACK_DB = JUMP_SLACK_DB = 0.5
STEP_RATIO = 1.1
DISTANCE_SLACK_DB = 0.5
FLOOR_DB = 60.0
"""Bands further than this below the loudest band are raised to this level: they are masked. Between the partials of a
synthetic tone such bands hold only side lobes of the window."""

Signal = NDArray[np.floating]


@dataclass(frozen=True)
class Verdict:
    """How far the seam lies outside the percentiles of the sound; differences at or below 0 dB do not stand out."""

    level_db: float
    step_ratio: float
    distance_db: float
    jump_db: float

    @property
    def passes(self) -> bool:
        return (
            self.level_db <= LEVEL_SLACK_DB
            and self.step_ratio <= STEP_RATIO
            and self.distance_db <= DISTANCE_SLACK_DB
            and self.jump_db <= JUMP_SLACK_DB
        )


def judge(loop: Signal, clip: Signal, rate: int, rng: np.random.Generator) -> Verdict:
    """Compare the seam of `loop` (n,) with `N_POSITIONS` random positions inside `clip` (m,)."""
    width = round(WINDOW_S * rate)
    around = np.concatenate([loop[-width:], loop[:width]])
    places = rng.integers(width, len(clip) - width, N_POSITIONS)
    stretches = np.vstack([around, clip[places[:, None] + np.arange(-width, width)]])
    level, step, distance, jump = _statistics(stretches, rate)

    def high(values: Signal) -> float:
        return float(np.percentile(values[1:], PERCENTILE))

    return Verdict(
        level_db=max(level[0] - high(level), -high(-level) - level[0]),
        step_ratio=step[0] / max(high(step), 1e-30),
        distance_db=distance[0] - high(distance),
        jump_db=jump[0] - high(jump),
    )


def _statistics(stretches: Signal, rate: int) -> tuple[Signal, Signal, Signal, Signal]:
    """Level, step, distance and jump in the middle of each stretch (n_stretches, 2 width)."""
    width = stretches.shape[1] // 2
    middle = stretches[:, width - width // 2 : width + width // 2]
    level_db = 10 * np.log10(np.mean(middle**2, axis=1) + 1e-20)
    step = np.abs(np.diff(stretches[:, width - 2 : width + 3], axis=1)).max(axis=1)
    before, after = _third_octaves_db(stretches[:, :width], rate), _third_octaves_db(stretches[:, width:], rate)
    floor = np.maximum(before.max(axis=1), after.max(axis=1))[:, None] - FLOOR_DB
    levels_db = [10 * np.log10(np.mean(part**2, axis=1) + 1e-20) for part in np.split(stretches, 2, axis=1)]
    return (
        level_db,
        step,
        np.abs(np.maximum(before, floor) - np.maximum(after, floor)).mean(axis=1),
        np.abs(levels_db[1] - levels_db[0]),
    )


def _third_octaves_db(x: Signal, rate: int) -> Signal:
    """Levels of the base-ten third octaves from 20 Hz up (n, n_bands), of stretches (n, width) under a Hann window."""
    power = np.abs(scipy.fft.rfft(x * np.hanning(x.shape[1]), axis=1)) ** 2
    frequencies = np.arange(power.shape[1]) * rate / x.shape[1]
    edges = 10 ** np.arange(1.25, np.log10(frequencies[-1]), 0.1)
    starts = np.unique(np.searchsorted(frequencies, edges))
    return 10 * np.log10(np.add.reduceat(power, starts[:-1], axis=1) + 1e-20)
