"""Habitat scenes: objects, their placement by origin or centre of mass, masses, and what is left out."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from gltf_builder import Gltf, Json
from habitat_builder import CHAIR, DATASET, HASH, Dataset, corner_box, instance, loaded, low_and_high, named
from others import SCENES, needed
from scene2hap import SceneWarning
from scene2hap.errors import SceneError
from scene2hap.scene.formats.habitat.reader import referenced_files
from scene2hap.scene.load import TextureWarning, UnitWarning, load_scene

QUARTER = [0.5**0.5, 0.0, 0.5**0.5, 0.0]
"""A quarter turn about Y, as a quaternion with w first."""


def test_instances_are_objects_and_the_stage_is_grouped_as_any_file(dataset: Dataset) -> None:
    path = dataset.scene(instance(at=[1, 0, 0]), instance(at=[2, 0, 0]), instance(HASH, [0, 0, 1]))
    scene = loaded(path)
    assert (scene.name, scene.up_axis) == ("flat", "y")
    assert [item.id for item in scene.objects] == ["floor", "wall", CHAIR, f"{CHAIR}#2", HASH]
    assert low_and_high(scene.object(f"{CHAIR}#2")) == [[2.0, 0.0, 0.0], [2.5, 1.0, 0.5]]


def test_a_model_of_many_nodes_is_one_object(dataset: Dataset) -> None:
    gltf = Gltf()
    cube = gltf.cube()
    knob = gltf.node("knob", mesh=cube, translation=[4.0, 0.0, 0.0], scale=[0.1] * 3)
    gltf.node("door", mesh=cube, children=[gltf.node("hinge", mesh=cube, children=[knob])], root=True)
    gltf.node("pot far away", mesh=cube, translation=[9.0, 0.0, 0.0], root=True)
    gltf.write(dataset.folder / "objects/f" / f"{CHAIR}.glb")
    scene = loaded(dataset.scene(instance(), stage_instance={"template_name": "NONE"}))
    assert [item.id for item in scene.objects] == [CHAIR]
    assert len(scene.objects[0].geometry.mesh.faces) == 4 * 12
    by_leaf = loaded(dataset.scene(instance(), stage_instance=None), group="leaf")
    assert [item.id for item in by_leaf.objects] == ["door", "hinge", "knob", "pot far away"]


def test_instances_share_a_mesh_and_scale_counts(dataset: Dataset) -> None:
    scene = loaded(
        dataset.scene(
            instance(at=[0, 0, 0]), instance(at=[3, 0, 0], rotation=QUARTER), instance(at=[6, 0, 0], uniform_scale=2.0)
        )
    )
    one, two, large = scene.objects[-3:]
    assert one.geometry is two.geometry
    assert one.instance_key == two.instance_key != large.instance_key
    assert two.pose.position_m == (3.0, 0.0, 0.0)
    assert low_and_high(large) == [[6.0, 0.0, 0.0], [7.0, 2.0, 1.0]]


def test_equal_piece_numbers_of_two_models_are_distinguished(dataset: Dataset) -> None:
    """Both meshes are mesh 0, primitive 0 of their files."""
    scene = loaded(dataset.scene(instance(), instance(HASH, [3, 0, 0])))
    chair, washer = scene.objects[-2:]
    assert chair.size_m != washer.size_m


def test_a_model_is_read_once(dataset: Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    from scene2hap.scene.formats.gltf import reader

    opened: list[str] = []
    read = reader.read_gltf

    def counting(path: Path, root: Path) -> Any:
        opened.append(path.name)
        return read(path, root)

    monkeypatch.setattr(reader, "read_gltf", counting)
    loaded(dataset.scene(*(instance(at=[i, 0, 0], uniform_scale=1 + i) for i in range(20))))
    assert sorted(opened) == [f"{CHAIR}.glb", "home.glb"]


def test_every_load_is_the_same(dataset: Dataset) -> None:
    path = dataset.scene(instance(), instance(HASH, [2, 0, 0], rotation=QUARTER, non_uniform_scale=[1, 2, 3]))
    assert len({loaded(path).to_json() for _ in range(3)}) == 1


def test_hidden_instances_are_left_out(dataset: Dataset) -> None:
    path = dataset.scene(instance(is_instance_visible=False), instance(at=[1, 0, 0], is_instance_visible=True))
    assert [item.id for item in loaded(path).objects] == ["floor", "wall", CHAIR]


def test_scene_equals_the_same_scene_in_one_glb(dataset: Dataset) -> None:
    """Sizes, poses and names equal those of a file that trimesh writes with the same transforms."""
    rng = np.random.default_rng(5)
    together = trimesh.Scene()
    rows = []
    for i in range(12):
        name = f"thing_{i}"
        mesh = trimesh.creation.cylinder(radius=0.2 + 0.02 * i, height=0.3 + 0.1 * i)
        mesh.apply_translation(rng.uniform(-0.3, 0.3, 3))
        mesh.export(dataset.folder / "objects/f" / f"{name}.glb")
        wxyz = trimesh.transformations.random_quaternion(rng.uniform(size=3))
        at, scale = rng.uniform(-3, 3, 3), rng.uniform(0.5, 2)
        rows.append(instance(name, at.tolist(), rotation=wxyz.tolist(), uniform_scale=scale))
        dataset.write(f"objects/f/{name}.object_config.json", {"render_asset": f"{name}.glb"})
        matrix = trimesh.transformations.quaternion_matrix(wxyz)
        matrix[:3, :3] *= scale
        matrix[:3, 3] = at
        together.add_geometry(mesh, node_name=name, geom_name=name, transform=matrix)
    together.export(dataset.folder / "together.glb")
    ours = loaded(dataset.scene(*rows, stage_instance=None))
    theirs = loaded(dataset.folder / "together.glb")
    assert [item.name for item in ours.objects] == [f"thing_{i}" for i in range(12)]
    for item in ours.objects:
        other = theirs.object(item.id)
        np.testing.assert_allclose(item.bounds_m, other.bounds_m, atol=1e-6)
        np.testing.assert_allclose(item.pose.position_m, other.pose.position_m, atol=1e-6)
        np.testing.assert_allclose(item.pose.rotation, other.pose.rotation, atol=1e-6)
        np.testing.assert_allclose(item.size_m, other.size_m, atol=1e-6)


def test_rotation_begins_with_w(dataset: Dataset) -> None:
    chair = loaded(dataset.scene(instance(rotation=QUARTER))).object(CHAIR)
    # A quarter turn about Y takes X to -Z.
    assert low_and_high(chair) == [[0.0, 0.0, -0.5], [0.5, 1.0, 0.0]]


@pytest.mark.parametrize(("of_scene", "of_row"), [("COM", None), (None, None), ("asset_local", "COM"), ("x", "com")])
def test_the_centre_of_mass_is_the_middle_of_the_box(
    dataset: Dataset, of_scene: str | None, of_row: str | None
) -> None:
    fields = {} if of_row is None else {"translation_origin": of_row}
    row = instance(at=[3, 4, 5], rotation=QUARTER, uniform_scale=2.0, **fields)
    chair = loaded(dataset.scene(row, translation_origin="default" if of_scene == "x" else of_scene)).object(CHAIR)
    np.testing.assert_allclose(chair.bounds_m.mean(axis=0), [3, 4, 5], atol=1e-9)
    np.testing.assert_allclose(np.ptp(chair.bounds_m, axis=0), [1, 2, 1], atol=1e-9)


def test_asset_local_places_the_origin_of_the_model(dataset: Dataset) -> None:
    row = instance(at=[3, 4, 5], translation_origin="Asset_Local")
    assert loaded(dataset.scene(row, translation_origin="com")).object(CHAIR).pose.position_m == (3.0, 4.0, 5.0)


def test_a_given_centre_of_mass_is_scaled(dataset: Dataset) -> None:
    dataset.write(
        f"objects/f/{CHAIR}.object_config.json",
        {"render_asset": f"{CHAIR}.glb", "COM": [0.1, 0.0, 0.0], "scale": [2.0, 1.0, 1.0]},
    )
    chair = loaded(dataset.scene(instance(at=[3, 0, 0]), translation_origin="com")).object(CHAIR)
    np.testing.assert_allclose(chair.bounds_m[0], [2.8, 0.0, 0.0], atol=1e-9)


def test_the_box_of_a_turned_node_is_that_of_its_turned_box(dataset: Dataset) -> None:
    """As Habitat joins boxes: for a node rotated by 45 degrees, the box's middle is not that of the vertices."""
    gltf = Gltf()
    cube = gltf.cube()
    eighth = [0.0, np.sin(np.pi / 8), 0.0, np.cos(np.pi / 8)]
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    faces = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
    corner = gltf.mesh(
        {
            "attributes": {"POSITION": gltf.accessor(points, "f4", "VEC3")},
            "indices": gltf.accessor(faces, "u2", "SCALAR"),
        }
    )
    gltf.node("corner", mesh=corner, rotation=eighth, root=True)
    gltf.node("cube", mesh=cube, scale=[0.1, 0.1, 0.1], root=True)
    gltf.write(dataset.folder / "objects/f" / f"{CHAIR}.glb")
    chair = loaded(dataset.scene(instance(), translation_origin="com")).object(CHAIR)
    diagonal = 2**0.5
    # The unit box turned by 45 degrees about Y: x from 0 to sqrt(2), z from -sqrt(1/2) to sqrt(1/2).
    np.testing.assert_allclose(chair.pose.position_m, [-diagonal / 2, -0.5, 0.0], atol=1e-6)


def test_up_and_front_turn_the_model(dataset: Dataset) -> None:
    dataset.write(
        f"objects/f/{CHAIR}.object_config.json", {"render_asset": f"{CHAIR}.glb", "up": [0, 0, 1], "front": [0, 1, 0]}
    )
    chair = loaded(dataset.scene(instance())).object(CHAIR)
    # Z becomes Y, and Y becomes -Z: the model of 0.5 x 1 x 0.5 lies on its back.
    assert low_and_high(chair) == [[0.0, 0.0, -1.0], [0.5, 0.5, 0.0]]


def test_non_orthogonal_up_and_front_are_ignored(dataset: Dataset) -> None:
    dataset.write(
        f"objects/f/{CHAIR}.object_config.json", {"render_asset": f"{CHAIR}.glb", "up": [0, 1, 0], "front": [0, 1, 0]}
    )
    assert low_and_high(loaded(dataset.scene(instance())).object(CHAIR)) == [[0.0, 0.0, 0.0], [0.5, 1.0, 0.5]]


def test_scales_of_configuration_and_instance_multiply(dataset: Dataset) -> None:
    dataset.write(f"objects/f/{CHAIR}.object_config.json", {"render_asset": f"{CHAIR}.glb", "scale": [2, 1, 1]})
    row = instance(rotation=QUARTER, uniform_scale=2.0, non_uniform_scale=[1, 1, 3])
    # Scaled along the model's axes, then rotated.
    assert low_and_high(loaded(dataset.scene(row)).object(CHAIR)) == [[0.0, 0.0, -2.0], [3.0, 2.0, 0.0]]


def test_a_negative_scale_mirrors_and_keeps_the_mass(dataset: Dataset) -> None:
    wedge = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    wedge.export(dataset.folder / "objects/f" / f"{CHAIR}.glb")
    chair = loaded(dataset.scene(instance(non_uniform_scale=[-1, 1, 1]))).object(CHAIR)
    assert low_and_high(chair) == [[-1.0, 0.0, 0.0], [0.0, 2.0, 3.0]]
    a, b, c = np.moveaxis(chair.geometry.mesh.vertices_m[chair.geometry.mesh.faces], 1, 0)
    assert (a * np.cross(b, c)).sum() / 6 == pytest.approx(1.0)  # turned outwards
    assert chair.mass_kg == 6.0
    config = {"render_asset": f"{CHAIR}.glb", "scale": [1, 1, -1]}
    dataset.write(f"objects/f/{CHAIR}.object_config.json", config)
    assert low_and_high(loaded(dataset.scene(instance())).object(CHAIR)) == [[0.0, 0.0, -3.0], [1.0, 2.0, 0.0]]


def test_the_stage_is_scaled_and_not_moved(dataset: Dataset) -> None:
    dataset.write("stages/home.stage_config.json", {"render_asset": "home.glb", "scale": [2, 2, 2]})
    path = dataset.scene(stage_instance={"template_name": "stages/home", "translation": [9, 9, 9], "uniform_scale": 2})
    with pytest.warns(SceneWarning, match="stage_instance is moved or turned, which Habitat does not apply"):
        floor = loaded(path).object("floor")
    np.testing.assert_allclose(floor.bounds_m, [[-12, -0.4, -8], [12, 0, 8]], atol=1e-9)


@pytest.mark.parametrize(
    ("fields", "mass_kg"),
    [
        ({}, 6.0),
        ({"uniform_scale": 2.0}, 48.0),
        ({"non_uniform_scale": [1, 2, 1], "mass_scale": 0.5}, 6.0),
        ({"uniform_scale": 2.0, "apply_scale_to_mass": False}, 6.0),
        ({"mass_scale": 0}, None),
    ],
)
def test_a_mass_scales_with_the_instance(dataset: Dataset, fields: Json, mass_kg: float | None) -> None:
    assert loaded(dataset.scene(instance(**fields))).object(CHAIR).mass_kg == mass_kg


def test_default_mass_of_the_dataset_is_ignored(dataset: Dataset) -> None:
    objects = {"default_attributes": {"mass": 10.0}, **DATASET["objects"]}
    dataset.write("home.scene_dataset_config.json", {**DATASET, "objects": objects})
    assert loaded(dataset.scene(instance(HASH))).object(HASH).mass_kg is None


FRIDGE = """<robot name="fridge">
<link name="body"><visual><origin xyz="0 0.9 0"/><geometry><mesh filename="body.glb"/></geometry></visual>
<inertial><mass value="40"/></inertial></link>
<link name="door"><visual><geometry><box size="0.6 1.0 0.04"/></geometry></visual>
<inertial><mass value="5"/></inertial></link>
<joint name="hinge" type="revolute"><parent link="body"/><child link="door"/><origin xyz="0 0.9 0.3"/></joint>
</robot>"""


@pytest.mark.parametrize("listed", [{".urdf": ["urdf/*"]}, {".json": ["urdf/*/"]}, {}])
def test_an_articulated_object_is_one_object(dataset: Dataset, listed: Json) -> None:
    dataset.write("home.scene_dataset_config.json", {**DATASET, "articulated_objects": {"paths": listed}})
    trimesh.creation.box((0.6, 1.8, 0.6)).export(dataset.write("urdf/fridge/body.glb", ""))
    dataset.write("urdf/fridge/fridge.urdf", FRIDGE)
    if ".json" in listed:
        dataset.write("urdf/fridge/fridge.ao_config.json", {"urdf_filepath": "fridge.urdf", "uniform_scale": 1.0})
    # A model with the same name is another template.
    corner_box().write(dataset.folder / "urdf/fridge/fridge.glb")
    row = {"template_name": "fridge", "translation": [3, 0, 0], "rotation": QUARTER, "fixed_base": True}
    path = dataset.scene(instance(), articulated_object_instances=[row], translation_origin="com")
    fridge = loaded(path).object("fridge")
    assert fridge.mass_kg == 45.0
    # The door sticks out towards Z, which the instance rotates to X.
    assert low_and_high(fridge) == [[2.7, 0.0, -0.3], [3.32, 1.8, 0.3]]
    assert {"fridge.urdf", "body.glb"} <= {file.name for file in referenced_files(path, None)}


def test_turned_initial_joints_warn(dataset: Dataset) -> None:
    trimesh.creation.box((0.6, 1.8, 0.6)).export(dataset.write("urdf/fridge/body.glb", ""))
    dataset.write("urdf/fridge/fridge.urdf", FRIDGE)
    row = {"template_name": "fridge", "initial_joint_pose": {"joint_00": 0.0, "joint_01": 1.2}}
    with pytest.warns(SceneWarning, match=r"1 articulated objects that begin with joints turned \(fridge\)"):
        loaded(dataset.scene(instance(), articulated_object_instances=[row, {**row, "initial_joint_pose": [0, 0]}]))


def test_missing_articulated_object_is_refused(dataset: Dataset) -> None:
    rows = [{"template_name": "fridge"}]
    with pytest.raises(
        SceneError, match=r"articulated_object_instances\[0\] names the template 'fridge', which .*\.urdf"
    ):
        loaded(dataset.scene(instance(), articulated_object_instances=rows))


@pytest.mark.parametrize("name", ["cubeSolid", "uvSphereSolid_rings_16_segments_32_useTexCoords_false"])
def test_shapes_without_a_file_are_left_out_with_a_warning(dataset: Dataset, name: str) -> None:
    dataset.write("objects/f/ball.object_config.json", {"render_asset": name})
    rows = instance(), instance(name), instance("ball")
    with pytest.warns(SceneWarning, match="without 3 shapes that have no model file"):
        assert named(dataset.scene(*rows, stage_instance={"template_name": name})) == [CHAIR]


def test_a_list_that_is_null_is_empty(dataset: Dataset) -> None:
    dataset.write("home.scene_dataset_config.json", {"objects": {"paths": {".json": None}, "configs": None}})
    assert named(dataset.scene(instance(), articulated_object_instances=None, stage_instance=None)) == [CHAIR]


def test_warning_of_missing_textures_names_the_model(dataset: Dataset) -> None:
    gltf = corner_box()
    gltf.header |= {
        "images": [{"uri": "gone.png"}],
        "textures": [{"source": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    }
    primitive = gltf.header["meshes"][0]["primitives"][0]
    primitive["material"] = 0
    primitive["attributes"]["TEXCOORD_0"] = gltf.accessor(np.zeros((8, 2)), "f4", "VEC2")
    for name in (f"f/{CHAIR}", f"0/{HASH}"):
        gltf.write(dataset.folder / f"objects/{name}.glb")
    path = dataset.scene(instance(), instance(at=[1, 0, 0]), instance(HASH))
    with pytest.warns(TextureWarning, match=rf"without 2 textures.*{CHAIR}\.glb: .*gone\.png.*{HASH}\.glb: "):
        loaded(path)


def test_referenced_files_of_a_scene_are_listed(dataset: Dataset) -> None:
    dataset.write("semantics/objects.csv", "id,name,main_category\n")
    files = referenced_files(dataset.scene(instance(), instance(at=[1, 0, 0])), None)
    assert {file.name for file in files} == {
        *("flat.scene_instance.json", "home.scene_dataset_config.json", "objects.csv"),
        *("home.stage_config.json", "home.glb", f"{CHAIR}.object_config.json", f"{CHAIR}.glb"),
    }


def test_real_models_have_the_stated_place(tmp_path: Path) -> None:
    """The Kenney furniture kit as a dataset without a dataset file, in the folders of HSSD's models."""
    kit = needed(SCENES / "lib_kenney_furniture")
    names = ["washer", "kitchenFridge", "radio"]
    dataset = Dataset(tmp_path / "kit", document=None)
    for name in names:
        (dataset.folder / f"objects/f/{name}.glb").write_bytes((kit / f"{name}.glb").read_bytes())
    rows = [instance(name, [3.0 * i, 0.5, 1.0], uniform_scale=1.8) for i, name in enumerate(names)]
    path = dataset.scene(*rows, stage_instance=None, translation_origin="COM")
    scene = load_scene(path, assets_root=dataset.folder)
    assert [item.name for item in scene.objects] == names
    for i, item in enumerate(scene.objects):
        np.testing.assert_allclose(item.bounds_m.mean(axis=0), [3.0 * i, 0.5, 1.0], atol=1e-3)


def test_implausible_sizes_warn(dataset: Dataset) -> None:
    row = instance(uniform_scale=500.0)
    with pytest.warns(UnitWarning):
        load_scene(dataset.scene(row, stage_instance=None))


def test_json_of_a_scene_contains_masses(dataset: Dataset) -> None:
    scene = loaded(dataset.scene(instance()))
    assert json.loads(scene.to_json())["objects"][-1]["mass_kg"] == 6.0
