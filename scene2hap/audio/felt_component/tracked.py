"""Tracking of the felt component of a live stream while it plays. A whole sound is analysed by `choice`."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from scene2hap.audio.actuator_range import HIGHEST_PEAK_DB, TONES_HZ, rendered_hz
from scene2hap.audio.felt_component.choice import FAINTEST_DB
from scene2hap.audio.levels import drive_db
from scene2hap.audio.spectra.components import magnitudes, peaks
from scene2hap.audio.threshold import NOTICED_DB
from scene2hap.common.arrays import Floats
from scene2hap.haptics import ActuatorProfile

LOST_DB = 12.0
"""A component that is this much weaker than the best one within a stretch belonged to another sound (assumed)."""
_SAME = 1.06
"""Largest frequency ratio of one component in successive stretches; a larger one means another component."""
_NEW_SHARE = 0.3
"""Weight of the newest stretch in the averaged spectrum (assumed: two stretches make half of it)."""


class TrackedComponent:
    """The felt component of a live sound, from stretches of equal length. The sound is assumed to be steady.

    Spectra are averaged over stretches. A component stays while it is within `NOTICED_DB` of the best, so that the
    result does not jump between two harmonics of similar strength.

    Parameters: sample_rate_hz : of the stretches; level_db : planned sensation level of the sound [dB].
    """

    def __init__(self, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile) -> None:
        self._rate_hz, self._level_db, self._actuator = sample_rate_hz, level_db, actuator
        self._power: Floats | None = None
        self.own_hz: float | None = None

    def analyse(self, stretch: Floats) -> float | None:
        """Analyse another stretch (n_samples,). Returns the felt frequency [Hz], None while there is no sound."""
        magnitude = magnitudes(stretch)
        self._power = self._averaged(magnitude)
        found = peaks(np.sqrt(self._power), self._rate_hz, rendered_hz(self._rate_hz, self._actuator), FAINTEST_DB)
        if not found:
            return self.own_hz
        _, hz, height_db = np.array(found).T
        drive = drive_db(hz, self._level_db, self._actuator)
        good = drive <= HIGHEST_PEAK_DB
        best = int(np.argmax(good) if good.any() else np.argmin(drive))
        if self.own_hz is not None:
            near = int(np.argmin(np.abs(np.log(hz / self.own_hz))))
            is_same = abs(np.log(hz[near] / self.own_hz)) < np.log(_SAME)
            if is_same and good[near] == good[best] and height_db[near] >= height_db[best] - NOTICED_DB:
                best = near
        self.own_hz = float(hz[best])
        return self.own_hz

    def _averaged(self, magnitude: Floats) -> Floats:
        """Return the power of each bin, averaged over stretches; of this stretch alone if it lacks the component."""
        power = magnitude**2
        before, own_hz = self._power, self.own_hz
        if before is None or own_hz is None or len(before) != len(power):
            return power
        per_bin = 2 * (len(power) - 1) / self._rate_hz
        low, high = int(own_hz / _SAME * per_bin), int(own_hz * _SAME * per_bin) + 1
        first, last = (int(edge * per_bin) for edge in TONES_HZ)
        if power[low : high + 1].max() < power[first : last + 1].max() * 10 ** (-LOST_DB / 10):
            return power
        return _NEW_SHARE * power + (1.0 - _NEW_SHARE) * before

    def passed_power(self, passes: Callable[[Floats], Floats]) -> float:
        """Return the averaged power [-] that a filter with this gain of power over frequency [Hz] passes."""
        if self._power is None:
            return 0.0
        f = np.arange(len(self._power)) * self._rate_hz / (2 * (len(self._power) - 1))
        return float(self._power @ passes(f))
