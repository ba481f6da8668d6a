"""Bodies: rigid or elastic classification, points of the world on a body, and caches of responses."""

import math
import weakref
from collections import OrderedDict
from dataclasses import replace

import numpy as np
import pytest

from garbage import no_garbage_collection
from scene2hap import (
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    InfinitePlate,
    ModalPlate,
    Plate,
    Pose,
    RigidBody,
    materials,
    plate_modes,
)
from scene2hap.common import caches
from scene2hap.common.caches import ByteBoundedLru
from scene2hap.errors import ConfigError, ModelDomainError
from scene2hap.propagation.bands.sampling import Sampling
from scene2hap.propagation.bodies.idealisation import is_compact
from scene2hap.propagation.bodies.infinite_body import InfiniteBody, SplitBody
from scene2hap.propagation.bodies.modal_body import ModalBody
from scene2hap.propagation.bodies.rigid import RigidMotion
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.modal.estimates import first_bending_hz

OAK, STEEL, CERAMIC, FOAM = (materials.lookup(name) for name in ("oak", "steel", "ceramic", "foam"))


@pytest.mark.parametrize(
    ("plate", "compact"),
    [
        (Plate(1.2, 0.7, 0.025, OAK), False),
        (Plate(0.5, 0.3, 0.101, OAK), False),  # thick, but with a first mode at 2 kHz
        (Plate(0.5, 0.4, 0.15, FOAM), False),
        (Plate(0.5, 0.4, 0.15, FOAM, object_mass_kg=0.6), False),  # no box: as a solid beam it bends at 33 Hz
        (Plate(0.5, 0.3, 0.061, OAK, object_mass_kg=1.0), True),  # hollow, and thicker than a fifth of the shorter
        (Plate(0.5, 0.3, 0.059, OAK, object_mass_kg=1.0), False),
        (Plate(1.0, 0.09, 0.02, OAK), False),  # a slender bar
        (Plate(0.09, 0.08, 0.012, CERAMIC), False),
        (Plate(0.09, 0.08, 0.012, CERAMIC, object_mass_kg=0.1), True),  # hollow: the plate would weigh 0.2 kg
        (Plate(0.04, 0.03, 0.005, CERAMIC), True),  # first mode above 10 kHz
        (Plate(0.3, 0.3, 0.002, STEEL), False),
        (Plate(0.04, 0.03, 0.005, CERAMIC, "CFFF"), False),  # clamped: as a rigid body it could not move
    ],
)
def test_compact_bodies(plate: Plate, compact: bool) -> None:
    assert is_compact(plate) == compact


def test_a_narrow_bar_resonates_as_a_beam_does() -> None:
    length, thickness = 1.0, 0.02
    bar = Plate(length, 0.09, thickness, OAK)
    E, density = OAK.youngs_modulus_pa, OAK.density_kg_m3
    # Free at both ends: (k L)^2 = 22.373; Blevins, Formulas for Natural Frequency and Mode Shape, table 8-1.
    beam_hz = 22.373 / (2 * math.pi * length**2) * math.sqrt(E * thickness**2 / (12 * density))
    frequencies = beam_hz * np.geomspace(0.85, 1.15, 31)
    network = ContactNetwork({"bar": bar}, [Contact("bar", "motor", (0.0, 0.045, 0.0))], {"bar": Pose()})
    levels = []
    for f in frequencies:
        field = ModalPlate().prepare(network, [Excitation("motor", float(f), float(f), 1e-4)], Bands.dominant())
        levels.append(field.attenuation("bar", [(length, 0.045, 0.0)])[0, 0, 0])
    assert frequencies[np.argmax(levels)] == pytest.approx(beam_hz, rel=0.02)
    assert max(levels) > 5 * min(levels)


def test_without_edges_a_small_stiff_plate_is_rigid_and_a_large_one_infinite() -> None:
    assert isinstance(InfinitePlate().elastic_body(Plate(0.09, 0.08, 0.012, CERAMIC), 1000.0), RigidMotion)
    assert isinstance(InfinitePlate().elastic_body(Plate(1.2, 0.7, 0.025, OAK), 1000.0), InfiniteBody)
    assert isinstance(InfinitePlate().elastic_body(Plate(0.09, 0.08, 0.012, CERAMIC, "CFFF"), 1000.0), InfiniteBody)


def test_a_body_without_edges_answers_as_its_formula_far_away_and_with_loss() -> None:
    """Its table takes the phase and the decay of the wave out and puts them back."""
    plate = Plate(1.2, 0.7, 0.025, replace(OAK, loss_factor=0.1))
    at, points = np.zeros((1, 2)), np.array([[0.0, 0.1], [1.0, 0.5], [7.0, 0.0]])
    found = InfiniteBody(plate, 0.1).receptance(points, at, np.array([400.0]))[0, :, 0]
    expected = InfinitePlate().plate_receptance(plate, at[0], points, [400.0])[:, 0]
    np.testing.assert_allclose(found, expected, rtol=1e-3)


def test_a_rigid_body_of_known_size_rocks() -> None:
    body = RigidBody(1.0, size_m=(0.3, 0.2, 0.1))
    sizes = [RigidMotion.of(one, 1.0, rocks=rocks).size_m for one in (body, None) for rocks in (True, False)]
    assert sizes == [(0.3, 0.2, 0.1), None, None, None]


@pytest.mark.parametrize("edges", ["free", "CFFF", "SSFF", "SSSS", "FFFS", "CCSF"])
@pytest.mark.parametrize("size", [(0.3, 0.3), (0.5, 0.11)])
def test_the_quick_first_mode_is_the_first_mode(edges: str, size: tuple[float, float]) -> None:
    plate = Plate(*size, 0.004, STEEL, edges)
    frequencies = plate_modes(plate, 6).frequencies_hz
    assert first_bending_hz(plate) == pytest.approx(frequencies[frequencies > 1e-6][0], rel=2e-3)


@pytest.mark.parametrize("aspect", [30.0, 1e3, 3e3, 1e5])
@pytest.mark.parametrize(
    ("edges", "root", "error"), [("FFFF", 4.7300407, 1e-3), ("SFFF", 3.9266023, 1e-3), ("CFFF", 1.8751041, 1e-2)]
)
def test_the_first_mode_of_a_strip_is_that_of_a_beam(edges: str, root: float, error: float, aspect: float) -> None:
    """Euler and Bernoulli's beam, whose sides are free to curve: E h^2 / (12 rho) instead of D / (rho h)."""
    thickness_m = 0.1 / aspect
    wave_m2_s = thickness_m * math.sqrt(STEEL.youngs_modulus_pa / (12 * STEEL.density_kg_m3))
    strip = Plate(1.0, 1.0 / aspect, thickness_m, STEEL, edges)
    assert first_bending_hz(strip) == pytest.approx(root**2 / (2 * math.pi) * wave_m2_s, rel=error)


def test_world_points_are_mapped_to_the_body() -> None:
    turn = Pose((1.0, 2.0, 3.0), (0.5**0.5, 0.0, 0.0, 0.5**0.5))  # z of the plate points along -y
    network = ContactNetwork({"p": Plate(1.0, 0.5, 0.01, OAK), "r": RigidBody(1.0)}, (), {"p": turn})
    points = turn.to_world([[0.2, 0.3, 0.0], [0.2, 0.3, -0.7], [1.4, -0.2, 0.0]])
    np.testing.assert_allclose(network.on_body("p", points), [[0.2, 0.3], [0.2, 0.3], [1.0, 0.0]], atol=1e-12)
    np.testing.assert_allclose(network.on_body("r", points), points[:, :2])
    np.testing.assert_allclose(network.on_body("nobody", points), points[:, :2])
    with pytest.raises(ModelDomainError, match="n_points, 3"):
        network.on_body("p", [[0.0, 0.0]])


def test_a_rug_has_edges_only_where_waves_come_back() -> None:
    rug = Plate(2.0, 1.5, 0.01, materials.Material("felt", 300.0, 2e6, 0.2, 0.3))
    body = ModalPlate().elastic_body(rug, 1000.0)
    assert isinstance(body, SplitBody)
    f = np.array([0.9, 1.1]) * body.limit_hz
    at = np.array([[1.0, 0.75]])
    below, above = body.receptance(at, at, f)[:, 0, 0]
    assert above == pytest.approx(InfinitePlate().plate_receptance(rug, at[0], at, f[1:])[0, 0], rel=1e-3)
    # The loss is so large that the edges hardly affect the middle: no step where one body takes over from the other.
    assert abs(20 * math.log10(abs(below / above) * f[0] / f[1])) < 1.0
    assert isinstance(ModalPlate().elastic_body(Plate(1.2, 0.7, 0.025, OAK), 1000.0), ModalBody)


def test_frequencies_of_bands() -> None:
    bands, source = Bands.third_octaves(), [Excitation("s", 99.0, 44.0), Excitation("t", 99.0, 55.0)]
    sampling = Sampling.of(bands, source, 0.01)
    assert sampling.is_shared
    for (at, _), (low, high) in zip(sampling.bands, bands.widths_hz(), strict=True):
        inside = sampling.frequencies_hz[at]
        assert low < inside.min() < inside.max() < high
        assert np.diff(inside).max() <= 0.55 * 0.01 * low * (1 + 1e-9)
        assert inside.mean() == pytest.approx((low + high) / 2)
    flat = sampling.gains(np.full((len(sampling.frequencies_hz), 3, 2), 0.6 + 0.8j), np.array([0, 1]))
    np.testing.assert_allclose(flat, np.ones((3, 2, 20)))
    assert len(Sampling.of(bands, source, math.inf).frequencies_hz) == 20 * 8
    assert Sampling.of(Bands.dominant(), source, 0.01).frequencies_hz.tolist() == [44.0, 55.0]


def test_the_cache_computes_once_and_drops_the_least_recently_used() -> None:
    asked: list[float] = []
    twice = ByteBoundedLru(lambda array: asked.append(float(array[0])) or 2 * array, room=2)
    for value in (1.0, 1.0, 2.0, 1.0, 3.0, 2.0, 1.0):
        assert twice(np.array([value]))[0] == 2 * value
    assert asked == [1.0, 2.0, 3.0, 2.0, 1.0]


def test_caches_share_one_limit_of_bytes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(caches, "MOST_BYTES", 3 * 8000)
    monkeypatch.setattr(ByteBoundedLru, "_shelf", OrderedDict())
    monkeypatch.setattr(ByteBoundedLru, "_held_bytes", 0)
    asked: list[float] = []
    one, other = (
        ByteBoundedLru(lambda array: asked.append(float(array[0])) or np.full(1000, array[0])) for _ in range(2)
    )
    for which, value in ((one, 1.0), (other, 2.0), (one, 3.0), (one, 1.0), (other, 4.0), (one, 1.0), (other, 2.0)):
        assert which(np.array([value]))[0] == value
        assert ByteBoundedLru._held_bytes == 8000 * len(ByteBoundedLru._shelf) <= 3 * 8000
    # The fourth value replaced the second, the least recently used.
    assert asked == [1.0, 2.0, 3.0, 4.0, 2.0]
    # A value larger than the limit is cached alone.
    large = ByteBoundedLru(lambda array: np.empty(9000))
    assert large(np.array([1.0])) is large(np.array([1.0]))
    assert len(ByteBoundedLru._shelf) == 1


def test_cached_values_are_released_with_their_body(monkeypatch: pytest.MonkeyPatch) -> None:
    """A cached value may refer to its body's data, as a plate under forces refers to its modes."""
    monkeypatch.setattr(ByteBoundedLru, "_shelf", OrderedDict())
    monkeypatch.setattr(ByteBoundedLru, "_held_bytes", 0)
    body = ModalBody(Plate(0.6, 0.4, 0.01, OAK), 500.0, 0.01)
    body.receptance(np.array([[0.1, 0.2]]), np.array([[0.3, 0.2]]), np.array([100.0]))
    modes = weakref.ref(body.terms)
    assert len(ByteBoundedLru._shelf) == 2
    with no_garbage_collection():
        del body
        assert modes() is None
    other = ByteBoundedLru(lambda array: 2 * array)
    other(np.array([1.0]))
    assert len(ByteBoundedLru._shelf) == 1
    assert ByteBoundedLru._held_bytes == 8


def test_bodies_are_shared_by_sources_of_nearly_the_same_frequency() -> None:
    network = ContactNetwork({"plate": Plate(1.2, 0.7, 0.025, OAK)}, [Contact("fan", "plate", (0.3, 0.2, 0.0))])
    bodies = [
        ModalPlate().prepare(network, [Excitation("fan", f, f, 0.2)], Bands.dominant()).reach["plate"].body
        for f in (101.0, 105.0, 112.0, 113.0)
    ]
    assert bodies[0] is bodies[1] is bodies[2]
    assert bodies[3] is not bodies[2]


@pytest.mark.parametrize("model", [ModalPlate, InfinitePlate])
@pytest.mark.parametrize(
    "settings",
    [{"contact": {"preload_n": 0.0}}, {"contact": {"weight": 1}}, {"contact": 7}, {"outside_domain": "perhaps"}],
)
def test_settings_out_of_bounds(model: type, settings: dict) -> None:
    with pytest.raises(ConfigError, match=r"preload_n|contact is|outside_domain is"):
        model(**settings)
    assert model(contact={"preload_n": 2.0}).contact == ContactLaw(preload_n=2.0)


def test_a_rigid_body_needs_a_mass_and_a_size() -> None:
    with pytest.raises(ModelDomainError, match="mass_kg is 0"):
        RigidBody(0.0)
    with pytest.raises(ModelDomainError, match=r"size_m\[1\] is 0"):
        RigidBody(1.0, (0.1, 0.0, 0.1))


def test_scene_without_sources_or_contacts_is_accepted() -> None:
    network = ContactNetwork({"t": Plate(1.0, 0.5, 0.02, OAK)}, [Contact("t", "u", (0, 0, 0))])
    for bands in (Bands.dominant(), Bands.third_octaves()):
        assert ModalPlate().prepare(network, [], bands).attenuation("t", [[0, 0, 0]]).shape == (1, 0, bands.n_bands)
        alone = ModalPlate().prepare(network, [Excitation("s", 99.0, 99.0)], bands)
        assert not alone.attenuation("t", [[0, 0, 0]]).any()
        assert (alone.attenuation("s", [[0, 0, 0]]) == 1).all()
