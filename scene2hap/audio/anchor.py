"""The frequency that stands for a source: where its own spectrum is strong and touch can be reached.

A sound's strongest component may lie so low, or be so uneven, that no drive below full scale makes it felt at the level
that its intensity asks for. The anchor is the strongest one that can; where none can, the one that comes nearest.

What a component needs is known before anything is converted: a band around it, of the shape that the adaptive
converter keeps, B(f) = 1 / (1 + Q^2 (f / f_0 - f_0 / f)^2), has a sensation level and a peak; the drive of a sine that
is felt as strongly, and what the peak exceeds it by ("crest"), must stay below the head-room of a loop together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.fft
from numpy.typing import ArrayLike, NDArray

from scene2hap.audio.levels import drive_db, felt_level_of_spectrum_db
from scene2hap.haptics import ActuatorProfile

BAND_Q = 2.0
"""Quality of each of two band-passes in series around the anchor [-]; see `tactile.adaptive`."""
HIGHEST_PEAK_DB = -6.5
"""Below full scale less the head-room of loops (6 dB) by what a loop differs from the sound it is cut from [dB]."""
_FAINTEST_DB = -24.0
"""Components this far below the strongest are not what the source is known by; assumed."""
_SINE_CREST_DB = 0.0
_RANGE_HZ = (20.0, 1000.0)
_CANDIDATES = 8
_APART = 2.0 ** (1.0 / 6.0)
_GRID = 81


@dataclass(frozen=True)
class Anchor:
    """A source's own frequency [Hz], and what its band's peak exceeds that of an equally felt sine by [dB]."""

    frequency_hz: float
    crest_db: float = _SINE_CREST_DB


def anchor_of(samples: ArrayLike, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile) -> Anchor | None:
    """The anchor of a whole sound (n_samples,) that is to be felt at a sensation level; None where there is none."""
    x = np.asarray(samples, dtype=np.float64)
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


def own_frequency_hz(
    samples: ArrayLike, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile
) -> float | None:
    """The anchor of a stretch (n_samples,) of a sound that goes on, taken for steady, which is quicker [Hz]."""
    x = np.asarray(samples, dtype=np.float64)
    components = np.array(_components(x, sample_rate_hz, actuator))
    if components.size == 0:
        return None
    drive = drive_db(components, level_db, actuator)
    good = drive <= HIGHEST_PEAK_DB
    return float(components[np.argmax(good)] if good.any() else components[np.argmin(drive)])


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
    """Frequencies of the spectrum's peaks, strongest first, none within a sixth of an octave of a stronger one [Hz].

    Hann window, zero-padding to twice the length, parabola through the logarithms of the three bins around a peak.
    """
    n = scipy.fft.next_fast_len(2 * len(x), real=True)
    magnitude = np.abs(scipy.fft.rfft((x - x.mean()) * np.hanning(len(x) + 2)[1:-1], n))
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
    return [(k + _peak_offset(magnitude[k - 1 : k + 2])) * sample_rate_hz / n for k in kept]


def _peak_offset(three: NDArray[np.float64]) -> float:
    a, b, c = np.log(np.maximum(three, np.finfo(float).tiny))
    curvature = a - 2 * b + c
    return float(np.clip(0.5 * (a - c) / curvature, -0.5, 0.5)) if curvature < 0 else 0.0


def _band(f: NDArray[np.float64], own_hz: float) -> NDArray[np.float64]:
    r = np.maximum(f, 1e-3) / own_hz
    return np.asarray(1.0 / (1.0 + (BAND_Q * (r - 1.0 / r)) ** 2))
