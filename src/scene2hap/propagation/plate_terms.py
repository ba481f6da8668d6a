"""The receptance of a plate with edges as a sum of terms, each a shape times a spectrum.

    D_c Y(x, x0) = sum over modes of phi(x) phi(x0) / (k_n^4 - q)  +  sum over i of rho_i(x, x0) l_i(q)
    q = k^4 / (1 + j eta)

The modes are those up to 1.5 times the top frequency. What `modal_plate` adds to them, the rest of the Ritz spectrum
and the near field, changes so little with q that its values rho_i at four places q_i and the polynomials l_i through
them give it to 1e-3 (its nearest pole is at 2.25 times the highest q). A touch then costs three small matrix products,
and no frequency needs a sum of its own.

Letters: Y [m/N] receptance, D_c [N m] complex bending stiffness, phi [1/m] shape normalised over the area, k [rad/m],
q [m^-4], rho [m^2], eta [-].
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.modes import FINE, MARGIN, Fineness, modes_up_to
from scene2hap.propagation.near_field import NearField
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.ritz import axis_basis

N_NODES = 4

Floats = NDArray[np.float64]


class PlateTerms:
    """The terms of one plate, for frequencies up to `max_frequency_hz`: first its modes, then the rest."""

    def __init__(self, plate: Plate, max_frequency_hz: float, fineness: Fineness = FINE) -> None:
        self.modes = modes_up_to(plate, MARGIN * max_frequency_hz, fineness)
        k4 = float(plate.wavenumber_rad_m(max_frequency_hz)) ** 4
        self._nodes = k4 / 2 * (1 - np.cos(np.pi * (np.arange(N_NODES) + 0.5) / N_NODES))
        n_x, n_y = self.modes.terms
        self._x = axis_basis(plate.edges[:2], plate.length_m, n_x)
        self._y = axis_basis(plate.edges[2:], plate.width_m, n_y)
        self._k4 = np.concatenate([block.k4 for block in self.modes.blocks])
        self._phi = self._spread([block.vectors for block in self.modes.blocks])

    def spectrum(self, q: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """Each term at each frequency (n_terms, n_frequencies): 1 / (k_n^4 - q) [m^4], then l_i(q) [-]."""
        apart = self._nodes[:, None] - self._nodes
        is_other = apart != 0
        factors = (q - self._nodes[:, None]) / np.where(is_other, apart, 1.0)[:, :, None]
        between = np.where(is_other[:, :, None], factors, 1.0).prod(axis=1)
        return np.concatenate([1 / (self._k4[:, None] - q), between])

    def of_forces(self, forces_m: Floats) -> Callable[[Floats], Floats]:
        """What forces at points (n_forces, 2) [m] do: the shape of each term at other points.

        Returns: a function from points (n_points, 2) [m] to (n_points, n_forces, n_terms).
        """
        near = NearField(self.modes, forces_m)
        basis_at_forces = self._basis(forces_m)
        phi = basis_at_forces @ self._phi
        by_axes = basis_at_forces.reshape(-1, *self.modes.terms)
        stiff = []
        for block, (along, across) in zip(self.modes.blocks, self._places(), strict=True):
            forces = by_axes[:, along, across].reshape(len(forces_m), -1).T
            stiff.append(block.beyond(forces, self._nodes).reshape(forces.shape[0], -1))
        # One column per force and node: how the rest of the spectrum answers to it, in the basis.
        rest = self._spread(stiff, side_by_side=False)
        k2 = np.sqrt(self._nodes)

        def terms(points_m: Floats) -> Floats:
            basis = self._basis(points_m)
            resonant = (basis @ self._phi)[:, None] * phi
            static = (basis @ rest).reshape(len(points_m), len(forces_m), N_NODES) + near(points_m, k2)
            return np.concatenate([resonant, static], axis=2)

        return terms

    def _basis(self, points_m: Floats) -> Floats:
        """All products of the two axes' functions at points (n_points, n_x n_y) [1/m]."""
        x, y = self._x.values(points_m[:, 0]), self._y.values(points_m[:, 1])
        return (x[:, :, None] * y[:, None, :]).reshape(len(points_m), -1)

    def _spread(self, by_block: list[Floats], *, side_by_side: bool = True) -> Floats:
        """Columns told in each block's own products, told in all: beside those of other blocks, or added to them."""
        widths = [columns.shape[1] for columns in by_block]
        ends = np.cumsum(widths) if side_by_side else np.array(widths)
        spread = np.zeros((*self.modes.terms, int(ends[-1])))
        for block, (along, across), columns, end in zip(self.modes.blocks, self._places(), by_block, ends, strict=True):
            width = columns.shape[1]
            shaped = columns.reshape(block.x.n_functions, block.y.n_functions, width)
            spread[along, across, end - width : end] = shaped
        return spread.reshape(math.prod(self.modes.terms), -1 if spread.size else 0)

    def _places(self) -> list[tuple[slice, slice]]:
        """Where the functions of each block are among all of each axis."""
        ends_x, ends_y = (np.cumsum([0, *(b.n_functions for b in bases)]) for bases in (self.modes.x, self.modes.y))
        along, across = ([slice(*pair) for pair in pairwise(ends)] for ends in (ends_x, ends_y))
        return list(product(along, across))
