"""`load_scene`: choice of the reader, refused files, and repeatable loads."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from gltf_builder import Gltf, one_cube
from scene2hap.common.warning import SceneWarning
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene.load import load_scene
from scene2hap.scene.snapshot import SceneSnapshot
from scenes import box, scene


def test_the_scene_is_named_after_the_file(tmp_path: Path) -> None:
    assert load_scene(one_cube().write(tmp_path / "my kitchen.glb")).name == "my kitchen"


def test_path_can_be_a_string(tmp_path: Path) -> None:
    assert len(load_scene(str(one_cube().write(tmp_path / "scene.glb"))).objects) == 1


def test_json_is_a_scene_file(tmp_path: Path) -> None:
    before = scene(box("table", (1, 1, 1), (0, 0, 0)))
    path = tmp_path / "scene.json"
    for encoding in ("utf-8", "utf-8-sig"):  # editors of Windows write a mark before the text
        path.write_text(before.to_json(), encoding=encoding)
        assert load_scene(path) == before


@pytest.mark.parametrize("options", [{"up_axis": "z"}, {"unit_m": 0.01}, {"group": "leaf"}])
def test_axis_unit_and_grouping_are_refused_for_json(tmp_path: Path, options: dict[str, object]) -> None:
    path = tmp_path / "scene.json"
    path.write_text(scene(box("table", (1, 1, 1), (0, 0, 0))).to_json(), encoding="utf-8")
    with pytest.raises(SceneError, match="leave up_axis, unit_m and group out"):
        load_scene(path, **options)


def test_binary_json_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "scene.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(SceneFormatError, match="byte 0 is 0xff, which is not UTF-8; save the text as UTF-8"):
        load_scene(tmp_path / "scene.json")


def test_unknown_suffix_is_refused(tmp_path: Path) -> None:
    (tmp_path / "scene.blend").write_bytes(b"BLENDER")
    with pytest.raises(SceneFormatError, match=r"'scene\.blend' is of no kind that is read: \.glb, \.gltf"):
        load_scene(tmp_path / "scene.blend")


@pytest.mark.parametrize("name", ["none.glb", "none.obj", "none.blend", "none", "no\0ne.glb"])
def test_missing_file_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(SceneError, match="there is no file|cannot be read"):
        load_scene(tmp_path / name)


@pytest.mark.parametrize("name", ["folder", "folder.glb", "folder.obj"])
def test_folder_is_refused(tmp_path: Path, name: str) -> None:
    (tmp_path / name).mkdir()
    with pytest.raises(SceneError, match="is not a file; give the path of the scene file itself"):
        load_scene(tmp_path / name)


@pytest.mark.parametrize("suffix", ["glb", "gltf", "obj", "dae", "stl", "ply", "json"])
def test_empty_file_is_refused(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"scene.{suffix}"
    path.write_bytes(b"")
    with pytest.raises(SceneFormatError, match=r"is empty \(0 bytes\)"):
        load_scene(path)


def test_a_text_without_shapes_is_an_empty_scene(tmp_path: Path) -> None:
    path = tmp_path / "notes.obj"
    path.write_text("a shopping list\nmilk\n")
    with pytest.raises(SceneError, match="'notes' holds no triangles; nothing in it can be touched"):
        load_scene(path)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"up_axis": "x"}, "up_axis is 'x'; it must be 'y' or 'z'"),
        ({"unit_m": 0.0}, "unit_m is 0 m; it must be above 0"),
        ({"unit_m": float("inf")}, "unit_m is inf m; it must be finite"),
        ({"unit_m": "cm"}, "unit_m is 'cm'; it must be a number"),
        ({"group": "auto"}, "group is 'auto'"),
        ({"group": True}, "group is True"),
        ({"group": {"cube": 1}}, "group is {'cube': 1}; it must be"),
        ({"group": np.array([1, 2])}, r"group is array\(\[1, 2\]\)"),
    ],
)
def test_invalid_options_are_refused(tmp_path: Path, options: dict[str, object], sentence: str) -> None:
    path = one_cube().write(tmp_path / "scene.glb")
    with pytest.raises(SceneError, match=sentence):
        load_scene(path, **options)


def test_up_axis_changes_heights_but_not_coordinates(tmp_path: Path) -> None:
    gltf = one_cube("low")
    gltf.node("high", mesh=0, translation=[0.0, 0.0, 4.0], root=True)
    path = gltf.write(tmp_path / "scene.glb")
    by_y, by_z = load_scene(path), load_scene(path, up_axis="z")
    assert [item.relative_height_m for item in by_y.objects] == [0.0, 0.0]
    assert [item.relative_height_m for item in by_z.objects] == [0.0, 4.0]
    assert [item.pose for item in by_y.objects] == [item.pose for item in by_z.objects]


def test_nodes_with_one_name_keep_the_name_and_get_unique_ids(tmp_path: Path) -> None:
    gltf = one_cube("Hemi")
    gltf.node("Hemi", mesh=0, translation=[3.0, 0.0, 0.0], root=True)
    gltf.node("", mesh=0, translation=[6.0, 0.0, 0.0], root=True)
    objects = load_scene(gltf.write(tmp_path / "scene.glb")).objects
    assert [(item.id, item.name) for item in objects] == [("Hemi", "Hemi"), ("Hemi#2", "Hemi"), ("object", "")]


def test_repeated_loads_are_bit_identical(tmp_path: Path) -> None:
    gltf = Gltf()
    for i in range(5):
        gltf.node(f"n{i % 2}", mesh=gltf.cube(), rotation=[0.0, 0.6, 0.0, 0.8], scale=[1.0, 2.0, 0.1 + i], root=True)
    path = gltf.write(tmp_path / "scene.glb")
    assert len({load_scene(path).to_json() for _ in range(10)}) == 1


def test_reading_glb_needs_no_trimesh(tmp_path: Path) -> None:
    path = one_cube().write(tmp_path / "scene.glb")
    code = (
        "import sys; from scene2hap.scene.load import load_scene; load_scene(sys.argv[1]); "
        "print('trimesh' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=True)
    assert (done.stdout.strip(), done.stderr) == ("False", "")


def test_appearance_is_left_out_of_json_and_equality(tmp_path: Path) -> None:
    gltf = one_cube()
    gltf.header["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [1.0, 0.0, 0.0, 1.0]}}]
    gltf.header["meshes"][0]["primitives"][0]["material"] = 0
    scene = load_scene(gltf.write(tmp_path / "scene.glb"))
    assert scene.objects[0].appearance is not None
    again = SceneSnapshot.from_json(scene.to_json())
    assert again == scene
    assert again.to_json() == scene.to_json()
    assert again.objects[0].appearance is None


def test_turned_and_scaled_scene_round_trips_through_json_bit_exactly(tmp_path: Path) -> None:
    gltf = one_cube(rotation=[0.1, 0.7, -0.1, 0.7], scale=[0.3, 0.7, 1.1])
    gltf.node("inner", mesh=0, rotation=[0.5, 0.5, 0.5, 0.5], root=True)
    scene = load_scene(gltf.write(tmp_path / "scene.glb"))
    again = SceneSnapshot.from_json(scene.to_json())
    for before, after in zip(scene.objects, again.objects, strict=True):
        assert after.geometry.mesh.digest == before.geometry.mesh.digest
        assert after.geometry.mesh.vertices_m.tobytes() == before.geometry.mesh.vertices_m.tobytes()


@pytest.mark.parametrize("suffix", [".glb", ".gltf", ".obj", ".stl", ".json", ".urdf"])
def test_a_pointer_of_git_lfs_says_so(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"room{suffix}"
    path.write_bytes(b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12\n")
    with pytest.raises(SceneFormatError, match=r"'room\..*' is a pointer of Git LFS.*run `git lfs pull`"):
        load_scene(path)


POINT = 3 * "v 0.5 0 0.5\n" + "f -3 -2 -1\n"
SHEET = "v 0 0 0\nv 1 0 0\nv 0 0 1\nf -3 -2 -1\n"


def test_a_mesh_in_one_point_is_left_out_with_a_warning(tmp_path: Path) -> None:
    """Left in files by mistake; in an earlier version it refused the whole scene."""
    path = tmp_path / "scene.obj"
    path.write_text(f"o dot\n{POINT}o table\n{SHEET}", encoding="utf-8")
    with pytest.warns(SceneWarning, match=r"'scene' is read without 1 node .*: 'dot'\. Give a size"):
        assert [item.id for item in load_scene(path).objects] == ["table"]


def test_a_scene_without_any_size_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "scene.obj"
    path.write_text(f"o dot\n{POINT}", encoding="utf-8")
    with pytest.raises(SceneError, match="no object in scene 'scene' has a size"):
        load_scene(path)


def test_pieces_in_one_point_do_not_take_the_other_pieces_of_a_mesh(tmp_path: Path) -> None:
    path = tmp_path / "scene.obj"
    path.write_text(f"o table\nusemtl a\n{SHEET}usemtl b\n{POINT}", encoding="utf-8")
    assert len(load_scene(path).object("table").geometry.mesh.faces) == 2
