"""Objects with hundreds of contacts: results as for few, memory within a bound, and errors beyond it."""

from __future__ import annotations

import tracemalloc
import warnings

import numpy as np
import pytest

from scene2hap import (
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
    SceneObject,
    SceneSnapshot,
    Touch,
    bake,
    materials,
)
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.bodies import many_joints
from scene2hap.propagation.bodies.inclined_body import inclined
from scene2hap.propagation.bodies.lattice_body import lattice_body
from scene2hap.propagation.bodies.modal_body import ModalBody, modal_body
from scene2hap.propagation.bodies.rigid import RigidMotion
from scene2hap.propagation.coupled import coupling, elimination, large_body
from scene2hap.propagation.coupled.coupling import Joint, couple
from scene2hap.propagation.modal.plate_terms import ForcedPlate

FLOOR = Plate(6.0, 5.0, 0.1, materials.lookup("wood"))
F_HZ = np.geomspace(40.0, 200.0, 30)
FEET_M = ((0.0, 0.0), (0.4, 0.0), (0.0, 0.4), (0.4, 0.4))
MODELS = [ModalPlate(), MassSpringDamper(), InfinitePlate()]


def crates(n: int) -> ContactNetwork:
    """Crates with four feet each, in rows on a floor; the first one is a source."""
    contacts = [
        Contact("floor", f"crate {k}", (0.3 + 0.5 * (k % 11) + x, 0.3 + 0.45 * (k // 11) + y, 0.0))
        for k in range(n)
        for x, y in FEET_M
    ]
    crate = Plate(0.45, 0.45, 0.45, materials.lookup("wood"), object_mass_kg=2.5)
    bodies = {"floor": FLOOR, **{f"crate {k}": crate for k in range(n)}}
    poses = {f"crate {k}": Pose((0.3 + 0.5 * (k % 11), 0.3 + 0.45 * (k // 11), 0.2)) for k in range(n)}
    return ContactNetwork(bodies, contacts, {"floor": Pose(), **poses})


SOURCES = [Excitation("crate 0", 120.0, 120.0, 2.5), Excitation("crate 7", 90.0, 90.0, 2.5)]
AROUND = Bands.dominant(octaves=0.5)
TOUCHED_M = [(1.0, 2.0, 0.0), (5.5, 4.0, 0.0)]


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.kind)
def test_many_contacts_give_what_all_pairs_at_once_give(
    model: ModalPlate | MassSpringDamper | InfinitePlate, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Receptances of single frequencies, parts of the frequencies, and LAPACK: equal to rounding."""
    network = crates(50)
    by_parts = model.prepare(network, SOURCES, AROUND)
    monkeypatch.setattr(many_joints, "MOST_PAIRS", 10**9)
    monkeypatch.setattr(coupling, "AT_ONCE_BYTES", 10**12)
    at_once = model.prepare(network, SOURCES, AROUND)
    for object_id in ("floor", "crate 3", "crate 7"):
        found, expected = (field.attenuation(object_id, TOUCHED_M) for field in (by_parts, at_once))
        np.testing.assert_allclose(found, expected, rtol=1e-11)
    assert by_parts.attenuation("floor", TOUCHED_M).all()


def leaning(network: ContactNetwork) -> ContactNetwork:
    """The same with a board that leans on the floor and pushes it along its plane."""
    board = Contact("floor", "board", (5.0, 4.8, 0.0), normal=(0.6, 0.0, 0.8))
    bodies = {**network.bodies, "board": Plate(0.8, 0.6, 0.02, materials.lookup("wood"))}
    poses = {**network.poses, "board": Pose((4.8, 4.5, 0.0))}
    return ContactNetwork(bodies, (*network.contacts, board), poses)


@pytest.mark.parametrize(
    ("scene", "bands"),
    [(crates(80), AROUND), (crates(80), Bands((60.0, 65.0, 70.0))), (leaning(crates(100)), AROUND)],
    ids=["around", "shared", "inclined"],
)
def test_a_body_with_hundreds_of_contacts_equals_lapack(
    scene: ContactNetwork, bands: Bands, monkeypatch: pytest.MonkeyPatch
) -> None:
    sizes: list[int] = []
    dense = elimination.dense
    monkeypatch.setattr(elimination, "dense", lambda *args: sizes.append(len(args[2])) or dense(*args))
    found = ModalPlate().prepare(scene, SOURCES, bands)
    assert not sizes, "no full matrix is factored"
    monkeypatch.setattr(large_body, "is_faster", lambda *args: False)
    expected = ModalPlate().prepare(scene, SOURCES, bands)
    assert sum(sizes) == len(expected.sampling.frequencies_hz)
    monkeypatch.undo()
    sizes.clear()
    monkeypatch.setattr(coupling, "AT_ONCE_BYTES", 3 * 10**5)
    solve = large_body.solve
    monkeypatch.setattr(large_body, "solve", lambda *args: sizes.append(args[4].shape[1]) or solve(*args))
    by_parts = ModalPlate().prepare(scene, SOURCES, bands)
    assert len(sizes) > 1, "the receptances of the other bodies are bounded too"
    for object_id in ("floor", "crate 3", "crate 7"):
        one, two, other = (field.attenuation(object_id, TOUCHED_M) for field in (found, by_parts, expected))
        np.testing.assert_allclose(one, other, rtol=1e-9)
        np.testing.assert_allclose(two, other, rtol=1e-9)
        assert other.all()


def test_points_that_stay_keep_their_terms_to_the_last_bit() -> None:
    """Also if points before them come or go."""
    points = np.random.default_rng(3).uniform((0.0, 0.0), (6.0, 5.0), (200, 2))
    moved = np.concatenate([points[5:90] * 0.9, points[94:], points[:3]])
    body, fresh = (ModalBody(FLOOR, 200.0, 0.01) for _ in range(2))
    products: list[int] = []
    beyond = ForcedPlate.beyond_modes
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ForcedPlate, "beyond_modes", lambda *args: products.append(1) or beyond(*args))
        for now in (points, moved, points):
            found, expected = (one.separated(now, F_HZ) for one in (body, ModalBody(FLOOR, 200.0, 0.01)))
            np.testing.assert_array_equal(found.smooth, expected.smooth)
            np.testing.assert_array_equal(found.shapes, expected.shapes)
        one_moved = np.concatenate([points[:150], points[150:151] + 0.01, points[151:]])
        fresh.separated(points, F_HZ)
        products.clear()
        fresh.separated(one_moved, F_HZ)
        few = len(products)
        ModalBody(FLOOR, 200.0, 0.01).separated(one_moved, F_HZ)
    assert few < 0.4 * (len(products) - few)


def test_a_plate_that_is_pushed_along_its_plane_alone_is_not_separated() -> None:
    """None of its contacts bends it, so that it has no modes to be solved by."""
    ports = np.zeros((300, 6))
    ports[:, 0], ports[:, 4] = np.linspace(0.1, 5.9, 300), 1.0
    body = inclined(FLOOR, modal_body(FLOOR, 200.0, 0.01))
    assert body.separated(ports, F_HZ) is None
    ports[7, 4:] = 0.0, 1.0
    assert body.separated(ports, F_HZ) is not None


def test_several_objects_may_touch_a_plate_at_the_same_points() -> None:
    """As boxes side by side do at their corners."""
    once = np.random.default_rng(3).uniform((0.0, 0.0), (6.0, 5.0), (100, 2))
    begins = next(point for point in once if many_joints.parts_of(np.stack([once[0], point]))[1:])
    points = np.concatenate([once[:60], [begins, begins, begins, begins], once])
    body, alone = (ModalBody(FLOOR, 200.0, 0.01) for _ in range(2))
    among = body.receptance(points, points, F_HZ)
    np.testing.assert_allclose(among, alone.receptance(points, points.copy(), F_HZ), rtol=1e-9, atol=1e-16)
    for now in (points[:-30], points):
        found, expected = (one.separated(now, F_HZ) for one in (body, ModalBody(FLOOR, 200.0, 0.01)))
        np.testing.assert_array_equal(found.smooth, expected.smooth)


@pytest.mark.parametrize("body", [modal_body(FLOOR, 200.0, 0.01), lattice_body(FLOOR, 8, 200.0, 0.01)])
def test_receptances_among_many_points(body, monkeypatch: pytest.MonkeyPatch) -> None:
    """Symmetric to the last bit, and equal to those between the same points as if they were others."""
    points = np.random.default_rng(3).uniform((0.0, 0.0), (6.0, 5.0), (140, 2))
    assert many_joints.has_many(points)
    found = body.receptance(points, points, F_HZ[::8])
    np.testing.assert_array_equal(found, found.transpose(0, 2, 1))
    expected = body.receptance(points, points.copy(), F_HZ[::8])
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-11 * np.abs(expected).max())


def test_parts_of_the_frequencies_are_solved_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    bodies = {"top": RigidMotion(3.0, (1.0, 1.0, 0.1)), "s": RigidMotion(1.0), "t": RigidMotion(2.0)}
    joints = [Joint("s", "top", (0.0, 0.0), (x, 0.3), 1e5, 0.1) for x in (0.1, 0.5)]
    joints.append(Joint("top", "t", (0.9, 0.8), (0.0, 0.0), 2e5, 0.1))
    whole = couple(bodies, joints, ["s", "t"], F_HZ)
    monkeypatch.setattr(coupling, "AT_ONCE_BYTES", 1)
    in_parts = couple(bodies, joints, ["s", "t"], F_HZ)
    np.testing.assert_array_equal(in_parts.forces, whole.forces)
    np.testing.assert_array_equal(in_parts.holding("top"), whole.holding("top"))


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.kind)
def test_memory_is_bounded_by_a_part_of_the_frequencies(
    model: ModalPlate | MassSpringDamper | InfinitePlate, monkeypatch: pytest.MonkeyPatch
) -> None:
    """300 contacts: all receptances take 16 bytes x 300^2 per frequency, and the terms of all pairs more than that."""
    monkeypatch.setattr(coupling, "AT_ONCE_BYTES", 6_000_000)
    network = crates(75)
    model.prepare(network, SOURCES, AROUND)  # modes and tables are cached
    tracemalloc.start()
    field = model.prepare(network, SOURCES, AROUND)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 80_000_000
    assert field.attenuation("floor", TOUCHED_M).all()


@pytest.mark.parametrize(
    ("most_bytes", "sources", "hand", "message"),
    [
        (90_000, SOURCES[:1], None, "receptance among the 40 contacts of object 'floor' would .* Leave objects out"),
        (90_000, SOURCES, None, r"forces of 2 sources in 40 contacts at \d+ frequencies would .*use ExponentialPlate"),
        (1_000_000, SOURCES, "palm", r"hand on object 'floor' with 40 contacts at \d+ .* 1 MB are used. Set hand to"),
    ],
)
def test_errors_for_solutions_that_do_not_fit(
    most_bytes: int, sources: list[Excitation], hand: str | None, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(coupling, "MOST_BYTES", most_bytes)
    with pytest.raises(ModelDomainError, match=message):
        ModalPlate(hand=hand).prepare(crates(10), sources, AROUND)


def test_a_session_plays_on_without_a_field_that_does_not_fit(monkeypatch: pytest.MonkeyPatch) -> None:
    def thing(name: str, size: tuple[float, float, float], x: float, y: float = 0.0) -> SceneObject:
        return SceneObject(name, pose=Pose((x, y + size[1] / 2, 0.0)), geometry=Box(size))

    scene = SceneSnapshot.build(
        [
            thing("wooden floor", (3.0, 0.1, 3.0), 0.0, -0.1),
            thing("washing machine", (0.6, 0.85, 0.6), 0.5),
            thing("wooden crate", (0.45, 0.45, 0.45), -0.5),
        ]
    )
    monkeypatch.setattr(coupling, "MOST_BYTES", 1000)
    with HapticSession(scene, bake(scene), {"propagation": "modal_plate"}) as session:
        touches = [Touch("left", "washing machine", (0.5, 0.85, 0.0)), Touch("right", "wooden floor", (0.0, 0.0, 0.0))]
        session.update({}, touches)
        with pytest.warns(RuntimeWarning, match="The model could not prepare a field.*would take"):
            assert session.wait_prepared(60)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            gains = session.update({}, touches).gains
        assert "would take" in session.stats.last_failure
    assert gains[0].max() == 1.0
    assert not gains[1].any()
