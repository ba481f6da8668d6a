"""The modes of one symmetry of a plate, and the response of the stiffer spectrum, whose modes are not computed.

    K c = k^4 c

Each symmetry is an eigenproblem. It is solved for the compliance (K + s)^-1, whose largest eigenvalues belong to the
lowest modes. The eigenvalues of K itself grow as the eighth power of the basis size: rounding errors would then hide
rigid motions and the lowest modes of large or slender plates. Powers of the compliance approximate the response of the
stiffer modes, in a larger basis than that of the modes (`modes.Fineness`).

Letters: K Ritz stiffness matrix of `ritz`, k [rad/m] wavenumber, s [m^-4] shift.
Source: see `ritz`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.modal.ritz import AxisBasis, products, stiffness

Number = TypeVar("Number", np.float64, np.complex128)

ORDERS = 4
"""Powers of compliance in `ModeBlock.beyond`. Each gains a factor of 6.8 below the top frequency, 5e-4 in all."""
_PLACES = (1 + np.cos(np.pi * (np.arange(ORDERS) + 0.5) / ORDERS)) / 2
_THROUGH = np.linalg.inv(np.vander(_PLACES, increasing=True))
"""Matrix from values at the Chebyshev nodes between 0 and 1 to the coefficients of the interpolating polynomial."""


@dataclass(frozen=True, eq=False)
class ModeBlock:
    """The modes of one symmetry, and the response of the stiffer spectrum, whose modes are not computed.

    x, y : the wider basis of each axis, n = n_x n_y products; k4 : (n_modes,) k^4 [m^-4], rising, 0 for rigid motions;
    vectors : (n, n_modes) orthonormal columns; shift : s [m^-4]; stiffer_k4 : lower bound on k^4 of the stiffer
    spectrum [m^-4].
    """

    x: AxisBasis
    y: AxisBasis
    k4: NDArray[np.float64]
    vectors: NDArray[np.float64]
    poisson_ratio: float
    shift: float
    stiffer_k4: float

    def deflections(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Every mode's shape at points (n_points, 2) [m], normalised over the area -> (n_points, n_modes) [1/m]."""
        return products(self.x, self.y, points_m) @ self.vectors

    @cached_property
    def _factor(self) -> NDArray[np.float64]:
        """Cholesky factor of K + shift."""
        return cholesky(self.x, self.y, self.poisson_ratio, self.shift)

    def beyond(self, forces: NDArray[np.float64], q: NDArray[Number]) -> NDArray[Number]:
        """Response of the stiffer spectrum to forces (n, n_forces), for q (n_q,) = k^4 / (1 + j eta) [m^-4]:
        (K - q)^-1 without its modes -> (n, n_forces, n_q), by a polynomial in the compliance

            C sum over j of a_j(q) C^j forces          C = (K + s)^-1

        The sum equals 1 / (1 - (q + s) C) at the Chebyshev nodes between 0 and the largest compliance without modes.
        """
        from scipy.linalg.lapack import dpotrs

        n, n_forces = forces.shape
        most = 1 / (self.stiffer_k4 + self.shift)
        powers = _THROUGH @ (1 / (1 - most * _PLACES[:, None] * (q + self.shift)))
        answer, orders = self._without_modes(forces), np.empty((ORDERS, n, n_forces))
        for order in orders:
            order[:] = self._without_modes(dpotrs(self._factor, answer, lower=1)[0])
            answer = order / most
        answers: NDArray[Number] = orders.reshape(ORDERS, -1).T @ powers
        return answers.reshape(n, n_forces, -1)

    def _without_modes(self, columns: NDArray[np.float64]) -> NDArray[np.float64]:
        return columns - self.vectors @ (self.vectors.T @ columns)


def cholesky(x: AxisBasis, y: AxisBasis, poisson_ratio: float, shift: float) -> NDArray[np.float64]:
    """Lower triangle L of K + shift = L L^T."""
    from scipy.linalg.lapack import dpotrf

    matrix = stiffness(x, y, poisson_ratio)
    matrix.flat[:: len(matrix) + 1] += shift
    # The matrix is symmetric: its transpose is in LAPACK's column order and need not be copied.
    factor: NDArray[np.float64] = dpotrf(matrix.T, lower=1, overwrite_a=1)[0]
    return factor


def modes_below(
    x: AxisBasis, y: AxisBasis, poisson_ratio: float, shift: float, limit: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Solve K c = k^4 c up to k^4 = `limit`. Returns k^4 (n_modes,), rising, and vectors (n, n_modes)."""
    from scipy.linalg.lapack import dormqr, dpotri, dstein, dsterf, dsytrd

    compliance = dpotri(cholesky(x, y, poisson_ratio, shift), lower=1, overwrite_c=1)[0]
    n = len(compliance)
    reflectors, diagonal, beside, tau, _ = dsytrd(compliance, lower=1, lwork=64 * n, overwrite_a=1)
    values, _ = dsterf(diagonal, beside)
    wanted = values[values > 1 / (limit + shift)]
    # Inverse iteration: the few vectors take less than half as long as by relatively robust representations.
    vectors, failed = dstein(diagonal, beside, wanted, np.ones(n, dtype=np.intc), np.full(n, n, dtype=np.intc))
    if failed:
        vectors = np.linalg.eigh(np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1))[1][:, n - len(wanted) :]
    turned = dormqr("L", "N", reflectors[1:, :-1], tau, vectors[1:], 64 * vectors.shape[1] + 64)[0]
    shapes: NDArray[np.float64] = np.vstack([vectors[:1], turned]).astype(np.float64, copy=False)
    return 1 / wanted[::-1] - shift, shapes[:, ::-1]
