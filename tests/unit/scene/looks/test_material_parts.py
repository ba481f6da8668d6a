"""Meshes that another tool has cut by material: the objects are those of the first file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from gltf_builder import CUBE, CUBE_FACES, Gltf
from scene2hap import load_scene
from scene2hap.scene.grouping.groups import group_objects
from scene2hap.scene.tree import AuthoredNode, Piece, transform


def node(name: str, *children: AuthoredNode, at: float = 0.0) -> AuthoredNode:
    return AuthoredNode(name, transform(np.eye(3), (at, 0, 0)), (), children)


def part(name: str, material: str, *, at: float = 0.0, vertices_at: float = 0.0) -> AuthoredNode:
    piece = Piece((name, material), CUBE + np.array([vertices_at, 0.0, 0.0]), CUBE_FACES.astype(np.int32), material)
    return replace(node(name, at=at), pieces=(piece,))


def objects(*roots: AuthoredNode) -> dict[str, int]:
    """The number of pieces of each object."""
    return {group.name: len(group.parts) for group in group_objects(roots)}


@pytest.mark.parametrize(
    "names",
    [
        ("washer_8b4d74", "washer_99b2ca", "washer_861325"),
        ("Mesh_washer", "Mesh_washer_1", "Mesh_washer_2"),
        ("Cube033", "Cube033_1", "Cube033_2"),
        ("washer_primitive0", "washer_primitive1", "washer_primitive2"),
    ],
)
def test_a_door_stays_part_of_a_mesh_that_was_cut_by_material(names: tuple[str, str, str]) -> None:
    cut = [part(name, material) for name, material in zip(names, ("steel", "glass", "rubber"), strict=True)]
    door = node("washerDoor", part("washerDoor_e7a75c", "steel"), part("washerDoor_c8dbd9", "glass"), at=0.5)
    assert objects(node("washing_machine", node("washer", *cut, door))) == {"washing_machine": 5}


def test_equal_materials_are_separate_things() -> None:
    shelf = node("shelf", part("jar", "glass"), part("jar_1", "glass", vertices_at=0.2))
    assert objects(shelf) == {"jar": 1, "jar_1": 1}


def test_frames_of_their_own_are_separate_things() -> None:
    assert objects(node("shelf", part("jar", "glass"), part("jar_1", "clay", at=0.2))) == {"jar": 1, "jar_1": 1}


def test_distant_meshes_of_another_name_are_separate_things() -> None:
    shelf = node("shelf", part("jar", "glass"), part("jar_1", "clay", vertices_at=5.0))
    assert objects(shelf) == {"jar": 1, "jar_1": 1}


def test_a_flat_in_one_frame_is_not_one_mesh() -> None:
    flat = node("flat of Anna", part("wall", "paint"), part("wall_1", "paper"), part("table", "oak"))
    assert objects(flat) == {"wall": 1, "wall_1": 1, "table": 1}


def test_a_place_is_a_container() -> None:
    assert objects(node("kitchen", part("wall", "paint"), part("wall_1", "paper"), part("table", "oak", at=0.1))) == {
        "wall": 1,
        "wall_1": 1,
        "table": 1,
    }


def test_trimesh_writes_a_cabinet_with_its_door_as_the_same_object(tmp_path: Path) -> None:
    made = Gltf()
    made.header["materials"] = [
        {"name": name, "pbrMetallicRoughness": {"baseColorFactor": colour}}
        for name, colour in {"oak": (0.6, 0.4, 0.2, 1), "glass": (0.1, 0.2, 0.9, 1)}.items()
    ]
    meshes = made.header["meshes"]
    for row in (made.cube(material=0), made.cube(material=0)):
        meshes[row]["primitives"].append({**meshes[row]["primitives"][0], "material": 1})
    door = made.node("door", mesh=1, translation=(0, 0, 1), scale=(1, 1, 0.1))
    made.node("cabinet", mesh=0, children=[door], root=True)
    first = made.write(tmp_path / "first.glb")
    trimesh.load(first).export(tmp_path / "again.glb")
    for path in (first, tmp_path / "again.glb"):
        (cabinet,) = load_scene(path).objects
        assert cabinet.name == "cabinet"
        assert sorted(cabinet.material_names) == ["glass", "oak"]
        np.testing.assert_allclose(cabinet.bounds_m, [(0, 0, 0), (1, 1, 1.1)], atol=1e-6)
