"""Cubic B-splines along one coordinate, for the masses and the elastic energies of a lattice.

    u = sum of c_i b_i,    u' = sum of (S c)_i q_i,    u'' = sum of (B c)_i g_i

b, q and g are splines of the third, second and first degree over the same lines. A deflection is given by a value c at
each of n + 3 nodes, for n cells between lines. Its slope and its curvature are splines with first and second
differences of these values as coefficients. The differences are the strains of springs between neighbours. The first
value is the deflection at the end.

Source: C. de Boor, A Practical Guide to Splines (1978), chapter X.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats

if TYPE_CHECKING:
    from scipy.sparse import csr_array, dia_array

_HELD = {"F": 0, "S": 1, "C": 2}
"""Number of nodes that an edge holds: a support holds the deflection, a clamp also the slope."""


@dataclass(frozen=True, eq=False)
class SplineAxis:
    """Nodes and springs along one coordinate.

    lines : (n + 1,) between cells, rising [m]; slope : (n + 2, 2) nonzero entries of each row of S, from the diagonal
    on [m^-1]; bend : (n + 1, 3) those of B [m^-2].
    """

    lines: Floats
    slope: Floats
    bend: Floats

    @classmethod
    def of(cls, lines: Floats) -> SplineAxis:
        """Return the axis of lines (n + 1,), rising [m]."""
        slope, curvature = (_differences(_knots(lines, degree), degree) for degree in (3, 2))
        # Each row of B is a difference of two rows of S.
        bend = np.zeros((len(curvature), 3))
        bend[:, :2] = curvature[:, :1] * slope[:-1]
        bend[:, 1:] += curvature[:, 1:] * slope[1:]
        return cls(lines, slope, bend)

    @property
    def n_nodes(self) -> int:
        """Number of nodes, those held by edges included."""
        return len(self.lines) + 2

    @cached_property
    def _knots(self) -> Floats:
        """Knots of cubic splines, without the first and the last, which affect none of them."""
        return _knots(self.lines, 2)

    @property
    def slope_of_cells(self) -> Floats:
        """S for the four nodes of each cell (n, 3, 4) [m^-1]."""
        return _banded(self.slope, 3)

    @property
    def bend_of_cells(self) -> Floats:
        """B for the four nodes of each cell (n, 2, 4) [m^-2]."""
        return _banded(self.bend, 2)

    def splines(self, x_m: Floats) -> tuple[NDArray[np.intp], dict[int, Floats]]:
        """Cell of each place within the axis (n_places,), and the values there of the cell's splines of degrees 1 to 3,
        (n_places, degree + 1) each. Spline k of a cell is spline cell + k of the axis."""
        n = len(self.lines) - 1
        cell = np.clip(np.searchsorted(self.lines, x_m, side="right") - 1, 0, n - 1)
        # De Boor's recursion.
        knots = self._knots[cell[:, None] + np.arange(6)]
        below, above = x_m[:, None] - knots, knots - x_m[:, None]
        found = {0: np.ones((len(x_m), 1))}
        for degree in (1, 2, 3):
            low, high = slice(3 - degree, 3), slice(3, 3 + degree)
            share = found[degree - 1] / (knots[:, high] - knots[:, low])
            found[degree] = np.zeros((len(x_m), degree + 1))
            found[degree][:, :-1] = above[:, high] * share
            found[degree][:, 1:] += below[:, low] * share
        del found[0]
        return cell, found

    def at(self, x_m: Floats) -> tuple[NDArray[np.intp], Floats]:
        """Nodes and the values of their splines (n_places, 4) at places; beyond the axis, at its nearest end."""
        cell, values = self.splines(np.clip(x_m, self.lines[0], self.lines[-1]))
        return cell[:, None] + np.arange(4), values[3]

    def free(self, edges: str) -> slice:
        """Nodes that the ends of the axis leave free; each end is F, S or C."""
        return slice(_HELD[edges[0]], self.n_nodes - _HELD[edges[1]])

    def products(self, degree: int, other_degree: int) -> csr_array:
        """Integrals of products of splines of two degrees, 1 to 3 [m]."""
        from scipy.sparse import csr_array

        splines, weight = self._at_gauss
        return csr_array(splines[degree].T @ weight @ splines[other_degree])

    @cached_property
    def _at_gauss(self) -> tuple[dict[int, csr_array], dia_array]:
        """Splines of each degree at the points of Gauss quadrature, and its weights on a diagonal."""
        from scipy.sparse import csr_array, diags_array

        places, weights = np.polynomial.legendre.leggauss(4)
        h = np.diff(self.lines)[:, None]
        cell, values = self.splines((self.lines[:-1, None] + h * (places + 1) / 2).ravel())
        splines = {}
        for degree, each in values.items():
            columns, ends = cell[:, None] + np.arange(degree + 1), (degree + 1) * np.arange(len(cell) + 1)
            shape = len(cell), len(self.lines) - 1 + degree
            splines[degree] = csr_array((each.ravel(), columns.ravel(), ends), shape=shape)
        return splines, diags_array((h * weights / 2).ravel())


def _knots(lines: Floats, degree: int) -> Floats:
    return np.concatenate([lines[:1].repeat(degree), lines, lines[-1:].repeat(degree)])


def _differences(knots: Floats, degree: int) -> Floats:
    """Weights (n, 2) of two neighbouring values of a spline in each value of its derivative, of one degree less."""
    n = len(knots) - degree - 1
    per_m = degree / (knots[degree + 1 : n + degree] - knots[1:n])
    return np.column_stack([-per_m, per_m])


def _banded(rows: Floats, count: int) -> Floats:
    """Every `count` consecutive rows as a matrix over 4 nodes (n, count, 4)."""
    n, width = len(rows) - count + 1, rows.shape[1]
    found = np.zeros((n, count, 4))
    for k in range(count):
        found[:, k, k : k + width] = rows[k : k + n]
    return found
