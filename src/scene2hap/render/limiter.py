"""The last step of the mix: a memoryless soft limiter, so that nothing leaves [-1, 1] and quiet mixes pass untouched.

    y = x                                       |x| <= t
    y = sign(x) (t + (1 - t) tanh((|x| - t) / (1 - t)))     |x| > t,     t = -3 dB re full scale

Value and slope are continuous at t. Having no memory, it gives the same output for any block size. It runs at the
session's rate, after the mix was resampled, so that nothing can overshoot behind it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

THRESHOLD = 10 ** (-3 / 20)

_REST = 1 - THRESHOLD


def soft_limit(mix: NDArray[np.float32]) -> NDArray[np.float32]:
    """The mix within [-1, 1]; float32 of any shape, changed only where |x| exceeds -3 dB re full scale."""
    limited = np.array(mix)
    limit_in_place(limited, np.empty_like(limited))
    return limited


def limit_in_place(mix: NDArray[np.float32], scratch: NDArray[np.float32]) -> None:
    """The same in place; scratch has the shape of the mix, so that nothing large is allocated."""
    np.abs(mix, out=scratch)
    if not mix.size or np.maximum.reduce(scratch, axis=None) <= THRESHOLD:
        return
    is_over = scratch > THRESHOLD
    np.subtract(scratch, THRESHOLD, out=scratch)
    np.divide(scratch, _REST, out=scratch)
    np.tanh(scratch, out=scratch)
    np.multiply(scratch, _REST, out=scratch)
    np.add(scratch, THRESHOLD, out=scratch)
    np.copysign(scratch, mix, out=scratch)
    np.copyto(mix, scratch, where=is_over)
