"""Gains at points of one object, after the scene is solved."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats
from scene2hap.compiled import compiled
from scene2hap.propagation.bands.sampling import Gains


@compiled
class ObjectResponse:
    """Gains at points of one object after the scene is solved.

    Parameters: place : maps world points (n_points, 3) to points on the body (n_points, 2) [m]; gains : of the sources
    that reach the object; columns : (n_own,) indices of these among all sources; shape : (n_sources, n_bands) of all;
    own : column of the object itself as a source, -1 if it is none.
    """

    def __init__(
        self,
        place: Callable[[Floats], Floats],
        gains: Gains,
        columns: NDArray[np.intp],
        shape: tuple[int, int],
        own: int,
    ) -> None:
        self._place, self._gains, self._columns, self._shape, self._own = place, gains, columns, shape, own

    def __call__(self, points_m: Floats) -> Floats:
        """Gains (n_points, n_sources, n_bands) [-] at points of the world (n_points, 3) [m]: 1 for a source on
        itself, 0 for sources that do not reach the object."""
        found = np.zeros((len(points_m), *self._shape))
        found[:, self._columns] = self._gains(self._place(points_m))
        if self._own >= 0:
            found[:, self._own] = 1.0
        return found


@compiled
class Magnitudes:
    """Magnitudes (n_points, n, 1) at points (n_points, 2) of complex numbers, from alternating real and imaginary
    parts."""

    def __init__(self, pairs: Callable[[Floats], Floats]) -> None:
        self._pairs = pairs

    def __call__(self, points_m: Floats) -> Floats:
        """See `Gains`."""
        sizes: Floats = np.abs(self._pairs(points_m).view(np.complex128))[:, :, None]
        return sizes
