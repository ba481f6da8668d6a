"""OBJ material libraries: colours, textures and their coordinates, compared with hand-written pixels."""

from __future__ import annotations

import re
import warnings
from pathlib import Path

import numpy as np
import pytest

from looks import BLUE, GREEN, PIXELS, RED, UPRIGHT, WHITE, image_file, looks, refused, shown
from scene2hap.scene.load import load_scene
from scene2hap.scene.objects import SceneObject

# A square with upright texture coordinates; in OBJ, v runs up.
SQUARE = """v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0
vt 0.25 0.25\nvt 0.75 0.25\nvt 0.75 0.75\nvt 0.25 0.75
"""
FACE = "f 1/1 2/2 3/3 4/4\n"


def write(folder: Path, mtl: str, obj: str = "", library: str = "scene.mtl") -> Path:
    (folder / library).write_text(mtl, encoding="utf-8")
    path = folder / "scene.obj"
    path.write_text(obj or f"mtllib {library}\n{SQUARE}usemtl wood\n{FACE}", encoding="utf-8")
    return path


def one(path: Path) -> SceneObject:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        (item,) = load_scene(path, unit_m=1.0).objects
    return item


@pytest.mark.parametrize(
    ("named", "stored"), [("dark%20oak.png", "dark oak.png"), ("50%20.png", "50%20.png"), ("100%.png", "100%.png")]
)
def test_a_name_is_read_as_it_is_or_as_an_address(tmp_path: Path, named: str, stored: str) -> None:
    (tmp_path / stored).write_bytes(image_file())
    assert looks(one(write(tmp_path, f"newmtl wood\nmap_Kd {named}\n"))).materials[0].texture is not None


def test_a_comment_begins_before_a_word_and_not_within_a_name(tmp_path: Path) -> None:
    """Copies of objects, materials and files are numbered with this sign."""
    (tmp_path / "oak#2.png").write_bytes(image_file())
    (tmp_path / "set#1.mtl").write_text("newmtl oak#1 # plain\nKd 1 0 0\nnewmtl oak#2\nmap_Kd oak#2.png\t# texture\n")
    chairs = "".join(f"o Chair#{k} # a chair\nusemtl oak#{k}\n{FACE.strip()} # front\n" for k in (1, 2))
    (tmp_path / "scene.obj").write_text(f"#head\nmtllib set#1.mtl\n{SQUARE}{chairs}")
    first, second = load_scene(tmp_path / "scene.obj", unit_m=1.0).objects
    assert [(item.id, item.name, item.material_names) for item in (first, second)] == [
        ("Chair#1", "Chair#1", ("oak#1",)),
        ("Chair#2", "Chair#2", ("oak#2",)),
    ]
    assert [looks(item).materials[0].texture is None for item in (first, second)] == [True, False]


def test_a_comment_may_begin_right_behind_a_number(tmp_path: Path) -> None:
    (tmp_path / "scene.mtl").write_text("newmtl red\nKd 1 0 0#red\n")
    numbers = "v 0 0 0#origin\nv 1 0 0\nv 0 1 0\n"
    (tmp_path / "scene.obj").write_text(f"mtllib scene.mtl\n{numbers}usemtl red\nf 1 2 3#front\n")
    (item,) = load_scene(tmp_path / "scene.obj", unit_m=1.0).objects
    assert looks(item).materials[0].color_rgba == (1.0, 0.0, 0.0, 1.0)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_names_of_materials_and_files_are_read_in_any_encoding(tmp_path: Path, encoding: str) -> None:
    (tmp_path / "Türe.png").write_bytes(image_file())
    (tmp_path / "Möbel.mtl").write_bytes("newmtl Ölfarbe\nmap_Kd Türe.png\n".encode(encoding))
    (tmp_path / "scene.obj").write_bytes(f"mtllib Möbel.mtl\n{SQUARE}usemtl Ölfarbe\n{FACE}".encode(encoding))
    item = one(tmp_path / "scene.obj")
    assert item.material_names == ("Ölfarbe",)
    assert item.appearance is not None
    assert item.appearance.materials[0].has_texture


@pytest.mark.parametrize(
    ("rows", "rgba"),
    [
        ("Kd 0.1 0.2 0.3", (0.1, 0.2, 0.3, 1.0)),
        ("\tkd  0.1\t0.2 0.3 # brown", (0.1, 0.2, 0.3, 1.0)),
        ("Kd 0.1 0.2 0.3\nd 0.5", (0.1, 0.2, 0.3, 0.5)),
        ("Kd 0.1 0.2 0.3\nd -halo 0.5", (0.1, 0.2, 0.3, 0.5)),
        ("Kd 0.1 0.2 0.3\nTr 0.75", (0.1, 0.2, 0.3, 0.25)),
        ("Kd 7 -1 nan", (0.8, 0.8, 0.8, 1.0)),
        ("Kd 7 -1 0", (1.0, 0.0, 0.0, 1.0)),
        ("Kd spectral file.rfl", (0.8, 0.8, 0.8, 1.0)),
        ("", (0.8, 0.8, 0.8, 1.0)),
    ],
)
def test_colours_are_read_from_kd(tmp_path: Path, rows: str, rgba: tuple[float, ...]) -> None:
    item = one(write(tmp_path, f"Kd 1 1 1\nnewmtl other\nKd 0 0 0\nnewmtl wood\n{rows}\n"))
    (material,) = looks(item).materials
    assert material.color_rgba == rgba
    assert material.texture is None
    assert looks(item).uv is None


@pytest.mark.parametrize("name", ["wood.png", "wood floor.png", "100%25.png"])
def test_texture_file_names_may_contain_blanks_and_percent_signs(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_bytes(image_file())
    item = one(write(tmp_path, f"newmtl wood\nKd 1 1 1\nmap_Kd {name}\n"))
    assert shown(item) == UPRIGHT


def test_backslashes_and_blanks_in_paths_are_accepted(tmp_path: Path) -> None:
    (tmp_path / "textures").mkdir()
    (tmp_path / "textures" / "wood.png").write_bytes(image_file())
    path = write(tmp_path, "newmtl wood\nmap_Kd textures\\wood.png\n", library="my scene.mtl")
    assert shown(one(path)) == UPRIGHT


def test_one_mtllib_statement_can_name_several_libraries(tmp_path: Path) -> None:
    (tmp_path / "b.mtl").write_text("newmtl wood\nKd 0 0 1\n")
    path = write(tmp_path, "newmtl wood\nKd 1 0 0\n", f"mtllib a.mtl b.mtl\n{SQUARE}usemtl wood\n{FACE}", "a.mtl")
    assert looks(one(path)).materials[0].color_rgba == (0.0, 0.0, 1.0, 1.0)


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ("-s 1 1 1 -o 0 0 0", [BLUE, WHITE, GREEN, RED]),
        ("-o 0.5", [WHITE, BLUE, RED, GREEN]),
        ("-o 0 0.5 0", [RED, GREEN, WHITE, BLUE]),
        ("-s -1 1", [WHITE, BLUE, RED, GREEN]),
        ("-s -1", [WHITE, BLUE, RED, GREEN]),
        # u' = 2 u + 0.25: 0.25 and 0.75 become 0.75 and 1.75.
        ("-clamp on -s 2 1 1 -bm 0.5 -o 0.25", [WHITE, WHITE, GREEN, GREEN]),
        ("-mm 0 1 -blendu on -imfchan r", [BLUE, WHITE, GREEN, RED]),
    ],
)
def test_texture_options_scale_and_shift_coordinates(
    tmp_path: Path, options: str, expected: list[tuple[int, ...]]
) -> None:
    (tmp_path / "wood floor.png").write_bytes(image_file())
    item = one(write(tmp_path, f"newmtl wood\nmap_Kd {options} wood floor.png\n"))
    corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    assert shown(item) == dict(zip(corners, expected, strict=True))


@pytest.mark.parametrize(("kd", "rgb"), [("Kd 0 0 0", 1.0), ("", 1.0), ("Kd 0.5 0.5 0.5", 0.5)])
def test_a_black_colour_does_not_hide_a_texture(tmp_path: Path, kd: str, rgb: float) -> None:
    (tmp_path / "wood.png").write_bytes(image_file())
    item = one(write(tmp_path, f"newmtl wood\n{kd}\nmap_Kd wood.png\n"))
    assert looks(item).materials[0].color_rgba == (rgb, rgb, rgb, 1.0)


@pytest.mark.parametrize(("rows", "channels"), [("", 3), ("map_d wood.png", 4)])
def test_texture_opacity_is_used_only_when_requested(tmp_path: Path, rows: str, channels: int) -> None:
    (tmp_path / "wood.png").write_bytes(image_file(np.dstack((PIXELS, np.full((2, 2), 9, np.uint8)))))
    texture = looks(one(write(tmp_path, f"newmtl wood\nmap_Kd wood.png\n{rows}\n"))).materials[0].texture
    assert texture is not None
    assert texture.shape == (2, 2, channels)


def test_negative_texture_indices_count_back(tmp_path: Path) -> None:
    (tmp_path / "wood.png").write_bytes(image_file())
    obj = f"mtllib scene.mtl\n{SQUARE}usemtl wood\nf -4/-4 -3/-3 -2/-2 -1/-1\nvt 0 0\n"
    assert shown(one(write(tmp_path, "newmtl wood\nmap_Kd wood.png\n", obj))) == UPRIGHT


@pytest.mark.parametrize("face", ["f 1 2 3 4", "f 1//1 2//2 3//3 4//4", "f 1/9 2/9 3/9 4/9", "f 1/x 2/x 3/x 4/x"])
def test_faces_without_coordinates_get_the_plain_colour(tmp_path: Path, face: str) -> None:
    (tmp_path / "wood.png").write_bytes(image_file())
    obj = f"mtllib scene.mtl\n{SQUARE}usemtl wood\n{face}\n"
    item = one(write(tmp_path, "newmtl wood\nKd 1 0 0\nmap_Kd wood.png\n", obj))
    (material,) = looks(item).materials
    assert (material.color_rgba, material.texture) == ((1.0, 0.0, 0.0, 1.0), None)


def test_every_face_has_its_own_material(tmp_path: Path) -> None:
    (tmp_path / "wood.png").write_bytes(image_file())
    obj = f"mtllib scene.mtl\n{SQUARE}usemtl wood\nf 1/1 2/2 3/3\nusemtl steel\nf 1 3 4\nusemtl lost\nf 2 3 4\n"
    appearance = looks(one(write(tmp_path, "newmtl wood\nmap_Kd wood.png\nnewmtl steel\nKd 0.5 0.5 0.5\n", obj)))
    colors = [appearance.materials[i].color_rgba[0] for i in appearance.face_material]
    assert colors == [1.0, 0.5, 0.8]


def test_object_without_library_has_no_appearance(tmp_path: Path) -> None:
    path = tmp_path / "scene.obj"
    path.write_text(f"{SQUARE}usemtl wood\n{FACE}")
    assert one(path).appearance is None


@pytest.mark.parametrize(
    ("library", "mtl", "reason"),
    [
        ("gone.mtl", "", "there is no file"),
        ("../gone.mtl", "", "'../gone.mtl', which lies outside"),
        ("scene.mtl", "newmtl wood\nKd 1 0 0\nmap_Kd gone.png\n", "there is no file '.*gone.png'"),
        ("scene.mtl", "newmtl wood\nKd 1 0 0\nmap_Kd ../gone.png\n", "'../gone.png', which lies outside"),
        ("scene.mtl", "newmtl wood\nKd 1 0 0\nmap_Kd scene.obj\n", "'scene.obj' is no image that is read"),
        (
            "scene.mtl",
            "newmtl wood\nKd 1 0 0\nmap_Kd C:\\maps\\wood.png\n",
            "no file '.*wood.png'|lies outside",
        ),
    ],
)
def test_unreadable_library_or_texture_warns_once(tmp_path: Path, library: str, mtl: str, reason: str) -> None:
    home = tmp_path / "home"
    home.mkdir()
    scene, message = refused(write(home, mtl, f"mtllib {library}\n{SQUARE}usemtl wood\n{FACE}"))
    assert re.search(reason, message)
    item = scene.objects[0]
    assert item.appearance is None if not mtl else looks(item).materials[0].color_rgba == (1.0, 0.0, 0.0, 1.0)


def test_instance_keys_follow_material_content(tmp_path: Path) -> None:
    obj = f"mtllib scene.mtl\n{SQUARE}o a\nusemtl wood\n{FACE}o b\nusemtl wood\n{FACE}o c\nusemtl steel\n{FACE}"
    path = write(tmp_path, "newmtl wood\nKd 1 0 0\nnewmtl steel\nKd 0 0 1\n", obj)
    a, b, c = (item.instance_key for item in load_scene(path, unit_m=1.0).objects)
    assert a == b != c
    write(tmp_path, "newmtl wood\nKd 0 1 0\nnewmtl steel\nKd 0 0 1\n", obj)
    green, _, same = (item.instance_key for item in load_scene(path, unit_m=1.0).objects)
    assert green != a
    assert same == c
