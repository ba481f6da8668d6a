"""AutoFidelity: for each object the cheapest physical model within a stated error, with its reason.

A rung of `auto_rungs` is chosen for every plate that a source can reach, before anything is solved. All plates are then
coupled by `substructuring`. The most expensive rung is `ModalPlate` itself, so a scene never costs more than with it.
Errors along a chain of plates are independent, so each plate may use the whole tolerance: the total error of real
scenes stays within it (docs/figures/propagation.md). A fifth of the tolerance allows coarser sampling of bands:

    error = 2 exp(-pi / d) of a resonance's power, sampled at d half-power widths

Letters: d [-] distance of frequencies.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from operator import add
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.blas_threads import one_blas_thread
from scene2hap.common.calls import clear_construction
from scene2hap.errors import ConfigError
from scene2hap.haptics import Bands
from scene2hap.propagation.auto_level import peak_level_db
from scene2hap.propagation.auto_rungs import Choice, PlateCase, body_of
from scene2hap.propagation.bands.sampling import SPACING
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw, GivenLaw
from scene2hap.propagation.coupled.coupling import Joint
from scene2hap.propagation.coupled.hand import GivenHand, Hand
from scene2hap.propagation.coupled.substructuring import Assembly, CoupledField, assemble
from scene2hap.propagation.domain import OutsideDomain, floored_loss, off_zero
from scene2hap.propagation.elastic_body import ElasticBody
from scene2hap.propagation.physical_model import PhysicalModel
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import ContactNetwork, Excitation

SAMPLING_SHARE = 0.2
"""Part of the tolerance [-] that coarser sampling of bands may use."""


@dataclass(frozen=True, eq=False)
class AutoField(CoupledField):
    """A prepared scene, with the model of each object in `choices`."""

    choices: Mapping[str, Choice] = field(default_factory=dict)

    def explain(self) -> str:
        """Return the choices as text, one line for each object that a source reaches."""
        return "\n".join(str(choice) for choice in self.choices.values())


@clear_construction
@dataclass(frozen=True)
class AutoFidelity(PhysicalModel):
    """Physical model that picks the cheapest of six plate models for each object, within a stated error.

    Parameters: tolerance_db : 0.1..6 [dB], allowed error of a band's gain against `ModalPlate`; gains below -40 dB re
    the source count as -40 dB. The tolerance held in all of 1,570 touches in real scenes
    (docs/figures/propagation.md); loss_floor, contact, outside_domain, hand : see `ModalPlate`.
    Raises: ConfigError: a setting out of bounds.
    """

    tolerance_db: float = 1.0
    loss_floor: float = 0.01
    contact: ContactLaw = field(default_factory=ContactLaw)
    outside_domain: OutsideDomain = "warn"
    hand: Hand | None = None
    kind: Literal["auto"] = "auto"
    follows_outlines: ClassVar[bool] = True

    if TYPE_CHECKING:

        def __init__(
            self,
            tolerance_db: float = 1.0,
            loss_floor: float = 0.01,
            contact: GivenLaw = ...,
            outside_domain: OutsideDomain = "warn",
            hand: GivenHand = None,
            kind: Literal["auto"] = "auto",
        ) -> None: ...

    def __post_init__(self) -> None:
        checks.number("tolerance_db", self.tolerance_db, "dB", at_least=0.1, at_most=6.0, error=ConfigError)
        super().__post_init__()

    @one_blas_thread
    def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands) -> AutoField:
        """Prepare the field of a scene, with each object's rung in `choices`. Errors and warnings: see `ModalPlate`."""
        scene = assemble(network, excitations, bands, self.contact, self.outside_domain)
        choices = {key: Choice(key, "rigid", 0.0, "a source, or so stiff that every rung is") for key in scene.rigid}
        for object_id in sorted(scene.plates):
            choices[object_id] = self._case(scene, object_id).choose(object_id, self.tolerance_db)
        elastic = {
            key: body_of(choices[key].rung, plate, scene.top_hz, floored_loss(plate, self.loss_floor))
            for key, plate in scene.plates.items()
        }
        solved = scene.solve(elastic, self._density(), self.hand)
        of_field = solved.source_ids, solved.bands, solved.network, solved.sampling, solved.reach
        return AutoField(*of_field, dict(sorted(choices.items())))

    def choose(self, plate: Plate, max_frequency_hz: float) -> Choice:
        """Choose the model of a single plate, for frequencies up to `max_frequency_hz` [Hz]."""
        case = PlateCase(plate, floored_loss(plate, self.loss_floor), max_frequency_hz)
        return case.choose("plate", self.tolerance_db, may_be_infinite=False)

    def elastic_body(self, plate: Plate, max_frequency_hz: float) -> ElasticBody:
        """Return a plate as a body for coupling up to `max_frequency_hz` [Hz], of the rung of `choose`."""
        rung = self.choose(plate, max_frequency_hz).rung
        return body_of(rung, plate, max_frequency_hz, floored_loss(plate, self.loss_floor))

    def _receptance(
        self, plate: Plate, drive_m: NDArray[np.float64], points_m: NDArray[np.float64], f: NDArray[np.float64]
    ) -> NDArray[np.complex128]:
        f = off_zero(plate, f)
        return self.elastic_body(plate, float(f.max(initial=1e-9))).receptance(points_m, drive_m, f)[:, :, 0].T

    def _case(self, scene: Assembly, object_id: str) -> PlateCase:
        plate, pushing = scene.plates[object_id], scene.beside[object_id]
        case = PlateCase(plate, floored_loss(plate, self.loss_floor), scene.top_hz, load_kg=load_kg(scene, object_id))
        mass_kg = {item.source_id: item.mass_kg for item in scene.excitations}
        if not pushing.keys() <= mass_kg.keys():
            return case  # the motion of an object that is no source is unknown before the scene is solved
        own_hz = [
            edge
            for item in scene.excitations
            if item.source_id in pushing
            for edge in scene.bands.around_hz(item.frequency_tactile_hz)
        ]
        pushed_by = [(mass_kg[key], several) for key, several in pushing.items()]
        joints = [joint for several in pushing.values() for joint in several]
        places = [joint.point_a_m if joint.a == object_id else joint.point_b_m for joint in joints]
        peak = peak_level_db(plate, case.loss_factor, pushed_by, places, scene.bands, own_hz)
        return replace(case, peak_db=peak)

    def _density(self) -> float:
        """Density of frequencies relative to that of `sampling`, for `SAMPLING_SHARE` of the tolerance."""
        spacing = math.pi / math.log(2 / (10 ** (SAMPLING_SHARE * self.tolerance_db / 10) - 1))
        return min(1.0, SPACING / min(spacing, 1.0))


def load_kg(scene: Assembly, object_id: str) -> float:
    """Mass with the inertia of the greatest forces that others exert on an object at the top frequency [kg].

    A rigid body that touches nothing else exerts no more than its own mass, any other no more than its contacts.
    Only forces along the normal bend the object.
    """
    loads_kg = []
    for other, joints in scene.beside[object_id].items():
        # Not `sum`, which rounds otherwise from Python 3.12 on.
        stiffnesses_n_m = [joint.stiffness_n_m * _along_normal(joint, object_id) ** 2 for joint in joints]
        kg = reduce(add, (k / (2 * math.pi * scene.top_hz) ** 2 for k in stiffnesses_n_m))
        is_free = other in scene.rigid and len(scene.beside[other]) == 1
        loads_kg.append(min(kg, scene.rigid[other].mass_kg) if is_free else kg)
    return sum(loads_kg)


def _along_normal(joint: Joint, object_id: str) -> float:
    """Component of a joint's direction along the normal of one of its objects."""
    return (joint.along_a if joint.a == object_id else joint.along_b).z
