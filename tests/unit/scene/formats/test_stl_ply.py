"""STL and PLY files: one object named after the file, or an error; no output of trimesh."""

from __future__ import annotations

import logging
import struct
from pathlib import Path

import numpy as np
import pytest

from gltf_builder import CUBE, CUBE_FACES
from looks import looks
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene.load import load_scene


def binary_stl() -> bytes:
    """The unit cube as binary STL."""
    rows = [struct.pack("<12fH", 0, 0, 0, *CUBE[face].ravel(), 0) for face in CUBE_FACES]
    return b"cube".ljust(80) + struct.pack("<I", len(rows)) + b"".join(rows)


def ascii_stl(*names: str) -> bytes:
    """A text STL with a cube for each name, side by side."""
    lines = []
    for i, name in enumerate(names):
        lines.append(f"solid {name}")
        for face in CUBE_FACES:
            points = "".join(f"vertex {x + 2 * i} {y} {z}\n" for x, y, z in CUBE[face])
            lines.append(f"facet normal 0 0 0\nouter loop\n{points}endloop\nendfacet")
        lines.append(f"endsolid {name}")
    return "\n".join(lines).encode()


def ascii_ply(faces: bool = True) -> bytes:
    """The unit cube as a text PLY, or only its corners."""
    header = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    body = "".join(f"{x} {y} {z}\n" for x, y, z in CUBE)
    if faces:
        header += "element face 12\nproperty list uchar int vertex_indices\n"
        body += "".join(f"3 {a} {b} {c}\n" for a, b, c in CUBE_FACES)
    return (header + "end_header\n" + body).encode()


@pytest.mark.parametrize(
    ("name", "content"), [("cup.stl", binary_stl()), ("cup.STL", ascii_stl("solid one")), ("cup.ply", ascii_ply())]
)
def test_file_is_one_object_with_its_name(tmp_path: Path, name: str, content: bytes) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    (item,) = load_scene(path).objects
    assert (item.id, item.size_m) == ("cup", pytest.approx((1.0, 1.0, 1.0)))
    assert item.surface.flags == ()
    np.testing.assert_array_equal(item.bounds_m, [[0.0] * 3, [1.0] * 3])


def test_solids_of_one_file_are_one_object(tmp_path: Path) -> None:
    path = tmp_path / "pair.stl"
    path.write_bytes(ascii_stl("left", "right"))
    (item,) = load_scene(path).objects
    np.testing.assert_array_equal(item.bounds_m, [[0.0, 0.0, 0.0], [3.0, 1.0, 1.0]])


def test_points_without_faces_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "cloud.ply"
    path.write_bytes(ascii_ply(faces=False))
    with pytest.raises(SceneError, match="holds no triangles"):
        load_scene(path)


@pytest.mark.parametrize("suffix", ["stl", "ply"])
@pytest.mark.parametrize("content", [b"a shopping list", b"\x89PNG\r\n\x1a\n" + bytes(200), b"\0" * 100])
def test_files_that_are_neither_stl_nor_ply_are_refused(tmp_path: Path, suffix: str, content: bytes) -> None:
    path = tmp_path / f"thing.{suffix}"
    path.write_bytes(content)
    with pytest.raises(SceneError, match="cannot be read as|holds no triangles"):
        load_scene(path)


def test_wrong_element_count_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "cup.stl"
    path.write_bytes(binary_stl()[:80] + struct.pack("<I", 10**9) + binary_stl()[84:])
    with pytest.raises(SceneFormatError, match="'cup' cannot be read as STL"):
        load_scene(path)


def test_a_text_ply_that_was_cut_short_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "cup.ply"
    path.write_bytes(ascii_ply()[:-40])
    with pytest.raises(SceneFormatError, match="'cup' promises 12 faces and holds"):
        load_scene(path)


def test_trimesh_logs_nothing_and_keeps_its_logger(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "cup.stl"
    path.write_bytes(ascii_stl("one").replace(b"normal 0 0 0", b"normal 0 x 0", 1))
    log = logging.getLogger("trimesh")
    before = (log.propagate, list(log.handlers))
    with caplog.at_level(logging.DEBUG):
        # trimesh 5.2 warns of the broken normal and continues.
        assert len(load_scene(path).objects) == 1
    assert caplog.records == []
    assert capsys.readouterr() == ("", "")
    assert (log.propagate, list(log.handlers)) == before


def colored_ply(*, of_faces: bool) -> bytes:
    """A square of a red and a half transparent blue triangle, or with a red, a green, a blue and a black vertex."""
    rgba = "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
    vertex, face = ("", rgba) if of_faces else (rgba, "")
    colors = ["255 0 0 255", "0 255 0 255", "0 0 255 255", "0 0 0 255"]
    corners = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"]
    lines = corners if of_faces else [f"{at} {color}" for at, color in zip(corners, colors, strict=True)]
    faces = ["3 0 1 2", "3 0 2 3"]
    if of_faces:
        faces = ["3 0 1 2 255 0 0 255", "3 0 2 3 0 0 255 128"]
    header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    header += f"{vertex}element face 2\nproperty list uchar int vertex_indices\n{face}end_header\n"
    return (header + "\n".join(lines + faces) + "\n").encode()


@pytest.mark.parametrize(
    ("of_faces", "expected"),
    [
        (True, [[1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 0.5]]),
        (False, [[1 / 3, 1 / 3, 1 / 3, 1.0], [1 / 3, 0.0, 1 / 3, 1.0]]),
    ],
)
def test_vertex_colours_become_face_colours(tmp_path: Path, of_faces: bool, expected: list[list[float]]) -> None:
    path = tmp_path / "scan.ply"
    path.write_bytes(colored_ply(of_faces=of_faces))
    (item,) = load_scene(path).objects
    appearance = looks(item)
    rgba = [appearance.materials[i].color_rgba for i in appearance.face_material]
    np.testing.assert_allclose(rgba, expected, atol=0.005)


@pytest.mark.parametrize(("name", "content"), [("cup.stl", binary_stl()), ("cup.ply", ascii_ply())])
def test_file_without_colours_has_no_appearance(tmp_path: Path, name: str, content: bytes) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    assert load_scene(path).objects[0].appearance is None


def test_scan_with_many_colours_gets_few_materials(tmp_path: Path) -> None:
    """A fan of 3000 triangles whose corners run through 3000 hues of red and green."""
    n = 3000
    angle = np.linspace(0.0, 6.0, n + 1)
    rows = ["0 0 0 0 0 0"]
    rows += [f"{np.cos(a):.6f} {np.sin(a):.6f} 0 {i % 256} {i // 16} 0" for i, a in enumerate(angle)]
    faces = [f"3 0 {i} {i + 1}" for i in range(1, n + 1)]
    header = f"ply\nformat ascii 1.0\nelement vertex {n + 2}\nproperty float x\nproperty float y\nproperty float z\n"
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    header += f"element face {n}\nproperty list uchar int vertex_indices\nend_header\n"
    path = tmp_path / "scan.ply"
    path.write_text(header + "\n".join(rows + faces) + "\n")
    appearance = looks(load_scene(path).objects[0])
    assert 16 < len(appearance.materials) <= 256
    expected = np.array([[(i % 256 + (i + 1) % 256) / 3, (i // 16 + (i + 1) // 16) / 3] for i in range(n)]) / 255
    rgba = np.array([appearance.materials[k].color_rgba for k in appearance.face_material])
    np.testing.assert_allclose(rgba[:, :2], expected, atol=0.5 / 15 + 0.01)
