"""Datasets of Habitat scenes: where templates and their names are found."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from gltf_builder import Json, one_cube
from habitat_builder import CHAIR, DATASET, HASH, Dataset, instance, loaded, low_and_high, named
from scene2hap import SceneWarning
from scene2hap.errors import SceneError
from scene2hap.scene.load import load_scene


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
