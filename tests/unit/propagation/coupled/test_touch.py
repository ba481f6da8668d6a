"""Precomputed sums of a touched body, against direct sums over contacts and modes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap import Bands, Contact, ContactNetwork, Excitation, Material, ModalPlate, Plate, Pose, materials
from scene2hap.propagation import elastic_body
from scene2hap.propagation.bands.band_shapes import CLOSE, band_gains
from scene2hap.propagation.bands.octaves import OctaveSums
from scene2hap.propagation.bands.sampling import Sampling
from scene2hap.propagation.bodies import modal_body
from scene2hap.propagation.bodies.infinite_body import SplitBody
from scene2hap.propagation.bodies.lattice_body import lattice_body
from scene2hap.propagation.bodies.modal_body import ModalBody
from scene2hap.propagation.bodies.rigid import RigidMotion
from scene2hap.propagation.elastic_body import contracted, pieces
from scene2hap.propagation.mass_spring_damper import MassSpringDamper
from scene2hap.propagation.protocol import ExpectantField

STEEL = Plate(0.65, 0.42, 0.002, materials.lookup("steel"))
RUG = Plate(2.0, 1.5, 0.01, Material("rug", 300.0, 2e6, 0.3, 0.3), "CFFF")
F_HZ = np.geomspace(11.0, 990.0, 200)


def bodies() -> dict[str, Any]:
    return {
        "steel": ModalPlate().elastic_body(STEEL, 1000.0),
        "rug": ModalPlate().elastic_body(RUG, 1000.0),
        "rigid": RigidMotion(1.3, (0.4, 0.42, 0.1)),
        "rigid that does not rock": RigidMotion(1.3),
        "lattice": lattice_body(Plate(0.6, 0.5, 0.01, materials.lookup("oak")), 8, 1000.0, 0.02),
    }


@pytest.mark.parametrize("name", ["steel", "rug", "lattice", "rigid"])
def test_folded_forces_are_the_sum_over_contacts(name: str) -> None:
    body = bodies()[name]
    if name == "rug":
        assert isinstance(body, SplitBody)
    rng = np.random.default_rng(5)
    f = rng.uniform(10.0, 1000.0, 6)  # unordered, like the frequencies of sources
    at, points = rng.uniform(0.0, 0.4, (9, 2)), rng.uniform(0.0, 0.42, (5, 2))
    forces = rng.normal(size=(9, 6)) + 1j * rng.normal(size=(9, 6))
    expected = np.einsum("fpc,cf->pf", body.receptance(points, at, f), forces)
    found = contracted(body, at, f, forces)(points).view(np.complex128)
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("name", ["steel", "lattice", "rigid", "rigid that does not rock"])
def test_shapes_of_bands_are_the_rms_over_frequencies(name: str) -> None:
    body = bodies()[name]
    rng = np.random.default_rng(6)
    sampling = Sampling.of(Bands.third_octaves(), (), 0.02)
    at, points = rng.uniform(0.0, 0.4, (9, 2)), rng.uniform(0.0, 0.42, (60, 2))
    # Forces of resonant bodies; one source is weak, and one has no force.
    resonances = 1 / (sampling.frequencies_hz[:, None] ** 2 - (1 + 0.02j) * np.array([50.0, 210.0, 700.0]) ** 2)
    forces = np.einsum("fr,rcs->fcs", resonances, rng.normal(size=(3, 9, 4))) * np.array([1.0, 3.0, 1e-9, 0.0])
    response = np.einsum("fpc,fcs->fps", body.receptance(points, at, sampling.frequencies_hz), forces)
    expected = np.sqrt([np.einsum("f,fps->ps", w, np.abs(response[one]) ** 2) for one, w in sampling.bands])
    found = band_gains(body.response_basis(at), forces, sampling, np.arange(4))(points).transpose(2, 0, 1)
    assert found.shape == (20, 60, 4)
    assert (np.abs(found - expected) <= CLOSE * expected.max(axis=1, keepdims=True)).all()


def test_expected_touch_gives_the_same_result() -> None:
    points, bands = [(0.31, 0.22, 0.0), (0.12, 0.4, 0.0)], Bands.third_octaves()
    field, expectant = (ModalPlate().prepare(scene(), SOURCES, bands) for _ in range(2))
    assert isinstance(expectant, ExpectantField)
    for object_id in ("top", "tray", "s0", "nobody knows"):
        expectant.expect(object_id)
    for object_id in ("top", "tray", "s0"):
        told, found = (one.attenuation(object_id, points) for one in (field, expectant))
        np.testing.assert_allclose(found, told, atol=CLOSE * told.max())


@pytest.mark.parametrize("boundary", ["CFFF", "SSSS"])
def test_a_force_on_a_held_edge_adds_nothing_to_an_expected_touch(boundary: str) -> None:
    """No shape of a lattice moves under a force on a held edge, so that the shapes of this force have no size."""
    plate = Plate(1.0, 0.6, 0.02, materials.lookup("oak"), boundary)
    contacts = [Contact("source", "held", (0.2, 0.2, 0.0)), Contact("wall", "held", (0.0, 0.3, 0.0))]
    network = ContactNetwork({"held": plate, "wall": Plate(1.0, 1.0, 0.1, materials.lookup("oak"))}, contacts)
    fields = [
        MassSpringDamper().prepare(network, [Excitation("source", 100.0, 120.0, 0.2)], Bands.third_octaves(80, 160))
        for _ in range(2)
    ]
    fields[1].expect("held")
    told, found = (field.attenuation("held", [(0.5, 0.4, 0.0), (0.9, 0.1, 0.0)]) for field in fields)
    np.testing.assert_allclose(found, told, atol=CLOSE * told.max())


@pytest.mark.parametrize("name", ["steel", "rug"])
def test_factored_terms_equal_the_receptance(name: str) -> None:
    body = bodies()[name]
    at, points = np.array([[0.1, 0.2], [0.3, 0.05]]), np.array([[0.2, 0.2], [0.0, 0.4], [0.4, 0.1]])
    expected = body.receptance(points, at, F_HZ)
    found = np.full_like(expected, np.nan)
    for part, own in pieces(body, points, at, F_HZ):
        assert own.flags.c_contiguous
        found[part] = own
    np.testing.assert_allclose(found, expected, rtol=1e-12)


@settings(max_examples=40)
@given(
    loss=st.floats(1e-4, 2.0),
    n_modes=st.integers(0, 120),
    n_f=st.integers(0, 300),
    is_rising=st.booleans(),
    seed=st.integers(0, 99),
)
def test_sums_by_octaves_are_sums_over_all_modes(
    loss: float, n_modes: int, n_f: int, is_rising: bool, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    k4 = np.sort(rng.uniform(0.0, 15.0, n_modes)) ** 4  # modal density of plates: k^2 grows with the mode number
    f = np.sort(10 ** rng.uniform(-2.0, 0.0, n_f)) if is_rising else 10 ** rng.uniform(-2.0, 0.0, n_f)
    q = (10 * np.sqrt(f)) ** 4 / complex(1.0, loss)
    others = rng.normal(size=(3, n_f)) + 1j * rng.normal(size=(3, n_f))
    terms = rng.normal(size=(4, n_modes + 3))
    plain = np.concatenate([1 / (k4[:, None] - q), others])
    found = OctaveSums(k4, others, q, 0.5 + 0.25j)(terms)
    size = np.abs(terms) @ np.abs(plain)
    assert (np.abs(found - terms @ plain * (0.5 + 0.25j)) <= 2e-12 * size).all()


def test_octaves_save_products_where_losses_are_small() -> None:
    k4 = np.linspace(0.0, 15.0, 120) ** 4
    q = (10 * np.sqrt(np.geomspace(0.01, 1.0, 500))) ** 4 / (1 + 0.01j)
    sums = OctaveSums(k4, np.zeros((0, 500), dtype=np.complex128), q, 1.0)
    products = sum(len(one.spectra) * (one.end - one.begin) for one in sums._octaves)
    assert products < 0.6 * 120 * 500


def scene(shift_m: float = 0.0) -> ContactNetwork:
    oak, glass = materials.lookup("oak"), materials.lookup("glass")
    plates = {"top": Plate(0.9, 0.5, 0.02, oak), "tray": Plate(0.4, 0.3, 0.004, glass), "shelf": STEEL}
    feet = [("tray", 0.1 + x, 0.1 + y) for x in (0.0, 0.2) for y in (0.0, 0.15)]
    contacts = [Contact(name, "top", (x + shift_m, y, 0.0)) for name, x, y in feet]
    contacts += [Contact("shelf", "top", (0.6, 0.1, 0.0)), Contact("shelf", "tray", (0.35, 0.3, 0.0))]
    for i, where in enumerate(("top", "shelf", "tray")):
        contacts += [
            Contact(f"s{i}", where, (0.2 + 0.1 * i + x, 0.2 + y, 0.0)) for x in (0.0, 0.05) for y in (0.0, 0.04)
        ]
    return ContactNetwork(plates, contacts, {"tray": Pose((0.05 + shift_m, 0.05, 0.0))})


SOURCES = [Excitation(f"s{i}", 100.0, 90.0 + 70.0 * i, 0.2) for i in range(3)]


@pytest.mark.parametrize("bands", [Bands.dominant(), Bands.third_octaves()])
def test_field_after_one_move_equals_a_new_field(bands: Bands) -> None:
    model, points = ModalPlate(), [(0.31, 0.22, 0.0), (0.12, 0.4, 0.0)]
    for shift_m in (0.0, 0.02, 0.04):
        field = model.prepare(scene(shift_m), SOURCES, bands)
    modal_body.modal_body.cache_clear()
    fresh = model.prepare(scene(0.04), SOURCES, bands)
    for object_id in ("top", "tray", "shelf"):
        np.testing.assert_allclose(
            field.attenuation(object_id, points), fresh.attenuation(object_id, points), rtol=1e-12
        )


def test_sources_beyond_the_folding_limit_are_summed(monkeypatch: pytest.MonkeyPatch) -> None:
    field, points = ModalPlate().prepare(scene(), SOURCES, Bands.dominant()), [(0.31, 0.22, 0.0), (0.12, 0.4, 0.0)]
    few = field.attenuation("top", points)
    monkeypatch.setattr(elastic_body, "MOST_CONTRACTED", 2)
    monkeypatch.setattr(ModalBody, "response_basis", None)
    many = ModalPlate().prepare(scene(), SOURCES, Bands.dominant()).attenuation("top", points)
    np.testing.assert_allclose(many, few, rtol=1e-12)
