"""The methods that all physical models share: scenes of coupled plates, and single plates with edges."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common import checks
from scene2hap.common.blas_threads import one_blas_thread
from scene2hap.errors import ConfigError, ModelDomainError
from scene2hap.haptics import Bands
from scene2hap.propagation.bands.sampling import AROUND
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw, checked_law
from scene2hap.propagation.coupled.hand import Hand, checked_hand
from scene2hap.propagation.coupled.substructuring import CoupledField, prepare_coupled
from scene2hap.propagation.domain import THIN_WAVELENGTHS, OutsideDomain, as_frequencies, check_choice, warn_if_thick
from scene2hap.propagation.elastic_body import ElasticBody
from scene2hap.propagation.modal.estimates import n_rigid_motions
from scene2hap.propagation.plate import Plate, require_plate
from scene2hap.propagation.points import points_on
from scene2hap.propagation.protocol import ContactNetwork, Excitation


class PhysicalModel:
    """Base of the physical models, which are frozen data classes with these settings as fields.

    A model defines `elastic_body`, its body for coupling, and `_receptance`, its receptance of a single plate.
    """

    contact: ContactLaw
    outside_domain: OutsideDomain
    hand: Hand | None
    loss_floor: float = 0.0
    least_wavelength_in_thicknesses: ClassVar[float] = THIN_WAVELENGTHS
    usual_bands: ClassVar[Bands] = AROUND

    def __post_init__(self) -> None:
        checks.number("loss_floor", self.loss_floor, "-", at_least=0.0, at_most=2.0, error=ConfigError)
        check_choice(self.outside_domain)
        object.__setattr__(self, "contact", checked_law(self.contact))
        object.__setattr__(self, "hand", checked_hand(self.hand))

    def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands) -> CoupledField:
        """Prepare the field of a scene: all bodies coupled at their contacts; see `substructuring`.

        Raises: ModelDomainError: a plate that the model cannot solve; no loss at all, since a resonance is then
        infinite; an object outside the domain, if so configured. Warns: ThinPlateWarning, otherwise.
        """
        return prepare_coupled(self, network, excitations, bands, self.outside_domain)

    def elastic_body(self, plate: Plate, max_frequency_hz: float) -> ElasticBody:
        """Return a plate as a body for coupling up to `max_frequency_hz` [Hz]."""
        raise NotImplementedError  # each model defines it

    @one_blas_thread
    def plate_transfer(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Return the amplitude at points of one plate over that at the driven point; above 1 where the plate resonates.

        Parameters: drive_m : (2,) [m]; points_m : (n_points, 2) [m], from the plate's corner along length and width;
        frequencies_hz : (n_frequencies,) [Hz], >= 0; the result at 0 is the limit.
        Returns: (n_points, n_frequencies) complex128 [-].
        Raises: ModelDomainError: a point outside the plate; a driven point on an edge that does not move; a plate or
        frequency that the model cannot solve; no loss at all, since a resonance is then infinite.
        Warns: ThinPlateWarning: the wavelength falls below six thicknesses.
        """
        f = as_frequencies(frequencies_hz)
        warn_if_thick(plate, f)
        drive = points_on(plate, drive_m)
        if _is_held(plate, drive):
            raise ModelDomainError(
                f"the driven point ({drive[0, 0]:g}, {drive[0, 1]:g}) m lies on an edge that does not move (boundary "
                f"{plate.boundary!r}), so nothing can be related to its amplitude. Drive a point off the edge."
            )
        driven = self._receptance(plate, drive, drive, f)
        ratio: NDArray[np.complex128] = self._receptance(plate, drive, points_on(plate, points_m), f) / driven
        return ratio

    @one_blas_thread
    def plate_receptance(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Return the deflection at points over the force at the driven point.

        Parameters, errors and warnings: see `plate_transfer`. Differences: the deflection is 0 for a held point, and
        0 Hz is an error for a plate that nothing holds in place.
        Returns: (n_points, n_frequencies) complex128 [m/N].
        """
        f = _receptance_frequencies(plate, frequencies_hz)
        warn_if_thick(plate, f)
        return self._receptance(plate, points_on(plate, drive_m), points_on(plate, points_m), f)

    def _receptance(
        self, plate: Plate, drive_m: NDArray[np.float64], points_m: NDArray[np.float64], f: NDArray[np.float64]
    ) -> NDArray[np.complex128]:
        """See `plate_receptance`, for valid points (1, 2) and (n_points, 2) [m]; at 0 Hz the limit."""
        raise NotImplementedError  # not called for InfinitePlate, which has no edges


def _receptance_frequencies(plate: Plate, frequencies_hz: ArrayLike) -> NDArray[np.float64]:
    """As `as_frequencies`, but 0 Hz is an error for a plate that nothing holds: a constant force moves it away."""
    require_plate(plate)
    loose = "nothing holds this plate in place" if n_rigid_motions(plate) else ""
    return as_frequencies(frequencies_hz, positive_because=loose)


def _is_held(plate: Plate, drive_m: NDArray[np.float64]) -> bool:
    """Whether a point (1, 2) [m] is on an edge that holds the plate, as far as `points_on` tells points apart."""
    (x, y), tolerance = drive_m[0], 1e-6
    distances = (x / plate.length_m, 1 - x / plate.length_m, y / plate.width_m, 1 - y / plate.width_m)
    return any(edge != "F" and d <= tolerance for edge, d in zip(plate.edges, distances, strict=True))
