"""Leg masses at the feet of an object, against the same masses as separate bodies, and the total mass."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap import Bands, Contact, ContactNetwork, Excitation, InfinitePlate, ModalPlate, Plate, Pose, materials
from scene2hap.propagation.bodies.legged_body import LeggedShapes, legged
from scene2hap.propagation.bodies.rigid import RigidMotion
from scene2hap.propagation.coupled.coupling import Joint, couple
from scene2hap.propagation.coupled.joints import legs_of
from scene2hap.propagation.elastic_body import contracted

OAK = materials.lookup("oak")
TOP = Plate(1.2, 0.7, 0.02, OAK)
LEGS_M = np.array([(0.05, 0.05), (1.15, 0.05), (0.05, 0.65), (1.15, 0.65)])
MASSES_KG = np.array([1.0, 1.5, 0.8, 2.0])
F_HZ = np.array([20.0, 47.0, 111.0, 260.0, 730.0])


def test_legged_plate_equals_a_plate_coupled_to_its_legs() -> None:
    top = ModalPlate().elastic_body(TOP, 1000.0)
    legs = {f"leg {k}": RigidMotion(float(m)) for k, m in enumerate(MASSES_KG)}
    source = RigidMotion(0.4)
    on_top = Joint("top", "source", (0.4, 0.3), (0.0, 0.0), 3e5, 0.1)
    rigid = [Joint("top", name, tuple(LEGS_M[k].tolist()), (0.0, 0.0)) for k, name in enumerate(legs)]
    points = np.random.default_rng(1).uniform(0.02, 0.68, (6, 2))
    apart = couple({"top": top, "source": source, **legs}, [on_top, *rigid], ["source"], F_HZ)
    together = couple({"top": legged(top, LEGS_M, MASSES_KG), "source": source}, [on_top], ["source"], F_HZ)
    expected = apart.deflection("top", points)
    np.testing.assert_allclose(together.deflection("top", points), expected, rtol=1e-6, atol=1e-9 * abs(expected).max())


def test_legged_plate_moves_with_its_total_mass_below_its_first_mode() -> None:
    top = ModalPlate().elastic_body(TOP, 1000.0)
    middle, f = np.array([[0.6, 0.35]]), np.array([1.0])
    masses = np.full(4, 1.5)
    found = legged(top, LEGS_M, masses).receptance(middle, middle, f)[0, 0, 0]
    assert found == pytest.approx(-1 / (TOP.mass_kg + 6.0) / (2 * np.pi) ** 2, rel=5e-3)


@settings(max_examples=40)
@given(st.integers(0, 500), st.integers(1, 5), st.floats(3.0, 1000.0))
def test_legged_plate_is_passive(seed: int, n_legs: int, f: float) -> None:
    rng = np.random.default_rng(seed)
    body = legged(
        InfinitePlate().elastic_body(TOP, 1000.0),
        rng.uniform(0, 1, (n_legs, 2)) * (1.2, 0.7),
        10 ** rng.uniform(-3, 2, n_legs),
    )
    at = rng.uniform(0, 1, (4, 2)) * (1.2, 0.7)
    found = body.receptance(at, at, np.array([f]))[0]
    np.testing.assert_array_equal(found, found.T)
    assert np.linalg.eigvalsh(found.imag).max() <= 1e-9 * np.abs(found).max()


def test_precomputed_sums_equal_the_direct_sum() -> None:
    body = legged(ModalPlate().elastic_body(TOP, 1000.0), LEGS_M, MASSES_KG)
    assert isinstance(body, LeggedShapes)
    rng = np.random.default_rng(4)
    at, points = rng.uniform(0, 0.7, (3, 2)), rng.uniform(0, 0.7, (5, 2))
    forces = rng.normal(size=(3, 5)) + 1j * rng.normal(size=(3, 5))
    expected = np.einsum("fpc,cf->pf", body.receptance(points, at, F_HZ), forces)
    found = contracted(body, at, F_HZ, forces)(points).view(np.complex128)
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(expected).max())


def on_a_floor(table: Plate, leg_m: float) -> ContactNetwork:
    """A table whose feet are `leg_m` below its top."""
    feet = [Contact("floor", "table", (x, y, -leg_m), normal=(0.0, 0.0, 1.0)) for x, y in LEGS_M.tolist()]
    phone = Contact("table", "phone", (0.4, 0.3, 0.01), normal=(0.0, 0.0, 1.0))
    floor = Plate(4.0, 3.0, 0.15, materials.lookup("concrete"))
    return ContactNetwork(
        {"table": table, "floor": floor}, [*feet, phone], {"table": Pose(), "floor": Pose((-1.0, -1.0, -leg_m))}
    )


def test_only_objects_with_legs_get_leg_masses() -> None:
    heavy = replace(TOP, object_mass_kg=25.0)
    assert legs_of(on_a_floor(heavy, 0.7), "table", heavy) == sorted(map(tuple, LEGS_M.tolist()))
    assert legs_of(on_a_floor(heavy, 0.01), "table", heavy) == []
    phone, at = [Excitation("phone", 150.0, 150.0, 0.2)], [[1.0, 0.5, 0.0]]

    def level(table: Plate, leg_m: float) -> float:
        field = ModalPlate().prepare(on_a_floor(table, leg_m), phone, Bands.dominant(0.5))
        return float(20 * np.log10(field.attenuation("table", at)[0, 0, 0]))

    # An unknown mass, or one not above the plate's, changes nothing; legs of 11 kg do.
    assert level(TOP, 0.7) == pytest.approx(level(TOP, 0.01), abs=1e-9)
    light = replace(TOP, object_mass_kg=TOP.mass_kg)
    assert abs(level(heavy, 0.7) - level(light, 0.7)) > 0.5
