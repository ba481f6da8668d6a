"""AutoFidelity: its tolerance against `ModalPlate`, and its choices of model and their reasons."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from scene2hap import Bands, Contact, ContactNetwork, Excitation, ModalPlate, Plate, Pose, materials
from scene2hap.errors import ConfigError, ModelDomainError
from scene2hap.propagation import MODELS
from scene2hap.propagation.auto import AutoFidelity, load_kg
from scene2hap.propagation.auto_level import peak_level_db
from scene2hap.propagation.auto_rungs import FINENESS, FLOOR_DB, PlateCase
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.coupled.coupling import Joint
from scene2hap.propagation.coupled.substructuring import assemble
from scene2hap.propagation.mass_spring_damper import MassSpringDamper
from scene2hap.propagation.modal import estimates, modes

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

import auto_fidelity as campaign

OAK, CONCRETE, STEEL = (materials.lookup(name) for name in ("oak", "concrete", "steel"))
MODEL = AutoFidelity(outside_domain="ignore")
FIRST_SEED = 300_000


def furniture(count: int) -> list[campaign.Draw]:
    """Random scenes whose modal model is quick; the campaign takes all scenes."""
    drawn = (campaign.draw(seed) for seed in range(FIRST_SEED, FIRST_SEED + 400))
    quick = [one for one in drawn if modes.largest_block(one.plate, 1.5 * one.bands.edges_hz[-1]) < 110]
    return quick[:count]


def phone_on(plate: Plate, mass_kg: float = 0.2) -> tuple[ContactNetwork, list[Excitation]]:
    feet = [Contact("phone", "top", (0.1 + x, 0.1 + y, 0.0)) for x in (0.0, 0.1) for y in (0.0, 0.05)]
    return ContactNetwork({"top": plate}, feet), [Excitation("phone", 175.0, 175.0, mass_kg)]


def test_auto_fidelity_keeps_its_tolerance_on_furniture() -> None:
    errors, rungs = [], set()
    for one in furniture(60):
        field = MODEL.prepare(one.network, one.excitations, one.bands)
        truth = campaign.asked(one, campaign.by_rung(one, "modal"))
        errors.append(campaign.wrong_by(campaign.asked(one, field), truth))
        rungs.add(field.choices["plate"].rung)
    assert np.mean(np.array(errors) <= 1.0) >= 0.95  # 0.99 of 2,000 in the campaign
    assert np.median(errors) < 0.3
    assert len(rungs) >= 3


def test_a_foil_above_its_first_resonance_has_a_level_without_overflow() -> None:
    """A clamped foil of nanograms: formulas for below its first resonance must not be evaluated above it."""
    foil = Plate(0.034, 0.0048, 2.5e-6, replace(OAK, density_kg_m3=120.0), "CCFF")
    bands = Bands.dominant()
    with np.errstate(all="raise", under="ignore"):
        for f in (10.0, 400.0, 900.0):
            scene = assemble(*phone_on(foil), bands, ContactLaw(), "ignore")
            joints = [joint for _, several in scene.groups for joint in several]
            level = peak_level_db(foil, 0.05, [(0.2, joints)], [(0.01, 0.0002)], bands, [f])
            assert np.isfinite(level)


def test_no_gain_exceeds_the_level_that_is_promised() -> None:
    for one in furniture(30):
        scene = assemble(one.network, one.excitations, one.bands, ContactLaw(), "ignore")
        if "plate" not in scene.plates:
            continue
        joints = [joint for _, several in scene.groups for joint in several]
        eta = max(one.plate.material.loss_factor, 0.01)
        places = [joint.point_a_m if joint.a == "plate" else joint.point_b_m for joint in joints]
        promised = peak_level_db(one.plate, eta, [(one.excitations[0].mass_kg, joints)], places, one.bands, [])
        field = campaign.by_rung(one, "modal")
        size = [one.plate.length_m, one.plate.width_m, 0.0]
        parts = np.random.default_rng(1).uniform(0.02, 0.98, (20, 3))
        parts[:8] = parts[:8].round()  # corners
        parts[8:14, 0] = parts[8:14, 0].round()  # edges
        loudest = 20 * np.log10(field.attenuation("plate", parts * size).max())
        assert loudest <= promised


@pytest.mark.parametrize("edges", ["CCCC", "SSSS", "CCFF", "CFCF", "CSSF"])
@pytest.mark.parametrize("width_m", [0.4, 0.08])
def test_the_level_promised_below_the_first_resonance_of_a_held_plate(edges: str, width_m: float) -> None:
    """A soft contact to a heavy source pushes with the force of its spring; a hand is where the plate moves most."""
    plate = Plate(0.5, width_m, 0.004, OAK, edges)
    places = [(x, y) for x in (0.0, 0.25, 0.5) for y in (0.0, width_m / 2, width_m)]
    for share in (0.1, 0.9, 0.97):
        f = share * estimates.first_bending_hz(plate)
        each = [np.abs(ModalPlate().plate_receptance(plate, at, at, f)[0, 0]) for at in places]
        joint = Joint("phone", "top", (0.0, 0.0), places[int(np.argmax(each))], stiffness_n_m=1.0)
        promised = peak_level_db(plate, 0.01, [(1e9, [joint])], [joint.point_b_m], Bands.dominant(), [f])
        assert 0 <= promised - 20 * np.log10(max(each)) < (1 if share == 0.1 else 15)


@pytest.mark.parametrize(
    ("plate", "bands", "rung"),
    [
        (Plate(0.15, 0.15, 0.15, OAK), Bands.third_octaves(), "rigid"),  # compact
        (Plate(0.45, 0.35, 0.03, OAK), Bands((10.0, 20.0)), "rigid"),  # its first mode lies above 500 Hz
        (Plate(5.0, 4.0, 0.2, CONCRETE, "clamped"), Bands((50.0, 80.0)), "infinite"),
        (Plate(2.4, 1.2, 0.03, OAK, "SSSS"), Bands((40.0, 63.0, 100.0)), "coarse"),
        (Plate(1.2, 0.7, 0.025, OAK), Bands.third_octaves(), "medium"),
        (Plate(0.5, 0.4, 0.002, STEEL, "clamped"), Bands.third_octaves(), "modal"),
    ],
)
def test_plate_and_bands_decide_the_rung(plate: Plate, bands: Bands, rung: str) -> None:
    field = MODEL.prepare(*phone_on(plate), bands)
    choice = field.choices["top"]
    assert choice.rung == rung
    assert 0 <= choice.bound_db <= 1.0
    assert "top: " + rung in field.explain()
    assert field.choices["phone"].rung == "rigid"


def test_a_tighter_tolerance_never_chooses_a_cheaper_rung() -> None:
    for plate in (Plate(1.2, 0.7, 0.025, OAK), Plate(0.5, 0.4, 0.002, STEEL, "CFFS"), Plate(0.3, 0.2, 0.02, OAK)):
        for top_hz in (30.0, 200.0, 1000.0):
            case = PlateCase(plate, 0.01, top_hz)
            chosen = [case.choose("x", tolerance) for tolerance in (6.0, 3.0, 1.0, 0.5, 0.1)]
            places = [("rigid", "infinite", "lattice", *FINENESS).index(choice.rung) for choice in chosen]
            assert places == sorted(places)
            assert chosen[-1].bound_db <= 0.1


def test_tightest_tolerance_gives_the_modal_plate() -> None:
    one = furniture(1)[0]
    field = AutoFidelity(0.1, outside_domain="ignore").prepare(one.network, one.excitations, one.bands)
    truth = ModalPlate(outside_domain="ignore").prepare(one.network, one.excitations, one.bands)
    assert field.choices["plate"].rung == "modal"
    assert campaign.wrong_by(campaign.asked(one, field), campaign.asked(one, truth)) <= 0.1


def test_a_chain_of_objects_keeps_the_tolerance() -> None:
    """A radio on a shelf on a table: two plates on the path, each with a reduced basis."""
    shelf, table = Plate(0.6, 0.25, 0.018, OAK), Plate(1.4, 0.8, 0.03, OAK)
    contacts = [Contact("radio", "shelf", (0.3 + x, 0.1, 0.0)) for x in (0.0, 0.1)]
    contacts += [Contact("shelf", "table", (x, y, 0.0)) for x in (0.1, 0.55) for y in (0.05, 0.2)]
    network = ContactNetwork({"shelf": shelf, "table": table}, contacts)
    excitations, bands = [Excitation("radio", 150.0, 150.0, 1.0)], Bands.third_octaves()
    field = AutoFidelity(1.0).prepare(network, excitations, bands)
    assert {field.choices[key].rung for key in ("shelf", "table")} == {"medium"}
    modal = ModalPlate().prepare(network, excitations, bands)
    places = {"shelf": [(0.1, 0.2), (0.0, 0.0), (0.6, 0.1)], "table": [(1.2, 0.3), (1.4, 0.8), (0.7, 0.0)]}
    for object_id, several in places.items():
        points = [(x, y, 0.0) for x, y in several]
        gains = [np.maximum(one.attenuation(object_id, points)[:, 0], 0.01) for one in (field, modal)]
        assert np.abs(20 * np.log10(gains[0] / gains[1])).max() < 1.0


def test_one_plate_by_itself() -> None:
    plate, f = Plate(1.2, 0.7, 0.025, replace(OAK, loss_factor=0.02)), np.array([0.0, 40.0, 200.0, 700.0])
    points = [[0.2, 0.1], [0.7, 0.5]]
    found = MODEL.plate_transfer(plate, [0.2, 0.1], points, f)
    np.testing.assert_allclose(found[0], 1.0, rtol=1e-9)
    expected = ModalPlate().plate_transfer(plate, [0.2, 0.1], points, f)
    np.testing.assert_allclose(np.abs(found), np.abs(expected), rtol=0.1)
    np.testing.assert_allclose(
        np.abs(MODEL.plate_receptance(plate, [0.2, 0.1], points, f[1:])),
        np.abs(ModalPlate().plate_receptance(plate, [0.2, 0.1], points, f[1:])),
        rtol=0.1,
    )
    assert MODEL.choose(plate, 700.0).rung == "medium"
    with pytest.raises(ModelDomainError, match="does not move"):
        MODEL.plate_transfer(replace(plate, boundary="CFFF"), [0.0, 0.2], points, [50.0])


@pytest.mark.parametrize("beside_hz", [0.0, 1.0, 200.0])
def test_a_stiff_plate_that_is_held_answers_at_0_hz(beside_hz: float) -> None:
    plate = Plate(0.1, 0.1, 0.01, OAK, "CCCC")
    models = AutoFidelity(outside_domain="ignore"), ModalPlate(outside_domain="ignore")
    found, exact = (model.plate_transfer(plate, [0.05, 0.05], [0.03, 0.04], [0.0, beside_hz])[0] for model in models)
    np.testing.assert_allclose(found, exact, rtol=0.01)
    with pytest.raises(ModelDomainError, match="does not move"):
        models[0].plate_transfer(plate, [0.0, 0.05], [0.03, 0.04], [0.0])


@pytest.mark.parametrize("model", [AutoFidelity(), ModalPlate(), MassSpringDamper()])
def test_high_frequencies_leave_a_slow_force_alone(model: AutoFidelity | ModalPlate | MassSpringDamper) -> None:
    """A slow force moves a free plate as a mass, whatever the other frequencies of the request."""
    plate = Plate(0.5, 0.3, 0.01, OAK)
    centre = np.array([0.25, 0.15])
    slow = model.plate_receptance(plate, centre, centre, [1e-9, 100.0])[0, 0]
    assert slow * (2e-9 * np.pi) ** 2 * plate.moving_mass_kg == pytest.approx(-1.0, rel=1e-6)


def test_settings() -> None:
    assert MODELS.build({"kind": "auto", "tolerance_db": 2.0}) == AutoFidelity(2.0)
    for settings in ({"tolerance_db": 0.01}, {"tolerance_db": 9.0}, {"loss_floor": -1.0}, {"outside_domain": "no"}):
        with pytest.raises(ConfigError, match="tolerance_db|loss_floor|outside_domain"):
            AutoFidelity(**settings)
    bare = replace(STEEL, loss_factor=0.0)
    with pytest.raises(ModelDomainError, match="loss factor of 0"):
        AutoFidelity(loss_floor=0.0).prepare(*phone_on(Plate(0.5, 0.4, 0.002, bare)), Bands((10.0, 20.0)))


def test_poses_and_dominant_bands() -> None:
    """The gains do not depend on the body's pose, also with one frequency per source as band."""
    network, excitations = phone_on(Plate(1.2, 0.7, 0.025, OAK))
    here = MODEL.prepare(network, excitations, Bands.dominant()).attenuation("top", [(0.9, 0.4, 0.0)])
    away = Pose((3.0, -1.0, 0.7))
    moved = [replace(one, point_m=tuple(np.add(one.point_m, away.position_m))) for one in network.contacts]
    there = MODEL.prepare(ContactNetwork(network.bodies, moved, {"top": away}), excitations, Bands.dominant())
    np.testing.assert_allclose(there.attenuation("top", [(3.9, -0.6, 0.7)]), here, rtol=1e-9)
    assert 20 * np.log10(here[0, 0, 0]) > FLOOR_DB


def test_forces_along_the_plane_of_a_board_do_not_make_it_bend_at_lower_frequencies() -> None:
    """A board, and one upright that is flush with it, are joined along both of their normals."""
    board, upright = Plate(0.3, 0.2, 0.02, OAK), Plate(0.2, 1.0, 0.02, OAK)
    poses = {"board": Pose((0.0, 0.0, 0.0)), "upright": Pose.from_euler((0.3, 0.0, 0.0), (0.0, -np.pi / 2, 0.0))}
    joined = [Contact("board", "upright", (0.3, y, 0.0)) for y in (0.02, 0.18)]
    standing = Contact("phone", "upright", (0.3, 0.1, 0.9), normal=(1.0, 0.0, 0.0))
    network = ContactNetwork({"board": board, "upright": upright}, [*joined, standing], poses)
    scene = assemble(network, [Excitation("phone", 100.0, 100.0, 0.2)], Bands((10.0, 20.0)), ContactLaw(), "ignore")
    joints = scene.beside["board"]["upright"]
    assert len(joints) == 4
    along = sum(one.stiffness_n_m for one in joints) / 2  # each contact has one spring for each normal
    assert load_kg(scene, "board") == pytest.approx(along / (2 * np.pi * 20.0) ** 2, rel=1e-9)
