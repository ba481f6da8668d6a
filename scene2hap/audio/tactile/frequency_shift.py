"""Frequency shift: move a band of sound down to frequencies that the skin feels.

For sounds above the range of touch: beeps, whines, glass. The band is shifted by a fixed number of hertz, so that its
envelope and its beats do not change. `adaptive` moves the band of a source in the same way.
Source: Okazaki, Kajimoto and Hayward 2012/2015 move audio into the tactile range in this way; Merchel and Altinsoy
recommend it with compression. Differs: they divide frequencies by powers of two, which keeps harmonic ratios but needs
a pitch. A shift by hertz needs no pitch and works on noise as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile.oscillator import Oscillator
from scene2hap.audio.tactile.sections import through_sections
from scene2hap.audio.tactile.stages import Stage, StageStream
from scene2hap.audio.threshold import TACTILE_RANGE_HZ
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.errors import ConfigError

_LOWEST_HZ = TACTILE_RANGE_HZ[0]
_RIPPLE_DB, _STOP_DB = 0.05, 70.0
"""Ripple and stop band of the low-pass of `ShiftStage` [dB]."""


@dataclass(frozen=True)
class FrequencyShift:
    """Shift the band `low_hz`..`high_hz` by `shift_hz` (negative is down) and drop the rest.

    The default moves 300..1250 Hz to 50..1000 Hz, in every context. Components that would end below 10 Hz are dropped.
    Raises: ConfigError: bounds that are not rising, or a band that would begin below 10 Hz; once the sample rate is
    known, a band that does not begin below 0.45 times this rate.
    """

    shift_hz: float = -250.0
    low_hz: float = 300.0
    high_hz: float = 1250.0

    def __post_init__(self) -> None:
        low = checks.number("low_hz", self.low_hz, "Hz", above=0.0, error=ConfigError)
        checks.number("high_hz", self.high_hz, "Hz", above=low, error=ConfigError)
        checks.number(
            "shift_hz",
            self.shift_hz,
            "Hz",
            at_least=_LOWEST_HZ - low,
            error=ConfigError,
            hint="Raise low_hz, or shift by less: below 10 Hz nothing is felt and the band would fold over.",
        )

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> StageStream:
        """Start a conversion at a sample rate."""
        highest = 0.45 * sample_rate_hz
        checks.number("low_hz", self.low_hz, "Hz", below=highest, error=ConfigError, hint="Use a higher sample rate.")
        high = min(self.high_hz, highest)
        return StageStream(ShiftStage(self.low_hz, high, self.shift_hz, sample_rate_hz))


class ShiftStage(Stage):
    """Single-sideband modulation: moves a band by a number of hertz and keeps its envelope.

    With c the middle of the band, w half its width and h a low-pass with cut-off w:

        z = h * (x exp(-i 2 pi c t))        y = 2 Re(z exp(i 2 pi (c + shift) t))

    The mirrored band lies 2 c away and is removed by h. The lower edge of the band is raised if components would end
    below 10 Hz, or fold at 0 Hz into false tones. Differences between frequencies are kept, so that beats and envelopes
    do not change. Ratios of harmonics change. The low-pass delays a narrow band by `n_late` samples, 10 to 40 ms.
    Source: D. K. Weaver, "A third method of generation and detection of single-sideband signals", Proc. IRE 44, 1956.
    """

    _WIDEST, _NARROWEST = 0.3, 0.08
    """Bounds of the transition band of h, as shares of w. Elliptic filters of order 8 to 10 reach them."""

    def __init__(self, low_hz: float, high_hz: float, shift_hz: float, sample_rate_hz: float) -> None:
        lowest_hz = max(0.0, _LOWEST_HZ - shift_hz)
        low_hz = min(max(low_hz, lowest_hz + self._NARROWEST * 0.5 * (high_hz - low_hz)), 0.99 * high_hz)
        middle_hz, width = 0.5 * (low_hz + high_hz), min(0.5 * (high_hz - low_hz), 0.45 * sample_rate_hz)
        stop = width + min(max(low_hz - lowest_hz, self._NARROWEST * width), self._WIDEST * width)
        self._down = Oscillator(middle_hz, sample_rate_hz)
        self._up = Oscillator(middle_hz + shift_hz, sample_rate_hz)
        self._sections = _steep_low_pass(width, min(stop, 0.49 * sample_rate_hz), sample_rate_hz)
        self._state = np.zeros((len(self._sections), 2, 2))
        self._position = 0
        self._slow = 2.0 * np.pi * 0.01 * width / sample_rate_hz  # [rad/sample], where the delay is as at 0 Hz

    @property
    def n_late(self) -> int:
        """Delay of the middle of the band [samples], from the phase of the low-pass at a small frequency."""
        _, (at_zero, near) = scipy.signal.sosfreqz(self._sections, [0.0, self._slow])
        return round(float(-np.angle(near / at_zero)) / self._slow)

    def run(self, x: Floats) -> Floats:
        """Return as many samples as given."""
        if x.size == 0:
            return x
        z = through_sections(self._sections, self._down.times(x, self._position), self._state)
        # `_down` stands for exp(-i...), hence the plus sign in the real part of the product.
        y = self._up.joined(z, self._position)
        self._position += len(x)
        return np.asarray(2.0 * y)


@lru_cache(maxsize=8)
def _steep_low_pass(pass_hz: float, stop_hz: float, sample_rate_hz: float) -> Floats:
    """Return an elliptic low-pass (n_sections, 6). The streams of a sound's channels share it."""
    order, _ = scipy.signal.ellipord(pass_hz, stop_hz, _RIPPLE_DB, _STOP_DB, fs=sample_rate_hz)
    return np.asarray(scipy.signal.ellip(order, _RIPPLE_DB, _STOP_DB, pass_hz, fs=sample_rate_hz, output="sos"))
