"""Loose parts: a mesh in which several things were merged becomes an object for each connected surface."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gltf_builder import CUBE, CUBE_FACES
from scene2hap import bake, load_scene
from scene2hap.common.warning import SceneWarning
from scene2hap.errors import SceneError
from scene2hap.scene import limits
from scene2hap.scene.grouping.groups import group_objects
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scene2hap.scene.tree import AuthoredNode, Piece

N = len(CUBE_FACES)
RED, BLUE = FaceMaterial((1, 0, 0, 1), name="red"), FaceMaterial((0, 0, 1, 1), name="blue")


def cubes(*at: float, key: str = "cubes", by_corner: bool = False) -> Piece:
    """Unit cubes in one mesh; `by_corner` stores a vertex for each corner of a face, as files with normals do."""
    points = np.concatenate([CUBE + np.array([x, 0.0, 0.0]) for x in at])
    faces = np.concatenate([CUBE_FACES + len(CUBE) * k for k in range(len(at))])
    if by_corner:
        points, faces = points[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)
    colors = np.repeat(np.arange(len(at)) % 2, N).astype(np.int32)
    uv = np.arange(6 * len(faces), dtype=np.float32).reshape(-1, 3, 2)
    return Piece(key, points, faces.astype(np.int32), "tile", Appearance((RED, BLUE), colors, uv))


def parts(*pieces: Piece) -> list[tuple[Piece, ...]]:
    found = group_objects([AuthoredNode("Bathroom", np.eye(4), pieces)], "loose")
    assert {item.name for item in found} == {"Bathroom"}
    return [tuple(piece for _, piece in item.parts) for item in found]


@pytest.mark.parametrize("by_corner", [False, True])
def test_each_connected_surface_is_an_object_with_its_faces_and_looks(by_corner: bool) -> None:
    whole = cubes(0.0, 5.0, 9.0, by_corner=by_corner)
    found = parts(whole)
    assert [float(part[0].vertices[:, 0].min()) for part in found] == pytest.approx(
        [x + CUBE[:, 0].min() for x in (0, 5, 9)]
    )
    for k, (part,) in enumerate(found):
        np.testing.assert_array_equal(part.vertices[part.faces], whole.vertices[whole.faces[k * N : (k + 1) * N]])
        assert part.appearance is not None
        assert [material.name for material in part.appearance.materials] == [("red", "blue")[k % 2]]
        assert whole.appearance is not None
        np.testing.assert_array_equal(part.appearance.uv, whole.appearance.uv[k * N : (k + 1) * N])
    assert len({part[0].key for part in found}) == 3


def test_pieces_of_other_materials_that_meet_are_one_part() -> None:
    assert [len(part) for part in parts(cubes(0.0), cubes(1.0, 5.0, key="other"))] == [2, 1]


def test_parts_are_in_the_order_of_their_faces() -> None:
    whole = cubes(0.0, 5.0, 9.0)
    found = parts(replace(whole, faces=np.roll(whole.faces, N, axis=0)))
    assert [float(part[0].vertices[:, 0].min()) for part in found] == pytest.approx(
        [x + CUBE[:, 0].min() for x in (9, 0, 5)]
    )


def test_corners_that_differ_by_the_rounding_of_float32_are_one_place() -> None:
    apart = cubes(0.0, 7.0, by_corner=True)
    off = np.random.default_rng(1).uniform(-2e-7, 2e-7, apart.vertices.shape)
    assert len(parts(replace(apart, vertices=apart.vertices + off))) == 2


def test_a_connected_mesh_stays_as_it_is() -> None:
    piece = cubes(0.0)
    assert parts(piece) == [(piece,)]


@pytest.mark.parametrize(("at", "mass_kg"), [((0.0,), 5.0), ((0.0, 7.0), None)])
def test_only_a_mesh_of_one_part_keeps_its_mass(at: tuple[float, ...], mass_kg: float | None) -> None:
    node = AuthoredNode("Bathroom", np.eye(4), (cubes(*at),), mass_kg=5.0)
    assert {item.mass_kg for item in group_objects([node], "loose")} == {mass_kg}


def test_more_parts_than_a_scene_may_have_objects_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MAX_OBJECTS", 4)
    with pytest.raises(SceneError, match="loose parts of 'Bathroom' is 5"):
        parts(cubes(*(3.0 * k for k in range(5))))


def merged(path: Path, n: int) -> Path:
    """Write a room of cubes as one object."""
    lines = [f"v {x + 3 * k} {y} {z}" for k in range(n) for x, y, z in CUBE]
    faces = [
        f"f {' '.join(str(corner + 1 + len(CUBE) * k) for corner in face)}" for k in range(n) for face in CUBE_FACES
    ]
    path.write_text("\n".join([*lines, "o Bathroom", *faces]), encoding="utf-8")
    return path


def test_a_merged_room_is_found_and_its_remedy_helps(tmp_path: Path) -> None:
    scene = load_scene(merged(tmp_path / "bathroom.obj", 3))
    (found,) = (each for each in scene.check() if each.kind == "merged")
    assert found.object_ids == ("Bathroom",)
    assert "of 3 loose parts" in str(found)
    with pytest.warns(SceneWarning) as warned:
        bake(scene)
    assert sum("loose" in str(each.message) for each in warned) == 1
    apart = load_scene(tmp_path / "bathroom.obj", group="loose")
    assert [item.id for item in apart.objects] == ["Bathroom", "Bathroom#2", "Bathroom#3"]
    assert not any(each.kind == "merged" for each in apart.check())
    with pytest.warns(SceneWarning, match="none of 3 objects") as warned:
        bake(apart)
    assert not any("group=0" in str(each.message) for each in warned), "which would merge it again"


def test_a_shell_of_one_part_is_not_merged(tmp_path: Path) -> None:
    assert not any(each.kind == "merged" for each in load_scene(merged(tmp_path / "room.obj", 1)).check())
