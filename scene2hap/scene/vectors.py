"""Single vectors as tuples: numpy takes ten times longer for one vector."""

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
