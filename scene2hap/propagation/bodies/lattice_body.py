"""Receptance of a lattice alone between any points, from its modes and the series for all higher modes.

    D_c Y(x, x0) = sum over modes of phi(x) phi(x0) / (k_n^4 - z)  +  sum over j of (z + s)^j R_j(x, x0)
    z = k^4 / (1 + j eta)

Letters: see `lattice_modes`; Y [m/N] receptance, D_c = D (1 + j eta) [N m].
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.caches import ByteBoundedLru, cached_while_used
from scene2hap.propagation.bodies.many_joints import among as among_many, has_many
from scene2hap.propagation.elastic_body import AnyFloat, real_times
from scene2hap.propagation.lattice.lattice import Lattice
from scene2hap.propagation.lattice.lattice_modes import TERMS, LatticeModes, lattice_modes
from scene2hap.propagation.plate import Plate


@cached_while_used
def lattice_body(plate: Plate, resolution: int, max_frequency_hz: float, loss_factor: float) -> LatticeBody:
    """The body of a plate. Cached, since every change of a contact prepares the scene again."""
    return LatticeBody(plate, resolution, max_frequency_hz, loss_factor)


@dataclass(frozen=True, eq=False)
class LatticeBasis:
    """The `ResponseBasis` of a lattice: its modes, and the series of each force.

    shapes : (n_nodes, n_modes + n_forces TERMS); shares : (n_forces, n_modes) value of every mode at every force;
    spectra : see `LatticeBody`.
    """

    lattice: Lattice
    shapes: NDArray[np.float64]
    shares: NDArray[np.float64]
    spectra: Callable[[NDArray[np.float64]], NDArray[np.float64]]

    @property
    def sizes(self) -> NDArray[np.float64]:
        """See `ResponseBasis`."""
        sizes: NDArray[np.float64] = np.sqrt(np.square(self.shapes).mean(axis=0))
        return sizes

    def weights(self, frequencies_hz: NDArray[np.float64], forces: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """See `ResponseBasis`."""
        spectrum, n_modes = self.spectra(frequencies_hz).view(np.complex128)[:, None], self.shares.shape[1]
        modal = real_times(self.shares.T, forces)
        modal *= spectrum[:n_modes]
        series = forces[:, None] * spectrum[n_modes:]
        return np.concatenate([modal, series.reshape(len(forces) * TERMS, *forces.shape[1:])])

    def mixed(self, weights: NDArray[AnyFloat]) -> Callable[[NDArray[np.float64]], NDArray[AnyFloat]]:
        """See `ResponseBasis`."""
        at_nodes = self.shapes @ weights
        return lambda points_m: (self.lattice.interpolation(points_m) @ at_nodes).astype(weights.dtype)


class LatticeBody:
    """An `ElasticBody` of masses and springs, for frequencies up to `max_frequency_hz`."""

    def __init__(self, plate: Plate, resolution: int, max_frequency_hz: float, loss_factor: float) -> None:
        self.plate = plate
        self.loss_factor = loss_factor
        self.modes: LatticeModes = lattice_modes(plate, resolution, max_frequency_hz)
        self._from_forces = ByteBoundedLru(self._pushed)
        self._spectra = ByteBoundedLru(self._spectrum, room=4)

    @property
    def nbytes(self) -> int:
        """Memory of the modes [byte], which is most of it, without the cached values, which `ByteBoundedLru` bounds."""
        return self.modes.shapes.nbytes

    def receptance(
        self, points_m: NDArray[np.float64], forces_m: NDArray[np.float64], frequencies_hz: NDArray[np.float64]
    ) -> NDArray[np.complex128]:
        """See `ElasticBody`."""
        shares, stiffer, among = self._from_forces(forces_m)
        if points_m is forces_m and has_many(points_m):
            series = among.reshape(len(points_m), len(points_m), TERMS)
            return among_many(shares, series, self._spectra(frequencies_hz).view(np.complex128))
        if points_m is forces_m:
            static, of_points = among, shares
        else:
            look = self.modes.lattice.interpolation(points_m)
            static, of_points = look @ stiffer, look @ self.modes.shapes
        static = static.reshape(len(points_m), len(forces_m), TERMS)
        # If points and forces are the same, each pair is computed once.
        row, column = np.indices(static.shape[:2])
        pair = np.nonzero(row >= column if points_m is forces_m else row >= 0)
        resonant = of_points[pair[0]] * shares[pair[1]]
        sums = (np.concatenate([resonant, static[pair]], axis=1) @ self._spectra(frequencies_hz)).view(np.complex128)
        answer = np.empty((*row.shape, len(frequencies_hz)), dtype=np.complex128)
        answer[pair] = sums
        if points_m is forces_m:
            answer[pair[::-1]] = sums
        return answer.transpose(2, 0, 1)

    def response_basis(self, forces_m: NDArray[np.float64]) -> LatticeBasis:
        """See `HasResponseBasis`."""
        shares, stiffer, _ = self._from_forces(forces_m)
        shapes = np.concatenate([self.modes.shapes, stiffer], axis=1)
        return LatticeBasis(self.modes.lattice, shapes, shares, self._spectra)

    def _pushed(self, forces_m: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
        """Value of every mode at every force (n_forces, n_modes); the series at the nodes (n_nodes, n_forces TERMS) and
        at the forces (n_forces, n_forces TERMS)."""
        forces = self.modes.lattice.interpolation(forces_m).T.toarray()
        stiffer = np.moveaxis(self.modes.stiffer(forces), 0, 2).reshape(len(forces), -1)
        return forces.T @ self.modes.shapes, stiffer, forces.T @ stiffer

    def _spectrum(self, frequencies_hz: NDArray[np.float64]) -> NDArray[np.float64]:
        """Alternating real and imaginary parts of each term at each frequency (n_modes + TERMS, 2 n_frequencies)."""
        loss = complex(1, self.loss_factor)
        z = self.plate.wavenumber_rad_m(frequencies_hz) ** 4 / loss
        modes = 1 / (self.modes.k4[:, None] - z)
        series = (z + self.modes.shift_k4) ** np.arange(TERMS)[:, None]
        terms = np.concatenate([modes, series]) / (self.plate.bending_stiffness_nm * loss)
        real: NDArray[np.float64] = np.ascontiguousarray(terms).view(np.float64)
        return real
