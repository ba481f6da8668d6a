"""Limits on totals of many small items; shared work is done once, and valid files are read."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from scene2hap import SceneSnapshot, load_scene
from scene2hap.common.warning import SceneWarning
from scene2hap.errors import SceneError
from scene2hap.scene import limits
from scene2hap.scene.engines import mjcf_files, mujoco_geoms
from scene2hap.scene.engines.mjcf_files import check_files
from scene2hap.scene.formats import mtl, stl_ply
from scene2hap.scene.formats.stl_ply import read_stl_ply
from scene2hap.scene.geometry import distances
from scene2hap.scene.grouping.split import Member, split
from scene2hap.scene.shapes import Box, TriMesh
from scene2hap.scene.surface import dominant_surface as dominant_surface_module, surface_cache
from scene2hap.scene.surface.cuboid import cuboid_bounds_m
from scene2hap.scene.surface.dominant_surface import dominant_surface
from scene2hap.scene.tree import Piece

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
FACET = "facet normal 0 0 1\nouter loop\nvertex 0 0 {}\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
TETRAHEDRON = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


# -- boxes, and the cost of measuring --------------------------------------------------------------------------------


def shuffled(mesh: TriMesh, seed: int) -> TriMesh:
    """The same triangles in another order, without shared corners."""
    rng = np.random.default_rng(seed)
    faces = np.array([np.roll(face, rng.integers(3)) for face in rng.permutation(mesh.faces)])
    return TriMesh(mesh.vertices_m[faces].reshape(-1, 3), np.arange(36).reshape(-1, 3))


@pytest.mark.parametrize("up", [None, (0, 1, 0), (0, 0, 1), (0.6, 0.8, 0), (0.1, -0.9, 0.3)])
@pytest.mark.parametrize("size_m", [(1, 2, 3), (1, 1, 1), (0.3, 0.01, 5), (2, 2, 0.1), (1, 1.005, 1.001)])
def test_boxes_have_the_same_surface_as_by_rays(
    size_m: tuple[float, float, float], up: tuple[float, float, float] | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    mesh = shuffled(TriMesh(np.add(Box(size_m).mesh.vertices_m, (0.5, -2, 3)), Box(size_m).mesh.faces), seed=1)
    quick = dominant_surface(mesh, up=up)
    monkeypatch.setattr(dominant_surface_module, "cuboid_bounds_m", lambda mesh: None)
    by_rays = dominant_surface(mesh, up=up)
    assert quick.flags == by_rays.flags == ()
    sizes = [(one.length_m, one.width_m, one.thickness_m) for one in (quick, by_rays)]
    np.testing.assert_allclose(*sizes, rtol=1e-9)
    np.testing.assert_allclose(quick.pose.rotation, by_rays.pose.rotation, atol=1e-9)
    np.testing.assert_allclose(quick.pose.position_m, by_rays.pose.position_m, atol=1e-9)


def test_only_complete_cuboids_are_recognised() -> None:
    mesh = Box((1, 2, 3)).mesh
    assert cuboid_bounds_m(mesh) is not None
    assert cuboid_bounds_m(TriMesh(mesh.vertices_m, mesh.faces[:, ::-1])) is not None
    points, faces = mesh.vertices_m, mesh.faces
    one_turned, twice, other_half = faces.copy(), faces.copy(), faces.copy()
    one_turned[3] = one_turned[3, ::-1]
    twice[1] = twice[0]
    other_half[:2] = other_half[2:4]
    # Both diagonals of one side, which its four corners allow, and another side left open.
    open_box, (first, second) = faces.copy(), faces[:2].tolist()
    (lone,), (opposite,) = {*first} - {*second}, {*second} - {*first}
    x, y = (first * 2)[first.index(lone) + 1 :][:2]
    open_box[2:4] = (lone, x, opposite), (lone, opposite, y)
    dented = points.copy()
    dented[0] *= 0.9
    flat = points * [1, 1, 0]
    wrong = [(points, each) for each in (faces[:11], one_turned, twice, other_half, open_box)]
    for vertices, triangles in [*wrong, (dented, faces), (flat, faces)]:
        assert cuboid_bounds_m(TriMesh(vertices, triangles)) is None


def tetrahedra(folder: Path, n: int) -> Path:
    """An OBJ of n tetrahedra of distinct shapes."""
    rows: list[str] = []
    for i in range(n):
        points = [(0, 0, 0), (1 + i, 0, 0), (0, 1, 0), (0, 0, 1)]
        rows += [f"o t{i}\n", *(f"v {x} {y} {z}\n" for x, y, z in points)]
        rows += [f"f {4 * i + a + 1} {4 * i + b + 1} {4 * i + c + 1}\n" for a, b, c in TETRAHEDRON]
    (folder / "a.obj").write_text("".join(rows))
    return folder / "a.obj"


def test_distinct_shapes_are_limited_by_a_budget(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(surface_cache, "_FREE", 50_000)
    assert "box-fallback" not in load_scene(tetrahedra(tmp_path, 1)).objects[0].surface.flags
    with pytest.warns(SceneWarning, match="object 't[1-3]' brings the rays that measure its shapes.*boxes") as warned:
        first, *_, last = load_scene(tetrahedra(tmp_path, 5)).objects
    assert len(warned) == 1
    assert "box-fallback" not in first.surface.flags
    assert "box-fallback" in last.surface.flags
    assert sorted([last.surface.length_m, last.surface.width_m, last.surface.thickness_m]) == [1.0, 1.0, 5.0]


def test_a_shape_above_the_budget_leaves_the_budget_to_others(monkeypatch: pytest.MonkeyPatch) -> None:
    """A mesh that is refused has used none of it."""
    monkeypatch.setattr(surface_cache, "_FREE", 200_000)
    measured, up = surface_cache.SurfaceCache(), np.array([0.0, 1.0, 0.0])
    rough, plain = trimesh.creation.icosphere(5), trimesh.creation.icosphere(1)
    with pytest.warns(SceneWarning, match="the first"):
        assert "box-fallback" in measured.of(TriMesh(rough.vertices, rough.faces), up, "the first").flags
    assert "box-fallback" not in measured.of(TriMesh(plain.vertices, plain.faces), up, "the second").flags


def test_vertices_of_scene_json_raise_the_budget(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    document = json.loads(load_scene(tetrahedra(tmp_path, 3)).to_json())
    for row in document["objects"]:
        del row["surface"]
    monkeypatch.setattr(surface_cache, "_FREE", 0)
    monkeypatch.setattr(surface_cache, "_PER_VERTEX", 1e6)
    assert len(SceneSnapshot.from_json(json.dumps(document)).objects) == 3


def test_copies_and_boxes_use_no_budget(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(surface_cache, "_FREE", 0)
    monkeypatch.setattr(surface_cache, "_PER_VERTEX", 0.0)
    objects = [
        {
            "id": str(i),
            "name": "a",
            "pose": {"position_m": [3 * i, 0, 0], "rotation_xyzw": [0, 0, 0.1 * i, 1]},
            "geometry": {"kind": "box", "size_m": [1 + i, 1, 1]},
        }
        for i in range(20)
    ]
    document = {"format": "scene2hap/scene", "version": 1, "name": "a", "up_axis": "y", "objects": objects}
    (tmp_path / "a.json").write_text(json.dumps(document))
    assert [item.surface.length_m for item in load_scene(tmp_path / "a.json").objects[:2]] == [1.0, 2.0]


def test_rays_are_counted_before_they_are_cast() -> None:
    asked: list[int] = []
    points = np.random.default_rng(0).normal(size=(300, 3))
    dominant_surface(TriMesh(points, np.arange(300).reshape(-1, 3)), spend=asked.append)
    assert len(asked) == 4
    assert all(work > 1000 for work in asked)

    def refuse(work: int) -> None:
        raise SceneError("enough")

    with pytest.raises(SceneError, match="enough"):
        dominant_surface(TriMesh(points, np.arange(300).reshape(-1, 3)), spend=refuse)


# -- groups, libraries, solids ---------------------------------------------------------------------------------------


def member(name: str, x: float) -> Member:
    frame = np.eye(4)
    frame[0, 3] = x
    return Member(name, frame, (Piece.checked(0, np.eye(3), [[0, 1, 2]], "", name),))


def test_items_of_a_group_are_compared_by_table(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = []
    monkeypatch.setattr("scene2hap.scene.grouping.split.distances", lambda *given: calls.append(1) or distances(*given))
    members = [member("tea_cup", 0.0), member("tea_lid", 0.1), *(member("tea_spoon", 9.0 + i) for i in range(20))]
    found = split("tea", members)
    assert [len(item) for item in found] == [2, *[1] * 20]
    assert len(calls) <= 22


def test_number_of_group_items_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MAX_OBJECTS", 5)
    with pytest.raises(SceneError, match="items in the group 'tea' is 6"):
        split("tea", [member("tea_spoon", 9.0 * i) for i in range(6)])


def test_number_of_libraries_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mtl, "MAX_LIBRARIES", 3)
    names = " ".join(f"a{i}.mtl" for i in range(4))
    (tmp_path / "a.obj").write_text(f"{TRIANGLE}mtllib {names}\nf 1 2 3\n")
    with pytest.raises(SceneError, match="over 3 material libraries"):
        load_scene(tmp_path / "a.obj")


def test_solids_of_a_text_stl_are_read_as_one() -> None:
    text = "".join(f"  solid part {i}\n{FACET.format(i)}  endsolid part {i}\n\n" for i in range(300))
    (node,) = read_stl_ply(text.encode(), "stl", "a").roots
    assert [len(piece.faces) for piece in node.pieces] == [300]
    assert sorted(node.pieces[0].vertices[:, 2])[-1] == 299


def test_solids_within_long_lines_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stl_ply, "MAX_SOLIDS", 3)
    text = "".join(f"solid a {FACET.format(i)} endsolid a " for i in range(4))
    with pytest.raises(SceneError, match="4 solids"):
        read_stl_ply(text.encode(), "stl", "a")


def test_binary_stl_with_the_word_solid_is_read_as_binary() -> None:
    data = bytearray(84 + 50 * 2)
    data[80] = 2
    data[:20] = b"solid a\nendsolid\nsol"
    data[96:132] = np.eye(3, dtype="<f4").tobytes()
    data[146:182] = (2 * np.eye(3, dtype="<f4")).tobytes()
    (node,) = read_stl_ply(bytes(data), "stl", "a").roots
    assert [len(piece.faces) for piece in node.pieces] == [2]


# -- Draco -----------------------------------------------------------------------------------------------------------


def draco_scene(folder: Path, data: bytes, n: int) -> Path:
    packed = {"bufferView": 0, "attributes": {"POSITION": 0}}
    row = {"attributes": {"POSITION": 0}, "extensions": {"KHR_draco_mesh_compression": packed}}
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(data), "uri": "a.bin"}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "accessors": [{"type": "VEC3", "componentType": 5126, "count": 3}],
        "meshes": [{"primitives": [row] * n}],
        "nodes": [{"mesh": 0}],
    }
    (folder / "a.bin").write_bytes(data)
    (folder / "a.gltf").write_text(json.dumps(document))
    return folder / "a.gltf"


def packed_plane(DracoPy: Any, edge: int, **how: Any) -> bytes:
    x, y = np.meshgrid(np.arange(edge), np.arange(edge))
    i = (np.arange(edge - 1)[:, None] * edge + np.arange(edge - 1)).ravel()
    faces = np.concatenate([np.stack([i, i + 1, i + edge], 1), np.stack([i + 1, i + edge + 1, i + edge], 1)])
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1).astype(np.float32)
    return bytes(DracoPy.encode(points, faces.astype(np.uint32), quantization_bits=11, **how))


@pytest.mark.parametrize("level", [0, 10])
def test_draco_mesh_is_counted_before_decoding_and_decoded_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, level: int
) -> None:
    DracoPy = pytest.importorskip("DracoPy")
    data, decode, calls = packed_plane(DracoPy, 20, compression_level=level), DracoPy.decode, []
    monkeypatch.setattr(DracoPy, "decode", lambda data: calls.append(1) or decode(data))
    scene = load_scene(draco_scene(tmp_path, data, 3))
    assert len(calls) == 1
    assert len(scene.objects[0].geometry.mesh.faces) == 3 * 2 * 19**2
    monkeypatch.setattr(limits.Budget, "spend", refuse_packed)
    with pytest.raises(SceneError, match="722 packed"):
        load_scene(draco_scene(tmp_path, data, 3))
    assert len(calls) == 1


def refuse_packed(budget: limits.Budget, amount: int, place: str) -> None:
    if "packed" in budget.what:
        raise SceneError(f"{amount} packed")


def test_copies_that_trimesh_writes_as_meshes_are_counted_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rocks = trimesh.Scene()
    for i in range(5):
        rocks.add_geometry(trimesh.creation.icosphere(2), node_name=f"rock {i}", transform=np.eye(4))
    rocks.export(tmp_path / "rocks.glb")
    spent: list[tuple[str, int]] = []
    monkeypatch.setattr(limits.Budget, "spend", lambda budget, amount, place: spent.append((budget.what, amount)))
    assert len(load_scene(tmp_path / "rocks.glb").objects) == 5
    assert [amount for what, amount in spent if what == "its triangles"] == [320]


def test_repeated_draco_primitives_are_limited(tmp_path: Path) -> None:
    DracoPy = pytest.importorskip("DracoPy")
    with pytest.raises(SceneError, match="its triangles to"):
        load_scene(draco_scene(tmp_path, packed_plane(DracoPy, 60), 200))


@pytest.mark.parametrize(
    "header",
    [
        b"DRACO\2\2\1\1\0\0\0" + b"\xff\xff\xff\xff\x0f" * 2,
        b"DRACO\2\2\1\0\0\0" + b"\xff\xff\xff\xff\x0f" * 2,
        # Metadata of one attribute (number 5) with one value and one nested element; then metadata of the file.
        b"DRACO\2\2\1\0\0\x80" + b"\1\5" + b"\1\2ab\3xyz" + b"\1\1c\0\0" + b"\0\0" + b"\xff\xff\xff\xff\x0f" * 2,
    ],
)
def test_draco_header_with_too_many_points_is_refused(tmp_path: Path, header: bytes) -> None:
    pytest.importorskip("DracoPy")
    with pytest.raises(SceneError, match="packed triangles to 4,294,967,295"):
        load_scene(draco_scene(tmp_path, header + bytes(100), 1))


@pytest.mark.parametrize(
    "data", [b"DRACO\2\1\1\1\0\0" + bytes(50), b"DRACO\2\2\0\0\0\0" + bytes(50), b"DRACO\2\2\1\1\0"]
)
def test_invalid_draco_header_is_refused(tmp_path: Path, data: bytes) -> None:
    pytest.importorskip("DracoPy")
    with pytest.raises(SceneError, match="Draco data cannot be decoded, by its header"):
        load_scene(draco_scene(tmp_path, data, 1))


# -- MJCF ------------------------------------------------------------------------------------------------------------


def mjcf(folder: Path, inside: str, assets: str = "") -> Path:
    text = f'<mujoco><asset>{assets}</asset><worldbody><geom type="box" size="1 1 1"/>{inside}</worldbody></mujoco>'
    (folder / "a.xml").write_text(text)
    (folder / "m.obj").write_text(TRIANGLE + "v 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    return folder / "a.xml"


def test_mesh_file_counts_once_per_reference(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rows = "".join(f'<mesh name="m{i}" file="m.obj"/>' for i in range(3))
    check_files(mjcf(tmp_path, "", rows), tmp_path)
    monkeypatch.setattr(mjcf_files, "FREE_MESH_BYTES", 0)
    with pytest.raises(SceneError, match="bytes of mesh files, as often as they are named,.*Name each file in one"):
        check_files(mjcf(tmp_path, "", rows), tmp_path)


def test_built_in_meshes_count_together(tmp_path: Path) -> None:
    sphere = '<mesh name="m{}" builtin="sphere" params="4"/>'
    check_files(mjcf(tmp_path, "", "".join(map(sphere.format, range(70)))), tmp_path)
    with pytest.raises(SceneError, match="triangles of built-in meshes"):
        check_files(mjcf(tmp_path, "", "".join(map(sphere.format, range(90)))), tmp_path)
    with pytest.raises(SceneError, match="triangles of built-in meshes"):
        plate = '<mesh name="m{}" builtin="plate" params="200 200"/>'
        check_files(mjcf(tmp_path, "", "".join(map(plate.format, range(5)))), tmp_path)


@pytest.mark.parametrize(
    "inside",
    [
        "<body/>" * 6,
        '<replicate count="6"><body/></replicate>',
        '<composite type="cable" count="6 1 1"/>',
        '<flexcomp count="2 3 1"/>',
    ],
)
def test_number_of_bodies_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, inside: str) -> None:
    monkeypatch.setattr(limits, "MAX_OBJECTS", 5)
    with pytest.raises(SceneError, match="the number of bodies is 6"):
        check_files(mjcf(tmp_path, inside), tmp_path)


def test_number_of_world_geoms_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("mujoco")
    monkeypatch.setattr(limits, "MAX_OBJECTS", 5)
    with pytest.raises(SceneError, match="the number of objects is 6"):
        load_scene(mjcf(tmp_path, '<geom size="1"/>' * 5))


def test_numbers_for_the_user_are_bounded_by_the_longest(tmp_path: Path) -> None:
    check_files(mjcf(tmp_path, f'<body user="{"1 " * 1000}"/>'), tmp_path)
    with pytest.raises(SceneError, match="user of .* has 1,001 numbers"):
        check_files(mjcf(tmp_path, f'<body user="{"1 " * 1001}"/>'), tmp_path)


def test_included_files_are_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mjcf_files, "MAX_INCLUDED", 3)
    for i in range(3):
        (tmp_path / f"{i}.xml").write_text("<mujoco/>")
    path = mjcf(tmp_path, "".join(f'<include file="{i}.xml"/>' for i in range(3)))
    with pytest.raises(SceneError, match="more than 3 included files"):
        check_files(path, tmp_path)


@pytest.mark.parametrize(
    ("inside", "assets"),
    [
        ('<geom type="hfield" hfield="h"/>', '<hfield name="h" nrow="40" ncol="40" size="1 1 1 1"/>'),
        ('<geom type="mesh" mesh="m"/>' * 800, '<mesh name="m" file="m.obj"/>'),
        ('<geom size="1"/>' * 2, ""),
    ],
)
def test_triangles_are_counted_before_geoms_are_drawn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, inside: str, assets: str
) -> None:
    pytest.importorskip("mujoco")
    path = mjcf(tmp_path, inside, assets)
    load_scene(path, unit_m=1.0)
    monkeypatch.setattr(mujoco_geoms, "_FREE_TRIANGLES", 3000)
    with pytest.raises(SceneError, match="brings the triangles of its geoms to"):
        load_scene(path, unit_m=1.0)


def test_generated_shapes_do_not_raise_the_budget(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Otherwise each sphere, a few bytes of MJCF, would raise the budget."""
    pytest.importorskip("mujoco")
    monkeypatch.setattr(surface_cache, "_FREE", 100_000)
    balls = "".join(f'<body pos="{9 * i} 0 0"><geom size="{1 + i / 10}"/></body>' for i in range(10))
    with pytest.warns(SceneWarning, match="where 0 vertices are stored|where 8 vertices are stored"):
        load_scene(mjcf(tmp_path, balls), unit_m=1.0)
