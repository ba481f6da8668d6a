"""Measures of a sound: silent ends, dynamic range, spectral flatness, dominant frequency, rhythm.

Pure functions of samples (n,) in any scale and their rate. The offset, which is neither heard nor felt, is removed
first; otherwise it would count as a loud, steady tone. For spectra the mean is removed, for silent ends the median: a
few strokes in digital silence have a mean, whose removal would turn the silence into a steady level. The dynamic range
is that of the sound without infrasound.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike

from scene2hap.audio.infrasound import without_infrasound
from scene2hap.audio.spectra.components import peak_offset
from scene2hap.audio.spectra.windows import hann
from scene2hap.audio.threshold import TACTILE_RANGE_HZ
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.errors import AudioError

Weight = Callable[[Floats], Floats]

TRIM_DB = 40.0
"""Frames this far below the loudest one are silence at the ends [dB]; assumed, as in most trimming programs."""
TRIM_FRAME_S = 0.010
SILENCE_DBFS = -90.0
"""A sound whose loudest frame is below this is silent [dB re 1]: this is the noise of 16-bit rounding."""

LEVEL_FRAME_S = 0.050
SLOW_LEVEL_FRAME_S = 0.100
SLOW_HZ = 30.0
"""Below this dominant frequency a 50 ms frame holds so few cycles that a steady tone would seem to flutter."""
LEVEL_FLOOR_DB = -60.0

FLATNESS_BAND_HZ = (20.0, 7000.0)
"""Range that codecs, and sample rates from 16 kHz on, preserve; otherwise a low-passed file would count as tonal."""
FLATNESS_FRAME_S = 0.125
FLATNESS_FLOOR_DB = -60.0
"""Floor of bins relative to the mean of their frame [dB]: weaker ones are masked, and codecs replace them by zeros."""

HEARD_RANGE_HZ = (10.0, 20_000.0)
"""Range in which the strongest component of a sound is looked for, including what is only felt."""

RHYTHM_RANGE_HZ = (0.5, 60.0)
SURE_DEPTH = 0.25
"""Modulation index of an envelope [-] from which every loop cut from a sound has its rate."""


def sounding_span(samples: ArrayLike, sample_rate_hz: float) -> tuple[int, int]:
    """Return the span [first, end) of samples that are not silence, on a grid of 10 ms; (0, 0) if all is silent.

    Frames are silent if their RMS is `TRIM_DB` below that of the loudest frame.
    """
    x, rate = _checked(samples, sample_rate_hz)
    x = x - np.median(x)
    frame = max(1, round(TRIM_FRAME_S * rate))
    starts = np.arange(0, len(x), frame)
    power = np.add.reduceat(x**2, starts) / np.diff(np.append(starts, len(x)))
    loudest = float(power.max())
    if loudest <= 10 ** (SILENCE_DBFS / 10):
        return 0, 0
    audible = np.flatnonzero(power > loudest * 10 ** (-TRIM_DB / 10))
    return int(starts[audible[0]]), min(len(x), int(starts[audible[-1]]) + frame)


def dynamic_range_db(samples: ArrayLike, sample_rate_hz: float, *, dominant_hz: float | None = None) -> float:
    """Return the dynamic range of a sound: 95th minus 10th percentile of its short-time RMS level [dB].

    Frames of 50 ms (100 ms below `SLOW_HZ`), overlapping by half. Frames more than 60 dB below the loudest are gated.
    The low percentile counts them as 60 dB below it; otherwise clicks with silence between them would be steady. The
    high percentile leaves them out; otherwise it would be the level of silence in a sound that is nearly all silence.
    Measured on 5 s: sine 0, white noise 0.3, a 20 dB decay 17, clicks above 25. (Loudness range after EBU R 128 takes
    blocks of 3 s and does not show clicks; the crest factor of steady noise is 13 dB.)
    Parameters: dominant_hz : the sound's dominant frequency if it is known already [Hz].
    Raises: AudioError: the samples are empty or all equal.
    """
    x, rate = _sounding(samples, sample_rate_hz)
    x = without_infrasound(x, rate)
    is_slow = (dominant_frequency_hz(x, rate) if dominant_hz is None else dominant_hz) < SLOW_HZ
    frames = _frames(x, round((SLOW_LEVEL_FRAME_S if is_slow else LEVEL_FRAME_S) * rate))
    power = np.mean(frames**2, axis=1)
    level_db = 10 * np.log10(np.maximum(power / power.max(), 10 ** (LEVEL_FLOOR_DB / 10)))
    high = np.percentile(level_db[level_db > LEVEL_FLOOR_DB], 95)
    return float(high - np.percentile(level_db, 10))


def spectral_flatness(
    samples: ArrayLike, sample_rate_hz: float, *, band_hz: tuple[float, float] = FLATNESS_BAND_HZ
) -> float:
    """Return the spectral flatness, from 0 (a pure tone) to 0.56 = exp(-Euler's gamma) (white noise) [-].

    It is the geometric over the arithmetic mean of the power spectrum within `band_hz`, averaged over Hann-windowed
    frames. Frames last 125 ms at any rate, and the band is the same for all. So each sound has the same bins, as if all
    were resampled to one rate first. Level has no effect; frames 60 dB below the loudest are left out, since digital
    silence would count as perfectly flat.
    Raises: AudioError: the samples are empty or all equal, or the band does not fit below half the rate.
    """
    x, rate = _sounding(samples, sample_rate_hz)
    low, high = band_hz
    checks.number("band_hz[1]", high, "Hz", above=low, error=AudioError)
    frames = _frames(x, round(FLATNESS_FRAME_S * rate))
    frequencies = scipy.fft.rfftfreq(frames.shape[1], 1 / rate)
    in_band = (frequencies >= low) & (frequencies <= high)
    if high > rate / 2 or not in_band.any():
        raise AudioError(
            f"band_hz is {low:g} to {high:g} Hz; a sound of {len(x)} samples at {rate:g} Hz has no such band. "
            "Choose one below half the rate, or a longer sound."
        )
    spectrum = scipy.fft.rfft(frames * hann(frames.shape[1]), axis=1)[:, in_band]
    power = spectrum.real**2 + spectrum.imag**2
    mean = power.mean(axis=1)
    is_heard = mean > mean.max() * 10 ** (LEVEL_FLOOR_DB / 10)
    if not is_heard.any():
        raise AudioError(f"there is nothing between {low:g} and {high:g} Hz; flatness needs a sound in that band.")
    relative = power[is_heard] / mean[is_heard, None]
    lifted = np.maximum(relative, 10 ** (FLATNESS_FLOOR_DB / 10))
    return float(np.mean(np.exp(np.log(lifted).mean(axis=1)) / lifted.mean(axis=1)))


def dominant_frequency_hz(
    samples: ArrayLike,
    sample_rate_hz: float,
    *,
    range_hz: tuple[float, float] = TACTILE_RANGE_HZ,
    weight_db: Weight | None = None,
) -> float:
    """Return the frequency of the strongest peak of a sound's spectrum within `range_hz` [Hz].

    The method is a Hann-windowed Fourier transform of the whole sound, zero-padded to twice its length, and a parabola
    through the logarithms of the three bins around the peak. For a tone in noise the error is below 0.1 Hz from 0.25 s
    on. Only true peaks count, not the flank of a louder component outside the range, unless the range has no peak.

    Parameters: weight_db : returns levels [dB] that are added at frequencies > 0 [Hz], in their shape, before peaks are
    compared; None for none.
    Raises: AudioError: the samples are empty or all equal, or the range does not begin below half the rate.
    """
    return dominant_frequencies_hz(samples, sample_rate_hz, range_hz, weight_db=weight_db)[0]


def dominant_frequencies_hz(
    samples: ArrayLike, sample_rate_hz: float, *ranges_hz: tuple[float, float], weight_db: Weight | None = None
) -> tuple[float, ...]:
    """Return `dominant_frequency_hz` for several ranges, from one spectrum [Hz]. Raises: AudioError: see there."""
    x, rate = _sounding(samples, sample_rate_hz)
    for low, high in ranges_hz:
        checks.number("range_hz[0]", low, "Hz", above=0.0, below=min(high, rate / 2), error=AudioError)
    n = scipy.fft.next_fast_len(2 * len(x), real=True)
    magnitude = np.abs(scipy.fft.rfft(x * hann(len(x)), n))
    found = []
    for low, high in ranges_hz:
        frequency_hz = peak_frequency_hz(magnitude, rate / n, (low, high), weight_db)
        if frequency_hz is None:
            raise AudioError(
                f"a sound of {len(x) / rate:g} s does not resolve {low:g} to {high:g} Hz. "
                "Use a longer sound or a wider range."
            )
        found.append(frequency_hz)
    return tuple(found)


def peak_frequency_hz(
    magnitude: ArrayLike, bin_hz: float, range_hz: tuple[float, float], weight_db: Weight | None = None
) -> float | None:
    """Return the frequency of the highest peak of a magnitude spectrum (n_bins,), with bins every `bin_hz` from 0 Hz.

    It is the maximum of a parabola through the logarithms of three bins; None if the range has no bin. With `weight_db`
    (see `dominant_frequency_hz`) it is the peak that is highest after weighting, at its place before weighting.
    """
    m = np.asarray(magnitude, dtype=np.float64)
    low, high = range_hz
    first, end = max(1, math.ceil(low / bin_hz)), min(len(m) - 2, math.floor(high / bin_hz)) + 1
    if end <= first:
        return None
    centre = m[first:end]
    is_peak = (centre >= m[first - 1 : end - 1]) & (centre >= m[first + 1 : end + 1])
    height = centre
    if weight_db is not None:
        f = np.asarray(np.arange(first, end) * bin_hz, dtype=np.float64)
        height = np.asarray(centre * 10 ** (weight_db(f) / 20), dtype=np.float64)
    k = first + int(np.argmax(np.where(is_peak, height, 0.0) if is_peak.any() else height))
    return float((k + peak_offset(m[k - 1 : k + 2])) * bin_hz)


def rhythm_hz(samples: ArrayLike, sample_rate_hz: float, least_depth: float = SURE_DEPTH) -> float | None:
    """Return the strongest rate in the Hilbert envelope of a sound (n_samples,) [Hz].

    None if its modulation index is below `least_depth` [-].
    """
    x = np.asarray(samples, dtype=np.float64)
    envelope = np.abs(scipy.signal.hilbert(x - x.mean()))
    rates = np.fft.rfftfreq(len(x), 1.0 / sample_rate_hz)
    inside = (rates >= RHYTHM_RANGE_HZ[0]) & (rates <= RHYTHM_RANGE_HZ[1])
    depth = 2.0 * np.abs(scipy.fft.rfft(envelope)) / len(x) / envelope.mean()
    depth[~inside] = 0.0
    k = int(np.argmax(depth))
    return float(rates[k]) if depth[k] >= least_depth else None


def _checked(samples: ArrayLike, sample_rate_hz: float) -> tuple[Floats, float]:
    """Return the samples as float64 without their mean, and the rate."""
    rate = checks.number("sample_rate_hz", sample_rate_hz, "Hz", above=0.0, error=AudioError)
    x = np.asarray(samples, dtype=np.float64)
    if x.ndim != 1 or x.size == 0:
        raise AudioError(f"samples has shape {x.shape}; analysis wants one channel with at least one sample, (n,).")
    return x - x.mean(), rate


def _sounding(samples: ArrayLike, sample_rate_hz: float) -> tuple[Floats, float]:
    x, rate = _checked(samples, sample_rate_hz)
    if np.ptp(x) == 0.0:
        raise AudioError(f"all {len(x)} samples are equal; silence has neither level nor spectrum. Drop this sound.")
    return x, rate


def _frames(x: Floats, size: int) -> Floats:
    """Return frames (n_frames, size) that overlap by half; the whole signal if it is shorter than one."""
    size = min(max(size, 2), len(x))
    return sliding_window_view(x, size)[:: max(1, size // 2)]
