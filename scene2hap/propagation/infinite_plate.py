"""The plate without edges as a physical model, and its response alone. For the equations see `infinite_body`."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common.blas_threads import one_blas_thread
from scene2hap.common.calls import clear_construction
from scene2hap.propagation.bodies.idealisation import is_stiff
from scene2hap.propagation.bodies.infinite_body import (
    InfiniteBody,
    damped_wavenumber_rad_m,
    point_receptance_m_n,
    spreading,
)
from scene2hap.propagation.bodies.rigid import RigidMotion
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw, GivenLaw
from scene2hap.propagation.coupled.hand import GivenHand, Hand
from scene2hap.propagation.domain import OutsideDomain, as_frequencies, warn_if_thick
from scene2hap.propagation.physical_model import PhysicalModel
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.points import as_points

WAVELESS_HZ = 2000.0
"""First mode above which a free plate has no waves up to 1 kHz: a rigid body is then the better model."""

_FARTHEST_M = 1e9


@clear_construction
@dataclass(frozen=True)
class InfinitePlate(PhysicalModel):
    """Physical model of a plate without edges: the damped Green's function of an infinite plate.

    It ignores the length and the width of a plate, and has no resonances. In a scene, small stiff plates are rigid
    (`WAVELESS_HZ`).

    Parameters: contact : stiffness of contacts, or its settings; outside_domain : reaction to an object of a scene that
    is thicker than thin-plate theory allows (`domain.THIN_WAVELENGTHS`): "warn" once per object, "raise" or "ignore";
    hand : see `ModalPlate`.
    Raises: ConfigError: a setting out of bounds.
    """

    contact: ContactLaw = field(default_factory=ContactLaw)
    outside_domain: OutsideDomain = "warn"
    hand: Hand | None = None
    kind: Literal["infinite_plate"] = "infinite_plate"

    if TYPE_CHECKING:

        def __init__(
            self,
            contact: GivenLaw = ...,
            outside_domain: OutsideDomain = "warn",
            hand: GivenHand = None,
            kind: Literal["infinite_plate"] = "infinite_plate",
        ) -> None: ...

    def elastic_body(self, plate: Plate, max_frequency_hz: float) -> InfiniteBody | RigidMotion:
        """Return a plate as a body for coupling at any frequency; a plate without waves (`WAVELESS_HZ`) is rigid."""
        if plate.edges == "FFFF" and is_stiff(plate, WAVELESS_HZ):
            return RigidMotion.of_thin(plate)
        return InfiniteBody(plate, plate.material.loss_factor)

    @one_blas_thread
    def plate_transfer(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Return the amplitude at points of one plate over that at the driven point: Pi(k_c r).

        Parameters: drive_m : (2,) [m]; points_m : (n_points, 2) [m], from the plate's corner along length and width;
        frequencies_hz : (n_frequencies,) [Hz], >= 0.
        Returns: (n_points, n_frequencies) complex128 [-], at most 1 in magnitude.
        Raises: ModelDomainError: points or frequencies of another shape, or not finite.
        Warns: ThinPlateWarning: the wavelength falls below six thicknesses.
        """
        f = as_frequencies(frequencies_hz)
        warn_if_thick(plate, f)
        return _spread(plate, drive_m, points_m, f)

    @one_blas_thread
    def plate_receptance(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Return the deflection at points over the force at the driven point: -j Pi(k_c r) / (8 D_c k_c^2).

        Parameters, errors and warnings: see `plate_transfer`; frequencies must be above 0.
        Returns: (n_points, n_frequencies) complex128 [m/N].
        """
        f = as_frequencies(frequencies_hz, positive_because="nothing holds the infinite plate in place")
        warn_if_thick(plate, f)
        return _spread(plate, drive_m, points_m, f) * point_receptance_m_n(plate, plate.material.loss_factor, f)


def _spread(
    plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: NDArray[np.float64]
) -> NDArray[np.complex128]:
    # Beyond this distance the wave has vanished; the limit keeps squares of distances finite.
    offsets = np.clip(as_points(points_m, 2) - as_points(drive_m, 2), -_FARTHEST_M, _FARTHEST_M)
    r = np.hypot(offsets[:, 0], offsets[:, 1])
    return spreading(np.outer(r, damped_wavenumber_rad_m(plate, plate.material.loss_factor, frequencies_hz)))
