"""The last step of the mix: a memoryless soft limiter, so that nothing leaves [-1, 1] and quiet mixes pass untouched.

    y = x                                       |x| <= t
    y = sign(x) (t + (1 - t) tanh((|x| - t) / (1 - t)))     |x| > t,     t = -3 dB re full scale

Value and slope are continuous at t. Having no memory, it gives the same output for any block size.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

THRESHOLD = 10 ** (-3 / 20)


def soft_limit(mix: NDArray[np.float32]) -> NDArray[np.float32]:
    """The mix within [-1, 1]; float32 of any shape, changed only where |x| exceeds -3 dB re full scale."""
    level = np.abs(mix)
    if not (level > THRESHOLD).any():
        return mix
    rest = 1 - THRESHOLD
    squeezed = np.copysign(THRESHOLD + rest * np.tanh((level - THRESHOLD) / rest), mix)
    return np.where(level > THRESHOLD, squeezed, mix).astype(np.float32)
