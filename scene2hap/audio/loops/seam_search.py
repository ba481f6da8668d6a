"""Search for the seam of a loop: a place where a sound continues as it began.

A seam is as good as the two stretches that are cross-faded are similar (`similarity`), on average over all signals that
share the seam. The search takes two steps:

1. coarse, at 8 kHz: twelve starts, and for each start every length from half to all of the sound behind it;
2. at the full rate: those lengths for which a cosine through a peak of the coarse curve is highest at a whole number
   of samples.

If the level is periodic, as that of a ringing phone, lengths of whole periods are preferred. A seam within a ring would
make that ring longer or shorter than the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import ArrayLike

from scene2hap.audio.loops.curve_peaks import at_whole_samples, peaks
from scene2hap.audio.loops.level_period import are_whole_periods, level_period
from scene2hap.audio.loops.similarity import mean_power, similarity_at, similarity_to_all
from scene2hap.audio.seam import Seam
from scene2hap.common import checks
from scene2hap.common.arrays import Bools, Floats, Ints
from scene2hap.errors import AudioError

MIN_CLIP_S = 0.1
"""Shortest clip that can be looped [s] (assumed: a shorter loop is felt as a tone of its own, above 10 Hz)."""
MAX_LOOP_S = 10.0
"""Longest loop [s], cut from the middle of a longer sound (assumed: a repetition after 10 s is not noticed)."""
CROSSFADE_S = 0.2
"""Length of the fade and of the compared stretches [s]; at most an eighth of the clip (assumed: four cycles at
20 Hz)."""
LEAST_POWER = 0.25
"""Least power of a loop, as a share of the sound's (assumed). Pauses are similar to each other, but a loop of pauses
would be silent."""

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


class Candidate(NamedTuple):
    """A seam: the similarity of its stretches [-], the length and the start of its loop [samples]."""

    similarity: float
    length: int
    start: int


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
    weights = [mean_power(x, fade) for x in cut]
    period = level_period(cut[0], rate)
    found = _refined(cut, weights, fade, _coarse(cut, weights, fade, min(1.0, _COARSE_HZ / rate), period))
    best = _best(found, usable - fade, period)
    return Seam(offset + best.start, best.length, fade, "linear").fitted(signals[0])


def _coarse(
    signals: Sequence[Floats], weights: Sequence[Floats], fade: int, ratio: float, period: float | None
) -> Ints:
    """Return starts and lengths (n, 2) [samples] for the second step, best first."""
    size = scipy.fft.next_fast_len(len(signals[0]), real=True)
    coarse_size = scipy.fft.next_fast_len(max(_FEWEST_SAMPLES, round(ratio * size)), real=True)
    scale = size / coarse_size
    n = int(len(signals[0]) / scale)
    width = max(1, round(fade / scale))
    starts = np.array([k * n // (4 * _N_STARTS) for k in range(_N_STARTS)])
    similarity = np.zeros((_N_STARTS, n - width + 1))
    for x, weight in zip(signals, weights, strict=True):
        spectrum = scipy.fft.rfft(x, size)
        root = np.interp(np.linspace(0, 1, len(spectrum)), np.linspace(0, 1, len(weight)), np.sqrt(weight))
        plain, weighted = (scipy.fft.irfft(part, coarse_size)[:n] for part in (spectrum, spectrum * root))
        similarity = similarity + similarity_to_all(weighted, plain, width, starts) / len(signals)
    found = []
    for row, start in zip(similarity, starts, strict=True):
        shortest = max(width, round(_SHORTEST_SHARE * (n - start - width)))
        curve = row[start + shortest :]
        at = peaks(curve)
        heights, lengths = at_whole_samples(curve, at, shortest, scale)
        found.append(np.stack([heights, np.full(len(at), round(start * scale)), lengths], axis=1))
    rows = np.concatenate(found)
    full = _has_sound(signals, fade, rows[:, 1], rows[:, 2])
    rows = rows[full] if full.any() else rows
    # Of equal similarities, the longer loop comes first: its repetition is noticed later.
    order = np.lexsort((-rows[:, 2], -np.round(rows[:, 0] / _AS_GOOD)))
    length, longest = rows[order, 2], len(signals[0]) - fade
    wanted = [length >= share * longest for share in (*_LONG_SHARES, 0.0)]
    if period is not None:
        wanted += [are_whole_periods(length, period) & long for long in wanted]
    chosen = [order[mask][:_N_REFINED] for mask in wanted]
    return rows[np.concatenate(chosen), 1:].astype(np.int64)


def _has_sound(signals: Sequence[Floats], settling: int, starts: Floats, lengths: Floats) -> Bools:
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


def _refined(signals: Sequence[Floats], weights: Sequence[Floats], fade: int, coarse: Ints) -> list[Candidate]:
    """Return the candidates at starts and lengths (n, 2) [samples], with their exact similarity."""
    starts, lengths = np.unique(coarse, axis=0).T
    lengths = np.clip(lengths, fade, len(signals[0]) - fade - starts)
    each = [similarity_at(x, w, fade, starts, lengths) for x, w in zip(signals, weights, strict=True)]
    rows = zip(np.mean(each, axis=0), lengths, starts, strict=True)
    return [Candidate(float(r), int(length), int(start)) for r, length, start in rows]


def _best(found: list[Candidate], longest: int, period: float | None) -> Candidate:
    """Return the longest of the best candidates. Candidates that keep the beat are preferred, then long ones."""
    if period is not None:
        in_beat = [seam for seam in found if are_whole_periods(seam.length, period)]
        found = _preferred(in_beat, found, _UNNOTICED)
    for share in _LONG_SHARES:
        long = _preferred([seam for seam in found if seam.length >= share * longest], found)
        if long is not found:
            found = long
            break
    least = max(seam.similarity for seam in found) - _AS_GOOD
    return max((seam for seam in found if seam.similarity >= least), key=lambda seam: (seam.length, -seam.start))


def _preferred(some: list[Candidate], found: list[Candidate], unnoticed: float = _AS_GOOD) -> list[Candidate]:
    """Return the candidates `some` if one of them is about as good as the best, else all candidates, `found`."""
    best, best_of_some = (max((seam.similarity for seam in seams), default=-1.0) for seams in (found, some))
    return some if best_of_some >= best - max(unnoticed, _WORTH * (1.0 - best)) else found


def _centred(samples: ArrayLike) -> Floats:
    """Return the samples without their mean: an offset correlates with itself everywhere and would mask the sound."""
    x = np.asarray(samples, dtype=np.float64)
    if x.ndim != 1 or x.size == 0:
        raise AudioError(f"samples has shape {x.shape}; a loop is cut from one channel, (n,).")
    return np.asarray(x - x.mean())
