"""The default converter: the adaptive band, plus roughness and onsets.

People's preference depends on the sound (Sound2Hap, CHI 2026). A hum is recognized by its frequency, an engine by its
roughness, a tick by its time. The output has two parts, a bed for the continuous sound and bursts for onsets:

- The bed goes through `adaptive`, and follows the level of the whole sound (`following`). A live stream does so with no
  latency. Its bed has the level of the whole sound, since the share of a band in it is unknown. On a resonant actuator
  the motion has this level, since no equalizer follows as in files.
- If the sound's strongest component is too low to be felt as a tone (the 49 Hz of a compressor on a phone's motor),
  that component modulates the bed (`roughness`). The bed then has a narrower band, so that it is one tone.
- If it is too high, as in a beep of 2 kHz, only its envelope is felt, on a carrier (`envelope`). A shifted band would
  lose the other notes of a melody.
- Each short onset becomes a burst (`bursts`).
- A sudden rise that is felt less clearly than it is heard is lifted (`attacks`), except in a live stream.
"""

from __future__ import annotations

from dataclasses import dataclass

from scene2hap.audio.actuator_range import CARRIER_RANGE_HZ, HIGHEST_PEAK_DB, best_carrier_hz
from scene2hap.audio.felt_component.bands import BAND_Q
from scene2hap.audio.felt_component.choice import is_beep
from scene2hap.audio.infrasound import infrasound_filter
from scene2hap.audio.levels import drive_db, sensation_level_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.second_order import high_pass
from scene2hap.audio.tactile.adaptive import Adaptive, band_around
from scene2hap.audio.tactile.attacks import EmphasizedAttacks
from scene2hap.audio.tactile.bursts import WithBursts
from scene2hap.audio.tactile.envelope import EnvelopeCarrier
from scene2hap.audio.tactile.following import HEADROOM_DB, LevelFollower
from scene2hap.audio.tactile.motion import modulation_gain, motion, played_band, ringing_s
from scene2hap.audio.tactile.roughness import DEPTH, LINE_Q, Roughened
from scene2hap.audio.tactile.stages import Chain, Scaled, SosStage, Stage, StageStream, WholeSteps

_ROOM = 0.5
"""Gain if the bed has a given level relative to the whole sound. It leaves room for bursts, and for the first harmonic
of a clipped sound, which may exceed the peak of the sound. The level of files and loops is set afterwards."""

_ROUGH_BED_Q = 5.0
"""Least Q of the bed of a source with roughness. A wider band holds harmonics of the source where the side bands of its
roughness will be. Both add up or cancel, as their phases happen to be: a side band may be felt more than the bed, and
higher peaks lower the level. A narrower band would ring for more than 40 ms at 80 Hz."""

_LIVE_DB = 0.0
"""Level of the bed of a live stream relative to the whole sound [dB]."""


@dataclass(frozen=True)
class Auto(Adaptive):
    """Convert as `adaptive`, follow the whole sound's level, and add roughness and onsets; the same settings."""

    keeps_roughness = True

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> StageStream:
        """Start a conversion at a sample rate."""
        bed = self._bed(sample_rate_hz, context)
        is_known = context.own_hz is not None  # the whole sound was analysed, so this is no live stream
        bed_db = context.band_db if is_known else _LIVE_DB
        felt_hz = (context.target_hz or context.own_hz) if is_known else None
        if felt_hz is None or not context.actuator.min_frequency_hz <= felt_hz <= context.actuator.max_frequency_hz:
            felt_hz = carrier_hz(context)
        rendered = motion(context.actuator, sample_rate_hz, is_compensated=is_known)
        if rendered is not None and context.band_q is not None:
            # A moving pitch leaves the band of a narrow actuator: there the sine stands for it.
            bed = Chain([bed, played_band(context.actuator, sample_rate_hz)])
        if rendered is not None and bed_db is not None:
            # The level of the motion is that of the whole sound.
            bed, bed_db = Chain([bed, Scaled(10 ** (-bed_db / 20))]), 0.0
        bed = LevelFollower(bed, sample_rate_hz, bed_db, felt_hz, is_live=not is_known, rendered=rendered)
        if context.rough_hz is not None:
            band, line = (band_around(context.rough_hz, q, sample_rate_hz) for q in (BAND_Q, LINE_Q))
            depth = _drive_depth(context, felt_hz, context.rough_hz)
            bed = Roughened(bed, band, line, context.rough_hz, sample_rate_hz, depth=depth)
        share_db = bed_db if is_known else None
        with_bursts = WithBursts(
            bed,
            carrier_hz(context),
            sample_rate_hz,
            bed_follows=is_known,
            bed_db=share_db,
            ringing_s=ringing_s(context.actuator) if is_known else 0.0,
        )
        parts: list[Stage] = [WholeSteps(with_bursts.step), SosStage(infrasound_filter(sample_rate_hz))]
        parts.append(EmphasizedAttacks(with_bursts, with_bursts.step) if is_known else with_bursts)
        if bed_db is None:
            return StageStream(*parts)
        return StageStream(*parts, Scaled(_ROOM if rendered is None else _ROOM * 10 ** (-HEADROOM_DB / 20)))

    def _bed(self, sample_rate_hz: int, context: ConversionContext) -> Stage:
        """Return the band of the source; of a beep, which is felt far below its own frequency, the envelope."""
        own_hz, target_hz = context.own_hz, context.target_hz
        if own_hz is not None and target_hz is not None and is_beep(own_hz, target_hz):
            # This high-pass removes hum and noise of the room, which would fill the pauses of the beep.
            above = high_pass(min(0.5 * own_hz, 0.4 * sample_rate_hz), sample_rate_hz)
            return Chain([SosStage(above), *EnvelopeCarrier().stream(sample_rate_hz, context).stages])
        q = self.q if context.rough_hz is None else max(self.q, _ROUGH_BED_Q)
        return Chain(Adaptive(q, self.shift_octaves).stream(sample_rate_hz, context).stages)


def carrier_hz(context: ConversionContext) -> float:
    """Return the frequency of bursts [Hz]: the source's target if that is in range, else the actuator's best."""
    wanted, actuator = context.target_hz or context.own_hz, context.actuator
    low_hz, high_hz = CARRIER_RANGE_HZ
    low_hz, high_hz = max(low_hz, actuator.min_frequency_hz), min(high_hz, actuator.max_frequency_hz)
    return wanted if wanted is not None and low_hz <= wanted <= high_hz else best_carrier_hz(actuator)


def _drive_depth(context: ConversionContext, felt_hz: float, rough_hz: float) -> float:
    """Return the depth of the drive's modulation, of which the actuator renders `DEPTH` [-].

    A narrow actuator renders little of a fast modulation. Its drive is modulated deeper, as far as a sine of the
    source's level leaves head-room.
    """
    level_db = sensation_level_db(context.intensity)
    spare_db = HIGHEST_PEAK_DB - float(drive_db(felt_hz, level_db, context.actuator))
    needed = DEPTH / modulation_gain(context.actuator, felt_hz, rough_hz)
    return max(DEPTH, min(needed, 10 ** (spare_db / 20) - 1.0))
