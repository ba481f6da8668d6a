"""Objects lighter than the plate that their surface would be: a fused apron, a shell, a hollow door."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from scene2hap import (
    AutoFidelity,
    Bands,
    Box,
    Contact,
    ContactNetwork,
    Excitation,
    HapticSession,
    InfinitePlate,
    MassSpringDamper,
    ModalPlate,
    Plate,
    Pose,
    RigidBody,
    SceneObject,
    SceneSnapshot,
    Touch,
    bake,
    materials,
)
from scene2hap.propagation.bodies.idealisation import ESTIMATE, THINNEST, no_heavier_than_object

OAK = materials.lookup("oak")
THICK = Plate(1.2, 0.7, 0.12, OAK)
PHONE_KG = 0.5
MIDDLE_M = (0.6, 0.35, 0.0)


def gain_at_rest(plate: Plate, model: object = None) -> float:
    """Far below the first mode, under a source in the middle."""
    network = ContactNetwork({"table": plate}, (Contact("phone", "table", MIDDLE_M),), {"table": Pose()})
    source = Excitation("phone", 10.0, 10.0, PHONE_KG)
    field = (model or ModalPlate(outside_domain="ignore")).prepare(network, [source], Bands((2.0, 3.0)))
    return float(field.attenuation("table", [MIDDLE_M])[0, 0, 0])


@pytest.mark.parametrize("model", [ModalPlate(), MassSpringDamper(), AutoFidelity()])
@pytest.mark.parametrize("object_kg", [8.0, 20.0])
def test_a_light_object_moves_with_its_own_mass(model: object, object_kg: float) -> None:
    """Two free masses on a stiff contact: v / v_free = m_source / (m_source + m)."""
    found = gain_at_rest(replace(THICK, object_mass_kg=object_kg), model)
    assert found == pytest.approx(PHONE_KG / (PHONE_KG + object_kg), rel=0.03)


def test_the_stiffness_lies_between_joined_and_loose_sheets() -> None:
    """A box of two sheets of thickness t at a distance h outside: E (h^3 - (h - 2 t)^3) / 12 where they hold together,
    E t^3 / 12 for one of them alone; both over 1 - nu^2."""
    for part in (0.05, 0.1, 0.3, 0.5, 0.8):
        found = no_heavier_than_object(replace(THICK, object_mass_kg=part * THICK.mass_kg))
        assert found.mass_kg == pytest.approx(part * THICK.mass_kg)
        factor = OAK.youngs_modulus_pa / 12 / (1 - OAK.poisson_ratio**2)
        h, t = THICK.thickness_m, part * THICK.thickness_m / 2
        assert factor * t**3 < found.bending_stiffness_nm < factor * (h**3 - (h - 2 * t) ** 3)


def test_only_what_weighs_more_than_its_object_becomes_thinner() -> None:
    for mass_kg in (None, THICK.mass_kg, 2 * THICK.mass_kg):
        plate = replace(THICK, object_mass_kg=mass_kg)
        assert no_heavier_than_object(plate) is plate
    estimated = replace(THICK, object_mass_kg=THICK.mass_kg / 1.9, mass_is_estimate=True)
    assert no_heavier_than_object(estimated) is estimated
    light = replace(THICK, object_mass_kg=THICK.mass_kg / 10, mass_is_estimate=True)
    assert no_heavier_than_object(light).mass_kg == pytest.approx(ESTIMATE * THICK.mass_kg / 10)
    held = replace(THICK, object_mass_kg=1.0, boundary="CFFF")
    assert no_heavier_than_object(held) is held
    grams = replace(THICK, object_mass_kg=1e-6)
    assert no_heavier_than_object(grams).thickness_m == pytest.approx(THINNEST * THICK.thickness_m)


def test_infinite_plate_of_a_light_object_answers_by_its_mass_per_area() -> None:
    """Point mobility 1 / (8 sqrt(D m'')), with both of the thinner plate; it grows as h^-2."""
    f = np.array([200.0])
    half = no_heavier_than_object(replace(THICK, object_mass_kg=THICK.mass_kg / 2))
    at = np.array([[0.6, 0.35]])
    thick, thin = (abs(InfinitePlate().elastic_body(one, 400.0).receptance(at, at, f)) for one in (THICK, half))
    assert float(thin.ravel()[0] / thick.ravel()[0]) == pytest.approx(4.0, rel=1e-3)


def test_an_overridden_mass_reaches_a_thick_table() -> None:
    """A slab of 1.2 x 0.7 x 0.12 m, as of a table whose apron is fused to its top: far below its first mode it moves as
    the free mass that it was weighed at."""
    slab = SceneObject("wooden table", pose=Pose((0, 0.7, 0)), geometry=Box((1.2, 0.12, 0.7)))
    phone = SceneObject("smartphone", pose=Pose((0, 0.764, 0)), geometry=Box((0.07, 0.008, 0.15)))
    bundle = bake(SceneSnapshot.build([slab, phone])).override("smartphone", mass_kg=PHONE_KG)
    config = {"propagation": "modal_plate", "prepare": "blocking", "gain_limit_db": None, "bands": "third-octaves"}

    def gain(mass_kg: float) -> float:
        session = HapticSession(bundle.override("wooden table", mass_kg=mass_kg), config=config)
        return float(session.update(touches=[Touch("left", "wooden table", (0.0, 0.76, 0.0))]).gains.ravel()[0])

    for mass_kg in (12.0, 24.0):
        assert gain(mass_kg) == pytest.approx(PHONE_KG / (PHONE_KG + mass_kg), rel=0.05)


FOAM = materials.lookup("foam")


@pytest.mark.parametrize(
    ("thin", "thick"),
    [
        (Plate(0.5, 0.4, 0.0999, FOAM), Plate(0.5, 0.4, 0.1001, FOAM)),  # a fifth of the longer side
        # Solid by its mass, and just hollow.
        (Plate(0.5, 0.4, 0.0856, FOAM, object_mass_kg=0.6), Plate(0.5, 0.4, 0.0858, FOAM, object_mass_kg=0.6)),
    ],
)
def test_a_thick_soft_block_bends_as_one_that_is_a_little_thinner(thin: Plate, thick: Plate) -> None:
    """Foam has its first mode at 22 Hz, so that no thickness makes a cushion a rigid body."""
    levels = []
    for block in (thin, thick):
        contacts = [Contact("phone", "cushion", (x, y, 0.0)) for x in (0.12, 0.18) for y in (0.1, 0.14)]
        bodies: dict[str, Plate | RigidBody] = {"cushion": block, "phone": RigidBody(0.2, (0.06, 0.04, 0.01))}
        network = ContactNetwork(bodies, contacts, {"cushion": Pose(), "phone": Pose((0.12, 0.1, 0.05))})
        field = AutoFidelity(outside_domain="ignore").prepare(
            network, [Excitation("phone", 180.0, 180.0, 0.2)], Bands.dominant(0.5)
        )
        assert field.choices["cushion"].rung != "rigid"
        at = [(x, y, 0.0) for x in (0.25, 0.35, 0.48) for y in (0.05, 0.2, 0.38)]
        levels.append(20 * np.log10(field.attenuation("cushion", at)[:, 0, 0]))
    np.testing.assert_allclose(levels[0], levels[1], atol=0.5)
