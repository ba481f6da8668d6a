"""Speed of a machine over time, relative to steady running, from the common motion of its spectral lines.

A machine's lines are at fixed multiples of its speed: a line at f_i in steady running is at r f_i at the relative speed
r. The score of r in a frame is the mean height of the spectrum at r f_i above the noise floor, less that of the whole
spectrum [dB]. The track is the path with the highest sum of scores (Viterbi) that ends at r = 1. The track rises by at
most three times the mean rate and hardly falls, since it must not jump to half the speed, where harmonics coincide as
well. Mains hum, which is constant, is one line of many.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view

from scene2hap.audio.spectra.components import components, magnitudes
from scene2hap.audio.spectra.windows import hann
from scene2hap.common.arrays import Floats, Indices

LINES_HZ = (20.0, 1000.0)
FAINTEST_LINE_DB = -30.0
"""Level of the faintest line used, relative to the strongest [dB]."""
CLEAR_DB, BY_CHANCE_DB = 4.0, 4.0
"""A frame shows the speed if its score exceeds CLEAR_DB + BY_CHANCE_DB / n for n lines [dB]. In white noise the best
path scores at most 6.9 for one line, 5.1 for two, and 2.8 for eight, over 30 draws."""
STEADY_WITHIN = 0.03
"""Median difference from full speed below which the pitch counts as constant [-]."""
LEAST_SHARE = 0.4
"""Least share of a rise in which frames must show the speed; otherwise it is unknown [-]."""
SHORTEST_S = 0.5
"""Shortest rise with a moving pitch [s]; in a shorter one, lines move further within a frame than their distance."""

_HOP_S = 0.02
_FRAME_S, _FRAMES_PER_RISE = (0.128, 0.256), 12
"""Bounds of the frame length [s], and frames per rise. In longer frames lines move; in shorter ones they merge."""
_STEP = 0.01
_SPEEDS = np.arange(0.15, 1.1 + _STEP / 2, _STEP)
_FULL, _NEAR_FULL = int(np.argmin(np.abs(_SPEEDS - 1.0))), 3
_STEEPEST = 3.0
"""Steepest rise of a track, as a multiple of the mean rate [-]. A motor with the speed x (2 - x) begins with twice the
mean rate."""
_FALLS = 1
"""Steps of the grid that a track may fall in a frame, to allow for rounding to the grid."""
_HIGHEST_DB = 40.0
_PADDING = 4
_BLOCK, _GROUND_PERCENTILE = 16, 25.0
"""Unpadded bins over which the noise floor is taken, and its percentile, which stays below dense lines."""
_LOBE = 2.0
"""Half the main lobe of a Hann window [bins]; a lower line would merge with the end of the spectrum."""


class SpeedTrack(NamedTuple):
    """Times (n,) [s] of frames that show the speed, and the speed relative to steady running (n,) [-]."""

    at_s: Floats
    speed: Floats

    @property
    def is_constant(self) -> bool:
        """True if the pitch stays constant."""
        return bool(np.median(np.abs(self.speed - 1.0)) <= STEADY_WITHIN)


def track_speed(
    samples: Floats, sample_rate_hz: float, rise_s: tuple[float, float], steady_s: tuple[float, float]
) -> SpeedTrack | None:
    """Track the speed over a rise in a recording (n,).

    Parameters: rise_s, steady_s : begin and end of the rise and of steady running [s].
    Returns: None if steady running has no lines, or if too few frames of the rise show the speed.
    """
    begin, end = (round(time_s * sample_rate_hz) for time_s in steady_s)
    range_hz = LINES_HZ[0], min(LINES_HZ[1], 0.45 * sample_rate_hz)
    found = components(magnitudes(samples[begin:end]), sample_rate_hz, range_hz, FAINTEST_LINE_DB)
    lines_hz = np.array([one.hz for one in found if one.is_line])
    length_s = rise_s[1] - rise_s[0]
    size = round(float(np.clip(length_s / _FRAMES_PER_RISE, *_FRAME_S)) * sample_rate_hz)
    hop = max(1, round(_HOP_S * sample_rate_hz))
    first = max(0, round(rise_s[0] * sample_rate_hz) - size // 2)
    last = min(len(samples), round(rise_s[1] * sample_rate_hz) + 2 * size)
    if not lines_hz.size or last - first < 2 * size:
        return None
    at = np.arange(first, last - size + 1, hop)
    score = _scores(samples, at, size, sample_rate_hz, lines_hz)
    path, clear_db = _best_path(score, max(1, math.ceil(_STEEPEST * _HOP_S / length_s / _STEP)))
    unclear = np.flatnonzero(
        (clear_db < CLEAR_DB + BY_CHANCE_DB / len(lines_hz)) | (path * lines_hz.min() < _LOBE * sample_rate_hz / size)
    )
    clear = slice(int(unclear[-1]) + 1 if unclear.size else 0, None)
    track = SpeedTrack((at + _centres(samples, at, size))[clear] / sample_rate_hz, path[clear])
    clear_s = np.count_nonzero(track.at_s < rise_s[1]) * hop / sample_rate_hz
    is_shown = clear_s >= LEAST_SHARE * length_s and (track.is_constant or length_s >= SHORTEST_S)
    return track if is_shown else None


def _centres(x: Floats, at: Indices, size: int) -> Floats:
    """Return the centre of energy of each windowed frame (n_frames,) [samples], which is late while the level rises."""
    energy = (sliding_window_view(x, size)[at] * hann(size)) ** 2 + 1e-30
    return np.asarray(energy @ np.arange(size) / energy.sum(axis=1))


def _scores(x: Floats, at: Indices, size: int, rate: float, lines_hz: Floats) -> Floats:
    """Return the score of each frame and speed (n_frames, n_speeds) [dB]."""
    n = scipy.fft.next_fast_len(_PADDING * size, real=True)
    frames = sliding_window_view(x, size)[at]
    window = hann(size)
    spectrum = np.abs(scipy.fft.rfft((frames - frames.mean(axis=1, keepdims=True)) * window, n, axis=1))
    top = min(spectrum.shape[1], int(1.2 * LINES_HZ[1] * n / rate) + 1)
    level_db = 20 * np.log10(np.maximum(spectrum[:, :top], 1e-12))
    over_db = np.clip(level_db - _ground_db(level_db, _BLOCK * _PADDING), 0.0, _HIGHEST_DB)
    over_db -= over_db.mean(axis=1, keepdims=True)
    bins = np.outer(_SPEEDS, lines_hz) * n / rate
    low = np.clip(np.floor(bins).astype(np.intp), 0, top - 2)
    share = np.clip(bins - low, 0.0, 1.0)
    return np.asarray((over_db[:, low] * (1 - share) + over_db[:, low + 1] * share).mean(axis=2))


def _ground_db(level_db: Floats, width: int) -> Floats:
    """Return the noise floor of spectra (n_frames, n_bins) [dB], interpolated between the middles of blocks."""
    n_frames, n = level_db.shape
    n_blocks = max(1, n // width)
    blocks = level_db[:, : n_blocks * width].reshape(n_frames, n_blocks, -1) if n >= width else level_db[:, None]
    ground = np.percentile(blocks, _GROUND_PERCENTILE, axis=2)
    middles = (np.arange(n_blocks) + 0.5) * width
    at = np.clip((np.arange(n) - middles[0]) / width, 0, n_blocks - 1)
    low = np.minimum(at.astype(int), max(0, n_blocks - 2))
    share = at - low
    return np.asarray(ground[:, low] * (1 - share) + ground[:, np.minimum(low + 1, n_blocks - 1)] * share)


def _best_path(score: Floats, steps: int) -> tuple[Floats, Floats]:
    """Return speed and score of each frame (n_frames,) on the best path that ends near full speed, and rises by at most
    `steps` of the grid per frame."""
    n_frames, n = score.shape
    speeds = np.arange(n)
    best = np.where(np.abs(speeds - _FULL) <= _NEAR_FULL, score[-1], -np.inf)
    next_speed = np.zeros((n_frames, n), dtype=np.intp)
    moves = np.arange(-_FALLS, steps + 1)
    for t in range(n_frames - 2, -1, -1):  # backwards: best[k] is the highest sum of scores after t, from speed k on
        padded = np.concatenate([np.full(_FALLS, -np.inf), best, np.full(steps, -np.inf)])
        options = sliding_window_view(padded, len(moves))
        chosen = options.argmax(axis=1)
        next_speed[t] = speeds + moves[chosen]
        best = score[t] + options[speeds, chosen]
    path = np.empty(n_frames, dtype=np.intp)
    path[0] = int(np.argmax(best))
    for t in range(1, n_frames):
        path[t] = next_speed[t - 1, path[t - 1]]
    return _SPEEDS[path], score[np.arange(n_frames), path]
