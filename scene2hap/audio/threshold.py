"""The threshold of touch by frequency, the felt range, and the least felt difference of level.

T(f) = A / lg(b)^2 * lg(f / 550 + b)^2 - e      [dB re full scale], b = 6/11, A = 50, e = 45, at most 0

Source: the psychohaptic model of the MPEG haptics reference software (ISO/IEC 23090-31), whose convention is that full
scale is 45 dB over the threshold at 250 Hz.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

TACTILE_RANGE_HZ = (10.0, 1000.0)
"""Range that touch perceives as vibration, and that the bands cover."""

NOTICED_DB = 3.0
"""About the least difference of level that is felt [dB]: smaller errors and changes of level do not matter."""

_A, _B, _E = 50.0, 6.0 / 11.0, 45.0


def threshold_db(frequencies_hz: ArrayLike) -> NDArray[np.float64]:
    """Return T(f), the least drive that is felt [dB re full scale], in the shape of `frequencies_hz`."""
    f = np.asarray(frequencies_hz, dtype=np.float64)
    return np.minimum(0.0, _A / math.log10(_B) ** 2 * np.log10(f / 550.0 + _B) ** 2 - _E)
