"""Contact rule: which objects hold an object, in scenes with an obvious answer."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from contact_scenes import Triple, box, boxes, chair, floor, found, on_floor, scene, weight
from scene2hap.contact import rule
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose

CUP: Triple = (0.08, 0.1, 0.08)


def floating_weight(item: SceneObject, lift_m: float, other: str = "floor") -> float:
    x, y, z = item.pose.position_m
    graph = ContactGraph(scene(floor(), box(item.id, item.geometry.size_m, (x, y + lift_m, z))))
    return weight(graph, *sorted((item.id, other)))


def weights_of(*objects: SceneObject) -> dict[tuple[str, str], float]:
    """The weight of each pair that touches."""
    graph = ContactGraph(scene(*objects))
    return {pair: weight(graph, *pair) for pair in found(*objects)}


@pytest.mark.parametrize(
    ("size", "gap_m"),
    [
        ((2.4, 1.0, 2.4), 0.060),  # sofa
        ((0.45, 0.9, 0.45), 0.045),  # chair
        ((1.3, 0.4, 0.7), 0.039),  # coffee table
        ((0.19, 0.012, 0.12), 0.037),  # tablet
        ((0.9, 1.8, 0.8), 0.012),  # refrigerator
        ((0.08, 0.1, 0.08), 0.016),  # tableware
        ((0.6, 0.6, 0.6), 0.009),  # ball
        ((0.5, 0.5, 0.5), 0.0),
        ((0.5, 0.5, 0.5), -0.010),  # sunk in
    ],
)
def test_gaps_below_resting_objects_of_real_scenes_weigh_one(size: Triple, gap_m: float) -> None:
    assert floating_weight(on_floor("thing", size, 0.3, 0.2), gap_m) == 1.0


def test_an_object_above_its_fall_reach_touches_nothing() -> None:
    assert found(floor(), on_floor("cup", CUP, 0, 0, gap_m=0.05)) == set()
    assert found(floor(), on_floor("sofa", (2, 1, 1), 0, 0, gap_m=0.1)) == set()


def test_the_weight_falls_smoothly_with_height() -> None:
    cup = on_floor("cup", CUP, 0, 0)
    reach = rule.fall_reach_m(float(np.linalg.norm(CUP)))
    lifts = np.arange(0.0, 0.05, 0.0005)
    weights = np.array([floating_weight(cup, float(lift)) for lift in lifts])
    assert weights == pytest.approx([rule.weight(float(lift), reach) for lift in lifts])
    assert weights[0] == 1.0
    assert weights[-1] == 0.0
    assert (np.diff(weights) <= 0).all()
    # The largest slope of half a cosine over a third of the reach.
    assert np.abs(np.diff(weights)).max() <= np.pi / 2 * 0.0005 / (reach / 3)


@pytest.mark.parametrize(
    ("share", "expected"), [(0, 1), (0.5, 1), (2 / 3, 1), (0.75, 0.853553), (5 / 6, 0.5), (1, 0), (2, 0)]
)
def test_weight_is_a_raised_cosine_over_the_last_third(share: float, expected: float) -> None:
    assert rule.weight(share * 0.03, 0.03) == pytest.approx(expected, abs=1e-6)


def test_weight_at_tolerance_zero_needs_a_gap_of_zero() -> None:
    assert rule.weight(0.0, 0.0) == 1.0
    assert rule.weight(1e-6, 0.0) == 0.0


def test_a_cup_on_a_saucer_is_not_on_the_table() -> None:
    table = on_floor("table", (1, 0.7, 1), 0, 0)
    saucer = box("saucer", (0.15, 0.006, 0.15), (0, 0.703, 0))
    cup = box("cup", CUP, (0, 0.756, 0))
    assert found(floor(), table, saucer, cup) == {("floor", "table"), ("saucer", "table"), ("cup", "saucer")}


def test_a_saucer_floats_over_the_table_although_a_cup_stands_on_it() -> None:
    table = on_floor("table", (1, 0.7, 1), 0, 0)
    saucer = box("saucer", (0.15, 0.006, 0.15), (0, 0.711, 0))
    cup = box("cup", CUP, (0, 0.764, 0))
    assert found(table, saucer, cup) == {("saucer", "table"), ("cup", "saucer")}


def test_objects_wholly_on_a_carpet_do_not_touch_the_floor() -> None:
    carpet = box("carpet", (2, 0.003, 2), (0, 0.0015, 0))
    assert found(floor(), carpet, chair((0, 0.011, 0))) == {("carpet", "floor"), ("carpet", "chair")}


def test_a_chair_half_on_the_carpet_stands_on_both() -> None:
    carpet = box("carpet", (2, 0.003, 2), (1, 0.0015, 0))
    expected = {("carpet", "floor"), ("carpet", "chair"), ("chair", "floor")}
    assert found(floor(), carpet, chair((0, 0.003, 0))) == expected
    assert found(floor(), carpet, chair((0, 0.025, 0))) == expected


def test_a_floating_refrigerator_stands_on_the_floor_despite_contacts_beside() -> None:
    wall = on_floor("wall", (3, 3, 0.2), 0, -1.1)
    counter = on_floor("counter", (1, 0.9, 0.6), 0.95, -0.7)
    fridge = on_floor("fridge", (0.901, 1.8, 0.7), 0, -0.651, gap_m=0.012)  # 1 mm deep in wall and counter
    resting = {("floor", "wall"), ("counter", "floor"), ("counter", "wall")}
    graph = ContactGraph(scene(floor(), wall, counter, fridge))
    assert {(c.a, c.b) for c in graph.contacts} == resting | {
        ("floor", "fridge"),
        ("counter", "fridge"),
        ("fridge", "wall"),
    }
    assert weight(graph, "floor", "fridge") == 1.0


def test_objects_side_by_side_do_not_hold_each_other() -> None:
    left, right = on_floor("left", (0.5, 0.5, 0.5), 0, 0, 0.02), on_floor("right", (0.5, 0.9, 0.5), 0.506, 0, 0.02)
    assert found(floor(), left, right) == {("floor", "left"), ("floor", "right")}


def test_objects_side_by_side_that_intersect_a_little_do_not_hold_each_other() -> None:
    left, right = on_floor("left", (0.5, 0.5, 0.5), 0, 0, 0.02), on_floor("right", (0.5, 0.9, 0.5), 0.498, 0, 0.022)
    assert found(floor(), left, right) == {("floor", "left"), ("floor", "right"), ("left", "right")}


def test_only_the_bottom_falls() -> None:
    """A table hovers 12 mm above the floor, and its top 6 mm above a stool."""
    legs = [((0.05, 0.7, 0.05), (x, 0.35, z)) for x in (-0.5, 0.5) for z in (-0.3, 0.3)]
    table = boxes("table", *legs, ((1.1, 0.04, 0.7), (0, 0.72, 0)), at_m=(0, 0.012, 0))
    assert found(floor(), table, on_floor("stool", (0.3, 0.706, 0.3), 0, 0)) == {("floor", "stool"), ("floor", "table")}


@pytest.mark.parametrize("gap_m", [0.0, 0.012])
def test_equal_boxes_may_be_stacked(gap_m: float) -> None:
    graph = ContactGraph(
        scene(box("above", (0.3, 0.3, 0.3), (0, 0.45 + gap_m, 0)), box("below", (0.3, 0.3, 0.3), (0, 0.15, 0)))
    )
    assert weight(graph, "above", "below") == 1.0
    assert {c.normal for c in graph.contacts} == {(0.0, -1.0, 0.0)}


def test_small_objects_hover_over_small_objects() -> None:
    saucer = box("saucer", (0.15, 0.006, 0.15), (0, 0.003, 0))
    assert found(saucer, box("cup", CUP, (0, 0.056 + 0.016, 0))) == {("cup", "saucer")}


def test_an_ajar_door_leaf_does_not_touch_the_other() -> None:
    leaves = [on_floor(name, (0.04, 2.0, 0.8), x, 0, gap_m=0.04) for name, x in (("left", 0.0), ("right", 0.061))]
    assert found(floor(), *leaves) == {("floor", "left"), ("floor", "right")}


def test_an_object_in_a_bin_stands_on_its_bottom() -> None:
    sides = [((0.3, 0.3, 0.01), (0, 0.15, z)) for z in (-0.145, 0.145)] + [
        ((0.01, 0.3, 0.3), (x, 0.15, 0)) for x in (-0.145, 0.145)
    ]
    bin_ = boxes("bin", *sides, ((0.3, 0.02, 0.3), (0, 0.01, 0)))
    assert found(floor(), bin_, box("paper", CUP, (0, 0.08, 0))) == {("bin", "floor"), ("bin", "paper")}


@pytest.mark.parametrize("gap_m", [0.0, 0.003, 0.012])
def test_a_picture_hangs_on_the_wall(gap_m: float) -> None:
    wall = on_floor("wall", (3, 3, 0.2), 0, 0)
    picture = box("picture", (0.6, 0.4, 0.02), (0, 1.5, 0.11 + gap_m))
    graph = ContactGraph(scene(floor(), wall, picture))
    assert {(c.a, c.b) for c in graph.contacts} == {("floor", "wall"), ("picture", "wall")}
    assert weight(graph, "picture", "wall") == 1.0
    if gap_m:
        normal = next(c.normal for c in graph.contacts if c.a == "picture")
        assert normal == pytest.approx((0, 0, -1))


def test_a_shelf_hangs_on_the_wall_though_a_vase_stands_on_it() -> None:
    wall = on_floor("wall", (3, 3, 0.2), 0, 0)
    shelf, vase = box("shelf", (1, 0.03, 0.2), (0, 1.5, 0.212)), box("vase", CUP, (0, 1.565, 0.2))
    assert found(floor(), wall, shelf, vase) == {("floor", "wall"), ("shelf", "wall"), ("shelf", "vase")}


def test_a_lamp_hangs_from_the_ceiling() -> None:
    ceiling, lamp = box("ceiling", (4, 0.2, 4), (0, 2.6, 0)), box("lamp", (0.5, 0.5, 0.5), (0, 2.24, 0))
    graph = ContactGraph(scene(floor(), ceiling, lamp))
    assert {(c.a, c.b) for c in graph.contacts} == {("ceiling", "lamp")}
    assert graph.contacts[0].normal == pytest.approx((0, -1, 0))


@pytest.mark.parametrize("length_m", [0.1, 0.16, 0.25])
def test_a_handle_hangs_before_its_leaf(length_m: float) -> None:
    leaf = box("leaf", (0.6, 0.7, 0.018), (0, 0.5, 0))
    handle = box("handle", (0.012, length_m, 0.012), (0.25, 0.5, 0.009 + 0.016 + 0.006))
    assert weights_of(leaf, handle) == {("handle", "leaf"): 1.0}


@pytest.mark.parametrize(("edge_m", "hangs"), [(0.05, True), (0.03, False)])
def test_a_knob_hangs_before_its_leaf_if_it_is_no_farther_off_than_a_quarter_of_its_size(
    edge_m: float, hangs: bool
) -> None:
    leaf = box("leaf", (0.6, 0.7, 0.018), (0, 0.5, 0))
    knob = box("knob", (edge_m, edge_m, edge_m), (0.25, 0.5, 0.009 + 0.016 + edge_m / 2))
    assert (("knob", "leaf") in weights_of(leaf, knob)) == hangs


def test_an_object_farther_from_a_leaf_than_handles_does_not_hang_on_it() -> None:
    leaf = box("leaf", (0.6, 0.7, 0.018), (0, 0.5, 0))
    handle = box("handle", (0.012, 0.16, 0.012), (0.25, 0.5, 0.009 + 0.026 + 0.006))
    assert weights_of(leaf, handle) == {}


@pytest.mark.parametrize("gap_m", [0.001, 0.0046, 0.008])
def test_a_wall_cabinet_hangs_on_the_tall_one_beside_it_and_on_its_wall(gap_m: float) -> None:
    wall = on_floor("wall", (3, 3, 0.2), 0, 0)
    tall = on_floor("tall", (0.6, 2.1, 0.6), -0.6, 0.4)
    cabinet = box("cabinet", (0.6, 0.7, 0.35), (0, 1.75, 0.1 + gap_m + 0.175))
    weights = weights_of(floor(), wall, tall, cabinet)
    assert weights["cabinet", "tall"] == weights["cabinet", "wall"] == 1.0


def test_wall_cabinet_does_not_hang_on_objects_much_farther_than_its_wall() -> None:
    wall = on_floor("wall", (3, 3, 0.2), 0, 0)
    tall = on_floor("tall", (0.6, 2.1, 0.6), -0.62, 0.4)
    cabinet = box("cabinet", (0.6, 0.7, 0.35), (0, 1.75, 0.1 + 0.002 + 0.175))
    assert ("cabinet", "tall") not in weights_of(floor(), wall, tall, cabinet)


def test_an_object_standing_near_a_wall_does_not_hang_on_it() -> None:
    wall = on_floor("wall", (3, 3, 0.2), 0, 0)
    assert found(floor(), wall, on_floor("desk", (1, 0.7, 0.6), 0, 0.412)) == {("floor", "wall"), ("desk", "floor")}


def test_hanging_takes_over_as_support_fades() -> None:
    wall = on_floor("wall", (3, 3, 0.2), 0, 0)
    for gap_m in (0.05, 0.07, 0.08, 0.1):
        graph = ContactGraph(scene(floor(), wall, on_floor("desk", (1, 0.7, 0.6), 0, 0.412, gap_m)))
        assert weight(graph, "desk", "wall") == pytest.approx(1 - weight(graph, "desk", "floor"))


@pytest.mark.parametrize("x", [-0.4, -0.1, 0.1])
def test_a_picture_sunk_into_a_wall_does_not_stand_on_the_walls_triangles(x: float) -> None:
    # The slanted side of the wall's lower triangle passes just under the picture's bottom.
    wall, picture = on_floor("wall", (3, 3, 0.2), 0, 0), box("picture", (0.6, 0.4, 0.02), (x, 1.5, 0.108))
    graph = ContactGraph(scene(wall, picture))
    assert {c.normal for c in graph.contacts} == {None}


def test_floor_without_thickness_holds_slightly_sunk_objects() -> None:
    sheet = boxes("floor", ((6.0, 1e-9, 6.0), (0, 0, 0)))
    graph = ContactGraph(scene(sheet, chair((0, -0.001, 0))))
    assert weight(graph, "chair", "floor") == 1.0
    assert all(contact.normal == pytest.approx((0, -1, 0)) for contact in graph.contacts)
    assert len(graph.contacts) == 4


def test_up_may_be_z() -> None:
    turned = Pose((0, 0, 0), (0.5**0.5, 0, 0, 0.5**0.5))  # y to z
    upright = scene(floor(), chair((0, 0.02, 0)))
    objects = tuple(
        type(item)(item.id, item.name, turned.compose(item.pose), item.geometry, item.surface)
        for item in upright.objects
    )
    graph = ContactGraph(type(upright)("test", "z", objects))
    assert {(c.a, c.b) for c in graph.contacts} == {("chair", "floor")}
    assert graph.contacts[0].normal == pytest.approx((0, 0, -1))
    assert all(contact.point_m[2] == pytest.approx(0.01) for contact in graph.contacts)


@given(seed=st.integers(0, 10**6))
@settings(max_examples=60)
def test_first_falls_give_the_supports_of_all_triangles_unless_one_may_hide_another(seed: int) -> None:
    """Supports by first fall distances equal those by the fall distance of each triangle."""
    rng = np.random.default_rng(seed)
    n_known = 0
    for _ in range(40):
        n, m = int(rng.integers(1, 5)), int(rng.integers(1, 30))
        spread_m = float(rng.choice([0.0005, 0.003, 0.01, 0.09]))
        falls_m = np.where(rng.random((n, m)) < 0.5, rng.uniform(-0.004, spread_m, (n, m)), np.inf)
        falls_m = falls_m[np.isfinite(falls_m).any(axis=1)] + 0.01 * rng.integers(0, 2)
        each = {f"x{k}": row for k, row in enumerate(falls_m)}
        nearby = rule.supports_of_faces({name: float(row.min()) for name, row in each.items()}, 0.06)
        if nearby is not None:
            n_known += 1
            of_triangles = rule.supports(each, 0.06)
            assert nearby == {name: pytest.approx(support) for name, support in of_triangles.items()}
    assert n_known > 5
    assert rule.supports_of_faces({}, 0.06) == {}


@given(seed=st.integers(0, 10**6))
@settings(max_examples=60)
def test_the_part_of_a_support_that_bears_most_gives_its_weight(seed: int) -> None:
    """A triangle bears if its fall is short, hardly longer than the shortest, and not hidden by another object."""
    rng = np.random.default_rng(seed)
    n, m, reach_m = int(rng.integers(0, 5)), int(rng.integers(1, 40)), float(rng.choice([0.004, 0.09]))
    falls_m = rng.uniform(-0.004, 1.2 * reach_m + 0.001, (n, m)) if rng.random() < 0.7 else np.zeros((n, m))
    falls_m[rng.random((n, m)) < 0.4] = np.inf
    least = falls_m.min(initial=np.inf)
    expected = {}
    for name, row in zip("abcd", falls_m, strict=False):
        bearing = {}
        for fall, first in zip(row.tolist(), falls_m.min(axis=0).tolist(), strict=True):
            if fall < np.inf:
                share = rule.weight(fall, reach_m) * rule.weight(fall - least, 0.004) * rule.weight(fall - first, 0.002)
                bearing[fall] = max(share, bearing.get(fall, 0.0))
        bearing = {fall: share for fall, share in bearing.items() if share > 0}
        if bearing:
            expected[name] = pytest.approx((max(bearing.values()), min(bearing)))
    assert rule.supports(dict(zip("abcd", falls_m, strict=False)), reach_m) == expected
