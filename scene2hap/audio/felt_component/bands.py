"""The band around a component that the adaptive converter keeps: its gain, and the level and peak of what it keeps.

Two band-passes in series have the gain B(f) = 1 / (1 + Q^2 (f / f_0 - f_0 / f)^2).
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable

import numpy as np
import scipy

from scene2hap.audio.felt_component.moving_pitch import growth_db
from scene2hap.audio.levels import over_threshold_db, sum_db
from scene2hap.audio.threshold import TACTILE_RANGE_HZ
from scene2hap.common.arrays import Complex, Floats
from scene2hap.haptics import ActuatorProfile

BAND_Q = 2.0
"""Quality of each of two band-passes in series around the component [-]; see `tactile.adaptive`."""
_OVERSAMPLED = 16.0
"""Half the sample rate at which a band's peak is searched, over the band's frequency: the peak is found to 0.04 dB."""
_SMOOTHED = 4.0
"""Frequency above which the mean that bounds a band's peak has nothing, over the band's frequency."""


def band_gain(f: Floats, own_hz: float, q: float) -> Floats:
    """Return the gain B(f) of two band-passes in series at frequencies (n,) [Hz], 0..1 [-]."""
    r = np.maximum(f, 1e-3) / own_hz
    return np.asarray(1.0 / (1.0 + (q * (r - 1.0 / r)) ** 2))


def kept_band(samples: Floats, sample_rate_hz: float, own_hz: float, q: float) -> Floats:
    """Return the band of a sound (n,) around a frequency, without delay, shortened to `fast_length`."""
    x = samples[: fast_length(len(samples))]
    spectrum = scipy.fft.rfft(x - x.mean())
    spectrum *= band_gain(scipy.fft.rfftfreq(len(x), 1.0 / sample_rate_hz), own_hz, q)
    return np.asarray(scipy.fft.irfft(spectrum, len(x)), dtype=np.float64)


def fast_length(n: int) -> int:
    """Return the greatest length up to n that has no prime factor above 11, so that its Fourier transform is fast.

    Files have any length, and a transform of 440,989 samples takes 14 times as long as one of 441,000. From 20,000
    samples on, this shortens a sound by at most 1 %.
    """
    if n < 2:
        return n
    low = n // 2
    return low - 1 + bisect_right(range(low, n + 1), n, key=scipy.fft.next_fast_len)


class SoundBands:
    """Levels and peaks of any band of a sound (n,), from its spectrum; q : of each of the two band-passes [-]."""

    def __init__(self, x: Floats, sample_rate_hz: float, actuator: ActuatorProfile) -> None:
        self._x, self._n, self._rate_hz = x, len(x), sample_rate_hz
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
        self._latest: tuple[tuple[float, float], Complex, Floats] | None = None

    def sensation_level_db(self, own_hz: float, q: float) -> float:
        """Return the sensation level of a band on the actuator [dB]."""
        return sum_db(self._felt * band_gain(self._felt_f, own_hz, q) ** 2)

    def peak(self, own_hz: float, q: float) -> float:
        """Return the peak of a band [-]."""
        return _peak(self._band(own_hz, q)[1])

    def least_peak(self, own_hz: float, q: float) -> float:
        """Return a lower bound of a band's peak [-], for a fraction of its cost.

        A weighted mean over time does not exceed the peak. The weights are Fejer's kernel, whose spectrum falls
        linearly to zero, so that few bins and samples suffice. For noise and ticks the bound is 1 to 4 dB too low.
        """
        end = round(max(_SMOOTHED * own_hz, TACTILE_RANGE_HZ[1]) * self._n / self._rate_hz)
        end = max(2, min(end, len(self._f) - 1))
        kept = band_gain(self._f[:end], own_hz, q) * (1.0 - np.arange(end) / end)
        return _peak(scipy.fft.irfft(self._spectrum[:end] * kept, scipy.fft.next_fast_len(2 * end, real=True)))

    def crest_db(self, own_hz: float, q: float) -> float:
        """Return the peak of a band relative to that of a sine with the same power [dB]."""
        band, signal = self._band(own_hz, q)
        rms = float(np.sqrt(2.0 * np.sum(np.abs(band) ** 2)))
        return 20.0 * float(np.log10(_peak(signal) / (np.sqrt(2.0) * rms)))

    def share_db(self, passes: Callable[[Floats], Floats]) -> float:
        """Return the level of what a filter keeps, relative to the whole sound [dB].

        It is rounded: the last digits of a sum depend on the machine, and would change each sample of a loop.
        Parameters: passes : returns the gain of power (n,) [-] at frequencies (n,) [Hz].
        """
        kept, whole = self._power @ passes(self._f), self._power.sum()
        return round(10.0 * float(np.log10(max(kept, 1e-300) / max(whole, 1e-300))), 2)

    def growth_db(self, own_hz: float, q: float) -> float:
        """Return the range of a band's level minus that of the sound [dB], see `moving_pitch.growth_db`."""
        return growth_db(self._x, self._band(own_hz, q)[1], self._n / self._rate_hz)

    def low_passed(self, highest_hz: float) -> tuple[Floats, float]:
        """Return the sound (m,) at the lowest rate that suits its part up to a frequency, and this rate [Hz]."""
        n = min(scipy.fft.next_fast_len(round(2.5 * highest_hz * self._n / self._rate_hz), real=True), self._n)
        return scipy.fft.irfft(self._spectrum[: n // 2 + 1], n), self._rate_hz * n / self._n

    def _band(self, own_hz: float, q: float) -> tuple[Complex, Floats]:
        """Return the spectrum of a band and the band itself (n,), both divided by n. The latest one is kept."""
        if self._latest is None or self._latest[0] != (own_hz, q):
            n = min(scipy.fft.next_fast_len(2 * self._n_bins(own_hz, q), real=True), self._n)
            band = self._spectrum[: n // 2 + 1] * band_gain(self._f[: n // 2 + 1], own_hz, q)
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


def _peak(x: Floats) -> float:
    """Return the peak of a band (n,) that is divided by n."""
    return len(x) * float(max(x.max(), -x.min()))
