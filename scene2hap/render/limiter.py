"""The last step of the mix: all samples are within [-1, 1], and quiet mixes are unchanged.

The gain of a mix that is too loud is reduced at once and released slowly, so the mix is scaled and keeps its shape:

    y = x (1 - u),   u[n] = max(a u[n - 1], 1 - t / |x[n]|),   t = -3 dB re full scale,   a release per frame

Three loud tones then have 0.3 % of odd harmonics. With only the curve below they had 14 %. The curve is the last guard,
for sums of mixes and for samples that rounding leaves beyond t:

    y = x                                       |x| <= t
    y = sign(x) (t + (1 - t) tanh((|x| - t) / (1 - t)))     |x| > t

Both act sample by sample, independent of the size of blocks. They run at the session's rate, after resampling, so no
later step can overshoot.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled

THRESHOLD = 10 ** (-3 / 20)
NOTHING = 1e-7
"""A smaller reduction is not applied: 1e-6 dB."""
RELEASE_S = 1.0
"""Release time constant [s]: longer than beats that are felt one by one. At 0.3 s there are twice the harmonics."""


def releases(sample_rate_hz: float, n_frames: int) -> NDArray[np.float64]:
    """Return a, a^2, ... (n_frames,) [-]."""
    return np.asarray(np.exp(np.arange(1, n_frames + 1) / (-RELEASE_S * sample_rate_hz)))


@compiled
def turn_down_in_place(
    mix: NDArray[np.float32],
    held: NDArray[np.float64],
    scratch: NDArray[np.float64],
    threshold: float,
    powers: NDArray[np.float64],
) -> None:
    """Reduce the gain of the next frames of a mix (n_channels, n_frames). `held` (n_channels,) is u of the last frame.

    Parameters: scratch : (2, n_channels, n_frames), so that nothing large is allocated; powers : `releases`
        (n_frames,).
    """
    x, u = scratch
    np.copyto(x, mix)
    np.abs(x, out=u)
    if not mix.size or (not held.any() and np.maximum.reduce(u, axis=None) <= threshold):
        return
    np.maximum(u, threshold, out=u)
    np.divide(threshold, u, out=u)
    np.subtract(1.0, u, out=u)
    # Values are divided by the decay since the frame before the first. A decaying maximum then is a running maximum.
    np.divide(u, powers, out=u)
    np.maximum.accumulate(u, axis=1, out=u)
    np.maximum(u, held[:, None], out=u)
    np.multiply(u, powers, out=u)
    held[:] = u[:, -1]
    held[held < NOTHING] = 0.0
    np.subtract(1.0, u, out=u)
    np.multiply(u, x, out=u)
    np.copyto(mix, u, casting="same_kind")


def soft_limit(mix: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the mix within [-1, 1]; float32 of any shape, changed only where |x| exceeds -3 dB re full scale."""
    limited = np.array(mix, order="C")
    flat = limited.reshape(1, -1)
    limit_in_place(flat, np.empty_like(flat), THRESHOLD)
    return limited


@compiled
def limit_in_place(mix: NDArray[np.float32], scratch: NDArray[np.float32], threshold: float) -> None:
    """Apply `soft_limit` in place to (n_channels, n_frames). Scratch has the mix's shape, so nothing large is
    allocated."""
    np.abs(mix, out=scratch)
    if not mix.size or np.maximum.reduce(scratch, axis=None) <= threshold:
        return
    rest = 1 - threshold
    is_over = scratch > threshold
    np.subtract(scratch, threshold, out=scratch)
    np.divide(scratch, rest, out=scratch)
    np.tanh(scratch, out=scratch)
    np.multiply(scratch, rest, out=scratch)
    np.add(scratch, threshold, out=scratch)
    np.copysign(scratch, mix, out=scratch)
    np.copyto(mix, scratch, where=is_over)
