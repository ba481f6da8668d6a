"""Changes of a scene that describe the same things in another way must not change the gains."""

from __future__ import annotations

import random
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from same_scene import ALIKE, Same, in_another_frame
from scene2hap import HapticBundle, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, TriMesh
from scene2hap.scene.shapes import Box
from scenes import RATE, haptics, tone_loop

THINGS = {"floor": "concrete", "wall_back": "oak", "wall_left": "oak", "table": "oak", "shelf": "steel"}
THINGS |= {"phone": "glass", "radio": "pom"}


def room(rng: random.Random) -> list[SceneObject]:
    """A floor with two walls that meet at right angles, a table on legs, a shelf on a wall, and two sources."""
    x, y, z, leg = rng.uniform(0.8, 1.6), rng.uniform(0.4, 0.8), rng.uniform(0.5, 0.8), rng.uniform(0.03, 0.07)
    u, v = x / 2 - leg, z / 2 - leg
    legs = [((leg, y - 0.015, leg), (a, (y - 0.015) / 2, b)) for a in (-u, u) for b in (-v, v)]
    table = _joined(((x, 0.03, z), (0, y, 0)), *legs)
    turn, top = rng.uniform(-0.5, 0.5), y + 0.015
    at = Pose.from_yaw((0.0, 0.0, 0.0), turn)
    phone = at.to_world([[rng.uniform(-0.3, 0.3), top + 0.005, rng.uniform(-0.15, 0.15)]])[0]
    places: dict[str, tuple[Box | TriMesh, Pose]] = {
        "floor": (Box((4.0, 0.1, 3.0)), Pose((0.0, -0.05, 0.0))),
        "wall_back": (Box((4.0, 2.4, 0.1)), Pose((0.0, 1.2, -1.5))),
        "wall_left": (Box((0.1, 2.4, 2.95)), Pose((-2.0, 1.2, 0.025))),
        "table": (table, at),
        "shelf": (Box((0.6, 0.02, 0.25)), Pose((rng.uniform(-1.0, 1.0), 1.3, -1.325))),
        "phone": (Box((0.07, 0.01, 0.15)), Pose.from_yaw(phone.tolist(), rng.uniform(-3.0, 3.0))),
        "radio": (Box((0.3, 0.2, 0.15)), Pose((1.4, 0.1, rng.uniform(0.5, 1.0)))),
    }
    return [SceneObject(name, pose=pose, geometry=shape.mesh) for name, (shape, pose) in places.items()]


def _joined(*parts: tuple[tuple[float, float, float], tuple[float, float, float]]) -> TriMesh:
    meshes = [(Box(size).mesh, np.array(at)) for size, at in parts]
    faces = [mesh.faces + 8 * k for k, (mesh, _) in enumerate(meshes)]
    return TriMesh(np.concatenate([mesh.vertices_m + at for mesh, at in meshes]), np.concatenate(faces))


def gains(same: Same, model: str, touched: list[tuple[str, np.ndarray]]) -> np.ndarray:
    """Gains (n_touches, n_sources) of all touches, with the sources in the order of their first ids."""
    scene = SceneSnapshot.build(same.objects, up_axis=same.up_axis)
    materials = {same.ids(name): material for name, material in THINGS.items()}
    sources = {"phone": 120.0, "radio": 60.0}
    states = {same.ids(name): ["on"] for name in sources}
    inferred = {item.id: haptics(materials[item.id], item.size_m, *states.get(item.id, [])) for item in scene.objects}
    loops = {same.ids(name): {"on": tone_loop(hertz)} for name, hertz in sources.items()}
    config = {
        "propagation": {"kind": model, "outside_domain": "ignore"},
        "prepare": "blocking",
        "gain_limit_db": None,
        "sample_rate_hz": RATE,
    }
    session = HapticSession(scene, HapticBundle(scene, "room", inferred, loops), config)
    session.update()
    points = [Touch("left", same.ids(name), same.motion.to_world([at])[0]) for name, at in touched]
    columns = [session.source_ids.index(same.ids(name)) for name in sources]
    return session.would_feel(points)[:, columns, 0]


CASES = [
    *((one, model) for model in ("exponential_plate", "infinite_plate", "modal_plate") for one in ALIKE),
    # Where plates intersect at right angles, the coupled models depend on their frames (docs/physical-models.md).
    (in_another_frame, "exponential_plate"),
]


@pytest.mark.parametrize(("change", "model"), CASES, ids=lambda one: getattr(one, "__name__", one))
@settings(max_examples=2)
@given(st.integers(0, 2**32 - 1))
def test_the_same_scene_in_other_words_has_the_same_gains(
    change: Callable[[list[SceneObject], random.Random], Same], model: str, seed: int
) -> None:
    rng = random.Random(seed)
    objects = room(rng)
    touched = []
    for item in objects:
        corners = item.geometry.mesh.vertices_m[item.geometry.mesh.faces[rng.randrange(12)]]
        touched.append((item.id, item.pose.to_world(corners).mean(axis=0)))
    expected = gains(Same(objects), model, touched)
    found = gains(change(objects, rng), model, touched)
    np.testing.assert_allclose(found, expected, rtol=2e-3, atol=5e-6)
    assert (expected[[item.id == "table" for item in objects]] > 0).all()
