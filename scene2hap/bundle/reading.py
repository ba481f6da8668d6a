"""A bundle read from its folder, which a person may have edited."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle.checking import warn_of_unknown_fields
from scene2hap.bundle.contents import BundleContents
from scene2hap.bundle.files import inside, read_bytes, read_json, reading
from scene2hap.bundle.folder_replacement import recover
from scene2hap.bundle.made_with import MadeWith
from scene2hap.bundle.manifest import MANIFEST, read_manifest, require_folder
from scene2hap.bundle.override import Override
from scene2hap.bundle.overrides_file import read_overrides
from scene2hap.bundle.ply import decode_ply
from scene2hap.bundle.sounds import SoundReader
from scene2hap.errors import BundleError, BundleIncomplete
from scene2hap.haptics import ObjectHaptics
from scene2hap.materials import lookup
from scene2hap.scene import json as scene_json
from scene2hap.scene.snapshot import SceneSnapshot

OBJECTS: TypeAdapter[dict[str, ObjectHaptics]] = TypeAdapter(dict[str, ObjectHaptics])
_MOST_READINGS = 5


def read_bundle(folder: Path, overrides: Mapping[str, Override] | None = None) -> BundleContents:
    """Read a folder that `write_bundle` wrote, even if edited. If it is replaced during reading, read it again.

    `overrides` : overrides in the place of those in the folder, which are then not read.
    Raises: BundleIncomplete, BundleVersionError, BundleError: see `HapticBundle.load`.
    Warns: BundleWarning: an interrupted save was completed first.
    """
    recover(folder)
    require_folder(folder)
    for _ in range(_MOST_READINGS):
        begun = _identity(folder)
        try:
            bundle = _read(folder, overrides)
        except BundleError:
            if _identity(folder) == begun:
                raise
        else:
            if _identity(folder) == begun:
                return bundle
    raise BundleIncomplete(f"{folder} was replaced {_MOST_READINGS} times while it was read. Read it again later.")


def _read(folder: Path, overrides: Mapping[str, Override] | None) -> BundleContents:
    with reading(folder / MANIFEST):
        manifest = read_manifest(folder)
        missing = [name for name in manifest.get("files", []) if not inside(folder, name).is_file()]
        if missing:
            problem = f"{folder} lacks {missing[0][:200]} ({len(missing)} missing). Bake it again or restore it."
            raise BundleIncomplete(problem)
    with reading(folder / "scene.json"):
        scene = _read_scene(folder)
    objects = _read_objects(folder, "objects.json", scene)
    inferred = _read_objects(folder, "inferred.json", scene) if "inferred.json" in manifest.get("files", []) else {}
    with reading(folder / "loops.json"):
        rows, sounds = read_json(folder, "loops.json"), SoundReader(folder)
        loops: dict[str, dict[str, HapticLoop]] = {}
        for key, states in rows.items():
            loops[key] = {}
            for state, row in states.items():
                with reading(folder / "loops.json", f"{key[:200]!r}, state {state[:200]!r}: "):
                    loops[key][state] = sounds.loop(row)
        choices = {
            key: {state: "\n".join(row["choice"]) for state, row in states.items() if "choice" in row}
            for key, states in rows.items()
            if any("choice" in row for row in states.values())
        }
        _require_objects(loops, scene)
    for key in loops:
        if key not in objects:
            raise BundleError(f"{folder / 'objects.json'} lacks {key[:200]!r}, which has loops. Bake again.")
    if overrides is None:
        overrides = read_overrides(folder)
    with reading(folder / "overrides.json"):
        _require_objects(overrides, scene)
    with reading(folder / MANIFEST):
        made_with = MadeWith.from_document(manifest.get("made_with"), str(folder / MANIFEST))
        category = str(manifest.get("scene_category", "undefined"))
        return BundleContents(scene, category, objects, loops, overrides, choices, made_with, inferred)


def _identity(folder: Path) -> tuple[int, int] | None:
    try:
        found = folder.stat()
    except (OSError, ValueError):
        return None
    return found.st_dev, found.st_ino


def _read_scene(folder: Path) -> SceneSnapshot:
    document = read_json(folder, "scene.json")
    names = {row.get("geometry") for row in document.get("objects", []) if isinstance(row.get("geometry"), str)}
    document["geometries"] = {name: decode_ply(read_bytes(folder, name)) for name in sorted(names)}
    return SceneSnapshot.of(scene_json.from_document(document))


def _read_objects(folder: Path, name: str, scene: SceneSnapshot) -> dict[str, ObjectHaptics]:
    path = folder / name
    with reading(path):
        answers = _with_named_materials(path, read_json(folder, name))
        objects = OBJECTS.validate_json(json.dumps(answers), strict=True)  # else true is taken for the number 1
        warn_of_unknown_fields(path, answers)
        _require_objects(objects, scene)
    return objects


def _with_named_materials(path: Path, answers: dict[str, Any]) -> dict[str, Any]:
    """Return the answers with the constants of materials that a person has named. Raises: BundleError."""
    named = {}
    for object_id, answer in answers.items():
        with reading(path, f"{object_id!r}: "):
            given = {name: answer[name] for name in ("material", "feet") if isinstance(answer.get(name), str)}
            named[object_id] = {**answer, **{name: asdict(lookup(value)) for name, value in given.items()}}
    return named


def _require_objects(ids: Iterable[str], scene: SceneSnapshot) -> None:
    """Raise an UnknownObject if the scene lacks one of the objects."""
    for object_id in ids:
        scene.object(object_id)
