"""The default: a band that follows the source, its roughness, and its onsets apart.

What people prefer depends on the sound (Sound2Hap, CHI 2026). A hum is known by its frequency, an engine by its
roughness, a tick by its moment.

- The bed goes through `adaptive`, and rises and falls with the whole sound (`following`) where somebody had all of it
  to look at; a live stream cannot wait that long.
- Where the sound's strongest component is too low to be felt as itself (the 49 Hz of a compressor on a phone's motor),
  the bed is modulated at that rate and by that component's own waveform r, whose envelope is e: y = bed (1 + r / 2e).
- Where it is too high, as in a beep of 2 kHz, touch follows its rise and fall alone, which go on a carrier
  (`envelope`). A band that is moved would lose the other notes of a melody.
- Each short onset becomes a burst of its own (`onsets`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import butter

from scene2hap.audio.anchor import BAND_Q, best_carrier_hz
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile.adaptive import Adaptive
from scene2hap.audio.tactile.envelope import EnvelopeCarrier
from scene2hap.audio.tactile.following import Following
from scene2hap.audio.tactile.onsets import WithOnsets
from scene2hap.audio.tactile.stages import Chain, Signal, SosStage, Stage, StageStream
from scene2hap.audio.tactile.svf_bandpass import SvfBandpass

_CARRIERS_HZ = (100.0, 300.0)
"""Where a burst of 8 ms still has a frequency, and touch is keen."""
DEPTH = 0.5
"""Of the modulation: felt as rough (the least depth that counts as a rhythm is 0.2, see `distinctness`), while side
bands stay 12 dB below the bed and do not take its place where touch is keener."""
_FROM_ABOVE = 1.5
"""Sources are moved apart by a third of an octave at most (1.26); what comes from farther above could not be felt."""
_SLOWER = 4.0
"""By which the envelope of a rough component is slower than it."""
_NOTHING = 1e-6


@dataclass(frozen=True)
class Auto(Adaptive):
    """`Adaptive`, with roughness and onsets; settings as there."""

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> StageStream:
        """A fresh conversion at that rate."""
        beep_hz = _beep_hz(context)
        if beep_hz is not None:
            # Without what is an octave below, no hum or noise of the room fills its pauses.
            above = butter(2, min(0.5 * beep_hz, 0.4 * sample_rate_hz), "highpass", fs=sample_rate_hz, output="sos")
            bed: Stage = Chain([SosStage(above), *EnvelopeCarrier().stream(sample_rate_hz, context).stages])
        else:
            bed = Chain(super().stream(sample_rate_hz, context).stages)
        if context.rough_hz is not None:
            bed = _Roughened(bed, context.rough_hz, sample_rate_hz)
        is_known = context.own_hz is not None
        if is_known:  # somebody had the whole sound to look at, so that it may wait
            bed = Following(bed, sample_rate_hz)
        return StageStream(WithOnsets(bed, carrier_hz(context), sample_rate_hz, bed_follows=is_known))


def _beep_hz(context: ConversionContext) -> float | None:
    """The own frequency of a source that is felt far below it, else None [Hz]."""
    own_hz, target_hz = context.own_hz, context.target_hz
    return own_hz if own_hz is not None and target_hz is not None and own_hz > _FROM_ABOVE * target_hz else None


def carrier_hz(context: ConversionContext) -> float:
    """Where bursts are felt: at the source's own place if that will do, else where the actuator is felt best."""
    wanted = context.target_hz or context.own_hz
    if wanted is not None and _CARRIERS_HZ[0] <= wanted <= _CARRIERS_HZ[-1]:
        return wanted
    return best_carrier_hz(context.actuator)


class _Roughened:
    """A bed that is modulated by a low component of the sound, at its own rate."""

    def __init__(self, bed: Stage, rough_hz: float, sample_rate_hz: float) -> None:
        section = SvfBandpass(rough_hz, BAND_Q).section(sample_rate_hz)
        self._bed, self._band = bed, SosStage(np.concatenate([section, section]))
        self._envelope = SosStage(butter(2, rough_hz / _SLOWER, fs=sample_rate_hz, output="sos"))

    def run(self, x: Signal) -> Signal:
        """Equally many samples."""
        low = self._band.run(x)
        envelope = np.maximum(self._envelope.run(np.abs(low)) * (0.5 * np.pi), _NOTHING)
        return np.asarray(self._bed.run(x) * (1.0 + DEPTH * np.clip(low / envelope, -1.0, 1.0)))

    def rest(self) -> Signal:
        """Nothing, as the bed below it."""
        return np.empty(0)
