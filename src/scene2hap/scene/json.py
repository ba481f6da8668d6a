"""SceneSnapshot as JSON, for engines that are not written in Python and for bundles.

Geometry stands once in a table, since instances share it; an object names its row, or brings its geometry along.
"""

from __future__ import annotations

import json
from typing import Any

from pydantic import TypeAdapter, ValidationError

from scene2hap import checks
from scene2hap.errors import SceneError
from scene2hap.scene.snapshot import Geometry, SceneSnapshot

FORMAT = "scene2hap/scene"
VERSION = 1

_scene: TypeAdapter[SceneSnapshot] = TypeAdapter(SceneSnapshot)
_geometry: TypeAdapter[Geometry] = TypeAdapter(Geometry)


def dump(snapshot: SceneSnapshot) -> str:
    """The snapshot as JSON text with a geometry table."""
    document = to_document(snapshot)
    geometries: dict[str, Any] = {}
    for item, row in zip(snapshot.objects, document["objects"], strict=True):
        key = geometry_key(item.geometry)
        geometries.setdefault(key, row["geometry"])
        row["geometry"] = key
    return json.dumps({"format": FORMAT, "version": VERSION, **document, "geometries": geometries}, allow_nan=False)


def parse(text: str) -> SceneSnapshot:
    """The snapshot in a JSON text; raises SceneError with the field that is wrong."""
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as cause:  # ValueError: also a number of thousands of digits
        raise SceneError(f'not JSON: {cause}. A scene file starts with {{"format": "{FORMAT}", ...}}.') from cause
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise SceneError(f'not a scene: the top level must be an object with "format": "{FORMAT}".')
    version = document.get("version")
    if version != VERSION:
        raise SceneError(f"scene format version is {version!r}; this scene2hap reads version {VERSION}.")
    return from_document(document)


def to_document(snapshot: SceneSnapshot) -> dict[str, Any]:
    """The snapshot as plain JSON values, each object with its geometry."""
    hidden: Any = {"_by_id": True, "images": True, "objects": {"__all__": {"appearance", "images"}}}
    document: dict[str, Any] = _scene.dump_python(snapshot, mode="json", exclude=hidden)
    return document


def from_document(document: dict[str, Any]) -> SceneSnapshot:
    """The snapshot in plain JSON values; objects may name a row of the table `geometries`."""
    table = document.get("geometries", {})
    shared: dict[str, Geometry] = {}
    try:
        if not isinstance(table, dict):
            raise SceneError("geometries must be an object that maps a key to a geometry.")
        shared = {key: _geometry.validate_python(row) for key, row in table.items()}
        objects = document.get("objects")
        if isinstance(objects, list):
            objects = [_with_geometry(row, shared) for row in objects]
        fields = {key: document[key] for key in ("name", "up_axis", "contacts") if key in document}
        return _scene.validate_python({**fields, "objects": objects})
    except ValidationError as cause:
        problem = checks.first_problem(cause)
        raise SceneError(f"scene field {problem.place or '(top)'}: {problem.reason}.") from cause


def geometry_key(geometry: Geometry) -> str:
    """The row that a geometry stands in."""
    if geometry.kind == "mesh":
        return f"mesh-{geometry.digest}"
    return "box-" + "x".join(f"{edge!r}" for edge in geometry.size_m)


def _with_geometry(row: Any, shared: dict[str, Geometry]) -> Any:
    if not isinstance(row, dict) or not isinstance(row.get("geometry"), str):
        return row
    key = row["geometry"]
    if key not in shared:
        raise SceneError(f"object {row.get('id')!r} names geometry {key!r}, which the table geometries lacks.")
    return {**row, "geometry": shared[key]}
