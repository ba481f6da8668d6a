"""Gains change without corners: a corner is a click far above the band of touch, which is heard and not felt."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

from scene2hap.audio.tactile.adaptive import band_around
from scene2hap.audio.tactile.following import LevelFollower
from scene2hap.audio.tactile.roughness import Roughened
from scene2hap.audio.tactile.stages import Stage

RATE = 8000
T = np.arange(4 * RATE) / RATE
TONE = 0.5 * np.sin(2 * np.pi * 150.0 * T)


class _Tone(Stage):
    """A bed that is a tone, whatever the sound, so that all above the tone comes from gains."""

    def __init__(self) -> None:
        self._n = 0

    def run(self, x: np.ndarray) -> np.ndarray:
        self._n += len(x)
        return TONE[self._n - len(x) : self._n]


def above_touch_db(stage: Stage, x: np.ndarray) -> float:
    """Highest peak above 1.2 kHz [dB re full scale], without both ends."""
    y = np.concatenate([stage.run(x), stage.rest()])
    high = sosfiltfilt(butter(8, 1200.0, "highpass", fs=RATE, output="sos"), y)
    return float(20 * np.log10(np.abs(high[RATE // 2 : -RATE // 2]).max()))


@pytest.mark.parametrize("step_db", [6.0, 14.0])
def test_a_level_that_is_switched_does_not_click(step_db: float) -> None:
    """Straight ramps of 5 ms gave -52 and -50 dB."""
    level = np.where(np.floor(T / 0.3) % 2 > 0, 10 ** (-step_db / 20), 1.0)
    assert above_touch_db(LevelFollower(_Tone(), RATE, 0.0), level * 0.5 * np.sin(2 * np.pi * 397.0 * T)) < -70.0


def test_a_roughness_that_exceeds_its_envelope_does_not_buzz() -> None:
    """A sharp bound gave -42 dB."""
    line = 0.2 * np.sin(2 * np.pi * 80.0 * T) * (1.0 + 0.8 * np.sin(2 * np.pi * 9.0 * T))
    bands = band_around(80.0, 2.0, RATE), band_around(80.0, 6.0, RATE)
    assert above_touch_db(Roughened(_Tone(), *bands, 80.0, RATE), line) < -55.0
