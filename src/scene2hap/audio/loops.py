"""Loops whose seam is neither heard nor felt.

A loop of length L is cut from a longer sound x at s, and its first C samples are faded over from those behind its end:

    y[i] = w_in(i) x[s + i] + w_out(i) x[s + L + i]   for i < C,        y[i] = x[s + i]   for C <= i < L

so that y[L - 1] is followed by y[0] = x[s + L], its true successor. What the fade does to the sound depends on how
alike the two stretches are: alike ones keep their level under a linear fade (w_in + w_out = 1), unrelated ones under
an equal-power fade (w_in^2 + w_out^2 = 1), and ones in antiphase cancel by 25 dB. So s and L are searched for the
stretches most alike, which for a tonal sound makes L a whole number of cycles.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.signal import correlate

from scene2hap import checks
from scene2hap.audio import analysis
from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.audio.convert import convert_clip
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.protocol import ConversionContext, TactileConverter
from scene2hap.errors import AudioError

FadeLaw = Literal["linear", "equal-power"]

TACTILE_HEADROOM_DB = 6.0
"""Peak of the tactile loop of a source of full intensity, below full scale [dB]: two such sources add up to full scale
(within 0.02 dB)."""
AUDIBLE_PEAK_DBFS = -1.0
"""Peak of every audible loop [dB re 1]; the usual margin for players that resample."""

MIN_CLIP_S = 0.1
MAX_LOOP_S = 10.0
"""Longer sounds give a loop from their middle; assumed: nobody notices the return after ten seconds."""
CROSSFADE_S = 0.2
"""Length of the fade and of the stretches that are compared; at most an eighth of the clip. Assumed: four cycles at
20 Hz."""

AUDIBLE_RANGE_HZ = (20.0, 20_000.0)

_SHORTEST_SHARE = 0.5
_N_STARTS = 12
_FEWEST_SAMPLES = 16
_AS_GOOD = 1e-4
"""Seams whose likeness is this close to the best are as good, and the longest of them wins: a tone out of phase by 0.8
degrees differs by as much."""
_ALIKE = 0.5
_SILENT = 1e-9
"""Of the whole energy; below, likeness would be a ratio of rounding errors."""


@dataclass(frozen=True)
class Seam:
    """Where a loop is cut and how it is closed: first sample, length and crossfade length [samples], and fade law."""

    start: int
    length: int
    crossfade: int
    law: FadeLaw

    def __post_init__(self) -> None:
        if self.start < 0 or not 0 <= self.crossfade <= self.length or self.length < 1:
            raise AudioError(f"{self} is impossible; it needs start >= 0, length >= 1 and 0 <= crossfade <= length.")

    @property
    def n_samples_needed(self) -> int:
        """How many samples a signal must have for this seam."""
        return self.start + self.length + self.crossfade


def make_loop(clip: AudioClip) -> AudioClip:
    """A clip as an endless loop, at its own level. Raises: AudioError: shorter than `MIN_CLIP_S`."""
    return replace(clip, samples=apply_seam(clip.samples, find_seam(clip.samples, clip.sample_rate_hz)))


def loop_pair(clip: AudioClip, converter: TactileConverter, context: ConversionContext) -> HapticLoop:
    """The audible and the tactile loop of a clip, cut at the same place.

    The whole clip is converted before it is cut, so that a converter's start-up lies outside the loop. The seam suits
    both signals; each is faded by the law that suits it. The audible loop peaks at `AUDIBLE_PEAK_DBFS`, the tactile one
    at `context.intensity` times full scale less `TACTILE_HEADROOM_DB`.
    Raises: AudioError: the clip is shorter than `MIN_CLIP_S` or silent, or its conversion is.
    """
    intensity = checks.number("intensity", context.intensity, "-", above=0.0, at_most=1.0, error=AudioError)
    rate = clip.sample_rate_hz
    converted = convert_clip(clip, converter, context)
    seam = find_seam(clip.samples, rate, converted.samples)
    audible = apply_seam(clip.samples, seam)
    tactile = apply_seam(converted.samples, replace(seam, law=_law(converted.samples, seam)))
    for name, loop in (("sound", audible), ("tactile signal", tactile)):
        if not loop.any():
            raise AudioError(f"{clip.credit.title!r}: the {name} is silent. Choose another sound or converter.")
    return HapticLoop(
        replace(clip, samples=_with_peak(audible, 10 ** (AUDIBLE_PEAK_DBFS / 20))),
        replace(clip, samples=_with_peak(tactile, intensity * 10 ** (-TACTILE_HEADROOM_DB / 20))),
        analysis.dominant_frequency_hz(audible, rate, range_hz=AUDIBLE_RANGE_HZ),
        analysis.dominant_frequency_hz(tactile, rate),
    )


def find_seam(samples: ArrayLike, sample_rate_hz: float, *others: ArrayLike) -> Seam:
    """The best place to close a sound (n,) into a loop; `others` are signals of the same length that shall share it.

    For twelve starts and every length from half to all of what is left behind them, likeness is that of the stretches
    to be faded, 2 <a, b> / (<a, a> + <b, b>): 1 where they are equal, less where shape *or level* differ; averaged
    over the signals. The law follows from the first signal.
    Raises: AudioError: the sound is shorter than `MIN_CLIP_S`, or the others are not as long as it is.
    """
    rate = checks.number("sample_rate_hz", sample_rate_hz, "Hz", above=0.0, error=AudioError)
    signals = [_centred(signal) for signal in (samples, *others)]
    n = len(signals[0])
    shortest_s = max(MIN_CLIP_S, _FEWEST_SAMPLES / rate)
    checks.number("duration", n / rate, "s", at_least=shortest_s, error=AudioError, hint="Use a longer sound.")
    if any(len(signal) != n for signal in signals):
        raise AudioError(
            f"the signals have {[len(x) for x in signals]} samples; a shared seam wants them equally long."
        )
    crossfade = max(1, min(round(CROSSFADE_S * rate), n // 8))
    usable = min(n, round(MAX_LOOP_S * rate) + crossfade)
    offset = (n - usable) // 2
    found: list[tuple[float, int, int]] = []  # likeness, length, start
    for start in (k * usable // (4 * _N_STARTS) for k in range(_N_STARTS)):
        shortest = max(crossfade, round(_SHORTEST_SHARE * (usable - start - crossfade)))
        stretch = slice(offset + start, offset + usable)
        likeness = np.mean([_likeness(x[stretch], crossfade, shortest) for x in signals], axis=0)
        longest = int(np.flatnonzero(likeness >= likeness.max() - _AS_GOOD)[-1])
        found.append((float(likeness.max()), shortest + longest, offset + start))
    best = max(likeness for likeness, _, _ in found)
    _, length, start = max((seam for seam in found if seam[0] >= best - _AS_GOOD), key=lambda seam: (seam[1], -seam[2]))
    seam = Seam(start, length, crossfade, "linear")
    return replace(seam, law=_law(signals[0], seam))


def apply_seam(samples: ArrayLike, seam: Seam) -> Samples:
    """The loop (seam.length,) that a seam cuts from a signal (n,). Raises: AudioError: it is too short for the seam."""
    x = np.asarray(samples, dtype=np.float64)
    if x.ndim != 1 or len(x) < seam.n_samples_needed:
        raise AudioError(
            f"samples has shape {x.shape}; this seam needs one channel of {seam.n_samples_needed} samples."
        )
    loop = x[seam.start : seam.start + seam.length].copy()
    rising = np.arange(seam.crossfade) / max(1, seam.crossfade)
    behind = x[seam.start + seam.length : seam.n_samples_needed]
    if seam.law == "linear":
        w_in, w_out = rising, 1.0 - rising
    else:
        w_in, w_out = np.sin(0.5 * np.pi * rising), np.cos(0.5 * np.pi * rising)
    loop[: seam.crossfade] = w_in * loop[: seam.crossfade] + w_out * behind
    return loop.astype(np.float32)


def _likeness(x: NDArray[np.float64], width: int, shortest: int) -> NDArray[np.float64]:
    """How alike the first `width` samples are to as many at `shortest`, `shortest` + 1, ... up to the end.

    Each stretch counts without its own mean, or silence beside an offset would be the perfect seam.
    """
    template = x[:width] - x[:width].mean()
    rest = x[shortest:]
    sums = np.cumsum(np.concatenate([[0.0], rest]))
    squares = np.cumsum(np.concatenate([[0.0], rest**2]))
    energies = squares[width:] - squares[:-width] - (sums[width:] - sums[:-width]) ** 2 / width
    total = template @ template + energies
    products = correlate(rest, template, mode="valid", method="fft")
    has_sound = total > _SILENT * squares[-1]
    return np.where(has_sound, 2 * products / np.where(has_sound, total, 1.0), 0.0)


def _law(samples: ArrayLike, seam: Seam) -> FadeLaw:
    """Linear where the faded stretches correlate, equal-power where they do not."""
    x = _centred(samples)
    a = x[seam.start : seam.start + seam.crossfade]
    b = x[seam.start + seam.length : seam.n_samples_needed]
    return "linear" if a @ b > _ALIKE * np.sqrt((a @ a) * (b @ b)) else "equal-power"


def _centred(samples: ArrayLike) -> NDArray[np.float64]:
    """Without its mean: an offset correlates with itself everywhere and would drown the search."""
    x = np.asarray(samples, dtype=np.float64)
    if x.ndim != 1 or x.size == 0:
        raise AudioError(f"samples has shape {x.shape}; a loop is cut from one channel, (n,).")
    return np.asarray(x - x.mean())


def _with_peak(samples: Samples, peak: float) -> Samples:
    return np.asarray(samples * (peak / np.abs(samples).max().astype(np.float64)), dtype=np.float32)
