"""A lattice alone, ready to be coupled: its receptance between any points, from its modes and the series beyond them.

    D_c Y(x, x0) = sum over modes of phi(x) phi(x0) / (k_n^4 - z)  +  sum over j of (z + s)^j R_j(x, x0)
    z = k^4 / (1 + j eta)

Letters: as `lattice_modes`; Y [m/N] receptance, D_c = D (1 + j eta) [N m].
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.lattice_modes import TERMS, lattice_modes
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.reached import Response
from scene2hap.propagation.recall import Recall


@lru_cache(maxsize=32)
def lattice_body(plate: Plate, resolution: int, max_frequency_hz: float, loss_factor: float) -> LatticeBody:
    """The body of a plate; remembered, since scenes are prepared anew whenever a contact changes."""
    return LatticeBody(plate, resolution, max_frequency_hz, loss_factor)


class LatticeBody:
    """An `ElasticBody` of masses and springs, for frequencies up to `max_frequency_hz`."""

    def __init__(self, plate: Plate, resolution: int, max_frequency_hz: float, loss_factor: float) -> None:
        self.plate = plate
        self.loss_factor = loss_factor
        self.modes = lattice_modes(plate, resolution, max_frequency_hz)
        self._from_forces = Recall(self._pushed)
        self._spectra = Recall(self._spectrum, room=4)

    def receptance(
        self, points_m: NDArray[np.float64], forces_m: NDArray[np.float64], frequencies_hz: NDArray[np.float64]
    ) -> NDArray[np.complex128]:
        """See `ElasticBody`."""
        look = self.modes.lattice.interpolation(points_m)
        shares, stiffer = self._from_forces(forces_m)
        resonant = (look @ self.modes.shapes)[:, None, :] * shares
        # (n_points, n_forces, n_modes + TERMS)
        terms = np.concatenate([resonant, (look @ stiffer).reshape(*resonant.shape[:2], TERMS)], axis=2)
        flat = terms.reshape(-1, terms.shape[2]) @ self._spectra(frequencies_hz)
        return flat.view(np.complex128).reshape(*terms.shape[:2], -1).transpose(2, 0, 1)

    def under(
        self, forces_m: NDArray[np.float64], frequencies_hz: NDArray[np.float64], forces: NDArray[np.complex128]
    ) -> Response:
        """See `Foldable`."""
        shares, stiffer = self._from_forces(forces_m)
        spectrum, n = self._spectra(frequencies_hz).view(np.complex128), shares.shape[1]
        summed = self.modes.shapes @ (spectrum[:n] * (shares.T @ forces))
        summed += stiffer @ (forces[:, None] * spectrum[n:]).reshape(-1, forces.shape[1])

        def response(points_m: NDArray[np.float64]) -> NDArray[np.complex128]:
            answer: NDArray[np.complex128] = np.asarray(self.modes.lattice.interpolation(points_m) @ summed)
            return answer

        return response

    def _pushed(self, forces_m: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Share of every mode in every force (n_forces, n_modes); the series at the nodes (n_nodes, n_forces TERMS)."""
        forces = self.modes.lattice.interpolation(forces_m).T.toarray()
        stiffer = np.moveaxis(self.modes.stiffer(forces), 0, 2)
        return forces.T @ self.modes.shapes, stiffer.reshape(len(forces), -1)

    def _spectrum(self, frequencies_hz: NDArray[np.float64]) -> NDArray[np.float64]:
        """Real and imaginary part, by turns, of each term at each frequency (n_modes + TERMS, 2 n_frequencies)."""
        loss = complex(1, self.loss_factor)
        z = self.plate.wavenumber_rad_m(frequencies_hz) ** 4 / loss
        modes = 1 / (self.modes.k4[:, None] - z)
        series = (z + self.modes.shift_k4) ** np.arange(TERMS)[:, None]
        terms = np.concatenate([modes, series]) / (self.plate.bending_stiffness_nm * loss)
        real: NDArray[np.float64] = np.ascontiguousarray(terms).view(np.float64)
        return real
