"""Things that slide, step by step: the short ways that the graph takes end where building from nothing does."""

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_scenes import box, chair, pairs, scene, thing
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneObject, TriMesh


def mug(at_m: tuple[float, float, float]) -> SceneObject:
    """An upright prism of 12 sides, 0.1 m wide and high, its middle at `at_m`."""
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
# Some steps stay within what neighbour lists allow for and some do not; heights within and beyond every reach.
STEPS = st.tuples(
    st.sampled_from([-0.07, -0.01, 0.0, 0.004, 0.05]),
    st.sampled_from([0.0, 0.0, 0.0, 0.0, 0.002, -0.002, 0.03, 0.2]),
    st.sampled_from([-0.05, 0.0, 0.003, 0.06]),
    st.sampled_from([0.0, 0.0, 0.01, 0.3]),
)
PATHS = st.lists(st.dictionaries(st.sampled_from(NAMES), STEPS, min_size=1, max_size=3), min_size=1, max_size=4)


def stepped(item: SceneObject, step: tuple[float, float, float, float]) -> SceneObject:
    x, y, z = item.pose.position_m
    dx, dy, dz, turn = step
    spin = Pose((0, 0, 0), (0.0, np.sin(turn / 2), 0.0, np.cos(turn / 2)))
    turned = spin.compose(Pose((0, 0, 0), item.pose.rotation_xyzw)).rotation_xyzw
    return replace(item, pose=Pose((x + dx, y + dy, z + dz), turned))


@given(PATHS)
@settings(derandomize=True, deadline=None, max_examples=120)
def test_every_step_of_a_slide_ends_where_building_from_nothing_does(
    path: list[dict[str, tuple[float, float, float, float]]],
) -> None:
    things = {item.id: item for item in THINGS}
    graph = ContactGraph(scene(*things.values()))
    for steps in path:
        before = set(graph.junctions)
        things |= {name: stepped(things[name], step) for name, step in steps.items()}
        change = graph.update({name: things[name].pose for name in steps})
        fresh = ContactGraph(scene(*things.values()))
        assert graph.contacts == fresh.contacts
        assert change.appeared == pairs(fresh) - before
        assert change.vanished == before - pairs(fresh)


@given(st.integers(0, 10**6))
@settings(derandomize=True, deadline=None, max_examples=4)
def test_small_steps_in_a_row_end_where_building_from_nothing_does(seed: int) -> None:
    """A game's frames: some millimetres each, some things turning, one lifted and put down again now and then."""
    rng = np.random.default_rng(seed)
    things = {item.id: item for item in THINGS}
    graph = ContactGraph(scene(*things.values()))
    lifted = dict.fromkeys(NAMES, 0.0)
    for _ in range(40):
        moved = rng.choice(NAMES, rng.integers(1, 4), replace=False).tolist()
        for name in moved:
            x, z = rng.normal(scale=0.006, size=2).tolist()
            lift = rng.choice([0.0, 0.2, 0.0012]) - lifted[name] if rng.random() < 0.15 else 0.0
            lifted[name] += lift
            things[name] = stepped(things[name], (x, float(lift), z, 0.02 if rng.random() < 0.4 else 0.0))
        graph.update({name: things[name].pose for name in moved})
        assert graph.contacts == ContactGraph(scene(*things.values())).contacts
