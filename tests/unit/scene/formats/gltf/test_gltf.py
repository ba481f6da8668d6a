"""glTF and GLB: a snapshot equals its file bit for bit and node for node."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pytest

from gltf_builder import CUBE, CUBE_FACES, Gltf, one_cube
from scene2hap.common.warning import SceneWarning
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.gltf.accessors import unpacked
from scene2hap.scene.formats.gltf.reader import read_gltf
from scene2hap.scene.load import load_scene
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.shapes import TriMesh
from scene2hap.scene.tree import AuthoredNode


def read(gltf: Gltf, folder: Path, name: str = "scene.glb") -> AuthoredNode:
    """The only root of the file."""
    (root,) = read_gltf(gltf.write(folder / name), folder).roots
    return root


def triangles(item: SceneObject) -> set[tuple[tuple[float, ...], ...]]:
    """World triangles, each beginning with its smallest corner, so that only the winding is left to compare."""
    mesh = item.geometry.mesh
    corners = np.round(item.pose.to_world(mesh.vertices_m), 9)[mesh.faces].tolist()
    turned = []
    for corner in corners:
        start = corner.index(min(corner))
        turned.append(tuple(tuple(corner[(start + k) % 3]) for k in range(3)))
    return set(turned)


@pytest.mark.parametrize("name", ["cube.glb", "cube.gltf", "CUBE.GLB"])
def test_a_cube_is_read_bit_for_bit(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    if name.isupper():
        path.write_bytes(one_cube().glb())
    else:
        one_cube().write(path)
    (root,) = read_gltf(path, tmp_path).roots
    np.testing.assert_array_equal(root.pieces[0].vertices, CUBE)
    np.testing.assert_array_equal(root.pieces[0].faces, CUBE_FACES)


def test_a_buffer_may_stand_in_the_header(tmp_path: Path) -> None:
    gltf = one_cube()
    gltf.header["buffers"][0]["uri"] = gltf.data_uri()
    path = tmp_path / "cube.gltf"
    path.write_text("\ufeff" + json.dumps(gltf.header), encoding="utf-8")
    assert load_scene(path).object("cube").size_m == pytest.approx((1.0, 1.0, 1.0))


@pytest.mark.parametrize(
    ("uri", "stored"), [("my%20parts/a+b.bin", "my parts/a+b.bin"), ("my parts\\a.bin", "my parts/a.bin")]
)
def test_a_file_name_in_the_header_may_be_quoted_and_have_either_slash(tmp_path: Path, uri: str, stored: str) -> None:
    """Exporters on Windows write backslashes, which browsers read as slashes."""
    gltf = one_cube()
    gltf.header["buffers"][0]["uri"] = uri
    path = gltf.write(tmp_path / "cube.gltf")
    (tmp_path / stored).parent.mkdir(exist_ok=True)
    (tmp_path / "cube.bin").rename(tmp_path / stored)
    assert len(load_scene(path).objects) == 1


def test_of_several_binary_chunks_the_first_is_read(tmp_path: Path) -> None:
    data = one_cube().glb()
    data += struct.pack("<I", 64) + b"BIN\0" + bytes(64)
    path = tmp_path / "cube.glb"
    path.write_bytes(data[:8] + struct.pack("<I", len(data)) + data[12:])
    np.testing.assert_array_equal(load_scene(path).objects[0].bounds_m, [[0, 0, 0], [1, 1, 1]])


def test_interleaved_vertices_are_read_by_stride(tmp_path: Path) -> None:
    gltf = Gltf()
    interleaved = np.hstack((CUBE, np.full((8, 3), 77.0)))
    view = gltf.view(interleaved, "<f4", byteStride=24)
    accessor = {"bufferView": view, "componentType": 5126, "type": "VEC3", "count": 8}
    gltf.header["accessors"].append(accessor)
    indices = gltf.accessor(CUBE_FACES.reshape(-1), "u1", "SCALAR")
    gltf.node("cube", mesh=gltf.mesh({"attributes": {"POSITION": 0}, "indices": indices}), root=True)
    np.testing.assert_array_equal(read(gltf, tmp_path).pieces[0].vertices, CUBE)


@pytest.mark.parametrize(("dtype", "largest"), [("i1", 127), ("u1", 255), ("i2", 32767), ("u2", 65535)])
def test_quantised_positions_are_scaled_to_one(tmp_path: Path, dtype: str, largest: int) -> None:
    gltf = Gltf()
    gltf.header["extensionsRequired"] = ["KHR_mesh_quantization"]
    positions = gltf.accessor(CUBE * largest, dtype, "VEC3", normalized=True)
    indices = gltf.accessor(CUBE_FACES.reshape(-1), "u2", "SCALAR")
    gltf.node("cube", mesh=gltf.mesh({"attributes": {"POSITION": positions}, "indices": indices}), root=True)
    np.testing.assert_array_equal(read(gltf, tmp_path).pieces[0].vertices, CUBE)


def test_a_quantised_mesh_that_is_mirrored_faces_outwards(tmp_path: Path) -> None:
    gltf = Gltf()
    gltf.header["extensionsRequired"] = ["KHR_mesh_quantization"]
    positions = gltf.accessor(CUBE * 255, "u1", "VEC3", normalized=True)
    indices = gltf.accessor(CUBE_FACES.reshape(-1), "u2", "SCALAR")
    mesh = gltf.mesh({"attributes": {"POSITION": positions}, "indices": indices})
    gltf.node("lamp", children=[gltf.node(None, mesh=mesh, scale=[-0.5, 0.5, 0.5])], root=True)
    item = load_scene(gltf.write(tmp_path / "scene.glb")).objects[0]
    a, b, c = (item.pose.to_world(item.geometry.mesh.vertices_m)[item.geometry.mesh.faces[:, k]] for k in range(3))
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 == pytest.approx(0.5**3)


def test_the_lowest_signed_number_is_read_as_minus_one() -> None:
    assert unpacked(np.array([-128, -127, 0, 127], np.int8)).tolist() == [-1.0, -1.0, 0.0, 1.0]


def test_integer_positions_without_normalisation_are_kept(tmp_path: Path) -> None:
    gltf = Gltf()
    positions = gltf.accessor(CUBE * 100, "u2", "VEC3")
    indices = gltf.accessor(CUBE_FACES.reshape(-1), "u2", "SCALAR")
    gltf.node("cube", mesh=gltf.mesh({"attributes": {"POSITION": positions}, "indices": indices}), root=True)
    np.testing.assert_array_equal(read(gltf, tmp_path).pieces[0].vertices, CUBE * 100)


@pytest.mark.parametrize("has_base", [True, False])
def test_sparse_values_replace_base_values(tmp_path: Path, has_base: bool) -> None:
    gltf = Gltf()
    if has_base:
        positions = gltf.accessor(CUBE, "f4", "VEC3")
        expected = CUBE.copy()
    else:
        gltf.header["accessors"].append({"componentType": 5126, "type": "VEC3", "count": 8})
        positions, expected = 0, np.zeros((8, 3))
    expected[[1, 6]] = [[5.0, 6.0, 7.0], [8.0, 9.0, 10.0]]
    gltf.header["accessors"][positions]["sparse"] = {
        "count": 2,
        "indices": {"bufferView": gltf.view([1, 6], "<u2"), "componentType": 5123},
        "values": {"bufferView": gltf.view(expected[[1, 6]], "<f4")},
    }
    indices = gltf.accessor(CUBE_FACES.reshape(-1), "u2", "SCALAR")
    gltf.node("cube", mesh=gltf.mesh({"attributes": {"POSITION": positions}, "indices": indices}), root=True)
    np.testing.assert_array_equal(read(gltf, tmp_path).pieces[0].vertices, expected)


@pytest.mark.parametrize(
    ("mode", "order", "expected"),
    [
        (4, None, [[0, 1, 2], [3, 4, 5]]),
        (4, [0, 1, 2, 3], [[0, 1, 2]]),
        (5, [0, 1, 2, 3, 4], [[0, 1, 2], [1, 3, 2], [2, 3, 4]]),
        (5, [0, 1, 2, 2, 3, 3, 4, 5], [[0, 1, 2], [3, 5, 4]]),
        (6, [0, 1, 2, 3, 4], [[1, 2, 0], [2, 3, 0], [3, 4, 0]]),
    ],
)
def test_lists_strips_and_fans_of_triangles(
    tmp_path: Path, mode: int, order: list[int] | None, expected: list[list[int]]
) -> None:
    """Section 3.7.2.1: v_i, v_(i + 1 + i % 2), v_(i + 2 - i % 2) in a strip; v_(i + 1), v_(i + 2), v_0 in a fan."""
    gltf = Gltf()
    points = np.arange(18.0).reshape(6, 3) ** 1.5
    primitive = {"attributes": {"POSITION": gltf.accessor(points, "f4", "VEC3")}, "mode": mode}
    if order is not None:
        primitive["indices"] = gltf.accessor(order, "u4", "SCALAR")
    gltf.node("thing", mesh=gltf.mesh(primitive), root=True)
    piece = read(gltf, tmp_path).pieces[0]
    np.testing.assert_array_equal(piece.vertices[piece.faces], points.astype(np.float32)[expected])


def test_points_and_lines_are_skipped(tmp_path: Path) -> None:
    gltf = one_cube()
    wire = {"attributes": {"POSITION": 0}, "indices": 1, "mode": 1}
    gltf.node("wire", mesh=gltf.mesh(wire, {**wire, "mode": 0}), root=True)
    assert [item.id for item in load_scene(gltf.write(tmp_path / "scene.glb")).objects] == ["cube"]


def test_a_primitive_without_positions_draws_nothing(tmp_path: Path) -> None:
    gltf = one_cube()
    gltf.header["meshes"][0]["primitives"].append({"attributes": {"NORMAL": 0}})
    assert len(read(gltf, tmp_path).pieces) == 1


def test_unused_vertices_are_left_out(tmp_path: Path) -> None:
    """Exporters give each primitive the vertices of the whole mesh; a NaN in an unused vertex must not matter."""
    gltf = Gltf()
    crowded = np.vstack((CUBE, [[np.nan, 900.0, 900.0]]))
    positions = gltf.accessor(crowded, "f4", "VEC3")
    indices = gltf.accessor(CUBE_FACES.reshape(-1), "u2", "SCALAR")
    gltf.node("cube", mesh=gltf.mesh({"attributes": {"POSITION": positions}, "indices": indices}), root=True)
    item = load_scene(gltf.write(tmp_path / "scene.glb")).object("cube")
    np.testing.assert_array_equal(item.bounds_m, [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])


def test_transforms_chain_from_the_root_down(tmp_path: Path) -> None:
    """Half a turn about y, then 2 m along x, then twice the size; bounds computed by hand."""
    gltf = Gltf()
    leaf = gltf.node("cube", mesh=gltf.cube(), translation=[2.0, 0.0, 0.0], scale=[2.0, 2.0, 2.0])
    gltf.node("turned", children=[leaf], rotation=[0.0, 1.0, 0.0, 0.0], root=True)
    item = load_scene(gltf.write(tmp_path / "scene.glb")).objects[0]
    np.testing.assert_allclose(item.bounds_m, [[-4.0, 0.0, -2.0], [-2.0, 2.0, 0.0]], atol=1e-12)


def test_a_node_is_scaled_before_it_is_turned(tmp_path: Path) -> None:
    """A quarter turn about z takes x to y, and y to -x."""
    half = float(np.sqrt(0.5))
    item = load_scene(
        one_cube(rotation=[0.0, 0.0, half, half], scale=[2.0, 3.0, 4.0]).write(tmp_path / "s.glb")
    ).objects[0]
    np.testing.assert_allclose(item.bounds_m, [[-3.0, 0.0, 0.0], [0.0, 2.0, 4.0]], atol=1e-12)


def test_node_matrix_is_column_major(tmp_path: Path) -> None:
    columns = [0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 5.0, 6.0, 7.0, 1.0]
    item = load_scene(one_cube(matrix=columns).write(tmp_path / "scene.glb")).objects[0]
    assert item.pose.position_m == (5.0, 6.0, 7.0)
    np.testing.assert_allclose(item.pose.to_world([[1.0, 0.0, 0.0]]), [[5.0, 7.0, 7.0]], atol=1e-12)


@pytest.mark.parametrize("scale", [(-1.0, 1.0, 1.0), (1.0, -1.0, 1.0), (-1.0, -1.0, -1.0), (-2.0, 3.0, 0.5)])
def test_a_mirrored_mesh_still_faces_outwards(tmp_path: Path, scale: tuple[float, float, float]) -> None:
    item = load_scene(one_cube(scale=list(scale)).write(tmp_path / "scene.glb")).objects[0]
    mesh = item.geometry.mesh
    a, b, c = (item.pose.to_world(mesh.vertices_m)[mesh.faces[:, k]] for k in range(3))
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 == pytest.approx(abs(np.prod(scale)))
    low, high = np.sort([np.zeros(3), scale], axis=0)
    np.testing.assert_allclose(item.bounds_m, [low, high], atol=1e-12)


def test_a_mirrored_object_still_stands_upright(tmp_path: Path) -> None:
    item = load_scene(one_cube(scale=[-1.0, 1.0, 1.0]).write(tmp_path / "scene.glb")).objects[0]
    np.testing.assert_allclose(item.pose.rotation, np.eye(3), atol=1e-12)


def test_shear_is_baked_and_leaves_a_rigid_pose(tmp_path: Path) -> None:
    gltf = Gltf()
    leaf = gltf.node("cube", mesh=gltf.cube(), rotation=[0.0, 0.0, np.sin(0.3), np.cos(0.3)])
    gltf.node("stretched", children=[leaf], scale=[3.0, 1.0, 1.0], root=True)
    item = load_scene(gltf.write(tmp_path / "scene.glb"), group="leaf").objects[0]
    turn = np.array([[np.cos(0.6), -np.sin(0.6), 0.0], [np.sin(0.6), np.cos(0.6), 0.0], [0.0, 0.0, 1.0]])
    expected = CUBE @ (np.diag([3.0, 1.0, 1.0]) @ turn).T
    np.testing.assert_allclose(item.pose.to_world(item.geometry.mesh.vertices_m), expected, atol=1e-12)
    np.testing.assert_allclose(item.pose.rotation @ item.pose.rotation.T, np.eye(3), atol=1e-12)


def test_instances_share_one_mesh_wherever_they_stand(tmp_path: Path) -> None:
    gltf = Gltf()
    cube = gltf.cube()
    rng = np.random.default_rng(1)
    for i in range(6):
        quaternion = rng.normal(size=4)
        rotation = (quaternion / np.linalg.norm(quaternion)).astype(np.float32).tolist()
        gltf.node(
            f"c{i}", mesh=cube, rotation=rotation, translation=[3.0 * i, 0.0, 0.0], scale=[0.3, 0.3, 0.3], root=True
        )
    gltf.node("larger", mesh=cube, scale=[0.31, 0.31, 0.31], root=True)
    *copies, larger = load_scene(gltf.write(tmp_path / "scene.glb")).objects
    assert len({id(item.geometry) for item in copies}) == 1
    assert len({item.instance_key for item in copies}) == 1
    assert larger.instance_key != copies[0].instance_key


def test_equal_meshes_that_are_stored_twice_are_one(tmp_path: Path) -> None:
    gltf = Gltf()
    for name in ("a", "b"):
        gltf.node(name, mesh=gltf.cube(), root=True)
    first, second = load_scene(gltf.write(tmp_path / "scene.glb")).objects
    assert first.geometry is second.geometry
    assert first.instance_key == second.instance_key


def test_one_mesh_with_two_materials_gets_two_instance_keys(tmp_path: Path) -> None:
    gltf = Gltf()
    gltf.header["materials"] = [{"name": "oak"}, {"name": "steel"}, {"name": "oak"}]
    for i in range(3):
        gltf.node(f"cube{i}", mesh=gltf.cube(material=i), root=True)
    oak, steel, same = load_scene(gltf.write(tmp_path / "scene.glb")).objects
    assert oak.geometry is steel.geometry
    assert oak.instance_key != steel.instance_key
    assert oak.instance_key == same.instance_key


def test_primitives_of_one_mesh_are_one_object(tmp_path: Path) -> None:
    gltf = Gltf()
    positions = gltf.accessor(CUBE, "f4", "VEC3")
    halves = [gltf.accessor(half.reshape(-1), "u2", "SCALAR") for half in (CUBE_FACES[:6], CUBE_FACES[6:])]
    mesh = gltf.mesh(*({"attributes": {"POSITION": positions}, "indices": half} for half in halves))
    gltf.node("cube", mesh=mesh, root=True)
    (item,) = load_scene(gltf.write(tmp_path / "two.glb")).objects
    (whole,) = load_scene(one_cube().write(tmp_path / "one.glb")).objects
    assert triangles(item) == triangles(whole)
    assert item.surface.flags == ()


def test_only_the_default_scene_is_read(tmp_path: Path) -> None:
    gltf = one_cube("here")
    gltf.node("elsewhere", mesh=0)
    gltf.header["scenes"].append({"nodes": [1]})
    path = gltf.write(tmp_path / "scene.glb")
    assert [item.id for item in load_scene(path).objects] == ["here"]
    gltf.header["scene"] = 1
    assert [item.id for item in load_scene(gltf.write(path)).objects] == ["elsewhere"]


def test_every_root_node_is_read_when_no_scene_is_defined(tmp_path: Path) -> None:
    gltf = one_cube("a")
    gltf.node("b", children=[gltf.node("leg", mesh=0)])
    del gltf.header["scenes"], gltf.header["scene"]
    assert [item.id for item in load_scene(gltf.write(tmp_path / "scene.glb")).objects] == ["a", "b"]


def test_cameras_lights_and_bones_are_not_objects(tmp_path: Path) -> None:
    gltf = one_cube()
    bone = gltf.node("bone")
    gltf.node("rig", children=[bone], root=True)
    gltf.node("camera", camera=0, root=True)
    gltf.node("lamp", extensions={"KHR_lights_punctual": {"light": 0}}, root=True)
    assert [item.id for item in load_scene(gltf.write(tmp_path / "scene.glb")).objects] == ["cube"]


@pytest.mark.parametrize("is_required", [False, True])
def test_hidden_nodes_and_all_below_are_left_out(tmp_path: Path, is_required: bool) -> None:
    gltf = one_cube()
    inner = gltf.node("inner", mesh=0)
    hidden = {"KHR_node_visibility": {"visible": False}}
    gltf.node("ghost", mesh=0, children=[inner], extensions=hidden, root=True)
    gltf.node("shown", mesh=0, extensions={"KHR_node_visibility": {"visible": True}}, root=True)
    if is_required:
        gltf.header["extensionsRequired"] = ["KHR_node_visibility"]
    assert [item.id for item in load_scene(gltf.write(tmp_path / "scene.glb")).objects] == ["cube", "shown"]


def test_nodes_of_scale_0_are_left_out_with_a_warning(tmp_path: Path) -> None:
    """A common way to hide an object. In an earlier version one such node refused the whole file."""
    gltf = one_cube()
    inner = gltf.node("inner", mesh=0)
    gltf.node("ghost", mesh=0, children=[inner], scale=[0.0, 0.0, 0.0], root=True)
    gltf.node("locator", scale=[0.0, 0.0, 0.0], root=True)
    path = gltf.write(tmp_path / "scene.glb")
    with pytest.warns(SceneWarning, match=r"'scene' is read without 1 node .*: 'ghost'\. Give a size"):
        assert [item.id for item in load_scene(path).objects] == ["cube"]


def test_what_follows_a_glb_in_its_file_is_ignored(tmp_path: Path) -> None:
    path = tmp_path / "tail.glb"
    path.write_bytes(one_cube().glb() + b"tail")
    assert [item.id for item in load_scene(path).objects] == ["cube"]


def test_required_extensions_without_effect_on_geometry_are_accepted(tmp_path: Path) -> None:
    gltf = one_cube()
    gltf.header["extensionsRequired"] = ["KHR_materials_unlit", "EXT_texture_webp", "KHR_texture_transform"]
    assert len(load_scene(gltf.write(tmp_path / "scene.glb")).objects) == 1


def test_a_mesh_of_more_indices_than_the_limit_of_triangles_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "MAX_TRIANGLES", 12)  # a cube has 12 triangles and 36 indices
    assert len(load_scene(one_cube().write(tmp_path / "scene.glb")).objects) == 1
    monkeypatch.setattr(limits, "MAX_TRIANGLES", 11)
    with pytest.raises(SceneError, match="MAX_TRIANGLES"):
        load_scene(one_cube().write(tmp_path / "scene.glb"))


def test_images_are_not_read(tmp_path: Path) -> None:
    gltf = one_cube()
    gltf.header["images"] = [{"uri": "../textures/none.png"}]
    assert len(load_scene(gltf.write(tmp_path / "scene.glb")).objects) == 1


def test_names_keep_every_letter(tmp_path: Path) -> None:
    gltf = Gltf()
    for name in ("Куб", "knob 1", "Circle.021_0", "机"):
        gltf.node(name, mesh=gltf.cube(), root=True)
    assert [item.name for item in load_scene(gltf.write(tmp_path / "scene.glb")).objects] == [
        "Куб",
        "knob 1",
        "Circle.021_0",
        "机",
    ]


def test_unnamed_node_takes_the_name_of_its_mesh(tmp_path: Path) -> None:
    gltf = one_cube(None)
    gltf.header["meshes"][0]["name"] = "kettle"
    assert load_scene(gltf.write(tmp_path / "scene.glb")).objects[0].id == "kettle"


def test_unit_scales_positions_and_keeps_rotations(tmp_path: Path) -> None:
    gltf = one_cube(translation=[200.0, 0.0, 0.0], rotation=[0.0, 0.0, 0.6, 0.8], scale=[50.0, 50.0, 50.0])
    path = gltf.write(tmp_path / "scene.glb")
    item = load_scene(path, unit_m=0.01).objects[0]
    assert item.pose.position_m == pytest.approx((2.0, 0.0, 0.0))
    assert item.size_m == pytest.approx((0.5, 0.5, 0.5))
    np.testing.assert_allclose(item.pose.rotation_xyzw, [0.0, 0.0, 0.6, 0.8], atol=1e-12)
    assert isinstance(item.geometry, TriMesh)


def instanced(**attributes: list[list[float]]) -> Gltf:
    """A cube that a node draws at several places."""
    gltf = Gltf()
    rows = {name: gltf.accessor(values, "f4", f"VEC{len(values[0])}") for name, values in attributes.items()}
    gltf.node(
        "chair",
        mesh=gltf.cube(),
        root=True,
        translation=(10, 0, 0),
        extensions={"EXT_mesh_gpu_instancing": {"attributes": rows}},
    )
    gltf.header["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
    return gltf


def test_each_copy_of_an_instanced_mesh_is_an_object(tmp_path: Path) -> None:
    half = np.sqrt(0.5)
    gltf = instanced(
        TRANSLATION=[[0, 0, 0], [5, 0, 0]], ROTATION=[[0, 0, 0, 1], [0, half, 0, half]], SCALE=[[1, 1, 1], [1, 1, 2]]
    )
    first, second = load_scene(gltf.write(tmp_path / "chairs.glb")).objects
    assert (first.id, second.id) == ("chair", "chair#2")
    np.testing.assert_allclose(first.bounds_m, [(10, 0, 0), (11, 1, 1)], atol=1e-6)
    np.testing.assert_allclose(second.bounds_m, [(15, 0, -1), (17, 1, 0)], atol=1e-6)


def test_triangles_of_all_copies_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = instanced(TRANSLATION=[[3 * k, 0, 0] for k in range(4)]).write(tmp_path / "chairs.glb")
    n = 4 * len(CUBE_FACES)
    monkeypatch.setattr(limits, "MAX_TRIANGLES", n - 1)
    with pytest.raises(SceneError, match=f"number of triangles is {n};"):
        load_scene(path)
    monkeypatch.setattr(limits, "MAX_TRIANGLES", n)
    assert len(load_scene(path).objects) == 4


def test_legs_that_are_instances_are_parts_of_their_rack(tmp_path: Path) -> None:
    """Blender writes children of one mesh as instances of a node that is called after their parent."""
    gltf = instanced(TRANSLATION=[[0, -1, 0], [3, -1, 0]])
    gltf.header["meshes"][0]["name"] = "leg"
    (legs,) = gltf.header["scenes"][0]["nodes"]
    gltf.header["scenes"][0]["nodes"] = []
    gltf.node("rack", mesh=gltf.header["nodes"][legs]["mesh"], children=[legs], root=True)
    (rack,) = load_scene(gltf.write(tmp_path / "rack.glb")).objects
    np.testing.assert_allclose(rack.bounds_m, [(0, -1, 0), (14, 1, 1)], atol=1e-6)


def test_copies_below_a_node_without_a_mesh_are_objects(tmp_path: Path) -> None:
    gltf = instanced(TRANSLATION=[[0, 0, 0], [3, 0, 0]])
    gltf.header["meshes"][0]["name"] = "stool"
    (copies,) = gltf.header["scenes"][0]["nodes"]
    gltf.header["scenes"][0]["nodes"] = []
    gltf.node("chair", children=[copies], root=True)
    assert [item.id for item in load_scene(gltf.write(tmp_path / "chairs.glb")).objects] == ["stool", "stool#2"]


@pytest.mark.parametrize(
    ("attributes", "sentence"),
    [
        ({"TRANSLATION": [[0, 0, 0]], "SCALE": [[1, 1, 1], [2, 2, 2]]}, "one of each for each copy"),
        ({"ROTATION": [[0, 0, 0, 0]]}, "ROTATION: .*quaternion"),
        ({"TRANSLATION": [[float("nan"), 0, 0]]}, "not finite"),
        ({"TRANSLATION": [[0, 0]]}, "must be 'VEC3'"),
    ],
)
def test_broken_copies_are_refused(tmp_path: Path, attributes: dict[str, list[list[float]]], sentence: str) -> None:
    with pytest.raises(SceneFormatError, match=sentence):
        load_scene(instanced(**attributes).write(tmp_path / "chairs.glb"))


def test_too_many_copies_are_refused_before_they_are_made(tmp_path: Path) -> None:
    gltf = instanced(TRANSLATION=[[0, 0, 0]])
    gltf.header["accessors"][0] = {"componentType": 5126, "type": "VEC3", "count": 200_000}  # zeros, without a buffer
    with pytest.raises(SceneError, match="number of copies of node 'chair' is 200,000"):
        load_scene(gltf.write(tmp_path / "chairs.glb"))
