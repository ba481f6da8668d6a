"""The frequency of a signal over time: a ridge of its short-time spectrum.

The ridge is the path through the spectrum with the highest sum of levels in decibels. A change of frequency costs
`JUMP_DB` per octave (dynamic programming; Carmona, Hwang and Torresani 1999, with another penalty). So a hum keeps its
pitch in noise, and a gliding tone is followed.
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import NDArray

from scene2hap.audio.spectra.windows import hann
from scene2hap.common.arrays import Floats

WINDOW_S = 0.1
"""Length of the window [s]: it resolves frequencies from 20 Hz up, in steps that touch hardly distinguishes."""
STEP_S = 0.025
RANGE_HZ = (20.0, 1000.0)
PER_OCTAVE = 24
JUMP_DB = 60.0
"""Cost of a change by an octave [dB] (tuned on recordings: hums in noise keep their pitch)."""
_FLOOR_DB = -60.0


def ridge_hz(samples: Floats, sample_rate_hz: float, times_s: Floats, *, is_loop: bool) -> Floats:
    """Return the frequency (n,) [Hz] of a signal (n_samples,) at times (n,) [s], within `RANGE_HZ`."""
    starts, levels, grid = _levels(samples, sample_rate_hz, is_loop=is_loop)
    path = _best_path(levels, grid)
    return np.exp(np.interp(times_s, starts, np.log(_refined(levels, grid, path))))


def _levels(samples: Floats, sample_rate_hz: float, *, is_loop: bool) -> tuple[Floats, Floats, Floats]:
    """Return times of the windows (m,), their level by frequency (m, k) [dB], and the frequencies (k,) [Hz]."""
    half = round(WINDOW_S * sample_rate_hz / 2)
    padded = np.pad(samples, half, mode="wrap" if is_loop else "constant")
    hop = max(1, round(STEP_S * sample_rate_hz))
    firsts = np.arange(0, len(samples), hop)
    frames = np.lib.stride_tricks.sliding_window_view(padded, 2 * half)[firsts] * hann(2 * half)
    n = scipy.fft.next_fast_len(8 * half, real=True)
    power = np.abs(scipy.fft.rfft(frames, n, axis=1)) ** 2
    bins = np.arange(power.shape[1]) * sample_rate_hz / n
    top = min(RANGE_HZ[1], 0.45 * sample_rate_hz)
    octaves = np.log2(top / RANGE_HZ[0])
    grid = RANGE_HZ[0] * 2.0 ** (np.arange(int(octaves * PER_OCTAVE) + 1) / PER_OCTAVE)
    loudest = max(float(power.max()), 1e-30)
    decibels = 10.0 * np.log10(np.maximum(power / loudest, 10.0 ** (_FLOOR_DB / 10)))
    below = np.minimum((grid / bins[1]).astype(int), len(bins) - 2)
    share = grid / bins[1] - below
    levels = decibels[:, below] * (1.0 - share) + decibels[:, below + 1] * share
    return firsts / sample_rate_hz, levels, grid


def _best_path(levels: Floats, grid: Floats) -> NDArray[np.intp]:
    k = np.arange(len(grid))
    cost = JUMP_DB / PER_OCTAVE * np.abs(k[:, None] - k[None, :])
    total = levels[0].copy()
    before = np.empty(levels.shape, dtype=np.intp)
    for row, level in enumerate(levels):
        if row:
            reached = total[None, :] - cost
            before[row] = reached.argmax(axis=1)
            total = level + reached[k, before[row]]
    path = np.empty(len(levels), dtype=np.intp)
    path[-1] = total.argmax()
    for row in range(len(levels) - 1, 0, -1):
        path[row - 1] = before[row, path[row]]
    return path


def _refined(levels: Floats, grid: Floats, path: NDArray[np.intp]) -> Floats:
    """Return frequencies between those of the grid, by a parabola through three levels."""
    inner = np.clip(path, 1, len(grid) - 2)
    rows = np.arange(len(path))
    a, b, c = levels[rows, inner - 1], levels[rows, inner], levels[rows, inner + 1]
    bend = a - 2.0 * b + c
    offset = np.where(bend < -1e-9, 0.5 * (a - c) / np.where(bend < -1e-9, bend, -1.0), 0.0)
    return np.asarray(grid[inner] * 2.0 ** (np.clip(offset, -0.5, 0.5) / PER_OCTAVE))
