"""Scenes that others made: counted by hand, held against an independent reading of the same files."""

from __future__ import annotations

import base64
import json
import struct
import subprocess
import sys
import warnings
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap.errors import Scene2HapError
from scene2hap.scene.load import TextureWarning, UnitWarning, load_scene
from scene2hap.scene.snapshot import SceneSnapshot

SCENES = Path(__file__).parents[3] / "shared" / "scenes"
pytestmark = pytest.mark.skipif(not SCENES.is_dir(), reason=f"the real scenes are not there: {SCENES}")

# Objects are counted by hand in the listings of nodes: what a user would point at.
COUNTS = {
    "sketchfab_kitchen/scene.gltf": 39,
    "aws_house_living/aws_house_living.glb": 43,
    "aws_house_bedroom/aws_house_bedroom.glb": 25,
    "composed_kitchen_kaykit/composed_kitchen_kaykit.glb": 29,
    "composed_bathroom_kenney/composed_bathroom_kenney.glb": 20,
    "messy_japanese_room/room.glb": 17,
    "messy_merged_bathroom/bathroom.glb": 1,
}
KITCHEN, LIVING, BEDROOM, COMPOSED, BATHROOM, DRACO, MERGED = COUNTS


@cache
def scene(name: str) -> SceneSnapshot:
    return load_scene(SCENES / name, unit_m=1.0)


@pytest.mark.parametrize(("name", "count"), COUNTS.items())
def test_every_thing_is_one_object(name: str, count: int) -> None:
    assert len(scene(name).objects) == count


def test_names_are_those_of_the_author() -> None:
    assert [item.id for item in scene(BATHROOM).objects] == [
        *("floor", "wall_back", "wall_right", "washing_machine", "tumble_dryer", "vanity_sink", "mirror", "toilet"),
        *("shower_cabin", "bathtub", "wall_cabinet", "bath_cabinet", "radio", "plant", "bath_mat", "trash_bin"),
        *("small_speaker", "stool", "toilet_roll", "towel_rail"),
    ]
    assert {"Cooktop", "Controller", "Oven", "Controller_1", "01_Drawer_01", "Tap", "Syphon"} <= {
        item.id for item in scene(KITCHEN).objects
    }
    assert scene(BEDROOM).object("Bed_01_001").name == "Bed_01_001"
    assert [item.id for item in scene(DRACO).objects] == [f"Object_{i}" for i in range(2, 19)]


@pytest.mark.parametrize(("name", "n"), [(name, 10 if name == MERGED else 2) for name in COUNTS])
def test_every_load_is_the_same(name: str, n: int) -> None:
    """Ten loads of the file with six primitives to a mesh, whose names trimesh would draw at random."""
    assert all(load_scene(SCENES / name, unit_m=1.0) == scene(name) for _ in range(n - 1))


def test_another_process_reads_the_same() -> None:
    code = (
        "import sys; from scene2hap.scene.load import load_scene; "
        "print([(i.id, i.instance_key) for p in sys.argv[1:] for i in load_scene(p, unit_m=1.0).objects])"
    )
    names = (BATHROOM, MERGED)
    paths = [str(SCENES / name) for name in names]
    done = subprocess.run([sys.executable, "-c", code, *paths], capture_output=True, text=True, check=True)
    expected = [(item.id, item.instance_key) for name in names for item in scene(name).objects]
    assert done.stdout.strip() == str(expected)


# -- an independent reading ------------------------------------------------------------------------------------------


def header_and_buffer(path: Path) -> tuple[dict[str, Any], bytes]:
    data = path.read_bytes()
    if data[:4] == b"glTF":
        (length,) = struct.unpack_from("<I", data, 12)
        return json.loads(data[20 : 20 + length]), data[20 + length + 8 :]
    header = json.loads(data)
    uri = header["buffers"][0]["uri"]
    if uri.startswith("data:"):
        return header, base64.b64decode(uri.split(",")[1])
    return header, (path.parent / uri).read_bytes()


def values(header: dict[str, Any], buffer: bytes, number: int) -> NDArray[np.float64]:
    """The rows of an accessor."""
    row = header["accessors"][number]
    view = header["bufferViews"][row["bufferView"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[row["type"]]
    dtype = np.dtype({5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}[row["componentType"]])
    start = view.get("byteOffset", 0) + row.get("byteOffset", 0)
    stride = view.get("byteStride", width * dtype.itemsize)
    rows = [np.frombuffer(buffer, dtype, width, start + i * stride) for i in range(row["count"])]
    return np.array(rows, dtype=np.float64)


def drawn_triangles(path: Path, textured: bool = False) -> Iterator[NDArray[np.float64]]:
    """World corners (m, 3, 3) of each mesh node, walked from each node up to its root.

    `textured`: only those with a texture, and with its coordinates behind each corner: (m, 3, 5).
    """
    header, buffer = header_and_buffer(path)
    nodes = header["nodes"]
    parent = {child: i for i, node in enumerate(nodes) for child in node.get("children", [])}

    def local(node: dict[str, Any]) -> NDArray[np.float64]:
        if "matrix" in node:
            return np.array(node["matrix"], dtype=np.float64).reshape(4, 4, order="F")
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        # R = I + 2 w [q] + 2 [q]^2 with [q] the cross-product matrix of (x, y, z).
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        result = np.eye(4)
        result[:3, :3] = (np.eye(3) + 2 * w * cross + 2 * cross @ cross) @ np.diag(node.get("scale", (1, 1, 1)))
        result[:3, 3] = node.get("translation", (0, 0, 0))
        return result

    for i, node in enumerate(nodes):
        if "mesh" not in node:
            continue
        matrix, at = local(node), i
        while at in parent:
            at = parent[at]
            matrix = local(nodes[at]) @ matrix
        for primitive in header["meshes"][node["mesh"]]["primitives"]:
            points = values(header, buffer, primitive["attributes"]["POSITION"])
            order = np.arange(len(points))
            if "indices" in primitive:
                order = values(header, buffer, primitive["indices"])[:, 0].astype(int)
            corners = (np.c_[points, np.ones(len(points))] @ matrix.T)[:, :3]
            if textured:
                if "baseColorTexture" not in header["materials"][primitive["material"]]["pbrMetallicRoughness"]:
                    continue
                corners = np.c_[corners, values(header, buffer, primitive["attributes"]["TEXCOORD_0"])]
            yield corners[order].reshape(-1, 3, corners.shape[1])


def world_triangles(snapshot: SceneSnapshot) -> NDArray[np.float64]:
    meshes = [
        (item.pose.to_world(item.geometry.mesh.vertices_m), item.geometry.mesh.faces) for item in snapshot.objects
    ]
    return np.concatenate([points[faces] for points, faces in meshes])


@pytest.mark.parametrize("name", [KITCHEN, COMPOSED, BATHROOM, MERGED])
def test_every_triangle_is_where_the_file_puts_it(name: str) -> None:
    """All corners of all triangles, as sets, to a millionth of the scene."""
    ours = world_triangles(scene(name)).reshape(-1, 9)
    theirs = np.concatenate(list(drawn_triangles(SCENES / name))).reshape(-1, 9)
    assert len(ours) == len(theirs)
    size = float(np.ptp(theirs))
    # Summing with fixed weights orders both sets alike whatever order the corners were read in.
    marks = [np.sort(rows.reshape(-1, 3) @ [1.0, np.pi, np.e]) for rows in (ours, theirs)]
    np.testing.assert_allclose(marks[0], marks[1], atol=1e-5 * size)


@pytest.mark.parametrize("name", [KITCHEN, COMPOSED, BATHROOM])
def test_every_corner_has_the_coordinates_that_the_file_gives_it(name: str) -> None:
    theirs = np.concatenate(list(drawn_triangles(SCENES / name, textured=True))).reshape(-1, 5)
    rows = []
    for item in scene(name).objects:
        looks, mesh = item.appearance, item.geometry.mesh
        assert looks is not None
        if looks.uv is not None:
            is_textured = np.array([material.has_texture for material in looks.materials])[looks.face_material]
            corners = item.pose.to_world(mesh.vertices_m)[mesh.faces]
            rows.append(np.concatenate((corners, looks.uv), axis=2)[is_textured])
    ours = np.concatenate(rows).reshape(-1, 5)
    assert len(ours) == len(theirs)
    size = np.array([float(np.ptp(theirs[:, :3]))] * 3 + [1.0, 1.0])
    # Distinct weights, so that coordinates that went to another corner change the sums.
    marks = [np.sort(table / size @ [1.0, np.pi, np.e, 10.1, 31.7]) for table in (ours, theirs)]
    np.testing.assert_allclose(marks[0], marks[1], atol=1e-4)


# Materials that primitives use, and different images that these show, counted in the files.
LOOKS = {
    KITCHEN: (16, 16),
    LIVING: (35, 22),
    BEDROOM: (27, 22),
    COMPOSED: (28, 1),
    BATHROOM: (48, 2),
    DRACO: (16, 15),
    MERGED: (6, 0),
}


def images_of(header: dict[str, Any], buffer: bytes, material: dict[str, Any], folder: Path) -> set[bytes]:
    info = material["pbrMetallicRoughness"].get("baseColorTexture")
    if info is None:
        return set()
    texture = header["textures"][info["index"]]
    source = texture if "source" in texture else texture["extensions"]["EXT_texture_webp"]
    image = header["images"][source["source"]]
    if "uri" in image:
        return {(folder / image["uri"]).read_bytes()}
    view = header["bufferViews"][image["bufferView"]]
    start = view.get("byteOffset", 0)
    return {buffer[start : start + view["byteLength"]]}


@pytest.mark.parametrize("name", COUNTS)
def test_every_material_and_texture_is_there_once(name: str) -> None:
    header, buffer = header_and_buffer(SCENES / name)
    used = {primitive["material"] for mesh in header["meshes"] for primitive in mesh["primitives"]}
    images = {
        image for i in used for image in images_of(header, buffer, header["materials"][i], (SCENES / name).parent)
    }
    materials = {
        id(material): material
        for item in scene(name).objects
        if item.appearance is not None
        for material in item.appearance.materials
    }
    textures = {id(material.texture): material.texture for material in materials.values() if material.has_texture}
    assert (len(materials), len(textures)) == LOOKS[name] == (len(used), len(images))
    for texture in textures.values():
        assert texture is not None
        assert max(texture.shape) <= 1024
        assert np.ptp(texture) > 0


@pytest.mark.parametrize("name", [LIVING, BEDROOM])
def test_bounds_are_those_of_an_independent_reading(name: str) -> None:
    theirs = np.concatenate(list(drawn_triangles(SCENES / name))).reshape(-1, 3)
    ours = np.array([item.bounds_m for item in scene(name).objects])
    np.testing.assert_allclose(ours[:, 0].min(axis=0), theirs.min(axis=0), atol=1e-5)
    np.testing.assert_allclose(ours[:, 1].max(axis=0), theirs.max(axis=0), atol=1e-5)


def test_draco_gives_what_the_file_promises() -> None:
    """The header tells the bounds of every compressed mesh; one step of quantisation is allowed."""
    header, _ = header_and_buffer(SCENES / DRACO)
    for item, node in zip(scene(DRACO).objects, header["nodes"][2:], strict=True):
        positions = header["meshes"][node["mesh"]]["primitives"][0]["attributes"]["POSITION"]
        row = header["accessors"][positions]
        size = np.ptp([row["min"], row["max"]], axis=0)
        np.testing.assert_allclose(
            np.sort(np.ptp(item.geometry.mesh.bounds_m, axis=0)), np.sort(size), atol=float(size.max()) / 2**10
        )


# -- what the scenes are known for -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", [COMPOSED, BATHROOM])
def test_closed_things_face_outwards(name: str) -> None:
    """The volume of a closed mesh is positive; floor and walls are boxes of known size."""
    for item in scene(name).objects:
        if (
            item.id.startswith(("floor", "wall_back", "wall_left", "wall_right"))
            and len(item.geometry.mesh.faces) == 12
        ):
            a, b, c = (item.geometry.mesh.vertices_m[item.geometry.mesh.faces[:, k]] for k in range(3))
            volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
            assert volume == pytest.approx(np.prod(item.size_m), rel=1e-6)


@pytest.mark.parametrize(
    ("name", "copies"),
    [
        (LIVING, ["RoomWindow_01_006", "RoomWindow_01_007", "RoomWindow_01_008", "RoomWindow_01_009"]),
        (LIVING, ["ChairD_01_001", "ChairD_01_002"]),
        (LIVING, ["DeskPortraitD_01", "DeskPortraitD_02", "DeskPortraitD_03", "DeskPortraitD_04"]),
        (BEDROOM, ["NightStand_01_001", "NightStand_01_002"]),
        (COMPOSED, ["chair_left", "chair_right"]),
        (COMPOSED, ["plate_1", "plate_2"]),
    ],
)
def test_copies_share_their_mesh(name: str, copies: list[str]) -> None:
    objects = [scene(name).object(object_id) for object_id in copies]
    assert len({id(item.geometry) for item in objects}) == 1
    assert len({item.instance_key for item in objects}) == 1
    assert len({item.surface for item in objects}) == 1


def test_things_that_are_no_copies_do_not_share() -> None:
    assert scene(LIVING).object("PortraitB_01").instance_key != scene(LIVING).object("PortraitD_01").instance_key


@pytest.mark.parametrize("name", [LIVING, BEDROOM, COMPOSED, BATHROOM, MERGED])
def test_plausible_scenes_are_silent(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        load_scene(SCENES / name)


@pytest.mark.parametrize(("name", "unit_m"), [(KITCHEN, "0.01"), (DRACO, "0.1")])
def test_lying_units_are_found_out(name: str, unit_m: str) -> None:
    with pytest.warns(UnitWarning, match=rf"unit_m={unit_m} "):
        load_scene(SCENES / name)


# Length, width and thickness [m] from the corners of each mesh, read by hand from its bounds and coordinates: the slab
# of a table, the leaf of a door, the pane and frame of a window.
SIZES: dict[tuple[str, str], tuple[float, float, float]] = {
    (LIVING, "CoffeeTable_01_001"): (1.321, 0.668, 0.020),
    (LIVING, "BalconyTable_01_001"): (0.557, 0.557, 0.030),
    (LIVING, "Carpet_01_001"): (4.012, 3.464, 0.002),
    (LIVING, "FloorB_01_001"): (11.40, 7.45, 0.0),
    (LIVING, "ShoeRack_01_001"): (0.893, 0.299, 0.035),
    (BEDROOM, "ReadingDesk_01_001"): (1.146, 0.530, 0.027),
    (BEDROOM, "Wardrobe_01_001"): (2.143, 0.999, 0.599),
    (BEDROOM, "RoomWall_01_001"): (4.430, 1.856, 0.105),
    (COMPOSED, "floor"): (8.4, 4.8, 0.1),
    (COMPOSED, "wall_back"): (8.4, 2.95, 0.1),
    (COMPOSED, "cutting_board"): (0.54, 0.36, 0.054),
    (BATHROOM, "bath_mat"): (0.687, 0.379, 0.016),
    (BATHROOM, "mirror"): (0.793, 0.55, 0.022),
    (BATHROOM, "stool"): (0.375, 0.375, 0.1),
    (DRACO, "Object_10"): (26.2, 26.2, 1.43),
}


@pytest.mark.parametrize(("place", "expected"), SIZES.items(), ids=[f"{name}" for _, name in SIZES])
def test_sizes_are_those_read_by_hand(place: tuple[str, str], expected: tuple[float, float, float]) -> None:
    name, object_id = place
    # Rounded edges shorten the median span a little; 2 % and a millimetre allow for them.
    assert scene(name).object(object_id).size_m == pytest.approx(expected, rel=0.02, abs=1e-3)


# -- broken ----------------------------------------------------------------------------------------------------------


def outcome(path: Path) -> str:
    with warnings.catch_warnings():
        # A byte of an image may be hit as well.
        warnings.simplefilter("ignore", TextureWarning)
        try:
            load_scene(path, unit_m=1.0)
        except Scene2HapError as error:
            return type(error).__name__
    return "ok"


def test_a_real_file_cut_short_is_refused(tmp_path: Path) -> None:
    data = (SCENES / MERGED).read_bytes()
    path = tmp_path / "scene.glb"
    for length in np.linspace(0, len(data) - 1, 60).astype(int):
        path.write_bytes(data[:length])
        assert outcome(path) == "SceneFormatError"


@pytest.mark.parametrize(("name", "n"), [(MERGED, 120), (DRACO, 5)])
def test_flipped_bytes_lead_to_our_own_errors_or_to_a_scene(tmp_path: Path, name: str, n: int) -> None:
    data = np.frombuffer((SCENES / name).read_bytes(), np.uint8)
    rng = np.random.default_rng(300)
    outcomes = set()
    for _ in range(n):
        mutated = data.copy()
        mutated[rng.integers(20, len(data), size=rng.integers(1, 4))] ^= rng.integers(1, 256, dtype=np.uint8)
        (tmp_path / "scene.glb").write_bytes(mutated.tobytes())
        outcomes.add(outcome(tmp_path / "scene.glb"))
    assert outcomes <= {"ok", "SceneFormatError", "SceneError"}
