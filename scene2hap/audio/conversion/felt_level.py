"""The sensation level of a sound of any length, block by block."""

from __future__ import annotations

import math

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from scene2hap.audio.actuators import response_db
from scene2hap.audio.levels import TACTILE_RANGE_HZ, threshold_db
from scene2hap.haptics import ActuatorProfile

_SEGMENT_S = 1.0

Block = NDArray[np.float32]
"""Samples (n, channels)."""


class FeltLevel:
    """Hears a vibration, for an actuator, and tells how far over the threshold of touch it is on the whole.

    The mean power of pieces of a second each, under Hann's window, stands for the components of `levels`.
    """

    def __init__(self, sample_rate_hz: int, channels: int, actuator: ActuatorProfile) -> None:
        size = scipy.fft.next_fast_len(round(_SEGMENT_S * sample_rate_hz) or 2, real=True)
        self.peak = 0.0
        self._segment, self._filled, self._n = np.zeros((channels, size), dtype=np.float32), 0, 0
        self._window = np.hanning(size + 2)[1:-1].astype(np.float32)
        f = np.fft.rfftfreq(size, 1.0 / sample_rate_hz)
        inside = (f >= TACTILE_RANGE_HZ[0]) & (f <= TACTILE_RANGE_HZ[1])
        weight = 10 ** ((response_db(actuator, f[inside]) - threshold_db(f[inside])) / 10)
        self._inside, self._weight = np.flatnonzero(inside), weight
        self._power = np.zeros(channels)

    def hear(self, block: Block) -> None:
        """Take in the next frames."""
        if not len(block):
            return
        self.peak = max(self.peak, float(np.abs(block).max()))
        at, size = 0, self._segment.shape[1]
        while at < len(block):
            n = min(len(block) - at, size - self._filled)
            self._segment[:, self._filled : self._filled + n] = block[at : at + n].T
            self._filled, at = self._filled + n, at + n
            if self._filled == size:
                self._add()

    def level_db(self) -> float:
        """Of the channel that is felt most [dB], minus infinity for silence. What is cut off at the end, less than a
        piece, counts where there is nothing else."""
        if not self._n and self._filled:
            self._segment[:, self._filled :] = 0.0
            self._window = np.zeros_like(self._window)
            self._window[: self._filled] = np.hanning(self._filled + 2)[1:-1]
            self._add()
        most = float(self._power.max()) / max(self._n, 1)
        return 10.0 * math.log10(most) if most > 0.0 else -math.inf

    def _add(self) -> None:
        spectrum = scipy.fft.rfft(self._segment * self._window, axis=1)[:, self._inside]
        # The window lets through its mean square of the power.
        through = len(self._window) * float(np.sum(self._window.astype(np.float64) ** 2)) / 4.0
        amplitude2 = (spectrum.real.astype(np.float64) ** 2 + spectrum.imag.astype(np.float64) ** 2) / through
        self._power += amplitude2 @ self._weight
        self._n, self._filled = self._n + 1, 0
