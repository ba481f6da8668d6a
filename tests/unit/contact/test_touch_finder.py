"""Contacts with a stated tolerance: pose tables, added and removed objects, array views."""

import numpy as np
import pytest

from contact_scenes import box, chair, floor, on_floor, pairs, scene
from scene2hap.contact.graph import ContactGraph
from scene2hap.errors import SceneError, UnknownObject
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.pose_table import PoseTable

IDS = tuple(f"b{k:02d}" for k in range(30))


def boxes_at(places: np.ndarray, turns: np.ndarray) -> list[SceneObject]:
    sizes = np.random.default_rng(1).uniform(0.05, 0.3, (len(IDS), 3)).tolist()
    rows = zip(IDS, sizes, places.tolist(), turns.tolist(), strict=True)
    return [box(name, tuple(size), tuple(at), turn) for name, size, at, turn in rows]


def heap(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    turns = rng.normal(size=(len(IDS), 4))
    return rng.uniform(0.0, 0.6, (len(IDS), 3)), turns / np.linalg.norm(turns, axis=1, keepdims=True)


def test_a_pose_table_gives_the_same_contacts_as_poses_and_a_new_graph() -> None:
    others = [floor(), chair((0.0, 0.0, 0.0))]
    by_table, by_pose, fresh = (
        ContactGraph(scene(*others, *boxes_at(*heap(seed))), tolerance_m=0.02) for seed in (0, 0, 1)
    )
    before = pairs(by_pose)
    table = PoseTable(IDS, *heap(1))
    change = by_table.update(table)
    assert change == by_pose.update(dict(table))
    assert len(pairs(fresh)) > 30
    assert by_table.contacts == by_pose.contacts == fresh.contacts
    assert by_table.poses == by_pose.poses == fresh.poses
    assert change.appeared == pairs(fresh) - before
    assert change.vanished == before - pairs(fresh)
    assert not by_table.update(PoseTable(IDS, *heap(1)))


def test_arrays_equal_the_contact_objects() -> None:
    graph = ContactGraph(scene(floor(), chair((0.0, 0.0, 0.0)), *boxes_at(*heap(2))), tolerance_m=0.02)
    graph.update(PoseTable(IDS, *heap(3)))
    arrays = graph.arrays
    contacts = graph.contacts
    assert [(arrays.ids[a], arrays.ids[b]) for a, b in zip(arrays.a, arrays.b, strict=True)] == [
        (c.a, c.b) for c in contacts
    ]
    assert arrays.points_m.tolist() == [list(c.point_m) for c in contacts]
    assert arrays.weights.tolist() == [c.weight for c in contacts]
    assert [tuple(n) if n[0] == n[0] else None for n in arrays.normals.tolist()] == [c.normal for c in contacts]


def test_shared_views_follow_updates() -> None:
    graph = ContactGraph(
        scene(floor(), on_floor("a", (0.1, 0.1, 0.1), 0, 0), on_floor("b", (0.1, 0.1, 0.1), 1, 1)), tolerance_m=0.004
    )
    junctions, beside = graph.junctions, graph.beside
    still, version, topology = junctions["b", "floor"], graph.version, graph.topology
    graph.update(PoseTable(["a"], [[0.3, 0.05, 0.0]], [[0, 0, 0, 1]]))
    assert junctions["b", "floor"] is still
    assert {round(x, 9) for x, _, _ in junctions["a", "floor"].points_m} == {0.25, 0.35}
    assert beside["a"]["floor"] is junctions["a", "floor"]
    assert (graph.version, graph.topology) == (version + 1, topology)
    graph.update(PoseTable(["a"], [[0.3, 0.5, 0.0]], [[0, 0, 0, 1]]))
    assert set(junctions) == {("b", "floor")}
    assert (graph.version, graph.topology) == (version + 2, topology + 1)


def test_tables_of_several_sets_of_ids_may_take_turns() -> None:
    graph = ContactGraph(scene(floor(), *boxes_at(*heap(4))), tolerance_m=0.01)
    expected = dict(graph.poses)
    for seed in range(12):
        places, turns = heap(seed)
        some = slice(seed % 5, None, 2)
        table = PoseTable(IDS[some], places[some], turns[some])
        graph.update(table)
        expected |= dict(table)
    assert graph.poses == expected
    assert graph.pose("b03") == expected["b03"]


def test_a_new_object_may_take_the_place_of_a_removed_one() -> None:
    graph = ContactGraph(scene(floor(), *boxes_at(*heap(5))), tolerance_m=0.01)
    change = graph.update({}, removed=IDS, added=[on_floor("new", (0.2, 0.2, 0.2), 0, 0)])
    assert change.appeared == {("floor", "new")}
    assert pairs(graph) == {("floor", "new")}
    graph.update(PoseTable(["new"], [[0.5, 0.1, 0.5]], [[0, 0, 0, 1]]))
    assert pairs(graph) == {("floor", "new")}


@pytest.mark.parametrize(
    ("ids", "positions", "rotations", "words"),
    [
        (["a"], [[0, 0]], [[0, 0, 0, 1]], "positions_m has shape"),
        (["a"], [[0, 0, np.nan]], [[0, 0, 0, 1]], "must be finite"),
        (["a"], [[0, 0, 0]], [[0, 0, 0, 0]], "length 0"),
        (["a"], [["x", 0, 0]], [[0, 0, 0, 1]], "not a table of numbers"),
    ],
)
def test_invalid_pose_table_is_refused(ids: list[str], positions: object, rotations: object, words: str) -> None:
    with pytest.raises(SceneError, match=words):
        PoseTable(ids, positions, rotations)


def test_an_id_twice_or_unknown_is_refused_and_changes_nothing() -> None:
    graph = ContactGraph(scene(floor(), on_floor("a", (0.1, 0.1, 0.1), 0, 0)), tolerance_m=0.004)
    before = graph.contacts
    with pytest.raises(SceneError, match="twice"):
        graph.update(PoseTable(["a", "a"], [[0, 5, 0], [0, 6, 0]], [[0, 0, 0, 1]] * 2))
    with pytest.raises(UnknownObject, match="aa"):
        graph.update(PoseTable(["a", "aa"], [[0, 5, 0], [0, 6, 0]], [[0, 0, 0, 1]] * 2))
    assert graph.contacts == before
    assert graph.pose("a") == Pose((0, 0.05, 0))


def test_a_table_is_a_mapping_of_poses_with_rotations_of_length_one() -> None:
    table = PoseTable(["a", "b"], [[1, 2, 3], [4, 5, 6]], [[0, 0, 0, 2], [0, 0, 3, 4]])
    assert dict(table) == {"a": Pose((1, 2, 3)), "b": Pose((4, 5, 6), (0, 0, 0.6, 0.8))}
    assert len(table) == 2
    assert "c" not in table
