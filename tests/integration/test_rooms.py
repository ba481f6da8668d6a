"""The rooms that the tests build themselves, from file to samples."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rooms import ROOMS, Room
from scene2hap import HapticBundle, HapticSession, Pose, SceneSnapshot, Touch, bake, load_scene
from scene2hap.contact.graph import ContactGraph
from scene2hap.errors import Scene2HapError

ReadRoom = tuple[Room, Path, SceneSnapshot]


@pytest.fixture(scope="module", params=ROOMS)
def read_room(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> ReadRoom:
    room = ROOMS[request.param]
    path = room.write(tmp_path_factory.mktemp("rooms"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # plausible scenes are silent
        return room, path, load_scene(path)


def test_every_thing_is_one_object_by_its_authors_name(read_room: ReadRoom) -> None:
    room, _, scene = read_room
    assert [item.id for item in scene.objects] == room.ids
    assert scene.up_axis == room.up_axis


def test_every_load_is_the_same(read_room: ReadRoom) -> None:
    _, path, scene = read_room
    assert load_scene(path) == scene


def test_every_triangle_is_where_it_was_put(read_room: ReadRoom) -> None:
    room, _, scene = read_room
    ours = [item.pose.to_world(item.geometry.mesh.vertices_m)[item.geometry.mesh.faces] for item in scene.objects]
    # Fixed weights sort both alike, whatever the order of corners; coordinates are stored in single precision.
    marks = [np.sort(table.reshape(-1, 3) @ [1.0, np.pi, np.e]) for table in (np.concatenate(ours), room.triangles_m())]
    np.testing.assert_allclose(*marks, atol=1e-5)


def test_exactly_the_composed_contacts_are_found(read_room: ReadRoom) -> None:
    room, _, scene = read_room
    contacts = ContactGraph(scene).contacts
    assert {(contact.a, contact.b) for contact in contacts} == room.contacts
    assert all(contact.weight == 1.0 for contact in contacts)


def test_sizes_are_those_of_the_construction(read_room: ReadRoom) -> None:
    room, _, scene = read_room
    for object_id, size_m in room.sizes_m.items():
        assert scene.object(object_id).size_m == pytest.approx(size_m, rel=1e-3)


def test_things_of_one_mesh_share_their_geometry_and_no_others_do(read_room: ReadRoom) -> None:
    room, _, scene = read_room
    meshes = {thing.id: id(thing.mesh) for thing in room.things}
    geometries = {item.id: id(item.geometry) for item in scene.objects}
    for x in room.ids:
        assert {y for y in room.ids if geometries[x] == geometries[y]} == {
            y for y in room.ids if meshes[x] == meshes[y]
        }
    for copies in room.copies:
        assert len({scene.object(object_id).instance_key for object_id in copies}) == 1


def test_exactly_the_sources_vibrate(read_room: ReadRoom) -> None:
    room, _, scene = read_room
    assert {key for key, haptics in bake(scene).objects.items() if haptics.vibrates} == room.sources


def test_from_file_to_samples(read_room: ReadRoom, tmp_path: Path) -> None:
    room, _, scene = read_room
    bundle = HapticBundle.load(bake(scene).save(tmp_path / "bundle"))
    assert bundle.snapshot == scene
    session = HapticSession(bundle.snapshot, bundle)
    assert set(session.source_ids) == room.sources
    for item in scene.objects:
        middle = tuple(item.bounds_m.mean(axis=0).tolist())
        frame = session.update(touches=[Touch("left", item.id, middle)])
        assert frame.gain("left", item.id) == 1.0 if item.id in room.sources else True
        out = session.render(480)
        assert np.isfinite(out).all()
        assert np.abs(out).max() <= 1.0


def test_what_stands_on_a_source_is_felt_and_what_is_lifted_off_is_not(read_room: ReadRoom) -> None:
    room, _, scene = read_room
    session = HapticSession(scene, bake(scene))
    for a, b in sorted(room.contacts):
        for source, other in ((a, b), (b, a)):
            if source not in room.sources or other in room.sources:
                continue
            item = scene.object(other)
            touch = Touch("left", other, tuple(item.bounds_m.mean(axis=0).tolist()))
            assert session.update({}, [touch]).gain("left", source) > 0
            away = scene.object(source).pose
            high = Pose(
                (away.position_m[0] + 100.0, away.position_m[1] + 100.0, away.position_m[2]), away.rotation_xyzw
            )
            assert session.update({source: high}, [touch]).gain("left", source) == 0
            session.update({source: away}, [touch])


@pytest.mark.parametrize("name", ROOMS)
@settings(max_examples=15, deadline=None)
@given(data=st.data())
def test_moving_there_is_building_there(
    name: str, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    room = ROOMS[name]
    scene = load_scene(room.write(tmp_path_factory.mktemp("rooms")))
    graph = ContactGraph(scene)
    offsets = st.tuples(*[st.sampled_from([-0.2, -0.05, -0.004, 0.0, 0.003, 0.05, 0.3])] * 3)
    for _ in range(5):
        moved = data.draw(st.dictionaries(st.sampled_from(room.ids), offsets, max_size=4))
        graph.update({key: shifted(scene.object(key).pose, by) for key, by in moved.items()})
        there = scene.with_poses({item.id: graph.pose(item.id) for item in scene.objects})
        assert graph.contacts == ContactGraph(there).contacts


def shifted(pose: Pose, by_m: tuple[float, float, float]) -> Pose:
    (x, y, z), (u, v, w) = pose.position_m, by_m
    return Pose((x + u, y + v, z + w), pose.rotation_xyzw)


def outcome(path: Path) -> str:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            load_scene(path)
        except Scene2HapError as error:
            return type(error).__name__
    return "ok"


def test_a_file_cut_short_is_refused(read_room: ReadRoom, tmp_path: Path) -> None:
    _, source, _ = read_room
    data, path = source.read_bytes(), tmp_path / source.name
    for length in np.linspace(0, len(data) - 4, 20).astype(int):
        path.write_bytes(data[:length])
        assert outcome(path) in ("SceneFormatError", "SceneError")


def test_flipped_bytes_lead_to_our_own_errors_or_to_a_scene(read_room: ReadRoom, tmp_path: Path) -> None:
    _, source, _ = read_room
    data, path = np.frombuffer(source.read_bytes(), np.uint8), tmp_path / source.name
    rng = np.random.default_rng(300)
    for _ in range(25):
        mutated = data.copy()
        mutated[rng.integers(20, len(data), size=3)] ^= rng.integers(1, 256, dtype=np.uint8)
        path.write_bytes(mutated.tobytes())
        assert outcome(path) in ("ok", "SceneFormatError", "SceneError")
