"""USD scenes: stage, meshes, materials and masses; skipped where usd-core is not installed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from looks import BLUE, GREEN, UPRIGHT, image_file, looks, refused, shown
from scene2hap.errors import SceneFormatError
from scene2hap.scene.load import load_scene
from scene2hap.scene.looks.appearance import srgb
from scene2hap.scene.objects import SceneObject
from usd_writing import (
    CUBE_POINTS,
    bind,
    ids,
    instancer,
    mesh,
    new_stage,
    painted_square,
    preview,
    scene_of,
    text_file,
    usd,
)

SUFFIXES = [".usda", ".usdc", ".usd"]


def volume(item: SceneObject) -> float:
    """The signed volume of a mesh [m3]: above 0 if its faces point outwards."""
    corners = item.geometry.mesh.vertices_m[item.geometry.mesh.faces]
    return float(np.linalg.det(corners).sum() / 6)


# -- the tree --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_prims_keep_names_and_transforms(tmp_path: Path, suffix: str) -> None:
    def fill(stage: Any) -> None:
        geom = usd("UsdGeom")
        geom.Xform.Define(stage, "/World").AddTranslateOp().Set((10, 0, 0))
        shelf = geom.Xform.Define(stage, "/World/shelf")
        shelf.AddTranslateOp().Set((0, 5, 0))
        shelf.AddRotateZOp().Set(90.0)
        shelf.AddScaleOp().Set((2, 1, 1))
        mesh(stage, "/World/shelf/shape")
        lamp = mesh(stage, "/World/lamp_01")
        lamp.GetPrim().SetDisplayName("Ständerlampe")
        lamp.AddTransformOp().Set(usd("Gf").Matrix4d([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [1, 2, 3, 1]]))

    shelf, lamp = scene_of(fill, tmp_path, suffix=suffix).objects
    assert (shelf.id, lamp.id) == ("shelf", "Ständerlampe")
    np.testing.assert_allclose(shelf.bounds_m, [[9, 5, 0], [10, 7, 1]], atol=1e-9)
    np.testing.assert_allclose(shelf.pose.position_m, [10, 5, 0], atol=1e-9)
    np.testing.assert_allclose(lamp.bounds_m, [[11, 1, 3], [12, 2, 4]], atol=1e-9)
    np.testing.assert_allclose(lamp.pose.rotation, [[1, 0, 0], [0, 0, -1], [0, 1, 0]], atol=1e-9)


def test_a_reset_transform_starts_from_the_world(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        usd("UsdGeom").Xform.Define(stage, "/World").AddTranslateOp().Set((10, 0, 0))
        box = mesh(stage, "/World/box")
        box.AddTranslateOp().Set((0, 3, 0))
        box.SetResetXformStack(True)

    (box,) = scene_of(fill, tmp_path).objects
    np.testing.assert_allclose(box.bounds_m, [[0, 3, 0], [1, 4, 1]], atol=1e-9)


def test_time_sampled_values_are_read_at_the_first_sample(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        moved = mesh(stage, "/moved").AddTranslateOp()
        moved.Set((1, 0, 0), 5)
        moved.Set((9, 0, 0), 10)
        rests = mesh(stage, "/rests").AddTranslateOp()
        rests.Set((2, 0, 0))
        rests.Set((9, 0, 0), 10)

    moved, rests = scene_of(fill, tmp_path, suffix=".usdc").objects
    assert moved.bounds_m[0, 0] == pytest.approx(1)
    assert rests.bounds_m[0, 0] == pytest.approx(2)


@pytest.mark.parametrize(("up", "expected"), [("Y", "y"), ("Z", "z"), (None, "y")])
def test_up_axis_comes_from_the_stage(tmp_path: Path, up: str | None, expected: str) -> None:
    stage = new_stage(tmp_path / "a.usda", up=up)
    mesh(stage, "/box")
    stage.Save()
    assert load_scene(tmp_path / "a.usda", unit_m=1.0).up_axis == expected


@pytest.mark.parametrize(("unit_m", "edge_m"), [(1.0, 1.0), (0.5, 0.5), (None, 0.01)])
def test_unit_comes_from_the_stage_and_defaults_to_centimetres(
    tmp_path: Path, unit_m: float | None, edge_m: float
) -> None:
    path = tmp_path / "a.usda"
    stage = new_stage(path, unit_m=unit_m)
    mesh(stage, "/box")
    stage.Save()
    (box,) = load_scene(path).objects
    np.testing.assert_allclose(box.bounds_m[1], edge_m)
    (box,) = load_scene(path, unit_m=3.0).objects
    np.testing.assert_allclose(box.bounds_m[1], 3.0)


@pytest.mark.parametrize("unit", ["0", "-1", "nan"])
def test_invalid_unit_is_refused(tmp_path: Path, unit: str) -> None:
    path = text_file(tmp_path, f'(\n metersPerUnit = {unit}\n)\ndef Cube "a" {{}}\n')
    with pytest.raises(SceneFormatError, match=rf"'scene\.usda' has {unit} metres per unit; .* or give unit_m"):
        load_scene(path)
    assert load_scene(path, unit_m=0.01).objects[0].whole_size_m("y") == pytest.approx((0.02, 0.02, 0.02))


def test_invisible_prims_are_left_out(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        geom = usd("UsdGeom")
        mesh(stage, "/shown")
        mesh(stage, "/hidden").MakeInvisible()
        geom.Xform.Define(stage, "/closed").MakeInvisible()
        mesh(stage, "/closed/box")
        mesh(stage, "/guide").CreatePurposeAttr("guide")
        geom.Xform.Define(stage, "/stand_in").CreatePurposeAttr("proxy")
        mesh(stage, "/stand_in/box")
        geom.Xform.Define(stage, "/drawn").CreatePurposeAttr("render")
        mesh(stage, "/drawn/box")
        mesh(stage, "/off").GetPrim().SetActive(False)
        stage.CreateClassPrim("/_class")
        mesh(stage, "/_class/box")
        stage.OverridePrim("/_over")
        geom.BasisCurves.Define(stage, "/wire")
        geom.Points.Define(stage, "/dust").CreatePointsAttr([(0, 0, 0)])
        geom.Camera.Define(stage, "/camera")

    assert ids(scene_of(fill, tmp_path)) == ["shown", "drawn"]


def test_native_instances_share_their_mesh(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        geom = usd("UsdGeom")
        stage.CreateClassPrim("/_cup")
        mesh(stage, "/_cup/shape")
        for number in range(3):
            cup = geom.Xform.Define(stage, f"/cup_{number}")
            cup.GetPrim().GetReferences().AddInternalReference("/_cup")
            cup.GetPrim().SetInstanceable(True)
            cup.AddTranslateOp().Set((3 * number, 0, 0))

    scene = scene_of(fill, tmp_path)
    assert ids(scene) == ["cup_0", "cup_1", "cup_2"]
    first, *others = scene.objects
    assert all(item.geometry is first.geometry and item.instance_key == first.instance_key for item in others)
    assert [item.bounds_m[0, 0] for item in scene.objects] == pytest.approx([0, 3, 6])


def test_a_point_instancer_draws_one_object_for_each_point(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        made = instancer(stage)
        made.CreateScalesAttr([(1, 1, 1), (1, 1, 1), (2, 2, 2)])
        made.CreateOrientationsAttr([usd("Gf").Quath(1, 0, 0, 0)] * 3)
        made.AddTranslateOp().Set((0, 7, 0))

    scene = scene_of(fill, tmp_path)
    assert ids(scene) == ["cup", "cup#2", "cup#3"]
    assert scene.objects[0].geometry is scene.objects[1].geometry
    np.testing.assert_allclose(scene.objects[1].bounds_m, [[2, 7, 0], [3, 8, 1]], atol=1e-9)
    np.testing.assert_allclose(scene.objects[2].bounds_m, [[4, 7, 0], [6, 9, 2]], atol=1e-9)


def test_invisible_points_are_left_out(tmp_path: Path) -> None:
    scene = scene_of(lambda stage: instancer(stage).CreateInvisibleIdsAttr([1]), tmp_path)
    assert [item.bounds_m[0, 0] for item in scene.objects] == pytest.approx([0, 4])


def test_a_point_without_a_prototype_or_place_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SceneFormatError, match="protoIndices go to 7; it has 1 prototypes"):
        scene_of(lambda stage: instancer(stage).CreateProtoIndicesAttr([0, 7, 0]), tmp_path)
    (tmp_path / "scene.usda").unlink()
    with pytest.raises(SceneFormatError, match="3 protoIndices and places for 0 copies"):
        scene_of(lambda stage: instancer(stage).CreatePositionsAttr([(0, 0, 0)]), tmp_path)


def test_component_is_one_object_unless_it_contains_the_whole_scene(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        geom, models = usd("UsdGeom"), usd("Usd").ModelAPI
        models(geom.Xform.Define(stage, "/kitchen").GetPrim()).SetKind("component")
        models(geom.Xform.Define(stage, "/kitchen/chair").GetPrim()).SetKind("component")
        for part in ("seat", "leg"):
            geom.Xform.Define(stage, f"/kitchen/chair/{part}")
            mesh(stage, f"/kitchen/chair/{part}/a")
            mesh(stage, f"/kitchen/chair/{part}/b").AddTranslateOp().Set((0, 3, 0))
        mesh(stage, "/kitchen/pot")

    assert ids(scene_of(fill, tmp_path)) == ["chair", "pot"]


def test_an_object_of_blender_has_its_own_mesh_and_its_parts(tmp_path: Path) -> None:
    def named(prim: Any, kind: str, name: str) -> None:
        attribute = prim.CreateAttribute(f"userProperties:blender:{kind}_name", usd("Sdf").ValueTypeNames.String)
        attribute.Set(name)

    def fill(stage: Any) -> None:
        for path, name, x in (("/root/Table", "Dining table", 0), ("/root/Table/leg_001", "leg.001", 1)):
            place = usd("UsdGeom").Xform.Define(stage, path)
            place.AddTranslateOp().Set((x, 0, 0))
            named(place.GetPrim(), "object", name)
            named(mesh(stage, f"{path}/Cube_012").GetPrim(), "data", "Cube.012")

    (table,) = scene_of(fill, tmp_path).objects
    assert table.id == "Dining table"
    np.testing.assert_allclose(table.bounds_m, [[0, 0, 0], [2, 1, 1]], atol=1e-9)


def test_a_rigid_body_is_one_object(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        geom, bodies = usd("UsdGeom"), usd("UsdPhysics").RigidBodyAPI
        models = usd("Usd").ModelAPI
        models(geom.Xform.Define(stage, "/cabinet").GetPrim()).SetKind("component")
        for name in ("frame", "door"):
            bodies.Apply(geom.Xform.Define(stage, f"/cabinet/{name}").GetPrim())
            mesh(stage, f"/cabinet/{name}/visuals/left")
            mesh(stage, f"/cabinet/{name}/visuals/right").AddTranslateOp().Set((4, 0, 0))
        mesh(stage, "/floor")

    assert ids(scene_of(fill, tmp_path)) == ["frame", "door", "floor"]


# -- meshes ----------------------------------------------------------------------------------------------------------


def test_quadrilaterals_become_triangles_that_face_outwards(tmp_path: Path) -> None:
    (box,) = scene_of(lambda stage: mesh(stage, "/box"), tmp_path).objects
    assert len(box.geometry.mesh.faces) == 12
    assert volume(box) == pytest.approx(1.0)


def test_left_handed_faces_are_reversed(tmp_path: Path) -> None:
    (box,) = scene_of(lambda stage: mesh(stage, "/box").CreateOrientationAttr("leftHanded"), tmp_path).objects
    assert volume(box) == pytest.approx(-1.0)


def test_holes_are_left_out(tmp_path: Path) -> None:
    (box,) = scene_of(lambda stage: mesh(stage, "/box").CreateHoleIndicesAttr([1, 5]), tmp_path).objects
    assert len(box.geometry.mesh.faces) == 8
    assert box.geometry.mesh.bounds_m[1, 2] == 1.0


STAR = [(np.cos(a) * r, np.sin(a) * r, 0.0) for a, r in zip(np.arange(10) * np.pi / 5, [1.0, 0.4] * 5, strict=True)]
LETTER = [(0, 0, 0), (3, 0, 0), (3, 1, 0), (1, 1, 0), (1, 2, 0), (3, 2, 0), (3, 3, 0), (0, 3, 0)]
ARROW = [(0, 0, 0), (1, -1, 0), (0, 2, 0), (-1, -1, 0)]


def area_of_outline(points: Any) -> float:
    x, y = np.array(points, float)[:, :2].T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)


@pytest.mark.parametrize("outline", [ARROW, LETTER, STAR], ids=["arrow", "letter", "star"])
@pytest.mark.parametrize("first", range(8))
@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 0, -1), (1, 2, 3)])
def test_concave_faces_are_covered_once(outline: list[Any], first: int, normal: tuple[float, ...]) -> None:
    """All triangles have the winding of their face, and their areas sum to its area."""
    from scene2hap.scene.formats.polygons import triangulated

    n, up = len(outline), np.array(normal, float) / np.linalg.norm(normal)
    side = np.cross(up, [1.0, 0.3, 0.2])
    side /= np.linalg.norm(side)
    frame = np.stack((side, np.cross(up, side), up))
    points = np.roll(np.array(outline, float), -first, axis=0) @ frame
    corners, faces = triangulated(points, np.array([2, n, 1]), np.array([0, 1, *range(n), 2]))
    assert faces.tolist() == [1] * (n - 2)
    a, b, c = np.moveaxis(points[np.array([0, 1, *range(n), 2])[corners]], 1, 0)
    areas = np.cross(b - a, c - a) @ up / 2
    assert (areas >= -1e-12).all()
    assert areas.sum() == pytest.approx(area_of_outline(outline))


def test_subsets_have_materials_of_their_own(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        box = mesh(stage, "/box")
        bind(box, preview(stage, "/Looks/wood", diffuseColor=(0.2, 0.1, 0.05)))
        subset = usd("UsdGeom").Subset.CreateGeomSubset(box, "top", "face", usd("Vt").IntArray([1, 99]), "materialBind")
        bind(subset, preview(stage, "/Looks/steel", diffuseColor=(0.5, 0.5, 0.5), opacity=0.25))

    (box,) = scene_of(fill, tmp_path).objects
    found = looks(box)
    assert [material.name for material in found.materials] == ["wood", "steel"]
    assert np.bincount(found.face_material).tolist() == [10, 2]
    wood, steel = (material.color_rgba for material in found.materials)
    np.testing.assert_allclose(wood, [*srgb((0.2, 0.1, 0.05)), 1.0], atol=1e-6)
    np.testing.assert_allclose(steel, [*srgb((0.5, 0.5, 0.5)), 0.25], atol=1e-6)
    tops = box.geometry.mesh.vertices_m[box.geometry.mesh.faces[found.face_material == 1]]
    assert (tops[..., 2] == 1.0).all()


@pytest.mark.parametrize(
    ("kind", "numbers", "size", "exact"),
    [
        ("Cube", {"size": 3.0}, (3, 3, 3), 27.0),
        ("Sphere", {"radius": 0.5}, (1, 1, 1), np.pi / 6),
        ("Cylinder", {"radius": 0.5, "height": 4.0, "axis": "X"}, (4, 1, 1), np.pi),
        ("Cylinder", {"radius": 0.5, "height": 4.0, "axis": "Y"}, (1, 4, 1), np.pi),
        ("Cone", {"radius": 0.5, "height": 3.0, "axis": "Z"}, (1, 1, 3), np.pi / 4),
        ("Capsule", {"radius": 0.5, "height": 1.0, "axis": "X"}, (2, 1, 1), np.pi / 4 + np.pi / 6),
        # A truncated cone: pi h (a^2 + a b + b^2) / 3.
        (
            "Cylinder_1",
            {"radiusBottom": 0.5, "radiusTop": 0.25, "height": 3.0, "axis": "Y"},
            (1, 3, 1),
            np.pi * (0.25 + 0.125 + 0.0625),
        ),
        ("Capsule_1", {"radiusBottom": 0.5, "radiusTop": 0.5, "height": 1.0}, (1, 1, 2), np.pi / 4 + np.pi / 6),
        (
            "Capsule_1",
            {"radiusBottom": 0.5, "radiusTop": 0.25, "height": 3.0},
            (1, 1, 3.75),
            np.pi * (0.25 + 0.125 + 0.0625) + 2 * np.pi / 3 * (0.125 + 0.015625),
        ),
        ("Plane", {"width": 2.0, "length": 3.0, "axis": "Z"}, (2, 3, 0), 0.0),
        ("Plane", {"width": 2.0, "length": 3.0, "axis": "Y"}, (2, 0, 3), 0.0),
        ("Plane", {"width": 2.0, "length": 3.0, "axis": "X"}, (0, 3, 2), 0.0),
    ],
)
def test_shapes_have_their_sizes(
    tmp_path: Path, kind: str, numbers: dict[str, Any], size: tuple[float, ...], exact: float
) -> None:
    def fill(stage: Any) -> None:
        prim = stage.DefinePrim("/shape", kind)
        for name, number in numbers.items():
            prim.GetAttribute(name).Set(number)

    (item,) = scene_of(fill, tmp_path).objects
    np.testing.assert_allclose(np.ptp(item.bounds_m, axis=0), size, atol=1e-9)
    assert volume(item) == pytest.approx(exact, rel=0.02)


def test_a_truncated_cone_has_its_smaller_end_along_its_axis(tmp_path: Path) -> None:
    text = 'def Cylinder_1 "a" { token axis = "Y"\n double radiusTop = 0.25\n }\n'
    (cone,) = load_scene(text_file(tmp_path, text), unit_m=1.0).objects
    points = cone.geometry.mesh.vertices_m
    assert np.hypot(*points[points[:, 1] == points[:, 1].max()][:, [0, 2]].T).max() == pytest.approx(0.25)
    assert np.hypot(*points[points[:, 1] == points[:, 1].min()][:, [0, 2]].T).max() == pytest.approx(1.0)


def test_a_cone_has_its_tip_along_its_axis(tmp_path: Path) -> None:
    (cone,) = load_scene(text_file(tmp_path, 'def Cone "a" { token axis = "Y"\n }\n'), unit_m=1.0).objects
    points = cone.geometry.mesh.vertices_m
    assert np.hypot(*points[points[:, 1] == points[:, 1].max()][:, [0, 2]].T).max() == 0.0


# -- appearances -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("interpolation", ["vertex", "varying", "faceVarying"])
@pytest.mark.parametrize("suffix", [".usda", ".usdc"])
def test_texture_coordinates_are_read(tmp_path: Path, interpolation: str, suffix: str) -> None:
    (tmp_path / "floor.png").write_bytes(image_file())
    scene = scene_of(lambda stage: painted_square(stage, interpolation=interpolation), tmp_path, suffix=suffix)
    assert shown(scene.objects[0]) == UPRIGHT


def test_indexed_coordinates_and_their_transform_are_read(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        painted_square(stage)
        shade, types = usd("UsdShade"), usd("Sdf").ValueTypeNames
        turn = shade.Shader.Define(stage, "/Looks/floor/turn")
        turn.CreateIdAttr("UsdTransform2d")
        turn.CreateInput("translation", types.Float2).Set((0.5, 0.0))
        reader = shade.Shader(stage.GetPrimAtPath("/Looks/floor/reader"))
        turn.CreateInput("in", types.Float2).ConnectToSource(reader.ConnectableAPI(), "result")
        texture = shade.Shader(stage.GetPrimAtPath("/Looks/floor/texture"))
        texture.GetInput("st").ConnectToSource(turn.ConnectableAPI(), "result")
        primvar = usd("UsdGeom").PrimvarsAPI(stage.GetPrimAtPath("/square")).GetPrimvar("map1")
        primvar.Set([(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)])
        primvar.SetIndices([0, 1, 3, 2])

    (tmp_path / "floor.png").write_bytes(image_file())
    colors = shown(scene_of(fill, tmp_path).objects[0])
    assert colors[(1.0, 0.0)] == BLUE
    assert colors[(0.0, 1.0)] == GREEN


def test_missing_texture_does_not_fail_the_load(tmp_path: Path) -> None:
    stage = new_stage(tmp_path / "a.usda")
    painted_square(stage)
    stage.Save()
    scene, told = refused(tmp_path / "a.usda")
    assert "there is no file" in told
    assert "floor.png" in told
    assert not looks(scene.objects[0]).materials[0].has_texture


@pytest.mark.parametrize("file", ["../floor.png", "https://example.org/floor.png", "/etc/hostname"])
def test_textures_outside_the_root_are_not_read(tmp_path: Path, file: str) -> None:
    (tmp_path / "floor.png").write_bytes(image_file())
    (tmp_path / "scenes").mkdir()
    path = tmp_path / "scenes" / "a.usda"
    stage = new_stage(path)
    painted_square(stage, file)
    stage.Save()
    _, told = refused(path)
    assert ("Addresses are never fetched" if "://" in file else "lies outside") in told
    if file.startswith(".."):
        assert shown(load_scene(path, assets_root=tmp_path, unit_m=1.0).objects[0]) == UPRIGHT


def test_display_colour_is_used_without_a_material(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        mesh(stage, "/plain").CreateDisplayColorAttr([(0.5, 0.25, 0.125)])
        faces = usd("UsdGeom").PrimvarsAPI(mesh(stage, "/faces"))
        types = usd("Sdf").ValueTypeNames
        faces.CreatePrimvar("displayColor", types.Color3fArray, "uniform").Set([(1, 0, 0)] * 5 + [(0, 0, 1)])
        faces.CreatePrimvar("displayOpacity", types.FloatArray, "constant").Set([0.5])
        mesh(stage, "/bare")

    plain, faces, bare = scene_of(fill, tmp_path).objects
    np.testing.assert_allclose(looks(plain).materials[0].color_rgba[:3], srgb((0.5, 0.25, 0.125)), atol=1 / 255)
    by_face = [looks(faces).materials[i].color_rgba for i in looks(faces).face_material]
    np.testing.assert_allclose(by_face, [(1, 0, 0, 0.5)] * 10 + [(0, 0, 1, 0.5)] * 2, atol=1 / 255)
    assert bare.appearance is None


def test_texture_is_dropped_when_coordinates_do_not_fit(tmp_path: Path) -> None:
    (tmp_path / "floor.png").write_bytes(image_file())
    stage = new_stage(tmp_path / "a.usda")
    painted_square(stage)
    usd("UsdGeom").PrimvarsAPI(stage.GetPrimAtPath("/square")).GetPrimvar("map1").Set([(0, 0)])
    stage.Save()
    scene, told = refused(tmp_path / "a.usda")
    assert "has 1 values, which do not fit" in told
    assert looks(scene.objects[0]).uv is None


def test_material_of_another_renderer_keeps_its_name(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        shade = usd("UsdShade")
        box = mesh(stage, "/box")
        box.CreateDisplayColorAttr([(1, 1, 1)])
        bind(box, shade.Material.Define(stage, "/Looks/Oak_Planks"))

    snapshot = scene_of(fill, tmp_path)
    other = tmp_path / "other"
    other.mkdir()
    bare = scene_of(lambda stage: mesh(stage, "/box").CreateDisplayColorAttr([(1, 1, 1)]), other)
    assert snapshot.objects[0].instance_key != bare.objects[0].instance_key


# -- masses ----------------------------------------------------------------------------------------------------------


def weigh(prim: Any, *, mass: float | None = None, density: float | None = None) -> None:
    api = usd("UsdPhysics").MassAPI.Apply(prim.GetPrim())
    if mass is not None:
        api.CreateMassAttr(mass)
    if density is not None:
        api.CreateDensityAttr(density)


def test_masses_are_read(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        geom = usd("UsdGeom")
        weigh(mesh(stage, "/given"), mass=3.5, density=100.0)
        weigh(mesh(stage, "/dense"), density=700.0)
        mesh(stage, "/unknown")
        weigh(mesh(stage, "/nothing"), mass=0.0)
        body = geom.Xform.Define(stage, "/body")
        body.AddScaleOp().Set((2, 1, 1))
        weigh(body, density=10.0)
        mesh(stage, "/body/shape")
        whole = geom.Xform.Define(stage, "/whole")
        weigh(whole, mass=8.0)
        weigh(mesh(stage, "/whole/shape"), mass=1.0)
        open_box = mesh(stage, "/open")
        open_box.CreateHoleIndicesAttr([0])
        weigh(open_box, density=700.0)
        by_material = mesh(stage, "/by_material")
        rubber = usd("UsdShade").Material.Define(stage, "/rubber")
        usd("UsdPhysics").MaterialAPI.Apply(rubber.GetPrim()).CreateDensityAttr(1100.0)
        bind(by_material, rubber, "physics")

    found = {item.id: item.mass_kg for item in scene_of(fill, tmp_path).objects}
    expected = {"given": 3.5, "dense": 700.0, "body": 20.0, "whole": 8.0, "by_material": 1100.0}
    assert {name: kg for name, kg in found.items() if kg is not None} == pytest.approx(expected, rel=1e-6)
    assert found.keys() >= {"unknown", "nothing", "open"}


def test_masses_are_in_the_units_of_the_stage(tmp_path: Path) -> None:
    """A cube of 100 cm has 0.001 mass units (of 2 kg) per cubic centimetre; a given unit_m changes no mass."""
    path = tmp_path / "a.usda"
    stage = new_stage(path, unit_m=0.01)
    usd("UsdPhysics").SetStageKilogramsPerUnit(stage, 2.0)
    weigh(mesh(stage, "/given"), mass=3.0)
    weigh(mesh(stage, "/dense", np.array(CUBE_POINTS) * 100.0), density=0.001)
    stage.Save()
    for options in ({}, {"unit_m": 0.02}):
        given, dense = load_scene(path, **options).objects
        assert given.mass_kg == pytest.approx(6.0)
        assert dense.mass_kg == pytest.approx(2000.0)


def test_mass_is_the_sum_of_parts_only_if_all_are_known(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        for table, parts in (("known", ("known_leg", "known_top")), ("partly", ("partly_leg", "partly_top"))):
            usd("UsdGeom").Xform.Define(stage, f"/{table}")
            for part in parts:
                weigh(mesh(stage, f"/{table}/{part}"), mass=0.0 if part == "partly_top" else 2.0)

    assert [(item.id, item.mass_kg) for item in scene_of(fill, tmp_path).objects] == [("known", 4.0), ("partly", None)]


def test_mass_of_a_copy_scales_with_its_volume(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        instancer(stage).CreateScalesAttr([(1, 1, 1), (1, 1, 1), (2, 2, 2)])
        weigh(stage.GetPrimAtPath("/World/cups/prototypes/cup"), density=5.0)

    assert [item.mass_kg for item in scene_of(fill, tmp_path).objects] == pytest.approx([5.0, 5.0, 40.0])
