"""Contact patches of long objects whose poses tremble, as those of trackers and physics engines do."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from contact_scenes import box, boxes, points, scene
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose

Floats = NDArray[np.float64]

WALL = box("wall", (8.0, 3.0, 0.2), (0.0, 1.5, -0.1))
FLOOR = box("floor", (10.0, 0.1, 10.0), (0.0, -0.05, 0.0))


def table(length_m: float, short_m: float = 0.0) -> SceneObject:
    """Four legs at the corners of a top; one is shorter."""
    x, z = length_m / 2 - 0.05, 0.4
    legs = [((0.06, 0.7, 0.06), (u, 0.35, v)) for u, v in ((-x, -z), (-x, z), (x, -z))]
    legs.append(((0.06, 0.7 - short_m, 0.06), (x, 0.35 + short_m / 2, z)))
    return boxes("mover", *legs, ((length_m, 0.03, 0.9), (0.0, 0.715, 0.0)))


def beam(length_m: float, y: float, z: float) -> SceneObject:
    return box("mover", (length_m, 0.04, 0.03), (0.0, y, z))


BANKS = boxes("banks", *(((2.0, 1.0, 2.0), (x, -0.5, 0.0)) for x in (-2.0, 2.0)), ((6.0, 0.2, 2.0), (0.0, -1.1, 0.0)))
ROD = boxes(
    "mover",
    ((3.0, 0.03, 0.03), (0.0, 0.0, 0.095)),
    *(((0.05, 0.05, 0.08), (x, 0.0, 0.04)) for x in (-1.45, 1.45)),
    at_m=(0.0, 2.0, 0.001),
)
LONG = [
    pytest.param([WALL, beam(6.0, 1.5, 0.02)], "wall", id="rail 5 mm off a wall"),
    pytest.param([WALL, beam(6.0, 1.5, 0.015)], "wall", id="rail at a wall"),
    pytest.param([WALL, ROD], "wall", id="curtain rod"),
    pytest.param([FLOOR, table(5.0)], "floor", id="table of 5 m"),
    pytest.param([FLOOR, table(1.2, short_m=0.0005)], "floor", id="table with a short leg"),
    pytest.param([BANKS, box("mover", (4.0, 0.04, 0.3), (0.0, 0.02, 0.0))], "banks", id="plank across a gap"),
    pytest.param(
        [FLOOR, box("lower", (5.0, 0.05, 0.2), (0.0, 0.025, 0.0)), box("mover", (5.0, 0.05, 0.2), (0.0, 0.075, 0.0))],
        "lower",
        id="equal planks on each other",
    ),
    pytest.param(
        [box("floor", (6.0, 0.1, 6.0), (0.0, -0.05, 0.0)), box("mover", (0.1, 2.5, 6.0), (3.05, 1.25, 0.0))],
        "floor",
        id="wall along the edge of a floor",
    ),
]


def tilted(item: SceneObject, turn: Floats, move_m: Floats) -> SceneObject:
    """The object rotated by a rotation vector [rad] about the middle of its box, and moved."""
    rotation, middle = Rotation.from_rotvec(turn), np.mean(item.bounds_m, axis=0)
    at = rotation.apply(np.array(item.pose.position_m) - middle) + middle + move_m
    turned = (rotation * Rotation.from_quat(item.pose.rotation_xyzw)).as_quat()
    return replace(item, pose=Pose(tuple(at.tolist()), tuple(turned.tolist())))


def patch(objects: list[SceneObject], other: str, turn: Floats, move_m: Floats) -> Floats:
    """The contact points (n, 3) of the mover and another object, once the mover is tilted."""
    placed = [tilted(item, turn, move_m) if item.id == "mover" else item for item in objects]
    return points(ContactGraph(scene(*placed)), *sorted((other, "mover")))


@pytest.mark.parametrize(("objects", "other"), LONG)
def test_a_trembling_object_keeps_all_ends_of_its_patch(objects: list[SceneObject], other: str) -> None:
    """Each place of the patch at rest, up to the corners of one foot of 60 mm, stays in contact, and no other joins."""
    still = patch(objects, other, np.zeros(3), np.zeros(3))
    rng = np.random.default_rng(1)
    for _ in range(40):
        trembling = patch(objects, other, rng.uniform(-4e-4, 4e-4, 3), rng.uniform(-1e-4, 1e-4, 3))
        apart = np.linalg.norm(still[:, None] - trembling[None], axis=2)
        assert apart.min(axis=1).max() < 0.09
        assert apart.min(axis=0).max() < 0.09


@pytest.mark.parametrize(
    ("objects", "other", "axis", "lift_m"),
    [
        pytest.param([WALL, beam(6.0, 1.5, 0.02)], "wall", (0.0, 1.0, 0.0), 0.005, id="rail"),
        # Its patch ends at the gap's far edge, at three quarters of its length.
        pytest.param(
            [BANKS, box("mover", (4.0, 0.04, 0.3), (0.0, 0.02, 0.0))], "banks", (0.0, 0.0, 1.0), 0.007, id="plank"
        ),
    ],
)
def test_an_end_that_lifts_is_lost(
    objects: list[SceneObject], other: str, axis: tuple[float, float, float], lift_m: float
) -> None:
    """Surfaces more than 4 mm farther apart than the nearest ones do not touch, however long the object is."""
    length_m = float(np.ptp(objects[1].bounds_m, axis=0)[0])
    still = patch(objects, other, np.zeros(3), np.zeros(3))[:, 0]
    tilted_x = patch(objects, other, lift_m / length_m * np.array(axis), np.zeros(3))[:, 0]
    assert still.min() < -0.9
    assert still.max() > 0.9
    assert (tilted_x < 0).all() or (tilted_x > 0).all()
