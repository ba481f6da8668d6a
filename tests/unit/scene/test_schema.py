"""The published JSON schema: current, valid for written scenes, and no stricter than the reader."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap import Contact, Pose, SceneObject, SceneSnapshot, TriMesh, load_scene
from scene2hap.demo import kitchen_path
from scene2hap.errors import SceneError
from scene2hap.scene.schema import scene_schema
from scenes import box, scene

jsonschema = pytest.importorskip("jsonschema", reason="needs jsonschema, of the extra test")

PUBLISHED = Path(__file__).parents[3] / "docs" / "scene.schema.json"


def validator() -> Any:
    return jsonschema.Draft202012Validator(scene_schema())


def test_the_published_file_is_current() -> None:
    run = subprocess.run(
        [sys.executable, "-m", "scene2hap.scene.schema"], capture_output=True, text=True, encoding="utf-8", check=True
    )
    assert run.stdout == PUBLISHED.read_text(encoding="utf-8"), (
        "the types have changed; run: python -m scene2hap.scene.schema > docs/scene.schema.json"
    )


def test_published_schema_is_valid_and_mentions_only_json() -> None:
    schema = scene_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    told = json.dumps(schema)
    for word in ("appearance", "images", "_by_id", "python", "Raises"):
        assert word not in told
    assert set(schema["properties"]) == {
        "format", "version", "name", "up_axis", "objects", "contacts", "geometries"
    }  # fmt: skip


def everything() -> SceneSnapshot:
    """A scene that uses every field."""
    mesh = TriMesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]) / 3, [[0, 1, 2]])
    shard = SceneObject(
        "shard", "Scherbe", Pose((1, 2, 3), (0.5, 0.5, 0.5, 0.5)), mesh, box("x", (1, 1, 1), (0, 0, 0)).surface
    )
    contacts = (Contact("shard", "b", (0, 0, 0), (0, 1, 0), 0.1, 0.5), Contact("a", "b", (0, 0, 0)))
    boxes = (box("a", (1, 1, 1), (0, 0, 0)), box("b", (1, 1, 1), (0, 1, 0)))
    return SceneSnapshot("s", "z", (shard, *boxes), contacts)


def test_written_scenes_are_valid_by_the_schema() -> None:
    for snapshot in (everything(), load_scene(kitchen_path())):
        document = json.loads(snapshot.to_json())
        assert list(validator().iter_errors(document)) == []


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("format",), "other"),
        (("version",), 2),
        (("up_axis",), "x"),
        (("objects",), []),
        (("objects", 0, "id"), ""),
        (("objects", 0, "name"), 7),
        (("objects", 0, "pose", "position_m"), [0, 0]),
        (("objects", 0, "pose", "rotation_xyzw"), [0, 0, 1]),
        (("objects", 0, "geometry"), 5),
        (("objects", 0, "geometry"), {"kind": "box", "size_m": [1, 1, 0]}),
        (("objects", 0, "geometry"), {"kind": "mesh", "vertices_m": [[0, 0, 0]], "faces": []}),
        (("objects", 0, "geometry"), {"kind": "mesh", "vertices_m": [[0, 0, 0]], "faces": [[0, 0]]}),
        (("objects", 0, "geometry"), {"kind": "mesh", "vertices_m": [[0, 0, 0]], "faces": [[0, 0, -1]]}),
        (("objects", 0, "geometry"), {"kind": "mesh", "vertices_m": [["0", 0, "x"]], "faces": [[0, 0, 0]]}),
        (("objects", 0, "surface", "thickness_m"), -1),
        (("objects", 0, "surface", "flags"), ["odd"]),
        (("objects", 0, "relative_height_m"), "low"),
        (("contacts",), [{"a": "a", "b": "b"}]),
        (("contacts", 0, "weight"), 1.5),
        (("geometries",), []),
    ],
)
def test_reader_refuses_values_that_the_schema_refuses(path: tuple[Any, ...], value: object) -> None:
    document = json.loads(everything().to_json())
    assert validator().is_valid(document)
    place = document
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    assert not validator().is_valid(document)
    with pytest.raises(SceneError):
        SceneSnapshot.from_json(json.dumps(document))


@pytest.mark.parametrize("missing", ["pose", "geometry", "id", "name"])
def test_reader_requires_fields_that_the_schema_requires(missing: str) -> None:
    document = json.loads(scene(box("a", (1, 1, 1), (0, 0, 0))).to_json())
    del document["objects"][0][missing]
    assert not validator().is_valid(document)
    with pytest.raises(SceneError, match=missing):
        SceneSnapshot.from_json(json.dumps(document))


@pytest.mark.parametrize("absent", [{}, {"surface": None, "relative_height_m": None, "instance_key": ""}])
def test_reader_fills_optional_fields(absent: dict[str, Any]) -> None:
    row = {"id": "a", "name": "a", "pose": {}, "geometry": {"kind": "box", "size_m": [1, 1, 1]}, **absent}
    document = {"format": "scene2hap/scene", "version": 1, "name": "s", "up_axis": "y", "objects": [row], "mine": 7}
    assert list(validator().iter_errors(document)) == []
    assert SceneSnapshot.from_json(json.dumps(document)).object("a").size_m == (1, 1, 1)
