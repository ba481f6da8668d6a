"""Types of arrays of numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Floats32 = NDArray[np.float32]
Complex = NDArray[np.complex128]
Ints = NDArray[np.int64]
Indices = NDArray[np.intp]
"""Places in other arrays."""
Bools = NDArray[np.bool_]
