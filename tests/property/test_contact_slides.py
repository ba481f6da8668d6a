"""Incremental contact updates of sliding objects equal a new graph after every step."""

from dataclasses import replace

import numpy as np
from hypothesis import given, settings, strategies as st

from contact_scenes import box, boxes, chair, house, pairs, scene, thing
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import TriMesh


def mug(at_m: tuple[float, float, float]) -> SceneObject:
    """An upright prism of 12 sides, 0.1 m wide and high, with its centre at `at_m`."""
    angle = 2 * np.pi * np.arange(12) / 12
    ring = 0.05 * np.stack([np.cos(angle), np.full(12, -1.0), np.sin(angle)], axis=1)
    i, j = np.arange(12), (np.arange(12) + 1) % 12
    k = np.arange(1, 11)
    fan = np.stack([np.zeros_like(k), k, k + 1], 1)
    faces = np.concatenate([np.stack([i, i + 12, j], 1), np.stack([j, i + 12, j + 12], 1), fan, fan + 12])
    return thing("mug", TriMesh(np.concatenate([ring, ring * [1, -1, 1]]), faces), Pose(at_m))


THINGS = [
    box("floor", (3.0, 0.1, 3.0), (0.0, -0.05, 0.0)),
    box("slab", (0.5, 0.04, 0.4), (0.0, 0.02, 0.0)),
    box("book", (0.2, 0.03, 0.15), (0.1, 0.055, 0.05)),
    box("crate", (0.1, 0.1, 0.1), (-0.12, 0.09, 0.0)),
    mug((0.6, 0.05, 0.0)),
    chair((-0.9, 0.0, 0.3)),
]
NAMES = [item.id for item in THINGS if item.id != "floor"]
# A room of one mesh, with objects on its floor, its podium and its board, near its walls and in the air; a rotated
# shelf with a pot between its boards, and a leaning stick.
INSIDE = [
    house(),
    replace(chair((-0.2, 0.0, 0.9)), id="chair"),
    box("crate", (0.2, 0.2, 0.2), (-1.1, 0.225, -1.1)),
    mug((1.2, 0.95, 0.1)),
    boxes("shelf", *(((0.6, 0.02, 0.3), (0.0, h, 0.0)) for h in (0.01, 0.4, 0.8)), at_m=(0.3, 0.002, -1.0)),
    box("pot", (0.12, 0.1, 0.12), (0.3, 0.465, -1.0)),
    # A frame without a bottom, which moves with and without the wool inside it.
    boxes("pen", *(((0.02, 0.2, 0.8), (x, 0.1, 0.0)) for x in (-0.4, 0.4)), at_m=(1.0, 0.0, -0.9)),
    box("wool", (0.1, 0.1, 0.1), (1.0, 0.05, -0.9)),
    box("stick", (0.02, 0.5, 0.02), (0.2, 0.26, 0.2), (0.05, 0.0, 0.02, 1.0)),
]
INSIDE[4] = replace(INSIDE[4], pose=Pose(INSIDE[4].pose.position_m, (0.0, np.sin(0.2), 0.0, np.cos(0.2))))
NAMES_INSIDE = [item.id for item in INSIDE if item.id != "house"]
# Blocks with gaps from a few millimetres to centimetres.
CROWD = [
    box("table", (1.0, 0.7, 0.8), (0.0, 0.35, 0.0)),
    *(
        box(f"block {i}", size, (x, 0.7 + size[1] / 2, z), (0.0, np.sin(turn / 2), 0.0, np.cos(turn / 2)))
        for i, (size, x, z, turn) in enumerate(
            [
                ((0.1, 0.1, 0.1), -0.15, 0.0, 0.0),
                ((0.12, 0.004, 0.1), -0.035, 0.0, 0.0),
                ((0.1, 0.25, 0.1), 0.08, 0.005, 0.0),
                ((0.3, 0.05, 0.08), 0.0, 0.1, 0.0),
                ((0.1, 0.1, 0.06), -0.1, -0.1, 0.2),
                ((0.1, 0.1, 0.06), 0.02, -0.1, 0.2),
            ]
        )
    ),
]
# Some steps stay within the margin of neighbour lists and some do not; heights are within and beyond every reach.
STEPS = st.tuples(
    st.sampled_from([-0.07, -0.01, 0.0, 0.004, 0.05]),
    st.sampled_from([0.0, 0.0, 0.0, 0.0, 0.002, -0.002, 0.03, 0.2]),
    st.sampled_from([-0.05, 0.0, 0.003, 0.06]),
    st.sampled_from([0.0, 0.0, 0.01, 0.3]),
)


def paths(names: list[str]) -> st.SearchStrategy[list[dict[str, tuple[float, float, float, float]]]]:
    return st.lists(st.dictionaries(st.sampled_from(names), STEPS, min_size=1, max_size=3), min_size=1, max_size=4)


PATHS = st.tuples(st.just(THINGS), paths(NAMES)) | st.tuples(st.just(INSIDE), paths(NAMES_INSIDE))
PATHS |= st.tuples(st.just(CROWD), paths([item.id for item in CROWD]))


def stepped(item: SceneObject, step: tuple[float, float, float, float]) -> SceneObject:
    x, y, z = item.pose.position_m
    dx, dy, dz, turn = step
    spin = Pose((0, 0, 0), (0.0, np.sin(turn / 2), 0.0, np.cos(turn / 2)))
    turned = spin.compose(Pose((0, 0, 0), item.pose.rotation_xyzw)).rotation_xyzw
    return replace(item, pose=Pose((x + dx, y + dy, z + dz), turned))


@given(PATHS)
@settings(max_examples=350)
def test_incremental_updates_of_a_slide_equal_a_new_graph(
    scene_and_path: tuple[list[SceneObject], list[dict[str, tuple[float, float, float, float]]]],
) -> None:
    items, path = scene_and_path
    things = {item.id: item for item in items}
    graph = ContactGraph(scene(*things.values()))
    for steps in path:
        before = set(graph.junctions)
        things |= {name: stepped(things[name], step) for name, step in steps.items()}
        change = graph.update({name: things[name].pose for name in steps})
        fresh = ContactGraph(scene(*things.values()))
        assert graph.contacts == fresh.contacts
        assert change.appeared == pairs(fresh) - before
        assert change.vanished == before - pairs(fresh)


@given(st.integers(0, 10**6), st.sampled_from([THINGS, INSIDE, CROWD]))
@settings(max_examples=8)
def test_incremental_updates_of_small_steps_equal_a_new_graph(seed: int, items: list[SceneObject]) -> None:
    """Frames of a game: moves of some millimetres, some rotations, and sometimes an object is lifted or put down."""
    rng = np.random.default_rng(seed)
    things = {item.id: item for item in items}
    names = [item.id for item in items if item.id not in ("floor", "house", "table")]
    graph = ContactGraph(scene(*things.values()))
    lifted = dict.fromkeys(names, 0.0)
    for _ in range(40):
        moved = rng.choice(names, rng.integers(1, 4), replace=False).tolist()
        for name in moved:
            x, z = rng.normal(scale=0.006, size=2).tolist()
            lift = rng.choice([0.0, 0.2, 0.0012]) - lifted[name] if rng.random() < 0.15 else 0.0
            lifted[name] += lift
            things[name] = stepped(things[name], (x, float(lift), z, 0.02 if rng.random() < 0.4 else 0.0))
        graph.update({name: things[name].pose for name in moved})
        assert graph.contacts == ContactGraph(scene(*things.values())).contacts
