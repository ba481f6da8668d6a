"""The choice of the component of a sound by which its source is felt.

A sound's strongest component may be so low, or so irregular, that no drive below full scale brings it to the planned
sensation level. The component that is chosen is the strongest of all, if it is above 60 Hz and comes within 6 dB of
this level; else the strongest that comes within 2 dB. Components are lines, which exceed the noise around them, or, in
a sound without lines, the strongest bands of noise. If no component within 14 dB of the strongest can reach the level:

- If the actuator does not render the strongest, its band is shifted to the frequency at which the actuator is felt
  best.
- If the strongest is below 60 Hz, its band is shifted there as well.
- If the strongest is higher, and would be felt more than 6 dB better there, as a beep of 900 Hz, it is shifted. So is
  the strongest of all frequencies that are heard, if the best component in the range of touch is that much weaker.
- Otherwise the component that comes nearest to the level keeps its frequency and is weaker than planned.

A strongest line of 20 to 120 Hz that is not felt at its own frequency is kept as roughness, at its rate. Below a whine
that is more than 14 dB stronger, a line below 60 Hz does not count: it is the mains in the recording, or a rumble, and
would make a clear beep rough.

If the pitch moves out of the band around the component, as that of an engine that revs, a band that holds the moving
pitch is used (`moving_pitch`). The same rules apply to the middle of that band. It has no roughness: nothing sounds at
the middle at most times, and the strongest line is in the band, moved or not.

The drive of a component is computed before any conversion, from the band around it that the adaptive converter keeps
(`bands`). This band has a sensation level and a peak. The drive of an equally felt sine, plus the band's peak relative
to that sine ("crest"), must fit into the head-room of a loop.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from operator import itemgetter

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.audio.actuator_range import HIGHEST_PEAK_DB, TONES_HZ, best_carrier_hz, rendered_hz
from scene2hap.audio.actuators import MAX_BOOST_DB, response_db
from scene2hap.audio.felt_component.bands import BAND_Q, SoundBands, band_gain, fast_length
from scene2hap.audio.felt_component.moving_pitch import MovingPitch, moving_pitch
from scene2hap.audio.infrasound import without_infrasound
from scene2hap.audio.levels import drive_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.spectra.components import (
    LINE_DB,
    Component,
    components,
    magnitudes,
    strongest_bands_hz,
    strongest_component,
)
from scene2hap.audio.threshold import NOTICED_DB
from scene2hap.common.arrays import Floats
from scene2hap.haptics import ActuatorProfile

FAINTEST_DB = -14.0
"""Level relative to the strongest component below which a component does not identify the source. With -24 dB, most
steady test recordings were felt at a component 14-21 dB below their strongest one."""
_FAINTEST_BELOW_WHINE_DB = -40.0
"""The bound `FAINTEST_DB` if the strongest component is too high to be felt: it admits a hum below a whine, but not a
recording's noise. The band around it must also be within this bound of the whole sound."""
_ACCEPTED_DB = 2.0
"""Shortfall up to which a component is preferred to weaker ones that reach the level [dB]. Loops have up to 1 dB less
than computed here."""
_ACCEPTED_OF_STRONGEST_DB = 6.0
"""The bound `_ACCEPTED_DB` for the strongest component, by which a source is recognized: it is rather felt weaker."""
_WORTH_A_SHIFT_DB = 6.0
"""A component that is too high is shifted down if it is felt better there by more than this [dB]. Touch is 4 dB less
sensitive at 350 Hz than at 250, 19 dB at 500, and feels nothing at 900. A component that is too low keeps its
frequency, by which an engine is recognized."""
_ROUGH_HZ = (20.0, 120.0)
"""Modulation rates that are kept as roughness [Hz]: slower ones are felt as single pulses. Above some 80 Hz a
modulation is faint, but a hum at twice the mains has no other trace on an actuator that does not play it (assumed)."""
_SLOW_HZ = 60.0
"""Highest frequency of a component that is rather felt as roughness alone than as a tone that misses its level."""
_HIGHEST_HZ = 10_000.0
"""Highest frequency at which the strongest component of all is looked for [Hz]."""
_OTHER_RATIO = 1.25
"""Least ratio of the felt component to a slower one that is kept as its roughness: nearer ones are one component."""
_BEEP_RATIO = 1.5
"""Least ratio of own to felt frequency of a beep; moving sources apart gives at most 1.26, a third of an octave."""


@dataclass(frozen=True)
class FeltComponent:
    """A source's own frequency [Hz], and the peak of its band relative to that of an equally felt sine [dB].

    rough_hz : the strongest component of the sound, if it is too low for a tone and is kept as roughness, else None
    [Hz]; carrier_hz : the frequency to which the band is shifted, if it cannot be felt at its own, else None [Hz];
    band_q : Q of a band that holds a moving pitch, `frequency_hz` in its middle; None for `BAND_Q` [-]; band_db : level
    of the band relative to the whole sound, None if unknown [dB]. The band of a beep begins at half its frequency.
    """

    frequency_hz: float
    crest_db: float = 0.0
    rough_hz: float | None = None
    carrier_hz: float | None = None
    band_q: float | None = None
    band_db: float | None = None

    @property
    def felt_hz(self) -> float:
        """The frequency at which the source is felt, before sources are moved apart [Hz]."""
        return self.carrier_hz or self.frequency_hz

    @property
    def q(self) -> float:
        """Q of each of the two band-passes around the component [-]."""
        return self.band_q or BAND_Q

    def added_to(self, context: ConversionContext, target_hz: float | None) -> ConversionContext:
        """Return a context with this component, to be felt at `target_hz` [Hz]."""
        return replace(
            context,
            own_hz=self.frequency_hz,
            target_hz=target_hz,
            rough_hz=self.rough_hz,
            band_q=self.band_q,
            band_db=self.band_db,
        )


def felt_component_of(
    samples: ArrayLike, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile
) -> FeltComponent | None:
    """Return the felt component of a whole sound (n_samples,) for a planned sensation level; None if it has none."""
    x = np.asarray(samples, dtype=np.float64)
    magnitude = magnitudes(x)  # of all: the flank of the high-pass would turn a slope into a peak
    audible_hz = TONES_HZ[0], min(_HIGHEST_HZ, 0.45 * sample_rate_hz)
    loudest = strongest_component(magnitude, sample_rate_hz, audible_hz)
    if loudest is None:
        return None
    low = _strongest_in_reach(magnitude, sample_rate_hz, loudest)
    strongest = loudest if low is None else low
    candidates_hz = [] if low is None else _candidates_hz(magnitude, sample_rate_hz, low, actuator)
    bands = SoundBands(without_infrasound(x[: fast_length(len(x))], sample_rate_hz), sample_rate_hz, actuator)
    drives = _Drives(bands, sample_rate_hz, level_db, actuator)
    # A slow one is kept as the roughness of a line that reaches the level.
    identity_hz = strongest.hz if strongest.hz > _SLOW_HZ else 0.0
    found, shortfall_db = drives.first_accepted(candidates_hz, strongest_hz=identity_hz)
    if not loudest.is_line:  # the highest peak of noise is anywhere
        centres_hz = strongest_bands_hz(magnitude, sample_rate_hz, audible_hz, 0.0)
        loudest = loudest._replace(hz=centres_hz[0]) if centres_hz else loudest
    is_whine = loudest.hz > TONES_HZ[1]
    if found is not None and is_whine and drives.band_db(found) < _FAINTEST_BELOW_WHINE_DB:
        found, strongest = None, loudest  # a hiss: only its lower end is in range
    found = drives.unshifted_or_shifted(found, shortfall_db, strongest)
    pitch = drives.moving_pitch(found)
    if pitch is not None:
        middle = strongest._replace(hz=pitch.centre_hz, above_noise_db=LINE_DB)
        found = drives.unshifted_or_shifted(*drives.first_accepted([pitch.centre_hz], pitch.q), middle)
    if drives.shortfall_db(found) > _WORTH_A_SHIFT_DB:  # hardly felt, as the hum of a room below the call of a bird
        shifted = drives.shifted(loudest.hz)
        gained_db = drives.shortfall_db(found) - drives.shortfall_db(shifted)
        if loudest.hz > shifted.felt_hz and gained_db > _WORTH_A_SHIFT_DB:
            found, strongest = shifted, loudest
    rough_hz = _rough_hz(strongest, found) if found.band_q is None else None
    return replace(found, rough_hz=rough_hz, band_db=drives.band_db(found))


def is_beep(own_hz: float, felt_hz: float) -> bool:
    """Return True if a component is so far above the frequency at which it is felt that only its envelope is kept."""
    return own_hz > _BEEP_RATIO * felt_hz


def _strongest_in_reach(magnitude: Floats, sample_rate_hz: float, loudest: Component) -> Component | None:
    """Return the strongest component in the range of touch; None if it is lost below the loudest of all."""
    low_hz = TONES_HZ[0], min(TONES_HZ[1], 0.45 * sample_rate_hz)
    low = strongest_component(magnitude, sample_rate_hz, low_hz)
    if low is not None and low.hz < _SLOW_HZ and low.level_db < loudest.level_db + FAINTEST_DB:
        low = strongest_component(magnitude, sample_rate_hz, (_SLOW_HZ, low_hz[1]))
    return low if low is not None and low.level_db >= loudest.level_db + _FAINTEST_BELOW_WHINE_DB else None


def _candidates_hz(
    magnitude: Floats, sample_rate_hz: float, strongest: Component, actuator: ActuatorProfile
) -> list[float]:
    """Return the lines that the actuator renders, strongest first [Hz]; of a sound without lines, also its bands."""
    lowest, highest = rendered_hz(sample_rate_hz, actuator)
    rendered = components(magnitude, sample_rate_hz, (lowest, highest), FAINTEST_DB)
    near = [one for one in rendered if one.level_db >= strongest.level_db + FAINTEST_DB]
    lines = [one.hz for one in near if one.is_line]
    if strongest.is_line:
        return lines
    bands = strongest_bands_hz(magnitude, sample_rate_hz, TONES_HZ, FAINTEST_DB)
    return lines + ([hz for hz in bands if lowest <= hz <= highest] or [one.hz for one in near])


def _rough_hz(strongest: Component, found: FeltComponent) -> float | None:
    """Return the strongest component if it is not the felt one, and slow enough to be felt as roughness of the latter.

    However strong the felt one is: two lines of equal strength are one engine's, and its rate is that of the lower one.
    """
    low, high = _ROUGH_HZ
    is_other = found.felt_hz >= strongest.hz * _OTHER_RATIO
    return strongest.hz if strongest.is_line and low <= strongest.hz <= high and is_other else None


class _Drives:
    """The drives that bands of a sound need for a sensation level, compared with the head-room of a loop."""

    def __init__(self, bands: SoundBands, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile) -> None:
        self._bands, self._rate_hz, self._level_db, self._actuator = bands, sample_rate_hz, level_db, actuator

    def first_accepted(
        self, candidates_hz: list[float], q: float | None = None, *, strongest_hz: float = 0.0
    ) -> tuple[FeltComponent | None, float]:
        """Return the first accepted candidate, or the one that is nearest to the level; and its shortfall [dB].

        The bands are searched for their peaks only as far as a bound of their shortfall leaves a choice.

        Parameters: strongest_hz : the strongest component, which is accepted with a larger shortfall, 0 for none.
        """
        best: tuple[FeltComponent | None, float] = None, np.inf
        beyond: list[tuple[float, float]] = []
        for own_hz in candidates_hz:
            accepted_db = _ACCEPTED_OF_STRONGEST_DB if own_hz == strongest_hz else _ACCEPTED_DB
            least_db = self._least_shortfall_db(own_hz, q or BAND_Q)
            if least_db > accepted_db:
                beyond.append((least_db, own_hz))
                continue
            found = self._candidate(own_hz, q)
            if found[1] <= accepted_db:
                return found
            best = min(best, found, key=itemgetter(1))
        for least_db, own_hz in sorted(beyond):
            if least_db >= best[1]:
                break
            best = min(best, self._candidate(own_hz, q), key=itemgetter(1))
        return best

    def unshifted_or_shifted(
        self, found: FeltComponent | None, shortfall_db: float, strongest: Component
    ) -> FeltComponent:
        """Return the found component, or the strongest one shifted to the best frequency, by the rules of this
        module."""
        if found is not None and shortfall_db <= NOTICED_DB:
            return found
        shifted = self.shifted(strongest.hz, None if found is None else found.band_q)
        is_slow = strongest.is_line and strongest.hz <= _SLOW_HZ
        is_rendered = found is not None and float(response_db(self._actuator, found.frequency_hz)) >= -MAX_BOOST_DB
        gained_db = shortfall_db - self.shortfall_db(shifted)
        is_too_high = strongest.hz > shifted.felt_hz and gained_db > _WORTH_A_SHIFT_DB
        return shifted if found is None or is_slow or not is_rendered or is_too_high else found

    def moving_pitch(self, found: FeltComponent) -> MovingPitch | None:
        """Return the band that holds the sound's pitch, if the pitch leaves the band around the component; else None.

        A component that is shifted down has no such band: only its rise and fall are felt, at any pitch.
        """
        if found.carrier_hz is not None and found.carrier_hz < found.frequency_hz:
            return None
        grown_db = self._bands.growth_db(found.frequency_hz, BAND_Q)
        if grown_db <= NOTICED_DB:
            return None
        range_hz = TONES_HZ[0], min(TONES_HZ[1], 0.45 * self._rate_hz)
        pitch = moving_pitch(*self._bands.low_passed(range_hz[1]), range_hz, BAND_Q)
        return pitch if pitch is not None and self._bands.growth_db(*pitch) < 0.5 * grown_db else None

    def shifted(self, own_hz: float, q: float | None = None) -> FeltComponent:
        """Return a band that is shifted to the best frequency of the actuator; its crest stays."""
        crest_db = self._bands.crest_db(own_hz, q or BAND_Q)
        return FeltComponent(own_hz, crest_db, carrier_hz=best_carrier_hz(self._actuator), band_q=q)

    def shortfall_db(self, found: FeltComponent) -> float:
        """Return by how much a component's band misses the level at the frequency at which it is felt [dB]."""
        drive = float(drive_db(found.felt_hz, self._level_db, self._actuator))
        return max(0.0, drive + found.crest_db - HIGHEST_PEAK_DB)

    def band_db(self, found: FeltComponent) -> float:
        """Return the level of the kept part of the sound, relative to the whole sound [dB]."""
        own_hz, q = found.frequency_hz, found.q
        if is_beep(own_hz, found.felt_hz):  # the converter keeps all that a high-pass at half its frequency keeps
            return self._bands.share_db(lambda f: 1.0 / (1.0 + (0.5 * own_hz / np.maximum(f, 1e-3)) ** 4))
        return self._bands.share_db(lambda f: band_gain(f, own_hz, q) ** 2)

    def _candidate(self, own_hz: float, q: float | None) -> tuple[FeltComponent, float]:
        """Return a candidate and its shortfall [dB]."""
        at = own_hz, q or BAND_Q
        reached_db = self._bands.sensation_level_db(*at) - 20 * np.log10(self._bands.peak(*at))
        crest_db = self._level_db - reached_db - float(drive_db(own_hz, self._level_db, self._actuator))
        found = FeltComponent(own_hz, crest_db, band_q=q)
        return found, self.shortfall_db(found)

    def _least_shortfall_db(self, own_hz: float, q: float) -> float:
        """Return a lower bound of a candidate's shortfall [dB], for a fraction of its cost."""
        felt_db, peak = self._bands.sensation_level_db(own_hz, q), self._bands.least_peak(own_hz, q)
        return self._level_db - felt_db + 20 * float(np.log10(peak)) - HIGHEST_PEAK_DB
