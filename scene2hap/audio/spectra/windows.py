"""The window of all spectra and smoothings."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def hann(n: int) -> NDArray[np.float64]:
    """Return Hann's window (n,) without the zeros at its ends, which would leave out two samples."""
    return np.hanning(n + 2)[1:-1]
