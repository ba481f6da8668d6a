"""Similarity of two stretches of a sound, by which the seam of a loop is chosen.

    (2 Re sum(W A* B) + e) / (sum(W |A|^2) + sum(W |B|^2) + e)

A and B are their spectra. The similarity is 1 if they are equal, less if shape *or level* differ. W is the sound's mean
power spectrum. Without this weight, chance similarity of hiss would decide, and a hum below the hiss would wrap out of
phase. e is 2 % of the mean energy of a stretch. Without e, inaudible sound would decide about a seam in a pause.
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view

from scene2hap.audio.seam import QUIET
from scene2hap.audio.spectra.windows import hann
from scene2hap.common.arrays import Floats, Ints

_SILENT = 1e-9
"""Share of the whole energy below which a similarity would be a ratio of rounding errors."""


def mean_power(x: Floats, width: int) -> Floats:
    """Return W (width // 2 + 1,) for stretches of `width` samples of a sound (n,), without offset; its maximum is 1."""
    frames = sliding_window_view(x, width)[:: max(1, width // 2)]
    power = np.mean(np.abs(scipy.fft.rfft(frames * hann(width), axis=1)) ** 2, axis=0)
    power[0] = 0.0
    return np.asarray(power / power.max() if power.any() else np.ones_like(power))


def similarity_to_all(weighted: Floats, plain: Floats, width: int, starts: Ints) -> Floats:
    """Return the similarity (n_starts, n - width + 1) of the stretches at `starts` to all others.

    It is 0 where both are silent. Parameters: weighted : the sound (n,), filtered by the root of W, which replaces the
    weights; the filter blurs the ends of stretches. plain : the sound itself (n,).
    """
    size = scipy.fft.next_fast_len(len(weighted) + width, real=True)
    stretches = scipy.fft.rfft(weighted[starts[:, None] + np.arange(width)], size, axis=1)
    products = scipy.fft.irfft(stretches.conj() * scipy.fft.rfft(weighted, size), size, axis=1)
    energies, heard = _moving_energy(weighted, width), _moving_energy(plain, width)
    has_sound = heard[starts][:, None] + heard > _SILENT * (plain @ plain)
    quiet = 2.0 * QUIET * float(energies.mean())
    total = energies[starts][:, None] + energies + quiet
    twice = 2.0 * products[:, : len(weighted) - width + 1] + quiet
    return np.asarray(np.where(has_sound, twice / np.where(has_sound, total, 1.0), 0.0))


def similarity_at(x: Floats, weights: Floats, width: int, starts: Ints, lengths: Ints) -> Floats:
    """Return the exact similarity (n,) of the stretches at `starts` and of those `lengths` behind them."""
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


def _moving_energy(x: Floats, width: int) -> Floats:
    """Return the energy (n - width + 1,) of every stretch of `width` samples."""
    squares = np.cumsum(np.concatenate([[0.0], x**2]))
    return np.asarray(squares[width:] - squares[:-width])


def _weighted(stretches: Floats, root: Floats) -> Floats:
    """Return the spectra of stretches (n, width), times a gain, as rows of real and imaginary parts in turn."""
    spectra = scipy.fft.rfft(stretches, axis=1)
    spectra *= root
    return spectra.view(np.float64)


def _energies(rows: Floats) -> Floats:
    return np.asarray(np.einsum("ij,ij->i", rows, rows))
