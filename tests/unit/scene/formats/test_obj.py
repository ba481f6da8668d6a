"""OBJ files: objects, groups, materials and faces, and errors that name the line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats import obj
from scene2hap.scene.load import load_scene
from scene2hap.scene.looks.texture_files import TextureFiles
from scene2hap.scene.tree import AuthoredScene

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


def read(text: str) -> AuthoredScene:
    return obj.read_obj(text, "file", TextureFiles(Path(), Path()))


def corners(text: str) -> list[list[list[float]]]:
    """The triangles of the only piece."""
    (node,) = read(text).roots
    (piece,) = node.pieces
    triangles: list[list[list[float]]] = piece.vertices[piece.faces].tolist()
    return triangles


@pytest.mark.parametrize("face", ["f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//2 3//3", "f 1/9/9 2/9/9 3/9/9", "f -4 -3 -2"])
def test_every_face_syntax_is_read(face: str) -> None:
    assert corners(SQUARE + face) == [[[0, 0, 0], [1, 0, 0], [1, 1, 0]]]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-be", "cp1252"])
def test_names_are_read_in_any_unicode_and_in_that_of_windows(tmp_path: Path, encoding: str) -> None:
    """Windows shells write UTF-16 when output is redirected, and 3ds Max writes code page 1252."""
    mark = "\ufeff" if encoding == "utf-16-be" else ""
    path = tmp_path / "room.obj"
    path.write_bytes((mark + f"o Türe\n{SQUARE}f 1 2 3 4\n").encode(encoding))
    assert [item.id for item in load_scene(path).objects] == ["Türe"]


def test_polygons_become_fans() -> None:
    assert corners(SQUARE + "f 1 2 3 4") == [[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]]


@pytest.mark.parametrize("first", range(6))
def test_a_concave_face_is_cut_within_its_outline(first: int) -> None:
    # The top of an L-shaped worktop, which Blender exports as one face that may begin at any corner.
    outline = [(0, 0), (3, 0), (3, 0.6), (0.6, 0.6), (0.6, 2), (0, 2)]
    outline = outline[first:] + outline[:first]
    text = "".join(f"v {x} {y} 0\n" for x, y in outline) + "f 1 2 3 4 5 6\n"
    a, b, c = np.array(corners(text)).transpose(1, 0, 2)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    assert areas.sum() == pytest.approx(2.64)


def test_edges_written_as_faces_are_left_out() -> None:
    assert corners(SQUARE + "f 1 2\nf 1 2 3\nf 4\n") == [[[0, 0, 0], [1, 0, 0], [1, 1, 0]]]


def test_an_object_of_edges_alone_is_left_out(tmp_path: Path) -> None:
    path = tmp_path / "bed.obj"
    path.write_text(SQUARE + "g BezierCircle\nf 1 2\nf 2 3\ng bed\nf 1 2 3 4\n")
    assert [item.name for item in load_scene(path).objects] == ["bed"]
    path.write_text(SQUARE + "g BezierCircle\nf 1 2\n")
    with pytest.raises(SceneError, match="holds no triangles"):
        load_scene(path)


def test_negative_indices_count_back_from_their_line() -> None:
    text = "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\no b\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf -3 -2 -1\n"
    heights = [node.pieces[0].vertices[:, 2].tolist() for node in read(text).roots]
    assert heights == [[0, 0, 0], [5, 5, 5]]


def test_each_o_statement_is_one_object_in_file_order() -> None:
    text = SQUARE + "o leg\nf 1 2 3\no top\nf 1 3 4\no leg\nf 2 3 4\n"
    assert [node.name for node in read(text).roots] == ["leg", "top", "leg"]


def test_groups_are_objects_only_without_o_statements() -> None:
    faces = "g one\nf 1 2 3\ng two\nf 1 3 4\ng one\nf 2 3 4\n"
    assert [(node.name, len(node.pieces[0].faces)) for node in read(SQUARE + faces).roots] == [
        ("one", 2),
        ("two", 1),
    ]
    assert [(node.name, len(node.pieces[0].faces)) for node in read(SQUARE + "o all\n" + faces).roots] == [("all", 3)]


def test_file_without_o_or_g_is_one_object_named_after_the_file(tmp_path: Path) -> None:
    path = tmp_path / "chair.obj"
    path.write_text(SQUARE + "f 1 2 3 4\n")
    assert [item.id for item in load_scene(path).objects] == ["chair"]


def test_materials_split_an_object_into_pieces() -> None:
    text = SQUARE + "mtllib ../elsewhere.mtl\no a\nusemtl oak\nf 1 2 3\nusemtl steel\nf 1 3 4\nusemtl oak\nf 2 3 4\n"
    (node,) = read(text).roots
    assert [(piece.material, len(piece.faces)) for piece in node.pieces] == [("oak", 2), ("steel", 1)]


def test_comments_continued_lines_and_vertex_colours_are_accepted() -> None:
    vertices = "# in C:\\models\\\r\nv 0 0 0 1 0 0\r\nv 1 0 0 # corner\r\nv 1 1 0 1.0\r\n\r\n"
    text = vertices + "vn 0 0 1\r\ns 1\r\nl 1 2\r\nf 1 \\\r\n 2 3 # front\r\n"
    assert corners(text) == [[[0, 0, 0], [1, 0, 0], [1, 1, 0]]]


def test_object_contains_only_its_used_vertices(tmp_path: Path) -> None:
    path = tmp_path / "two.obj"
    path.write_text("o a\n" + SQUARE + "f 1 2 3 4\no b\nv 9 9 9\nv 9 8 9\nv 8 8 9\nf 5 6 7\n")
    first, second = load_scene(path).objects
    np.testing.assert_array_equal(first.bounds_m, [[0, 0, 0], [1, 1, 0]])
    np.testing.assert_array_equal(second.bounds_m, [[8, 8, 9], [9, 9, 9]])


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("v 0 0\n", "line 1: 'v 0 0' is no vertex"),
        ("v 0 0 zero\n", "line 1: .*three numbers"),
        (SQUARE + "f\n", "line 5: 'f ' must name some of the 4 vertices"),
        (SQUARE + "f 1 9\n", "line 5: 'f 1 9' must name some of the 4 vertices"),
        (SQUARE + "f 1 2 5\n", "line 5: 'f 1 2 5' must name"),
        (SQUARE + "f 0 1 2\n", "line 5: 'f 0 1 2' must name"),
        (SQUARE + "f -5 1 2\n", "line 5: 'f -5 1 2' must name"),
        (SQUARE + "f a b c\n", "line 5: 'f a b c' is no face"),
    ],
)
def test_error_names_the_line(text: str, sentence: str) -> None:
    with pytest.raises(SceneFormatError, match=sentence):
        read(text)


def test_non_finite_vertex_error_names_its_object() -> None:
    with pytest.raises(SceneError, match="object 'cup': vertex 1 is .*finite"):
        read("o cup\nv 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")


def test_objects_are_limited(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MAX_OBJECTS", 1)
    (tmp_path / "two.obj").write_text(SQUARE + "o a\nf 1 2 3\no b\nf 1 2 3\n")
    with pytest.raises(SceneError, match="number of objects is 2; .*MAX_OBJECTS"):
        load_scene(tmp_path / "two.obj")


def test_triangles_are_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MAX_TRIANGLES", 1)
    with pytest.raises(SceneError, match="number of triangles is 2; .*MAX_TRIANGLES"):
        read(SQUARE + "f 1 2 3 4\n")
