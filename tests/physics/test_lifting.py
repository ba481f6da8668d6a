"""A source that is lifted off a table: its contacts fade, and nothing gets louder than at rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from scene2hap import Bands, Contact, ContactNetwork, Excitation, InfinitePlate, ModalPlate, Plate, Pose, RigidBody
from scene2hap.propagation.coupled.contact_stiffness import FADING_LOSS, ContactLaw
from scene2hap.propagation.coupled.joints import joints_of
from scene2hap.propagation.physical_model import PhysicalModel

UP = (0.0, 0.0, 1.0)
CORNERS = [Contact("table", "phone", (x, y, 0.01), UP) for x in (0.4, 0.46) for y in (0.2, 0.34)]
ON_TABLE = ContactNetwork(
    {"table": Plate(1.2, 0.7, 0.02, "oak"), "phone": RigidBody(0.2, (0.06, 0.14, 0.008))},
    CORNERS,
    {"table": Pose(), "phone": Pose((0.4, 0.2, 0.014))},
    "z",
)
WEIGHTS = np.append(np.geomspace(1e-3, 1.0, 40), np.linspace(0.05, 0.95, 40))


def faded(weight: float, n: int = 4) -> ContactNetwork:
    return replace(ON_TABLE, contacts=[*(replace(one, weight=weight) for one in CORNERS[:n]), *CORNERS[n:]])


@pytest.mark.parametrize("model", [InfinitePlate(), ModalPlate()])
@pytest.mark.parametrize("f", [60.0, 120.0, 180.0, 300.0])
def test_a_source_gets_no_louder_while_it_is_lifted(model: PhysicalModel, f: float) -> None:
    source, at = [Excitation("phone", f, f, 0.2)], np.array([[0.1, 0.1, 0.01], [0.8, 0.5, 0.01], [0.5, 0.3, 0.01]])

    def level_db(network: ContactNetwork) -> np.ndarray:
        gains = model.prepare(network, source, Bands.dominant(0.5)).attenuation("table", at)[:, 0, 0]
        decibels: np.ndarray = 20 * np.log10(gains)
        return decibels

    rest = level_db(ON_TABLE)
    assert max((level_db(faded(float(w))) - rest).max() for w in WEIGHTS) < 1.0
    assert (level_db(faded(1e-4)) < rest - 20).all()


def test_a_contact_that_touches_is_that_of_the_law() -> None:
    law, ids = ContactLaw(), {"table", "phone"}
    at_rest, fading = (joints_of(one, ids, law, {}) for one in (ON_TABLE, faded(0.25)))
    for full, weak in zip(at_rest, fading, strict=True):
        assert full.loss_factor == law.loss_floor
        assert weak.stiffness_n_m == pytest.approx(0.25 * full.stiffness_n_m)
        assert weak.loss_factor == full.loss_factor + 0.75 * FADING_LOSS
