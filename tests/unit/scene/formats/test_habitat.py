"""Habitat scenes: templates, placement by origin or centre of mass, names, masses, and errors."""

from __future__ import annotations

import json
import os
import random
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from gltf_builder import Gltf, Json, one_cube
from habitat_builder import CHAIR, DATASET, HASH, Dataset, corner_box, instance, mutated_dataset
from others import SCENES, needed
from scene2hap import SceneWarning
from scene2hap.errors import Scene2HapError, SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.habitat import referenced_files
from scene2hap.scene.load import TextureWarning, UnitWarning, load_scene
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.snapshot import SceneSnapshot
from systems import needs_links

QUARTER = [0.5**0.5, 0.0, 0.5**0.5, 0.0]
"""A quarter turn about Y, as a quaternion with w first."""


@pytest.fixture
def dataset(tmp_path: Path) -> Dataset:
    return Dataset(tmp_path / "home")


def loaded(path: Path, **options: Any) -> SceneSnapshot:
    return load_scene(path, unit_m=1.0, **options)


def low_and_high(item: SceneObject) -> list[list[float]]:
    return [[round(value, 6) + 0.0 for value in corner] for corner in item.bounds_m.tolist()]


# -- one object for each instance ------------------------------------------------------------------------------------


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
    from scene2hap.scene.formats import gltf

    opened: list[str] = []
    read = gltf.read_gltf

    def counting(path: Path, root: Path) -> Any:
        opened.append(path.name)
        return read(path, root)

    monkeypatch.setattr(gltf, "read_gltf", counting)
    loaded(dataset.scene(*(instance(at=[i, 0, 0], uniform_scale=1 + i) for i in range(20))))
    assert sorted(opened) == [f"{CHAIR}.glb", "home.glb"]


def test_every_load_is_the_same(dataset: Dataset) -> None:
    path = dataset.scene(instance(), instance(HASH, [2, 0, 0], rotation=QUARTER, non_uniform_scale=[1, 2, 3]))
    assert len({loaded(path).to_json() for _ in range(3)}) == 1


def test_hidden_instances_are_left_out(dataset: Dataset) -> None:
    path = dataset.scene(instance(is_instance_visible=False), instance(at=[1, 0, 0], is_instance_visible=True))
    assert [item.id for item in loaded(path).objects] == ["floor", "wall", CHAIR]


# -- placing ---------------------------------------------------------------------------------------------------------


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


# -- templates -------------------------------------------------------------------------------------------------------


def test_dataset_1_of_habitat_sim_is_read(tmp_path: Path) -> None:
    """dataset_tests/dataset_1 of habitat-sim: names that are parts of handles, and templates based on others."""
    folder = tmp_path / "dataset_1"
    for name in ("objects/object_0", "objects/object_1", "stages/stage_0", "scenes/scene_0"):
        (folder / name).mkdir(parents=True)
    own = Dataset.__new__(Dataset)
    own.folder = folder
    document: Json = {
        "stages": {
            "default_attributes": {"origin": [1.0, 2.0, 3.0]},
            "paths": {".json": ["stages/*"]},
            "configs": [
                {
                    "original_file": "stages/stage_0/dataset_test_stage_0.stage_config.json",
                    "template_handle": "modified_test_stage_0",
                    "attributes": {"scale": [1, 1, 1], "gravity": [0, -9.8, 0], "units_to_meters": 1.0},
                }
            ],
        },
        "objects": {
            "default_attributes": {"mass": 10.0, "inertia": [3, 2, 1]},
            "paths": {".json": ["objects/*"]},
            "configs": [
                {
                    "original_file": "objects/object_0/dataset_test_object1_0.object_config.json",
                    "template_handle": "modified_test_object1_1_slick_heavy",
                    "attributes": {"friction_coefficient": 0.2, "mass": 3.5},
                },
                {
                    "template_handle": "new_test_object3",
                    "attributes": {"render_asset": "objects/object_1/dataset_test_object2_1.glb", "mass": 1.1},
                },
            ],
        },
        "scene_instances": {"paths": {".json": ["scenes/*"]}},
        "navmesh_instances": {"navmesh_path1": "test_navmesh_path1"},
    }
    own.write("test_dataset_1.scene_dataset_config.json", document)
    one_cube("floor").write(folder / "stages/stage_0/dataset_test_stage_0.glb")
    own.write("stages/stage_0/dataset_test_stage_0.stage_config.json", {"render_asset": "dataset_test_stage_0.glb"})
    for place, name in (("object_0", "dataset_test_object1_0"), ("object_1", "dataset_test_object2_1")):
        one_cube().write(folder / "objects" / place / f"{name}.glb")
        own.write(f"objects/{place}/{name}.object_config.json", {"render_asset": f"{name}.glb"})
    path = own.scene(
        {"translation_origin": "asset_local", "template_name": "dataset_test_object1", "translation": [0.1, 0.2, 0.3]},
        {"translation_origin": "asset_local", "template_name": "dataset_test_object2", "translation": [3.3, 0.4, 0.5]},
        instance("modified_test_object1", [6, 0, 0]),
        instance("new_test_object3", [9, 0, 0]),
        name="scenes/scene_0/dataset_test_scene_0.scene_instance.json",
        translation_origin="com",
        stage_instance={"translation_origin": "asset_local", "template_name": "modified_test_stage"},
    )
    scene = loaded(path)
    assert [(item.id, item.mass_kg) for item in scene.objects] == [
        ("floor", None),
        ("dataset_test_object1", None),
        ("dataset_test_object2", None),
        ("modified_test_object1", 3.5),
        ("new_test_object3", 1.1),
    ]
    np.testing.assert_allclose(scene.object("dataset_test_object1").pose.position_m, [0.1, 0.2, 0.3], atol=1e-9)


def test_folder_is_searched_when_the_dataset_file_is_missing(tmp_path: Path) -> None:
    dataset = Dataset(tmp_path / "home", document=None)
    (dataset.folder / f"objects/0/{HASH}.object_config.json").unlink()
    path = dataset.scene(instance(), instance(HASH, [2, 0, 0]))
    assert [item.id for item in loaded(path, assets_root=dataset.folder).objects][2:] == [CHAIR, HASH]
    with pytest.raises(SceneError, match=r"names the template 'stages/home', which .*give assets_root="):
        loaded(path)


def test_models_may_be_listed_without_configurations(dataset: Dataset) -> None:
    (dataset.folder / f"objects/f/{CHAIR}.object_config.json").unlink()
    document = {**DATASET, "objects": {"paths": {".glb": ["objects/f/*.glb"], ".json": ["objects/0"]}}}
    dataset.write("home.scene_dataset_config.json", document)
    assert [item.id for item in loaded(dataset.scene(instance(), instance(HASH, [2, 0, 0]))).objects][2:] == [
        CHAIR,
        HASH,
    ]


@pytest.mark.parametrize("name", [CHAIR, f"objects/f/{CHAIR}", f"f/{CHAIR}.object_config.json", f"objects\\f\\{CHAIR}"])
def test_a_template_may_be_named_by_the_end_of_its_path(dataset: Dataset, name: str) -> None:
    assert loaded(dataset.scene(instance(name))).objects[-1].id == CHAIR


def test_dataset_file_that_lists_the_scene_is_used(dataset: Dataset) -> None:
    other = {**DATASET, "objects": {"paths": {}}, "scene_instances": {"paths": {".json": ["scenes-articulated"]}}}
    dataset.write("a.scene_dataset_config.json", {**other, "objects": {"default_attributes": {"scale": [9, 9, 9]}}})
    assert low_and_high(loaded(dataset.scene(instance())).object(CHAIR))[1] == [0.5, 1.0, 0.5]


def test_a_model_may_be_named_after_its_configuration(dataset: Dataset) -> None:
    objects = {"default_attributes": {"render_asset": "%%CONFIG_NAME_AS_ASSET_FILENAME%%.glb"}, **DATASET["objects"]}
    dataset.write("home.scene_dataset_config.json", {**DATASET, "objects": objects})
    dataset.write(f"objects/f/{CHAIR}.object_config.json", {})
    assert loaded(dataset.scene(instance(), instance("apartment_chair", [1, 0, 0]))).objects[-1].id == "apartment_chair"


@pytest.mark.parametrize("suffix", [".ply", ".stl", ".obj"])
def test_models_of_other_formats_are_read(dataset: Dataset, suffix: str) -> None:
    trimesh.creation.box((1, 1, 1)).export(dataset.folder / f"objects/f/box{suffix}")
    dataset.write(f"objects/f/{CHAIR}.object_config.json", {"render_asset": f"box{suffix}"})
    assert low_and_high(loaded(dataset.scene(instance())).object(CHAIR)) == [[-0.5] * 3, [0.5] * 3]


def test_ignored_unit_setting_warns(dataset: Dataset) -> None:
    config = {"render_asset": f"{CHAIR}.glb", "units_to_meters": 0.01}
    dataset.write(f"objects/f/{CHAIR}.object_config.json", config)
    with pytest.warns(SceneWarning, match=r"has units_to_meters 0\.01, which Habitat keeps and does not apply"):
        loaded(dataset.scene(instance()))


# -- names -----------------------------------------------------------------------------------------------------------


def named(path: Path, **options: Any) -> list[str]:
    return [item.name for item in loaded(path, **options).objects if item.name not in ("floor", "wall")]


@pytest.mark.parametrize(
    ("file", "text", "name"),
    [
        (
            "metadata/hssd_obj_semantics_condensed.csv",
            'Object Hash,"Semantic Category:\nCONDENSED\n\nThis is an effort to condense",Pickable\n%s,washer,No\n',
            "washer",
        ),
        ("metadata/object_categories_filtered.csv", "id,clean_category\n%s,washing machine\n", "washing machine"),
        ("metadata/fpmodels-with-decomposed.csv", "id,name,main_category\n%s,W 9000,washer\n", "washer"),
        ("semantics/objects.csv", "id,name,wnsynsetkey,main_category\n%s,W,washer.n.03,large\n", "washer"),
        ("semantics/objects.csv", "id,name,wnsynsetkey,main_category\n%s,W,,large_appliance\n", "large_appliance"),
        ("semantics/objects.csv", "id,name,wnsynsetkey,main_category\n%s,W,,unknown\n", HASH),
    ],
)
def test_names_are_found_in_the_tables_of_hssd(dataset: Dataset, file: str, text: str, name: str) -> None:
    dataset.write(file, text % HASH)
    assert named(dataset.scene(instance(), instance(HASH, [2, 0, 0]))) == [CHAIR, name]


def test_a_broken_table_of_the_dataset_costs_names_alone(dataset: Dataset) -> None:
    dataset.write("semantics/objects.csv", "one,two\n1,2\n")
    with pytest.warns(
        SceneWarning, match=r"semantics/objects\.csv names no objects: .* has the columns \['one', 'two'\]"
    ):
        assert named(dataset.scene(instance(HASH))) == [HASH]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_names_of_a_table_are_read_as_spreadsheets_write_them(dataset: Dataset, encoding: str, separator: str) -> None:
    path = dataset.folder / "names.csv"
    path.write_bytes(f"id{separator}name\n{HASH}{separator}Spülmaschine\n".encode(encoding))
    assert named(dataset.scene(instance(HASH)), names=path) == ["Spülmaschine"]


@pytest.mark.parametrize("form", ["mapping", "names.json", "names.csv"])
def test_names_are_read_from_mapping_json_or_csv(dataset: Dataset, form: str) -> None:
    dataset.write("metadata/object_categories_filtered.csv", f"id,clean_category\n{HASH},box\n{CHAIR},seat\n")
    dataset.write("names.json", {HASH: "washing machine"})
    dataset.write("names.csv", f"id,name,price\n{HASH},washing machine,700\n")
    given: Any = {HASH: "washing machine"} if form == "mapping" else dataset.folder / form
    path = dataset.scene(instance(), instance(HASH, [2, 0, 0]))
    assert named(path, names=given) == ["seat", "washing machine"]


@pytest.mark.parametrize(
    ("names", "sentence"),
    [
        ({"a": 1}, "names maps 'a' to 1; it must map the names of templates"),
        (7, "names is 7; it must be a path"),
        ("gone.csv", "there is no file 'gone.csv'"),
    ],
)
def test_invalid_names_are_refused(dataset: Dataset, names: Any, sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        loaded(dataset.scene(instance()), names=names)


def test_names_are_refused_for_other_formats(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"names is for Habitat scenes .*, and 'cube\.glb' is none"):
        load_scene(one_cube().write(tmp_path / "cube.glb"), names={"cube": "kettle"})


# -- masses ----------------------------------------------------------------------------------------------------------


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


# -- articulated objects, and instances that are left out ------------------------------------------------------------


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


# -- faults ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"template_name": "frl_apartment_chiar_01"}, rf"object_instances\[0\] names the template .* mean '{CHAIR}'"),
        ({"template_name": None}, r"object_instances\[0\]\.template_name is None; it must be a template's name"),
        ({"template_name": ""}, r"template_name is ''"),
        ({"template_name": ["a"]}, r"template_name is \['a'\]"),
        ({"rotation": [0, 0, 0, 0]}, r"object_instances\[0\]\.rotation \(w, x, y, z\): .* length 0"),
        ({"rotation": [1, 0, 0]}, r"rotation is \[1, 0, 0\]; it must be 4 numbers"),
        ({"rotation": "up"}, r"rotation is 'up'; it must be 4 numbers"),
        ({"translation": [0, float("nan"), 0]}, r"translation\[1\] is nan m; it must be finite"),
        ({"translation": [0, "1", 0]}, r"translation\[1\] is '1'; it must be a number"),
        ({"translation": [1e9, 0, 0]}, f"object '{CHAIR}' is placed or scaled beyond 1e\\+06 m"),
        ({"uniform_scale": -1}, r"uniform_scale is -1; it must be above 0"),
        ({"uniform_scale": 1e300, "non_uniform_scale": [1e300] * 3}, "is placed or scaled beyond|mass"),
        ({"non_uniform_scale": [1, 0, 1]}, r"non_uniform_scale\[1\] is 0; a model without thickness"),
        ({"non_uniform_scale": 2}, r"non_uniform_scale is 2; it must be 3 numbers"),
        ({"translation_origin": "corner"}, r"translation_origin is 'corner'; it must be 'COM' or 'asset_local'"),
        ({"translation_origin": 3}, r"translation_origin is 3"),
        ({"mass_scale": -1}, r"mass_scale is -1; it must be at least 0"),
        ({"is_instance_visible": "yes"}, r"is_instance_visible is 'yes'; it must be True or False"),
    ],
)
def test_invalid_instance_row_is_refused(dataset: Dataset, fields: Json, sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        loaded(dataset.scene({**instance(), **fields}))


@pytest.mark.parametrize(
    ("config", "sentence"),
    [
        ({}, rf"{CHAIR}\.object_config\.json: render_asset is None; it must be the name of a model file"),
        ({"render_asset": "gone.glb"}, r"render_asset is 'gone\.glb', but there is no file .*gone\.glb"),
        ({"render_asset": f"{CHAIR}.gbl"}, "models of these kinds are read"),
        ({"render_asset": f"{CHAIR[:-2]}10.glb"}, rf"there is no file .* Did you mean '{CHAIR}\.glb"),
        ({"render_asset": "../../../../etc/passwd.glb"}, r"which lies outside .*; only files inside it are read"),
        ({"render_asset": "/etc/x.glb"}, "which lies outside"),
        ({"render_asset": "a\0b.glb"}, "no usable file name"),
        ({"render_asset": f"{CHAIR}.glb", "scale": [1, 1, 0]}, r"scale\[2\] is 0; a model without thickness"),
        ({"render_asset": f"{CHAIR}.glb", "scale": 2}, "scale is 2; it must be 3 numbers"),
        ({"render_asset": f"{CHAIR}.glb", "COM": "middle"}, "COM is 'middle'"),
        ({"render_asset": f"{CHAIR}.glb", "mass": -2}, "mass is -2 kg; it must be at least 0"),
        ({"render_asset": f"{CHAIR}.glb", "mass": "heavy"}, "mass is 'heavy'"),
        ({"render_asset": f"{CHAIR}.glb", "up": [0, 1]}, r"up is \[0, 1\]; it must be 3 numbers"),
        ({"render_asset": f"{CHAIR}.glb", "units_to_meters": 0}, "units_to_meters is 0; it must be above 0"),
        ("[]", r"object_config\.json' holds a list; it must be a JSON object"),
        ("{", r"object_config\.json' is not JSON"),
    ],
)
def test_invalid_configuration_is_refused(dataset: Dataset, config: Any, sentence: str) -> None:
    dataset.write(f"objects/f/{CHAIR}.object_config.json", config)
    with pytest.raises(SceneError, match=sentence):
        loaded(dataset.scene(instance()))


@pytest.mark.parametrize(
    ("document", "sentence"),
    [
        ("{", r"home\.scene_dataset_config\.json' is not JSON"),
        ({"objects": []}, r"objects is \[\]; it must be an object"),
        ({"objects": {"paths": ["objects"]}}, r"objects\.paths must be an object of lists"),
        ({"objects": {"paths": {".json": "objects"}}}, r"objects\.paths\.\.json is 'objects'; it must be a list"),
        ({"objects": {"paths": {".json": [3]}}}, r"objects\.paths\['\.json'\] has 3; it must have paths"),
        ({"objects": {"configs": {}}}, r"objects\.configs is \{\}; it must be a list"),
        ({"objects": {"configs": [3]}}, r"objects\.configs\[0\] must be an object"),
        ({"objects": {"configs": [{}]}}, r"objects\.configs\[0\] has no template_handle"),
        ({"objects": {"configs": [{"template_handle": CHAIR, "original_file": 3}]}}, "original_file is 3"),
        ({"objects": {"configs": [{"template_handle": CHAIR, "original_file": "../x"}]}}, "which lies outside"),
        ({"objects": {"configs": [{"template_handle": CHAIR, "original_file": "x.json"}]}}, "there is no file"),
        ({"objects": {"default_attributes": []}}, "objects.default_attributes must be an object"),
        ({"objects": {"paths": {".json": ["../elsewhere/*"]}}}, None),
    ],
)
def test_invalid_dataset_file_is_refused(dataset: Dataset, document: Any, sentence: str | None) -> None:
    dataset.write("home.scene_dataset_config.json", document)
    if sentence is None:  # the listed files do not exist, and the template is found below the dataset
        loaded(dataset.scene(instance()))
        return
    with pytest.raises(
        SceneFormatError if "outside" not in sentence and "no file" not in sentence else SceneError, match=sentence
    ):
        loaded(dataset.scene(instance()))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "is empty"),
        ("[]", "holds a list; it must be a JSON object"),
        ("nonsense", "is not JSON"),
        ("[" * 100_000, "is not JSON"),
        ("{}", "is no Habitat scene: it has neither stage_instance nor object_instances"),
        ('{"format": "scene2hap/scene"}', "Scenes of scene2hap itself are named NAME.json"),
        ('{"object_instances": {}}', r"object_instances is \{\}; it must be a list"),
        ('{"object_instances": [7]}', r"object_instances\[0\] is 7; it must be an object"),
        ('{"stage_instance": "home"}', "stage_instance is 'home'; it must be an object"),
        ('{"object_instances": []}', "scene 'flat' holds no triangles"),
        ('{"object_instances": [], "articulated_object_instances": 3}', "articulated_object_instances is 3"),
    ],
)
def test_invalid_scene_file_is_refused(dataset: Dataset, text: str, sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        loaded(dataset.write("scenes/flat.scene_instance.json", text))


def test_habitat_scene_with_another_suffix_is_refused_with_a_hint(dataset: Dataset) -> None:
    path = dataset.scene(instance(), name="scenes/flat.json")
    with pytest.raises(SceneError, match=r"looks like a Habitat scene; name its file NAME\.scene_instance\.json"):
        load_scene(path)


def test_broken_model_error_names_its_row(dataset: Dataset) -> None:
    (dataset.folder / f"objects/f/{CHAIR}.glb").write_bytes(b"version https://git-lfs.github.com/spec/v1\n")
    with pytest.raises(
        SceneFormatError, match=rf"object_instances\[0\]: its model '{CHAIR}\.glb' .*run `git lfs pull`"
    ):
        loaded(dataset.scene(instance()))


@needs_links
def test_symbolic_links_out_of_the_root_are_refused(dataset: Dataset, tmp_path: Path) -> None:
    secret = one_cube().write(tmp_path / "secret.glb")
    model = dataset.folder / f"objects/f/{CHAIR}.glb"
    model.unlink()
    os.symlink(secret, model)
    with pytest.raises(SceneError, match="only files inside it are read"):
        loaded(dataset.scene(instance()))
    assert loaded(dataset.scene(instance()), assets_root=tmp_path).object(CHAIR)


def test_a_pattern_on_another_drive_finds_nothing(dataset: Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    """On Windows, a pattern may name another drive, to which there is no relative path."""
    relative = os.path.relpath

    def relpath(path: Path, start: Path) -> str:
        if path == dataset.folder.parent:
            raise ValueError("path is on mount 'C:', start on mount 'E:'")
        return relative(path, start)

    monkeypatch.setattr(os.path, "relpath", relpath)
    dataset.write("home.scene_dataset_config.json", {**DATASET, "stages": {"paths": {".json": [".."]}}})
    assert loaded(dataset.scene(instance())).object(CHAIR)


def test_files_above_assets_root_are_not_used(dataset: Dataset) -> None:
    """The dataset file and the objects lie outside `assets_root`."""
    with pytest.raises(SceneError, match="names the template 'stages/home'"):
        loaded(dataset.scene(instance()), assets_root=dataset.folder / "scenes")


# -- limits ----------------------------------------------------------------------------------------------------------


def test_totals_over_all_instances_are_limited(dataset: Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    path = dataset.scene(*(instance(at=[i, 0, 0]) for i in range(10)))
    for name, value, sentence in (
        ("MAX_OBJECTS", 9, "the number of object instances is 10"),
        ("MAX_TRIANGLES", 100, "the number of triangles is 108"),
        ("MAX_NODES", 5, "the number of nodes is 6"),
        ("MAX_DATASET_BYTES", 1000, "the size of all files of the dataset"),
        ("MAX_DATASET_FILES", 10, "the number of files in the dataset's folders"),
    ):
        with monkeypatch.context() as patch:
            patch.setattr(limits, name, value)
            with pytest.raises(SceneError, match=f"{sentence}.*scene2hap.scene.limits.{name}"):
                loaded(path)
    loaded(path)


@needs_links
def test_repeated_pattern_matches_are_bounded(dataset: Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MAX_DATASET_FILES", 20_000)
    for name in "abc":
        os.symlink(dataset.folder, dataset.folder / name)
    document = {**DATASET, "objects": {"paths": {".json": ["/".join("*" * 30)]}}}
    dataset.write("home.scene_dataset_config.json", document)
    with pytest.raises(SceneError, match="the number of files in the dataset's folders"):
        loaded(dataset.scene(instance()))


def test_broken_datasets_raise_only_scene_errors(tmp_path: Path) -> None:
    """A sample of the mutated datasets of `stress/fuzz_scenes.py`."""
    outcomes = set()
    for number in range(60):
        path = mutated_dataset(tmp_path / str(number), random.Random(number))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                load_scene(path)
                outcomes.add("read")
            except Scene2HapError as error:
                outcomes.add(type(error).__name__)
    assert outcomes >= {"read", "SceneFormatError"}


# -- whole scenes ----------------------------------------------------------------------------------------------------


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
