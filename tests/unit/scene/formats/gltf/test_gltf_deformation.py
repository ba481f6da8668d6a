"""Skins and morph targets of glTF: a mesh has the shape and place that a viewer shows before animations play."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_builder import CUBE, Gltf
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene.load import load_scene


def box_of(gltf: Gltf, folder: Path, name: str = "body") -> list[list[float]]:
    """The lowest and the highest corner of an object in the world."""
    item = load_scene(gltf.write(folder / "scene.glb"), unit_m=1.0).object(name)
    points = item.pose.to_world(item.geometry.mesh.vertices_m)
    return [np.round(points.min(axis=0), 6).tolist(), np.round(points.max(axis=0), 6).tolist()]


def skinned(joints: Any = ((0, 0, 0, 0),) * 8, weights: Any = ((1, 0, 0, 0),) * 8, **node: Any) -> Gltf:
    """A cube of 100 cm on a rig in centimetres at x = 2 m, as FBX converters write it; the joint `hips` is 50 cm up."""
    gltf = Gltf()
    mesh = gltf.cube()
    row = gltf.header["meshes"][mesh]["primitives"][0]
    row["attributes"]["POSITION"] = gltf.accessor(100 * CUBE, "f4", "VEC3")
    row["attributes"]["JOINTS_0"] = gltf.accessor(joints, "u1", "VEC4")
    row["attributes"]["WEIGHTS_0"] = gltf.accessor(weights, "f4", "VEC4")
    head = gltf.node("head", translation=[0, 50, 0])
    hips = gltf.node("hips", translation=[0, 50, 0], children=[head])
    gltf.node("rig", scale=[0.01] * 3, translation=[2, 0, 0], children=[hips], root=True)
    bound = np.tile(np.eye(4), (2, 1, 1))
    bound[:, 1, 3] = -50, -100
    matrices = gltf.accessor(bound.transpose(0, 2, 1).reshape(2, 16), "f4", "MAT4")
    gltf.header["skins"] = [{"joints": [hips, head], "inverseBindMatrices": matrices}]
    gltf.node("body", mesh=mesh, skin=0, root=True, **node)
    return gltf


def test_a_skinned_mesh_is_where_its_joints_place_it(tmp_path: Path) -> None:
    assert box_of(skinned(), tmp_path) == [[2, 0, 0], [3, 1, 1]]


def test_the_transform_of_a_skinned_node_does_not_count(tmp_path: Path) -> None:
    moved = skinned(translation=[7, 8, 9], rotation=[0, 0.6, 0, 0.8], scale=[3, 3, 3])
    assert box_of(moved, tmp_path) == [[2, 0, 0], [3, 1, 1]]


def test_joints_that_were_moved_since_bend_the_mesh(tmp_path: Path) -> None:
    upper = [(1, 0, 0, 0) if corner[1] else (0, 0, 0, 0) for corner in CUBE]
    gltf = skinned(upper)
    gltf.header["nodes"][0]["translation"] = [0, 150, 0]
    assert box_of(gltf, tmp_path) == [[2, 0, 0], [3, 2, 1]]
    # Half of each joint, in weights that do not sum to one.
    half = skinned(((0, 1, 0, 0),) * 8, ((0.25, 0.25, 0, 0),) * 8)
    half.header["nodes"][0]["translation"] = [0, 150, 0]
    assert box_of(half, tmp_path) == [[2, 0.5, 0], [3, 1.5, 1]]


def test_joints_without_inverse_bind_matrices_move_positions_as_they_are(tmp_path: Path) -> None:
    gltf = skinned()
    del gltf.header["skins"][0]["inverseBindMatrices"]
    assert box_of(gltf, tmp_path) == [[2, 0.5, 0], [3, 1.5, 1]]


@pytest.mark.parametrize("where", ["mesh", "node"])
def test_morph_targets_have_their_stored_weights(tmp_path: Path, where: str) -> None:
    gltf = Gltf()
    mesh = gltf.cube(targets=[{"POSITION": gltf.accessor(CUBE * [1, 0, 0], "f4", "VEC3")}, {}])
    gltf.header["meshes"][mesh]["weights"] = [0.5, 1] if where == "mesh" else [0, 0]
    own: dict[str, Any] = {} if where == "mesh" else {"weights": [0.5, 0]}
    gltf.node("body", mesh=mesh, root=True, **own)
    gltf.node("plain", mesh=mesh, weights=[0, 0], root=True)
    assert box_of(gltf, tmp_path) == [[0, 0, 0], [1.5, 1, 1]]
    assert box_of(gltf, tmp_path, "plain") == [[0, 0, 0], [1, 1, 1]]


@pytest.mark.parametrize(
    ("table", "change", "sentence"),
    [
        ("nodes", {"skin": 3}, r"node 'body' refers to skins\[3\]; the file has 1"),
        ("nodes", {"weights": ["x"]}, "weights"),
        ("skins", {"joints": []}, r"skins\[0\].joints must be a list"),
        ("skins", {"joints": [99]}, r"nodes\[99\]"),
        ("skins", {"joints": [0]}, r"uses joint 1 of its skin; there are 1"),
        ("skins", {"joints": [0, 1, 2, 0]}, "2 inverse bind matrices for 4 joints"),
        ("skins", {"inverseBindMatrices": 0}, "MAT4"),
    ],
)
def test_broken_skins_are_refused(tmp_path: Path, table: str, change: dict[str, Any], sentence: str) -> None:
    gltf = skinned(((1, 0, 0, 0),) * 8)
    gltf.header[table][-1] |= change
    with pytest.raises(SceneFormatError, match=sentence):
        load_scene(gltf.write(tmp_path / "scene.glb"))


def test_joints_that_hang_below_themselves_are_refused(tmp_path: Path) -> None:
    gltf = skinned()
    gltf.header["nodes"][0]["children"] = [1]
    with pytest.raises(SceneError):
        load_scene(gltf.write(tmp_path / "scene.glb"))
