"""The components of a spectrum: lines, which exceed the noise around them, and bands of noise."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy

from scene2hap.audio.spectra.windows import hann
from scene2hap.common.arrays import Floats

LINE_DB = 13.5
"""Least height of a line above the median of its surroundings [dB]. Five seconds of noise have 5000 bins up to 1 kHz.
The highest exceeds the median by 11.3 dB on average, by 12 dB in one sound of eight, by 13.5 dB in one of 500."""
_AROUND = 2.0 ** (1.0 / 3.0)
"""Ratio of frequencies to which the surroundings of a line extend on either side: a third of an octave [-]."""
_LOBES = 8.0
"""Least extent of a line's surroundings, in widths of the window's main lobe."""
_APART = 2.0 ** (1.0 / 6.0)
"""Least ratio of the frequencies of two components: a sixth of an octave, below what touch tells apart [-]."""
_MOST = 8
"""Most components of a sound (assumed)."""


class Component(NamedTuple):
    """A peak of a spectrum: frequency [Hz], level [dB], and height above the median of its surroundings [dB]."""

    hz: float
    level_db: float
    above_noise_db: float

    @property
    def is_line(self) -> bool:
        """True if it is a line, not a peak of noise."""
        return self.above_noise_db >= LINE_DB


def magnitudes(x: Floats) -> Floats:
    """Return the magnitude spectrum of a sound (n,), Hann-windowed and padded to an even length of at least 2 n."""
    n = 2 * scipy.fft.next_fast_len(len(x), real=True)
    found: Floats = np.abs(scipy.fft.rfft((x - x.mean()) * hann(len(x)), n))
    return found


def components(
    magnitude: Floats, sample_rate_hz: float, range_hz: tuple[float, float], faintest_db: float, most: int = _MOST
) -> list[Component]:
    """Return the peaks of a spectrum from `magnitudes`, as `peaks` finds them, with their surroundings."""
    found = peaks(magnitude, sample_rate_hz, range_hz, faintest_db, most)
    return [Component(hz, level_db, _above_noise_db(magnitude, k)) for k, hz, level_db in found]


def strongest_component(magnitude: Floats, sample_rate_hz: float, range_hz: tuple[float, float]) -> Component | None:
    """Return the highest peak of a spectrum from `magnitudes` within a range, None without any."""
    return next(iter(components(magnitude, sample_rate_hz, range_hz, 0.0, 1)), None)


def peaks(
    magnitude: Floats, sample_rate_hz: float, range_hz: tuple[float, float], faintest_db: float, most: int = _MOST
) -> list[tuple[int, float, float]]:
    """Return bin, frequency [Hz] and level [dB] of the strongest peaks within a range, strongest first.

    Peaks within a sixth of an octave of a stronger one are left out, and those more than -`faintest_db` below the
    strongest. Frequencies are the maxima of parabolas through the logarithms of three bins.
    """
    n = 2 * (len(magnitude) - 1)
    low, high = range_hz
    first, last = max(1, int(np.ceil(low * n / sample_rate_hz))), int(high * n / sample_rate_hz)
    within = magnitude[first - 1 : min(last, len(magnitude) - 2) + 2]
    bins = first + np.flatnonzero((within[1:-1] >= within[:-2]) & (within[1:-1] > within[2:]))
    if bins.size == 0:
        return []
    bins = bins[magnitude[bins] >= magnitude[bins].max() * 10 ** (faintest_db / 20)]
    heights = magnitude[bins]
    kept: list[int] = []
    while len(kept) < most and heights.any():
        k = int(bins[np.argmax(heights)])
        kept.append(k)
        heights[np.searchsorted(bins, k / _APART) : np.searchsorted(bins, k * _APART, side="right")] = 0.0
    return [
        (k, (k + peak_offset(magnitude[k - 1 : k + 2])) * sample_rate_hz / n, 20.0 * float(np.log10(magnitude[k])))
        for k in kept
    ]


def strongest_bands_hz(
    magnitude: Floats, sample_rate_hz: float, range_hz: tuple[float, float], faintest_db: float
) -> list[float]:
    """Return the centres of the third octaves within a range [Hz], strongest first, down to -`faintest_db` below it."""
    n = 2 * (len(magnitude) - 1)
    low, high = range_hz
    middles = 10 ** (np.arange(np.ceil(10 * np.log10(low)), np.floor(10 * np.log10(high)) + 1) / 10)
    edges = np.clip(
        np.rint(np.outer([10**-0.05, 10**0.05], middles) * n / sample_rate_hz).astype(int), 0, len(magnitude)
    )
    power = np.concatenate([[0.0], np.cumsum(magnitude[: edges.max(initial=0)] ** 2)])
    energy = power[edges[1]] - power[edges[0]]
    if not energy.any():
        return []
    order = [int(k) for k in np.argsort(-energy, kind="stable")]
    return [float(middles[k]) for k in order if energy[k] >= energy.max() * 10 ** (faintest_db / 10)]


def _above_noise_db(magnitude: Floats, k: int) -> float:
    # Spectra are padded to twice the sound: a main lobe has eight bins.
    reach = max(k * (_AROUND - 1.0), _LOBES * 8)
    around = magnitude[max(1, int(k - reach)) : int(k + reach) + 1]
    return float(20.0 * np.log10(magnitude[k] / max(float(np.median(around)), 1e-300)))


def peak_offset(three: Floats) -> float:
    """Return where a parabola through the logarithms of three bins is highest, -0.5..0.5 bins from the middle one."""
    a, b, c = np.log(np.maximum(three, np.finfo(float).tiny))
    curvature = a - 2 * b + c
    return float(np.clip(0.5 * (a - c) / curvature, -0.5, 0.5)) if curvature < 0 else 0.0
