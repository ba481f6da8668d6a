"""The sources' tactile loops, split in bands and ready to be read at any position."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.audio.bands import split_bands
from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.haptics import Bands


class LoopBank:
    """Loops at one sample rate, in a fixed order.

    A loop of another rate is resampled as the periodic signal that it is, to the nearest whole number of samples.
    """

    def __init__(self, loops: Sequence[AudioClip], bands: Bands, sample_rate_hz: int) -> None:
        resampled = [_at_rate(loop, sample_rate_hz) for loop in loops]
        self._loops = [split_bands(samples, sample_rate_hz, bands) for samples in resampled]
        self.n_rows = len(loops) * bands.n_bands

    def __len__(self) -> int:
        return len(self._loops)

    def length(self, loop: int) -> int:
        """Samples after which that loop begins anew."""
        return int(self._loops[loop].shape[1])

    def read(self, start: int, n_frames: int) -> NDArray[np.float32]:
        """Samples (n_loops * n_bands, n_frames) from a position on the common clock; every loop wraps by itself."""
        if not self._loops:
            return np.zeros((0, n_frames), dtype=np.float32)
        return np.concatenate([_wrapped(loop, start, n_frames) for loop in self._loops])


def _wrapped(loop: NDArray[np.float32], start: int, n_frames: int) -> NDArray[np.float32]:
    length = loop.shape[1]
    first = start % length
    if first + n_frames <= length:
        return loop[:, first : first + n_frames]
    return loop[:, np.arange(first, first + n_frames) % length]


def _at_rate(loop: AudioClip, sample_rate_hz: int) -> Samples:
    if loop.sample_rate_hz == sample_rate_hz:
        return loop.samples
    n_in = len(loop.samples)
    n_out = max(1, round(n_in * sample_rate_hz / loop.sample_rate_hz))
    # irfft of the truncated or zero-padded spectrum is exact band-limited interpolation of a periodic signal.
    spectrum = np.fft.rfft(loop.samples.astype(np.float64))
    return (np.fft.irfft(spectrum, n_out) * (n_out / n_in)).astype(np.float32)
