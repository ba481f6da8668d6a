"""Envelope converter: the envelope of a sound on a carrier that the actuator renders well.

    e = h * |x| pi / 2        y = e sin(2 pi f_c t)

h is a Butterworth low-pass of order 2; pi / 2 makes e the amplitude of a sine. The rhythm is kept, the pitch is lost.
The converter suits narrow-band actuators (LRA), clicks and speech-like sounds. Different carriers keep sources apart.
Source: common practice in vibrotactile displays of sound; at the carrier of 250 Hz, the skin is most sensitive
(Verrillo 1963).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.second_order import low_pass
from scene2hap.audio.tactile.oscillator import Oscillator
from scene2hap.audio.tactile.stages import SosStage, Stage, StageStream
from scene2hap.audio.threshold import TACTILE_RANGE_HZ
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.errors import ConfigError

BEST_FELT_HZ = 250.0


@dataclass(frozen=True)
class EnvelopeCarrier:
    """Modulate a carrier by the sound's envelope up to `envelope_hz`.

    `carrier_hz` None takes the target frequency of the context, else the actuator's resonance, else 250 Hz.
    Raises: ConfigError: `carrier_hz` is outside the 10 to 1000 Hz that touch feels, or `envelope_hz` is not above 0;
    or, once the sample rate is known, one is above 0.49 times this rate.
    """

    carrier_hz: float | None = None
    envelope_hz: float = 40.0

    def __post_init__(self) -> None:
        checks.number("envelope_hz", self.envelope_hz, "Hz", above=0.0, error=ConfigError)
        if self.carrier_hz is not None:
            low, high = TACTILE_RANGE_HZ
            checks.number("carrier_hz", self.carrier_hz, "Hz", at_least=low, at_most=high, error=ConfigError)

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> StageStream:
        """Start a conversion at a sample rate."""
        wanted = self.carrier_hz or context.target_hz or context.actuator.resonance_hz or BEST_FELT_HZ
        for name, frequency in (("carrier_hz", wanted), ("envelope_hz", self.envelope_hz)):
            checks.number(name, frequency, "Hz", at_most=0.49 * sample_rate_hz, error=ConfigError)
        return StageStream(_EnvelopeStage(wanted, self.envelope_hz, sample_rate_hz))


class _EnvelopeStage(Stage):
    def __init__(self, carrier_hz: float, envelope_hz: float, sample_rate_hz: float) -> None:
        self._smooth = SosStage(low_pass(envelope_hz, sample_rate_hz))
        self._carrier = Oscillator(carrier_hz, sample_rate_hz)
        self._position = 0

    def run(self, x: Floats) -> Floats:
        # A Butterworth filter overshoots, and a negative envelope would invert the carrier's phase.
        envelope = np.maximum(self._smooth.run(np.abs(x)) * (0.5 * math.pi), 0.0)
        y: Floats = self._carrier.times(envelope, self._position)[1]
        self._position += len(x)
        return y
