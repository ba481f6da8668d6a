"""Broken glTF: every fault raises an error of the library that names the place, within limits of size."""

from __future__ import annotations

import copy
import json
import struct
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_builder import CUBE, Gltf, Json, glb_bytes, one_cube
from scene2hap.errors import ConfigError, MissingExtra, Scene2HapError, SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.load import UnitWarning, load_scene
from systems import needs_links

# A sparse accessor with one value, for the vertex number in the third buffer view of `broken`.
SPARSE = {
    "count": 1,
    "indices": {"bufferView": 2, "componentType": 5123},
    "values": {"bufferView": 0},
}
# Seven positions, of which the eighth is replaced: the ninth corner of the cube's faces is vertex 7.
ONE_TOO_FAR = {
    "bufferView": 0,
    "componentType": 5126,
    "count": 7,
    "type": "VEC3",
    "sparse": {**SPARSE, "indices": {"bufferView": 1, "componentType": 5123, "byteOffset": 16}},
}


def broken(tmp_path: Path, change: Callable[[Json], object], gltf: Gltf | None = None) -> Path:
    """Write the file of a cube with a changed header."""
    gltf = gltf or one_cube()
    gltf.view([65535], "<u2")
    change(gltf.header)
    return gltf.write(tmp_path / "broken.glb")


def setting(*path: str | int, to: Any) -> Callable[[Json], object]:
    """A change that sets a value in the header."""

    def change(header: Json) -> None:
        place: Any = header
        for step in path[:-1]:
            place = place[step]
        place[path[-1]] = to

    return change


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (setting("asset", to={}), r"asset\.version is None; glTF 2\.0"),
        (setting("asset", to=[]), r"asset\.version is None"),
        (setting("asset", "version", to="1.0"), r"asset\.version is '1\.0'; glTF 2\.0 is read"),
        (setting("nodes", to={}), "nodes must be a list of objects"),
        (setting("accessors", 0, to=7), "accessors must be a list of objects"),
        (setting("scene", to=4), r"scene refers to scenes\[4\]; the file has 1 scenes"),
        (setting("scenes", 0, "nodes", to=[0, 0]), r"nodes\[0\] hangs below itself or below two nodes"),
        (setting("scenes", 0, "nodes", to=[7]), r"nodes\[7\]; the file has 1 nodes"),
        (setting("scenes", 0, "nodes", to=[-1]), "must be a whole number from 0"),
        (setting("scenes", 0, "nodes", to=3), "must be a list of node numbers"),
        (setting("nodes", 0, "children", to=[0]), r"nodes\[0\] hangs below itself"),
        (setting("nodes", 0, "mesh", to=1), r"node 'cube' refers to meshes\[1\]"),
        (setting("nodes", 0, "mesh", to=True), r"node 'cube' refers to meshes\[True\]"),
        (setting("nodes", 0, "matrix", to=[1.0] * 15), "node 'cube'.matrix is .* must be 16 numbers"),
        (setting("nodes", 0, "matrix", to=[1.0] * 16), "ends in the row"),
        (setting("nodes", 0, "scale", to=[1, 1, "a"]), r"node 'cube'\.scale\[2\] is 'a'"),
        (setting("nodes", 0, "rotation", to=[0, 0, 0, 0]), r"node 'cube'\.rotation: .* length 0"),
        (setting("nodes", 0, "translation", to=[1e300, 0, 0]), "object 'cube' is placed or scaled beyond"),
        (setting("nodes", 0, "translation", to=[float("nan"), 0, 0]), r"node 'cube'\.translation\[0\] is nan"),
        (setting("meshes", 0, "primitives", to=None), r"meshes\[0\]\.primitives must be a list"),
        (setting("meshes", 0, "primitives", 0, "attributes", to=[]), "node 'cube', meshes.0..attributes must be"),
        (setting("meshes", 0, "primitives", 0, "mode", to=-1), r"mode is -1"),
        (setting("meshes", 0, "primitives", 0, "indices", to=0), "indices must be unsigned scalars"),
        (setting("meshes", 0, "primitives", 0, "attributes", "POSITION", to=1), "positions are 'SCALAR'"),
        (setting("meshes", 0, "primitives", 0, "material", to=0), r"materials\[0\]; the file has 0 materials"),
        (setting("accessors", 0, "count", to=10**9), r"accessors\[0\]\.count / 3 is 333,333,333.*MAX_TRIANGLES"),
        (setting("accessors", 0, "count", to=10**6), r"wants bytes 0 to 12000000 of a buffer view of 96 bytes"),
        (setting("accessors", 0, "count", to=0), r"count is 0; it must be a whole number from 1"),
        (setting("accessors", 0, "count", to=2.5), r"count is 2\.5"),
        (setting("accessors", 0, "componentType", to=5124), "componentType is 5124"),
        (setting("accessors", 0, "type", to="VEC5"), "type is 'VEC5'"),
        (setting("accessors", 0, "byteOffset", to=-4), "byteOffset is -4"),
        (setting("accessors", 0, "bufferView", to=9), r"bufferViews\[9\]; the file has 3"),
        (setting("accessors", 1, "componentType", to=5125), "wants bytes 0 to 144 of a buffer view of 72"),
        (setting("accessors", 0, "sparse", to=[]), r"accessors\[0\]\.sparse must be an object"),
        (setting("accessors", 0, "sparse", to=SPARSE), r"accessors\[0\]\.sparse replaces value 65535; there are 8"),
        (setting("accessors", 0, to=ONE_TOO_FAR), r"accessors\[0\]\.sparse replaces value 7; there are 7"),
        (setting("bufferViews", 0, "byteLength", to=10**9), r"bufferViews\[0\] wants bytes 0 to 1000000000"),
        (setting("bufferViews", 0, "byteStride", to=4), "wants bytes"),
        (setting("bufferViews", 0, "buffer", to="0"), r"buffers\['0'\]; the file has 1"),
        (setting("buffers", 0, "byteLength", to=10**6), r"buffers\[0\] has 172 bytes, the header promises 1000000"),
        (setting("buffers", 0, "uri", to=5), r"buffers\[0\]\.uri is 5"),
        (setting("buffers", 0, "uri", to="data:;base64,@@"), "data: URI cannot be decoded"),
        (setting("buffers", 0, "uri", to="data:,plain"), "only base64 data is understood"),
        (setting("buffers", 0, "uri", to="gone.bin"), "there is no file '.*gone.bin'"),
        (setting("buffers", 0, "uri", to="."), "is not a file"),
        (
            setting("extensionsRequired", to=["EXT_mesh_gpu_instancing", "KHR_gone", "VRMC_vrm"]),
            "requires KHR_gone, VRMC_vrm",
        ),
        (setting("extensionsRequired", to="x"), "extensionsRequired must be a list"),
        (setting("nodes", to=[{"name": "camera"}]), "holds no triangles"),
    ],
)
def test_broken_gltf_raises_a_scene_error(tmp_path: Path, change: Callable[[Json], object], sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        load_scene(broken(tmp_path, change))


def test_a_vertex_that_is_not_finite_names_its_node(tmp_path: Path) -> None:
    gltf = Gltf()
    points = CUBE.copy()
    points[5, 1] = np.nan
    mesh = gltf.mesh({"attributes": {"POSITION": gltf.accessor(points, "f4", "VEC3")}, "mode": 5})
    gltf.node("kettle", mesh=mesh, root=True)
    with pytest.raises(SceneError, match=r"node 'kettle', meshes\[0\]: vertex 5 is \[1\.0, nan, 1\.0\]"):
        load_scene(gltf.write(tmp_path / "scene.glb"))


def test_vertices_at_extreme_distances_are_refused(tmp_path: Path) -> None:
    gltf = Gltf()
    mesh = gltf.mesh({"attributes": {"POSITION": gltf.accessor(CUBE * 1e9, "f4", "VEC3")}, "mode": 5})
    gltf.node("kettle", mesh=mesh, root=True)
    with pytest.raises(SceneError, match=r"'kettle' reaches 1e\+09 m from its node"):
        load_scene(gltf.write(tmp_path / "scene.glb"))


def test_cyclic_nodes_are_refused(tmp_path: Path) -> None:
    gltf = one_cube()
    gltf.node("a", children=[2])
    gltf.node("b", children=[1])
    gltf.header["scenes"][0]["nodes"].append(1)
    with pytest.raises(SceneFormatError, match=r"nodes\[1\] hangs below itself"):
        load_scene(gltf.write(tmp_path / "scene.glb"))


def test_depth_of_nodes_is_limited(tmp_path: Path) -> None:
    def chain(length: int) -> Path:
        gltf = Gltf()
        number = gltf.node("end", mesh=gltf.cube())
        for _ in range(length - 2):
            number = gltf.node("link", children=[number])
        gltf.node("start", children=[number], root=True)
        return gltf.write(tmp_path / "scene.glb")

    assert [item.id for item in load_scene(chain(limits.MAX_DEPTH)).objects] == ["start"]
    with pytest.raises(SceneError, match=r"depth of the node tree is 201; .*MAX_DEPTH"):
        load_scene(chain(limits.MAX_DEPTH + 1))


@pytest.mark.parametrize(
    ("limit", "value", "what"),
    [
        ("MAX_FILE_BYTES", 500, "size of 'scene.glb' in bytes"),
        ("MAX_NODES", 2, "number of nodes"),
        ("MAX_TRIANGLES", 36, "number of triangles"),
    ],
)
def test_error_names_the_exceeded_limit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limit: str, value: int, what: str
) -> None:
    gltf = one_cube("a")
    for name in ("b", "c", "d"):
        gltf.node(name, mesh=0, root=True)
    path = gltf.write(tmp_path / "scene.glb")
    assert len(load_scene(path).objects) == 4
    monkeypatch.setattr(limits, limit, value)
    with pytest.raises(SceneError, match=rf"{what} is .*at most {value} \(scene2hap\.scene\.limits\.{limit}\)"):
        load_scene(path)


@pytest.mark.parametrize("uri", ["../secret.bin", "folder/../../secret.bin", "%2e%2e/secret.bin", "/etc/hostname"])
def test_a_buffer_outside_the_root_is_refused_by_name(tmp_path: Path, uri: str) -> None:
    home = tmp_path / "home"
    home.mkdir()
    gltf = one_cube()
    (tmp_path / "secret.bin").write_bytes(bytes(gltf.buffer))
    gltf.header["buffers"][0]["uri"] = uri
    (home / "scene.gltf").write_text(json.dumps(gltf.header), encoding="utf-8")
    with pytest.raises(SceneError, match=rf"buffers\[0\] wants '{uri}', which lies outside .*give assets_root"):
        load_scene(home / "scene.gltf")


def test_wider_assets_root_allows_the_buffer(tmp_path: Path) -> None:
    home = tmp_path / "home"
    home.mkdir()
    gltf = one_cube()
    (tmp_path / "shared.bin").write_bytes(bytes(gltf.buffer))
    gltf.header["buffers"][0]["uri"] = "../shared.bin"
    (home / "scene.gltf").write_text(json.dumps(gltf.header), encoding="utf-8")
    assert len(load_scene(home / "scene.gltf", assets_root=tmp_path).objects) == 1


@needs_links
def test_symbolic_link_out_of_the_root_is_refused(tmp_path: Path) -> None:
    home = tmp_path / "home"
    home.mkdir()
    gltf = one_cube()
    (tmp_path / "secret.bin").write_bytes(bytes(gltf.buffer))
    (home / "scene.bin").symlink_to(tmp_path / "secret.bin")
    gltf.header["buffers"][0]["uri"] = "scene.bin"
    (home / "scene.gltf").write_text(json.dumps(gltf.header), encoding="utf-8")
    with pytest.raises(SceneError, match="outside"):
        load_scene(home / "scene.gltf")


@pytest.mark.parametrize("uri", ["http://example.org/scene.bin", "file:///etc/hostname", "//host/scene.bin"])
def test_urls_are_never_fetched(tmp_path: Path, uri: str) -> None:
    with pytest.raises(SceneError, match="never fetched"):
        load_scene(broken(tmp_path, setting("buffers", 0, "uri", to=uri)))


@pytest.mark.parametrize("uri", ["a\0b", "x" * 5000, "http://[broken"])
def test_invalid_file_name_is_refused(tmp_path: Path, uri: str) -> None:
    with pytest.raises(SceneError):
        load_scene(broken(tmp_path, setting("buffers", 0, "uri", to=uri)))


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("text.glb", b"a shopping list", "'text.glb' is no GLB: it starts with b'a sh'"),
        ("picture.glb", b"\x89PNG\r\n\x1a\n" + bytes(50), "is no GLB: it starts with"),
        ("picture.gltf", b"\x89PNG\r\n\x1a\n" + bytes(50), "its JSON cannot be read"),
        ("empty.glb", b"", "is empty"),
        ("empty.gltf", b"", "is empty"),
        ("short.glb", b"glTF\2\0\0\0", "cut short before its first chunk"),
        ("old.glb", struct.pack("<4sIIII", b"glTF", 1, 20, 0, 0), "GLB version 1"),
        ("lies.glb", struct.pack("<4sIIII", b"glTF", 2, 99, 0, 0), "says it has 99 bytes and has 20: cut short"),
        ("chunk.glb", struct.pack("<4sIIII", b"glTF", 2, 20, 1 << 31, 0), "chunk at byte 12 runs past the end"),
        ("nothing.glb", struct.pack("<4sIIII", b"glTF", 2, 20, 0, 1), "without a JSON chunk"),
        ("list.gltf", b"[]", "its JSON is a list, not an object"),
        ("deep.gltf", b"[" * 200_000, "its JSON cannot be read"),
        ("digits.gltf", b'{"a": ' + b"1" * 5000 + b"}", "its JSON cannot be read"),
        ("latin.gltf", b'{"asset": "\xff"}', "its JSON cannot be read"),
    ],
)
def test_files_that_are_not_gltf_are_refused(tmp_path: Path, name: str, content: bytes, sentence: str) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(SceneFormatError, match=sentence):
        load_scene(tmp_path / name)


def test_a_buffer_without_bytes_anywhere_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "scene.gltf"
    path.write_text(json.dumps(one_cube().header), encoding="utf-8")
    with pytest.raises(SceneFormatError, match="has no binary chunk"):
        load_scene(path)


# -- Draco -----------------------------------------------------------------------------------------------------------


def compressed_cube() -> Gltf:
    import DracoPy

    from gltf_builder import CUBE_FACES

    gltf = Gltf()
    data = DracoPy.encode(CUBE.astype(np.float32), faces=CUBE_FACES.astype(np.uint32), quantization_bits=14)
    view = gltf.view(np.frombuffer(data, np.uint8), "<u1")
    gltf.header["accessors"] = [
        {"componentType": 5126, "type": "VEC3", "count": 8},
        {"componentType": 5123, "type": "SCALAR", "count": 36},
    ]
    draco = {"KHR_draco_mesh_compression": {"bufferView": view, "attributes": {"POSITION": 0}}}
    mesh = gltf.mesh({"attributes": {"POSITION": 0}, "indices": 1, "extensions": draco})
    gltf.header["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    gltf.node("cube", mesh=mesh, root=True)
    return gltf


def test_draco_is_decoded(tmp_path: Path) -> None:
    item = load_scene(compressed_cube().write(tmp_path / "scene.glb")).object("cube")
    # Quantisation to 14 bits: errors up to half a step of 1 / (2^14 - 1).
    np.testing.assert_allclose(item.bounds_m, [[0.0] * 3, [1.0] * 3], atol=3.1e-5)
    assert len(item.geometry.mesh.faces) == 12


def test_draco_without_decoder_is_refused_with_the_install_command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = compressed_cube().write(tmp_path / "scene.glb")
    monkeypatch.setitem(sys.modules, "DracoPy", None)
    with pytest.raises(MissingExtra, match="node 'cube'.*pip install DracoPy") as caught:
        load_scene(path)
    assert isinstance(caught.value, ConfigError | ImportError)


def test_broken_draco_is_refused(tmp_path: Path) -> None:
    gltf = compressed_cube()
    gltf.buffer[:] = bytes(len(gltf.buffer))
    with pytest.raises(SceneFormatError, match="Draco data cannot be decoded, by its header: it must be a mesh"):
        load_scene(gltf.write(tmp_path / "scene.glb"))


# -- in bulk ---------------------------------------------------------------------------------------------------------


def small_room() -> Gltf:
    """A file of three nodes, two meshes and a material, to be damaged."""
    gltf = Gltf()
    gltf.header["materials"] = [{"name": "oak"}]
    leaf = gltf.node("door", mesh=gltf.cube(), translation=[0.0, 0.0, 1.0])
    gltf.node("cupboard", mesh=gltf.cube(material=0), children=[leaf], matrix=np.eye(4).ravel().tolist(), root=True)
    gltf.node("cup", mesh=0, rotation=[0.0, 0.6, 0.0, 0.8], scale=[0.1, 0.1, 0.1], root=True)
    return gltf


def outcome(path: Path) -> str:
    """Load a file. Returns "ok" or the name of the library's error; any other error fails the test."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UnitWarning)
        try:
            load_scene(path)
        except Scene2HapError as error:
            return type(error).__name__
    return "ok"


def test_a_file_cut_short_anywhere_is_refused(tmp_path: Path) -> None:
    data = small_room().glb()
    path = tmp_path / "scene.glb"
    for length in range(0, len(data), 7):
        path.write_bytes(data[:length])
        with pytest.raises(SceneFormatError):
            load_scene(path)


def test_changed_bytes_raise_only_scene_errors(tmp_path: Path) -> None:
    data = small_room().glb()
    path = tmp_path / "scene.glb"
    rng = np.random.default_rng(20)
    outcomes = set()
    for _ in range(150):
        mutated = np.frombuffer(data, np.uint8).copy()
        at = rng.integers(20, len(mutated), size=rng.integers(1, 4))
        # Digits and brackets often keep the header readable, with changed values.
        mutated[at] = rng.choice(np.frombuffer(b'0123456789-,.[]{}":e', np.uint8), size=len(at))
        path.write_bytes(mutated.tobytes())
        outcomes.add(outcome(path))
    assert {"ok", "SceneFormatError"} <= outcomes <= {"ok", "SceneFormatError", "SceneError"}


def test_changed_values_raise_only_scene_errors(tmp_path: Path) -> None:
    room = small_room()
    odd: list[Any] = [
        None,
        True,
        -1,
        0,
        7,
        1e308,
        -1e-308,
        2**63,
        float("nan"),
        "",
        "x",
        [],
        {},
        [0],
        [1e308] * 16,
        [0] * 4,
    ]
    rng = np.random.default_rng(21)
    outcomes = set()
    for _ in range(150):
        header = copy.deepcopy(room.header)
        place: Any = header
        while True:
            keys = list(place) if isinstance(place, dict) else list(range(len(place)))
            key = keys[rng.integers(len(keys))]
            if not isinstance(place[key], dict | list) or not place[key] or rng.random() < 0.1:
                break
            place = place[key]
        place[key] = odd[rng.integers(len(odd))]
        (tmp_path / "scene.glb").write_bytes(glb_bytes(header, bytes(room.buffer)))
        outcomes.add(outcome(tmp_path / "scene.glb"))
    assert {"ok", "SceneFormatError"} <= outcomes <= {"ok", "SceneFormatError", "SceneError"}
