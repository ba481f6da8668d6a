"""A common reference level, so that one model can replace another.

The paper's law starts at a gain of 1 where a source stands, and decays. A source that is a mass on a plate moves the
plate less, and a resonant plate more. Replacing one model by another therefore changes every level by -16 to +37 dB.
`FeltNear` scales each source by one factor, so that 0.1 m from where the source stands, its level is that of the law.
The model's dependence on distance, frequency and objects is kept.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats
from scene2hap.common.calls import clear_construction
from scene2hap.haptics import Bands
from scene2hap.propagation.exponential_plate import ExponentialPlate
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import (
    Carrier,
    CarryingField,
    ContactNetwork,
    Excitation,
    ExpectantField,
    PropagationField,
    PropagationModel,
    follows_poses,
)
from scene2hap.scene.pose import Pose

NEAR_M = 0.1
"""Distance from where a source stands at which its level is that of the law [m]."""
LARGEST = 1e3
"""Largest factor by which a source is raised or lowered [-], so that faint sources are not raised without limit."""
_N_AROUND = 8
"""Points on the ring around a source, over which its level is averaged (assumed: some of them are near nodes)."""


@clear_construction
@dataclass(frozen=True)
class FeltNear:
    """A model with the reference level of the paper's law, at `NEAR_M` from where each source stands.

    Parameters: model : any model; the gain on a source itself stays 1.
    """

    model: PropagationModel
    kind: Literal["felt_near"] = "felt_near"

    @property
    def usual_bands(self) -> Bands:
        """The usual bands of the model."""
        return getattr(self.model, "usual_bands", Bands.dominant())

    @property
    def follows_outlines(self) -> bool:
        """Whether the model follows outlines."""
        return getattr(self.model, "follows_outlines", False)

    @property
    def follows_poses(self) -> bool:
        """Whether the model's gains depend on poses."""
        return follows_poses(self.model)

    def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands) -> PropagationField:
        """Prepare the model's field and scale it. Raises, warns: see the model."""
        field = self.model.prepare(network, excitations, bands)
        law = ExponentialPlate().prepare(network, excitations, bands)
        factors = _factors(field, law, _rings(network, excitations))
        return _ScaledCarryingField(field, factors) if isinstance(field, CarryingField) else ScaledField(field, factors)


@dataclass(frozen=True, eq=False)
class ScaledField:
    """A field whose gains are scaled by a factor for each source, except on the source itself."""

    field: PropagationField
    factors: Mapping[str, float]

    @property
    def source_ids(self) -> tuple[str, ...]:
        """Ids of the sources; see `PropagationField`."""
        return self.field.source_ids

    def attenuation(self, object_id: str, points_m: NDArray[np.float64]) -> Floats:
        """See `PropagationField`."""
        factors = [1.0 if key == object_id else self.factors[key] for key in self.source_ids]
        found: Floats = self.field.attenuation(object_id, points_m) * np.array(factors)[:, None]
        return found

    def expect(self, object_id: str) -> None:
        """See `ExpectantField`; has no effect if `field` is not one."""
        if isinstance(self.field, ExpectantField):
            self.field.expect(object_id)


class _ScaledCarryingField(ScaledField):
    def carriers(self, object_id: str, source_id: str, band: int) -> tuple[Carrier, ...]:
        """See `CarryingField`; shares do not depend on the level."""
        assert isinstance(self.field, CarryingField)
        return self.field.carriers(object_id, source_id, band)


def _rings(network: ContactNetwork, excitations: Sequence[Excitation]) -> dict[str, list[tuple[str, Floats]]]:
    """For each object with sources on it: the sources, and points (n, 3) [m] of its body around each source."""
    stands: dict[tuple[str, str], list[tuple[float, float, float]]] = {}
    source_ids = {item.source_id for item in excitations}
    for contact in network.contacts:
        for source_id, other in ((contact.a, contact.b), (contact.b, contact.a)):
            if source_id in source_ids and other in network.bodies and contact.weight > 0:
                stands.setdefault((other, source_id), []).append(contact.point_m)
    angles = 2 * np.pi * np.arange(_N_AROUND) / _N_AROUND
    around = NEAR_M * np.column_stack([np.cos(angles), np.sin(angles)])
    rings: dict[str, list[tuple[str, Floats]]] = {}
    for (other, source_id), points_m in stands.items():
        body = network.bodies[other]
        own = network.on_body(other, points_m).mean(axis=0) + around
        if isinstance(body, Plate):
            own = own.clip(0.0, [body.length_m, body.width_m])
        ring = network.poses.get(other, Pose()).to_world(np.column_stack([own, np.zeros(_N_AROUND)]))
        rings.setdefault(other, []).append((source_id, ring))
    return rings


def _factors(
    field: PropagationField, law: PropagationField, rings: Mapping[str, list[tuple[str, Floats]]]
) -> dict[str, float]:
    """Factor of each source; 1 if it stands on nothing or has no gain at the reference points."""
    power = {source_id: np.zeros(2) for source_id in field.source_ids}
    for other, around in rings.items():
        points = np.concatenate([ring for _, ring in around])
        for k, one in enumerate((field, law)):
            squares = np.square(one.attenuation(other, points)).sum(axis=2)
            for n, (source_id, _) in enumerate(around):
                column = one.source_ids.index(source_id)
                power[source_id][k] += squares[n * _N_AROUND : (n + 1) * _N_AROUND, column].sum()
    return {
        source_id: float(np.clip(np.sqrt(by_law / own), 1 / LARGEST, LARGEST)) if own > 0 and by_law > 0 else 1.0
        for source_id, (own, by_law) in power.items()
    }
