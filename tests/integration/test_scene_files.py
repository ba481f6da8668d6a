"""Loading scene files: the rooms of the tests, and scenes by others where they are present.

The properties of the rooms are known by construction; the others were counted by hand. Both are compared with an
independent reader of the same files.
"""

from __future__ import annotations

import subprocess
import sys
import warnings
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TypeVar

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_reading import drawn_triangles, header_and_buffer, images_of
from others import SCENES, needed, there
from rooms import ROOMS, room_file
from scene2hap.errors import Scene2HapError
from scene2hap.scene.load import TextureWarning, UnitWarning, load_scene
from scene2hap.scene.snapshot import SceneSnapshot

# Objects counted by hand in the lists of nodes: those that a user would point at.
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
TEXTURED = [name for name, room in ROOMS.items() if room.n_looks[1] and room.up_axis == "y"]
OWN_GLTF = [name for name, room in ROOMS.items() if room.up_axis == "y"]

T = TypeVar("T")


def others(*names: str) -> list[str]:
    """The given scenes by others that are present."""
    return there(names, SCENES.joinpath)


def known(own: Mapping[str, T], by_others: Mapping[str, T]) -> list[tuple[str, T]]:
    """Known properties of the rooms, and of the scenes by others that are present."""
    return [*own.items(), *((name, by_others[name]) for name in others(*by_others))]


def file_of(name: str) -> Path:
    return room_file(name) if name in ROOMS else SCENES / name


@cache
def scene(name: str) -> SceneSnapshot:
    return load_scene(file_of(name), unit_m=1.0)


@pytest.mark.parametrize(("name", "count"), known({name: len(room.things) for name, room in ROOMS.items()}, COUNTS))
def test_every_composed_item_is_one_object(name: str, count: int) -> None:
    assert len(scene(name).objects) == count


@pytest.mark.parametrize("name", ROOMS)
def test_names_and_axis_equal_the_composition(name: str) -> None:
    assert [item.id for item in scene(name).objects] == ROOMS[name].ids
    assert scene(name).up_axis == ROOMS[name].up_axis


def test_names_equal_the_authored_names() -> None:
    needed(SCENES)
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


@pytest.mark.parametrize(("name", "n"), [(name, 4 if name == MERGED else 2) for name in (*ROOMS, *others(*COUNTS))])
def test_every_load_is_the_same(name: str, n: int) -> None:
    """A file with six primitives in a mesh is loaded four times: trimesh would name them at random."""
    assert all(load_scene(file_of(name), unit_m=1.0) == scene(name) for _ in range(n - 1))


def test_another_process_reads_the_same() -> None:
    code = (
        "import sys; from scene2hap.scene.load import load_scene; "
        "print([(i.id, i.instance_key) for p in sys.argv[1:] for i in load_scene(p, unit_m=1.0).objects])"
    )
    names = [name for name in (*ROOMS, BATHROOM, MERGED) if file_of(name).exists()]
    paths = [str(file_of(name)) for name in names]
    done = subprocess.run([sys.executable, "-c", code, *paths], capture_output=True, text=True, check=True)
    expected = [(item.id, item.instance_key) for name in names for item in scene(name).objects]
    assert done.stdout.strip() == str(expected)


# -- an independent reading ------------------------------------------------------------------------------------------


def world_triangles(snapshot: SceneSnapshot) -> NDArray[np.float64]:
    meshes = [
        (item.pose.to_world(item.geometry.mesh.vertices_m), item.geometry.mesh.faces) for item in snapshot.objects
    ]
    return np.concatenate([points[faces] for points, faces in meshes])


@pytest.mark.parametrize("name", [*OWN_GLTF, *others(KITCHEN, COMPOSED, BATHROOM, MERGED)])
def test_every_triangle_has_the_place_of_the_file(name: str) -> None:
    """All corners of all triangles agree as sets, within 1e-5 of the scene's size."""
    ours = world_triangles(scene(name)).reshape(-1, 9)
    theirs = np.concatenate(list(drawn_triangles(file_of(name)))).reshape(-1, 9)
    assert len(ours) == len(theirs)
    size = float(np.ptp(theirs))
    # Sums with fixed weights order both sets equally, for any order of the corners.
    marks = [np.sort(rows.reshape(-1, 3) @ [1.0, np.pi, np.e]) for rows in (ours, theirs)]
    np.testing.assert_allclose(marks[0], marks[1], atol=1e-5 * size)


@pytest.mark.parametrize("name", [*TEXTURED, *others(KITCHEN, COMPOSED, BATHROOM)])
def test_every_corner_has_the_coordinates_that_the_file_gives_it(name: str) -> None:
    theirs = np.concatenate(list(drawn_triangles(file_of(name), textured=True))).reshape(-1, 5)
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
    # Distinct weights, so that coordinates at a wrong corner change the sums.
    marks = [np.sort(table / size @ [1.0, np.pi, np.e, 10.1, 31.7]) for table in (ours, theirs)]
    np.testing.assert_allclose(marks[0], marks[1], atol=1e-4)


# Materials that primitives use, and different images of these materials, counted in the files.
LOOKS = {
    KITCHEN: (16, 16),
    LIVING: (35, 22),
    BEDROOM: (27, 22),
    COMPOSED: (28, 1),
    BATHROOM: (48, 2),
    DRACO: (16, 15),
    MERGED: (6, 0),
}


@pytest.mark.parametrize(("name", "count"), known({name: ROOMS[name].n_looks for name in OWN_GLTF}, LOOKS))
def test_every_material_and_texture_is_read_once(name: str, count: tuple[int, int]) -> None:
    header, buffer = header_and_buffer(file_of(name))
    used = {primitive["material"] for mesh in header["meshes"] for primitive in mesh["primitives"]}
    images = {image for i in used for image in images_of(header, buffer, header["materials"][i], file_of(name).parent)}
    materials = {
        id(material): material
        for item in scene(name).objects
        if item.appearance is not None
        for material in item.appearance.materials
    }
    textures = {id(material.texture): material.texture for material in materials.values() if material.has_texture}
    assert (len(materials), len(textures)) == count == (len(used), len(images))
    for texture in textures.values():
        assert texture is not None
        assert max(texture.shape) <= 1024
        assert np.ptp(texture) > 0


@pytest.mark.parametrize("name", [*OWN_GLTF, *others(LIVING, BEDROOM)])
def test_bounds_equal_those_of_an_independent_reader(name: str) -> None:
    theirs = np.concatenate(list(drawn_triangles(file_of(name)))).reshape(-1, 3)
    ours = np.array([item.bounds_m for item in scene(name).objects])
    np.testing.assert_allclose(ours[:, 0].min(axis=0), theirs.min(axis=0), atol=1e-5)
    np.testing.assert_allclose(ours[:, 1].max(axis=0), theirs.max(axis=0), atol=1e-5)


def test_draco_meshes_have_the_bounds_of_the_header() -> None:
    """The header states the bounds of every compressed mesh; one step of quantisation is allowed."""
    header, _ = header_and_buffer(needed(SCENES / DRACO))
    for item, node in zip(scene(DRACO).objects, header["nodes"][2:], strict=True):
        positions = header["meshes"][node["mesh"]]["primitives"][0]["attributes"]["POSITION"]
        row = header["accessors"][positions]
        size = np.ptp([row["min"], row["max"]], axis=0)
        np.testing.assert_allclose(
            np.sort(np.ptp(item.geometry.mesh.bounds_m, axis=0)), np.sort(size), atol=float(size.max()) / 2**10
        )


# -- known properties of the scenes ----------------------------------------------------------------------------------


BOXES_BY_OTHERS = ("floor", "wall_back", "wall_left", "wall_right")


@pytest.mark.parametrize("name", [*ROOMS, *others(COMPOSED, BATHROOM)])
def test_closed_meshes_face_outwards(name: str) -> None:
    """The volume of a closed mesh is positive, and the volume of a box follows from its size."""
    for item in scene(name).objects:
        mesh = item.geometry.mesh
        a, b, c = (mesh.vertices_m[mesh.faces[:, k]] for k in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        if name in ROOMS:
            assert volume > 0
        if len(mesh.faces) == 12 and (name in ROOMS or item.id.startswith(BOXES_BY_OTHERS)):
            assert volume == pytest.approx(np.prod(item.size_m), rel=1e-6)


COPIES = [
    (LIVING, ["RoomWindow_01_006", "RoomWindow_01_007", "RoomWindow_01_008", "RoomWindow_01_009"]),
    (LIVING, ["ChairD_01_001", "ChairD_01_002"]),
    (LIVING, ["DeskPortraitD_01", "DeskPortraitD_02", "DeskPortraitD_03", "DeskPortraitD_04"]),
    (BEDROOM, ["NightStand_01_001", "NightStand_01_002"]),
    (COMPOSED, ["chair_left", "chair_right"]),
    (COMPOSED, ["plate_1", "plate_2"]),
]
OWN_COPIES = [(name, list(copies)) for name, room in ROOMS.items() for copies in room.copies]


@pytest.mark.parametrize(("name", "copies"), [*OWN_COPIES, *there(COPIES, lambda case: SCENES / case[0])])
def test_copies_share_their_mesh(name: str, copies: list[str]) -> None:
    objects = [scene(name).object(object_id) for object_id in copies]
    assert len({id(item.geometry) for item in objects}) == 1
    assert len({item.instance_key for item in objects}) == 1
    assert len({item.surface for item in objects}) == 1


@pytest.mark.parametrize("name", ROOMS)
def test_only_objects_of_one_mesh_share_it(name: str) -> None:
    meshes = {thing.id: id(thing.mesh) for thing in ROOMS[name].things}
    loaded = {item.id: id(item.geometry) for item in scene(name).objects}
    for x in meshes:
        assert {y for y in loaded if loaded[x] == loaded[y]} == {y for y in meshes if meshes[x] == meshes[y]}


@pytest.mark.parametrize(
    ("name", "one", "other"),
    [("dining_room", "plate_1", "cup"), *((name, "PortraitB_01", "PortraitD_01") for name in others(LIVING))],
)
def test_distinct_objects_do_not_share_meshes(name: str, one: str, other: str) -> None:
    assert scene(name).object(one).instance_key != scene(name).object(other).instance_key


@pytest.mark.parametrize("name", [*ROOMS, *others(LIVING, BEDROOM, COMPOSED, BATHROOM, MERGED)])
def test_plausible_scenes_do_not_warn(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        load_scene(file_of(name))


@pytest.mark.parametrize(
    ("name", "unit_m"), [("dining_room", 0.01), ("dining_room", 0.1), *known({}, {KITCHEN: 0.01, DRACO: 0.1})]
)
def test_wrong_units_are_detected(tmp_path: Path, name: str, unit_m: float) -> None:
    own = ROOMS.get(name)
    path = SCENES / name if own is None else own.in_units(unit_m).write(tmp_path)
    with pytest.warns(UnitWarning, match=rf"unit_m={unit_m:g} "):
        load_scene(path)
    if own is not None:
        sizes_m = [item.size_m for item in load_scene(path, unit_m=unit_m).objects]
        np.testing.assert_allclose(sizes_m, [item.size_m for item in scene(name).objects], rtol=1e-4)


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


OWN_SIZES = {(name, thing): size for name, room in ROOMS.items() for thing, size in room.sizes_m.items()}


@pytest.mark.parametrize(
    ("name", "object_id", "expected"),
    [(*place, size) for place, size in OWN_SIZES.items()]
    + [(*place, SIZES[place]) for place in there(SIZES, lambda place: SCENES / place[0])],
)
def test_sizes_equal_constructed_or_hand_measured_sizes(
    name: str, object_id: str, expected: tuple[float, float, float]
) -> None:
    # Rounded edges shorten the median span a little; 2 % and a millimetre allow for them. The rooms have none.
    bounds = {"rel": 1e-3} if name in ROOMS else {"rel": 0.02, "abs": 1e-3}
    assert scene(name).object(object_id).size_m == pytest.approx(expected, **bounds)


# -- broken ----------------------------------------------------------------------------------------------------------


def outcome(path: Path) -> str:
    with warnings.catch_warnings():
        # The damage may also hit an image.
        warnings.simplefilter("ignore", TextureWarning)
        try:
            load_scene(path, unit_m=1.0)
        except Scene2HapError as error:
            return type(error).__name__
    return "ok"


@pytest.mark.parametrize(("name", "n"), [*((name, 20) for name in ROOMS), *((name, 60) for name in others(MERGED))])
def test_a_file_cut_short_is_refused(tmp_path: Path, name: str, n: int) -> None:
    data = file_of(name).read_bytes()
    path = tmp_path / file_of(name).name
    # A GLB states its length, and up to three bytes at its end may be padding. A cut JSON gives one of two errors.
    expected = {"SceneFormatError"} | ({"SceneError"} if path.suffix == ".json" else set())
    for length in np.linspace(0, len(data) - 4, n).astype(int):
        path.write_bytes(data[:length])
        assert outcome(path) in expected


@pytest.mark.parametrize(("name", "n"), known(dict.fromkeys(ROOMS, 10), {MERGED: 50, DRACO: 5}))
def test_flipped_bytes_give_a_scene_error_or_a_scene(tmp_path: Path, name: str, n: int) -> None:
    data = np.frombuffer(file_of(name).read_bytes(), np.uint8)
    path = tmp_path / file_of(name).name
    rng = np.random.default_rng(300)
    outcomes = set()
    for _ in range(n):
        mutated = data.copy()
        mutated[rng.integers(20, len(data), size=rng.integers(1, 4))] ^= rng.integers(1, 256, dtype=np.uint8)
        path.write_bytes(mutated.tobytes())
        outcomes.add(outcome(path))
    assert outcomes <= {"ok", "SceneFormatError", "SceneError"}
