"""Frequency shift: move a band of sound down to frequencies that the skin feels.

For sounds above the range of touch: beeps, whines, glass. The band is shifted by a fixed number of hertz
(`ShiftStage`), so that its envelope and its beats do not change.
Source: Okazaki, Kajimoto and Hayward 2012/2015 move audio into the tactile range in this way; Merchel and Altinsoy
recommend it with compression. Differs: they divide frequencies by powers of two, which keeps harmonic ratios but needs
a pitch. A shift by hertz needs no pitch and works on noise as well.
"""

from __future__ import annotations

from dataclasses import dataclass

from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile.stages import LOWEST_FELT_HZ, ShiftStage, StageStream
from scene2hap.common import checks
from scene2hap.errors import ConfigError


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
            at_least=LOWEST_FELT_HZ - low,
            error=ConfigError,
            hint="Raise low_hz, or shift by less: below 10 Hz nothing is felt and the band would fold over.",
        )

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> StageStream:
        """Start a conversion at a sample rate."""
        highest = 0.45 * sample_rate_hz
        checks.number("low_hz", self.low_hz, "Hz", below=highest, error=ConfigError, hint="Use a higher sample rate.")
        high = min(self.high_hz, highest)
        return StageStream(ShiftStage(self.low_hz, high, self.shift_hz, sample_rate_hz))
