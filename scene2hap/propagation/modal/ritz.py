"""Ritz basis of a thin plate: polynomials along each axis, and the stiffness matrix of their products.

    w(x, y) = sum_ij c_ij X_i(x) Y_j(y)           X_i(xi) = (1 + xi)^p (1 - xi)^q P_i(xi),   xi = 2 x / L - 1
    U = D/2 integral of (w_xx + w_yy)^2 - 2 (1 - nu) (w_xx w_yy - w_xy^2)

p and q are 0, 1, 2 at a free, simply supported, clamped edge: the basis meets the conditions on deflection and slope
exactly, and minimum energy leads to those on moment and shear. Legendre polynomials times these factors, made
orthonormal, are the Jacobi polynomials of weights 2q, 2p times the same factors, so no orthonormalisation is needed.
Each X_i is stored as coefficients of normalised Legendre polynomials, for which differentiation is a matrix and an
integral a dot product.

Letters: L [m] length of an axis, nu [-] Poisson's ratio, D [N m] bending stiffness, xi [-] -1 to 1.
Source: Leissa, The free vibration of rectangular plates, J. Sound Vib. 31 (1973), for the energy and the method;
Bhat, J. Sound Vib. 102 (1985), for orthogonal polynomials as the basis.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

_FIXED = {"F": 0, "S": 1, "C": 2}
"""Number of derivatives, from the zeroth on, that vanish at an edge."""


@dataclass(frozen=True, eq=False)
class UnitBasis:
    """Functions of xi, orthonormal on -1..1, for axes of any length; shared by all plates with the same edges.

    coefficients : (n_legendre, n_functions) of normalised Legendre polynomials.
    """

    coefficients: NDArray[np.float64]

    @cached_property
    def chebyshev(self) -> NDArray[np.float64]:
        """The functions as coefficients of Chebyshev polynomials cos(n arccos xi)."""
        n = len(self.coefficients)
        angle = np.pi * (np.arange(n) + 0.5) / n
        values = legendre.legvander(np.cos(angle), n - 1) * _norms(n) @ self.coefficients
        coefficients: NDArray[np.float64] = np.cos(np.outer(np.arange(n), angle)) @ values
        coefficients *= 2 / n
        coefficients[0] /= 2
        return coefficients

    @cached_property
    def integrals(self) -> tuple[NDArray[np.float64], ...]:
        """Integrals of X_i'' X_j'', X_i' X_j', X_i X_j'' and X_i X_j' over xi, each (n, n)."""
        derivative = _derivative(len(self.coefficients))
        first = derivative @ self.coefficients
        second = derivative @ first
        return second.T @ second, first.T @ first, self.coefficients.T @ second, self.coefficients.T @ first


@dataclass(frozen=True, eq=False)
class AxisBasis:
    """Functions of one coordinate, orthonormal on 0..length [m]."""

    unit: UnitBasis
    length_m: float

    @property
    def n_functions(self) -> int:
        """Number of functions."""
        return len(self.unit.coefficients.T)

    def values(self, x_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """The functions at (n_points,) [m] -> (n_points, n_functions) [m^-1/2]."""
        # As cosines, since a hand touches one point at a time and the Legendre recurrence is a loop.
        chebyshev = self.unit.chebyshev
        angle = np.arccos(np.clip(2 * x_m / self.length_m - 1, -1.0, 1.0))
        values: NDArray[np.float64] = np.cos(angle[:, None] * np.arange(len(chebyshev))) @ chebyshev
        values *= np.sqrt(2 / self.length_m)
        return values

    @property
    def curvature(self) -> NDArray[np.float64]:
        """Integrals of X_i'' X_j'' (n, n) [m^-4]."""
        return self.unit.integrals[0] * (2 / self.length_m) ** 4

    @property
    def slope(self) -> NDArray[np.float64]:
        """Integrals of X_i' X_j' (n, n) [m^-2]."""
        return self.unit.integrals[1] * (2 / self.length_m) ** 2

    @property
    def crossed(self) -> NDArray[np.float64]:
        """Integrals of X_i X_j'' (n, n) [m^-2]."""
        return self.unit.integrals[2] * (2 / self.length_m) ** 2

    @property
    def climb(self) -> NDArray[np.float64]:
        """Integrals of X_i X_j' (n, n) [m^-1]."""
        return self.unit.integrals[3] * (2 / self.length_m)


def axis_bases(edges: str, length_m: float, n_terms: int) -> tuple[AxisBasis, ...]:
    """The bases of one axis: even and odd functions apart if both edges are equal, since modes do not mix them.

    Parameters: edges : two letters F, S, C for the edges at 0 and at length; n_terms : functions in all.
    """
    return tuple(AxisBasis(unit, length_m) for unit in _unit_bases(edges, n_terms)[:-1])


def axis_basis(edges: str, length_m: float, n_terms: int) -> AxisBasis:
    """The functions of `axis_bases`, one unit basis after the other."""
    return AxisBasis(_unit_bases(edges, n_terms)[-1], length_m)


def stiffness(x: AxisBasis, y: AxisBasis, poisson_ratio: float) -> NDArray[np.float64]:
    """Stiffness matrix of the products X_i(x) Y_j(y), their bending energy over D/2.

    The mass matrix over (rho h)/2 is the identity.

    Returns: (n_x n_y, n_x n_y) float64 [m^-4], symmetric, positive except for rigid motions. Its eigenvalues are k^4.
    """
    nu, n_x, n_y = poisson_ratio, x.n_functions, y.n_functions
    along = np.stack([x.curvature, np.eye(n_x), nu * x.crossed, nu * x.crossed.T, 2 * (1 - nu) * x.slope])
    across = np.stack([np.eye(n_y), y.curvature, y.crossed.T, y.crossed, y.slope])
    # Sum of five Kronecker products, by one matrix product.
    summed = along.reshape(5, -1).T @ across.reshape(5, -1)
    ordered: NDArray[np.float64] = summed.reshape(n_x, n_x, n_y, n_y).transpose(0, 2, 1, 3)
    return ordered.reshape(n_x * n_y, n_x * n_y)


def products(x: AxisBasis, y: AxisBasis, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Every X_i(x) Y_j(y) at points (n_points, 2) [m] -> (n_points, n_x n_y) [1/m]."""
    values = x.values(points_m[:, 0])[:, :, None] * y.values(points_m[:, 1])[:, None, :]
    return values.reshape(len(points_m), values.shape[1] * values.shape[2])


@lru_cache(maxsize=512)
def _unit_bases(edges: str, n_terms: int) -> tuple[UnitBasis, ...]:
    """The unit bases that do not mix, and last one with the functions of all of them in that order."""
    parities = (slice(0, None, 2), slice(1, None, 2)) if edges[0] == edges[1] else (slice(None),)
    coefficients = _coefficients(edges, n_terms)
    apart = [coefficients[:, parity] for parity in parities]
    return (*(UnitBasis(one) for one in apart), UnitBasis(np.hstack(apart)))


def _coefficients(edges: str, n_terms: int) -> NDArray[np.float64]:
    from scipy.special import eval_jacobi, roots_legendre

    p, q = (_FIXED[edge] for edge in edges)
    n_legendre = n_terms + p + q
    xi, weights = roots_legendre(n_legendre)  # exact up to degree 2 n - 1; the largest product here has 2 n - 2
    values = ((1 + xi) ** p * (1 - xi) ** q)[:, None] * eval_jacobi(np.arange(n_terms), 2 * q, 2 * p, xi[:, None])
    values /= np.sqrt(weights @ values**2)
    polynomials = legendre.legvander(xi, n_legendre - 1) * _norms(n_legendre)
    coefficients: NDArray[np.float64] = polynomials.T @ (weights[:, None] * values)
    return coefficients


def _norms(n: int) -> NDArray[np.float64]:
    norms: NDArray[np.float64] = np.sqrt(np.arange(n) + 0.5)
    return norms


@lru_cache(maxsize=256)
def _derivative(n: int) -> NDArray[np.float64]:
    """Derivative in normalised Legendre polynomials: P_i' = sum of (2 j + 1) P_j over j < i of the other parity."""
    j, i = np.indices((n, n))
    return np.where((j < i) & ((i - j) % 2 == 1), 2 * np.outer(_norms(n), _norms(n)), 0.0)
