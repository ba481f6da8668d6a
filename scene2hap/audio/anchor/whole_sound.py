"""The anchor of a source: the strong component of its spectrum by which it is felt.

A sound's strongest component may be so low, or so irregular, that no drive below full scale brings it to the planned
sensation level. The anchor is the strongest component of all, if it is above 60 Hz and comes within 6 dB of this level;
else the strongest that comes within 2 dB. Components are lines, which exceed the noise around them, or, in a sound
without lines, the strongest bands of noise. If no component within 14 dB of the strongest can reach the level:

- If the actuator does not render the strongest, its band is shifted to the frequency at which the actuator is felt
  best.
- If the strongest is below 60 Hz, its band is shifted there as well.
- If the strongest is higher, and would be felt more than 6 dB better there, as a beep of 900 Hz, it is shifted. So is
  the strongest of all frequencies that are heard, if the best component in the range of touch is that much weaker.
- Otherwise the component that comes nearest to the level keeps its frequency and is weaker than planned.

A strongest line of 20 to 120 Hz that is not felt at its own frequency is kept as roughness, at its rate. Below a whine
that is more than 14 dB stronger, a line below 60 Hz does not count: it is the mains in the recording, or a rumble, and
would make a clear beep rough.

If the pitch moves out of the band around the anchor, as that of an engine that revs, a band that holds the moving pitch
is used (`moving_pitch`). The same rules apply to the middle of that band. It has no roughness: nothing sounds at the
middle at most times, and the strongest line is in the band, moved or not.

The drive of a component is computed before any conversion, from the band around it that the adaptive converter keeps,
B(f) = 1 / (1 + Q^2 (f / f_0 - f_0 / f)^2). This band has a sensation level and a peak. The drive of an equally felt
sine, plus the band's peak relative to that sine ("crest"), must fit into the head-room of a loop.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, replace
from functools import lru_cache
from operator import itemgetter

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from scene2hap.audio.actuators import MAX_BOOST_DB, response_db
from scene2hap.audio.anchor.moving_pitch import MovingPitch, growth_db, moving_pitch
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.levels import drive_db, over_threshold_db, sum_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.spectra.components import (
    LINE_DB,
    Component,
    Signal,
    components,
    magnitudes,
    strongest_bands_hz,
    strongest_component,
)
from scene2hap.audio.spectra.heard import heard
from scene2hap.audio.threshold import NOTICED_DB, TACTILE_RANGE_HZ, threshold_db
from scene2hap.haptics import ActuatorProfile

BAND_Q = 2.0
"""Quality of each of two band-passes in series around the anchor [-]; see `tactile.adaptive`."""
HIGHEST_PEAK_DB = -6.5
"""Highest peak of a band [dB re full scale]: the head-room of loops (6 dB), and 0.5 dB for the difference of a loop
from the sound it is cut from."""
FAINTEST_DB = -14.0
"""Level relative to the strongest component below which a component does not identify the source. With -24 dB, most
steady test recordings were felt at a component 14-21 dB below their strongest one."""
FAINTEST_BELOW_WHINE_DB = -40.0
"""The bound `FAINTEST_DB` if the strongest component is too high to be felt: it admits a hum below a whine, but not a
recording's noise. The band around it must also be within this bound of the whole sound."""
ACCEPTED_DB = 2.0
"""Level error up to which a component is preferred to weaker ones that reach the level [dB]. Loops have up to 1 dB less
than computed here."""
ACCEPTED_OF_STRONGEST_DB = 6.0
"""The bound `ACCEPTED_DB` for the strongest component, by which a source is recognized: it is rather felt weaker."""
CARRIED_DB = 6.0
"""A component that is too high is shifted down if it is felt better there by more than this [dB]. Touch is 4 dB less
sensitive at 350 Hz than at 250, 19 dB at 500, and feels nothing at 900. A component that is too low keeps its
frequency, by which an engine is recognized."""
ROUGH_HZ = (20.0, 120.0)
"""Modulation rates that are kept as roughness [Hz]: slower ones are felt as single pulses. Above some 80 Hz a
modulation is faint, but a hum at twice the mains has no other trace on an actuator that does not play it (assumed)."""
_SLOW_HZ = 60.0
"""Highest frequency of a component that is rather felt as roughness alone than as a tone that misses its level."""
RANGE_HZ = (20.0, 1000.0)
"""Range of components that may be felt as tones [Hz]."""
_HIGHEST_HZ = 10_000.0
"""Highest frequency at which the strongest component of all is looked for [Hz]."""
CARRIER_RANGE_HZ = (100.0, 300.0)
"""Range of carriers [Hz], in which a burst of 8 ms still has a frequency, and touch is sensitive."""
_OTHER_RATIO = 1.25
"""Least ratio of the anchor to a slower component that is kept as its roughness: nearer ones are one component."""
_BEEP_RATIO = 1.5
"""Least ratio of own to felt frequency of a beep; moving sources apart gives at most 1.26, a third of an octave."""
_OVERSAMPLED = 16.0
"""Half the sample rate at which a band's peak is searched, over the band's frequency: the peak is found to 0.04 dB."""
_SMOOTHED = 4.0
"""Frequency above which the mean that bounds a band's peak has nothing, over the band's frequency."""
_GRID = 81
"""Frequencies at which `reachable_hz` looks for the limits of a move."""


@dataclass(frozen=True)
class Anchor:
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

    def within(self, context: ConversionContext, target_hz: float | None) -> ConversionContext:
        """Return a context for this source, to be felt at `target_hz` [Hz]."""
        return replace(
            context,
            own_hz=self.frequency_hz,
            target_hz=target_hz,
            rough_hz=self.rough_hz,
            band_q=self.band_q,
            band_db=self.band_db,
        )


def anchor_of(samples: ArrayLike, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile) -> Anchor | None:
    """Return the anchor of a whole sound (n_samples,) for a planned sensation level; None if it has none."""
    x = np.asarray(samples, dtype=np.float64)
    magnitude = magnitudes(x)  # of all: the flank of the high-pass would turn a slope into a peak
    audible_hz = RANGE_HZ[0], min(_HIGHEST_HZ, 0.45 * sample_rate_hz)
    loudest = strongest_component(magnitude, sample_rate_hz, audible_hz)
    if loudest is None:
        return None
    low_hz = RANGE_HZ[0], min(RANGE_HZ[1], 0.45 * sample_rate_hz)
    low = strongest_component(magnitude, sample_rate_hz, low_hz)
    if low is not None and low.hz < _SLOW_HZ and low.level_db < loudest.level_db + FAINTEST_DB:
        low = strongest_component(magnitude, sample_rate_hz, (_SLOW_HZ, low_hz[1]))
    is_heard_low = low is not None and low.level_db >= loudest.level_db + FAINTEST_BELOW_WHINE_DB
    strongest = low if low is not None and is_heard_low else loudest
    needs = _Needs(heard(x[: fast_length(len(x))], sample_rate_hz), sample_rate_hz, level_db, actuator)
    candidates: list[float] = []
    if is_heard_low:
        rendered = components(magnitude, sample_rate_hz, rendered_hz(sample_rate_hz, actuator), FAINTEST_DB)
        near = [one for one in rendered if one.level_db >= strongest.level_db + FAINTEST_DB]
        candidates = [one.hz for one in near if one.is_line]
        if not strongest.is_line:
            bands = strongest_bands_hz(magnitude, sample_rate_hz, RANGE_HZ, FAINTEST_DB)
            lowest, highest = rendered_hz(sample_rate_hz, actuator)
            candidates += [hz for hz in bands if lowest <= hz <= highest] or [one.hz for one in near]
    # A slow one is kept as the roughness of a line that reaches the level.
    identity_hz = strongest.hz if strongest.hz > _SLOW_HZ else 0.0
    found, missed_db = needs.first_met(candidates, strongest_hz=identity_hz)
    if not loudest.is_line:  # the highest peak of noise is anywhere
        bands = strongest_bands_hz(magnitude, sample_rate_hz, audible_hz, 0.0)
        loudest = loudest._replace(hz=bands[0]) if bands else loudest
    is_whine = loudest.hz > RANGE_HZ[1]
    if found is not None and is_whine and needs.band_db(found) < FAINTEST_BELOW_WHINE_DB:
        found, strongest = None, loudest  # a hiss: only its lower end is in range
    found = needs.felt(found, missed_db, strongest)
    pitch = needs.moving_pitch(found)
    if pitch is not None:
        middle = strongest._replace(hz=pitch.centre_hz, above_noise_db=LINE_DB)
        found = needs.felt(*needs.first_met([pitch.centre_hz], pitch.q), middle)
    if needs.missed_db(found) > CARRIED_DB:  # hardly felt, as the hum of a room below the call of a bird
        carried = needs.carried(loudest.hz)
        if loudest.hz > carried.felt_hz and needs.missed_db(found) - needs.missed_db(carried) > CARRIED_DB:
            found, strongest = carried, loudest
    rough_hz = _rough_hz(strongest, found) if found.band_q is None else None
    return replace(found, rough_hz=rough_hz, band_db=needs.band_db(found))


def fast_length(n: int) -> int:
    """Return the greatest length up to n that has no prime factor above 11, so that its Fourier transform is fast.

    Files have any length, and a transform of 440,989 samples takes 14 times as long as one of 441,000. From 20,000
    samples on, this shortens a sound by at most 1 %.
    """
    if n < 2:
        return n
    low = n // 2
    return low - 1 + bisect_right(range(low, n + 1), n, key=scipy.fft.next_fast_len)


def is_beep(own_hz: float, felt_hz: float) -> bool:
    """Return True if a component is so far above the frequency at which it is felt that only its envelope is kept."""
    return own_hz > _BEEP_RATIO * felt_hz


def band_of(clip: AudioClip, anchor: Anchor) -> NDArray[np.float64]:
    """Return the band that the adaptive converter keeps around a clip's anchor, shortened to `fast_length`."""
    x = clip.samples[: fast_length(len(clip.samples))].astype(np.float64)
    spectrum = scipy.fft.rfft(x - x.mean())
    f = scipy.fft.rfftfreq(len(x), 1.0 / clip.sample_rate_hz)
    spectrum *= band_gain(f, anchor.frequency_hz, anchor.band_q or BAND_Q)
    return np.asarray(scipy.fft.irfft(spectrum, len(x)), dtype=np.float64)


def rendered_hz(sample_rate_hz: float, actuator: ActuatorProfile) -> tuple[float, float]:
    """Return the range of frequencies that are both felt and rendered [Hz]."""
    low = max(RANGE_HZ[0], actuator.min_frequency_hz)
    return low, min(RANGE_HZ[1], actuator.max_frequency_hz, 0.45 * sample_rate_hz)


@lru_cache(maxsize=8)
def best_carrier_hz(actuator: ActuatorProfile) -> float:
    """Return the frequency at which the actuator is felt best, among those that suit short bursts [Hz]."""
    f = np.geomspace(*CARRIER_RANGE_HZ, 65)
    inside = f[(f >= actuator.min_frequency_hz) & (f <= actuator.max_frequency_hz)]
    among = inside if inside.size else f
    return float(among[int(np.argmax(response_db(actuator, among) - threshold_db(among)))])


def reachable_hz(
    anchor: Anchor, level_db: float, actuator: ActuatorProfile, octaves: float
) -> tuple[float, float, float]:
    """Return how far a source may be moved: lowest and highest frequency, and the gain possible at all of them [dB].

    Both frequencies [Hz] are within `octaves` of that at which the source is felt. Frequencies at which it cannot reach
    its level are left out, unless the shortfall is no larger than at the present frequency.
    """
    own_hz = anchor.felt_hz
    f: NDArray[np.float64] = own_hz * 2.0 ** np.linspace(-octaves, octaves, _GRID)
    spare_db = HIGHEST_PEAK_DB - anchor.crest_db - drive_db(f, level_db, actuator)
    in_band = (f >= actuator.min_frequency_hz) & (f <= actuator.max_frequency_hz)
    middle = _GRID // 2
    good = in_band & (spare_db >= min(0.0, float(spare_db[middle])))
    low = high = middle
    while low > 0 and good[low - 1]:
        low -= 1
    while high < _GRID - 1 and good[high + 1]:
        high += 1
    return float(f[low]), float(f[high]), max(0.0, float(spare_db[low : high + 1].min()))


class _Needs:
    """The drive that bands of a sound need for a sensation level."""

    def __init__(self, x: Signal, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile) -> None:
        self._x, self._n, self._rate_hz, self._level_db, self._actuator = x, len(x), sample_rate_hz, level_db, actuator
        self._spectrum = np.asarray(scipy.fft.rfft(x), dtype=np.complex128)
        self._spectrum /= len(x)
        self._f = scipy.fft.rfftfreq(len(x), 1.0 / sample_rate_hz)
        self._power = self._spectrum.real**2 + self._spectrum.imag**2
        # Far above the middle f_0 of a band, its energy is that of the sound times (f_0 / f)^4 / Q^4.
        self._above = np.cumsum(self._power[:0:-1] / np.square(np.square(self._f[:0:-1])))[::-1]
        low_hz, high_hz = TACTILE_RANGE_HZ
        inside = slice(np.searchsorted(self._f, low_hz), np.searchsorted(self._f, high_hz, side="right"))
        self._felt_f = self._f[inside]
        self._felt = 4.0 * self._power[inside] * 10 ** (over_threshold_db(self._felt_f, actuator) / 10)
        self._latest: tuple[tuple[float, float | None], NDArray[np.complex128], Signal] | None = None

    def first_met(
        self, candidates_hz: list[float], q: float | None = None, *, strongest_hz: float = 0.0
    ) -> tuple[Anchor | None, float]:
        """Return the first accepted candidate, or the one that is nearest to the level; and its level error [dB].

        The bands are searched for their peaks only as far as a bound of their error leaves a choice.

        Parameters: strongest_hz : the strongest component, which is accepted with a larger error, 0 for none.
        """
        best: tuple[Anchor | None, float] = None, np.inf
        beyond: list[tuple[float, float]] = []
        for own_hz in candidates_hz:
            accepted_db = ACCEPTED_OF_STRONGEST_DB if own_hz == strongest_hz else ACCEPTED_DB
            least_db = self._least_missed_db(own_hz, q)
            if least_db > accepted_db:
                beyond.append((least_db, own_hz))
                continue
            found = self._met(own_hz, q)
            if found[1] <= accepted_db:
                return found
            best = min(best, found, key=itemgetter(1))
        for least_db, own_hz in sorted(beyond):
            if least_db >= best[1]:
                break
            best = min(best, self._met(own_hz, q), key=itemgetter(1))
        return best

    def _met(self, own_hz: float, q: float | None) -> tuple[Anchor, float]:
        """Return a candidate and its level error [dB]."""
        reached_db = self._felt_db(own_hz, q) - 20 * np.log10(_peak(self._band(own_hz, q)[1]))
        crest_db = self._level_db - reached_db - float(drive_db(own_hz, self._level_db, self._actuator))
        anchor = Anchor(own_hz, crest_db, band_q=q)
        return anchor, self.missed_db(anchor)

    def _least_missed_db(self, own_hz: float, q: float | None) -> float:
        """Return a lower bound of a candidate's level error [dB], for a fraction of its cost.

        A weighted mean over time does not exceed the peak. The weights are Fejer's kernel, whose spectrum falls
        linearly to zero, so that few bins and samples suffice. For noise and ticks the bound is 1 to 4 dB too low.
        """
        end = round(max(_SMOOTHED * own_hz, TACTILE_RANGE_HZ[1]) * self._n / self._rate_hz)
        end = max(2, min(end, len(self._f) - 1))
        kept = band_gain(self._f[:end], own_hz, q or BAND_Q) * (1.0 - np.arange(end) / end)
        n = scipy.fft.next_fast_len(2 * end, real=True)
        peak = _peak(scipy.fft.irfft(self._spectrum[:end] * kept, n))
        return self._level_db - self._felt_db(own_hz, q) + 20 * float(np.log10(peak)) - HIGHEST_PEAK_DB

    def _felt_db(self, own_hz: float, q: float | None) -> float:
        """Return the sensation level of a band [dB]."""
        return sum_db(self._felt * band_gain(self._felt_f, own_hz, q or BAND_Q) ** 2)

    def felt(self, found: Anchor | None, missed_db: float, strongest: Component) -> Anchor:
        """Return the found anchor, or the strongest component at the best frequency, by the rules of this module."""
        if found is not None and missed_db <= NOTICED_DB:
            return found
        carried = self.carried(strongest.hz, None if found is None else found.band_q)
        is_slow = strongest.is_line and strongest.hz <= _SLOW_HZ
        is_rendered = found is not None and float(response_db(self._actuator, found.frequency_hz)) >= -MAX_BOOST_DB
        is_too_high = strongest.hz > carried.felt_hz and missed_db - self.missed_db(carried) > CARRIED_DB
        return carried if found is None or is_slow or not is_rendered or is_too_high else found

    def moving_pitch(self, anchor: Anchor) -> MovingPitch | None:
        """Return the band that holds the sound's pitch, if the pitch leaves the band around the anchor; else None.

        A component that is shifted down has no such band: only its rise and fall are felt, at any pitch.
        """
        if anchor.carrier_hz is not None and anchor.carrier_hz < anchor.frequency_hz:
            return None
        grown_db = self._growth_db(anchor.frequency_hz)
        if grown_db <= NOTICED_DB:
            return None
        range_hz = RANGE_HZ[0], min(RANGE_HZ[1], 0.45 * self._rate_hz)
        n = min(scipy.fft.next_fast_len(round(2.5 * range_hz[1] * self._n / self._rate_hz), real=True), self._n)
        low = scipy.fft.irfft(self._spectrum[: n // 2 + 1], n)
        pitch = moving_pitch(low, self._rate_hz * n / self._n, range_hz, BAND_Q)
        return pitch if pitch is not None and self._growth_db(*pitch) < 0.5 * grown_db else None

    def _growth_db(self, own_hz: float, q: float | None = None) -> float:
        return growth_db(self._x, self._band(own_hz, q)[1], self._n / self._rate_hz)

    def carried(self, own_hz: float, q: float | None = None) -> Anchor:
        """Return the anchor of a band that is shifted to the best frequency of the actuator; its crest stays."""
        band, signal = self._band(own_hz, q)
        rms = float(np.sqrt(2.0 * np.sum(np.abs(band) ** 2)))
        crest_db = 20.0 * float(np.log10(_peak(signal) / (np.sqrt(2.0) * rms)))
        return Anchor(own_hz, crest_db, carrier_hz=best_carrier_hz(self._actuator), band_q=q)

    def missed_db(self, anchor: Anchor) -> float:
        """Return by how much an anchor's band misses the level at the frequency at which it is felt [dB]."""
        drive = float(drive_db(anchor.felt_hz, self._level_db, self._actuator))
        return max(0.0, drive + anchor.crest_db - HIGHEST_PEAK_DB)

    def band_db(self, anchor: Anchor) -> float:
        """Return the level of the kept part of the sound, relative to the whole sound [dB].

        It is rounded: the last digits of a sum depend on the machine, and would change each sample of a loop.
        """
        own_hz, q = anchor.frequency_hz, anchor.band_q or BAND_Q
        if is_beep(own_hz, anchor.felt_hz):
            kept = 1.0 / (1.0 + (0.5 * own_hz / np.maximum(self._f, 1e-3)) ** 4)
        else:
            kept = band_gain(self._f, own_hz, q) ** 2
        return round(10.0 * float(np.log10(max(self._power @ kept, 1e-300) / max(self._power.sum(), 1e-300))), 2)

    def _band(self, own_hz: float, q: float | None = None) -> tuple[NDArray[np.complex128], Signal]:
        """Return the spectrum of a band and the band itself (n,), both divided by n. The latest one is kept."""
        if self._latest is None or self._latest[0] != (own_hz, q):
            n = min(scipy.fft.next_fast_len(2 * self._n_bins(own_hz, q or BAND_Q), real=True), self._n)
            band = self._spectrum[: n // 2 + 1] * band_gain(self._f[: n // 2 + 1], own_hz, q or BAND_Q)
            self._latest = (own_hz, q), band, scipy.fft.irfft(band, n)
        return self._latest[1:]

    def _n_bins(self, own_hz: float, q: float) -> int:
        """Return the number of bins that hold a band: all that can be felt, and all but -50 dB of its energy."""
        low, high, end = (
            min(round(f * self._n / self._rate_hz), len(self._f) - 1)
            for f in (own_hz / 2**0.5, own_hz * 2**0.5, max(_OVERSAMPLED * own_hz, TACTILE_RANGE_HZ[1]))
        )
        within = float(self._power[low : high + 1] @ band_gain(self._f[low : high + 1], own_hz, q) ** 2)
        while end < len(self._f) - 1 and (own_hz / q) ** 4 * self._above[end] > 1e-5 * within:
            end = min(2 * end, len(self._f) - 1)
        return end


def _rough_hz(strongest: Component, found: Anchor) -> float | None:
    """Return the strongest component if it is not the anchor, and slow enough to be felt as the anchor's roughness.

    However strong the anchor is: two lines of equal strength are one engine's, and its rate is that of the lower one.
    """
    low, high = ROUGH_HZ
    is_other = found.felt_hz >= strongest.hz * _OTHER_RATIO
    return strongest.hz if strongest.is_line and low <= strongest.hz <= high and is_other else None


def _peak(x: Signal) -> float:
    """Return the peak of a band (n,) that is divided by n."""
    return len(x) * float(max(x.max(), -x.min()))


def band_gain(f: NDArray[np.float64], own_hz: float, q: float) -> NDArray[np.float64]:
    """Return the gain B(f) of two band-passes in series at frequencies (n,) [Hz], 0..1 [-]."""
    r = np.maximum(f, 1e-3) / own_hz
    return np.asarray(1.0 / (1.0 + (q * (r - 1.0 / r)) ** 2))
