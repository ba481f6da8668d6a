"""Streaming conversion of the sample rate, from the session's to a device's.

    y[m] = sum_j h[p + j up] x[q - j]        q = m down // up,  p = m down mod up,  up / down = f_out / f_in

h is a Kaiser-windowed low-pass at rate up f_in, split into `up` phases once. Inputs for the next outputs are stored, so
the block size has no effect on the signal. Available streaming converters have too much latency for touch (soxr 1.1
from 48 to 4 kHz: 36 ms at medium quality, 222 ms at high quality). A filter that must preserve only the tactile band
has 2.6 ms.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from scene2hap.devices.protocol import Block

TACTILE_EDGE_HZ = 1000.0
"""Upper end of the pass band [Hz]; higher frequencies are not felt."""

STOP_BAND_DB = 80.0
"""Attenuation of aliasing frequencies [dB], well beyond the 55 dB range of touch."""


class RateConverter:
    """A streaming converter for n_channels; with equal rates it returns samples unchanged.

    It passes 0 to min(1 kHz, 0.6 Nyquist), and attenuates frequencies above the lower Nyquist frequency by 80 dB.
    """

    def __init__(self, rate_in_hz: int, rate_out_hz: int, n_channels: int) -> None:
        common = math.gcd(rate_in_hz, rate_out_hz)
        self._up, self._down = rate_out_hz // common, rate_in_hz // common
        self._phases = _phases(rate_in_hz, rate_out_hz, self._up) if self._up != self._down else None
        n_taps = 1 if self._phases is None else self._phases.shape[1]
        self.latency_s: float = (n_taps * self._up - 1) / 2 / (rate_in_hz * self._up) if n_taps > 1 else 0.0
        self.n_held: int = math.ceil(n_taps * self._up / self._down) if n_taps > 1 else 0
        """Number of output frames that the newest input frame reaches."""
        self._past = np.zeros((n_taps, n_channels))
        self._next_out = self._next_in = 0

    def needed(self, n_out: int) -> int:
        """Return the number of input frames for the next n_out frames."""
        if n_out == 0:
            return 0
        return max(0, (self._next_out + n_out - 1) * self._down // self._up + 1 - self._next_in)

    def convert(self, block: Block, n_out: int) -> Block:
        """Return the next frames (n_out, n_channels) float32 from `needed(n_out)` frames of input."""
        if self._phases is None:
            return block
        n_taps = self._phases.shape[1]
        signal = np.concatenate([self._past, block])
        start = self._next_in - n_taps
        place = np.arange(self._next_out, self._next_out + n_out) * self._down
        oldest, phase = place // self._up - start - (n_taps - 1), place % self._up
        reach = sliding_window_view(signal, n_taps, axis=0)[oldest]
        out: NDArray[np.float64] = np.einsum("mj,mcj->mc", self._phases[phase], reach)
        self._past = signal[len(signal) - n_taps :]
        self._next_in += len(block)
        self._next_out += n_out
        self._rebase()
        return out.astype(np.float32)

    def _rebase(self) -> None:
        """Subtract a common period from both counters, so that they stay small in a long run."""
        periods = min(self._next_out // self._up, self._next_in // self._down)
        self._next_out -= periods * self._up
        self._next_in -= periods * self._down


def _phases(rate_in_hz: int, rate_out_hz: int, up: int) -> NDArray[np.float64]:
    """Return the low-pass as (up, n_taps_per_phase), newest input last. Each phase has a gain of 1 at 0 Hz.

    Source: Kaiser 1974; Oppenheim and Schafer, Discrete-Time Signal Processing, 7.5.3, for beta and length. It is
    written out since importing scipy.signal takes a second on a busy machine, while a device waits.
    """
    nyquist_hz = min(rate_in_hz, rate_out_hz) / 2
    pass_hz = min(TACTILE_EDGE_HZ, 0.6 * nyquist_hz)
    rate_hz = rate_in_hz * up
    n_taps = (STOP_BAND_DB - 7.95) / (2.285 * 2 * np.pi * (nyquist_hz - pass_hz) / rate_hz) + 1
    n_per_phase = math.ceil(n_taps / up)
    n_taps = n_per_phase * up
    place = np.arange(n_taps) - (n_taps - 1) / 2
    taps = np.sinc((nyquist_hz + pass_hz) / rate_hz * place) * np.kaiser(n_taps, 0.1102 * (STOP_BAND_DB - 8.7))
    phases: NDArray[np.float64] = np.ascontiguousarray(taps.reshape(n_per_phase, up).T[:, ::-1])
    phases /= phases.sum(axis=1, keepdims=True)
    return phases
