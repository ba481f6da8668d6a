"""Broken, hostile and too large Habitat scenes and datasets."""

from __future__ import annotations

import os
import random
import warnings
from pathlib import Path
from typing import Any

import pytest

from gltf_builder import Json, one_cube
from habitat_builder import CHAIR, DATASET, Dataset, instance, loaded, mutated_dataset
from scene2hap.errors import Scene2HapError, SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.load import load_scene
from systems import needs_links


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
