"""The shapes that a body can take under forces at known points.

What it does at any frequency is a sum of them. So all that does not depend on where a hand is, contacts, sources and
frequencies, is summed before one touches.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol, TypeVar, runtime_checkable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
AnyFloat = TypeVar("AnyFloat", np.float32, np.float64)


class ResponseBasis(Protocol):
    """Shapes s_i(x), of which deflection is the sum  u(x, f) = sum over i of s_i(x) W_i(f)."""

    @property
    def sizes(self) -> Floats:
        """About how large each shape is (n_shapes,), so that what it adds can be compared."""
        ...

    def weights(self, frequencies_hz: Floats, forces: Complex) -> Complex:
        """W (n_shapes, n, n_f) under forces (n_forces, n, n_f) at frequencies (n_f,) [Hz]."""
        ...

    def mixed(self, weights: NDArray[AnyFloat]) -> Callable[[Floats], NDArray[AnyFloat]]:
        """Sums of the shapes (n_shapes, n), thought out but for the point: from points (n_points, 2) [m] to
        (n_points, n), in the precision of the weights."""
        ...


@runtime_checkable
class HasResponseBasis(Protocol):
    """A body whose deflection under any forces is a sum of some shapes."""

    def response_basis(self, forces_m: Floats) -> ResponseBasis:
        """The shapes for forces at points (n_forces, 2) [m]."""
        ...


def real_times(matrix: Floats, columns: Complex) -> Complex:
    """A real matrix (m, n) times complex columns (n, ...), at half of what a complex one costs."""
    flat = np.ascontiguousarray(columns).reshape(len(columns), math.prod(columns.shape[1:])).view(np.float64)
    return (matrix @ flat).view(np.complex128).reshape(len(matrix), *columns.shape[1:])
