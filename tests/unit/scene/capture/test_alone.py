"""Isolated pictures are equal for equal objects at any place and with any neighbours."""

import math

import numpy as np
import pytest
import trimesh

from scene2hap import Box, Pose, SceneObject, SceneSnapshot, TriMesh, capture_images
from scene2hap.scene.capture import render_all

pytest.importorskip("embreex", reason="needs the extra 'pictures'")

SMALL = {"size_px": 48}


def lamp(object_id: str, pose: Pose) -> SceneObject:
    cone = trimesh.creation.cone(0.2, 0.5)
    # A mesh without symmetry.
    vertices = np.asarray(cone.vertices) @ np.array([[1.0, 0.2, 0.3], [0.0, 1.5, 0.4], [0.0, 0.0, 1.0]])
    mesh = TriMesh(vertices, np.asarray(cone.faces, np.int32))
    return SceneObject(object_id, pose=pose, geometry=mesh)


def isolated(*items: SceneObject, alone: bool = True) -> list[tuple[bytes, ...]]:
    scene = capture_images(SceneSnapshot.build(items, name="room"), config=SMALL, alone=alone)
    return [tuple(item.images.isolated) for item in scene.objects if item.images is not None]


def test_isolated_pictures_do_not_depend_on_place_or_neighbours() -> None:
    turned = Pose.from_yaw((3.0, 1.0, -2.0), math.radians(77.0))
    (here,) = isolated(lamp("a", Pose()))
    elsewhere, _ = isolated(lamp("b", turned), SceneObject("box", pose=Pose((0, 5, 0)), geometry=Box((1, 1, 1))))
    assert here == elsewhere
    assert here != isolated(lamp("b", turned), alone=False)[0]


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])
@pytest.mark.parametrize("degrees", [90.0, 180.0, 30.0])
def test_isolated_pictures_show_a_lying_object_as_lying(axis: tuple[float, float, float], degrees: float) -> None:
    half = math.radians(degrees) / 2
    x, y, z = (math.sin(half) * part for part in axis)
    lies = Pose((0.0, 0.0, 0.0), (x, y, z, math.cos(half)))
    yaw = Pose.from_yaw((1.0, 2.0, 3.0), 1.1)
    (upright,), (lying,), (lying_elsewhere,) = (isolated(lamp("a", pose)) for pose in (Pose(), lies, yaw.compose(lies)))
    assert lying == lying_elsewhere
    assert lying != upright


def test_alone_mode_takes_no_context_pictures() -> None:
    items = (lamp("a", Pose()), lamp("b", Pose((2.0, 0.0, 0.0))))
    scene = capture_images(SceneSnapshot.build(items, name="room"), config=SMALL, alone=True)
    counted: list[tuple[int, int]] = []
    render_all(scene, progress=lambda done, total: counted.append((done, total)))
    assert counted[-1][0] == counted[-1][1] == 4 + 8 + 8
    for item in scene.objects:
        assert item.images is not None
        assert (len(item.images.isolated), len(item.images.context)) == (8, 0)
        assert len(item.images.together) == 8
