"""The last step of the mix: a memoryless soft limiter, so that nothing leaves [-1, 1] and quiet mixes pass untouched.

    y = x                                       |x| <= t
    y = sign(x) (t + (1 - t) tanh((|x| - t) / (1 - t)))     |x| > t,     t = -3 dB re full scale

Value and slope are continuous at t. Having no memory, it gives the same output for any block size. It runs at the
session's rate, after the mix was resampled, so that nothing can overshoot behind it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled

THRESHOLD = 10 ** (-3 / 20)


def soft_limit(mix: NDArray[np.float32]) -> NDArray[np.float32]:
    """The mix within [-1, 1]; float32 of any shape, changed only where |x| exceeds -3 dB re full scale."""
    limited = np.array(mix, order="C")
    flat = limited.reshape(1, -1)
    limit_in_place(flat, np.empty_like(flat), THRESHOLD)
    return limited


@compiled
def limit_in_place(mix: NDArray[np.float32], scratch: NDArray[np.float32], threshold: float) -> None:
    """The same in place, of (n_channels, n_frames); scratch has the shape of the mix, so that nothing large is
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
