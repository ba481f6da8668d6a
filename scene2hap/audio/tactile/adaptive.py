"""Adaptive converter: a band around the source's own frequency, moved away from the scene's other sources.

A fixed band-pass keeps the same few hundred hertz of every source, so that different sounds feel alike. This converter:

1. finds the source's own frequency: the strongest component that this actuator can render at the source's level
   (`felt_component`). The context gives it if the whole sound was analysed; else it is tracked while the sound plays;
2. keeps a band around it: two trapezoidal state-variable band-passes in series (12 dB per octave). The band is narrow
   enough for the own frequency to dominate, and wide enough (f / Q at -6 dB) for the beats and irregularities of a
   machine;
3. moves that band as a whole to the target given by `spreading`, or to the nearest frequency within a third of an
   octave that is two JNDs from the neighbours.

A band that moves is cross-faded, so that a source whose pitch changes does not click.
Source: the paper's band-pass, and its outlook that the band should follow the sound (signals "felt too similar").
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scene2hap.audio.actuator_range import reachable_hz
from scene2hap.audio.felt_component import TrackedComponent
from scene2hap.audio.felt_component.bands import BAND_Q, band_gain
from scene2hap.audio.levels import sensation_level_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile.frequency_shift import ShiftStage
from scene2hap.audio.tactile.stages import Chain, InStep, SosStage, Stage, StageStream
from scene2hap.audio.tactile.svf_bandpass import SvfBandpass
from scene2hap.audio.threshold import FREQUENCY_WEBER
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.errors import ConfigError

_LOOK_S = 0.5
_RESTS_S = (0.5, 1.0, 2.0, 4.0)
"""A sound without a given frequency is analysed for half a second, which resolves 2 Hz. The pause before the next
analysis grows from 0.5 to 4 s while the frequency does not change."""
_LOOK_RATE_HZ = 8000
_FADE_S = 0.05
_MOVED = 0.25 * FREQUENCY_WEBER
"""Least change of the own frequency that moves the band: a quarter of a JND; the band's width covers smaller ones."""
_HIGHEST = 0.45
_WIDE_Q = 0.5**0.5
"""Q of the paper's band-pass, see `svf_bandpass`."""
_MOST_GAIN = 4.0
"""Largest gain, or attenuation, of a new band [-]."""
_SILENCE = 1e-4
"""Amplitude below which a stretch is silence and is not analysed (-80 dB re full scale)."""
_SHIFTED = 0.75
"""Half width of the shifted band, as a share of the own frequency; its mirror image is twice that frequency away."""


@dataclass(frozen=True)
class Adaptive:
    """Keep a band around the source's own frequency, and shift it to the source's target frequency.

    Parameters: q 0.5..20 [-] of each of the two filters; shift_octaves 0..1, how far the band may be moved if no target
    is given.
    Raises: ConfigError: outside these bounds, or a sample rate below 1 kHz.
    """

    q: float = BAND_Q
    shift_octaves: float = 1.0 / 3.0

    follows_target = True

    def __post_init__(self) -> None:
        checks.number("q", self.q, "-", at_least=0.5, at_most=20.0, error=ConfigError)
        checks.number("shift_octaves", self.shift_octaves, "-", at_least=0.0, at_most=1.0, error=ConfigError)

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> StageStream:
        """Start a conversion at a sample rate."""
        checks.number("sample_rate_hz", sample_rate_hz, "Hz", at_least=1000.0, error=ConfigError)
        if context.own_hz is not None:
            return StageStream(*self.band(sample_rate_hz, context, context.own_hz, in_step=True))
        return StageStream(_Tracking(self, sample_rate_hz, context))

    def band(
        self, sample_rate_hz: float, context: ConversionContext, own_hz: float, *, in_step: bool = False
    ) -> list[Stage]:
        """Return the band-passes for a source with this own frequency, and the frequency shift if one is needed.

        A shift delays the band. A band that is `in_step` with its sound has a latency, for which no live stream has
        time.
        """
        own_hz = min(own_hz, _HIGHEST * sample_rate_hz)
        target_hz = min(self._target_hz(context, own_hz), _HIGHEST * sample_rate_hz)
        q = min(self.q, context.band_q or self.q)
        stages: list[Stage] = [band_around(own_hz, q, sample_rate_hz)]
        if target_hz != own_hz:
            # A band that is moved far down would be too wide for the range below its target.
            half_hz = _SHIFTED * (target_hz if target_hz < own_hz / 2.0 else own_hz)
            # The mirror image of a wide band is further away, in proportion to its middle.
            high_hz = max(own_hz + half_hz, 0.5 * own_hz * (1.0 / q + (q**-2 + 4.0) ** 0.5) if context.band_q else 0.0)
            shift = ShiftStage(own_hz - half_hz, high_hz, target_hz - own_hz, sample_rate_hz)
            stages.append(shift)
            if in_step:
                return [InStep(Chain(stages), shift.n_late)]
        return stages

    def _target_hz(self, context: ConversionContext, own_hz: float) -> float:
        if context.target_hz is not None:
            return context.target_hz
        if not context.neighbours_hz or self.shift_octaves == 0.0:
            return own_hz
        level_db = sensation_level_db(context.intensity)
        low, high, _ = reachable_hz(own_hz, level_db, context.actuator, self.shift_octaves)
        return clear_of(own_hz, context.neighbours_hz, low, high)


def band_around(frequency_hz: float, q: float, sample_rate_hz: float) -> SosStage:
    """Return two state-variable band-passes in series."""
    section = SvfBandpass(frequency_hz, q).section(sample_rate_hz)
    return SosStage(np.concatenate([section, section]))


def clear_of(own_hz: float, neighbours_hz: tuple[float, ...], low_hz: float, high_hz: float) -> float:
    """Return the frequency nearest to `own_hz` within bounds that is two JNDs from all neighbours [Hz].

    If there is none, return the frequency furthest from its nearest neighbour.
    """
    x = np.sort(np.append(np.linspace(np.log(low_hz), np.log(high_hz), 129), np.log(own_hz)))
    gaps = np.abs(x[:, None] - np.log(neighbours_hz)).min(axis=1) / np.log1p(FREQUENCY_WEBER)
    moves = np.abs(x - np.log(own_hz))
    clear = gaps >= 2.0
    best = np.argmin(np.where(clear, moves, np.inf)) if clear.any() else np.argmax(gaps - 1e-9 * moves)
    return own_hz if moves[best] == 0.0 else float(np.exp(x[best]))


class _Tracking(Stage):
    """Analyses the sound in stretches of fixed length, for any block size, and moves the band with the own frequency.

    Until the end of the first stretch, the band is the paper's, around 250 Hz. A narrower band passes less of the sound
    and is amplified in proportion, so that the level does not jump.
    """

    def __init__(self, design: Adaptive, sample_rate_hz: float, context: ConversionContext) -> None:
        self._design, self._rate_hz, self._context = design, sample_rate_hz, context
        self._level_db = sensation_level_db(context.intensity)
        self._step = max(1, int(sample_rate_hz // _LOOK_RATE_HZ))
        self._seen = np.empty(round(_LOOK_S * sample_rate_hz) // self._step * self._step)
        self._n_unchanged = 0
        self._n_seen = 0  # negative during the pause before the next stretch
        self._fade = max(1, round(_FADE_S * sample_rate_hz))
        self._component = TrackedComponent(sample_rate_hz / self._step, self._level_db, context.actuator)
        self._own_hz: float | None = None
        self._band: Stage = SosStage(SvfBandpass(min(250.0, 0.4 * sample_rate_hz)).section(sample_rate_hz))
        self._gain = self._retiring_gain = 1.0
        self._retiring: Stage | None = None
        self._n_faded = 0

    def run(self, x: Floats) -> Floats:
        parts = []
        while x.size:
            n = min(len(x), len(self._seen) - self._n_seen)
            if self._retiring is not None:
                n = min(n, self._fade - self._n_faded)
            if self._n_seen < 0:
                n = min(n, -self._n_seen)
            taken, x = x[:n], x[n:]
            if self._n_seen >= 0:
                self._seen[self._n_seen : self._n_seen + n] = taken
            self._n_seen += n
            parts.append(self._filtered(taken))
            if self._n_seen == len(self._seen):
                self._analyse()
        if len(parts) == 1:
            return parts[0]
        return np.concatenate(parts) if parts else x

    def _filtered(self, x: Floats) -> Floats:
        y = self._gain * self._band.run(x)
        if self._retiring is None:
            return y
        rising = np.arange(self._n_faded + 1, self._n_faded + len(x) + 1) / self._fade
        y = rising * y + (1.0 - rising) * self._retiring_gain * self._retiring.run(x)
        self._n_faded += len(x)
        if self._n_faded == self._fade:
            self._retiring = None
        return y

    def _analyse(self) -> None:
        rest_s = _RESTS_S[min(self._n_unchanged, len(_RESTS_S) - 1)]
        self._n_seen = -round(rest_s * self._rate_hz)
        self._n_unchanged += 1
        thinned = sum(self._seen[k :: self._step] for k in range(1, self._step)) + self._seen[:: self._step]
        thinned = thinned / self._step
        if np.abs(thinned).max() < _SILENCE:
            return
        own_hz = self._component.analyse(thinned)
        if own_hz is None or (self._own_hz is not None and abs(np.log(own_hz / self._own_hz)) < np.log1p(_MOVED)):
            return
        wide = self._component.passed_power(lambda f: band_gain(f, 250.0, _WIDE_Q))
        narrow = self._component.passed_power(lambda f: band_gain(f, own_hz, self._design.q) ** 2)
        self._retiring_gain, self._gain = self._gain, float(np.clip((wide / narrow) ** 0.5, 1 / _MOST_GAIN, _MOST_GAIN))
        self._own_hz, self._n_unchanged = own_hz, 0
        self._retiring, self._n_faded = self._band, 0
        self._band = Chain(self._design.band(self._rate_hz, self._context, own_hz))
