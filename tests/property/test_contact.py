"""Invariants of contacts for any motion: no dependence on history, direction or order of objects."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from contact_scenes import box, pairs, scene
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose

SIZES = {"floor": (2.0, 0.1, 2.0), "slab": (0.6, 0.02, 0.4), "crate": (0.3, 0.3, 0.3), "cup": (0.08, 0.1, 0.08)}
# Coarse steps, so that objects often touch, rest, hover and intersect.
PLACES = st.tuples(st.sampled_from([-0.4, 0.0, 0.3]), st.integers(0, 30), st.sampled_from([-0.3, 0.0, 0.4]))
TURNS = st.sampled_from([(0, 0, 0, 1), (0, 1, 0, 3), (1, 0, 0, 40), (0.5, 0.5, 0.5, 0.5), (1, 2, -1, 3)])


@st.composite
def poses(draw: st.DrawFn) -> Pose:
    x, level, z = draw(PLACES)
    rotation = draw(TURNS)
    return Pose((x, 0.013 * level, z), tuple(float(q) for q in rotation))


MOVES = st.dictionaries(st.sampled_from(sorted(SIZES)), poses(), min_size=1, max_size=2)
PATHS = st.lists(st.tuples(MOVES, st.sampled_from([None, "out", "in"])), min_size=1, max_size=2)


THINGS = {name: box(name, size, (0, 0, 0)) for name, size in SIZES.items()}


def things(places: dict[str, Pose]) -> list[SceneObject]:
    return [replace(THINGS[name], pose=pose) for name, pose in places.items()]


@given(st.fixed_dictionaries(dict.fromkeys(SIZES, poses())), PATHS, st.sampled_from([None, None, 0.0, 0.02]))
@settings(max_examples=200)
def test_incremental_updates_equal_a_new_graph(
    places: dict[str, Pose], path: list[tuple[dict[str, Pose], str | None]], tolerance_m: float | None
) -> None:
    graph = ContactGraph(scene(*things(places)), tolerance_m=tolerance_m)
    for moves, traffic in path:
        before = {pair: [c for c in graph.contacts if (c.a, c.b) == pair] for pair in pairs(graph)}
        added = things({"cup": Pose((0.0, 0.3, 0.0))}) if traffic == "in" and "cup" not in places else []
        removed = ["cup"] if traffic == "out" and "cup" in places else []
        moved = {name: pose for name, pose in moves.items() if name in places and name not in removed}
        change = graph.update(moved, added=added, removed=removed)

        places = {name: pose for name, pose in places.items() if name not in removed} | moved
        places |= {item.id: item.pose for item in added}
        fresh = ContactGraph(scene(*things(places)), tolerance_m=tolerance_m)
        assert graph.contacts == fresh.contacts
        assert graph.poses == places
        assert change.appeared == pairs(fresh) - before.keys()
        assert change.vanished == before.keys() - pairs(fresh)
        after = {pair: [c for c in fresh.contacts if (c.a, c.b) == pair] for pair in pairs(fresh) & before.keys()}
        assert change.shifted == {pair for pair in after if after[pair] != before[pair]}


GAPS = st.sampled_from([0.0, 0.0013, 0.0031, 0.0117, 0.033])


@st.composite
def stacks(draw: st.DrawFn) -> list[SceneObject]:
    """Stacked slabs, rotated about the vertical, with gaps like those of real scenes."""
    top, objects = 0.0, []
    for name, size in SIZES.items():
        turn = draw(st.sampled_from([0.0, 0.3, 1.1]))
        gap = draw(GAPS)
        middle = (draw(st.sampled_from([-0.03, 0.0, 0.02])), top + gap + size[1] / 2, 0.01)
        objects.append(box(name, size, middle, (0.0, np.sin(turn / 2), 0.0, np.cos(turn / 2))))
        top += gap + size[1]
    beside = objects[2].pose.compose(Pose((0.25 + draw(GAPS), 0.0, 0.0)))
    return [*objects, replace(box("radio", (0.2, 0.2, 0.1), (0, 0, 0)), pose=beside)]


def check_goes_along(objects: list[SceneObject], motion: Pose, tolerance_m: float | None) -> None:
    here = ContactGraph(scene(*objects), tolerance_m=tolerance_m)
    there = ContactGraph(
        scene(*(replace(item, pose=motion.compose(item.pose)) for item in objects)), tolerance_m=tolerance_m
    )
    assert [(c.a, c.b) for c in there.contacts] == [(c.a, c.b) for c in here.contacts]
    for one, other in zip(here.contacts, there.contacts, strict=True):
        assert motion.to_world([one.point_m])[0] == pytest.approx(other.point_m, abs=1e-9)
        assert one.weight == pytest.approx(other.weight, abs=1e-9)
        assert (one.normal is None) == (other.normal is None)
        if one.normal is not None:
            assert motion.rotation @ one.normal == pytest.approx(other.normal, abs=1e-6)


@given(stacks(), st.floats(-3, 3), st.tuples(*[st.floats(-5, 5)] * 3))
@settings(max_examples=40)
def test_contacts_are_invariant_under_upright_motion(
    objects: list[SceneObject], angle: float, shift: tuple[float, float, float]
) -> None:
    check_goes_along(objects, Pose(shift, (0.0, np.sin(angle / 2), 0.0, np.cos(angle / 2))), None)


@given(stacks(), st.tuples(*[st.integers(-5, 5)] * 4).filter(any), st.tuples(*[st.floats(-5, 5)] * 3))
@settings(max_examples=40)
def test_contacts_at_a_stated_tolerance_are_invariant_under_rigid_motion(
    objects: list[SceneObject], rotation: tuple[float, float, float, float], shift: tuple[float, float, float]
) -> None:
    check_goes_along(objects, Pose(shift, rotation), 0.005)


@given(stacks(), st.randoms(use_true_random=False))
@settings(max_examples=20)
def test_contacts_do_not_depend_on_object_order(objects: list[SceneObject], random: "object") -> None:
    shuffled = list(objects)
    random.shuffle(shuffled)
    assert ContactGraph(scene(*shuffled)).contacts == ContactGraph(scene(*objects)).contacts


@given(stacks(), st.sampled_from([None, 0.004, 0.02]))
@settings(max_examples=40)
def test_points_lie_between_the_two_surfaces(objects: list[SceneObject], tolerance_m: float | None) -> None:
    by_id = {item.id: item for item in objects}
    for contact in ContactGraph(scene(*objects), tolerance_m=tolerance_m).contacts:
        assert 0.0 < contact.weight <= 1.0
        for name in (contact.a, contact.b):
            half = np.asarray(by_id[name].geometry.size_m) / 2
            beyond = np.abs(by_id[name].pose.to_own([contact.point_m])[0]) - half
            # On the box, or off it by at most half of the fall reach of objects of this size.
            assert np.linalg.norm(np.maximum(beyond, 0.0)) <= 0.09 / 2 + 0.001
            assert beyond.max() >= -0.001
