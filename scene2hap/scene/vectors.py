"""Single vectors as tuples, for which numpy takes ten times longer; products of many vectors as arrays."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Vector = tuple[float, float, float]


def vector(values: Sequence[float] | NDArray[np.floating]) -> Vector:
    """Return three numbers as a tuple of floats."""
    return (float(values[0]), float(values[1]), float(values[2]))


def dot(one: Sequence[float], other: Sequence[float]) -> float:
    """Return the dot product of two vectors."""
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]


def cross_2d(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the cross products (...) of vectors (..., 2)."""
    product: NDArray[np.float64] = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product
