"""The rooms of `tests/support/rooms`: properties that are known by construction."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rooms import ROOMS, room_file
from scene2hap import HapticSession, Pose, SceneSnapshot, Touch, load_scene
from scene2hap.contact.graph import ContactGraph
from with_tones import with_tones

# Some rooms have no sources.
pytestmark = pytest.mark.filterwarnings("ignore::scene2hap.SceneWarning")


@cache
def loaded(name: str) -> SceneSnapshot:
    return load_scene(room_file(name))


@pytest.mark.parametrize("name", ROOMS)
def test_every_triangle_has_its_composed_place(name: str) -> None:
    room, scene = ROOMS[name], loaded(name)
    ours = [item.pose.to_world(item.geometry.mesh.vertices_m)[item.geometry.mesh.faces] for item in scene.objects]
    # Fixed weights sort both equally for any order of corners; coordinates are stored in single precision.
    marks = [np.sort(table.reshape(-1, 3) @ [1.0, np.pi, np.e]) for table in (np.concatenate(ours), room.triangles_m())]
    np.testing.assert_allclose(*marks, atol=1e-5)


@pytest.mark.parametrize("name", ROOMS)
def test_object_on_a_source_is_felt_and_lifted_object_is_not(name: str) -> None:
    room, scene = ROOMS[name], loaded(name)
    session = HapticSession(scene, with_tones(scene))
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
@settings(max_examples=6)
@given(data=st.data())
def test_moved_scene_equals_a_scene_built_at_that_place(name: str, data: st.DataObject) -> None:
    room, scene = ROOMS[name], loaded(name)
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
