"""Bodies driven along their plane, against rigid-body mechanics, published frequencies and finite elements."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

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
from scene2hap.propagation.bands.band_shapes import CLOSE, band_gains
from scene2hap.propagation.bands.sampling import Sampling
from scene2hap.propagation.bodies.inclined_body import InclinedShapes, inclined, inclined_box
from scene2hap.propagation.bodies.rigid import RigidMotion
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.coupled.coupling import inclined_in
from scene2hap.propagation.coupled.joints import joints_of
from scene2hap.propagation.elastic_body import contracted
from scene2hap.propagation.modal.in_plane import InPlaneModes

OAK, STEEL = materials.lookup("oak"), materials.lookup("steel")
UPRIGHT = (0.5**0.5, 0.0, 0.0, 0.5**0.5)
UP = (0.0, 0.0, 1.0)
F_HZ = np.array([45.0, 130.0, 390.0])


def ports(*rows: tuple[float, ...]) -> np.ndarray:
    return np.array(rows)


def test_in_plane_frequencies_equal_the_published_ones() -> None:
    """Frequencies of a free square, omega a sqrt(rho (1 - nu^2) / E), nu = 0.3.

    Source: Bardell, Langley, Dunsdon, J. Sound Vib. 191 (1996) 459, table of the completely free plate.
    """
    plate = Plate(0.5, 0.5, 0.01, Material("any", 2700.0, 7e10, 0.3, 0.01))
    modes = InPlaneModes(plate, plate.mass_kg)
    scale = 0.5 * math.sqrt(2700.0 * (1 - 0.3**2) / 7e10)
    assert np.sqrt(modes.squares[:3]) == pytest.approx(0.0)
    assert np.sqrt(modes.squares[3:9]) * scale == pytest.approx([2.321, 2.472, 2.472, 2.628, 2.987, 3.452], abs=2e-3)


def test_board_moves_rigidly_far_below_its_first_mode() -> None:
    """Two vertical forces at the lower edge of an upright board: heave, and roll about the middle."""
    board = Plate(0.6, 0.4, 0.02, OAK)
    body = inclined(board, ModalPlate().elastic_body(board, 1000.0))
    m, f = board.mass_kg, np.array([5.0])
    at = ports((0.1, 0.0, 0.0, 0.0, 1.0, 0.0), (0.5, 0.0, 0.0, 0.0, 1.0, 0.0))
    found = body.receptance(at, at, f)[0]
    roll = m / 12 * (0.6**2 + 0.4**2)
    expected = -np.array([[1 / m + 0.2**2 / roll, 1 / m - 0.2**2 / roll]] * 2) / (2 * np.pi * 5.0) ** 2
    expected[1] = expected[1][::-1]
    np.testing.assert_allclose(found, expected, rtol=2e-3)


def test_box_on_front_and_rear_feet_pitches() -> None:
    """A refrigerator as a rigid box: heave and pitch by forces at its feet, in closed form."""
    box = Plate(0.6, 0.5, 0.55, STEEL, object_mass_kg=75.0)
    body = inclined_box(RigidMotion.of(box, 75.0, rocks=True))
    at = ports((0.3, 0.0, 0.2, 0.0, 1.0, 0.0), (0.3, 0.0, -0.2, 0.0, 1.0, 0.0))
    pitch = 75.0 / 12 * (0.5**2 + 0.55**2)
    for k, f in enumerate(F_HZ):
        own, across = 1 / 75.0 + 0.2**2 / pitch, 1 / 75.0 - 0.2**2 / pitch
        expected = -np.array([[own, across], [across, own]]) / (2 * np.pi * f) ** 2
        np.testing.assert_allclose(body.receptance(at, at, F_HZ)[k], expected, rtol=1e-12)
    thin = Plate(0.6, 1.7, 0.009, STEEL, object_mass_kg=75.0)
    sheet = inclined(thin, ModalPlate().elastic_body(thin, 1000.0))
    found = sheet.receptance(at, at, np.array([3.0]))[0]
    pitch = 75.0 / 12 * (1.7**2 + 0.009**2)
    assert (found[0, 0] - found[0, 1]).real == pytest.approx(-2 * 0.2**2 / pitch / (2 * np.pi * 3.0) ** 2, rel=1e-9)


@settings(max_examples=60)
@given(
    length=st.floats(0.02, 3.0),
    width=st.floats(0.02, 3.0),
    thickness=st.floats(5e-4, 0.1),
    is_compact=st.booleans(),
    seed=st.integers(0, 1000),
    f=st.floats(5.0, 1000.0),
)
def test_inclined_body_is_passive(
    length: float, width: float, thickness: float, is_compact: bool, seed: int, f: float
) -> None:
    plate = Plate(length, width, thickness, OAK)
    if is_compact:
        body = inclined_box(RigidMotion.of(plate, plate.mass_kg, rocks=True))
    else:
        body = inclined(plate, InfinitePlate().elastic_body(plate, 1000.0))
    rng = np.random.default_rng(seed)
    directions = rng.normal(size=(5, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    at = np.column_stack([rng.uniform(0, 1, (5, 2)) * (length, width), rng.uniform(-0.2, 0.2, 5), directions])
    found = body.receptance(at, at, np.array([f]))[0]
    size = np.abs(found).max()
    np.testing.assert_allclose(found, found.T, atol=1e-9 * size)
    assert np.linalg.eigvalsh(found.imag).max() <= 1e-9 * size


def test_precomputed_sums_equal_the_direct_sum() -> None:
    board = Plate(0.9, 0.6, 0.004, STEEL)
    body = inclined(board, ModalPlate().elastic_body(board, 1000.0))
    assert isinstance(body, InclinedShapes)
    rng = np.random.default_rng(2)
    s = 0.5**0.5
    at = ports((0.1, 0.0, 0.1, 0.0, 1.0, 0.0), (0.8, 0.0, -0.1, 0.0, s, s), (0.4, 0.3, 0.0, 0.0, 0.0, 1.0))
    places = rng.uniform(0, 0.6, (7, 2))
    felt = body.felt(places)
    forces = rng.normal(size=(3, 4)) + 1j * rng.normal(size=(3, 4))
    f = rng.uniform(20, 900, 4)
    expected = np.einsum("fpc,cf->pf", body.receptance(felt, at, f), forces)
    found = contracted(body, at, f, forces)(felt).view(np.complex128)
    np.testing.assert_allclose(found, expected, atol=1e-10 * np.abs(expected).max())

    sampling = Sampling.of(Bands.third_octaves(), (), 0.02)
    n_f = len(sampling.frequencies_hz)
    pushes = np.einsum("f,cs->fcs", np.ones(n_f), rng.normal(size=(3, 2)) + 0j)
    moved = np.einsum("fpc,fcs->fps", body.receptance(felt, at, sampling.frequencies_hz), pushes)
    exact = np.array([np.sqrt(np.einsum("f,fps->ps", w, np.abs(moved[one]) ** 2)) for one, w in sampling.bands])
    quick = band_gains(body.response_basis(at), pushes, sampling, np.arange(2))(felt).transpose(2, 0, 1)
    assert (np.abs(quick - exact) <= 3 * CLOSE * exact.max(axis=1, keepdims=True)).all()


def on_a_table(normal: tuple[float, float, float] | None, pose: Pose) -> ContactNetwork:
    table, board = Plate(1.2, 0.7, 0.02, OAK), Plate(0.6, 0.4, 0.004, STEEL)
    points = [(0.3, 0.3, 0.0), (0.6, 0.3, 0.0), (0.9, 0.3, 0.0)]
    contacts = [Contact("table", "board", at, normal=normal) for at in points]
    contacts.append(Contact("table", "phone", (0.6, 0.6, 0.0), normal=normal))
    return ContactNetwork({"table": table, "board": board}, contacts, {"table": Pose(), "board": pose})


def test_only_bodies_pushed_in_their_plane_are_inclined() -> None:
    phone = Excitation("phone", 150.0, 150.0, 0.2)
    level, upright = Pose((0.3, 0.2, 0.0)), Pose((0.3, 0.3, 0.0), UPRIGHT)
    for pose, normal, expected in ((level, UP, set()), (upright, None, {"table", "board"}), (upright, UP, {"board"})):
        network = on_a_table(normal, pose)
        assert inclined_in(joints_of(network, {"table", "board", "phone"}, ContactLaw(), {})) == expected
    at = [[0.9, 0.5, 0.0]]
    with_normals, without = (
        ModalPlate().prepare(on_a_table(normal, level), [phone], Bands.third_octaves()).attenuation("table", at)
        for normal in (UP, None)
    )
    np.testing.assert_array_equal(with_normals, without)


def test_an_upright_board_does_not_bend() -> None:
    """With equal forces on both halves of its edge, the board moves up and down as one rigid piece, equally at all
    heights. The same board, driven aslant, bends, and varies more over its height."""
    phone, at = Excitation("phone", 60.0, 60.0, 0.2), [[0.6, 0.3, height] for height in (0.02, 0.15, 0.3, 0.38)]
    inclined_field, bending_field = (
        ModalPlate().prepare(on_a_table(normal, Pose((0.3, 0.3, 0.0), UPRIGHT)), [phone], Bands.third_octaves(20, 400))
        for normal in (UP, (0.0, -(0.5**0.5), 0.5**0.5))
    )
    stiff, bent = (20 * np.log10(one.attenuation("board", at)[:, 0]) for one in (inclined_field, bending_field))
    assert np.ptp(stiff, axis=0).max() < 2.0 < np.ptp(bent, axis=0).max()
    carriers = inclined_field.carriers("board", "phone", 5)
    assert {one.by for one in carriers} == {"table"}
    assert sum(one.share for one in carriers) == pytest.approx(1.0)


@pytest.mark.parametrize("felt_on", ["lower", "board"])
def test_upright_board_agrees_with_finite_elements(monkeypatch: pytest.MonkeyPatch, felt_on: str) -> None:
    """The reference is one system of bending and plane stress; `benchmarks/coupled.py` has more cases."""
    pytest.importorskip("skfem", reason="scikit-fem is not installed; run: pip install scikit-fem")
    monkeypatch.syspath_prepend(str(Path(__file__).parents[2] / "benchmarks"))
    import coupled

    monkeypatch.setattr(coupled, "GRID_M", 0.1)
    monkeypatch.setattr(coupled, "FREQUENCIES_HZ", np.array([45.0, 110.0, 190.0, 330.0, 520.0]))
    case = replace(coupled.cases()["oak board upright on its edge"], felt_on=felt_on)
    points = coupled.points_on(case)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        errors = np.abs(20 * np.log10(coupled.found_by(ModalPlate(), case, points) / coupled.truth(case, points)))
    assert np.median(errors) < 0.15
    assert np.percentile(errors, 95) < 0.6


def cupboard_at_a_wall(turned_rad: float) -> ContactNetwork:
    """A vibrating cupboard on a floor and against a wall, with a board that leans on wall and floor; z is up."""
    turn = Pose.from_yaw((0.0, 0.0, 0.0), turned_rad, up_axis="z")
    bodies = {
        "floor": Plate(4.0, 3.0, 0.15, materials.lookup("concrete")),
        "wall": Plate(4.0, 2.5, 0.1, materials.lookup("plasterboard")),
        "cupboard": Plate(0.8, 1.6, 0.4, OAK, object_mass_kg=40.0),
        "board": Plate(0.5, 1.2, 0.02, OAK),
    }
    lean = math.radians(10.0)
    poses = {
        "floor": Pose((0.0, 0.0, 0.0)),
        "wall": Pose((0.0, 2.8, 0.0), UPRIGHT),
        "cupboard": Pose((0.5, 2.55, 0.0), UPRIGHT),
        "board": Pose((2.0, 2.5, 0.0), (math.sin(math.pi / 4 - lean / 2), 0.0, 0.0, math.cos(math.pi / 4 - lean / 2))),
    }
    back, leaning = (0.0, 1.0, 0.0), (0.0, math.cos(lean), math.sin(lean))
    contacts = [Contact("cupboard", "floor", (x, y, 0.0), (0.0, 0.0, -1.0)) for x in (0.55, 1.25) for y in (2.4, 2.7)]
    contacts += [Contact("cupboard", "wall", (x, 2.75, 1.5), back) for x in (0.6, 1.2)]
    contacts += [Contact("board", "floor", (x, 2.5, 0.0), (0.0, 0.0, -1.0)) for x in (2.05, 2.4)]
    contacts += [Contact("board", "wall", (x, 2.75, 1.15), leaning) for x in (2.05, 2.4)]
    moved = [
        replace(one, point_m=tuple(turn.to_world([one.point_m])[0]), normal=tuple(turn.to_world([one.normal])[0]))
        for one in contacts
    ]
    return ContactNetwork(bodies, moved, {name: turn.compose(pose) for name, pose in poses.items()})


@pytest.mark.parametrize("model", [ModalPlate(), InfinitePlate()])
@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")
def test_gains_do_not_depend_on_the_compass_direction_of_a_room(model: ModalPlate | InfinitePlate) -> None:
    """The phase between the forces on floor and wall followed the axes of the world: 5 dB, at 45 degrees by chance."""
    places = {"wall": (1.5, 2.75, 1.0), "floor": (2.0, 1.0, 0.0), "board": (2.2, 2.6, 0.6)}

    def gains(turned_rad: float) -> list[float]:
        network = cupboard_at_a_wall(turned_rad)
        field = model.prepare(network, [Excitation("cupboard", 100.0, 100.0, 40.0)], Bands((40.0, 80.0, 160.0, 320.0)))
        turn = Pose.from_yaw((0.0, 0.0, 0.0), turned_rad, up_axis="z")
        return [x for name, at in places.items() for x in field.attenuation(name, turn.to_world([at]))[0, 0]]

    expected = gains(0.0)
    for degrees in (45, 90, 135, 180, 225, 270, 315, 17):
        assert gains(math.radians(degrees)) == pytest.approx(expected, rel=1e-6), degrees


def leaning(degrees: float, board: Plate) -> ContactNetwork:
    """A board that lies on a table with two places of its edge, and is tilted about it."""
    half = math.radians(degrees) / 2
    pose = Pose((0.2, 0.3, 0.0), (math.sin(half), 0.0, 0.0, math.cos(half)))
    contacts = [Contact("table", "phone", (x, y, 0.0), UP) for x in (0.4, 0.46) for y in (0.5, 0.6)]
    touching = pose.to_world([(part * board.length_m, 0.0, 0.0) for part in (0.1, 0.9)]).tolist()
    contacts += [Contact("table", "board", at, UP) for at in touching]
    table = Plate(1.2, 0.7, 0.03, OAK)
    poses = {"table": Pose((0.0, 0.0, -0.015)), "board": pose, "phone": Pose((0.4, 0.5, 0.005))}
    return ContactNetwork({"table": table, "board": board, "phone": RigidBody(0.2, (0.06, 0.1, 0.01))}, contacts, poses)


@pytest.mark.parametrize("degrees", [1.0, 3.0, math.degrees(math.acos(0.9))])
def test_gains_do_not_step_while_a_board_is_tilted(degrees: float) -> None:
    """No angle divides a board that bends alone from one that also moves along its plane."""
    steps = []
    for f, board in (
        (60.0, Plate(0.5, 0.3, 0.012, STEEL)),
        (150.0, Plate(0.4, 0.25, 0.006, OAK)),
        (240.0, Plate(0.6, 0.2, 0.018, OAK)),
        (380.0, Plate(0.3, 0.35, 0.004, STEEL)),
    ):
        levels = []
        for angle in (degrees - 0.01, degrees + 0.01):
            network = leaning(angle, board)
            at = network.poses["board"].to_world([(x, y, 0.0) for x in (0.05, 0.2) for y in (0.05, 0.15)])
            field = ModalPlate().prepare(network, [Excitation("phone", f, f, 0.2)], Bands.dominant(0.5))
            levels.append(20 * np.log10(field.attenuation("board", at)[:, 0, 0]))
        steps.append(np.abs(levels[1] - levels[0]).max())
    assert max(steps) < 0.1


TURNED = {False: (0.0, -(0.5**0.5), 0.0, 0.5**0.5), True: (0.5**0.5, 0.0, 0.5**0.5, 0.0)}
"""Rotations of a plate whose length points up, with its normal along -x or along x."""


def board_between_sides(*, is_turned: bool = False) -> ContactNetwork:
    """A shelf board, flush between two sides that stand on a base, with a phone beside its middle.

    Parameters: is_turned : the frame of the left side is turned over.
    """
    board, side, base = Plate(1.0, 0.3, 0.02, OAK), Plate(0.8, 0.3, 0.02, OAK), Plate(1.2, 0.4, 0.03, OAK)
    poses = {"board": Pose((-0.5, -0.15, 0.5)), "base": Pose((-0.6, -0.2, -0.015))}
    contacts = [Contact("phone", "board", (x, y, 0.51), (0, 0, -1)) for x in (-0.03, 0.03) for y in (-0.05, 0.05)]
    for name, sign in (("left", -1), ("right", 1)):
        along = TURNED[is_turned and name == "left"]
        middle = Pose((0.51 * sign, 0.0, 0.4), along)
        poses[name] = middle.compose(Pose((-0.4, -0.15, 0.0)))
        contacts += [Contact("board", name, (0.5 * sign, y, z)) for y in (-0.15, 0.15) for z in (0.49, 0.51)]
        for at in (0.5, 0.52):
            contacts += [Contact(name, "base", (at * sign, y, 0.0), (0, 0, -1)) for y in (-0.15, 0.15)]
    return ContactNetwork({"board": board, "left": side, "right": side, "base": base}, contacts, poses, up_axis="z")


def felt_between_sides(network: ContactNetwork, frequency_hz: float) -> np.ndarray:
    phone = Excitation("phone", frequency_hz, frequency_hz, 0.2)
    field = ModalPlate().prepare(network, [phone], Bands.dominant())
    places = {"board": (0.2, 0.1, 0.5), "left": (-0.51, 0.1, 0.4), "base": (0.1, 0.1, 0.0)}
    return np.array([field.attenuation(name, np.array([place]))[0, 0, 0] for name, place in places.items()])


def test_joined_plates_pass_on_forces_along_each_normal() -> None:
    """Far below all modes, a board and the sides and base that carry it move as one mass: m / (m + M), by momentum."""
    network = board_between_sides()
    mass_kg = sum(body.moving_mass_kg for body in network.bodies.values())
    felt_db = 20 * np.log10(felt_between_sides(network, 1.0))
    assert felt_db == pytest.approx(np.full(3, 20 * math.log10(0.2 / (0.2 + mass_kg))), abs=0.1)


@pytest.mark.parametrize("frequency_hz", [40.0, 160.0, 400.0])
def test_joined_plates_may_be_described_from_either_side(frequency_hz: float) -> None:
    """The normals of perpendicular, joined plates do not decide on a phase."""
    as_it_is, turned = (felt_between_sides(board_between_sides(is_turned=x), frequency_hz) for x in (False, True))
    np.testing.assert_allclose(turned, as_it_is, rtol=1e-3)


def test_a_contact_without_normal_is_a_spring_along_each_of_two_normals() -> None:
    network = board_between_sides()
    ids = {"phone", *network.bodies}
    joined = [one for one in joints_of(network, ids, ContactLaw(), {}) if {one.a, one.b} == {"board", "left"}]
    ways = {(one.point_a_m, one.along_a.height_m, *np.abs(np.round(one.along_a[:3], 9)).tolist()) for one in joined}
    # At each of four places: along the board's own normal, and along the side's normal, which is the board's length.
    assert {way[2:] for way in ways} == {(0.0, 0.0, 1.0), (1.0, 0.0, 0.0)}
    assert len(joined) == len(ways) == 2 * len({way[:2] for way in ways}) == 8
    phone = Excitation("phone", 90.0, 90.0, 0.2)
    carriers = ModalPlate().prepare(network, [phone], Bands.dominant()).carriers("left", "phone", 0)
    assert len({(one.by, one.point_m) for one in carriers}) == len(carriers)


@pytest.mark.parametrize("normal", [(0.0, -1.0, 0.0), None])
def test_what_hangs_beside_a_wall_loads_it_along_the_vertical(normal: tuple[float, float, float] | None) -> None:
    """Far below all modes, a phone on a cabinet, the cabinet and the loose wall that holds it move up as one mass."""
    cabinet, wall = Plate(0.8, 0.6, 0.3, OAK, object_mass_kg=15.0), Plate(3.0, 2.4, 0.15, OAK)
    poses = {"cabinet": Pose((-0.4, 0.15, 0.9), UPRIGHT), "wall": Pose((-1.5, 0.375, 0.0), UPRIGHT)}
    contacts = [Contact("phone", "cabinet", (x, y, 1.5), (0, 0, -1)) for x in (-0.05, 0.05) for y in (0.1, 0.2)]
    contacts += [Contact("wall", "cabinet", (x, 0.3, z), normal) for x in (-0.4, 0.4) for z in (0.9, 1.5)]
    network = ContactNetwork({"cabinet": cabinet, "wall": wall}, contacts, poses, up_axis="z")
    phone = Excitation("phone", 1.0, 1.0, 0.2)
    field = ModalPlate(outside_domain="ignore").prepare(network, [phone], Bands.dominant())
    middle = np.array([[0.0, 0.375, 1.2]])
    mass_kg = 0.2 + cabinet.moving_mass_kg + wall.moving_mass_kg
    # The cabinet's weight is beside the wall's plane, which tilts the wall; its middle only moves up.
    assert field.attenuation("wall", middle)[0, 0, 0] == pytest.approx(0.2 / mass_kg, rel=0.05)


def test_only_what_stands_on_nothing_is_held_by_its_side() -> None:
    """A cabinet on a floor that touches a wall is not held there; the same cabinet without the floor is."""
    upright = Plate(0.8, 0.6, 0.3, OAK, object_mass_kg=15.0)
    bodies = {"cabinet": upright, "wall": Plate(3.0, 2.4, 0.15, OAK), "floor": Plate(3.0, 3.0, 0.1, OAK)}
    poses = {
        "cabinet": Pose((-0.4, 0.15, 0.0), UPRIGHT),
        "wall": Pose((-1.5, 0.375, 0.0), UPRIGHT),
        "floor": Pose((-1.5, -1.5, -0.05)),
    }
    beside = [Contact("wall", "cabinet", (x, 0.3, z), (0, -1, 0)) for x in (-0.4, 0.4) for z in (0.0, 0.6)]
    feet = [Contact("cabinet", "floor", (x, y, 0.0), (0, 0, -1)) for x in (-0.4, 0.4) for y in (0.0, 0.3)]
    for contacts, springs in (([*beside, *feet], 4), (beside, 8)):
        network = ContactNetwork(bodies, contacts, poses, up_axis="z")
        joints = joints_of(network, bodies.keys(), ContactLaw(), {})
        assert sum({one.a, one.b} == {"cabinet", "wall"} for one in joints) == springs
