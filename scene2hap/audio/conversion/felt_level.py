"""The sensation level of a sound of any length, block by block."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import scipy

from scene2hap.audio.actuators import response_db
from scene2hap.audio.conversion.meter import AT_ONCE, Block
from scene2hap.audio.threshold import TACTILE_RANGE_HZ, threshold_db
from scene2hap.common.arrays import Floats, Floats32
from scene2hap.haptics import ActuatorProfile

_SEGMENT_S, _OVERLAP = 1.0, 0.1


class FeltLevel:
    """Measures the sensation level of a vibration on an actuator, over its whole length.

    The mean power of pieces of one second replaces the components of `levels`. Silence is added before and after the
    sound. Pieces overlap with sine windows, whose squares add up to 1, so that every sample has the same weight,
    including the first one of a knock. Source: J. P. Princen, A. B. Bradley, IEEE Trans. ASSP 34 (1986) 1153.
    """

    def __init__(self, sample_rate_hz: int, channels: int, actuator: ActuatorProfile) -> None:
        size = scipy.fft.next_fast_len(max(round(_SEGMENT_S * sample_rate_hz), 2), real=True)
        self._overlap = max(1, round(_OVERLAP * size))
        self.peak: float = 0.0
        self._segment, self._filled = np.zeros((channels, size), dtype=np.float32), self._overlap
        self._full: list[Block] = []
        self._n_frames = 0
        self._window = _window(size, self._overlap)
        self._inside, self._weight = _weights(size, sample_rate_hz, actuator)
        self._energy = np.zeros(channels)

    def add(self, block: Block) -> None:
        """Add the next frames to the measurement."""
        if not len(block):
            return
        self.peak = max(self.peak, float(np.abs(block).max()))
        self._n_frames += len(block)
        at, size = 0, self._segment.shape[1]
        while at < len(block):
            n = min(len(block) - at, size - self._filled)
            self._segment[:, self._filled : self._filled + n] = block[at : at + n].T
            self._filled, at = self._filled + n, at + n
            if self._filled == size:
                self._full.append(self._segment.copy())
                if len(self._full) * len(self._segment) >= AT_ONCE:
                    self._add_full()
                self._segment[:, : self._overlap] = self._segment[:, -self._overlap :]
                self._filled = self._overlap

    def level_db(self) -> float:
        """Return the sensation level of the strongest channel [dB], minus infinity for silence."""
        self._add_full()
        rest = self._segment.copy()
        rest[:, self._filled :] = 0.0
        after = np.zeros_like(rest)
        after[:, : self._overlap] = rest[:, -self._overlap :]
        energy = self._energy + self._energy_of([rest, after])
        most = float(energy.max()) / max(self._n_frames, 1)
        return 10.0 * math.log10(most) if most > 0.0 else -math.inf

    def _add_full(self) -> None:
        self._energy += self._energy_of(self._full)
        self._full = []

    def _energy_of(self, pieces: list[Block]) -> Floats | float:
        """Return, for each channel of pieces (channels, n), the squared ratios of its components' amplitudes to their
        thresholds, summed over components and pieces and multiplied by time [samples]."""
        if not pieces:
            return 0.0
        windowed = np.stack(pieces)
        windowed *= self._window
        spectrum = scipy.fft.rfft(windowed, axis=2)[:, :, self._inside]
        power = spectrum.real.astype(np.float64) ** 2 + spectrum.imag.astype(np.float64) ** 2
        # Factor 4: both sides of the spectrum, and the square of an amplitude is twice its mean power (Parseval).
        return np.asarray(4.0 / len(self._window) * (power @ self._weight).sum(axis=0))


@lru_cache(maxsize=2)
def _window(size: int, overlap: int) -> Floats32:
    slope = np.sin(0.5 * np.pi * (np.arange(overlap) + 0.5) / overlap)
    return np.concatenate([slope, np.ones(size - 2 * overlap), slope[::-1]]).astype(np.float32)


@lru_cache(maxsize=2)
def _weights(size: int, sample_rate_hz: int, actuator: ActuatorProfile) -> tuple[slice, Floats]:
    """Return the bins that can be felt, and the squared ratio of amplitude to threshold at each."""
    f = np.fft.rfftfreq(size, 1.0 / sample_rate_hz)
    inside = slice(np.searchsorted(f, TACTILE_RANGE_HZ[0]), np.searchsorted(f, TACTILE_RANGE_HZ[1], side="right"))
    return inside, 10 ** ((response_db(actuator, f[inside]) - threshold_db(f[inside])) / 10)
