"""A scene as JSON, for engines that are not written in Python and for bundles.

Instances share geometry, so each geometry is stored once in a table. An object contains the key of its geometry, or the
geometry itself. The dominant surface and the height of an object are measured if the file does not have them.
docs/scene-json.md describes the format for authors of exporters.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from pydantic import TypeAdapter, ValidationError

from scene2hap.common import checks
from scene2hap.common.json_fields import is_version
from scene2hap.common.json_texts import read_json
from scene2hap.common.warning import warn_of
from scene2hap.errors import SceneError
from scene2hap.scene import limits
from scene2hap.scene.copies import as_copy, material_names
from scene2hap.scene.files import HABITAT_SUFFIX
from scene2hap.scene.objects import VERTICAL, SceneData, SceneObject, require_placed, with_relative_heights
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box, DominantSurface, Geometry, TriMesh
from scene2hap.scene.surface import plate_sizes

FORMAT = "scene2hap/scene"
VERSION = 1

_scene: TypeAdapter[SceneData] = TypeAdapter(SceneData)
_geometries: dict[str, TypeAdapter[Any]] = {"box": TypeAdapter(Box), "mesh": TypeAdapter(TriMesh)}
_SCENE_FIELDS = frozenset({"format", "version", "name", "up_axis", "objects", "contacts", "geometries"})
_OBJECT_FIELDS = frozenset(
    {"id", "name", "pose", "geometry", "surface", "relative_height_m", "instance_key", "mass_kg", "hinge"}
    | {"material_names"}
)
# Fields that are found from the geometry if a row lacks them.
_FOUND_FIELDS = ("surface", "relative_height_m", "instance_key")
_POSE_FIELDS = frozenset({"position_m", "rotation_xyzw"})
# Placeholder for a surface until it is measured.
_UNMEASURED = DominantSurface(Pose(), 0.0, 0.0, 0.0, ("zero-thickness",))


def dump(scene: SceneData) -> str:
    """Return the scene as JSON text with a geometry table."""
    geometries: dict[str, Any] = {}

    def key_of(geometry: Geometry) -> str:
        key = geometry_key(geometry)
        if key not in geometries:
            geometries[key] = plain_geometry(geometry)
        return key

    document = to_document(scene, key_of)
    return json.dumps({"format": FORMAT, "version": VERSION, **document, "geometries": geometries}, allow_nan=False)


def parse(text: str) -> SceneData:
    """Return the scene in a JSON text. Raises: SceneError: a field is wrong; the message names it."""
    if isinstance(text, bytes | bytearray):
        text = text.decode("utf-8", "replace")
    if not isinstance(text, str):
        raise SceneError(
            f"text is {checks.described(text)}; it must be the JSON text of a scene, as `to_json` gives. Of a file "
            "give path.read_text(), of a dictionary json.dumps(document)."
        )
    try:
        document = read_json(text.removeprefix("\ufeff"))  # Windows tools begin a text so
    except ValueError as cause:
        raise SceneError(f'not JSON: {cause}. A scene file starts with {{"format": "{FORMAT}", ...}}.') from cause
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        looks_like_habitat = isinstance(document, dict) and {"stage_instance", "object_instances"} & document.keys()
        hint = f" It looks like a Habitat scene; name its file NAME{HABITAT_SUFFIX}." if looks_like_habitat else ""
        raise SceneError(f'not a scene: the top level must be an object with "format": "{FORMAT}".{hint}')
    version = document.get("version")
    if not is_version(version, VERSION):
        raise SceneError(f"scene format version is {version!r}; this scene2hap reads version {VERSION}.")
    return from_document(document)


def to_document(scene: SceneData, geometry_field: Callable[[Geometry], Any]) -> dict[str, Any]:
    """Return the scene as plain JSON values, with the field `geometry` of each object from a function."""
    hidden: Any = {"objects": {"__all__": {"appearance", "images", "material_names", "geometry"}}}
    document: dict[str, Any] = _scene.dump_python(scene, mode="json", exclude=hidden)
    for item, row in zip(scene.objects, document["objects"], strict=True):
        rest = {key: row.pop(key) for key in tuple(row) if key not in ("id", "name", "pose")}
        row |= {"geometry": geometry_field(item.geometry), **rest}
        if names := material_names(item):
            row["material_names"] = list(names)
        if item.hinge is None:
            del row["hinge"]
    return document


def plain_geometry(geometry: Geometry) -> dict[str, Any]:
    """Return a geometry as plain JSON values."""
    row: dict[str, Any] = _geometries[geometry.kind].dump_python(geometry, mode="json")
    return row


def from_document(document: dict[str, Any]) -> SceneData:
    """Return the scene in plain JSON values; objects may contain a key of the table `geometries`.

    An object's `surface` and `relative_height_m` are measured if they are absent or null. Without `instance_key`,
    objects of equal mesh are copies.
    """
    table = document.get("geometries", {})
    shared: dict[str, Geometry] = {}
    try:
        if not isinstance(table, dict):
            raise SceneError("geometries must be an object that maps a key to a geometry.")
        shared = {key: _as_geometry(row, f"geometries.{key}") for key, row in table.items()}
        objects = document.get("objects")
        if isinstance(objects, list):
            limits.at_most("the number of objects", len(objects), "MAX_OBJECTS")
            objects = [
                _with_geometry(_without_nulls(row), shared, f"objects.{number}.geometry")
                for number, row in enumerate(objects)
            ]
        fields = {key: document[key] for key in ("name", "up_axis", "contacts") if key in document}
        scene = _scene.validate_python({**fields, "objects": objects})
    except ValidationError as cause:
        problem = checks.first_problem(cause)
        raise SceneError(f"scene field {problem.place or '(top)'}: {problem.reason}.") from cause
    for item in scene.objects:
        require_placed(item)
        _require_plausible_thickness(item)
    rows = document["objects"]
    _warn_of_slips("the scene", _SCENE_FIELDS, [document])
    _warn_of_slips("an object", _OBJECT_FIELDS, rows)
    poses = [row["pose"] for row in rows if isinstance(row["pose"], dict)]
    _warn_of_slips("a pose", _POSE_FIELDS, poses)
    if scale := next((x["scale"] for x in (*rows, *poses) if "scale" in x and x["scale"] not in (1, [1, 1, 1])), None):
        warn_of(
            f"the field 'scale', {checks.represented(scale)}, is ignored: objects and poses have no scale. Multiply "
            "size_m or vertices_m by it."
        )
    is_whole = all(row.get(key) is not None for row in rows for key in _FOUND_FIELDS)
    return scene if is_whole else _completed(scene, rows)


def _warn_of_slips(owner: str, known: frozenset[str], rows: Sequence[dict[str, Any]]) -> None:
    """Warn of fields whose names are similar to a missing one: they are ignored, as fields of an exporter's own are."""
    seen: set[str] = set()
    for row in rows:
        for key in sorted(row.keys() - known - seen):
            seen.add(key)
            if near := checks.did_you_mean(key, sorted(known - row.keys())):
                warn_of(f"the field {checks.represented(key)} of {owner} is ignored. {near}")


def geometry_key(geometry: Geometry) -> str:
    """Return the name of a geometry's row."""
    if geometry.kind == "mesh":
        return f"mesh-{geometry.digest}"
    return "box-" + "x".join(f"{edge!r}" for edge in geometry.size_m)


def _as_geometry(row: Any, place: str) -> Any:
    """Return a box or a mesh. Its errors are those of its kind: of a mesh with a wrong face, none speaks of a box."""
    if isinstance(row, Box | TriMesh):
        return row
    if not isinstance(row, dict):
        raise SceneError(
            f"scene field {place} is {checks.represented(row)}; it must be a box or a mesh, as "
            '{"kind": "box", "size_m": [1, 1, 1]}.'
        )
    kind = row.get("kind", "box" if "size_m" in row else "mesh")
    if not isinstance(kind, str) or kind not in _geometries:
        raise SceneError(f"scene field {place}.kind is {checks.represented(kind)}; it must be 'box' or 'mesh'.")
    try:
        return _geometries[kind].validate_python(row)
    except ValidationError as cause:
        problem = checks.first_problem(cause)
        raise SceneError(f"scene field {'.'.join(filter(None, (place, problem.place)))}: {problem.reason}.") from cause


def _with_geometry(row: Any, shared: dict[str, Geometry], place: str) -> Any:
    if not isinstance(row, dict) or "geometry" not in row:
        return row
    if not isinstance(row["geometry"], str):
        return {**row, "geometry": _as_geometry(row["geometry"], place)}
    key = row["geometry"]
    if key not in shared:
        raise SceneError(f"object {row.get('id')!r} names geometry {key!r}, which the table geometries lacks.")
    return {**row, "geometry": shared[key]}


def _without_nulls(row: Any) -> Any:
    """Copy an object's row without its nulls. A row without a surface gets a placeholder."""
    if not isinstance(row, dict):
        return row
    return {"surface": _UNMEASURED, **{key: value for key, value in row.items() if value is not None}}


def _require_plausible_thickness(item: SceneObject) -> None:
    """Compare a stated thickness with the geometry: no slab is many times thicker than its mesh."""
    normal = np.abs(item.surface.pose.rotation[:, 2])
    extent_m = float(normal @ np.ptp(item.geometry.mesh.bounds_m, axis=0))
    bound_m = plate_sizes.thickest_m((item.surface.length_m, item.surface.width_m, extent_m))
    if item.surface.thickness_m > bound_m:
        raise SceneError(
            f"object {item.id!r}: surface.thickness_m is {item.surface.thickness_m:g} m, but its geometry is "
            f"{extent_m:.3g} m thick there; it must be at most {bound_m:.3g} [m]. "
            "Leave the surface out to have it measured."
        )


def _completed(scene: SceneData, rows: Sequence[dict[str, Any]]) -> SceneData:
    """Return the scene with the surfaces, heights and keys of copies that its rows lack."""
    # Imported only here, since files that this library wrote contain all measurements.
    from scene2hap.scene.surface.surface_cache import SurfaceCache

    surfaces = SurfaceCache()
    stored = {item.geometry.mesh.digest: len(item.geometry.mesh.vertices_m) for item in scene.objects}
    surfaces.work.stored = sum(stored.values())
    objects = []
    for item, row in zip(scene.objects, rows, strict=True):
        if row.get("instance_key") is None:
            item = as_copy(item)
        if item.surface is _UNMEASURED:
            up = item.pose.rotation[VERTICAL[scene.up_axis]]
            item = replace(item, surface=surfaces.of(item.geometry.mesh, up, f"object {item.id!r}", turns=True))
        objects.append(item)
    above = with_relative_heights(objects, scene.up_axis)
    objects = [
        measured if row.get("relative_height_m") is None else item
        for item, measured, row in zip(objects, above, rows, strict=True)
    ]
    return replace(scene, objects=tuple(objects))
