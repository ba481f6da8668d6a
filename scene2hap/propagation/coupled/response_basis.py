"""Shape functions that span a body's deflection under forces at given points.

The deflection at any frequency is a weighted sum of them. All sums that do not depend on the touched point (over
contacts, sources, frequencies) are computed before a touch.
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
    """Shape functions s_i(x) that span a body's deflection under forces:  u(x, f) = sum over i of s_i(x) W_i(f)."""

    @property
    def sizes(self) -> Floats:
        """Typical magnitude of each shape (n_shapes,), to compare their contributions."""
        ...

    def weights(self, frequencies_hz: Floats, forces: Complex) -> Complex:
        """W (n_shapes, n, n_f) under forces (n_forces, n, n_f) at frequencies (n_f,) [Hz]."""
        ...

    def mixed(self, weights: NDArray[AnyFloat]) -> Callable[[Floats], NDArray[AnyFloat]]:
        """Sums of the shapes with weights (n_shapes, n), as a function from points (n_points, 2) [m] to (n_points, n),
        in the precision of the weights."""
        ...


@runtime_checkable
class HasResponseBasis(Protocol):
    """A body whose deflection under any forces is a sum of shape functions."""

    def response_basis(self, forces_m: Floats) -> ResponseBasis:
        """The shapes for forces at points (n_forces, 2) [m]."""
        ...


def real_times(matrix: Floats, columns: Complex) -> Complex:
    """Multiply a real matrix (m, n) by complex columns (n, ...), at half the cost of a complex product."""
    flat = np.ascontiguousarray(columns).reshape(len(columns), math.prod(columns.shape[1:])).view(np.float64)
    return (matrix @ flat).view(np.complex128).reshape(len(matrix), *columns.shape[1:])
