"""Build Habitat datasets by hand, so that tests know their content and can damage one place in them.

Structure and fields follow habitat-sim's data/test_assets/dataset_tests and docs/pages/attributesJSON.rst.
"""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gltf_builder import Gltf, Json
from scene2hap.scene.load import load_scene
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.snapshot import SceneSnapshot

CHAIR = "frl_apartment_chair_01"
HASH = "02a5a7ca2a4dc5cf5bd1f8c4e1f2aaf2bde0c3d1"
DATASET: Json = {
    "stages": {"paths": {".json": ["stages"]}},
    "objects": {"paths": {".json": ["objects/*"]}},
    "scene_instances": {"default_attributes": {"default_lighting": ""}, "paths": {".json": ["scenes"]}},
}


def corner_box(*, size: Sequence[float] = (1.0, 1.0, 1.0), name: str = "body") -> Gltf:
    """A model: one cuboid with a corner in the origin."""
    gltf = Gltf()
    gltf.node(name, mesh=gltf.cube(), root=True, scale=list(size))
    return gltf


def rooms() -> Gltf:
    """A stage: a floor and a wall."""
    gltf = Gltf()
    cube = gltf.cube()
    gltf.node("floor", mesh=cube, root=True, scale=[6.0, 0.1, 4.0], translation=[-3.0, -0.1, -2.0])
    gltf.node("wall", mesh=cube, root=True, scale=[6.0, 2.5, 0.1], translation=[-3.0, 0.0, -2.1])
    return gltf


class Dataset:
    """A dataset with a stage, a chair, and a washer whose name is a hash, but no scene yet."""

    def __init__(self, folder: Path, *, document: Json | None = DATASET) -> None:
        self.folder = folder
        for name in ("scenes", "stages", "objects/f", "objects/0", "metadata"):
            (folder / name).mkdir(parents=True, exist_ok=True)
        if document is not None:
            self.write("home.scene_dataset_config.json", document)
        rooms().write(folder / "stages" / "home.glb")
        self.write("stages/home.stage_config.json", {"render_asset": "home.glb"})
        corner_box(size=(0.5, 1.0, 0.5)).write(folder / "objects/f" / f"{CHAIR}.glb")
        self.write(f"objects/f/{CHAIR}.object_config.json", {"render_asset": f"{CHAIR}.glb", "mass": 6.0})
        corner_box(size=(0.6, 0.9, 0.6)).write(folder / "objects/0" / f"{HASH}.glb")
        self.write(f"objects/0/{HASH}.object_config.json", {"render_asset": f"{HASH}.glb"})

    def write(self, name: str, document: Any) -> Path:
        """Write a JSON file into the dataset. Returns its path."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(document if isinstance(document, str) else json.dumps(document), encoding="utf-8")
        return path

    def scene(self, *objects: Json, name: str = "scenes/flat.scene_instance.json", **fields: Any) -> Path:
        """Write a scene of these object instances. Returns its path."""
        document = {
            "translation_origin": "asset_local",
            "stage_instance": {"template_name": "stages/home"},
            "object_instances": list(objects),
            "default_lighting": "lights",
            "navmesh_instance": "navmesh_path1",
            "semantic_scene_instance": "semantic_descriptor_path1",
            **fields,
        }
        return self.write(name, {key: value for key, value in document.items() if value is not None})


def instance(template: str = CHAIR, at: Sequence[float] = (0.0, 0.0, 0.0), **fields: Any) -> Json:
    """A row of `object_instances`."""
    return {"template_name": template, "translation": list(at), "motion_type": "STATIC", **fields}


# -- broken datasets -------------------------------------------------------------------------------------------------

ODD: tuple[Any, ...] = (
    *(None, True, False, 0, -1, 3, 1e308, -1e308, 1e-320, 10**400, float("nan"), float("inf"), "", "\0", "\ud800"),
    *("../../../../../etc/passwd", "/dev/zero", "file:///etc/passwd", "a" * 5000, "*/*/*/*", "**", "[", "com", "NONE"),
    *([], {}, [[]], [0, 0, 0], [0, 0, 0, 0], [1e308] * 3, ["a", "b", "c"], [1, 2], [0] * 1000, {"a": {}}),
    *(CHAIR, HASH, f"{CHAIR}.glb", "cubeSolid", ".", "..", "objects", f"{HASH}.object_config.json"),
)
"""Invalid values, put in place of valid ones."""


def mutated_dataset(folder: Path, rng: random.Random) -> Path:
    """Write a dataset and damage one or two of its files at random. Returns the path of its scene."""
    dataset = Dataset(folder)
    row = instance(
        CHAIR, [1, 0, 0], rotation=[1, 0, 0, 0], uniform_scale=1.0, non_uniform_scale=[1, 1, 1], mass_scale=1.0
    )
    path = dataset.scene(
        {**row, "translation_origin": "COM", "apply_scale_to_mass": True},
        instance(HASH, [2, 0, 0], is_instance_visible=True),
        instance("heavy chair", [4, 0, 0]),
        articulated_object_instances=[{"template_name": "fridge"}],
    )
    chair: Json = {"render_asset": f"{CHAIR}.glb", "up": [0, 1, 0], "front": [0, 0, -1], "scale": [1, 1, 1]}
    chair |= {"COM": [0, 0, 0], "mass": 5.0, "units_to_meters": 1.0}
    dataset.write(f"objects/f/{CHAIR}.object_config.json", chair)
    heavy = {
        "template_handle": "heavy chair",
        "original_file": f"objects/f/{CHAIR}.object_config.json",
        "attributes": {"mass": 9.0},
    }
    objects = {**DATASET["objects"], "default_attributes": {"mass": 1.0}, "configs": [heavy]}
    dataset.write("home.scene_dataset_config.json", {**DATASET, "objects": objects})
    box = '<link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>'
    dataset.write("urdf/fridge/fridge.urdf", f'<robot name="fridge">{box}</robot>')
    dataset.write("semantics/objects.csv", f"id,name,main_category,wnsynsetkey\n{HASH},W,washer,washer.n.03\n")
    files = sorted(file for file in folder.rglob("*") if file.suffix in (".json", ".csv", ".urdf"))
    for _ in range(rng.choice([1, 1, 2])):
        file = rng.choice([path, path, *files])
        text = file.read_bytes().decode("utf-8", "surrogatepass")
        broken = _with_odd_value(text, rng) if file.suffix == ".json" and rng.random() < 0.8 else _torn(text, rng)
        file.write_bytes(broken.encode("utf-8", "surrogatepass"))
    return path


def _with_odd_value(text: str, rng: random.Random) -> str:
    """JSON with one random value replaced, repeated or removed; the same text if it is not valid JSON."""
    try:
        document = json.loads(text)
    except ValueError:
        return text
    place: Any = {"": document}
    step: Any = ""
    while isinstance(place[step], dict | list) and place[step] and (step == "" or rng.random() < 0.85):
        place = place[step]
        step = rng.choice(list(place) if isinstance(place, dict) else list(range(len(place))))
    action = rng.random()
    if action < 0.1 and isinstance(place, dict):
        del place[step]
    elif action < 0.2:
        place[step] = [place[step]] * rng.choice([2, 3, 5000])
    else:
        place[step] = rng.choice(ODD)
    return json.dumps(document)


def _torn(text: str, rng: random.Random) -> str:
    """A text that ends early, or has one part removed, repeated or replaced."""
    begin = rng.randrange(len(text) + 1)
    end = min(len(text), begin + rng.randrange(1, 40))
    middle = rng.choice(["", text[begin:end] * 1000, "[" * 50_000, '"', "\0", "9" * 5000, "\ud800", "é\n\r,"])
    return text[:begin] + middle + rng.choice(["", text[end:]])


def loaded(path: Path, **options: Any) -> SceneSnapshot:
    """A scene whose sizes are not held against those of real objects."""
    return load_scene(path, unit_m=1.0, **options)


def named(path: Path, **options: Any) -> list[str]:
    """The names of a scene's objects, without those of the stage."""
    return [item.name for item in loaded(path, **options).objects if item.name not in ("floor", "wall")]


def low_and_high(item: SceneObject) -> list[list[float]]:
    """The lowest and the highest corner of an object in the world [m]."""
    return [[round(value, 6) + 0.0 for value in corner] for corner in item.bounds_m.tolist()]
