"""The receptance of a plate with edges as a sum of terms, each a shape times a spectrum.

    D_c Y(x, x0) = sum over modes of phi(x) phi(x0) / (k_n^4 - q)  +  sum over i of rho_i(x, x0) l_i(q)
    q = k^4 / (1 + j eta)

The first sum has the modes up to 1.5 times the top frequency. The second sum is the remainder of `modal_plate`: the
rest of the Ritz spectrum and the near field. The remainder changes little with q, since its nearest pole is at 2.25
times the highest q. Chebyshev interpolation from its values rho_i at four nodes q_i, with Lagrange polynomials l_i, is
therefore accurate to 1e-3. A touch then costs three small matrix products, and no frequency needs a sum of its own.

Letters: Y [m/N] receptance, D_c [N m] complex bending stiffness, phi [1/m] shape normalised over the area, k [rad/m],
q [m^-4], rho [m^2], eta [-].
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise, product
from typing import Generic

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.compiled import compiled
from scene2hap.propagation.bands.octaves import OctaveSums
from scene2hap.propagation.elastic_body import AnyFloat, real_times
from scene2hap.propagation.modal.modes import FINE, MARGIN, Fineness, PlateModes, modes_up_to
from scene2hap.propagation.modal.near_field import Dimples, NearField
from scene2hap.propagation.modal.ritz import axis_basis, products
from scene2hap.propagation.plate import Plate

N_NODES = 4


@dataclass(frozen=True, eq=False)
class ForcedPlate:
    """A plate under forces at given points.

    modes : (n_first, n_modes) mode shapes as coefficients of the first cosines along each axis; phi : (n_forces,
    n_modes) mode shapes at the forces; rest : (n_products, n_forces N_NODES) response of the stiffer spectrum as
    coefficients of all cosines; near : near field beyond the basis; k2 : (N_NODES,) roots of the nodes q_i [m^-2].
    """

    plate: PlateTerms
    modes: Floats
    phi: Floats
    rest: Floats
    near: NearField
    k2: Floats

    def __call__(self, points_m: Floats) -> Floats:
        """The shape of each term at points (n_points, 2) [m], per force (n_points, n_forces, n_terms)."""
        (n_forces, n_modes), n_points = self.phi.shape, len(points_m)
        cosines = self.plate.cosines(points_m)
        terms = np.empty((n_points, n_forces, n_modes + N_NODES))
        np.multiply((self.plate.first(cosines) @ self.modes)[:, None], self.phi, out=terms[:, :, :n_modes])
        terms[:, :, n_modes:] = self.beyond_modes(points_m, cosines)
        return terms

    def beyond_modes(self, points_m: Floats, cosines: Floats) -> Floats:
        """The shape of the terms that are no modes, per force (n_points, n_forces, N_NODES), from the plate's `cosines`
        at the points."""
        rest = (cosines @ self.rest).reshape(len(points_m), len(self.phi), N_NODES)
        rest += self.near(points_m, self.k2)
        return rest

    @property
    def nbytes(self) -> int:
        """Memory that these forces hold [byte]."""
        return self.phi.nbytes + self.rest.nbytes

    @property
    def sizes(self) -> Floats:
        """Typical magnitude of each mode, then of the remainder of each force and node (n_modes + n_forces N_NODES,).

        Magnitudes are norms of coefficients of cosines; near fields are left out, since all nodes of a force have them.
        """
        sizes: Floats = np.sqrt(np.concatenate([np.square(one).sum(axis=0) for one in (self.modes, self.rest)]))
        return sizes

    def weights(self, spectrum: Complex, forces: Complex) -> Complex:
        """Weights of these shapes (n_modes + n_forces N_NODES, n, n_f) under forces (n_forces, n, n_f), from the
        spectrum of the terms (n_terms, n_f)."""
        n_modes = self.phi.shape[1]
        modal = real_times(self.phi.T, forces)
        modal *= spectrum[:n_modes, None]
        by_node = forces[:, None] * spectrum[n_modes:, None]
        return np.concatenate([modal, by_node.reshape(len(forces) * N_NODES, *forces.shape[1:])])

    def mixed(self, weights: NDArray[AnyFloat]) -> ContractedShapes[AnyFloat]:
        """Sums of these shapes; see `ResponseBasis`."""
        n_modes = self.phi.shape[1]
        beyond = np.ascontiguousarray(weights[n_modes:])
        smooth = self.rest @ beyond
        self.plate.add_first(smooth, self.modes @ weights[:n_modes])
        size = (*self.plate.per_size, *self.plate.n_cosines)
        return ContractedShapes(size, smooth.astype(weights.dtype), self.near.dimples, self.k2, beyond)


@compiled
class ContractedShapes(Generic[AnyFloat]):
    """Deflection under known forces, summed in advance and evaluated at points given later.

    Parameters: size : last four parameters of `fill_cosines`; smooth : (n_products, n) coefficients of its products;
    dimples, k2 : near fields (n_forces, n_k2); beyond : (n_forces n_k2, n) coefficients of the near fields. The sums
    have the precision of `smooth` and `beyond`.
    """

    def __init__(
        self,
        size: tuple[float, float, int, int],
        smooth: NDArray[AnyFloat],
        dimples: Dimples,
        k2: Floats,
        beyond: NDArray[AnyFloat],
    ) -> None:
        self._size, self._dimples, self._k2 = size, dimples, k2
        self._smooth: NDArray[AnyFloat] = smooth
        self._beyond: NDArray[AnyFloat] = beyond

    def __call__(self, points_m: Floats) -> NDArray[AnyFloat]:
        """Deflections (n_points, n) at points (n_points, 2) [m]."""
        cosines = np.empty((len(points_m), len(self._smooth)))
        fill_cosines(cosines, points_m, *self._size)
        near = self._dimples.near(points_m, self._k2).reshape(len(points_m), len(self._beyond))
        found: NDArray[AnyFloat] = (cosines @ self._smooth + near @ self._beyond).astype(self._smooth.dtype)
        return found


@compiled
def fill_cosines(found: Floats, points_m: Floats, per_length: float, per_width: float, n_x: int, n_y: int) -> None:
    """Fill (n_points, n_x n_y) with cos(i acos(xi)) cos(j acos(eta)), xi and eta from -1 to 1 along both sides."""
    # Scalars instead of arrays: a hand touches one point, for which five calls of numpy take longer.
    angles = np.array(
        [
            (math.acos(min(max(x * per_length - 1, -1.0), 1.0)), math.acos(min(max(y * per_width - 1, -1.0), 1.0)))
            for x, y in points_m.tolist()
        ]
    ).reshape(-1, 2)
    values = np.cos(angles[:, :, None] * np.arange(max(n_x, n_y)))
    found[:] = (values[:, 0, :n_x, None] * values[:, 1, None, :n_y]).reshape(found.shape)


class PlateTerms:
    """The terms of one plate, for frequencies up to `max_frequency_hz`: first its modes, then the rest."""

    def __init__(self, plate: Plate, max_frequency_hz: float, fineness: Fineness = FINE) -> None:
        self.modes: PlateModes = modes_up_to(plate, MARGIN * max_frequency_hz, fineness)
        top = float(plate.wavenumber_rad_m(max_frequency_hz)) ** 4
        self._nodes = top / 2 * (1 - np.cos(np.pi * (np.arange(N_NODES) + 0.5) / N_NODES))
        n_x, n_y = self.modes.terms
        self._axes = (
            axis_basis(plate.edges[:2], plate.length_m, n_x),
            axis_basis(plate.edges[2:], plate.width_m, n_y),
        )
        self.per_size: tuple[float, float] = (2 / plate.length_m, 2 / plate.width_m)
        k4 = np.concatenate([block.k4 for block in self.modes.blocks])
        order = np.argsort(k4, kind="stable")
        self._k4 = k4[order]
        along, across = np.subtract(self.n_cosines, self.modes.terms) + self.modes.of_modes
        self._n_first = int(along), int(across)
        shapes = self._in_cosines(self._spread([block.vectors for block in self.modes.blocks])[:, order])
        self._phi = self.first(shapes.T).T.copy()

    @property
    def nbytes(self) -> int:
        """Memory of the modes [byte]."""
        return self.modes.nbytes + self._phi.nbytes

    def first(self, values: Floats) -> Floats:
        """Select from values (n, n_products) those of the products that modes consist of (n, n_first)."""
        along, across = self._n_first
        return values.reshape(len(values), *self.n_cosines)[:, :along, :across].reshape(len(values), along * across)

    def add_first(self, values: Floats, more: Floats) -> None:
        """Add `more` (n_first, n) to those values (n_products, n) whose products modes consist of."""
        along, across = self._n_first
        values.reshape(*self.n_cosines, -1)[:along, :across] += more.reshape(along, across, -1)

    @property
    def n_cosines(self) -> tuple[int, int]:
        """Number of Chebyshev polynomials along each axis."""
        x, y = (len(axis.unit.chebyshev) for axis in self._axes)
        return x, y

    def spectrum(self, q: Complex) -> Complex:
        """Each term at each frequency (n_terms, n_frequencies): 1 / (k_n^4 - q) [m^4], then l_i(q) [-]."""
        return np.concatenate([1 / (self._k4[:, None] - q), self._between(q)])

    def sums(self, q: Complex, scale: complex) -> OctaveSums:
        """Return the `OctaveSums` that sum terms at frequencies by their q, times `scale`."""
        return OctaveSums(self._k4, self._between(q), q, scale)

    def _between(self, q: Complex) -> Complex:
        apart = self._nodes[:, None] - self._nodes
        is_other = apart != 0
        factors = (q - self._nodes[:, None]) / np.where(is_other, apart, 1.0)[:, :, None]
        between: Complex = np.where(is_other[:, :, None], factors, 1.0).prod(axis=1)
        return between

    def of_forces(self, forces_m: Floats) -> ForcedPlate:
        """The plate under forces at points (n_forces, 2) [m]."""
        phi = self.first(self.cosines(forces_m)) @ self._phi
        by_axes = products(*self._axes, forces_m).reshape(-1, *self.modes.terms)
        stiff = []
        for block, (along, across) in zip(self.modes.blocks, self._places(), strict=True):
            forces = by_axes[:, along, across].reshape(len(forces_m), -1).T
            stiff.append(block.beyond(forces, self._nodes).reshape(forces.shape[0], -1))
        # One column per force and node: the response of the rest of the spectrum to the force.
        rest = self._in_cosines(self._spread(stiff, side_by_side=False))
        return ForcedPlate(self, self._phi, phi, rest, NearField(self.modes, forces_m), np.sqrt(self._nodes))

    def cosines(self, points_m: Floats) -> Floats:
        """Products of Chebyshev polynomials of both axes at points (n_points, n_products), as cosines."""
        found = np.empty((len(points_m), math.prod(self.n_cosines)))
        fill_cosines(found, points_m, *self.per_size, *self.n_cosines)
        return found

    def _in_cosines(self, columns: Floats) -> Floats:
        """Convert columns over products of the axes' functions to those of `cosines`: a hand touches one point at a
        time, for which few calls save more time than few products."""
        x, y = (axis.unit.chebyshev * math.sqrt(2 / axis.length_m) for axis in self._axes)
        along = x @ columns.reshape(x.shape[1], -1)
        both = y @ along.reshape(len(x), y.shape[1], -1)
        return both.reshape(len(x) * len(y), -1 if both.size else columns.shape[1])

    def _spread(self, by_block: list[Floats], *, side_by_side: bool = True) -> Floats:
        """Convert columns over each block's products to all products: side by side, or all blocks in the same
        columns."""
        widths = [columns.shape[1] for columns in by_block]
        ends = np.cumsum(widths) if side_by_side else np.array(widths)
        spread = np.zeros((*self.modes.terms, int(ends[-1])))
        for block, (along, across), columns, end in zip(self.modes.blocks, self._places(), by_block, ends, strict=True):
            width = columns.shape[1]
            shaped = columns.reshape(block.x.n_functions, block.y.n_functions, width)
            spread[along, across, end - width : end] = shaped
        return spread.reshape(math.prod(self.modes.terms), -1 if spread.size else 0)

    def _places(self) -> list[tuple[slice, slice]]:
        """Position of each block's functions among all functions of each axis."""
        ends_x, ends_y = (np.cumsum([0, *(b.n_functions for b in bases)]) for bases in (self.modes.x, self.modes.y))
        along, across = ([slice(*pair) for pair in pairwise(ends)] for ends in (ends_x, ends_y))
        return list(product(along, across))
