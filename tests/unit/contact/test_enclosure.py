"""Enclosure: objects built into another with play, and objects that only stand near another."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from contact_scenes import Triple, box, boxes, floor, found, on_floor, points, scene, weight
from scene2hap.contact.body import Body
from scene2hap.contact.enclosure import enclosed, play_reach_m
from scene2hap.contact.geometry.triangles import first_hits
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose

DRAWER: Triple = (0.4, 0.12, 0.45)
REACH_M = play_reach_m(math.hypot(*DRAWER))


def carcass(play_m: float, at_m: Triple = (0, 0, 0)) -> SceneObject:
    """Two sides and a back, open in front (+z), above and below, with `play_m` on each side of the drawer."""
    x = DRAWER[0] / 2 + play_m + 0.009
    sides = [((0.018, 0.7, 0.5), (s * x, 0, 0)) for s in (-1, 1)]
    return boxes("carcass", *sides, ((2 * x, 0.7, 0.01), (0, 0, -0.25)), at_m=at_m)


def drawer(at_m: Triple = (0, 0, 0)) -> SceneObject:
    return box("drawer", DRAWER, at_m)


def graph_of(play_m: float, at_m: Triple = (0, 0, 0)) -> ContactGraph:
    """The graph of the drawer in the carcass, on a board, so that it does not hang."""
    board = box("board", (0.3, 0.02, 1.4), (0, -0.07, 0.5))
    return ContactGraph(scene(carcass(play_m), drawer(at_m), board))


@pytest.mark.parametrize("play_m", [0.001, 0.003, 0.005, 0.0127, 0.0135])
def test_a_drawer_is_built_into_its_carcass(play_m: float) -> None:
    graph = graph_of(play_m)
    assert weight(graph, "carcass", "drawer") == 1.0
    touch = points(graph, "carcass", "drawer")
    assert np.abs(touch[:, 0]) == pytest.approx(DRAWER[0] / 2 + play_m / 2)
    assert set(np.sign(touch[:, 0])) == {-1.0, 1.0}
    if play_m > 0.004:  # With less play it touches one side, which has a normal.
        assert {c.normal for c in graph.contacts if (c.a, c.b) == ("carcass", "drawer")} == {None}


def test_the_weight_falls_smoothly_with_play() -> None:
    plays = np.arange(0.0045, 0.022, 0.0005)
    weights = [weight(graph_of(float(play)), "carcass", "drawer") for play in plays]
    share = np.clip(3 * plays / REACH_M - 2, 0, 1)
    assert weights == pytest.approx(np.where(share < 1, (1 + np.cos(np.pi * share)) / 2, 0), abs=1e-6)
    assert weights[0] == 1.0
    assert weights[-1] == 0.0


def test_the_larger_play_counts() -> None:
    graph = graph_of(0.0127, (0.005, 0, 0))
    share = 3 * 0.0177 / REACH_M - 2
    assert weight(graph, "carcass", "drawer") == pytest.approx((1 + math.cos(math.pi * share)) / 2, abs=1e-6)


def test_a_drawer_drawn_out_leaves_its_carcass_smoothly() -> None:
    # The drawer's box ends at 0.225 m, the carcass at 0.25 m.
    for way_m, outside in ((0.025, 0.0), (0.17, 0.145 / 0.45), (0.2, 0.175 / 0.45), (0.26, 0.235 / 0.45)):
        graph = graph_of(0.0127, (0, 0, way_m))
        share = min(max(3 * outside / 0.5 - 2, 0.0), 1.0)
        assert weight(graph, "carcass", "drawer") == pytest.approx((1 + math.cos(math.pi * share)) / 2, abs=1e-6)


@pytest.mark.parametrize(("play_m", "expected"), [(0.0005, 1.0), (0.008, 0.0)])
def test_a_small_object_has_less_play(play_m: float, expected: float) -> None:
    remote = boxes("remote", *[((0.004, 0.02, 0.06), (s * 0.0125, 0, 0)) for s in (-1, 1)])
    battery = box("battery", (0.021 - 2 * play_m, 0.02, 0.055), (0, 0, 0))
    assert enclosed(Body.of(remote, 1), Body.of(battery, 1))[0] == expected


def test_a_leaf_is_built_into_its_frame_and_ajar_it_is_not() -> None:
    posts = [((0.05, 2.0, 0.08), (s * 0.43, 1.0, 0)) for s in (-1, 1)]
    frame = boxes("frame", *posts, ((0.91, 0.05, 0.08), (0, 2.03, 0)))
    size: Triple = (0.8, 1.99, 0.04)
    standing = {("floor", "frame"), ("floor", "leaf")}
    assert found(floor(), frame, on_floor("leaf", size, 0, 0, 0.006)) == {*standing, ("frame", "leaf")}
    for angle in (0.15, 0.6, 1.5):
        # Rotation about a hinge at (-0.38, 0.04); the leaf's hinge edge stays within its thickness of the hinge.
        x, z = -0.38 + 0.4 * math.cos(angle), 0.04 + 0.4 * math.sin(angle)
        turned = (0.0, -math.sin(angle / 2), 0.0, math.cos(angle / 2))
        assert found(floor(), frame, box("leaf", size, (x, 1.001, z), turned)) == standing


def test_a_sofa_in_a_corner_is_not_built_into_the_room() -> None:
    sides = [((4.0, 2.5, 0.1), (0, 1.25, s * 2)) for s in (-1, 1)]
    sides += [((0.1, 2.5, 4.0), (s * 2, 1.25, 0)) for s in (-1, 1)]
    room = boxes("room", *sides, ((4.0, 0.1, 4.0), (0, 2.5, 0)))
    sofa = on_floor("sofa", (2.0, 0.8, 0.9), -0.94, -1.49)
    assert enclosed(Body.of(room, 1), Body.of(sofa, 1))[0] == 0.0
    assert found(floor(), room, sofa) == {("floor", "room"), ("floor", "sofa")}


def test_a_book_between_books_is_built_into_neither() -> None:
    books = [on_floor(name, (0.03, 0.24, 0.17), x, 0) for name, x in (("a", -0.036), ("b", 0.0), ("c", 0.036))]
    assert found(floor(), *books) == {("a", "floor"), ("b", "floor"), ("c", "floor")}


def test_a_cup_between_two_walls_is_built_into_neither() -> None:
    walls = [on_floor(name, (0.1, 2.0, 2.0), s * 0.0955, 0) for name, s in (("left", -1), ("right", 1))]
    cup = on_floor("cup", (0.08, 0.1, 0.08), 0, 0)
    assert found(floor(), *walls, cup) == {("floor", "left"), ("floor", "right"), ("cup", "floor")}


def test_a_chair_between_the_legs_of_a_table_is_not_built_into_it() -> None:
    legs = [((0.04, 0.7, 0.04), (x, 0.35, z)) for x in (-0.25, 0.25) for z in (-0.3, 0.3)]
    table = boxes("table", *legs, ((0.6, 0.03, 0.7), (0, 0.715, 0)))
    stool = on_floor("stool", (0.44, 0.45, 0.63), 0, 0)
    assert found(floor(), table, stool) == {("floor", "table"), ("floor", "stool")}


def test_two_that_stand_beside_each_other_are_not_built_into_each_other() -> None:
    assert enclosed(Body.of(drawer(), 1), Body.of(carcass(0.005, (0.5, 0, 0)), 1))[0] == 0.0


PLACES = st.tuples(*[st.sampled_from(values) for values in ((0.0, 0.004, 0.011), (0.0, 0.03), (0.0, 0.1, 0.19, 0.4))])
TURNS = st.sampled_from([(0.0, 0.0, 0.0, 1.0), (0.0, 0.004, 0.0, 1.0), (0.002, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 0.0)])


@given(st.lists(st.tuples(st.sampled_from(["drawer", "carcass"]), PLACES, TURNS), min_size=1, max_size=4))
@settings(max_examples=40)
def test_poses_alone_decide(path: list[tuple[str, Triple, tuple[float, float, float, float]]]) -> None:
    objects = {"drawer": drawer(), "carcass": carcass(0.0127)}
    graph = ContactGraph(scene(*objects.values()))
    for name, place, turn in path:
        pose = Pose(place, turn)
        graph.update({name: pose})
        item = objects[name]
        objects[name] = type(item)(item.id, item.name, pose, item.geometry, item.surface)
        assert graph.contacts == ContactGraph(scene(*objects.values())).contacts


def test_enclosure_is_invariant_under_common_motion() -> None:
    motion = Pose((0.3, -1.2, 0.7), (0.0, 0.6, 0.0, 0.8))
    items = [Body.of(item, 1) for item in (carcass(0.015), drawer())]
    there = [body.at(motion.compose(body.pose)) for body in items]
    assert 0 < enclosed(*items)[0] < 1
    assert enclosed(*there) == pytest.approx(enclosed(*items), abs=1e-9)
    assert enclosed(*items[::-1]) == enclosed(*items)


def test_a_ray_finds_the_first_triangle() -> None:
    shape = Body.of(box("cube", (1, 1, 1), (0, 0, 0)), 1).shape
    start = np.array([[-2.0, 0.1, 0.2], [0.0, 0.0, 0.0], [-2.0, 0.7, 0.0], [0.2, 0.3, 3.0]])
    way = np.array([[3.0, 0, 0], [0, 1.0, 0], [3.0, 0, 0], [0, 0, -10.0]])
    assert first_hits(start.T, way.T, shape.triangles, shape.boxes) == pytest.approx([0.5, 0.5, np.inf, 0.25])


def test_a_shape_is_seen_from_six_sides() -> None:
    shape = Body.of(boxes("chair", ((0.4, 0.02, 0.4), (0, 0.2, 0)), ((0.1, 0.2, 0.1), (0, 0.1, 0))), 1).shape
    low_x, low_y, _, high_x, high_y, _ = shape.sides
    assert shape.sides.shape == (6, 64, 3)
    assert set(np.round(high_y[:, 1], 9)) == {0.21}
    assert set(np.round(low_y[:, 1], 9)) == {0.0, 0.19}
    for side, sign in ((low_x, -1), (high_x, 1)):
        seen = side[~np.isnan(side[:, 0])]
        assert set(np.round(seen[:, 0] * sign, 9)) == {0.05, 0.2}
        assert len(seen) < 64
