"""Totals are limited before memory is allocated, and valid files of the same kind are read."""

import json
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile

from scene2hap import load_scene
from scene2hap.audio import files
from scene2hap.audio.conversion import convert
from scene2hap.audio.files import read_clip
from scene2hap.errors import AudioError, SceneError
from scene2hap.scene import limits
from scene2hap.scene.engines import mjcf_files
from scene2hap.scene.formats import mtl, obj
from scene2hap.scene.looks.texture_files import TextureFiles
from scene2hap.scene.shapes import TriMesh
from scene2hap.scene.surface.dominant_surface import dominant_surface
from scene2hap.scene.tree import Piece


def gltf(folder: Path, *, accessors: list[Any], primitives: list[Any], data: bytes = b"", **more: Any) -> Path:
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(data), "uri": "a.bin"}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "accessors": accessors,
        "meshes": [{"primitives": primitives}],
        "nodes": [{"mesh": 0}],
        **more,
    }
    (folder / "a.bin").write_bytes(data or b"\0")
    (folder / "a.gltf").write_text(json.dumps(document))
    return folder / "a.gltf"


def vec3(count: int, **more: Any) -> dict[str, Any]:
    return {"type": "VEC3", "componentType": 5126, "count": count, **more}


def test_budget_grows_with_stored_bytes() -> None:
    budget = limits.Budget("the numbers", 10, 2.0)
    budget.spend(10, "a")
    with pytest.raises(SceneError, match="a brings the numbers to 11; at most 10"):
        budget.spend(1, "a")
    budget.stored = 5
    budget.spend(9, "a")


def test_nodes_are_counted_in_total(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MAX_NODES", 5)
    size = limits.TreeSize()
    size.add_nodes(3)
    size.add_nodes(2)
    with pytest.raises(SceneError, match="number of nodes is 6; .*MAX_NODES"):
        size.add_nodes(1)


def test_numbers_of_a_buffer_in_its_own_file_raise_the_budget(tmp_path: Path) -> None:
    """400,000 positions of three bytes: more numbers than are free."""
    points = np.zeros((400_000, 4), np.uint8)
    points[:3, :3] = np.eye(3) * 255
    faces = np.arange(3, dtype=np.uint32)
    path = gltf(
        tmp_path,
        accessors=[
            {"type": "VEC3", "componentType": 5121, "normalized": True, "count": len(points), "bufferView": 0},
            {"type": "SCALAR", "componentType": 5125, "count": 3, "bufferView": 1},
        ],
        primitives=[{"attributes": {"POSITION": 0}, "indices": 1}],
        data=points.tobytes() + faces.tobytes(),
        bufferViews=[
            {"buffer": 0, "byteLength": points.nbytes, "byteStride": 4},
            {"buffer": 0, "byteOffset": points.nbytes, "byteLength": faces.nbytes},
        ],
        extensionsRequired=["KHR_mesh_quantization"],
    )
    assert len(load_scene(path).objects) == 1


def test_accessors_without_bytes_are_limited(tmp_path: Path) -> None:
    many = [{"attributes": {"POSITION": i}} for i in range(50)]
    with pytest.raises(SceneError, match="the numbers in its accessors"):
        load_scene(gltf(tmp_path, accessors=[vec3(10**7)] * 50, primitives=many))


def test_accessors_that_share_one_buffer_are_limited(tmp_path: Path) -> None:
    data = np.random.default_rng(0).normal(size=(3000, 3)).astype("<f4").tobytes()
    many = [{"attributes": {"POSITION": i}} for i in range(400)]
    with pytest.raises(SceneError, match="the numbers in its accessors|its triangles"):
        load_scene(gltf(tmp_path, accessors=[vec3(3000, bufferView=0)] * 400, primitives=many, data=data))


def test_primitives_that_share_an_accessor_are_read(tmp_path: Path) -> None:
    """As exporters write primitives: one table of vertices, and a list of indices for each material."""
    n, m = 20_000, 300
    indices = np.arange(3 * m, dtype="<u4").tobytes()
    data = indices + np.random.default_rng(0).normal(size=(n, 3)).astype("<f4").tobytes()
    views = [
        {"buffer": 0, "byteOffset": len(indices), "byteLength": 12 * n},
        *({"buffer": 0, "byteOffset": 12 * i, "byteLength": 12} for i in range(m)),
    ]
    accessors = [vec3(n, bufferView=0)]
    accessors += [{"type": "SCALAR", "componentType": 5125, "count": 3, "bufferView": i + 1} for i in range(m)]
    many = [{"attributes": {"POSITION": 0}, "indices": i + 1} for i in range(m)]
    path = gltf(tmp_path, accessors=accessors, primitives=many, data=data, bufferViews=views)
    assert len(load_scene(path).objects[0].geometry.mesh.faces) == m


def test_instances_within_one_object_are_limited(tmp_path: Path) -> None:
    data = np.random.default_rng(0).normal(size=(3000, 3)).astype("<f4").tobytes()
    n = 1000
    nodes: list[dict[str, Any]] = [{"mesh": 0, "translation": [i, 0, 0]} for i in range(n)]
    nodes.append({"name": "all", "children": list(range(n))})
    path = gltf(
        tmp_path,
        accessors=[vec3(3000, bufferView=0)],
        primitives=[{"attributes": {"POSITION": 0}}],
        data=data,
        nodes=nodes,
        scenes=[{"nodes": [n]}],
    )
    with pytest.raises(SceneError, match="triangles to draw to"):
        load_scene(path)


def test_piece_keeps_only_its_used_vertices() -> None:
    points = np.full((1000, 3), np.nan)
    points[[7, 500, 999]] = np.eye(3)
    piece = Piece.checked(0, points, [[999, 7, 500]], "", "a")
    assert piece.faces.tolist() == [[2, 0, 1]]
    assert piece.vertices.tolist() == np.eye(3).tolist()
    with pytest.raises(SceneError, match="a: vertex 8 is"):
        Piece.checked(0, points, [[999, 8, 500]], "", "a")


def test_excessive_triangles_fall_back_to_the_box_surface() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    heap = TriMesh(points, np.tile([[0, 1, 2], [1, 2, 3]], (100_000, 1)))
    assert "box-fallback" in dominant_surface(heap, up=np.array([0.0, 1.0, 0.0])).flags


def test_continued_lines_are_joined_once() -> None:
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2 \\\n3 \\\n\nf 3 2 1\n"
    textures = TextureFiles(Path(), Path())
    assert [len(piece.faces) for piece in obj.read_obj(text, "a", textures).roots[0].pieces] == [2]
    long = "f 1 2 " + "\\\n" * 200_000 + "3\n"
    scene = obj.read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + long, "a", textures)
    assert len(scene.roots[0].pieces[0].faces) == 1


def test_texture_options_are_parsed_in_any_number() -> None:
    assert mtl._texture("-s 2 3 -o 0.5 -clamp on a b.png")[0] == "a b.png"
    file, lies = mtl._texture("-s 2 " * 100_000 + "-s 3 4 5 wood.png")
    assert (file, lies.scale) == ("wood.png", (3.0, 4.0))


def test_a_library_is_read_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[Path] = []
    monkeypatch.setattr(mtl, "read_bytes", lambda path: read.append(path) or b"newmtl a\n")
    names = "".join(f"mtllib {'./' * i}a.mtl\n" for i in range(50))
    (tmp_path / "a.obj").write_text(names + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    load_scene(tmp_path / "a.obj")
    assert len(read) == 1


def test_samples_of_all_channels_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    soundfile.write(tmp_path / "a.flac", np.zeros((2000, 8)), 655_350, format="FLAC")
    assert len(read_clip(tmp_path / "a.flac").samples) == 2000
    monkeypatch.setattr(files, "MAX_FILE_SAMPLES", 15_999)
    monkeypatch.setattr(files, "SAMPLES_PER_BYTE", 0)
    with pytest.raises(AudioError, match="2,000 frames of 8 channels at 655,350 Hz, 16,000 samples"):
        read_clip(tmp_path / "a.flac")


def test_more_channels_than_a_sound_field_has_are_refused(tmp_path: Path) -> None:
    soundfile.write(tmp_path / "a.wav", np.zeros((20, 65)), 48_000)
    for read in (read_clip, lambda path: convert(path, tmp_path / "felt.wav")):
        with pytest.raises(AudioError, match="has 65 channels; it must have at most 64"):
            read(tmp_path / "a.wav")
    assert not (tmp_path / "felt.wav").exists()


def test_textures_of_a_model_count_together(tmp_path: Path) -> None:
    pytest.importorskip("mujoco")
    rows = "".join(f'<texture name="t{i}" type="2d" builtin="flat" width="2000" height="2000"/>' for i in range(9))
    (tmp_path / "a.xml").write_text(f"<mujoco><asset>{rows}</asset></mujoco>")
    with pytest.raises(SceneError, match="the cells of textures and height fields to 36,000,000"):
        mjcf_files.check_files(tmp_path / "a.xml", tmp_path)


def test_picture_that_decodes_to_too_much_is_refused(tmp_path: Path) -> None:
    header = b"IHDR" + struct.pack(">IIBBBBB", 30_000, 30_000, 8, 2, 0, 0, 0)
    png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + header + struct.pack(">I", zlib.crc32(header))
    (tmp_path / "a.png").write_bytes(png)
    row = '<mujoco><asset><texture name="t" type="2d" file="a.png"/></asset></mujoco>'
    (tmp_path / "a.xml").write_text(row)
    with pytest.raises(SceneError, match="to 900,000,00"):
        mjcf_files.check_files(tmp_path / "a.xml", tmp_path)


def test_nested_models_count_towards_the_limit(tmp_path: Path) -> None:
    for i in range(19):
        rows = "".join(f'<model name="{name}" file="m{i + 1}.xml"/>' for name in "ab")
        (tmp_path / f"m{i}.xml").write_text(f"<mujoco><asset>{rows}</asset></mujoco>")
    (tmp_path / "m19.xml").write_text("<mujoco/>")
    with pytest.raises(SceneError, match="models within models"):
        mjcf_files.check_files(tmp_path / "m0.xml", tmp_path)
