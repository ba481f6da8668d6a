"""The sound as it is heard: without the slow pressure of wind and rooms, which may be stronger than all else.

A recording of a mason at work has 10 dB more energy between 1 and 15 Hz than in all that is heard. Its level and its
steadiness are those of the strokes, not of the air. The gain is

    a(f) = 1 / (1 + (15 Hz / f)^4)      -2.4 dB at 20 Hz, where hearing begins, -0.5 at 30, -38 at 5

It is real in `heard`. In `heard_sections`, which are causal, it is the absolute value of the gain.
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import NDArray

from scene2hap.audio.second_order import high_pass

Signal = NDArray[np.float64]

HALVED_HZ = 15.0
"""Frequency of half gain [Hz]."""


def heard_sections(sample_rate_hz: float) -> Signal:
    """Return the high-pass as sections (2, 6) for `SosStage`."""
    section = high_pass(min(HALVED_HZ, 0.4 * sample_rate_hz), sample_rate_hz)
    return np.concatenate([section, section])


def heard(x: Signal, sample_rate_hz: float) -> Signal:
    """Return a whole sound (n,) as it is heard, without its offset. Its ends are mirrored, so that they do not ring."""
    f = np.arange(1, len(x)) * (0.5 * sample_rate_hz / len(x))
    spectrum = scipy.fft.dct(x)
    spectrum[0] = 0.0
    spectrum[1:] /= 1.0 + np.square(np.square(HALVED_HZ / f))
    return np.asarray(scipy.fft.idct(spectrum), dtype=np.float64)
