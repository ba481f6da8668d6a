"""A bundle on disk: a folder of JSON, WAV and meshes that a person can read and edit.

bundle.json     format, version, kind of place, settings of all loops, files; written last: without it, the folder is
                incomplete
scene.json      the snapshot; geometry by reference to meshes/
objects.json    ObjectHaptics of each object by id
inferred.json   ObjectHaptics of corrected objects, before the corrections; missing without any
loops.json      sounds, frequencies, credit and fingerprint of each source and state
overrides.json  a person's overrides, by id
credits.txt     credits of the sounds
meshes/*.ply    one per distinct mesh [m]
sounds/*.wav    audible and tactile loop of each source and state, with equal length and seam; equal loops share a file
sounds/*.flac   the sounds from which loops were cut, kept for later cuts and conversions
"""

from __future__ import annotations

import json
import os
import re
import shutil
import stat
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, fields, replace
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from scene2hap.audio.clip import Credit
from scene2hap.audio.encoding import encoded
from scene2hap.audio.files import read_clip
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle.checking import warn_of_unknown_fields
from scene2hap.bundle.contents import BundleContents
from scene2hap.bundle.corrections import FORMAT as CORRECTIONS_FORMAT
from scene2hap.bundle.files import inside, own_file, read_bytes, read_json
from scene2hap.bundle.folder_replacement import recover, replaced
from scene2hap.bundle.history import Kind, pop, push, step_beside, steps_beside, warned_of_steps
from scene2hap.bundle.made_with import MadeWith
from scene2hap.bundle.manifest import FORMAT, MANIFEST, VERSION, read_manifest, require_folder
from scene2hap.bundle.override import Override
from scene2hap.bundle.ply import decode_ply, encode_ply
from scene2hap.bundle.sounds import SoundReader, file_stems, write_loops
from scene2hap.common import checks
from scene2hap.common.files import Stamp
from scene2hap.errors import AudioError, BundleError, BundleIncomplete, Scene2HapError, SceneError, unwritable
from scene2hap.haptics import ObjectHaptics
from scene2hap.materials import lookup
from scene2hap.scene import json as scene_json
from scene2hap.scene.shapes import Geometry
from scene2hap.scene.snapshot import SceneSnapshot

_objects: TypeAdapter[dict[str, ObjectHaptics]] = TypeAdapter(dict[str, ObjectHaptics])


_SURROGATE = re.compile("[\ud800-\udfff]")
_MOST_READINGS = 5
_DAMAGE = (ArithmeticError, AttributeError, LookupError, MemoryError, OSError, RecursionError, TypeError, ValueError)
"""Errors that Python raises for documents of the wrong shape, for huge numbers, and for files that disappear."""


def write_bundle(bundle: BundleContents, target: Path, since: Stamp | None = None) -> Path:
    """Write the folder whole or not at all. An older bundle there is replaced, and foreign files are kept.

    `since` : replace the older bundle only if this is still its `save_stamp`.
    Raises: BundleVersionError: a bundle of a newer scene2hap is there; BundleChanged: the older bundle was replaced in
    the meantime; BundleError: the folder is not a bundle, is the working folder of this process, or cannot be written.
    """
    try:
        with replaced(target, since) as draft:
            _write(bundle, draft)
    except OSError as cause:
        raise BundleError(unwritable(target, cause)) from cause
    return target


def write_edited(bundle: BundleContents, target: Path, old: BundleContents | None, since: Stamp | None = None) -> Path:
    """Write a bundle, keep the one before as a step back, and remove the steps forward. Otherwise as `write_both`."""
    write_both(bundle, target, old, "before", since)
    with warned_of_steps(target):
        while steps_beside(target, "after"):
            pop(target, "after")
    return target


def write_both(
    bundle: BundleContents, target: Path, old: BundleContents | None, kind: Kind, since: Stamp | None = None
) -> Path:
    """Write a bundle, and the one that it replaces as a step of its history: both or none. Otherwise as `write_bundle`.

    `old` is None for one that cannot be read: its folder is copied as it is, since it may hold somebody's work.

    Both are written before either replaces a folder, so that a full disk or an early end changes nothing. Steps share
    equal sounds and meshes by hard links with one another, and not with the bundle, whose files people edit.
    """
    kept = step_beside(target, kind)
    shared = [*steps_beside(target, "before"), *steps_beside(target, "after")][:1]
    try:
        with replaced(kept, retire=push) as draft:
            if old is None:
                shutil.copytree(target, draft, symlinks=True, dirs_exist_ok=True)
            else:
                _write(old, draft, *shared)
            return write_bundle(bundle, target, since)
    except OSError as cause:
        raise BundleError(unwritable(kept, cause)) from cause


def _write(bundle: BundleContents, folder: Path, like: Path | None = None) -> None:
    """Write all files. Sounds and meshes that the folder `like` has too become hard links."""
    (folder / "meshes").mkdir()
    (folder / "sounds").mkdir()
    written: list[str] = []

    def put(name: str, document: Any, written_as: Callable[..., str] = _indented) -> None:
        text = written_as(document, ensure_ascii=False)
        if _SURROGATE.search(text):  # a name came from a file name that is not UTF-8
            text = written_as(document, ensure_ascii=True)
        put_bytes(name, f"{text}\n".encode())

    def put_bytes(name: str, content: bytes) -> None:
        written.append(name)
        if like is not None and "/" in name and _linked(like / name, folder / name, content):
            return
        with (folder / name).open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())

    shared: set[str] = set()

    def geometry_field(geometry: Geometry) -> object:
        if geometry.kind != "mesh":
            return scene_json.plain_geometry(geometry)
        name = f"meshes/{scene_json.geometry_key(geometry)}.ply"
        if name not in shared:
            shared.add(name)
            put_bytes(name, encode_ply(geometry))
        return name

    scene = scene_json.to_document(bundle.snapshot, geometry_field)
    put("scene.json", {"format": scene_json.FORMAT, "version": scene_json.VERSION, **scene})
    put("objects.json", _objects.dump_python(dict(bundle.objects), mode="json"))
    if bundle.inferred:
        put("inferred.json", _objects.dump_python(dict(bundle.inferred), mode="json"), _by_line)
    put("loops.json", write_loops(bundle, put_bytes))
    put("overrides.json", _override_rows(bundle, put_bytes), _by_line)
    owed = dict.fromkeys(replace(who, query="") for who in bundle.credits)  # two queries may find one sound
    lines = [f"{who.title}, by {who.author}, {who.licence}{', ' + who.address if who.address else ''}" for who in owed]
    text = "\n".join(["Sounds in this bundle, cut into loops and turned into vibration", *lines]) + "\n"
    put_bytes("credits.txt", text.encode("utf-8", "replace"))
    put(
        MANIFEST,
        {
            "format": FORMAT,
            "version": VERSION,
            "scene_category": bundle.scene_category,
            "made_with": bundle.made_with.to_document() if bundle.made_with is not None else None,
            "files": written,
        },
    )


def _indented(document: Any, *, ensure_ascii: bool) -> str:
    return json.dumps(document, indent=1, ensure_ascii=ensure_ascii, allow_nan=False)


def _by_line(rows: Mapping[str, Any], *, ensure_ascii: bool) -> str:
    """Return JSON with one line for each object, since git merges lines: it would mix the fields of two objects."""
    lines = [json.dumps({key: row}, ensure_ascii=ensure_ascii, allow_nan=False)[1:-1] for key, row in rows.items()]
    return "{\n " + ",\n ".join(lines) + "\n}" if lines else "{}"


def _linked(existing: Path, new: Path, content: bytes) -> bool:
    """Make `new` a hard link to an existing file of this content. Returns False if there is none, or no links."""
    try:
        if not stat.S_ISREG(existing.lstat().st_mode) or existing.read_bytes() != content:
            return False
        os.link(existing, new)
    except OSError:
        return False
    return True


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
    with _reading(folder / MANIFEST):
        manifest = read_manifest(folder)
        missing = [name for name in manifest.get("files", []) if not inside(folder, name).is_file()]
        if missing:
            problem = f"{folder} lacks {missing[0][:200]} ({len(missing)} missing). Bake it again or restore it."
            raise BundleIncomplete(problem)
    with _reading(folder / "scene.json"):
        scene = _read_scene(folder)
    objects = _read_objects(folder, "objects.json", scene)
    inferred = _read_objects(folder, "inferred.json", scene) if "inferred.json" in manifest.get("files", []) else {}
    with _reading(folder / "loops.json"):
        rows, sounds = read_json(folder, "loops.json"), SoundReader(folder)
        loops: dict[str, dict[str, HapticLoop]] = {}
        for key, states in rows.items():
            loops[key] = {}
            for state, row in states.items():
                with _reading(folder / "loops.json", f"{key[:200]!r}, state {state[:200]!r}: "):
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
    with _reading(folder / "overrides.json"):
        _require_objects(overrides, scene)
    with _reading(folder / MANIFEST):
        made_with = MadeWith.from_document(manifest.get("made_with"), str(folder / MANIFEST))
        category = str(manifest.get("scene_category", "undefined"))
        return BundleContents(scene, category, objects, loops, overrides, choices, made_with, inferred)


@contextmanager
def _reading(path: Path, place: str = "") -> Iterator[None]:
    """Convert errors of the block into a BundleError, or a child of it, that names the file and the place in it."""
    try:
        yield
    except BundleError as cause:
        if str(cause).startswith((f"{path.parent} ", f"{path.parent}{os.sep}")):  # it names the file already
            raise
        raise type(cause)(f"{path}: {place}{cause}") from cause
    except ValidationError as cause:
        problem = checks.first_problem(cause)
        value = checks.represented(problem.value)
        raise BundleError(f"{path}: {place}{problem.place[:200]} is {value}: {problem.reason}.") from cause
    except (AudioError, SceneError) as cause:
        raise BundleIncomplete(f"{path}: {place}{cause}") from cause
    except Scene2HapError as cause:
        raise BundleError(f"{path}: {place}{cause}") from cause
    except KeyError as cause:
        raise BundleError(f"{path}: {place}it lacks {cause}. Bake again, or mend the file.") from cause
    except _DAMAGE as cause:  # a file may be damaged in any way
        reason = str(cause)[:200] or type(cause).__name__
        raise BundleError(f"{path}: {place}invalid content: {reason}. Bake again, or correct the file.") from cause


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
    with _reading(path):
        answers = _with_named_materials(path, read_json(folder, name))
        objects = _objects.validate_json(json.dumps(answers), strict=True)  # else true is taken for the number 1
        warn_of_unknown_fields(path, answers)
        _require_objects(objects, scene)
    return objects


def _override_rows(bundle: BundleContents, put: Callable[[str, bytes], None]) -> dict[str, Any]:
    rows: dict[str, Any] = {}
    stems = file_stems(bundle.overrides)
    for object_id, wish in bundle.overrides.items():
        row = rows[object_id] = wish.corrections()
        for name in {"material", "feet"} & row.keys():
            row[name] = asdict(row[name])
        if wish.clip is not None:
            name = f"sounds/{stems[object_id]}.override.wav"
            put(name, encoded(wish.clip.samples, wish.clip.sample_rate_hz, path=Path(name), loop=wish.clip.loop))
            row["clip"] = {"file": name, "credit": asdict(wish.clip.credit)}
            if wish.clip.is_vibration:
                row["clip"]["is_vibration"] = True
    return rows


def read_overrides(folder: Path) -> dict[str, Override]:
    """Read the overrides of the bundle in a folder, by id; empty if there is no bundle.

    Raises: BundleError and its children: the file cannot be read. A bake then stops, so that overrides are not lost.
    """
    recover(folder)
    if not os.path.lexists(folder / MANIFEST) or not os.path.lexists(folder / "overrides.json"):
        return {}
    read_manifest(folder)
    path = folder / "overrides.json"
    with _reading(path):
        rows = read_json(folder, path.name)
        if rows.get("format") == CORRECTIONS_FORMAT:
            raise BundleError(
                f"{path} is a file of corrections from a report page, and no longer the bundle's own file. Move it out "
                f"of the folder, write {{}} into {path.name}, and apply it: scene2hap edit {folder} apply FILE."
            )
    overrides = {}
    for object_id, row in rows.items():
        with _reading(path, f"{object_id!r}: "):
            overrides[object_id] = _override(folder, row)
    return overrides


def _override(folder: Path, row: object) -> Override:
    if not isinstance(row, dict):
        raise BundleError(
            f'corrections are {checks.represented(row)}; they must be an object, such as {{"gain_db": -6}}.'
        )
    known = [one.name for one in fields(Override)]
    for name in row:
        if name not in known:
            near = checks.did_you_mean(name, known, f"They are {', '.join(known)}.")
            raise BundleError(f"there is no field {checks.shown(name)}. {near}")
    given = dict(row)
    clip = given.get("clip")
    if clip is not None:
        if not isinstance(clip, dict):
            raise BundleError(
                f"clip is {checks.represented(clip)}; it must be an object with file and credit. To choose a sound: "
                "scene2hap edit BUNDLE sound ID FILE."
            )
        read = read_clip(own_file(folder, clip["file"]), Credit(**clip["credit"]))
        is_vibration = checks.flag("is_vibration", clip.get("is_vibration", False), error=BundleError)
        given["clip"] = replace(read, is_vibration=is_vibration)
    return Override(**given)


def _with_named_materials(path: Path, answers: dict[str, Any]) -> dict[str, Any]:
    """Return the answers with the constants of materials that a person has named. Raises: BundleError."""
    named = {}
    for object_id, answer in answers.items():
        with _reading(path, f"{object_id!r}: "):
            given = {name: answer[name] for name in ("material", "feet") if isinstance(answer.get(name), str)}
            named[object_id] = {**answer, **{name: asdict(lookup(value)) for name, value in given.items()}}
    return named


def _require_objects(ids: Iterable[str], scene: SceneSnapshot) -> None:
    """Raise an UnknownObject if the scene lacks one of the objects."""
    for object_id in ids:
        scene.object(object_id)
