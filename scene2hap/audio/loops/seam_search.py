"""Search for the seam of a loop: a place where a sound continues as it began.

The similarity of two stretches with spectra A and B is averaged over all signals that share the seam:

    (2 Re sum(W A* B) + e) / (sum(W |A|^2) + sum(W |B|^2) + e)

It is 1 if they are equal, less if shape *or level* differ. W is the sound's mean power spectrum. Without this weight,
chance similarity of hiss would decide, and a hum below the hiss would wrap out of phase. e is 2 % of the mean energy of
a stretch. Without e, inaudible sound would decide about a seam in a pause. The search takes two steps:

1. coarse, at 8 kHz: twelve starts, and for each start every length from half to all of the sound behind it;
2. at the full rate: those lengths for which a cosine through a peak of the coarse curve is highest at a whole number
   of samples.

If the level is periodic, as that of a ringing phone, lengths of whole periods are preferred. A seam within a ring would
make that ring longer or shorter than the others.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray

from scene2hap.audio.seam import QUIET, Seam
from scene2hap.audio.spectra.windows import hann
from scene2hap.common import checks
from scene2hap.errors import AudioError

Signal = NDArray[np.float64]
Candidate = tuple[float, int, int]
"""Similarity [-], length and start [samples] of a seam."""

MIN_CLIP_S = 0.1
"""Shortest clip that can be looped [s] (assumed: a shorter loop is felt as a tone of its own, above 10 Hz)."""
MAX_LOOP_S = 10.0
"""Longest loop [s], cut from the middle of a longer sound (assumed: a repetition after 10 s is not noticed)."""
CROSSFADE_S = 0.2
"""Length of the fade and of the compared stretches [s]; at most an eighth of the clip (assumed: four cycles at
20 Hz)."""

_SHORTEST_SHARE = 0.5
"""Shortest length that is searched, as a share of what lies behind a start [-] (assumed: a short loop repeats soon)."""
_EDGE_S, _EDGE_SHARE = 0.02, 0.02
"""Time [s] that is skipped at either end, where filters settle and recordings are faded; at most this share of the
sound [-]. Assumed."""
_N_STARTS = 12
"""Starts of the first step, evenly in the first quarter of the sound (assumed)."""
_FEWEST_SAMPLES = 16
"""Fewest samples of a sound, and of its coarse copy, for which spectra of stretches exist."""
_COARSE_HZ = 8000.0
"""Sample rate of the first step [Hz]: above twice the frequencies at which most sounds have their energy (assumed)."""
_N_REFINED = 96
"""Candidates of the second step. For a tone of 1 kHz at 16 kHz one length in twenty wraps within half a degree; the
candidates must include some of these lengths."""
_AS_GOOD = 3e-5
"""Largest difference between similarities that count as equal; of equal ones, the longest loop is chosen. A phase error
of 0.44 degrees in a tone gives this difference."""
_LONG_SHARES, _WORTH = (0.8, 0.65), 0.5
"""A loop that is longer than this share of the clip, or that keeps the beat, is preferred if its dissimilarity exceeds
the least one by at most half. In noise all seams are equally good, and the repetition of a longer loop is noticed
later. A rhythm has few good seams."""
_UNNOTICED = 0.01
"""Loss of similarity up to which a seam that keeps the beat is preferred in any case. A tone 8 degrees out of phase
loses as much, and 0.02 dB in the fade. A ring that is a tenth of a second too long is noticed sooner."""
_LEVEL_STEP_S, _SHORTEST_PERIOD_S = 0.01, 0.2
"""Time resolution of the level, and shortest period of it [s]. Shorter periods fit into the compared stretches."""
_LEAST_DEPTH, _LEAST_LIKENESS, _TIE = 0.3, 0.8, 0.05
"""Bounds of a periodic level [-], assumed: least standard deviation over mean; least autocorrelation at one period;
largest difference from the best autocorrelation, up to which a shorter period is chosen."""
_PERIOD_TOLERANCE = 0.02
"""Largest difference from a whole number of periods [periods]. Touch notices a change of rate by 0.18."""
LEAST_POWER = 0.25
"""Least power of a loop, as a share of the sound's (assumed). Pauses are similar to each other, but a loop of pauses
would be silent."""
_SILENT = 1e-9
"""Share of the whole energy below which a similarity would be a ratio of rounding errors."""


def find_seam(samples: ArrayLike, sample_rate_hz: float, *others: ArrayLike) -> Seam:
    """Return the best seam of a sound (n,); `others` are signals of the same length that share it.

    The fade law follows from the first signal; `Seam.fitted` gives the law for the others. `MAX_LOOP_S` bounds the
    computing time, for a sound of any length.
    Raises: AudioError: the sound is shorter than `MIN_CLIP_S`, or the others have another length.
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
    fade = max(1, min(round(CROSSFADE_S * rate), n // 8))
    edge = round(min(_EDGE_S * rate, _EDGE_SHARE * n))
    usable = min(n - 2 * edge, round(MAX_LOOP_S * rate) + fade)
    offset = (n - usable) // 2
    cut = [signal[offset : offset + usable] for signal in signals]
    weights = [_mean_power(x, fade) for x in cut]
    period = level_period(cut[0], rate)
    found = _refined(cut, weights, fade, _promising(cut, weights, fade, min(1.0, _COARSE_HZ / rate), period))
    if period is not None:
        found = _preferred([seam for seam in found if _in_beat(seam[1], period)], found, _UNNOTICED)
    for share in _LONG_SHARES:
        long = _preferred([seam for seam in found if seam[1] >= share * (usable - fade)], found)
        if long is not found:
            found = long
            break
    best = max(likeness for likeness, _, _ in found)
    _, length, start = max((seam for seam in found if seam[0] >= best - _AS_GOOD), key=lambda seam: (seam[1], -seam[2]))
    return Seam(offset + start, length, fade, "linear").fitted(signals[0])


def _mean_power(x: Signal, width: int) -> Signal:
    """Return the mean power spectrum (width // 2 + 1,) of stretches of `width` samples, without offset, maximum 1."""
    frames = sliding_window_view(x, width)[:: max(1, width // 2)]
    power = np.mean(np.abs(scipy.fft.rfft(frames * hann(width), axis=1)) ** 2, axis=0)
    power[0] = 0.0
    return np.asarray(power / power.max() if power.any() else np.ones_like(power))


def _preferred(some: list[Candidate], found: list[Candidate], unnoticed: float = _AS_GOOD) -> list[Candidate]:
    """Return the candidates `some` if one of them is about as good as the best, else all candidates, `found`."""
    best, likest = (max((likeness for likeness, _, _ in seams), default=-1.0) for seams in (found, some))
    return some if likest >= best - max(unnoticed, _WORTH * (1.0 - best)) else found


def _in_beat(lengths: ArrayLike, period: float) -> NDArray[np.bool_]:
    """Return a mask of the lengths that are whole numbers of a period."""
    periods = np.asarray(lengths) / period
    return np.asarray(np.abs(periods - np.round(periods)) <= _PERIOD_TOLERANCE)


def level_period(x: Signal, rate: float) -> float | None:
    """Return the period of the level of a sound (n,) [samples]; None if the level is not periodic."""
    step = max(1, round(_LEVEL_STEP_S * rate))
    level = np.sqrt((x[: len(x) // step * step].reshape(-1, step) ** 2).mean(axis=1))
    n, shortest = len(level), round(_SHORTEST_PERIOD_S * rate / step)
    if n <= 4 * shortest or level.std() <= _LEAST_DEPTH * level.mean():
        return None
    level -= level.mean()
    products = scipy.fft.irfft(np.abs(scipy.fft.rfft(level, 2 * n)) ** 2)[: n // 2]
    energies = np.concatenate([[0.0], np.cumsum(level**2)])
    shifts = np.arange(n // 2)
    likeness = 2.0 * products / (energies[n - shifts] + energies[n] - energies[shifts])
    repeats = _peaks(likeness[shortest:-1]) + shortest
    repeats = repeats[likeness[repeats] >= max(_LEAST_LIKENESS, likeness[repeats].max(initial=0.0) - _TIE)]
    if repeats.size == 0:
        return None
    _, after = _at_whole_samples(likeness, repeats, 0, step)
    # The last repetition measures the period most exactly.
    return float(after[-1] / round(after[-1] / after[0]))


def _promising(
    signals: Sequence[Signal], weights: Sequence[Signal], fade: int, ratio: float, period: float | None
) -> NDArray[np.int64]:
    """Return starts and lengths (n, 2) [samples] for the second step, best first."""
    size = scipy.fft.next_fast_len(len(signals[0]), real=True)
    coarse_size = scipy.fft.next_fast_len(max(_FEWEST_SAMPLES, round(ratio * size)), real=True)
    scale = size / coarse_size
    n = int(len(signals[0]) / scale)
    width = max(1, round(fade / scale))
    starts = np.array([k * n // (4 * _N_STARTS) for k in range(_N_STARTS)])
    likeness = np.zeros((_N_STARTS, n - width + 1))
    for x, weight in zip(signals, weights, strict=True):
        spectrum = scipy.fft.rfft(x, size)
        # Here a zero-phase filter with the root of the weights replaces them. It blurs the ends; `_refined` is exact.
        root = np.interp(np.linspace(0, 1, len(spectrum)), np.linspace(0, 1, len(weight)), np.sqrt(weight))
        plain, strong = (scipy.fft.irfft(part, coarse_size)[:n] for part in (spectrum, spectrum * root))
        likeness = likeness + _likeness(strong, plain, width, starts) / len(signals)
    found = []
    for row, start in zip(likeness, starts, strict=True):
        shortest = max(width, round(_SHORTEST_SHARE * (n - start - width)))
        curve = row[start + shortest :]
        peaks = _peaks(curve)
        heights, lengths = _at_whole_samples(curve, peaks, shortest, scale)
        found.append(np.stack([heights, np.full(len(peaks), round(start * scale)), lengths], axis=1))
    rows = np.concatenate(found)
    full = _has_sound(signals, fade, rows[:, 1], rows[:, 2])
    rows = rows[full] if full.any() else rows
    # Of equal similarities, the longer loop comes first: its repetition is noticed later.
    order = np.lexsort((-rows[:, 2], -np.round(rows[:, 0] / _AS_GOOD)))
    length, longest = rows[order, 2], len(signals[0]) - fade
    wanted = [length >= share * longest for share in (*_LONG_SHARES, 0.0)]
    if period is not None:
        wanted += [_in_beat(length, period) & long for long in wanted]
    chosen = [order[mask][:_N_REFINED] for mask in wanted]
    return rows[np.concatenate(chosen), 1:].astype(np.int64)


def _has_sound(signals: Sequence[Signal], settling: int, starts: Signal, lengths: Signal) -> NDArray[np.bool_]:
    """Return a mask (n,) of the loops with at least `LEAST_POWER` of the mean power of every signal.

    The first signal is the sound. The others were converted from it, and their first `settling` samples do not count:
    a converter responds to the onset of a steady tone with a burst that can exceed the rest of the signal. If it
    counted, every loop would begin in that burst.
    """
    enough = np.ones(len(starts), dtype=bool)
    for place, x in enumerate(signals):
        skipped = settling if place > 0 else 0
        energy = np.concatenate([[0.0], np.cumsum(x[skipped:] ** 2)])
        first, end = (
            np.clip(edge.astype(np.int64) - skipped, 0, len(x) - skipped) for edge in (starts, starts + lengths)
        )
        enough &= (energy[end] - energy[first]) * (len(x) - skipped) >= LEAST_POWER * (end - first) * energy[-1]
    return enough


def _likeness(x: Signal, plain: Signal, width: int, starts: NDArray[np.int64]) -> Signal:
    """Return the similarity (n_starts, n - width + 1) of the stretches of x (n,) at `starts` to all others; 0 where
    `plain` is silent in both."""
    size = scipy.fft.next_fast_len(len(x) + width, real=True)
    stretches = scipy.fft.rfft(x[starts[:, None] + np.arange(width)], size, axis=1)
    products = scipy.fft.irfft(stretches.conj() * scipy.fft.rfft(x, size), size, axis=1)[:, : len(x) - width + 1]
    energies, heard = _moving_energy(x, width), _moving_energy(plain, width)
    has_sound = heard[starts][:, None] + heard > _SILENT * (plain @ plain)
    quiet = 2.0 * QUIET * float(energies.mean())
    total = energies[starts][:, None] + energies + quiet
    return np.asarray(np.where(has_sound, (2.0 * products + quiet) / np.where(has_sound, total, 1.0), 0.0))


def _moving_energy(x: Signal, width: int) -> Signal:
    """Return the energy (n - width + 1,) of every stretch of `width` samples."""
    squares = np.cumsum(np.concatenate([[0.0], x**2]))
    return np.asarray(squares[width:] - squares[:-width])


def _peaks(curve: Signal) -> NDArray[np.int64]:
    """Return the indices of the local maxima of a curve, ends included."""
    padded = np.concatenate([[-np.inf], curve, [-np.inf]])
    return np.flatnonzero((padded[1:-1] >= padded[:-2]) & (padded[1:-1] > padded[2:]))


def _at_whole_samples(curve: Signal, peaks: NDArray[np.int64], first: int, scale: float) -> tuple[Signal, Signal]:
    """Return, for each peak, the best whole number of samples at the full rate, and the cosine's value there."""
    inner = np.clip(peaks, 1, max(1, len(curve) - 2))
    left, centre, right = (curve[np.clip(inner + step, 0, len(curve) - 1)] for step in (-1, 0, 1))
    centre = np.maximum(centre, 1e-9)
    turn = np.arccos(np.clip(0.5 * (left + right) / centre, 0.0, 1.0 - 1e-12))
    shift = np.clip(np.arctan2(0.5 * (right - left), centre * np.sin(turn)) / turn, -1.0, 1.0)
    place = first + inner + shift
    length = np.round(place * scale)
    return centre / np.cos(turn * shift) * np.cos(turn * (length / scale - place)), length


def _refined(
    signals: Sequence[Signal], weights: Sequence[Signal], fade: int, candidates: NDArray[np.int64]
) -> list[Candidate]:
    """Return similarity, length and start of each candidate."""
    starts, lengths = np.unique(candidates, axis=0).T
    lengths = np.clip(lengths, fade, len(signals[0]) - fade - starts)
    likeness = np.mean([_exactly(x, w, fade, starts, lengths) for x, w in zip(signals, weights, strict=True)], axis=0)
    return [(float(r), int(length), int(start)) for r, length, start in zip(likeness, lengths, starts, strict=True)]


def _exactly(x: Signal, weights: Signal, width: int, starts: NDArray[np.int64], lengths: NDArray[np.int64]) -> Signal:
    """Return the similarity (n,) of the stretches at `starts` and of those `lengths` behind them."""
    stretches, root = sliding_window_view(x, width), np.sqrt(weights)
    places, of_start = np.unique(starts, return_inverse=True)
    ahead, behind, frames = (
        _weighted(stretches[at], root) for at in (places, starts + lengths, slice(None, None, max(1, width // 2)))
    )
    total = _energies(ahead)[of_start] + _energies(behind)
    is_silent = total <= _SILENT * width * (x @ x) * np.mean(weights)
    quiet = 2.0 * QUIET * float(_energies(frames).mean())
    products = np.empty(len(starts))
    for place, spectrum in enumerate(ahead):  # few starts, many lengths behind each
        mine = of_start == place
        products[mine] = behind[mine] @ spectrum
    return np.where(is_silent, 0.0, (2.0 * products + quiet) / np.where(is_silent, 1.0, total + quiet))


def _weighted(stretches: Signal, root: Signal) -> Signal:
    """Return the spectra of stretches (n, width), times a gain, as rows of real and imaginary parts in turn."""
    spectra = scipy.fft.rfft(stretches, axis=1)
    spectra *= root
    return spectra.view(np.float64)


def _energies(rows: Signal) -> Signal:
    return np.asarray(np.einsum("ij,ij->i", rows, rows))


def _centred(samples: ArrayLike) -> Signal:
    """Return the samples without their mean: an offset correlates with itself everywhere and would mask the sound."""
    x = np.asarray(samples, dtype=np.float64)
    if x.ndim != 1 or x.size == 0:
        raise AudioError(f"samples has shape {x.shape}; a loop is cut from one channel, (n,).")
    return np.asarray(x - x.mean())
