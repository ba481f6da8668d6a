"""The frequency that stands for a source: where its own spectrum is strong and touch can be reached.

A sound's strongest component may lie so low, or be so uneven, that no drive below full scale makes it felt at the
level that its intensity asks for. The anchor is the strongest one that can. Components are lines, which stand out of
the noise around them; a sound without lines has its strongest bands of noise instead. If no component within 14 dB of
the strongest can be felt at that level:

- the actuator does not render the strongest: its band is moved as a whole to where the actuator is felt best;
- the strongest is slower than 60 Hz: its band is moved as well, and its rate is kept as roughness;
- the strongest is higher than that and would be felt better there by more than 6 dB, as a beep of 900 Hz: it is moved;
- else the component that comes nearest to the level is felt as itself, weaker than asked.

What a component needs is known before anything is converted: a band around it, of the shape that the adaptive
converter keeps, B(f) = 1 / (1 + Q^2 (f / f_0 - f_0 / f)^2), has a sensation level and a peak; the drive of a sine that
is felt as strongly, and what the peak exceeds it by ("crest"), must stay below the head-room of a loop together.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.fft
from numpy.typing import ArrayLike, NDArray

from scene2hap.audio.actuators import MAX_BOOST_DB, response_db
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.components import Component, Signal, components, magnitudes, strongest_bands_hz
from scene2hap.audio.levels import TACTILE_RANGE_HZ, drive_db, felt_level_of_spectrum_db, threshold_db
from scene2hap.haptics import ActuatorProfile

BAND_Q = 2.0
"""Quality of each of two band-passes in series around the anchor [-]; see `tactile.adaptive`."""
HIGHEST_PEAK_DB = -6.5
"""Below full scale less the head-room of loops (6 dB) by what a loop differs from the sound it is cut from [dB]."""
FAINTEST_DB = -14.0
"""Components this far below the strongest are not what the source is known by; better it is felt weaker. At 24 dB, most
steady recordings at hand were felt as something 14-21 dB below what they sound like."""
FAINTEST_BELOW_WHINE_DB = -40.0
"""The same below what is too high to be felt: a hum is felt as itself under a whine, a recording's noise is not."""
MISSED_DB = 3.0
"""A component that misses its level by more cannot be felt as asked; about what is felt as a difference."""
CARRIED_DB = 6.0
"""What is too high is moved down if it is felt better by more there. Touch is 4 dB less keen at 350 Hz than at 250 and
19 at 500, and feels nothing of 900. What is too low keeps its frequency, by which an engine is known."""
ROUGH_HZ = (20.0, 60.0)
"""Rates of modulation that are felt as roughness, not one by one and not as another tone."""
RANGE_HZ = (20.0, 1000.0)
_HIGHEST_HZ = 10_000.0
_CARRIERS_HZ = np.geomspace(100.0, 300.0, 65)
"""Where a burst of 8 ms still has a frequency, and touch is keen."""
_OTHER_RATIO = 1.25
_OVERSAMPLED = 16.0
"""Half the rate at which a band's peak is looked for, over its frequency: it is found to 0.04 dB."""
_GRID = 81


@dataclass(frozen=True)
class Anchor:
    """A source's own frequency [Hz], and what its band's peak exceeds that of an equally felt sine by [dB].

    rough_hz : the strongest component of the sound, where that is too low to be felt as itself and is to be kept as
    roughness, else None [Hz]; carrier_hz : where the band is felt that cannot be felt where it is, else None [Hz].
    """

    frequency_hz: float
    crest_db: float = 0.0
    rough_hz: float | None = None
    carrier_hz: float | None = None

    @property
    def felt_hz(self) -> float:
        """Where it is felt before sources are moved apart [Hz]."""
        return self.carrier_hz or self.frequency_hz


def anchor_of(samples: ArrayLike, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile) -> Anchor | None:
    """The anchor of a whole sound (n_samples,) that is to be felt at a sensation level; None where there is none."""
    x = np.asarray(samples, dtype=np.float64)
    magnitude = magnitudes(x)
    heard = components(magnitude, sample_rate_hz, (RANGE_HZ[0], min(_HIGHEST_HZ, 0.45 * sample_rate_hz)), -300.0)
    if not heard:
        return None
    low = components(magnitude, sample_rate_hz, (RANGE_HZ[0], min(RANGE_HZ[1], 0.45 * sample_rate_hz)), FAINTEST_DB)
    is_heard_low = bool(low) and low[0].level_db >= heard[0].level_db + FAINTEST_BELOW_WHINE_DB
    strongest = low[0] if is_heard_low else heard[0]
    needs = _Needs(x, sample_rate_hz, level_db, actuator)
    candidates: list[float] = []
    if is_heard_low:
        rendered = components(magnitude, sample_rate_hz, rendered_hz(sample_rate_hz, actuator), FAINTEST_DB)
        near = [one for one in rendered if one.level_db >= strongest.level_db + FAINTEST_DB]
        candidates = [one.hz for one in near if one.is_line]
        if not strongest.is_line:
            bands = strongest_bands_hz(magnitude, sample_rate_hz, RANGE_HZ, FAINTEST_DB)
            lowest, highest = rendered_hz(sample_rate_hz, actuator)
            candidates += [hz for hz in bands if lowest <= hz <= highest] or [one.hz for one in near]
    found, missed_db = needs.first_met(candidates)
    is_whine = heard[0].hz > RANGE_HZ[1]
    if found is not None and is_whine and needs.above_db(found.frequency_hz, heard[0].hz) < FAINTEST_BELOW_WHINE_DB:
        found, strongest = None, heard[0]  # of a hiss, what is left at its lower end
    if found is None or missed_db > MISSED_DB:
        carried = needs.carried(strongest.hz)
        is_slow = strongest.is_line and strongest.hz <= ROUGH_HZ[1]
        is_rendered = found is not None and float(response_db(actuator, found.frequency_hz)) >= -MAX_BOOST_DB
        is_too_high = strongest.hz > carried.felt_hz and missed_db - needs.missed_db(carried) > CARRIED_DB
        if found is None or is_slow or not is_rendered or is_too_high:
            found = carried
    return replace(found, rough_hz=_rough_hz(strongest, found, magnitude, sample_rate_hz))


def band_of(clip: AudioClip, anchor: Anchor) -> NDArray[np.float64]:
    """What the adaptive converter keeps of a clip around its anchor (n_samples,)."""
    x = clip.samples.astype(np.float64)
    spectrum = scipy.fft.rfft(x - x.mean())
    spectrum *= _band(scipy.fft.rfftfreq(len(x), 1.0 / clip.sample_rate_hz), anchor.frequency_hz)
    return np.asarray(scipy.fft.irfft(spectrum, len(x)), dtype=np.float64)


def rendered_hz(sample_rate_hz: float, actuator: ActuatorProfile) -> tuple[float, float]:
    """The range of what is both felt and rendered [Hz]."""
    low = max(RANGE_HZ[0], actuator.min_frequency_hz)
    return low, min(RANGE_HZ[1], actuator.max_frequency_hz, 0.45 * sample_rate_hz)


def best_carrier_hz(actuator: ActuatorProfile) -> float:
    """Where the actuator is felt best, of what also carries a short burst [Hz]."""
    f = _CARRIERS_HZ
    inside = f[(f >= actuator.min_frequency_hz) & (f <= actuator.max_frequency_hz)]
    among = inside if inside.size else f
    return float(among[int(np.argmax(response_db(actuator, among) - threshold_db(among)))])


def reachable_hz(
    anchor: Anchor, level_db: float, actuator: ActuatorProfile, octaves: float
) -> tuple[float, float, float]:
    """How far a source may be moved: lowest and highest frequency [Hz], and how much louder it may be all the way [dB].

    Both lie within `octaves` of where it is felt; further than its level can be reached only if that was so before.
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
    """What bands of a sound need to be felt at a level."""

    def __init__(self, x: Signal, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile) -> None:
        self._n, self._rate_hz, self._level_db, self._actuator = len(x), sample_rate_hz, level_db, actuator
        self._spectrum = np.asarray(scipy.fft.rfft(x - x.mean()), dtype=np.complex128) / len(x)
        self._f = scipy.fft.rfftfreq(len(x), 1.0 / sample_rate_hz)
        self._power = self._spectrum.real**2 + self._spectrum.imag**2
        # Far above its middle f_0 the energy of a band is that of the sound times (f_0 / f)^4 / Q^4.
        self._above = np.cumsum(self._power[:0:-1] / self._f[:0:-1] ** 4)[::-1]

    def first_met(self, candidates_hz: list[float]) -> tuple[Anchor | None, float]:
        """The first that can be felt at the level, or the one that comes nearest, and what it misses [dB]."""
        best: tuple[Anchor | None, float] = None, np.inf
        for own_hz in candidates_hz:
            band, n, peak = self._band(own_hz)
            rate_hz = self._rate_hz * n / self._n
            reached_db = felt_level_of_spectrum_db(n * band, n, rate_hz, self._actuator) - 20 * np.log10(peak)
            crest_db = self._level_db - reached_db - float(drive_db(own_hz, self._level_db, self._actuator))
            anchor = Anchor(own_hz, crest_db)
            missed_db = self.missed_db(anchor)
            if missed_db < best[1]:
                best = anchor, missed_db
            if missed_db == 0.0:
                break
        return best

    def carried(self, own_hz: float) -> Anchor:
        """A band that is to be moved to where the actuator is felt best; its crest stays."""
        band, _, peak = self._band(own_hz)
        rms = float(np.sqrt(2.0 * np.sum(np.abs(band) ** 2)))
        crest_db = 20.0 * float(np.log10(peak / (np.sqrt(2.0) * rms)))
        return Anchor(own_hz, crest_db, carrier_hz=best_carrier_hz(self._actuator))

    def missed_db(self, anchor: Anchor) -> float:
        """What an anchor's band misses where it is felt [dB]."""
        drive = float(drive_db(anchor.felt_hz, self._level_db, self._actuator))
        return max(0.0, drive + anchor.crest_db - HIGHEST_PEAK_DB)

    def above_db(self, one_hz: float, other_hz: float) -> float:
        """By how much more energy a band has than another [dB]."""
        one, other = (float(np.sum(np.abs(self._band(hz)[0]) ** 2)) for hz in (one_hz, other_hz))
        return 10.0 * float(np.log10(max(one, 1e-300) / max(other, 1e-300)))

    def _band(self, own_hz: float) -> tuple[NDArray[np.complex128], int, float]:
        """The spectrum of a band over its number of samples, that number, and its peak.

        Sampled no more often than its peak needs.
        """
        n = min(scipy.fft.next_fast_len(2 * self._n_bins(own_hz), real=True), self._n)
        band = self._spectrum[: n // 2 + 1] * _band(self._f[: n // 2 + 1], own_hz)
        return band, n, n * float(np.abs(scipy.fft.irfft(band, n)).max())

    def _n_bins(self, own_hz: float) -> int:
        """How many bins of the spectrum hold a band: all that is felt, and all but -50 dB of its energy."""
        low, high, end = (
            min(round(f * self._n / self._rate_hz), len(self._f) - 1)
            for f in (own_hz / 2**0.5, own_hz * 2**0.5, max(_OVERSAMPLED * own_hz, TACTILE_RANGE_HZ[1]))
        )
        within = float(self._power[low : high + 1] @ _band(self._f[low : high + 1], own_hz) ** 2)
        while end < len(self._f) - 1 and (own_hz / BAND_Q) ** 4 * self._above[end] > 1e-5 * within:
            end = min(2 * end, len(self._f) - 1)
        return end


def _rough_hz(strongest: Component, found: Anchor, magnitude: Signal, sample_rate_hz: float) -> float | None:
    """The strongest component, if that is another one than is felt, and slow enough to be felt as roughness of it."""
    low, high = ROUGH_HZ
    if not strongest.is_line or not low <= strongest.hz <= high or found.felt_hz < strongest.hz * _OTHER_RATIO:
        return None
    if found.carrier_hz is not None:
        return strongest.hz
    n = 2 * (len(magnitude) - 1)
    felt_db = 20.0 * float(np.log10(max(magnitude[round(found.frequency_hz * n / sample_rate_hz)], 1e-300)))
    return strongest.hz if strongest.level_db - felt_db >= MISSED_DB else None


def _band(f: NDArray[np.float64], own_hz: float) -> NDArray[np.float64]:
    r = np.maximum(f, 1e-3) / own_hz
    return np.asarray(1.0 / (1.0 + (BAND_Q * (r - 1.0 / r)) ** 2))
