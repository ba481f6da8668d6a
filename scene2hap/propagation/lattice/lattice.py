"""A plate as masses on a grid, connected by bending and twisting springs.

    U = D/2 e^T W e,  e = B u          K = B^T W B          T = m/2 (du/dt)^T A (du/dt)

The nodes carry a cubic spline (`spline_axis`). A bending spring joins three neighbours in a row; its strain is the
spline's curvature u_xx or u_yy. A twisting spring joins four neighbours in a square; its strain is the twist u_xy. The
weights W of springs, alone and in pairs, and the masses A are integrals over the plate, exact for the spline. Natural
frequencies are therefore too high, never too low. Their error falls as the fourth power of the cell size (measured in
tests/physics/test_mass_spring_damper.py); at a corner between a clamped and a free edge, as the 1.7th power.

Where cells are tiny beside the plate, the longest waves are lost in rounding of K. K u is then computed from the
springs, whose strains are small for such waves. Most lattices never need their springs, so they are built at first use.

Free edges need no equations of their own: the integrals end there, whether the edge is a side of the grid or an outline
that runs through its cells (`outline_lattice`). A support holds the deflection of the spline at the grid's side, a
clamp also its slope.

Letters: u [m] values of the nodes (spline coefficients), e [1/m] curvature, W, A [m^2] weights, D [N m] bending
stiffness, m [kg/m2] mass per area, nu [-] Poisson's ratio, h [m] cell.
Source: for the energy, Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, section 4; for splines and
consistent masses, J. A. Cottrell, A. Reali, Y. Bazilevs, T. J. R. Hughes, Computer Methods in Applied Mechanics and
Engineering 195 (2006) 5257.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.plate import Plate

if TYPE_CHECKING:
    from scipy.sparse import csr_array

_STIFFEST = 100.0
"""Largest k^4 of a spline in cells of 1 m far from edges (16/3 of linear over 17/315 of cubic splines)."""
_CLEAR = 1e-5
"""Rounding of K, relative to k^4 of half a wave along the plate, up to which the springs are not needed. Measured on
plates with fine cells at notches: the lowest frequencies then differ by less than 1e-7."""


@dataclass(frozen=True, eq=False)
class Lattice:
    """Masses and springs of one plate, for D = 1 and m = 1.

    cell_m : sides of the smallest cell [m]; masses : A, sparse, symmetric (n_nodes, n_nodes) [m^2]; stiffness : K = B^T
    W B, likewise [m^-2], times D the force per deflection; rounding_k4 : approximate error of k^4 of long waves from
    rounding of K [m^-4]; interpolation : maps points (n_points, 2) [m] to the sparse matrix (n_points, n_nodes) that
    gives their deflections from the values of the nodes; its transpose spreads a force over nodes; build_springs : B
    and W, see `springs` and `weights`.
    """

    plate: Plate
    cell_m: tuple[float, float]
    masses: csr_array
    stiffness: csr_array
    rounding_k4: float
    interpolation: Callable[[NDArray[np.float64]], csr_array]
    build_springs: Callable[[], tuple[csr_array, csr_array]]

    @cached_property
    def _springs(self) -> tuple[csr_array, csr_array]:
        return self.build_springs()

    @property
    def springs(self) -> csr_array:
        """Strains B per value of the nodes, sparse (n_springs, n_nodes) [m^-2]."""
        return self._springs[0]

    @property
    def weights(self) -> csr_array:
        """Weights W of the springs, sparse, symmetric (n_springs, n_springs) [m^2]."""
        return self._springs[1]

    @property
    def is_clear(self) -> bool:
        """Whether K itself is precise enough for the longest waves."""
        return self.rounding_k4 < _CLEAR * (math.pi / max(self.plate.extent_m)) ** 4

    @property
    def n_nodes(self) -> int:
        """Nodes that can move."""
        return int(self.masses.shape[0])

    @property
    def stiffest_k4(self) -> float:
        """Approximate largest eigenvalue of K over A [m^-4], where neighbours move against each other."""
        return _STIFFEST * sum(h**-2 for h in self.cell_m) ** 2

    def resized(self, plate: Plate, times: float) -> Lattice:
        """Return the lattice of a plate of the same shape, `times` as large. Its nodes have values in units of `times`
        metres: the springs stay the same, and the rest is scaled."""
        x, y = self.cell_m
        return Lattice(
            plate,
            (x * times, y * times),
            self.masses * times**4,
            self.stiffness,
            self.rounding_k4 / times**4,
            lambda points_m: self.interpolation(points_m / times) * times,
            lambda: self._springs,
        )

    def restoring(self, deflections: NDArray[np.float64]) -> NDArray[np.float64]:
        """Forces K u, computed from the springs where K would lose the digits of long waves."""
        forces: NDArray[np.float64]
        if self.is_clear:
            forces = self.stiffness @ deflections
        else:
            forces = self.springs.T @ (self.weights @ (self.springs @ deflections))
        return forces


def rounding_k4(diagonal: NDArray[np.float64], area_m2: float) -> float:
    """Error of k^4 from rounding of K for a plate that moves as one [m^-4].

    Parameters: diagonal : of K (n_nodes,) [m^-2], for nodes whose values all equal the deflection in that motion.
    """
    return float(np.finfo(float).eps * diagonal.sum() / area_m2)
