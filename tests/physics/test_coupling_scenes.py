"""ModalPlate and InfinitePlate on whole scenes, against closed forms and properties that hold for any scene."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray

from scene2hap import (
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    InfinitePlate,
    Material,
    ModalPlate,
    Plate,
    Pose,
    RigidBody,
    materials,
)
from scene2hap.propagation.bodies.rigid import RigidMotion
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.coupled.coupling import couple
from scene2hap.propagation.coupled.joints import joints_of
from scene2hap.propagation.coupled.substructuring import prepare_coupled
from scene2hap.propagation.domain import ThinPlateWarning

OAK, STEEL, GLASS = (materials.lookup(name) for name in ("oak", "steel", "glass"))
TABLE = Plate(1.2, 0.7, 0.025, OAK)
THIRDS = Bands.third_octaves(10, 1000)
MODELS = [ModalPlate(outside_domain="ignore"), InfinitePlate(outside_domain="ignore")]


def phone_on(plate: Plate, at: tuple[float, float] = (0.4, 0.3), **more: float) -> ContactNetwork:
    return ContactNetwork({"table": plate}, [Contact("phone", "table", (*at, 0.0), **more)])


def navier(plate: Plate, drive: NDArray, points: NDArray, f: float, eta: float) -> NDArray[np.complex128]:
    """Receptance of a simply supported plate by Navier's double series, 400 terms in each direction."""
    m, n = np.arange(1, 401)[:, None], np.arange(1, 401)[None, :]
    D, mass = plate.bending_stiffness_nm, plate.material.density_kg_m3 * plate.thickness_m
    omega_mn = math.sqrt(D / mass) * ((m * np.pi / plate.length_m) ** 2 + (n * np.pi / plate.width_m) ** 2)

    def shapes(p: NDArray) -> NDArray:
        return np.sin(m * np.pi * p[0] / plate.length_m) * np.sin(n * np.pi * p[1] / plate.width_m)

    resonance = 4 / (mass * plate.length_m * plate.width_m) / (omega_mn**2 * (1 + 1j * eta) - (2 * np.pi * f) ** 2)
    return np.array([(shapes(drive) * shapes(p) * resonance).sum() for p in points])


@pytest.mark.parametrize("f", [35.0, 120.0, 250.0, 480.0])
def test_one_contact_on_a_supported_plate(f: float) -> None:
    """v = v_f Y_ts / (Y_s + Y_r + Y_c), with the plate's mobilities from Navier's series and Hertz's k."""
    plate = Plate(0.9, 0.6, 0.012, replace(OAK, loss_factor=0.02), "simply-supported")
    drive, points = np.array([0.35, 0.22]), np.array([[0.35, 0.22], [0.6, 0.4], [0.1, 0.5]])
    law = ContactLaw()
    plastic = Material("case", 1050.0, 2.4e9, 0.35, 0.02)
    modulus = 1 / ((1 - 0.35**2) / 2.4e9 + (1 - OAK.poisson_ratio**2) / OAK.youngs_modulus_pa)
    k = (6 * modulus**2 * law.tip_radius_m * 0.2 * 9.80665) ** (1 / 3) * (1 + 0.05j)
    y = navier(plate, drive, points, f, 0.02)
    expected = np.abs(y / (-1 / (0.2 * (2 * np.pi * f) ** 2) + y[0] + 1 / k))
    network = ContactNetwork(
        {"table": plate, "phone": RigidBody(0.2, material=plastic)}, [Contact("phone", "table", (*drive, 0.0))]
    )
    field = ModalPlate().prepare(network, [Excitation("phone", 99.0, f, 0.2)], Bands.dominant())
    found = field.attenuation("table", np.column_stack([points, np.zeros(3)]))[:, 0, 0]
    assert np.abs(20 * np.log10(found / expected)).max() < 0.2
    assert field.attenuation("phone", [[0, 0, 0]])[0, 0, 0] == 1.0


@pytest.mark.parametrize("model", [ModalPlate(), InfinitePlate()])
def test_one_contact_by_the_models_own_receptance(model: ModalPlate | InfinitePlate) -> None:
    at, f, omega = [[0.4, 0.3], [0.7, 0.5]], 180.0, 2 * np.pi * 180.0
    y = model.plate_receptance(TABLE, [0.4, 0.3], at, [f])[:, 0]
    k, eta = model.contact.stiffness(None, OAK)
    expected = np.abs(y / (-1 / (0.2 * omega**2) + y[0] + 1 / (k * (1 + 1j * eta))))
    field = model.prepare(phone_on(TABLE), [Excitation("phone", 99.0, f, 0.2)], Bands.dominant())
    found = field.attenuation("table", [[*p, 0.0] for p in at])[:, 0, 0]
    np.testing.assert_allclose(found, expected, rtol=2e-3)


@pytest.mark.parametrize("plate", [TABLE, Plate(0.5, 0.3, 0.002, STEEL, "CFFS"), Plate(0.9, 0.25, 0.018, OAK, "SSFF")])
def test_a_prepared_plate_answers_as_its_kernel(plate: Plate) -> None:
    f = np.geomspace(12.0, 1000.0, 80)
    points = np.random.default_rng(1).uniform(0.1, 0.9, (6, 2)) * [plate.length_m, plate.width_m]
    body = ModalPlate().elastic_body(plate, 1000.0)
    found = body.receptance(points, points, f)
    expected = np.stack([ModalPlate().plate_receptance(plate, p, points, f).T for p in points], axis=2)
    np.testing.assert_allclose(found, expected, atol=2e-3 * np.abs(expected).max(axis=(1, 2)).min(), rtol=2e-3)
    np.testing.assert_allclose(found, found.transpose(0, 2, 1), rtol=1e-9, atol=1e-18)


def random_scene(seed: int) -> tuple[ContactNetwork, list[Excitation]]:
    """Up to nine objects, thin and thick, soft and hard, fixed and free, with loops and several contacts per pair."""
    rng = np.random.default_rng(seed)
    bodies: dict[str, Plate | RigidBody] = {}
    for i in range(rng.integers(2, 8)):
        material = materials.table()[rng.integers(len(materials.table()))].material
        edges = "".join(rng.choice(list("FFFSC"), 4))
        size = rng.uniform(0.08, 0.6, 2)
        thickness = 10 ** rng.uniform(-2.4, -1.2)
        bodies[f"o{i}"] = (
            Plate(*size, thickness, material, edges) if rng.random() < 0.8 else RigidBody(rng.uniform(0.05, 9))
        )
    names = list(bodies)
    contacts = []
    for _ in range(rng.integers(2, 12)):
        a, b = rng.choice([*names, "s0", "s1"], 2, replace=False)
        contacts.append(Contact(str(a), str(b), (*rng.uniform(0, 0.5, 2), 0.0), weight=rng.uniform(0, 1)))
    contacts += [Contact("s0", names[0], (0.1, 0.1, 0)), Contact("s1", names[-1], (0.05, 0.2, 0))]
    sources = [Excitation(f"s{i}", 99.0, 10 ** rng.uniform(1.2, 2.5), 10 ** rng.uniform(-1.5, 1)) for i in range(2)]
    return ContactNetwork(bodies, contacts), sources


@settings(max_examples=15)
@given(st.integers(0, 10**6), st.sampled_from(MODELS))
def test_transfer_between_sources_is_reciprocal(seed: int, model: ModalPlate | InfinitePlate) -> None:
    """A free deflection of 1 means a force of m omega^2, so by reciprocity the gains are proportional to the masses."""
    network, sources = random_scene(seed)
    band = Bands((80.0, 100.0))
    field = model.prepare(network, sources, band)
    one = field.attenuation("s1", [[0, 0, 0]])[0, 0, 0] / sources[0].mass_kg
    other = field.attenuation("s0", [[0, 0, 0]])[0, 1, 0] / sources[1].mass_kg
    assert one == pytest.approx(other, rel=1e-7, abs=1e-30)


@settings(max_examples=15)
@given(st.integers(0, 10**6), st.sampled_from(MODELS))
def test_coupled_scene_is_passive(seed: int, model: ModalPlate | InfinitePlate) -> None:
    network, _ = random_scene(seed)
    f = np.geomspace(15.0, 400.0, 40)
    bodies = {
        x: model.elastic_body(body, 400.0) if isinstance(body, Plate) else RigidMotion(body.mass_kg)
        for x, body in network.bodies.items()
    } | {x: RigidMotion(0.3) for x in ("s0", "s1")}
    joints = joints_of(network, bodies, model.contact, {})
    solved = couple(bodies, joints, ["s0", "s1"], f)
    moved = np.concatenate([solved.deflection(x, np.zeros((1, 2))) for x in ("s0", "s1")], axis=1)
    y = -moved / (0.3 * (2 * np.pi * f) ** 2)[:, None, None]
    lossy = (y - y.conj().transpose(0, 2, 1)) / 2j
    assert (np.linalg.eigvalsh(lossy).max(axis=1) <= 1e-9 * np.abs(y).max(axis=(1, 2))).all()


@settings(max_examples=15)
@given(
    st.integers(0, 10**6), st.sampled_from(MODELS), st.sampled_from([Bands.dominant(), Bands((10.0, 12.5, 40, 500.0))])
)
def test_gains_are_finite_and_do_not_depend_on_order(
    seed: int, model: ModalPlate | InfinitePlate, bands: Bands
) -> None:
    network, sources = random_scene(seed)
    rng = np.random.default_rng(seed)
    shuffled = ContactNetwork(
        dict(reversed(network.bodies.items())), [network.contacts[i] for i in rng.permutation(len(network.contacts))]
    )
    points = rng.uniform(-0.1, 0.7, (5, 3))
    field, other = model.prepare(network, sources, bands), model.prepare(shuffled, sources[::-1], bands)
    for name in (*network.bodies, "s0", "s1", "nobody"):
        gains = field.attenuation(name, points)
        assert gains.shape == (5, 2, bands.n_bands)
        assert np.isfinite(gains).all()
        assert (gains >= 0).all()
        np.testing.assert_allclose(other.attenuation(name, points)[:, ::-1], gains, rtol=1e-7, atol=1e-12)


@settings(max_examples=10)
@given(*[st.floats(0.2, 5.0)] * 3)
def test_gains_do_not_depend_on_units(kg: float, m: float, s: float) -> None:
    """The gains are equal if every quantity is given in other units of mass, length and time."""

    def steel_shelf(kg: float, m: float, s: float) -> NDArray[np.float64]:
        sheet = Material("steel", 7800 * kg / m**3, 2e11 * kg / m / s**2, 0.3, 0.01)
        wood = Material("wood", 700 * kg / m**3, 1e10 * kg / m / s**2, 0.3, 0.02)
        plastic = Material("case", 1000 * kg / m**3, 2e9 * kg / m / s**2, 0.35, 0.02)
        bodies = {
            "shelf": Plate(0.5 * m, 0.3 * m, 0.003 * m, sheet, "CFFF"),
            "top": Plate(0.8 * m, 0.5 * m, 0.02 * m, wood),
            # Compact, since it is thick. A stated mass would press with its weight, and g is the same in all units.
            "radio": Plate(0.2 * m, 0.1 * m, 0.1 * m, plastic),
        }
        feet = [Contact("radio", "shelf", (x * m, y * m, 0)) for x in (0.1, 0.2) for y in (0.1, 0.15)]
        links = [Contact("shelf", "top", (x * m, 0.25 * m, 0)) for x in (0.4, 0.3)]
        pose = Pose((0.08 * m, 0.07 * m, 0.0))
        law = ContactLaw(0.005 * m, 0.5 * kg * m / s**2)
        # Sampled by hand, since "compact" is a bound in hertz.
        field = ModalPlate(contact=law).prepare(
            ContactNetwork(bodies, [*feet, *links], {"radio": pose}),
            [Excitation("radio", 99 / s, 99 / s, 0.8 * kg)],
            Bands((20 / s, 40 / s, 200 / s, 250 / s)),
        )
        return np.concatenate([field.attenuation(x, [[0.3 * m, 0.2 * m, 0], [0.1 * m, 0, 0]]) for x in bodies])

    np.testing.assert_allclose(steel_shelf(kg, m, s), steel_shelf(1, 1, 1), rtol=1e-6)


def test_contact_weight_scales_the_stiffness() -> None:
    source = [Excitation("phone", 99.0, 240.0, 0.2)]
    model = ModalPlate()

    def gain(network: ContactNetwork) -> float:
        return float(model.prepare(network, source, Bands.dominant()).attenuation("table", [[0.9, 0.5, 0]])[0, 0, 0])

    def stiffness_n_m(network: ContactNetwork) -> float:
        return sum(one.stiffness_n_m for one in joints_of(network, {"table", "phone"}, model.contact, {"phone": 0.2}))

    # Two contacts at one point act in parallel, each as one that fades.
    half = phone_on(TABLE, weight=0.5)
    twice = ContactNetwork(half.bodies, [*half.contacts] * 2)
    assert stiffness_n_m(twice) == pytest.approx(stiffness_n_m(phone_on(TABLE)), rel=1e-9)
    assert gain(half) != pytest.approx(gain(phone_on(TABLE)), rel=1e-3)
    assert gain(phone_on(TABLE, weight=0.0)) == 0.0
    assert gain(ContactNetwork({}, half.contacts)) == 0.0


def test_stiff_and_soft_contacts() -> None:
    source = [Excitation("phone", 99.0, 120.0, 0.2)]
    at = [[0.4, 0.3, 0.0]]

    def at_the_foot(preload_n: float) -> float:
        field = ModalPlate(contact=ContactLaw(preload_n=preload_n)).prepare(phone_on(TABLE), source, Bands.dominant())
        return float(field.attenuation("table", at)[0, 0, 0])

    y = ModalPlate().plate_receptance(TABLE, [0.4, 0.3], [[0.4, 0.3]], [120.0])[0, 0]
    rigid = abs(y / (y - 1 / (0.2 * (2 * np.pi * 120.0) ** 2)))
    assert at_the_foot(1e24) == pytest.approx(rigid, rel=2e-3)
    assert at_the_foot(1e-40) < 1e-9


def test_twice_as_many_frequencies_change_little() -> None:
    """Thin sheets of low loss on stiff contacts change by at most 0.5 dB at any point in any band."""
    bodies = {"sheet": Plate(0.5, 0.35, 0.002, STEEL), "pane": Plate(0.6, 0.4, 0.005, GLASS, "CFFS"), "top": TABLE}
    contacts = [Contact("phone", "sheet", (0.1, 0.1, 0)), Contact("sheet", "pane", (0.3, 0.2, 0))]
    contacts += [Contact("pane", "top", (x, 0.3, 0)) for x in (0.2, 0.5)]
    points = np.column_stack([np.random.default_rng(2).uniform(0, 0.5, (20, 2)), np.zeros(20)])
    args = ModalPlate(), ContactNetwork(bodies, contacts), [Excitation("phone", 99.0, 99.0, 0.2)], THIRDS
    plain, twice = (prepare_coupled(*args, density=density) for density in (1.0, 2.0))
    for name in bodies:
        ratio = twice.attenuation(name, points) / plain.attenuation(name, points)
        assert np.abs(20 * np.log10(ratio)).max() <= 0.5


def test_a_band_is_the_rms_over_its_width() -> None:
    field = ModalPlate().prepare(phone_on(TABLE), [Excitation("phone", 99.0, 99.0, 0.2)], Bands((200.0, 250.0)))
    f = np.linspace(200.0, 250.0, 1001)
    y = ModalPlate().plate_receptance(TABLE, [0.4, 0.3], [[0.4, 0.3], [0.9, 0.6]], f)
    k, eta = ContactLaw().stiffness(None, OAK)
    h = np.abs(y[1] / (y[0] - 1 / (0.2 * (2 * np.pi * f) ** 2) + 1 / (k * (1 + 1j * eta))))
    found = field.attenuation("table", [[0.9, 0.6, 0.0]])[0, 0, 0]
    assert abs(20 * math.log10(found / math.sqrt((h**2).mean()))) < 0.2


def test_moved_plate_keeps_its_plate_coordinates() -> None:
    turn = Pose((3.0, -1.0, 2.0), (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)))
    source = [Excitation("phone", 99.0, 200.0, 0.2)]
    still = ModalPlate().prepare(phone_on(TABLE), source, THIRDS).attenuation("table", [[0.9, 0.6, 0.0]])
    (touch, contact) = turn.to_world([[0.9, 0.6, 0.0], [0.4, 0.3, 0.0]])
    carried = ContactNetwork({"table": TABLE}, [Contact("phone", "table", tuple(contact))], {"table": turn})
    np.testing.assert_allclose(
        ModalPlate().prepare(carried, source, THIRDS).attenuation("table", [touch]), still, rtol=1e-9
    )


def test_foot_outside_the_plate_is_moved_to_its_edge() -> None:
    source = [Excitation("phone", 99.0, 200.0, 0.2)]
    outside, edge = (
        ModalPlate().prepare(phone_on(TABLE, at), source, THIRDS).attenuation("table", [[0.9, 0.6, 0.0]])
        for at in ((0.4, -0.2), (0.4, 0.0))
    )
    np.testing.assert_array_equal(outside, edge)


def test_compact_bodies_move_as_a_whole() -> None:
    mug = Plate(0.09, 0.08, 0.05, materials.lookup("ceramic"))
    network = ContactNetwork(
        {"mug": mug, "table": TABLE}, [Contact("s", "table", (0.3, 0.3, 0)), Contact("mug", "table", (0.05, 0.05, 0))]
    )
    gains = (
        ModalPlate()
        .prepare(network, [Excitation("s", 99.0, 300.0, 0.2)], THIRDS)
        .attenuation("mug", [[0, 0, 0], [0.09, 0.08, 0]])
    )
    np.testing.assert_array_equal(gains[0], gains[1])
    assert (gains > 0).all()


def test_rocking_of_a_body_whose_place_is_known() -> None:
    """A force at a corner of a free box moves that corner by 1/m + x^2/I_y + y^2/I_x, the middle by 1/m."""
    body = RigidMotion(2.0, (0.4, 0.2, 0.1))
    f = np.array([10.0])
    corner, middle, opposite = body.receptance(
        np.array([[0.4, 0.2], [0.2, 0.1], [0.0, 0.0]]), np.array([[0.4, 0.2]]), f
    )[0, :, 0]
    i_y, i_x = 2 / 12 * (0.4**2 + 0.1**2), 2 / 12 * (0.2**2 + 0.1**2)
    omega2 = (20 * np.pi) ** 2
    assert corner == pytest.approx(-(1 / 2 + 0.04 / i_y + 0.01 / i_x) / omega2)
    assert middle == pytest.approx(-1 / 2 / omega2)
    assert opposite == pytest.approx(-(1 / 2 - 0.04 / i_y - 0.01 / i_x) / omega2)


def test_a_slab_thicker_than_theory_warns_once_per_object_or_raises() -> None:
    concrete = Plate(2.0, 1.5, 0.14, Material("concrete", 2300.0, 20e9, 0.2, 0.02))
    network = ContactNetwork({"slab of this test": concrete}, [Contact("s", "slab of this test", (1, 1, 0))])
    source, bands = [Excitation("s", 99.0, 99.0)], Bands((1000.0, 1250.0))
    with pytest.warns(ThinPlateWarning, match="'slab of this test'.*140 mm concrete"):
        InfinitePlate().prepare(network, source, bands)
    InfinitePlate().prepare(network, source, bands)  # a second warning would be an error
    with pytest.raises(Exception, match="'slab of this test'.*140 mm concrete.*RigidBody"):
        ModalPlate(outside_domain="raise").prepare(network, source, bands)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ModalPlate(outside_domain="raise").prepare(network, source, Bands((100.0, 125.0)))


def test_a_phone_on_four_corners_resonates_where_it_should() -> None:
    """0.2 kg on four hard plastic corners of 5 mm on a rigid base resonates between 380 and 500 Hz."""
    k, _ = ContactLaw().stiffness(None, Material("rock", 3000.0, 1e12, 0.2, 0.01))
    assert 380.0 < math.sqrt(4 * k / 0.2) / (2 * math.pi) < 500.0
    radius_m = 1e-6  # of a flat punch, which is as stiff as 2 E* a
    tiny, _ = ContactLaw().stiffness(OAK, OAK, area_m2=math.pi * radius_m**2)
    assert tiny == pytest.approx(OAK.youngs_modulus_pa / (1 - OAK.poisson_ratio**2) * radius_m, rel=1e-3)
    assert ContactLaw().stiffness(None, OAK, area_m2=1.0) == ContactLaw().stiffness(None, OAK)


def test_phone_with_four_feet_on_an_oak_top() -> None:
    phone = Plate(0.15, 0.07, 0.008, GLASS)
    feet = [Contact("phone", "table", (0.4 + x, 0.3 + y, 0)) for x in (0.01, 0.14) for y in (0.01, 0.06)]
    network = ContactNetwork({"table": TABLE, "phone": phone}, feet, {"phone": Pose((0.4, 0.3, 0.0)), "table": Pose()})
    for model in (ModalPlate(), InfinitePlate()):
        field = model.prepare(network, [Excitation("phone", 175.0, 175.0, 0.2)], THIRDS)
        gains_db = 20 * np.log10(field.attenuation("table", [[0.5, 0.35, 0], [0.9, 0.5, 0], [1.15, 0.05, 0]])[:, 0])
        assert np.isfinite(gains_db).all()
        assert (np.abs(gains_db) < 60).all()
        # The phone's mass and the stiffness of its corners resonate with the top, but with a loss.
        assert gains_db.max() < 12
    # Far below the first mode the top is a mass: 0.2 kg against 15.75 kg, which also tilts about its middle.
    gains = ModalPlate().prepare(network, [Excitation("phone", 175.0, 2.0, 0.2)], Bands.dominant())
    center = gains.attenuation("table", [[0.6, 0.35, 0.0]])[0, 0, 0]
    assert center == pytest.approx(0.2 / (0.2 + TABLE.mass_kg), rel=0.02)
