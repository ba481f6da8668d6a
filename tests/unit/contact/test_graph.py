"""The public behaviour of the contact graph."""

import subprocess
import sys
from collections.abc import Container

import numpy as np
import pytest

from contact_scenes import box, boxes, floor, found, on_floor, pairs, points, scene, weight
from scene2hap.contact.body import Body
from scene2hap.contact.graph import ContactChange, ContactGraph
from scene2hap.errors import SceneError, UnknownObject
from scene2hap.scene.objects import Contact, SceneObject
from scene2hap.scene.pose import Pose

TABLE = on_floor("table", (1.0, 0.7, 1.0), 0, 0)
CUP = box("cup", (0.08, 0.1, 0.08), (0.2, 0.75, 0.1))


def room(*more: SceneObject, tolerance_m: float | None = None) -> ContactGraph:
    return ContactGraph(scene(floor(), TABLE, CUP, *more), tolerance_m=tolerance_m)


def test_a_cup_on_a_table_touches_at_its_corners_straight_down() -> None:
    graph = room()
    assert pairs(graph) == {("cup", "table"), ("floor", "table")}
    expected = {(round(x, 9), 0.7, round(z, 9)) for x in (0.16, 0.24) for z in (0.06, 0.14)}
    assert {tuple(np.round(point, 9)) for point in points(graph, "cup", "table").tolist()} == expected
    assert all(c.weight == 1.0 for c in graph.contacts)
    assert {c.normal for c in graph.contacts if c.a == "cup"} == {(0.0, -1.0, 0.0)}
    assert {c.normal for c in graph.contacts if c.a == "floor"} == {(0.0, 1.0, 0.0)}


def test_graph_neighbours_and_poses_are_consistent() -> None:
    graph = room(on_floor("alone", (0.1, 0.1, 0.1), 2, 2, gap_m=1.0))
    assert set(graph.graph.nodes) == {"floor", "table", "cup", "alone"}
    assert {tuple(sorted(edge)) for edge in graph.graph.edges} == pairs(graph)
    for a, b, contacts in graph.graph.edges(data="contacts"):
        assert contacts == [c for c in graph.contacts if {c.a, c.b} == {a, b}]
    assert graph.neighbours("table") == ("cup", "floor")
    assert graph.neighbours("alone") == ()
    assert graph.poses["cup"] == CUP.pose


def test_contacts_are_sorted_by_pair_for_any_order_of_objects() -> None:
    objects = [floor(), TABLE, CUP, box("plate", (0.2, 0.01, 0.2), (-0.2, 0.706, 0.0))]
    forward, backward = ContactGraph(scene(*objects)), ContactGraph(scene(*reversed(objects)))
    assert forward.contacts == backward.contacts
    assert [(c.a, c.b) for c in forward.contacts] == sorted((c.a, c.b) for c in forward.contacts)
    assert all(c.a < c.b for c in forward.contacts)


def test_names_have_no_effect_on_contacts() -> None:
    renamed = ContactGraph(
        scene(box("a", (1.0, 0.7, 1.0), (0, 0.35, 0)), box("b", (0.08, 0.1, 0.08), (0.2, 0.75, 0.1)))
    )
    assert {tuple(p) for p in points(renamed, "a", "b").round(9)} == {
        tuple(p) for p in points(room(), "cup", "table").round(9)
    }


def test_overlap_is_contact() -> None:
    sunk = box("sunk", (0.3, 0.3, 0.3), (0.0, 0.6, 0.0))
    assert ("sunk", "table") in pairs(room(sunk))
    assert ("sunk", "table") in pairs(room(sunk, tolerance_m=0.0))


def test_room_shell_does_not_replace_contacts_of_objects_inside() -> None:
    walls = [((0.1, 3, 6), (x, 1.5, 0)) for x in (-3, 3)] + [((6, 3, 0.1), (0, 1.5, z)) for z in (-3, 3)]
    shell = boxes("shell", *walls)
    beside_wall = on_floor("beside", (0.4, 0.4, 0.4), 2.749, 0)
    assert pairs(room(shell, beside_wall)) == pairs(room()) | {
        ("floor", "shell"),
        ("beside", "floor"),
        ("beside", "shell"),
    }


def test_a_box_inside_a_closed_box_does_not_touch_it() -> None:
    outer, inner = box("outer", (1, 1, 1), (0, 5, 0)), box("inner", (0.2, 0.2, 0.2), (0, 5, 0))
    assert found(outer, inner) == set()
    assert found(outer, inner, tolerance_m=0.02) == set()


def test_a_stated_tolerance_is_used_as_it_is_for_every_pair() -> None:
    lifted = on_floor("lifted", (1, 1, 1), 0, 0, gap_m=0.02)
    beside = on_floor("beside", (1, 1, 1), 1.02, 0, gap_m=0.02)
    assert found(floor(), lifted, beside, tolerance_m=0.019) == set()
    every = ContactGraph(scene(floor(), lifted, beside), tolerance_m=0.024)
    assert pairs(every) == {("floor", "lifted"), ("beside", "floor"), ("beside", "lifted")}
    # 0.020 is half way between 2/3 of 0.024 and 0.024, where the raised cosine is 0.5.
    assert weight(every, "beside", "lifted") == pytest.approx(0.5)
    normals = {c.normal for c in every.contacts if (c.a, c.b) == ("beside", "lifted")}
    assert [pytest.approx(normal) for normal in normals] == [(-1, 0, 0)]


def test_tolerance_zero_finds_exact_contacts_only() -> None:
    assert found(floor(), TABLE, CUP, tolerance_m=0.0) == {("floor", "table"), ("cup", "table")}
    assert found(floor(), on_floor("up", (1, 1, 1), 0, 0, gap_m=1e-6), tolerance_m=0.0) == set()


@pytest.mark.parametrize("tolerance", [-0.001, float("nan"), float("inf"), "wide", True])
def test_a_tolerance_that_is_no_length_is_refused(tolerance: object) -> None:
    with pytest.raises(SceneError, match="tolerance_m"):
        ContactGraph(scene(TABLE), tolerance_m=tolerance)


def test_update_returns_appeared_shifted_and_vanished_pairs() -> None:
    graph = room(on_floor("shelf", (0.4, 0.4, 0.4), 2.0, 0.0))
    assert graph.update({"cup": Pose((0.3, 0.75, 0.1))}) == ContactChange(shifted=frozenset({("cup", "table")}))
    assert points(graph, "cup", "table")[:, 0].mean() == pytest.approx(0.3)
    change = graph.update({"cup": Pose((2.0, 0.45, 0.0))})
    assert change == ContactChange(frozenset({("cup", "shelf")}), frozenset({("cup", "table")}))
    assert graph.neighbours("cup") == ("shelf",)
    assert graph.poses["cup"].position_m == (2.0, 0.45, 0.0)
    assert not graph.update({"cup": Pose((2.0, 0.45, 0.0))})
    assert not graph.update({})


def test_a_change_of_weight_alone_is_a_shift() -> None:
    saucer = box("saucer", (0.15, 0.006, 0.15), (0.2, 0.703, 0.1))
    cup = box("cup", (0.08, 0.1, 0.08), (0.2, 0.757, 0.1))
    graph = ContactGraph(scene(floor(), TABLE, cup, saucer))
    assert ("cup", "table") not in pairs(graph)
    change = graph.update({"saucer": Pose((5.0, 0.703, 5.0))})
    assert change == ContactChange(
        appeared=frozenset({("cup", "table")}), vanished=frozenset({("cup", "saucer"), ("saucer", "table")})
    )


def test_bodies_at_rest_are_not_searched(monkeypatch: pytest.MonkeyPatch) -> None:
    from scene2hap.contact import finder
    from scene2hap.contact.mesh_distance import MeshPair

    graph = room(*(on_floor(f"crate{i}", (0.2, 0.2, 0.2), -2, i * 0.5 - 2) for i in range(6)))
    met: list[set[str]] = []
    paired, made = finder.BodyPair.__init__, MeshPair.__init__

    def watched(self: MeshPair, a: Body, b: Body) -> None:
        met.append({a.id, b.id})
        made(self, a, b)

    def tied(self: finder.BodyPair, a: Body, b: Body, *hinged: Container[str]) -> None:
        met.append({a.id, b.id})
        paired(self, a, b, *hinged)

    monkeypatch.setattr(MeshPair, "__init__", watched)
    monkeypatch.setattr(finder.BodyPair, "__init__", tied)
    graph.update({"cup": Pose((0.25, 0.76, 0.1))})
    assert all(pair == {"cup", "table"} for pair in met)
    # At the table's edge, the foot of a tilted cup is not wholly over the table, so that triangles must be tested.
    graph.update({"cup": Pose((0.5, 0.77, 0.1), (0.1, 0.0, 0.0, 1.0))})
    assert len(met) >= 2  # a body pair, and its triangles
    assert all(pair == {"cup", "table"} for pair in met)


def test_objects_can_be_added_and_removed() -> None:
    graph = room()
    plate = box("plate", (0.2, 0.01, 0.2), (-0.2, 0.705, 0.0))
    assert graph.update({}, added=[plate]) == ContactChange(appeared=frozenset({("plate", "table")}))
    assert graph.update({}, removed=["table"]) == ContactChange(
        vanished=frozenset({("cup", "table"), ("floor", "table"), ("plate", "table")})
    )
    assert set(graph.poses) == {"floor", "cup", "plate"}
    assert graph.contacts == ()
    change = graph.update({"plate": Pose((1.0, 0.005, 1.0))}, added=[TABLE], removed=["cup"])
    assert change.appeared == {("floor", "table"), ("floor", "plate")}
    assert graph.contacts == ContactGraph(scene(floor(), TABLE, box("plate", (0.2, 0.01, 0.2), (1, 0.005, 1)))).contacts


def test_a_removed_object_leaves_no_contacts() -> None:
    graph = ContactGraph(scene(box("table", (1.0, 0.1, 1.0), (0.0, 0.0, 0.0))))
    for n in range(3):
        graph.update({}, added=[box(f"cup_{n}", (0.1, 0.1, 0.1), (0.0, 0.1, 0.0))])
        assert set(graph.beside) == {"table", f"cup_{n}"}
        graph.update({}, removed=[f"cup_{n}"])
    assert not graph.beside


def test_one_update_may_remove_and_add_the_same_id() -> None:
    graph = room()
    graph.update({}, removed=["cup"], added=[box("cup", (0.3, 0.3, 0.3), (2, 0.15, 2))])
    assert pairs(graph) == {("floor", "table"), ("cup", "floor")}
    graph.update({}, removed=["cup", "table", "floor"])
    assert graph.contacts == ()


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"moved": {"cap": Pose()}}, UnknownObject, "Did you mean 'cup'"),
        ({"moved": {}, "removed": ["cap"]}, UnknownObject, "cap"),
        ({"moved": {}, "removed": ["cup", "cup"]}, UnknownObject, "cup"),
        ({"moved": {"cup": Pose()}, "removed": ["cup"]}, UnknownObject, "cup"),
        ({"moved": {}, "added": [CUP]}, SceneError, "already"),
        ({"moved": {"cup": (0, 0, 0)}}, SceneError, "must be a Pose"),
        ({"moved": {}, "contacts": [Contact("cup", "ghost", (0, 0, 0))]}, UnknownObject, "ghost"),
    ],
)
def test_a_refused_update_leaves_the_graph_as_it_was(arguments: dict, error: type[Exception], words: str) -> None:
    graph = room()
    before = (graph.contacts, dict(graph.poses))
    with pytest.raises(error, match=words):
        graph.update(**arguments)
    assert (graph.contacts, dict(graph.poses)) == before


def test_neighbours_of_an_unknown_object_are_refused() -> None:
    with pytest.raises(UnknownObject, match="tabel"):
        room().neighbours("tabel")


def test_poses_are_read_only_and_not_changed_by_later_updates() -> None:
    graph = room()
    poses = graph.poses
    with pytest.raises(TypeError):
        poses["cup"] = Pose()
    graph.update({"cup": Pose((0.0, 0.75, 0.0))})
    assert poses["cup"] == CUP.pose


GIVEN = (
    Contact("table", "cup", (0.2, 0.7, 0.1), normal=(0.0, 1.0, 0.0), area_m2=1e-4, weight=0.5),
    Contact("cup", "table", (0.1, 0.7, 0.1)),
    Contact("cup", "floor", (9.0, 9.0, 9.0)),
)


def given_room() -> ContactGraph:
    return ContactGraph(scene(floor(), TABLE, CUP, contacts=GIVEN))


def test_given_contacts_are_kept_except_for_the_order_of_ids() -> None:
    assert given_room().contacts == (
        Contact("cup", "floor", (9.0, 9.0, 9.0)),
        Contact("cup", "table", (0.1, 0.7, 0.1)),
        Contact("cup", "table", (0.2, 0.7, 0.1), normal=(-0.0, -1.0, -0.0), area_m2=1e-4, weight=0.5),
    )
    assert ContactGraph(scene(floor(), TABLE, CUP, contacts=reversed(GIVEN))).contacts == given_room().contacts


def test_an_empty_list_of_contacts_means_that_nothing_touches() -> None:
    assert ContactGraph(scene(floor(), TABLE, CUP, contacts=())).contacts == ()


def test_given_contacts_of_moving_objects_are_dropped() -> None:
    graph = given_room()
    change = graph.update({"floor": Pose((0, -1, 0))})
    assert change == ContactChange(vanished=frozenset({("cup", "floor")}))
    assert pairs(graph) == {("cup", "table")}
    assert not graph.update({"cup": CUP.pose})
    graph.update({}, removed=["table"])
    assert graph.contacts == ()


def test_new_given_contacts_replace_all() -> None:
    graph = given_room()
    change = graph.update({"cup": Pose((0.5, 0.75, 0.1))}, contacts=[Contact("cup", "table", (0.5, 0.7, 0.1))])
    assert change == ContactChange(vanished=frozenset({("cup", "floor")}), shifted=frozenset({("cup", "table")}))
    assert graph.contacts == (Contact("cup", "table", (0.5, 0.7, 0.1)),)


def test_an_engine_may_take_over_from_geometry() -> None:
    graph = room()
    change = graph.update({}, contacts=[Contact("cup", "floor", (0, 0, 0))])
    assert change.appeared == {("cup", "floor")}
    assert change.vanished == {("cup", "table"), ("floor", "table")}
    graph.update({"cup": Pose((0.2, 0.75, 0.2))})
    assert graph.contacts == ()


def test_networkx_waits_until_a_graph_is_drawn() -> None:
    code = "import sys, scene2hap.contact.graph; sys.exit('networkx' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
