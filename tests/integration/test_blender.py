"""The Blender script: a scene built with `bpy` is exported as GLB, JSON and pictures, and loaded again.

Needs a Python with the package bpy: the one that SCENE2HAP_BPY_PYTHON names, or this one. Expected sizes are computed
by hand from the numbers of `BUILD`, which are centimetres.
"""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from hinged_doors import check_door
from scene2hap import SceneObject, SceneSnapshot, load_scene
from scene2hap.scene.capture.given_pictures import GivenPictures

SCRIPT = Path(__file__).parents[2] / "clients" / "blender" / "export_scene2hap.py"
PYTHON = os.environ.get("SCENE2HAP_BPY_PYTHON") or (sys.executable if importlib.util.find_spec("bpy") else "")
needs_bpy = pytest.mark.skipif(
    not PYTHON,
    reason="needs Blender as a module: pip install bpy, or name a Python that has it in SCENE2HAP_BPY_PYTHON",
)

HEAD = """
import bpy, math, sys
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.unit_settings.system, scene.unit_settings.scale_length = "METRIC", 0.01


def mesh(name, vertices, faces):
    data = bpy.data.meshes.new(name)
    data.from_pydata(vertices, [], faces)
    return data


def add(name, data, at=(0, 0, 0), scale=(1, 1, 1), parent=None, turn=0, into=scene.collection):
    obj = bpy.data.objects.new(name, data)
    obj.location, obj.scale, obj.rotation_euler, obj.parent = at, scale, (0, 0, math.radians(turn)), parent
    into.objects.link(obj)
    return obj


CORNERS = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
CUBE = mesh("cube", CORNERS, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
"""
BUILD = (
    HEAD
    + """
# No mirror image of itself, with its faces turned outwards: 10 x 20 x 30 cm, 1000 cm3.
WEDGE = mesh("wedge", [(0, 0, 0), (10, 0, 0), (0, 20, 0), (0, 0, 30)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])

table = add("Table", CUBE, (0, 0, 72), (120, 70, 4))
bpy.context.view_layer.objects.active = table
bpy.ops.rigidbody.object_add()
table.rigid_body.mass = 12e6  # which Blender shows as 12 kg, at a unit scale of 0.01
add("Wedge", WEDGE, (200, 0, 0), (-1, 1, 1))
lamp = add("Desk lamp", None, (-30, 0, 74), turn=90)
add("shade", CUBE, (0, 0, 30), (20, 20, 10), lamp)
add("mirrored arm", WEDGE, (0, 0, 0), (1, 1, -1), lamp)
plane = mesh("plane", [(-50, -30, 0), (50, -30, 0), (50, 30, 0), (-50, 30, 0)], [(0, 1, 2, 3)])
panel = add("Panel", plane, (0, 300, 100))
solid = panel.modifiers.new("Solidify", "SOLIDIFY")
solid.thickness, solid.offset = 2, 0
stool = add("Stool", CUBE, (100, 100, 22.5), (40, 30, 45))
bpy.context.view_layer.objects.active = stool
bpy.ops.rigidbody.object_add()  # of 1, Blender's default
add("Stool.001", CUBE, (-100, 100, 22.5), (40, 30, 45), turn=90)
parts = bpy.data.collections.new("mug parts")
add("body", CUBE, (0, 0, 5), (8, 8, 10), into=parts)
add("handle", CUBE, (5, 0, 5), (2, 4, 6), into=parts)
mug = add("Mug", None, (10, 20, 74))
mug.instance_type, mug.instance_collection = "COLLECTION", parts
group = add("Kitchenware", None, (0, -200, 0))
add("Bowl", CUBE, (50, 0, 10), (20, 20, 20), group)
kettle = add("Kettle", None, (0, 0, 0), parent=group)
add("can", CUBE, (0, 0, 10), (16, 16, 20), kettle)
add("spout", CUBE, (10, 0, 15), (4, 2, 2), kettle)
cabinet = add("Cabinet", CUBE, (0, 500, 40), (60, 40, 80))
door = add("door", CUBE, (0, -0.52, 0), (1, 0.04, 1), cabinet)
rod = bpy.data.curves.new("rod", "CURVE")
rod.dimensions, rod.extrude = "3D", 5  # a ribbon 10 cm high
line = rod.splines.new("POLY")
line.points.add(1)
line.points[1].co = (40, 0, 0, 1)
rod.materials.append(bpy.data.materials.new("Brass"))
add("Towel ribbon", rod, (0, 0, 150))
text = bpy.data.objects.new("Cutting text", bpy.data.curves.new("text", "FONT"))
text.data.body, text.display_type = "A", "WIRE"
scene.collection.objects.link(text)
vase = add("Vase", CUBE, (0, 0, 0.625), (0.25, 0.25, 0.25), cabinet)
vase["scene2hap"] = "object"
add("Gizmo", CUBE, (0, 0, 500), (100, 100, 100))["scene2hap"] = "skip"
add("Cutter", CUBE, (0, 0, 0), (900, 900, 900)).display_type = "WIRE"
add("Hidden", CUBE, (0, 0, 600), (9, 9, 9)).hide_render = True
bedroom = add("Bedroom", None, (400, 0, 0), (0.5, 0.5, 0.5), turn=90)
bedroom["scene2hap"] = "group"
wardrobe_door = add("Wardrobe door", CUBE, (0, -33, 200), (120, 4, 400), bedroom)
wardrobe = add("Wardrobe", CUBE, (0, 0, 200), (120, 60, 400), bedroom)
bpy.context.view_layer.objects.active = wardrobe_door
bpy.ops.rigidbody.object_add()
bpy.context.view_layer.objects.active = wardrobe
bpy.ops.rigidbody.object_add(type="PASSIVE")
for name, x in (("disabled pivot", 60), ("pivot", -60)):
    bpy.context.view_layer.objects.active = pivot = add(name, None, (x, -31, 200), parent=bedroom)
    bpy.ops.rigidbody.constraint_add(type="HINGE")
    pivot.rigid_body_constraint.object1, pivot.rigid_body_constraint.object2 = wardrobe_door, wardrobe
    pivot.hide_viewport = name == "disabled pivot"
    pivot.hide_set(True)
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
"""
)
# Id: position, size of the world bounding box, volume; in m and m3.
EXPECTED = {
    "Table": ((0, 0, 0.72), (1.2, 0.7, 0.04), 1.2 * 0.7 * 0.04),
    "Wedge": ((2.0, 0, 0), (0.1, 0.2, 0.3), 1e-3),
    # Rotated by 90 degrees; the arm hangs 30 cm below its origin, the shade ends 35 cm above it.
    "Desk lamp": ((-0.3, 0, 0.74), (0.3, 0.2, 0.65), 0.2 * 0.2 * 0.1 + 1e-3),
    "Panel": ((0, 3.0, 1.0), (1.0, 0.6, 0.02), 1.0 * 0.6 * 0.02),
    "Stool": ((1.0, 1.0, 0.225), (0.4, 0.3, 0.45), 0.4 * 0.3 * 0.45),
    "Stool.001": ((-1.0, 1.0, 0.225), (0.3, 0.4, 0.45), 0.4 * 0.3 * 0.45),
    "Mug": ((0.1, 0.2, 0.74), (0.1, 0.08, 0.1), 0.08 * 0.08 * 0.1 + 0.02 * 0.04 * 0.06),
    "Bowl": ((0.5, -2.0, 0.1), (0.2, 0.2, 0.2), 0.2**3),
    "Kettle": ((0, -2.0, 0), (0.2, 0.16, 0.2), 0.16 * 0.16 * 0.2 + 0.04 * 0.02 * 0.02),
    # The door is 1.6 cm thick; its middle is 20 cm + 0.8 cm in front of the middle of a cabinet of 40 cm.
    "Cabinet": ((0, 5.0, 0.4), (0.6, 0.416, 0.8), 0.6 * 0.4 * 0.8 + 0.6 * 0.016 * 0.8),
    "Vase": ((0, 5.0, 0.9), (0.15, 0.1, 0.2), 0.15 * 0.1 * 0.2),
    "Towel ribbon": ((0, 0, 1.5), (0.4, 0, 0.1), 0),
    "Wardrobe": ((4.0, 0, 1.0), (0.3, 0.6, 2.0), 0.3 * 0.6 * 2.0),
    "Wardrobe door": ((4.165, 0, 1.0), (0.02, 0.6, 2.0), 0.02 * 0.6 * 2.0),
}


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([PYTHON, *map(str, arguments)], capture_output=True, text=True, timeout=120)


def written(code: str, folder: Path, *options: str) -> Path:
    """Build a scene with `code` and export it with the script. Returns the folder with its output."""
    (folder / "build.py").write_text(code, encoding="utf-8")
    built = run(folder / "build.py", folder / "made.blend")
    assert (folder / "made.blend").exists(), built.stdout + built.stderr
    done = run(SCRIPT, folder / "made.blend", "-o", folder / "out", *options)
    # The exit code is not checked: bpy 4.2 crashes at its end after any glTF export.
    assert "wrote " in done.stdout, done.stdout + done.stderr
    return folder / "out"


def volume_m3(item: SceneObject) -> float:
    a, b, c = np.moveaxis(np.asarray(item.geometry.mesh.vertices_m)[np.asarray(item.geometry.mesh.faces)], 1, 0)
    return float((a * np.cross(b, c)).sum() / 6)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if not PYTHON:
        pytest.skip("needs bpy")
    return written(BUILD, tmp_path_factory.mktemp("blender"), "--pictures", "none")


@pytest.fixture(scope="module")
def scenes(folder: Path) -> tuple[SceneSnapshot, SceneSnapshot]:
    return load_scene(folder / "scene.json"), load_scene(folder / "scene.glb")


def test_help_needs_no_blender() -> None:
    done = subprocess.run([sys.executable, str(SCRIPT), "--help"], capture_output=True, text=True)
    assert done.returncode == 0
    assert "--pictures" in done.stdout


def test_json_names_the_materials_of_an_object() -> None:
    spec = importlib.util.spec_from_file_location("export_scene2hap", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    oak, steel = SimpleNamespace(name="Oak"), SimpleNamespace(name="Steel")
    thing = script.Thing.__new__(script.Thing)
    thing.id = thing.name = thing.key = "table"
    thing.vertices_m, thing.position_m = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 2.0]]), np.zeros(3)
    thing.faces, thing.face_material = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2]]), [steel, oak, None]
    body = SimpleNamespace(rigid_body=None)
    thing.rotation, thing.owner, thing.bodies, thing.hinge = (1, 0, 0, 0), body, [body], None
    found = SceneSnapshot.from_json(json.dumps(script.scene_json("room", [thing], 1.0)))
    assert found.object("table").material_names == ("Oak", "Steel")


@needs_bpy
def test_json_and_glb_hold_the_same_objects(scenes: tuple[SceneSnapshot, SceneSnapshot]) -> None:
    from_json, from_glb = scenes
    assert {item.id for item in from_json.objects} == EXPECTED.keys()
    assert [(item.id, item.name) for item in from_glb.objects] == [(item.id, item.name) for item in from_json.objects]
    assert (from_json.up_axis, from_glb.up_axis) == ("z", "y")


@needs_bpy
@pytest.mark.parametrize("object_id", EXPECTED)
def test_objects_have_the_place_and_size_that_were_built(
    object_id: str, scenes: tuple[SceneSnapshot, SceneSnapshot]
) -> None:
    position_m, size_m, expected_m3 = EXPECTED[object_id]
    in_json, in_glb = (scene.object(object_id) for scene in scenes)
    np.testing.assert_allclose(in_json.pose.position_m, position_m, atol=1e-6)
    np.testing.assert_allclose(np.ptp(in_json.bounds_m, axis=0), size_m, atol=2e-6)
    # A mesh inside out would have a negative volume.
    assert volume_m3(in_json) == pytest.approx(expected_m3, rel=1e-4)
    assert volume_m3(in_glb) == pytest.approx(expected_m3, rel=1e-4)
    # (x, y, z) with z up is (x, z, -y) with y up.
    x, y, z = position_m
    np.testing.assert_allclose(in_glb.pose.position_m, (x, z, -y), atol=1e-6)
    (low_x, low_y, low_z), (high_x, high_y, high_z) = in_json.bounds_m
    turned = [(low_x, low_z, -high_y), (high_x, high_z, -low_y)]
    np.testing.assert_allclose(in_glb.bounds_m, turned, atol=2e-6)


@needs_bpy
def test_the_mirrored_wedge_points_to_the_other_side(scenes: tuple[SceneSnapshot, SceneSnapshot]) -> None:
    (low_x, low_y, _), (high_x, high_y, _) = scenes[0].object("Wedge").bounds_m
    assert (low_x, high_x) == pytest.approx((1.9, 2.0))
    assert (low_y, high_y) == pytest.approx((0.0, 0.2))


@needs_bpy
def test_mass_is_read_from_configured_rigid_bodies(scenes: tuple[SceneSnapshot, SceneSnapshot]) -> None:
    assert {item.id: item.mass_kg for item in scenes[0].objects if item.mass_kg is not None} == {
        "Table": pytest.approx(12.0)
    }


@needs_bpy
def test_a_rigid_body_hinge_holds_the_active_body_on_the_passive_one(
    scenes: tuple[SceneSnapshot, SceneSnapshot],
) -> None:
    assert [item.id for item in scenes[0].objects if item.hinge] == ["Wardrobe door"]
    check_door(scenes[0], (4.155, -0.3, 1.0), "Wardrobe door", "Wardrobe")


@needs_bpy
def test_linked_duplicates_are_copies(folder: Path, scenes: tuple[SceneSnapshot, SceneSnapshot]) -> None:
    for scene in scenes:
        keys = {item.id: item.instance_key for item in scene.objects}
        assert keys["Stool"] == keys["Stool.001"] != ""
        assert len(set(keys.values())) == len(EXPECTED) - 1
    assert len(json.loads((folder / "scene.json").read_text(encoding="utf-8"))["geometries"]) == len(EXPECTED) - 1


@needs_bpy
def test_a_curve_is_written_once(scenes: tuple[SceneSnapshot, SceneSnapshot]) -> None:
    for scene in scenes:
        ribbon = scene.object("Towel ribbon")
        assert len(ribbon.geometry.mesh.faces) == 2
        assert ribbon.material_names == ("Brass",)
        assert sorted(np.ptp(ribbon.bounds_m, axis=0)) == pytest.approx([0, 0.1, 0.4], abs=1e-6)


PICTURED = (
    HEAD
    + """
scene.unit_settings.scale_length = 1.0
red = bpy.data.materials.new("red paint")
red.use_nodes = True
red.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.8, 0.01, 0.01, 1)
CUBE.materials.append(red)
floor = mesh("floor", [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)], [(0, 1, 2, 3)])
add("Crate", CUBE, (0, 0, 0.5))
add("Crate.001", CUBE, (1.5, 0, 0.5))
add("Floor", floor)
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
"""
)
SIZE_PX = 96


@needs_bpy
def test_pictures_show_each_object_alone_and_outlined_among_others(tmp_path: Path) -> None:
    try:
        out = written(PICTURED, tmp_path, "--size-px", str(SIZE_PX))
    except AssertionError:  # Blender aborts without OpenGL
        out = written(PICTURED, tmp_path, "--size-px", str(SIZE_PX), "--engine", "cycles")
    pictures = GivenPictures.load(out)
    assert len(pictures) == 4 + 3 * 8 + 2 * 8  # copies share the pictures of the object alone
    scene = pictures.attach_to(load_scene(out / "scene.json"))
    crate, copy = scene.object("Crate").images, scene.object("Crate.001").images
    assert scene.images is not None
    assert crate is not None
    assert copy is not None
    assert [shot.label for shot in crate.isolated.shots][3:6] == ["above 300°", "below 30°", "below 120°"]
    assert [shot.label for shot in crate.context.shots] == [shot.label for shot in crate.isolated.shots]
    assert tuple(copy.isolated) == tuple(crate.isolated)
    for alone, among in zip(map(pixels, crate.isolated), map(pixels, crate.context), strict=True):
        is_object = (np.abs(alone - (190, 194, 200)) > 8).any(axis=2)
        rows, columns = np.flatnonzero(is_object.any(axis=1)), np.flatnonzero(is_object.any(axis=0))
        assert max(np.ptp(rows), np.ptp(columns)) + 1 == pytest.approx(0.75 * SIZE_PX, abs=2)
        middle = alone[SIZE_PX // 2, SIZE_PX // 2]
        assert middle[0] > 2 * max(middle[1], middle[2])  # red
        is_pink = (np.abs(among - (255, 0, 190)) <= 2).all(axis=2)
        rows, columns = np.flatnonzero(is_pink.any(axis=1)), np.flatnonzero(is_pink.any(axis=0))
        # Seen from 2.5 times the distance, with an outline of a pixel on each side.
        assert max(np.ptp(rows), np.ptp(columns)) + 1 == pytest.approx(0.75 / 2.5 * SIZE_PX + 2, abs=2)
        assert not is_pink[SIZE_PX // 2, SIZE_PX // 2]
    from_above = pixels(scene.images[0])
    assert ((from_above[..., 0] > 2 * from_above[..., 1]) & (from_above[..., 0] > 60)).sum() > 50  # two crates
    assert not (np.abs(from_above - (255, 0, 190)) <= 2).all(axis=2).any()


def pixels(file: bytes) -> np.ndarray:
    import io

    with Image.open(io.BytesIO(file)) as image:
        assert image.size == (SIZE_PX, SIZE_PX)
        return np.asarray(image.convert("RGB")).astype(int)


PLAIN = (
    HEAD.replace("0.01", "1.0")
    + """
chair, setting = (bpy.data.collections.new(name) for name in ("Chair", "Place setting"))
add("seat", CUBE, (0, 0, 0.45), (0.4, 0.4, 0.04), into=chair)
for x, y in ((-0.18, -0.18), (0.18, -0.18), (-0.18, 0.18), (0.18, 0.18)):
    add("leg", CUBE, (x, y, 0.215), (0.04, 0.04, 0.43), into=chair)
add("backrest", CUBE, (0, 0.18, 0.7), (0.4, 0.04, 0.46), into=chair)
add("plate", CUBE, (0, 0, 0.01), (0.25, 0.25, 0.02), into=setting)
add("fork", CUBE, (-0.2, 0, 0.005), (0.02, 0.2, 0.01), into=setting)
for name, collection, x in (("Chair", chair, 0), ("Chair", chair, 1), ("Place setting", setting, 3)):
    shown = add(name, None, (x, 0, 0))
    shown.instance_type, shown.instance_collection = "COLLECTION", collection
bpy.ops.export_scene.gltf(filepath=sys.argv[-1] + ".glb")
bpy.ops.wm.usd_export(filepath=sys.argv[-1] + ".usdc")
bpy.ops.wm.usd_export(filepath=sys.argv[-1] + "_shared.usdc", use_instancing=True)
"""
)


@needs_bpy
@pytest.mark.parametrize("ending", [".glb", ".usdc", "_shared.usdc"])
def test_a_collection_instance_in_a_plain_export_is_one_object(ending: str, tmp_path: Path) -> None:
    if ending != ".glb":
        pytest.importorskip("pxr")
    (tmp_path / "build.py").write_text(PLAIN, encoding="utf-8")
    built = run(tmp_path / "build.py", tmp_path / "made")
    assert (tmp_path / f"made{ending}").exists(), built.stdout + built.stderr
    found = load_scene(tmp_path / f"made{ending}").objects
    assert sorted(item.name for item in found) == ["Chair", "Chair.001", "fork", "plate"]
    first, second = (item for item in found if item.name.startswith("Chair"))
    np.testing.assert_allclose(first.size_m, second.size_m, atol=1e-6)
    if ending == ".glb":  # USD may store each copy, rounded to float32
        assert first.instance_key == second.instance_key
