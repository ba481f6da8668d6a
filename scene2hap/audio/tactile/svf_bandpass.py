"""The paper's converter: a state-variable band-pass around the frequency to which the skin is most sensitive.

Pacinian corpuscles detect best near 250 Hz; frequencies far from it are dropped.

It is the band-pass of `second_order`. Differs: the paper used Max/MSP's svf~ (Chamberlin's form, which becomes unstable
near a sixth of the sample rate) at a resonance that the paper does not state.
"""

from __future__ import annotations

from dataclasses import dataclass

from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.second_order import band_pass
from scene2hap.audio.tactile.stages import SosStage, StageStream
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
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

    def section(self, sample_rate_hz: float) -> Floats:
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
        return band_pass(self.center_hz, self.q, rate)
