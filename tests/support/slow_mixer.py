"""Reference mixer: written from the definition, in double precision, without the library's code."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.signal import upfirdn

Changes = list[tuple[int, NDArray[np.float32]]]


def kaiser_low_pass(rate_in_hz: int, rate_out_hz: int) -> tuple[NDArray[np.float64], int]:
    """Windowed sinc at rate up * rate_in_hz from Kaiser's formulas for 82 dB, and `up`; each phase sums to 1."""
    up = rate_out_hz // math.gcd(rate_in_hz, rate_out_hz)
    if rate_in_hz == rate_out_hz:
        return np.ones(1), 1
    stop_hz = rate_in_hz / 2
    pass_hz = min(1000.0, 0.8 * stop_hz)
    nyquist_hz = rate_in_hz * up / 2
    n = math.ceil((82 - 7.95) / (2.285 * math.pi * (stop_hz - pass_hz) / nyquist_hz) + 1)
    n = math.ceil(n / up) * up
    at = np.arange(n) - (n - 1) / 2
    h = np.sinc(at * (stop_hz + pass_hz) / 2 / nyquist_hz) * np.kaiser(n, 0.1102 * (82 - 8.7))
    phases = h.reshape(-1, up)
    return (phases / phases.sum(axis=0)).ravel(), up


def slow_mix(
    loops: list[NDArray[np.float64]],
    changes: Changes,
    n_frames: int,
    n_hands: int,
    *,
    ramp: int,
    rate_in_hz: int,
    rate_out_hz: int,
) -> NDArray[np.float64]:
    """Mix `loops` (one row per band of a source, each with its period) under changes (frame, gains (hands, rows)).

    Works sample by sample: each change of gains follows a raised cosine. Then scipy's polyphase filter and the limiter.
    """
    n_ticks = -(-n_frames * rate_in_hz // rate_out_hz)
    mix = np.zeros((n_ticks, n_hands))
    for t in range(n_ticks):
        gains = before = np.zeros((n_hands, len(loops)))
        for frame, target in changes:
            start = math.ceil(frame * rate_in_hz / rate_out_hz)
            phase = min(max((t - start + 1) / ramp, 0.0), 1.0)
            gains = gains + (target - before) * (0.5 - 0.5 * math.cos(math.pi * phase))
            before = target.astype(np.float64)
        mix[t] = gains @ [loop[t % len(loop)] for loop in loops]
    h, up = kaiser_low_pass(rate_in_hz, rate_out_hz)
    down = rate_in_hz // math.gcd(rate_in_hz, rate_out_hz)
    out = upfirdn(h, mix, up, down, axis=0)[:n_frames]
    threshold, release, attack = 10 ** (-3 / 20), math.exp(-1 / rate_out_hz), math.exp(-1 / (0.002 * rate_out_hz))
    held, down_by = np.zeros((2, n_hands))
    for k, sample in enumerate(out):
        wanted = np.log(np.maximum(np.abs(sample), threshold) / threshold)
        held = np.maximum(release * held, wanted)
        down_by = attack * down_by + (1 - attack) * held
        out[k] = sample * np.exp(-down_by)
    beyond = np.maximum(np.abs(out) - threshold, 0.0)
    guarded = np.sign(out) * (threshold + (1 - threshold) * np.tanh(beyond / (1 - threshold)))
    return np.where(beyond > 0.0, guarded, out)
