"""The frequencies at which an actuator can play a source, and its peak limit."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from scene2hap.audio.actuators import response_db
from scene2hap.audio.levels import drive_db
from scene2hap.audio.threshold import threshold_db
from scene2hap.common.arrays import Floats
from scene2hap.haptics import ActuatorProfile

HIGHEST_PEAK_DB = -6.5
"""Highest peak of a band [dB re full scale]: the head-room of loops (6 dB), and 0.5 dB for the difference of a loop
from the sound it is cut from."""
TONES_HZ = (20.0, 1000.0)
"""Range of components that may be felt as tones [Hz]."""
CARRIER_RANGE_HZ = (100.0, 300.0)
"""Range of carriers [Hz], in which a burst of 8 ms still has a frequency, and touch is sensitive."""
_GRID = 81
"""Frequencies at which `reachable_hz` looks for the limits of a move."""


def rendered_hz(sample_rate_hz: float, actuator: ActuatorProfile) -> tuple[float, float]:
    """Return the range of frequencies that are both felt and rendered [Hz]."""
    low = max(TONES_HZ[0], actuator.min_frequency_hz)
    return low, min(TONES_HZ[1], actuator.max_frequency_hz, 0.45 * sample_rate_hz)


@lru_cache(maxsize=8)
def best_carrier_hz(actuator: ActuatorProfile) -> float:
    """Return the frequency at which the actuator is felt best, among those that suit short bursts [Hz]."""
    f = np.geomspace(*CARRIER_RANGE_HZ, 65)
    inside = f[(f >= actuator.min_frequency_hz) & (f <= actuator.max_frequency_hz)]
    among = inside if inside.size else f
    return float(among[int(np.argmax(response_db(actuator, among) - threshold_db(among)))])


def nearest_felt_hz(
    frequencies_hz: Floats,
    levels_db: Floats,
    actuator: ActuatorProfile,
    peak_db: float,
    accepted_db: float,
) -> Floats:
    """Return the frequency (n,) nearest to each given one at which an actuator plays a sine of some level [Hz].

    There the sine, with an amplitude of at most `peak_db` re full scale, is felt at most `accepted_db` weaker than at
    the best frequency of the band. Parameters: frequencies_hz (n,), > 0; levels_db (n,) : sensation levels [dB].
    """
    grid_hz, over_level_db = _drive_at_threshold_db(actuator)
    most_db = np.maximum(peak_db, levels_db + over_level_db.min()) + accepted_db
    inside = (frequencies_hz >= actuator.min_frequency_hz) & (frequencies_hz <= actuator.max_frequency_hz)
    stays = inside & (drive_db(frequencies_hz, levels_db, actuator) <= most_db)
    if stays.all():
        return frequencies_hz
    octaves = np.abs(np.log2(grid_hz / frequencies_hz[:, None]))
    octaves[over_level_db + levels_db[:, None] > most_db[:, None]] = np.inf
    return np.where(stays, frequencies_hz, grid_hz[octaves.argmin(axis=1)])


@lru_cache(maxsize=64)
def _drive_at_threshold_db(actuator: ActuatorProfile) -> tuple[Floats, Floats]:
    """Frequencies of a band, 24 per octave (n,) [Hz], and the drive of a sine at the threshold (n,) [dB].

    A step is far below the 22 % in frequency that are just noticed.
    """
    low_hz, high_hz = actuator.min_frequency_hz, actuator.max_frequency_hz
    grid_hz: Floats = np.geomspace(low_hz, high_hz, 2 + math.ceil(24 * math.log2(high_hz / low_hz)))
    return grid_hz, drive_db(grid_hz, 0.0, actuator)


def reachable_hz(
    felt_hz: float, level_db: float, actuator: ActuatorProfile, octaves: float, *, crest_db: float = 0.0
) -> tuple[float, float, float]:
    """Return how far a source may be moved: lowest and highest frequency, and the gain possible at all of them [dB].

    Both frequencies [Hz] are within `octaves` of `felt_hz`. Frequencies at which the source cannot reach its level are
    left out, unless the shortfall is no larger than at `felt_hz`.

    Parameters: felt_hz : at which the source is felt [Hz]; level_db : its planned sensation level [dB]; crest_db : its
    peak relative to that of an equally felt sine [dB].
    """
    f: Floats = felt_hz * 2.0 ** np.linspace(-octaves, octaves, _GRID)
    spare_db = HIGHEST_PEAK_DB - crest_db - drive_db(f, level_db, actuator)
    in_band = (f >= actuator.min_frequency_hz) & (f <= actuator.max_frequency_hz)
    middle = _GRID // 2
    good = in_band & (spare_db >= min(0.0, float(spare_db[middle])))
    low = high = middle
    while low > 0 and good[low - 1]:
        low -= 1
    while high < _GRID - 1 and good[high + 1]:
        high += 1
    return float(f[low]), float(f[high]), max(0.0, float(spare_db[low : high + 1].min()))
