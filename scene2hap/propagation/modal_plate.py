"""The plate with edges: its modes, each a resonance, and the near field that they leave out.

    w(x) / F(x0) = sum over the Ritz spectrum of phi(x) phi(x0) / (D_c (k_n^4 - k_c^4))  +  residual(x, x0)
    D_c = D (1 + j eta)                  k_c^4 = k^4 / (1 + j eta)

The whole spectrum of `modes` is summed: modes up to 1.5 times the top frequency one by one, and the rest, which is too
stiff to resonate, by powers of the compliance. The residual is the near field beyond the polynomials; see `near_field`.

Letters: phi [1/m] shape normalised over the area, D [N m], k [rad/m], eta [-] loss factor, c complex. Time runs as
e^{+j omega t}.
Source: Cremer, Heckl, Petersson, Structure-Borne Sound, for the modal sum and complex stiffness.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.calls import clear_construction
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.bodies.modal_body import modal_body
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw, GivenLaw
from scene2hap.propagation.coupled.hand import GivenHand, Hand
from scene2hap.propagation.domain import OutsideDomain, floored_loss, off_zero
from scene2hap.propagation.elastic_body import ElasticBody
from scene2hap.propagation.modal.modes import MARGIN, plate_modes
from scene2hap.propagation.modal.near_field import NearField
from scene2hap.propagation.modal.ritz import products
from scene2hap.propagation.physical_model import PhysicalModel
from scene2hap.propagation.plate import Plate


@clear_construction
@dataclass(frozen=True)
class ModalPlate(PhysicalModel):
    """Physical model of a finite plate: a sum over its modes, with edges and resonances.

    Parameters: loss_floor : 0..2 [-], smallest loss factor of a plate. Tables give the loss of the bare material, 1e-4
    for a metal, while joints and supports bring assembled objects to 0.005-0.02; the default 0.01 lies between;
    contact : stiffness of contacts, or its settings; outside_domain : reaction to an object of a scene that is thicker
    than thin-plate theory allows (`domain.THIN_WAVELENGTHS`): "warn" once per object, "raise" or "ignore"; hand : load
    on an object at the touched point: "palm", "fingertip", a `Hand` or its settings, None for no load.
    Raises: ConfigError: a setting out of bounds.
    """

    loss_floor: float = 0.01
    contact: ContactLaw = field(default_factory=ContactLaw)
    outside_domain: OutsideDomain = "warn"
    hand: Hand | None = None
    kind: Literal["modal_plate"] = "modal_plate"

    if TYPE_CHECKING:

        def __init__(
            self,
            loss_floor: float = 0.01,
            contact: GivenLaw = ...,
            outside_domain: OutsideDomain = "warn",
            hand: GivenHand = None,
            kind: Literal["modal_plate"] = "modal_plate",
        ) -> None: ...

    def elastic_body(self, plate: Plate, max_frequency_hz: float) -> ElasticBody:
        """Return a plate as a body for coupling up to `max_frequency_hz` [Hz]; see `modal_body`."""
        _require_rectangle(plate)
        return modal_body(plate, max_frequency_hz, floored_loss(plate, self.loss_floor))

    def _receptance(
        self, plate: Plate, drive_m: NDArray[np.float64], points_m: NDArray[np.float64], f: NDArray[np.float64]
    ) -> NDArray[np.complex128]:
        _require_rectangle(plate)
        eta = floored_loss(plate, self.loss_floor)
        f = off_zero(plate, f)
        modes = plate_modes(plate, max_frequency_hz=MARGIN * float(f.max(initial=0.0)))
        k2 = plate.wavenumber_rad_m(f) ** 2 / np.sqrt(1 + 1j * eta)
        total = NearField(modes, drive_m)(points_m, k2)[:, 0]
        for block in modes.blocks:
            weights = block.deflections(points_m) * block.deflections(drive_m)
            total += weights @ (1 / (block.k4[:, None] - k2**2))
            answers = block.beyond(products(block.x, block.y, drive_m).T, k2**2)[:, 0]
            total += products(block.x, block.y, points_m) @ answers
        return total / (plate.bending_stiffness_nm * (1 + 1j * eta))


def _require_rectangle(plate: Plate) -> None:
    if plate.outline is not None:
        raise ModelDomainError(
            "ModalPlate is for rectangles, and this plate has an outline. Use MassSpringDamper or AutoFidelity, or "
            "leave the outline out."
        )
