"""Equalizer: a filter with the bounded inverse of an actuator's response, applied block by block."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import scipy

from scene2hap.audio.actuators import inverse_db
from scene2hap.audio.conversion.meter import Block
from scene2hap.common.arrays import Complex, Floats
from scene2hap.haptics import ActuatorProfile

_LENGTH_S = 0.25
"""Length of the filter [s]: its resolution of 4 Hz is a quarter of the bandwidth of the sharpest built-in actuator."""


class Equalizer:
    """Compensates an actuator's response, without delay and without scaling.

    The filter has minimum phase, so that it has no pre-ringing. Blocks are convolved by overlap-save at places that
    depend on the sample number alone, so that the block size has no effect on the result. All channels are transformed
    together, which takes a third less time.
    Source: A. V. Oppenheim, R. W. Schafer, Discrete-Time Signal Processing, 3rd ed., sections 8.7 and 13.6.
    """

    def __init__(self, actuator: ActuatorProfile, sample_rate_hz: int, channels: int) -> None:
        n = max(16, round(_LENGTH_S * sample_rate_hz))
        size = scipy.fft.next_fast_len(4 * n, real=True)
        self._spectrum = _spectrum(actuator, sample_rate_hz, n, size)
        self._size, self._hop = size, size - n + 1
        self._before = np.zeros((channels, n - 1))
        self._waiting: list[Floats] = []
        self._n_waiting = 0

    def process(self, block: Block) -> Block:
        """Return the filtered frames (n, channels) of the internal blocks that are complete now."""
        self._waiting.append(block.T.astype(np.float64))
        self._n_waiting += len(block)
        found = [np.empty((0, len(self._before)), dtype=np.float32)]
        while self._n_waiting >= self._hop:
            waiting = np.concatenate(self._waiting, axis=1)
            found.append(self._filtered(waiting[:, : self._hop]))
            self._waiting = [waiting[:, self._hop :]]
            self._n_waiting -= self._hop
        return np.concatenate(found)

    def finish(self) -> Block:
        """Return the remaining frames (n, channels)."""
        silence = np.zeros((len(self._before), self._hop - self._n_waiting))
        return self._filtered(np.concatenate([*self._waiting, silence], axis=1))[: self._n_waiting]

    def _filtered(self, rows: Floats) -> Block:
        heard = np.concatenate([self._before, rows], axis=1)
        self._before = heard[:, self._hop :]
        felt = scipy.fft.irfft(scipy.fft.rfft(heard, axis=1) * self._spectrum, self._size, axis=1)
        return np.asarray(felt[:, self._size - self._hop :].T.astype(np.float32, order="C"))


@lru_cache(maxsize=2)
def _spectrum(actuator: ActuatorProfile, sample_rate_hz: int, n: int, size: int) -> Complex:
    return np.asarray(scipy.fft.rfft(_minimum_phase(actuator, sample_rate_hz, n), size))


def _minimum_phase(actuator: ActuatorProfile, sample_rate_hz: int, n: int) -> Floats:
    """Return the impulse response (n,), from the gain's cepstrum with its second half folded onto the first."""
    size = 1 << (4 * n - 1).bit_length()
    gain = inverse_db(actuator, np.fft.rfftfreq(size, 1.0 / sample_rate_hz)) * (np.log(10.0) / 20.0)
    cepstrum = np.fft.irfft(gain, size)
    cepstrum[1 : size // 2] *= 2.0
    cepstrum[size // 2 + 1 :] = 0.0
    response = np.fft.irfft(np.exp(np.fft.rfft(cepstrum)), size)[:n]
    response[n // 2 :] *= np.cos(np.linspace(0.0, np.pi / 2.0, n - n // 2)) ** 2
    return response
