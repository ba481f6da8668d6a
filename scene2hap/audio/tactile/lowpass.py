"""Low-pass converter: all frequencies up to a cut-off, unchanged.

Butterworth, order 4: -3 dB at the cut-off, 24 dB per octave above it. Low frequencies are kept, so the actuator must be
able to render them.
"""

from __future__ import annotations

from dataclasses import dataclass

import scipy

from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile.stages import SosStage, StageStream
from scene2hap.common import checks
from scene2hap.errors import ConfigError

_HIGHEST_CUTOFF = 0.49
_ORDER = 4


@dataclass(frozen=True)
class Lowpass:
    """Keep everything below `cutoff_hz` [Hz], by a low-pass of order 4.

    Raises: ConfigError: `cutoff_hz` is not above 0; or, once the sample rate is known, above 0.49 times this rate.
    """

    cutoff_hz: float = 250.0

    def __post_init__(self) -> None:
        cutoff = checks.number("cutoff_hz", self.cutoff_hz, "Hz", above=0.0, error=ConfigError)
        object.__setattr__(self, "cutoff_hz", cutoff)

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> StageStream:
        """Start a filter at a sample rate; the context has no effect."""
        checks.number("cutoff_hz", self.cutoff_hz, "Hz", at_most=_HIGHEST_CUTOFF * sample_rate_hz, error=ConfigError)
        return StageStream(SosStage(scipy.signal.butter(_ORDER, self.cutoff_hz, fs=sample_rate_hz, output="sos")))
