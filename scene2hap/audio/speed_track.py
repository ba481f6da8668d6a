"""Speed of a machine over time re steady running, from how its lines move together in a recording.

A machine's lines lie at fixed multiples of its speed. The lines of steady running, at f_i, are at r f_i while it runs
at r of that speed. By frame t and speed r, the score is the mean over the lines of how far the spectrum at r f_i rises
above the median around it; the track is the path of the highest sum of scores (Viterbi) that ends at r = 1. It may
climb by no more than a few times the mean rate and hardly fall: harmonics of one machine coincide at half its speed,
which a track cannot jump to.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.fft
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from scene2hap.audio.components import components, magnitudes

Signal = NDArray[np.float64]

LINES_HZ = (20.0, 1000.0)
FAINTEST_LINE_DB = -30.0
HOP_S = 0.02
FRAME_S = (0.128, 0.256)
FRAMES_PER_RISE = 8
"""Frames are so many to a rise, within the bounds above: in a longer one a line moves on, a shorter one blurs lines."""
STEP = 0.01
_SPEEDS = np.arange(0.15, 1.1 + STEP / 2, STEP)
_STEEPEST = 3.0
"""Times the mean rate. A motor that nears its speed as x (2 - x) begins with twice the mean rate."""
_FALLS = 1
"""Steps per frame that a track may fall, for the grid's sake."""
_HIGHEST_DB = 40.0
_PADDING = 4
BLOCK = 16
GROUND = 25.0
CLEAR_DB = 4.0
"""Mean score above which a frame tells the speed [dB]; the mean of the strongest of noise along a path stays below."""
_STEADY_WITHIN = 0.03


class SpeedTrack(NamedTuple):
    """Times (n,) [s] at which a recording tells the speed, and the speed re steady running (n,) [-]."""

    at_s: Signal
    speed: Signal

    @property
    def is_constant(self) -> bool:
        """Whether the machine keeps its pitch all along."""
        return bool(np.median(np.abs(self.speed - 1.0)) <= _STEADY_WITHIN)


def track_speed(
    samples: Signal, sample_rate_hz: float, rise_s: tuple[float, float], steady_s: tuple[float, float]
) -> SpeedTrack | None:
    """The speed over a rise, of a recording (n,) of which the rise and the steady part are known [s].

    None where steady running has no lines, or they cannot be followed over half of the rise.
    """
    begin, end = (round(t * sample_rate_hz) for t in steady_s)
    steady = samples[begin:end]
    found = components(
        magnitudes(steady), sample_rate_hz, (LINES_HZ[0], min(LINES_HZ[1], 0.45 * sample_rate_hz)), FAINTEST_LINE_DB
    )
    lines_hz = np.array([one.hz for one in found if one.is_line])
    if not lines_hz.size:
        return None
    length_s = rise_s[1] - rise_s[0]
    frame_s = float(np.clip(length_s / FRAMES_PER_RISE, *FRAME_S))
    size, hop = round(frame_s * sample_rate_hz), max(1, round(HOP_S * sample_rate_hz))
    first = max(0, round((rise_s[0]) * sample_rate_hz) - size // 2)
    last = min(len(samples), round(rise_s[1] * sample_rate_hz) + 2 * size)
    if last - first < 2 * size:
        return None
    at = np.arange(first, last - size + 1, hop)
    score = _scores(samples, at, size, sample_rate_hz, lines_hz)
    steps = max(1, int(np.ceil(_STEEPEST * HOP_S / length_s / STEP)))
    path, clear = _best_path(score, steps)
    told = np.flatnonzero((clear < CLEAR_DB) | (path * lines_hz.min() < 2.0 / frame_s))
    start = 0 if not told.size else int(told[-1]) + 1
    at_s = (at[start:] + size / 2) / sample_rate_hz
    n_in = int(np.count_nonzero(at_s < rise_s[1]))
    if n_in * hop / sample_rate_hz < 0.4 * length_s:
        return None
    return SpeedTrack(at_s, path[start:])


def _scores(x: Signal, at: NDArray[np.intp], size: int, rate: float, lines_hz: Signal) -> Signal:
    """By frame and speed (n_frames, n_speeds) [dB]."""
    n = scipy.fft.next_fast_len(_PADDING * size, real=True)
    frames = sliding_window_view(x, size)[at]
    window = np.hanning(size + 2)[1:-1]
    spectrum = np.abs(scipy.fft.rfft((frames - frames.mean(axis=1, keepdims=True)) * window, n, axis=1))
    top = min(spectrum.shape[1], int(1.2 * LINES_HZ[1] * n / rate) + 1)
    level_db = 20 * np.log10(np.maximum(spectrum[:, :top], 1e-12))
    over_db = np.clip(level_db - _ground_db(level_db, BLOCK * _PADDING), 0.0, _HIGHEST_DB)
    over_db -= over_db.mean(axis=1, keepdims=True)
    bins = np.outer(_SPEEDS, lines_hz) * n / rate
    low = np.clip(np.floor(bins).astype(np.intp), 0, top - 2)
    share = np.clip(bins - low, 0.0, 1.0)
    return (over_db[:, low] * (1 - share) + over_db[:, low + 1] * share).mean(axis=2)


def _ground_db(level_db: Signal, width: int) -> Signal:
    n_frames, n = level_db.shape
    n_blocks = max(1, n // width)
    blocks = level_db[:, : n_blocks * width].reshape(n_frames, n_blocks, -1) if n >= width else level_db[:, None]
    ground = np.percentile(blocks, GROUND, axis=2)
    middles = (np.arange(n_blocks) + 0.5) * width
    at = np.clip((np.arange(n) - middles[0]) / width, 0, n_blocks - 1)
    low = np.minimum(at.astype(int), max(0, n_blocks - 2))
    share = at - low
    return ground[:, low] * (1 - share) + ground[:, np.minimum(low + 1, n_blocks - 1)] * share


def _best_path(score: Signal, steps: int) -> tuple[Signal, Signal]:
    """Speed and score by frame (n_frames,) of the best path that ends at full speed."""
    n_frames, n = score.shape
    full = int(np.argmin(np.abs(_SPEEDS - 1.0)))
    best = np.where(np.abs(np.arange(n) - full) <= 3, score[-1], -np.inf)
    came = np.zeros((n_frames, n), dtype=np.intp)
    # Read backwards: from a later frame's speed k + d, d steps above this frame's.
    moves = np.arange(-_FALLS, steps + 1)
    for t in range(n_frames - 2, -1, -1):
        padded = np.concatenate([np.full(_FALLS, -np.inf), best, np.full(steps, -np.inf)])
        options = sliding_window_view(padded, len(moves))
        chosen = options.argmax(axis=1)
        came[t] = np.arange(n) + moves[chosen]
        best = score[t] + options[np.arange(n), chosen]
    k = int(np.argmax(best))
    path = np.empty(n_frames, dtype=np.intp)
    for t in range(n_frames):
        path[t] = k
        k = int(came[t, k]) if t < n_frames - 1 else k
    return _SPEEDS[path], score[np.arange(n_frames), path]
