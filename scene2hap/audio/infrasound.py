"""Removal of infrasound: the slow pressure of wind and rooms, which may be stronger than all that is heard.

A recording of a mason at work has 10 dB more energy between 1 and 15 Hz than in all that is heard. Its level and its
steadiness are those of the strokes, not of the air. The gain is

    a(f) = 1 / (1 + (15 Hz / f)^4)      -2.4 dB at 20 Hz, where hearing begins, -0.5 at 30, -38 at 5

It is real in `without_infrasound`. The sections of `infrasound_filter` are causal; theirs has this absolute value.
"""

from __future__ import annotations

import numpy as np
import scipy

from scene2hap.audio.second_order import high_pass
from scene2hap.common.arrays import Floats

HALVED_HZ = 15.0
"""Frequency of half gain [Hz]."""


def infrasound_filter(sample_rate_hz: float) -> Floats:
    """Return the high-pass as sections (2, 6) for `SosStage`."""
    section = high_pass(min(HALVED_HZ, 0.4 * sample_rate_hz), sample_rate_hz)
    return np.concatenate([section, section])


def without_infrasound(x: Floats, sample_rate_hz: float) -> Floats:
    """Return a whole sound (n,) without infrasound and offset. Its ends are mirrored, so that they do not ring."""
    f = np.arange(1, len(x)) * (0.5 * sample_rate_hz / len(x))
    spectrum = scipy.fft.dct(x)
    spectrum[0] = 0.0
    spectrum[1:] /= 1.0 + np.square(np.square(HALVED_HZ / f))
    return np.asarray(scipy.fft.idct(spectrum), dtype=np.float64)
