"""Peak of a loop in each band: over the threshold of touch, and re full scale."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from scene2hap.audio.bands import split_bands
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.levels import threshold_db
from scene2hap.haptics import Bands

RATE_HZ = 8000
"""Rate at which peaks are looked for: eight samples per wave at 1 kHz miss it by a factor of cos(pi/8) at most."""


def peaks_of(clip: AudioClip, bands: Bands) -> NDArray[np.float64]:
    """Peak of each band (2, n_bands): over the threshold of touch, then re full scale."""
    spectrum = np.fft.rfft(clip.samples.astype(np.float64))
    frequencies = np.fft.rfftfreq(len(clip.samples), 1 / clip.sample_rate_hz)
    n = max(1, round(len(clip.samples) * RATE_HZ / clip.sample_rate_hz))
    weights = (10 ** (-threshold_db(frequencies) / 20), np.ones(len(frequencies)))
    weighted = [np.fft.irfft(spectrum * weight, n) * (n / len(clip.samples)) for weight in weights]
    peaks: NDArray[np.float64] = np.array(
        [np.abs(split_bands(samples, RATE_HZ, bands)).max(axis=1) for samples in weighted]
    )
    return peaks / math.cos(math.pi / 8)
