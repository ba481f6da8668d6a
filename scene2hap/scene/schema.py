"""The JSON schema of scene JSON, for authors of exporters.

    python -m scene2hap.scene.schema > docs/scene.schema.json

It is generated from the types, so that both agree. Pydantic gives names, shapes and defaults. This module adds the
parts that pydantic cannot see: bounds that the types check in code, arrays, optional fields, and descriptions for
exporters.
"""

from __future__ import annotations

import json
from typing import Any

from pydantic import TypeAdapter
from pydantic.json_schema import GenerateJsonSchema

from scene2hap.scene.json import FORMAT, VERSION
from scene2hap.scene.snapshot import SceneSnapshot

_Json = dict[str, Any]

_PYTHON_ONLY = "x-python-only"
_LENGTH = {"minimum": 0}
_ROW = {"type": "array", "minItems": 3, "maxItems": 3}
_BOUNDS: dict[str, _Json] = {
    "Box.size_m": {"prefixItems": [{"type": "number", "exclusiveMinimum": 0}] * 3},
    "TriMesh.vertices_m": {"type": "array", "minItems": 1, "items": {**_ROW, "items": {"type": "number"}}},
    "TriMesh.faces": {"type": "array", "minItems": 1, "items": {**_ROW, "items": {"type": "integer", "minimum": 0}}},
    "DominantSurface.length_m": _LENGTH,
    "DominantSurface.width_m": _LENGTH,
    "DominantSurface.thickness_m": _LENGTH,
    "Contact.weight": {"minimum": 0, "maximum": 1},
    "SceneObject.id": {"minLength": 1},
}
_WORDS = {
    "Box": "A cuboid centred on its object's pose.",
    "Box.size_m": "Edges along the object's own x, y and z [m].",
    "TriMesh": "A triangle mesh in its object's own frame, scale and mirroring baked in.",
    "TriMesh.vertices_m": "Vertices (x, y, z) [m].",
    "TriMesh.faces": "Triangles as three vertex numbers from 0, counter-clockwise seen from outside.",
    "Pose": "Where an object's own frame stands in the world, without scale.",
    "Pose.position_m": "World [m].",
    "Pose.rotation_xyzw": "Quaternion (x, y, z, w); it is normalised.",
    "DominantSurface": "The plate that a person would name first, such as the top of a table.",
    "DominantSurface.pose": "A corner of the plate's mid-plane in the object's own frame; x runs along the length, "
    "y along the width, z along the normal.",
    "DominantSurface.outline": "What it covers if it is no rectangle, from the corner along length and width [m]; "
    "leave it out or null for a rectangle.",
    "Outline.rings_m": "Rings of corners (x, y) [m], at least 3 each; a ring within another cuts a hole.",
    "DominantSurface.flags": "Why a measured surface wants a second look; leave it out where an engine knows.",
    "Contact": "Where two objects touch. A pair may have several.",
    "Contact.a": "An object's id.",
    "Contact.b": "Another object's id.",
    "Contact.point_m": "World [m].",
    "Contact.normal": "Unit vector from a to b.",
    "Contact.area_m2": "Of the patch that the point stands for [m2].",
    "Contact.weight": "1 touching to 0 gone [-].",
    "Hinge": "A pivot that holds an object on another: a door on its cabinet, a robot's link on the one before it.",
    "Hinge.to": "The other object's id.",
    "Hinge.point_m": "The pivot in the object's own frame [m].",
    "Hinge.other_point_m": "The pivot in the other object's frame [m].",
    "SceneObject": "One thing that a user would point at.",
    "SceneObject.id": "Unique in the scene, and the same on every export.",
    "SceneObject.name": "What the author called it; inference reads this first.",
    "SceneObject.geometry": "A box, a mesh, or the key of a row in `geometries`.",
    "SceneObject.surface": "Leave it out to have it measured.",
    "SceneObject.relative_height_m": "Of the lowest point above the lowest point of the scene [m]. Leave it out to "
    "have it measured.",
    "SceneObject.mass_kg": "What the whole object weighs [kg]; null or missing if nobody knows.",
    "SceneObject.hinge": "The pivot by which it is held on another object; null or missing if it is loose.",
    "SceneObject.material_names": "The authored names of its materials, that of the largest area first. "
    "Inference reads them.",
    "SceneObject.instance_key": "Equal for objects of equal mesh and materials; empty if unknown. "
    "Leave it out to have it found from the mesh.",
}
_MEASURED = ("surface", "relative_height_m")


class _Generator(GenerateJsonSchema):
    """Pydantic's generator, changed for types that have no JSON: they are marked or left open instead of refused."""

    def handle_invalid_for_json_schema(self, schema: Any, error_info: str) -> _Json:
        return {_PYTHON_ONLY: True} if schema["type"] == "is-instance" else {}


def scene_schema() -> _Json:
    """Return the schema (JSON Schema, 2020-12) of the text that `SceneSnapshot.from_json` reads."""
    plain = _plain(TypeAdapter(SceneSnapshot).json_schema(schema_generator=_Generator))
    parts: _Json = plain["$defs"]
    for name, part in parts.items():
        part["properties"] = {
            key: {**_described(f"{name}.{key}"), **field, **_BOUNDS.get(f"{name}.{key}", {})}
            for key, field in part["properties"].items()
        }
        parts[name] = {**_described(name), **part}
    thing = parts["SceneObject"]
    shapes = thing["properties"]["geometry"]["anyOf"]
    thing["properties"]["geometry"]["anyOf"] = [{"type": "string"}, *shapes]
    for key in _MEASURED:
        field = thing["properties"][key]
        words, _ = field.pop("description"), field.pop("default", None)
        thing["properties"][key] = {"description": words, "anyOf": [field, {"type": "null"}]}
    thing["required"] = [key for key in thing["required"] if key not in _MEASURED]
    plain["properties"]["objects"]["minItems"] = 1
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "scene2hap scene",
        "description": "The objects of a scene in metres, right-handed; see docs/scene-json.md.",
        "type": "object",
        "properties": {
            "format": {"const": FORMAT},
            "version": {"const": VERSION},
            **plain["properties"],
            "geometries": {
                "description": "Geometries that objects name, each once.",
                "type": "object",
                "additionalProperties": {"anyOf": shapes},
            },
        },
        "required": ["format", "version", *plain["required"]],
        "$defs": parts,
    }


def _plain(schema: Any) -> Any:
    """Return the schema without fields that exist only in Python, and without titles and docstrings."""
    if isinstance(schema, list):
        return [_plain(item) for item in schema]
    if not isinstance(schema, dict):
        return schema
    kept = {key: _plain(value) for key, value in schema.items() if key not in ("title", "description")}
    if isinstance(kept.get("properties"), dict):
        kept["properties"] = {
            key: field
            for key, field in kept["properties"].items()
            if not key.startswith("_") and _PYTHON_ONLY not in json.dumps(field)
        }
    if "const" in kept:
        # Versions of pydantic describe a constant differently.
        kept = {key: kept[key] for key in ("const", "default") if key in kept}
    return kept


def _described(place: str) -> _Json:
    return {"description": _WORDS[place]} if place in _WORDS else {}


if __name__ == "__main__":
    print(json.dumps(scene_schema(), indent=2, ensure_ascii=False))
