"""Scenes as physics sees them: turned, mirrored, or with a plate's frame upside down, they give the same gains.

Every expectation is a symmetry, or the closed form of a rigid body; none comes from the code tested.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from scene2hap import (
    AutoFidelity,
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    InfinitePlate,
    MassSpringDamper,
    Material,
    ModalPlate,
    Plate,
    Pose,
    RigidBody,
    materials,
)
from scene2hap.propagation.auto_rungs import Choice
from scene2hap.propagation.bodies.inclined_body import inclined
from scene2hap.propagation.coupled.contact_stiffness import STANDARD_GRAVITY_M_S2, ContactLaw
from scene2hap.propagation.coupled.joints import joints_of
from scene2hap.propagation.protocol import Body
from scene2hap.scene.surface.outline import Outline

OAK, STEEL, RUBBER = (materials.lookup(name) for name in ("oak", "steel", "rubber"))
BANDS = Bands((20.0, 40.0, 80.0, 160.0, 315.0))
DOWN = (0.0, 0.0, -1.0)
MODELS = [ModalPlate(outside_domain="ignore"), InfinitePlate(outside_domain="ignore")]
UPRIGHT = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))
"""Width upwards, and the normal towards -y."""

Scene = tuple[dict[str, Body], dict[str, Pose], list[Contact]]


def random_scene(seed: int) -> Scene:
    """Plates in any direction, with loops; some contacts have no normal, and s0 has neither body nor place."""
    rng = np.random.default_rng(seed)
    bodies: dict[str, Body] = {}
    poses, contacts = {}, [Contact("s0", "o0", (0.1, 0.1, 0.0), DOWN)]
    for i in range(rng.integers(3, 6)):
        size = rng.uniform(0.1, 0.6, 2)
        bodies[f"o{i}"] = Plate(*size, 10 ** rng.uniform(-2.3, -1), (OAK, STEEL)[i % 2], object_mass_kg=4.0 * i or None)
        turn = Rotation.random(random_state=seed + i) if rng.random() < 0.6 else Rotation.identity()
        poses[f"o{i}"] = Pose(tuple(rng.uniform(-0.4, 0.4, 3)), tuple(turn.as_quat()))
        for j in range(i):
            normal = rng.normal(size=3) if rng.random() < 0.5 else np.array(DOWN)
            own = tuple(normal / np.linalg.norm(normal)) if rng.random() < 0.7 else None
            contacts.append(Contact(f"o{i}", f"o{j}", tuple(rng.uniform(-0.4, 0.4, 3)), own))
    return bodies, poses, contacts


def gains(model: ModalPlate | InfinitePlate, scene: Scene, at: dict[str, np.ndarray], *sources: str) -> np.ndarray:
    bodies, poses, contacts = scene
    excitations = [Excitation(source, 90.0, 90.0, 0.5) for source in sources or ("s0",)]
    field = model.prepare(ContactNetwork(bodies, contacts, poses), excitations, BANDS)
    return np.array([field.attenuation(name, points) for name, points in at.items()])


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("seed", range(8))
def test_a_turned_scene_has_the_same_gains(model: ModalPlate | InfinitePlate, seed: int) -> None:
    bodies, poses, contacts = random_scene(seed)
    rng = np.random.default_rng(seed)
    at = {name: rng.uniform(-0.4, 0.4, (3, 3)) for name in bodies}
    turn, shift = Rotation.random(random_state=seed + 99), rng.uniform(-3, 3, 3)
    motion = Pose(tuple(shift), tuple(turn.as_quat()))
    turned = [
        replace(
            one, point_m=tuple(motion.to_world([one.point_m])[0]), normal=one.normal and tuple(turn.apply(one.normal))
        )
        for one in contacts
    ]
    after = (bodies, {name: motion.compose(pose) for name, pose in poses.items()}, turned)
    found = gains(model, after, {name: motion.to_world(points) for name, points in at.items()}, "s0", "o0")
    expected = gains(model, (bodies, poses, contacts), at, "s0", "o0")
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("model", MODELS)
def test_a_room_turned_by_quarters_has_the_same_gains(model: ModalPlate | InfinitePlate) -> None:
    """Floor and two walls intersect at right angles, without known normals, and a source stands in their corner."""
    z_up, x_up, y_up = (0, 0, 0, 1), (0, math.sqrt(0.5), 0, math.sqrt(0.5)), (-math.sqrt(0.5), 0, 0, math.sqrt(0.5))
    bodies: dict[str, Body] = dict.fromkeys(("floor", "wall_x", "wall_y"), Plate(1.0, 0.8, 0.01, OAK))
    poses = {name: Pose((0, 0, 0), way) for name, way in zip(bodies, (z_up, x_up, y_up), strict=True)}
    pairs = (("floor", "wall_x", (0, 0.3, 0)), ("floor", "wall_y", (0.4, 0, 0)), ("wall_x", "wall_y", (0, 0, 0.2)))
    contacts = [Contact(*pair) for pair in pairs] + [Contact("s0", "floor", (0.3, 0.2, 0), DOWN)]
    at = {name: np.array([[0.2, 0.1, 0.3]]) for name in bodies}
    expected = gains(model, (bodies, poses, contacts), at)
    for quarters in (1, 2, 3):
        turn = Rotation.from_rotvec([0, 0, quarters * math.pi / 2])
        motion = Pose((1.0, 2.0, 0.0), tuple(turn.as_quat()))
        turned = [replace(one, point_m=tuple(motion.to_world([one.point_m])[0])) for one in contacts]
        after = (bodies, {name: motion.compose(pose) for name, pose in poses.items()}, turned)
        found = gains(model, after, {name: motion.to_world(points) for name, points in at.items()})
        np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("seed", range(8))
def test_a_plate_may_be_described_from_either_side(model: ModalPlate | InfinitePlate, seed: int) -> None:
    """Its frame turned over: the same plate in the same place, with its normal the other way."""
    bodies, poses, contacts = random_scene(seed)
    rng = np.random.default_rng(seed)
    contacts = [replace(one, normal=one.normal or DOWN) for one in contacts]
    at = {name: rng.uniform(-0.4, 0.4, (3, 3)) for name in bodies}
    expected = gains(model, (bodies, poses, contacts), at)
    for name, pose in poses.items():
        body = bodies[name]
        assert isinstance(body, Plate)
        over = poses | {name: pose.compose(Pose((0.0, body.width_m, 0.0), (1.0, 0.0, 0.0, 0.0)))}
        np.testing.assert_allclose(gains(model, (bodies, over, contacts), at), expected, rtol=1e-3, atol=1e-6)


def stack(y_m: float) -> Scene:
    """Two cabinets, one on the other, on four feet each, with a source on top at a distance from their front."""
    cabinet = Plate(0.4, 0.45, 0.3, STEEL, object_mass_kg=20.0)
    bodies: dict[str, Body] = {"low": cabinet, "up": cabinet, "floor": Plate(3, 3, 0.15, materials.lookup("concrete"))}
    poses = {"low": Pose((0, 0.15, 0), UPRIGHT), "up": Pose((0, 0.15, 0.45), UPRIGHT), "floor": Pose((-1.3, -1.35, 0))}
    feet = [(x, y) for x in (0.05, 0.35) for y in (0.02, 0.28)]
    contacts = [
        Contact(a, b, (*foot, z), DOWN) for a, b, z in (("up", "low", 0.45), ("low", "floor", 0)) for foot in feet
    ]
    return bodies, poses, [*contacts, Contact("s0", "up", (0.2, y_m, 0.9), DOWN)]


@pytest.mark.parametrize("model", MODELS)
def test_front_and_rear_feet_of_stacked_cabinets_are_two(model: ModalPlate | InfinitePlate) -> None:
    """The scene and its mirror image have the same gains; the rear feet have the same place in both of the planes."""
    at = {
        "up": np.array([[0.2, 0.15, 0.7]]),
        "low": np.array([[0.1, 0.15, 0.2]]),
        "floor": np.array([[0.2, 0.15, 0.0]]),
    }
    np.testing.assert_allclose(gains(model, stack(0.25), at), gains(model, stack(0.05), at), rtol=1e-3)


@pytest.mark.parametrize("normal", [DOWN, (0.0, -1.0, 0.0), (1.0, 0.0, 0.0)])
def test_a_rigid_body_is_the_compact_plate_of_its_mass_and_size(normal: tuple[float, float, float]) -> None:
    size = (0.12, 0.1, 0.06)
    middle = np.array([0.06, 0.05, 0.0])
    side = middle + np.array(normal) * size / np.array(2.0)
    aside = np.roll(normal, 1)
    feet = [tuple(side + 0.02 * aside), tuple(side - 0.02 * aside + 0.01 * np.roll(aside, 1))]
    found = []
    for body in (RigidBody(1.5, size, STEEL), Plate(*size, STEEL, object_mass_kg=1.5)):
        bodies: dict[str, Body] = {"box": body, "table": Plate(1.0, 0.7, 0.02, OAK)}
        turn = Rotation.align_vectors([normal], [DOWN])[0]
        poses = {"box": Pose(), "table": Pose(tuple(side - turn.apply([0.5, 0.35, 0.01])), tuple(turn.as_quat()))}
        contacts = [Contact("box", "table", foot, normal) for foot in feet]
        contacts.append(Contact("s0", "box", tuple(2 * middle - side + 0.01 * aside), normal))
        at = {"table": np.array([feet[0]]), "box": middle[None]}
        found.append(gains(MODELS[0], (bodies, poses, contacts), at))
    np.testing.assert_allclose(found[0], found[1], rtol=1e-9)


def test_a_thin_board_tilts_as_a_rigid_body_far_below_its_modes() -> None:
    """Receptance among any ports, against Newton's and Euler's equations of the rigid board."""
    board = Plate(0.7, 0.5, 0.06, OAK)
    body = inclined(board, ModalPlate().elastic_body(board, 1000.0))
    rng = np.random.default_rng(5)
    along = rng.normal(size=(6, 3))
    along /= np.linalg.norm(along, axis=1)[:, None]
    at = np.column_stack([rng.uniform(0.1, 0.4, (6, 2)), rng.uniform(-0.1, 0.1, 6), along])
    x, y, z = np.square([0.7, 0.5, 0.06])
    inertia = board.mass_kg / 12 * np.array([y + z, x + z, x + y])
    arms = np.cross(at[:, :3] - [0.35, 0.25, 0.0], along)
    expected = -(along @ along.T / board.mass_kg + arms / inertia @ arms.T) / (2 * np.pi * 2.0) ** 2
    found = body.receptance(at, at, np.array([2.0]))[0]
    # Bending has no inertia of its thickness, which is 1.4 % of the tilt's here.
    np.testing.assert_allclose(found, expected, atol=0.02 * np.abs(expected).max())


def rings(kind: str) -> list[list[tuple[float, float]]]:
    around = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    disc = np.column_stack([0.15 + 0.15 * np.cos(around), 0.15 + 0.15 * np.sin(around)])
    return {
        "disc": [disc.tolist()],
        "L": [[(0, 0), (0.3, 0), (0.3, 0.1), (0.1, 0.1), (0.1, 0.3), (0, 0.3)]],
        "triangle": [[(0, 0), (0.3, 0), (0, 0.3)]],
        "ring": [disc.tolist(), (0.15 + (disc - 0.15) / 2).tolist()],
    }[kind]


@pytest.mark.parametrize(
    ("kind", "middle", "xx", "xy"),
    [
        ("disc", 0.15, 0.15**2 / 4, 0.0),
        ("ring", 0.15, (0.15**2 + 0.075**2) / 4, 0.0),
        ("triangle", 0.1, 0.3**2 / 18, -(0.3**2) / 36),
        # Two rectangles about their common centroid: (0.3 x 0.1) at (0.15, 0.05) and (0.1 x 0.2) at (0.05, 0.2).
        (
            "L",
            0.11,
            0.6 * (0.3**2 / 12 + 0.04**2) + 0.4 * (0.1**2 / 12 + 0.06**2),
            -0.6 * 0.04 * 0.06 - 0.4 * 0.06 * 0.09,
        ),
    ],
)
def test_moments_of_an_outline(kind: str, middle: float, xx: float, xy: float) -> None:
    """In closed form; all four are symmetric about the diagonal."""
    found, products = Outline(rings(kind)).moments
    assert found == pytest.approx(middle, abs=3e-4)
    np.testing.assert_allclose(products, [[xx, xy], [xy, xx]], atol=4e-3 * xx)


@pytest.mark.parametrize("kind", ["disc", "L", "triangle"])
def test_the_rigid_rung_has_the_inertia_of_its_outline(kind: str) -> None:
    """A stool below its first mode, on rubber feet; `MassSpringDamper` is the reference where there is an outline."""
    outline = Outline(rings(kind))
    mass = Plate.of_outline(outline, 0.05, STEEL).mass_kg
    stool = Plate.of_outline(outline, 0.05, STEEL, object_mass_kg=mass, feet=RUBBER)
    at = [(0.05, 0.12), (0.12, 0.07), (0.07, 0.15)]
    found, expected, choice = rigid_and_bending(stool, at, MassSpringDamper(outside_domain="ignore"))
    assert choice.rung == "rigid"
    assert np.abs(found - expected).max() <= choice.bound_db


@pytest.mark.parametrize(("material", "kg"), [(OAK, 4.0), (OAK, 8.0), (STEEL, 22.0), (STEEL, 40.0)])
def test_a_stiff_top_on_heavy_legs_keeps_its_tolerance(material: Material, kg: float) -> None:
    """The legs of a stool weigh more than its top, and stand at its corners."""
    stool = Plate(0.25, 0.25, 0.035, material, object_mass_kg=kg, feet=RUBBER)
    corners = [(x, y) for x in (0.02, 0.23) for y in (0.02, 0.23)]
    found, expected, choice = rigid_and_bending(stool, corners, ModalPlate(), height_m=0.45)
    assert np.abs(found - expected).max() <= max(choice.bound_db, 0.2)


def rigid_and_bending(
    stool: Plate, feet: list[tuple[float, float]], reference: ModalPlate | MassSpringDamper, height_m: float = 0.0
) -> tuple[np.ndarray, np.ndarray, Choice]:
    """Levels on a stool [dB], at least -40 dB: those of `AutoFidelity`, and of a model that bends it."""
    bodies: dict[str, Body] = {"stool": stool, "floor": Plate(4, 4, 0.15, materials.lookup("concrete"))}
    top_m = height_m + stool.thickness_m / 2
    poses = {"stool": Pose((0, 0, height_m)), "floor": Pose((-2, -2, -0.075))}
    contacts = [Contact("stool", "floor", (x, y, 0), DOWN) for x, y in feet]
    x, y = feet[0]
    contacts += [Contact("s0", "stool", (x + dx, y + dy, top_m), DOWN) for dx in (0, 0.03) for dy in (0, 0.03)]
    network, sources = ContactNetwork(bodies, contacts, poses), [Excitation("s0", 40.0, 40.0, 3.0)]
    bands = Bands((10.0, 12.5, 16.0, 20.0, 25.0, 31.5, 40.0, 50.0, 60.0))
    points = [(*foot, height_m) for foot in feet]
    auto = AutoFidelity(tolerance_db=1.0).prepare(network, sources, bands)
    both = (auto.attenuation("stool", points), reference.prepare(network, sources, bands).attenuation("stool", points))
    found, expected = (20 * np.log10(np.maximum(one, 0.01)) for one in both)
    return found, expected, auto.choices["stool"]


def springs(scene_bodies: dict[str, Body], n: int, **source_kg: float) -> list[tuple[float, float]]:
    contacts = [Contact("phone", "table", (0.1 * (k + 1), 0.1, 0.0)) for k in range(n)]
    joints = joints_of(ContactNetwork(scene_bodies, contacts), {"phone", "table"}, ContactLaw(), source_kg)
    return [(one.stiffness_n_m, one.loss_factor) for one in joints]


def hertz(a: Material, b: Material, load_n: float) -> float:
    modulus = 1 / abs(sum((1 - m.poisson_ratio**2) / m.youngs_modulus_pa / complex(1, m.loss_factor) for m in (a, b)))
    return float((6 * modulus**2 * 0.005 * load_n) ** (1 / 3))


def test_a_phone_presses_with_its_own_weight_on_a_heavy_table() -> None:
    """Only the table's mass is stated, and its feet are rubber: neither has to do with the phone."""
    table = Plate(1.2, 0.7, 0.02, OAK, object_mass_kg=25.0, feet=RUBBER)
    g, glass = STANDARD_GRAVITY_M_S2, materials.lookup("glass")
    plate = Plate(0.15, 0.07, 0.008, glass)
    plastic = Material("hard plastic", 1050.0, 2.4e9, 0.35, 0.02)
    for bodies, source_kg, other, load_n in (
        ({"table": table}, {"phone": 0.2}, plastic, 0.2 * g / 4),
        ({"table": table, "phone": RigidBody(0.2, None, glass)}, {}, glass, 0.2 * g / 4),
        ({"table": table, "phone": plate}, {}, glass, plate.mass_kg * g / 4),
    ):
        for k, _ in springs(bodies, 4, **source_kg):
            assert k == pytest.approx(hertz(OAK, other, load_n), rel=1e-3)


def test_a_stiff_top_under_a_heavy_machine_bends() -> None:
    """A source of 15 kg on a stiff board of a few kg resonates on it far below the board's own first mode."""
    bodies: dict[str, Body] = {
        "top": Plate(0.3, 0.2, 0.02, OAK),
        "floor": Plate(3, 2, 0.15, materials.lookup("concrete")),
    }
    contacts = [Contact("top", "floor", (x, y, 0), DOWN) for x in (0.015, 0.285) for y in (0.01, 0.19)]
    contacts += [Contact("s0", "top", (0.15 + x, 0.02 + y, 0.02), DOWN) for x in (0, 0.03) for y in (0, 0.03)]
    network = ContactNetwork(bodies, contacts, {"top": Pose((0, 0, 0.01)), "floor": Pose((-1, -1, -0.075))})
    for f in (15.0, 22.0, 30.0, 45.0):
        sources, bands = [Excitation("s0", f, f, 15.0)], Bands.dominant(octaves=0.5)
        points = [(x, y, 0.01) for x in (0.0, 0.15, 0.3) for y in (0.0, 0.1, 0.2)]
        both = [
            model.prepare(network, sources, bands).attenuation("top", points)
            for model in (AutoFidelity(tolerance_db=1.0), ModalPlate())
        ]
        found, expected = (20 * np.log10(np.maximum(one, 0.01)) for one in both)
        assert np.abs(found - expected).max() <= 1.0
