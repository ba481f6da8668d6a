"""The frequency that stands for a source: where its own spectrum is strong and touch can be reached.

A sound's strongest component may lie so low, or be so uneven, that no drive below full scale makes it felt at the level
that its intensity asks for. The anchor is the strongest one that can; where none can, the one that comes nearest.

What a component needs is known before anything is converted: a band around it, of the shape that the adaptive
converter keeps, B(f) = 1 / (1 + Q^2 (f / f_0 - f_0 / f)^2), has a sensation level and a peak; the drive of a sine that
is felt as strongly, and what the peak exceeds it by ("crest"), must stay below the head-room of a loop together.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy.fft
from numpy.typing import ArrayLike, NDArray

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.levels import drive_db, felt_level_of_spectrum_db
from scene2hap.haptics import ActuatorProfile

BAND_Q = 2.0
"""Quality of each of two band-passes in series around the anchor [-]; see `tactile.adaptive`."""
HIGHEST_PEAK_DB = -6.5
"""Below full scale less the head-room of loops (6 dB) by what a loop differs from the sound it is cut from [dB]."""
_FAINTEST_DB = -14.0
"""Components this far below the strongest are not what the source is known by; better it is felt weaker. At 24 dB, most
steady recordings at hand were felt as something 14-21 dB below what they sound like."""
_SINE_CREST_DB = 0.0
ROUGH_HZ = (20.0, 60.0)
"""Rates of modulation that are felt as roughness, not one by one and not as another tone."""
_RANGE_HZ = (20.0, 1000.0)
_CANDIDATES = 8
STAYS_DB = 3.0
"""An anchor that was followed stays while it is no weaker than the best by more; about what is felt as a difference."""
LOST_DB = 12.0
"""An anchor that falls so far behind the best within one stretch belonged to another sound; assumed."""
_SAME = 1.06
"""Between looks a component moves less than this; a faster one is another component."""
_NEW_SHARE = 0.3
"""Of the newest stretch in the averaged spectrum; assumed: two looks make half of it."""
_APART = 2.0 ** (1.0 / 6.0)
_GRID = 81


@dataclass(frozen=True)
class Anchor:
    """A source's own frequency [Hz], and what its band's peak exceeds that of an equally felt sine by [dB].

    rough_hz : the strongest component of the sound, where that is too low to be felt as itself and is to be kept as
    roughness; None otherwise [Hz].
    """

    frequency_hz: float
    crest_db: float = _SINE_CREST_DB
    rough_hz: float | None = None


def anchor_of(samples: ArrayLike, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile) -> Anchor | None:
    """The anchor of a whole sound (n_samples,) that is to be felt at a sensation level; None where there is none."""
    x = np.asarray(samples, dtype=np.float64)
    found = _felt_anchor(x, sample_rate_hz, level_db, actuator)
    return found and replace(found, rough_hz=_rough_hz(x, sample_rate_hz, found.frequency_hz))


def band_of(clip: AudioClip, anchor: Anchor) -> NDArray[np.float64]:
    """What the adaptive converter keeps of a clip around its anchor (n_samples,)."""
    x = clip.samples.astype(np.float64)
    spectrum = scipy.fft.rfft(x - x.mean())
    spectrum *= _band(scipy.fft.rfftfreq(len(x), 1.0 / clip.sample_rate_hz), anchor.frequency_hz)
    return np.asarray(scipy.fft.irfft(spectrum, len(x)), dtype=np.float64)


def _rough_hz(x: NDArray[np.float64], sample_rate_hz: float, felt_hz: float) -> float | None:
    """The strongest component, if that is another one than is felt, and slow enough to be felt as roughness of it."""
    low, high = ROUGH_HZ
    magnitude = _spectrum(x)
    n = 2 * (len(magnitude) - 1)
    strongest = next(iter(_peaks(magnitude, sample_rate_hz, ActuatorProfile(min_frequency_hz=low))), None)
    if strongest is None or not low <= strongest[0] <= high or felt_hz < strongest[0] * 1.25:
        return None
    felt_db = 20.0 * float(np.log10(max(magnitude[round(felt_hz * n / sample_rate_hz)], 1e-300)))
    return strongest[0] if strongest[1] - felt_db >= STAYS_DB else None


def _felt_anchor(
    x: NDArray[np.float64], sample_rate_hz: float, level_db: float, actuator: ActuatorProfile
) -> Anchor | None:
    spectrum = np.asarray(scipy.fft.rfft(x - x.mean()), dtype=np.complex128)
    f = scipy.fft.rfftfreq(len(x), 1.0 / sample_rate_hz)
    best: tuple[float, Anchor] | None = None
    for own_hz in _components(x, sample_rate_hz, actuator):
        band = spectrum * _band(f, own_hz)
        peak = np.abs(scipy.fft.irfft(band, len(x))).max()
        reached_db = felt_level_of_spectrum_db(band, len(x), sample_rate_hz, actuator) - 20.0 * np.log10(peak)
        needed_db = level_db - reached_db
        crest_db = needed_db - float(drive_db(own_hz, level_db, actuator))
        if needed_db <= HIGHEST_PEAK_DB:
            return Anchor(own_hz, crest_db)
        if best is None or needed_db < best[0]:
            best = needed_db, Anchor(own_hz, crest_db)
    return best[1] if best else None


class TrackedAnchor:
    """The anchor of a sound that goes on, looked at in stretches of one length and taken for steady, which is quicker.

    Spectra are averaged from look to look, and an anchor stays while its component is within `STAYS_DB` of the best: a
    machine with two harmonics alike does not hop between them.

    Parameters: sample_rate_hz : of the stretches; level_db : over the threshold, at which the sound is to be felt.
    """

    def __init__(self, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile) -> None:
        self._rate_hz, self._level_db, self._actuator = sample_rate_hz, level_db, actuator
        self._power: NDArray[np.float64] | None = None
        self.own_hz: float | None = None

    def look(self, stretch: NDArray[np.float64]) -> float | None:
        """The anchor after another stretch (n_samples,); None while there is nothing [Hz]."""
        magnitude = _spectrum(stretch)
        self._power = self._averaged(magnitude)
        found = _peaks(np.sqrt(self._power), self._rate_hz, self._actuator)
        if not found:
            return self.own_hz
        hz, height_db = np.array(found).T
        drive = drive_db(hz, self._level_db, self._actuator)
        good = drive <= HIGHEST_PEAK_DB
        best = int(np.argmax(good) if good.any() else np.argmin(drive))
        if self.own_hz is not None:
            near = int(np.argmin(np.abs(np.log(hz / self.own_hz))))
            is_same = abs(np.log(hz[near] / self.own_hz)) < np.log(_SAME)
            if is_same and good[near] == good[best] and height_db[near] >= height_db[best] - STAYS_DB:
                best = near
        self.own_hz = float(hz[best])
        return self.own_hz

    def _averaged(self, magnitude: NDArray[np.float64]) -> NDArray[np.float64]:
        """Power by bins, of this stretch and those before; of this one alone if the anchor is lost in it."""
        power = magnitude**2
        before, own_hz = self._power, self.own_hz
        if before is None or own_hz is None or len(before) != len(power):
            return power
        per_bin = 2 * (len(power) - 1) / self._rate_hz
        low, high = int(own_hz / _SAME * per_bin), int(own_hz * _SAME * per_bin) + 1
        first, last = (int(edge * per_bin) for edge in _RANGE_HZ)
        if power[low : high + 1].max() < power[first : last + 1].max() * 10 ** (-LOST_DB / 10):
            return power
        return _NEW_SHARE * power + (1.0 - _NEW_SHARE) * before

    def share(self, passes: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> float:
        """The power that a filter of this gain over frequency [Hz] lets through, of the stretches so far [-]."""
        if self._power is None:
            return 0.0
        f = np.arange(len(self._power)) * self._rate_hz / (2 * (len(self._power) - 1))
        return float(self._power @ passes(f) ** 2)


def reachable_hz(
    anchor: Anchor, level_db: float, actuator: ActuatorProfile, octaves: float
) -> tuple[float, float, float]:
    """How far a source may be moved: lowest and highest frequency [Hz], and how much louder it may be all the way [dB].

    Both lie within `octaves` of its own frequency; further than its level can be reached only if that was so before.
    """
    own_hz = anchor.frequency_hz
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


def _components(x: NDArray[np.float64], sample_rate_hz: float, actuator: ActuatorProfile) -> list[float]:
    """Frequencies of the spectrum's peaks, strongest first, see `_peaks` [Hz]."""
    return [hz for hz, _ in _peaks(_spectrum(x), sample_rate_hz, actuator)]


def _spectrum(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Magnitudes under a Hann window, of the sound padded to an even number of twice its length and more."""
    n = 2 * scipy.fft.next_fast_len(len(x), real=True)
    magnitudes: NDArray[np.float64] = np.abs(scipy.fft.rfft((x - x.mean()) * np.hanning(len(x) + 2)[1:-1], n))
    return magnitudes


def _peaks(
    magnitude: NDArray[np.float64], sample_rate_hz: float, actuator: ActuatorProfile
) -> list[tuple[float, float]]:
    """Peaks [Hz] and their heights [dB], strongest first, none within a sixth of an octave of a stronger one.

    Parabola through the logarithms of the three bins around a peak.
    """
    n = 2 * (len(magnitude) - 1)
    low = max(_RANGE_HZ[0], actuator.min_frequency_hz)
    high = min(_RANGE_HZ[1], actuator.max_frequency_hz, 0.45 * sample_rate_hz)
    first, last = max(1, int(np.ceil(low * n / sample_rate_hz))), int(high * n / sample_rate_hz)
    bins = np.arange(first, min(last, len(magnitude) - 2) + 1)
    bins = bins[(magnitude[bins] >= magnitude[bins - 1]) & (magnitude[bins] > magnitude[bins + 1])]
    if bins.size == 0:
        return []
    bins = bins[magnitude[bins] >= magnitude[bins].max() * 10 ** (_FAINTEST_DB / 20)]
    heights = magnitude[bins]
    kept: list[int] = []
    while heights.any() and len(kept) < _CANDIDATES:
        k = int(bins[np.argmax(heights)])
        kept.append(k)
        heights[(bins <= k * _APART) & (bins >= k / _APART)] = 0.0
    return [
        ((k + _peak_offset(magnitude[k - 1 : k + 2])) * sample_rate_hz / n, 20.0 * float(np.log10(magnitude[k])))
        for k in kept
    ]


def _peak_offset(three: NDArray[np.float64]) -> float:
    a, b, c = np.log(np.maximum(three, np.finfo(float).tiny))
    curvature = a - 2 * b + c
    return float(np.clip(0.5 * (a - c) / curvature, -0.5, 0.5)) if curvature < 0 else 0.0


def _band(f: NDArray[np.float64], own_hz: float) -> NDArray[np.float64]:
    r = np.maximum(f, 1e-3) / own_hz
    return np.asarray(1.0 / (1.0 + (BAND_Q * (r - 1.0 / r)) ** 2))
