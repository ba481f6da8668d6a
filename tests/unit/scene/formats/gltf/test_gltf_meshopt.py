"""glTF compressed with meshopt gives the uncompressed scene; broken data raises errors of the library."""

from __future__ import annotations

import base64
import copy
import json
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_builder import CUBE, CUBE_FACES, Gltf, glb_bytes
from gltf_reading import header_and_buffer
from laundry import IDS
from scene2hap import SceneSnapshot, load_scene
from scene2hap.errors import Scene2HapError, SceneError, SceneFormatError
from scene2hap.scene.formats.gltf import meshopt_codec, meshopt_filters

DATA = Path(__file__).parents[4] / "data" / "meshopt"
STREAMS: list[dict[str, Any]] = json.loads((DATA / "streams.json").read_text(encoding="utf-8"))
EXT = "EXT_meshopt_compression"
# A step of gltfpack's 14 bits over the 3 m of the laundry, and of 15 bits of mantissa, in metres.
STEP_M = {"exact": 1e-6, "quantised": 2e-4, "khr": 2e-4, "floats": 1e-4, "gltf_transform": 2e-4}


def decoded(row: dict[str, Any], data: bytes) -> bytes:
    count, stride = row["count"], row["stride"]
    if row["mode"] == "ATTRIBUTES":
        elements = meshopt_codec.attributes(data, count, stride)
        return (elements if row["filter"] == "NONE" else meshopt_filters.filtered(elements, row["filter"])).tobytes()
    decode = meshopt_codec.triangles if row["mode"] == "TRIANGLES" else meshopt_codec.indices
    return decode(data, count).astype(f"<u{stride}").tobytes()


# -- the data --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("row", STREAMS, ids=lambda row: f"{row['name']} {row['filter']} {row['stride']}")
def test_decoded_data_equals_that_of_the_reference_decoder(row: dict[str, Any]) -> None:
    ours, theirs = decoded(row, base64.b64decode(row["data"])), base64.b64decode(row["decoded"])
    if row["filter"] == "OCTAHEDRAL" and row["stride"] == 8:
        # The reference decoder rounds in single precision.
        a, b = np.frombuffer(ours, "<i2").astype(int), np.frombuffer(theirs, "<i2").astype(int)
        assert np.abs(a - b).max() <= 1
    else:
        assert ours == theirs


@pytest.mark.parametrize("row", STREAMS[::3], ids=lambda row: f"{row['name']} {row['stride']}")
def test_data_cut_short_anywhere_is_refused(row: dict[str, Any]) -> None:
    data = base64.b64decode(row["data"])
    for length in range(len(data)):
        # Indices state no length: they end four bytes before the end of the data.
        with pytest.raises(ValueError, match=r"begin|cut short|end at|of data|in data"):
            decoded(row, data[:length])


def packed(values: NDArray[Any]) -> bytes:
    """Encode attributes (n, stride) of bytes, with every group of 16 stored uncompressed."""
    n, stride = values.shape
    before = np.concatenate((values[:1], values[:-1]))
    steps = (values - before).astype(np.uint8)
    coded = np.where(steps < 128, steps.astype(int) * 2, (255 - steps.astype(int)) * 2 + 1).astype(np.uint8)
    out, per_block = bytearray(b"\xa0"), min(8192 // stride // 16 * 16, 256)
    for begin in range(0, n, per_block):
        block = coded[begin : begin + per_block]
        block = np.concatenate((block, np.zeros((-len(block) % 16, stride), np.uint8)))
        for channel in block.T:
            out += b"\xff" * -(-len(block) // 64) + channel.tobytes()
    return bytes(out) + bytes(max(32 - stride, 0)) + values[0].tobytes()


@pytest.mark.parametrize("n", [1, 16, 255, 257, 5000])
@pytest.mark.parametrize("stride", [4, 20, 256])
def test_attributes_of_several_blocks_are_decoded(n: int, stride: int) -> None:
    values = np.random.default_rng(n + stride).integers(0, 256, (n, stride), dtype=np.uint8)
    np.testing.assert_array_equal(meshopt_codec.attributes(packed(values), n, stride), values)


def test_vertex_counter_continues_across_triangle_batches() -> None:
    """A strip with more triangles than one batch decodes; the third vertex of each triangle is new."""
    n = 70_000
    codes = bytes([0xF0]) + bytes([0x00]) * (n - 1)
    data = b"\xe1" + codes + bytes(16)
    rows = meshopt_codec.triangles(data, 3 * n).reshape(n, 3)
    np.testing.assert_array_equal(rows[:, 2], np.arange(2, n + 2))
    # Each triangle shares the newest edge of its predecessor.
    np.testing.assert_array_equal(rows[1:, 0], rows[:-1, 0])
    np.testing.assert_array_equal(rows[1:, 1], rows[:-1, 2])


# -- scenes ----------------------------------------------------------------------------------------------------------


def plain() -> SceneSnapshot:
    return load_scene(DATA / "plain.glb")


@pytest.mark.parametrize("name", STEP_M)
def test_compressed_scene_equals_the_plain_scene(name: str) -> None:
    step_m, before, after = STEP_M[name], plain(), load_scene(DATA / f"{name}.glb")
    assert [item.id for item in after.objects] == IDS
    assert [item.name for item in after.objects] == [item.name for item in before.objects]
    for old, new in zip(before.objects, after.objects, strict=True):
        np.testing.assert_allclose(new.pose.position_m, old.pose.position_m, atol=1e-6)
        np.testing.assert_allclose(new.pose.rotation, old.pose.rotation, atol=1e-6)
        np.testing.assert_allclose(new.bounds_m, old.bounds_m, atol=step_m)
        assert len(new.geometry.mesh.faces) == len(old.geometry.mesh.faces)
        assert new.relative_height_m == pytest.approx(old.relative_height_m, abs=2 * step_m)
    for key in ("floor", "washing_machine"):
        sizes = [
            (s.length_m, s.width_m, s.thickness_m) for s in (before.object(key).surface, after.object(key).surface)
        ]
        np.testing.assert_allclose(sizes[0], sizes[1], atol=2 * step_m)
    assert after.object("cup").instance_key == after.object("cup_2").instance_key


@pytest.mark.parametrize("name", STEP_M)
def test_compressed_scene_keeps_its_appearance(name: str) -> None:
    before, after = plain(), load_scene(DATA / f"{name}.glb")
    for key in IDS:
        old, new = before.object(key).appearance, after.object(key).appearance
        assert old is not None
        assert new is not None
        if key != "ball":  # has a colour for each face, in another order
            assert {material.digest for material in new.materials} == {material.digest for material in old.materials}
        assert (new.uv is None) == (old.uv is None)
        if old.uv is not None and new.uv is not None:
            np.testing.assert_allclose(np.sort(new.uv.ravel()), np.sort(old.uv.ravel()), atol=1e-3)


def header_of(name: str) -> tuple[dict[str, Any], bytes]:
    return header_and_buffer(DATA / f"{name}.glb")


def test_fallback_buffer_is_not_opened(tmp_path: Path) -> None:
    header, binary = header_of("quantised")
    assert header["buffers"][1]["extensions"][EXT] == {"fallback": True}
    header["buffers"][1]["uri"] = "is_not_there.bin"
    (tmp_path / "scene.glb").write_bytes(glb_bytes(header, binary))
    assert [item.id for item in load_scene(tmp_path / "scene.glb").objects] == IDS


def test_external_buffers_are_read_from_files(tmp_path: Path) -> None:
    header, binary = header_of("exact")
    header["buffers"][0]["uri"] = "packed.bin"
    (tmp_path / "packed.bin").write_bytes(binary)
    (tmp_path / "scene.gltf").write_text(json.dumps(header), encoding="utf-8")
    assert [item.id for item in load_scene(tmp_path / "scene.gltf").objects] == IDS


# -- nodes that only scale -------------------------------------------------------------------------------------------


def quantised_cupboard(**node: Any) -> Gltf:
    """A cupboard and its door with integer vertices, each mesh below a scaling node, as gltfpack writes them."""
    gltf = Gltf()
    points = gltf.accessor(CUBE * 100, "u2", "VEC3")
    order = gltf.accessor(CUBE_FACES.reshape(-1), "u2", "SCALAR")
    mesh = gltf.mesh({"attributes": {"POSITION": points}, "indices": order})
    scale = {"translation": [-0.5, 0.0, 0.0], "scale": [0.01, 0.01, 0.01]}
    leaf = gltf.node(mesh=mesh, **scale)
    door = gltf.node("door", children=[leaf], translation=[0.0, 0.0, 1.0])
    body = gltf.node(mesh=mesh, **{**scale, **node})
    gltf.node("cupboard", children=[body, door], translation=[2.0, 0.0, 0.0], root=True)
    return gltf


def test_scale_only_node_is_merged_into_its_parent(tmp_path: Path) -> None:
    (item,) = load_scene(quantised_cupboard().write(tmp_path / "scene.glb")).objects
    assert item.id == "cupboard"
    assert item.pose.position_m == (2.0, 0.0, 0.0)
    np.testing.assert_allclose(item.bounds_m, [[1.5, 0.0, 0.0], [2.5, 1.0, 2.0]], atol=1e-9)


@pytest.mark.parametrize("node", [{"name": "body"}, {"rotation": [0.0, 0.6, 0.0, 0.8]}, {"scale": [-0.01, 0.01, 0.01]}])
def test_node_with_name_rotation_or_mirroring_is_not_merged(tmp_path: Path, node: dict[str, Any]) -> None:
    gltf = quantised_cupboard(**node)
    assert "cupboard" not in {item.id for item in load_scene(gltf.write(tmp_path / "scene.glb")).objects[1:]}
    assert len(load_scene(gltf.write(tmp_path / "scene.glb"), group="leaf").objects) == 2


@pytest.mark.parametrize(
    "broken", [{"mode": 0}, {"mode": 0, "attributes": []}, {"mode": 0, "attributes": {"POSITION": 99}}]
)
def test_invalid_undrawn_points_are_ignored(tmp_path: Path, broken: dict[str, Any]) -> None:
    gltf = quantised_cupboard()
    gltf.header["meshes"][0]["primitives"].append(broken)
    assert load_scene(gltf.write(tmp_path / "scene.glb")).objects[0].id == "cupboard"


def test_many_scaled_copies_of_one_mesh_are_refused(tmp_path: Path) -> None:
    gltf = Gltf()
    grid = np.stack(np.meshgrid(*[np.arange(20)] * 3), axis=-1).reshape(-1, 3)
    points = gltf.accessor(grid, "u1", "VEC3")
    mesh = gltf.mesh({"attributes": {"POSITION": points}, "mode": 5})
    for i in range(200):
        leaf = gltf.node(mesh=mesh, scale=[1.0, 1.0, 1.0 + i])
        gltf.node(f"n{i}", children=[leaf], root=True)
    with pytest.raises(SceneError, match="a node that scales a quantised mesh brings the numbers"):
        load_scene(gltf.write(tmp_path / "scene.glb"))


# -- faults ----------------------------------------------------------------------------------------------------------


def changed(view: int, **fields: Any) -> Callable[[dict[str, Any]], None]:
    return lambda header: header["bufferViews"][view]["extensions"][EXT].update(fields)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (changed(1, mode="POINTS"), r"its meshopt data cannot be decoded: mode 'POINTS'"),
        (changed(1, mode=None), "mode None; it must be ATTRIBUTES"),
        (changed(1, mode="TRIANGLES", byteStride=2), r"triangles begin with b'\\xa0'|multiple of 3"),
        (changed(1, byteStride=6), "attributes of 6 bytes"),
        (changed(1, byteStride=0), r"byteStride is 0; it must be a whole number from 1"),
        (changed(1, byteStride=256), "attributes"),
        (changed(1, count=0), r"count is 0; it must be a whole number from 1"),
        (changed(1, count=10**8), r"EXT_meshopt_compression\.count is 100,000,000; .*MAX_TRIANGLES"),
        (changed(1, count=9 * 10**6), "brings the bytes of its packed views to"),
        (changed(1, count=3000), "attributes (are cut short|end at)"),
        (changed(1, count=3), "attributes end at byte|wants bytes"),
        (changed(1, filter="BLUR"), "filter 'BLUR'; it must be NONE, OCTAHEDRAL"),
        (changed(1, filter="QUATERNION", byteStride=4), "filter QUATERNION of elements of 4 bytes|attributes"),
        (changed(1, buffer=7), r"refers to buffers\[7\]; the file has 2"),
        (changed(1, buffer=1), r"buffers\[1\] names no file"),
        (changed(1, byteOffset=-1), "byteOffset is -1"),
        (changed(1, byteLength=10**6), r"wants bytes \d+ to \d+ of a buffer of"),
        (changed(1, byteLength=9), "cut short"),
        (changed(1, byteLength=0), "attributes begin with b''"),
        (
            lambda header: header["bufferViews"][1].update(byteLength=10**6),
            r"bufferViews\[1\] wants bytes 0 to 1000000",
        ),
        (lambda header: header["bufferViews"][1].update(extensions={EXT: 7}), r"names no file"),
    ],
)
def test_broken_compression_raises_a_scene_error(
    tmp_path: Path, change: Callable[[dict[str, Any]], None], sentence: str
) -> None:
    header, binary = header_of("quantised")
    # gltfpack stores the picture first; swap views, so that view 1 is compressed.
    view = next(i for i, row in enumerate(header["bufferViews"]) if EXT in row.get("extensions", {}))
    header["bufferViews"][1], header["bufferViews"][view] = header["bufferViews"][view], header["bufferViews"][1]
    for row in header["accessors"]:
        row["bufferView"] = {1: view, view: 1}.get(row["bufferView"], row["bufferView"])
    change(header)
    (tmp_path / "scene.glb").write_bytes(glb_bytes(header, binary))
    with pytest.raises(SceneError, match=sentence):
        load_scene(tmp_path / "scene.glb")


def packed_cubes(n_views: int, count: int) -> bytes:
    """A file of cubes whose points are zeros, `count` from each of `n_views` compressed views."""
    stride, gltf = 16, Gltf()
    n_blocks = -(-count // 256)
    # A block of zeros: four bytes of headers for each of 16 channels.
    data = b"\xa0" + bytes(4 * stride * n_blocks) + bytes(32)
    view = gltf.view(np.frombuffer(data, np.uint8), "u1")
    stored = gltf.header["bufferViews"][view]
    row = {"buffer": 0, "byteOffset": 0, "byteLength": len(data), "byteStride": stride, "mode": "ATTRIBUTES"}
    extension = {EXT: {**row, "count": count}}
    view_row = {"buffer": 0, "byteOffset": 0, "byteLength": count * stride, "byteStride": stride}
    gltf.header["bufferViews"] = [stored, *[{**view_row, "extensions": extension}] * n_views]
    order = gltf.accessor(CUBE_FACES.reshape(-1), "u2", "SCALAR")
    for i in range(n_views):
        accessor = {"bufferView": i + 1, "componentType": 5126, "type": "VEC3", "count": count}
        gltf.header["accessors"].append(accessor)
        mesh = gltf.mesh({"attributes": {"POSITION": len(gltf.header["accessors"]) - 1}, "indices": order})
        gltf.node(f"n{i}", mesh=mesh, root=True)
    return gltf.glb()


@pytest.mark.parametrize(("n_views", "count"), [(1, 2 * 10**6), (1000, 20_480), (40, 65_536)])
def test_decompressed_size_is_limited(tmp_path: Path, n_views: int, count: int) -> None:
    (tmp_path / "scene.glb").write_bytes(packed_cubes(n_views, count))
    with pytest.raises(SceneError, match="packed views to|numbers in its accessors to"):
        load_scene(tmp_path / "scene.glb")


def outcome(path: Path) -> str:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        try:
            load_scene(path)
        except Scene2HapError as error:
            return type(error).__name__
    return "ok"


def test_changed_data_raises_only_scene_errors(tmp_path: Path) -> None:
    header, binary = header_of("khr")
    path, rng, outcomes = tmp_path / "scene.glb", np.random.default_rng(7), set()
    for _ in range(60):
        data = np.frombuffer(binary, np.uint8).copy()
        at = rng.integers(0, len(data), size=rng.integers(1, 10))
        data[at] = rng.integers(0, 256, size=len(at))
        path.write_bytes(glb_bytes(header, data.tobytes()))
        outcomes.add(outcome(path))
    assert {"ok", "SceneFormatError"} <= outcomes <= {"ok", "SceneFormatError", "SceneError"}


def test_changed_extensions_raise_only_scene_errors(tmp_path: Path) -> None:
    header, binary = header_of("quantised")
    odd = [None, True, -1, 0, 1, 2.5, 7, 2**31, 2**63, 1e308, "", "TRIANGLES", "INDICES", "COLOR", [], {}]
    path, rng, outcomes = tmp_path / "scene.glb", np.random.default_rng(8), set()
    for _ in range(60):
        mutated = copy.deepcopy(header)
        views = [row for row in mutated["bufferViews"] if "extensions" in row]
        place = views[rng.integers(len(views))]
        place = place["extensions"][EXT] if rng.random() < 0.8 else place
        keys = list(place)
        place[keys[rng.integers(len(keys))]] = odd[rng.integers(len(odd))]
        path.write_bytes(glb_bytes(mutated, binary))
        outcomes.add(outcome(path))
    assert {"ok", "SceneFormatError"} <= outcomes <= {"ok", "SceneFormatError", "SceneError"}


def test_indices_beyond_the_vertices_are_refused(tmp_path: Path) -> None:
    header, binary = header_of("exact")
    for row in header["accessors"]:
        if row["type"] == "VEC3":
            row["count"] = 3
    (tmp_path / "scene.glb").write_bytes(glb_bytes(header, binary))
    with pytest.raises(SceneFormatError, match="a face uses vertex"):
        load_scene(tmp_path / "scene.glb")
