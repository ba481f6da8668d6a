"""The paper's converter: a state-variable band-pass around the frequency to which the skin is most sensitive.

Pacinian corpuscles detect best near 250 Hz; frequencies far from it are dropped.

    g = tan(pi f_c / f_s)   warped centre frequency [-]         k = 1 / Q   damping [-]
    H(z) = g k (1 - z^-2) / (1 + g k + g^2 + 2 (g^2 - 1) z^-1 + (1 - g k + g^2) z^-2)

This is the trapezoidal (TPT) state-variable filter. Its band-pass output is multiplied by k, for 0 dB at f_c. It is
written as one biquad, since a biquad runs in compiled code. While centre and Q are constant, both are the same filter.

Source: A. Simper, "Linear trapezoidal state variable filter" (Cytomic, 2013); R. Bristow-Johnson, "Audio EQ cookbook",
band-pass with constant 0 dB peak gain. Differs: the paper used Max/MSP's svf~ (Chamberlin's form, which becomes
unstable near a sixth of the sample rate) at a resonance that the paper does not state.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile.stages import SosStage, StageStream
from scene2hap.common import checks
from scene2hap.errors import ConfigError

_HIGHEST_CENTER = 0.49
"""Highest centre, as a share of the sample rate; at one half the warped frequency g is infinite."""


@dataclass(frozen=True)
class SvfBandpass:
    """Filter by a state-variable band-pass of second order at `center_hz`, the paper's conversion.

    0 dB at `center_hz`, 6 dB per octave on both sides, zero at 0 Hz and at half the sample rate.

    Parameters: center_hz > 0; q 0.1..100 [-], the bandwidth at -3 dB is center_hz / q. The default of 0.707 passes 129
    to 483 Hz; assumed, since the paper does not state its resonance.
    Raises: ConfigError: outside these bounds, or, once the sample rate is known, a centre above 0.49 times this rate.
    """

    center_hz: float = 250.0
    q: float = 0.707

    def __post_init__(self) -> None:
        center = checks.number("center_hz", self.center_hz, "Hz", above=0.0, error=ConfigError)
        q = checks.number("q", self.q, "-", at_least=0.1, at_most=100.0, error=ConfigError)
        object.__setattr__(self, "center_hz", center)
        object.__setattr__(self, "q", q)

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> StageStream:
        """Start a filter at a sample rate; the context has no effect."""
        return StageStream(SosStage(self.section(sample_rate_hz)))

    def section(self, sample_rate_hz: float) -> NDArray[np.float64]:
        """Return the filter as one second-order section (1, 6): b0 b1 b2 a0 a1 a2."""
        rate = checks.number("sample_rate_hz", sample_rate_hz, "Hz", above=0.0, error=ConfigError)
        checks.number(
            "center_hz",
            self.center_hz,
            "Hz",
            at_most=_HIGHEST_CENTER * rate,
            error=ConfigError,
            hint=f"At {rate:g} Hz choose a lower centre, or bring the sound to a higher rate.",
        )
        g = math.tan(math.pi * self.center_hz / rate)
        k = 1.0 / self.q
        a0 = 1.0 + g * k + g * g
        return np.array([[g * k, 0.0, -g * k, a0, 2.0 * (g * g - 1.0), 1.0 - g * k + g * g]]) / a0
