"""A bundle on disk: a folder of JSON, WAV and meshes that a person can read and edit.

bundle.json     format, version, kind of place, list of files (written last: a folder without it is half written)
scene.json      the snapshot; geometry by reference to meshes/
objects.json    ObjectHaptics of each object by id
loops.json      for each source and state its two sounds, frequencies and credit
overrides.json  what a person has overridden, by id
credits.txt     whom the sounds are owed to
meshes/*.ply    one per distinct mesh [m]
sounds/*.wav    audible and tactile loop of each source and state, equal in length and seam
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import tempfile
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from scene2hap import checks
from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.files import read_clip, write_wav
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle.haptic_bundle import HapticBundle
from scene2hap.bundle.override import Override
from scene2hap.errors import AudioError, BundleError, BundleIncomplete, BundleVersionError, MaterialError, SceneError
from scene2hap.haptics import ObjectHaptics
from scene2hap.materials import Material
from scene2hap.scene import json as scene_json
from scene2hap.scene.ply import decode_ply, encode_ply
from scene2hap.scene.snapshot import SceneSnapshot

FORMAT = "scene2hap/bundle"
VERSION = 1
MANIFEST = "bundle.json"

_objects: TypeAdapter[dict[str, ObjectHaptics]] = TypeAdapter(dict[str, ObjectHaptics])


def write_bundle(bundle: HapticBundle, target: Path) -> Path:
    """Write the folder whole or not at all; a bundle that is there already is replaced.

    Raises: BundleError: the folder holds something else, or cannot be written.
    """
    if target.exists() and not _may_replace(target):
        raise BundleError(f"{target} is not empty and not a bundle; choose another folder, or empty this one.")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        draft = Path(tempfile.mkdtemp(prefix=f".{target.name}-", dir=target.parent))
        try:
            _write(bundle, draft)
            _swap(draft, target)
        finally:
            shutil.rmtree(draft, ignore_errors=True)
    except OSError as cause:
        raise BundleError(f"{target} cannot be written: {cause}.") from cause
    return target


def _may_replace(target: Path) -> bool:
    return target.is_dir() and ((target / MANIFEST).is_file() or not any(target.iterdir()))


def _swap(draft: Path, target: Path) -> None:
    os.chmod(draft, 0o755)  # mkdtemp makes it private; a bundle is as readable as any folder
    if not target.exists():
        draft.rename(target)
        return
    retired = Path(tempfile.mkdtemp(prefix=f".{target.name}-old-", dir=target.parent))
    target.rename(retired / "bundle")
    draft.rename(target)
    shutil.rmtree(retired)


def _write(bundle: HapticBundle, folder: Path) -> None:
    (folder / "meshes").mkdir()
    (folder / "sounds").mkdir()
    written: list[str] = []

    def put(name: str, document: Any) -> None:
        text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)
        (folder / name).write_text(text + "\n", encoding="utf-8")
        written.append(name)

    scene = scene_json.to_document(bundle.snapshot)
    for item, row in zip(bundle.snapshot.objects, scene["objects"], strict=True):
        if item.geometry.kind == "mesh":
            name = f"meshes/{scene_json.geometry_key(item.geometry)}.ply"
            row["geometry"] = name
            if name not in written:
                (folder / name).write_bytes(encode_ply(item.geometry))
                written.append(name)
    loops: dict[str, dict[str, Any]] = {}
    for object_id, states in bundle.loops.items():
        loops[object_id] = {}
        for state, loop in states.items():
            stem = f"sounds/{file_stem(object_id)}.{file_stem(state)}"
            files = {kind: f"{stem}.{kind}.wav" for kind in ("audible", "tactile")}
            for kind, name in files.items():
                clip: AudioClip = getattr(loop, kind)
                write_wav(folder / name, clip.samples, clip.sample_rate_hz)
                written.append(name)
            loops[object_id][state] = {
                **files,
                "frequency_raw_hz": loop.frequency_raw_hz,
                "frequency_tactile_hz": loop.frequency_tactile_hz,
                "credit": asdict(loop.audible.credit),
            }
            if why := bundle.choices.get(object_id, {}).get(state):
                loops[object_id][state]["choice"] = why.splitlines()
    put("scene.json", {"format": scene_json.FORMAT, "version": scene_json.VERSION, **scene})
    put("objects.json", _objects.dump_python(dict(bundle.objects), mode="json"))
    put("loops.json", loops)
    put("overrides.json", _override_rows(bundle, folder, written))
    owed = dict.fromkeys(replace(who, query="") for who in bundle.credits)  # found by two queries, owed once
    lines = [f"{who.title}, by {who.author}, {who.licence}{', ' + who.address if who.address else ''}" for who in owed]
    text = "\n".join(["Sounds in this bundle, cut into loops and turned into vibration", *lines]) + "\n"
    (folder / "credits.txt").write_text(text, encoding="utf-8")
    put(
        MANIFEST,
        {
            "format": FORMAT,
            "version": VERSION,
            "scene_category": bundle.scene_category,
            "files": [*written, "credits.txt"],
        },
    )


def read_bundle(folder: Path) -> HapticBundle:
    """Read a folder that `write_bundle` wrote, edited or not.

    Raises: BundleIncomplete, BundleVersionError, BundleError: see `HapticBundle.load`.
    """
    manifest = _json_file(folder, MANIFEST)
    if manifest.get("format") != FORMAT:
        raise BundleError(f'{folder / MANIFEST} is not a bundle: it lacks "format": "{FORMAT}".')
    version = manifest.get("version")
    if not isinstance(version, int) or version > VERSION:
        raise BundleVersionError(
            f"{folder} has bundle version {version!r}; this scene2hap reads up to {VERSION}. Upgrade scene2hap."
        )
    missing = [name for name in manifest.get("files", []) if not (folder / name).is_file()]
    if missing:
        raise BundleIncomplete(f"{folder} lacks {missing[0]} ({len(missing)} missing). Bake it again or restore it.")
    try:
        rows = _json_file(folder, "loops.json")
        return HapticBundle(
            _read_scene(folder),
            str(manifest.get("scene_category", "undefined")),
            _objects.validate_python(_json_file(folder, "objects.json")),
            {
                object_id: {state: _read_loop(folder, row) for state, row in states.items()}
                for object_id, states in rows.items()
            },
            read_overrides(folder),
            {
                object_id: {state: "\n".join(row["choice"]) for state, row in states.items() if "choice" in row}
                for object_id, states in rows.items()
            },
        )
    except ValidationError as cause:
        problem = checks.first_problem(cause)
        raise BundleError(f"{folder / 'objects.json'}: {problem.place}: {problem.reason}.") from cause
    except MaterialError as cause:
        raise BundleError(f"{folder / 'overrides.json'}: {cause}") from cause
    except (AudioError, SceneError) as cause:
        raise BundleIncomplete(f"{folder}: {cause}") from cause
    except (AttributeError, KeyError, TypeError) as cause:
        raise BundleError(f"{folder}: loops.json or overrides.json lacks or misuses {cause}.") from cause


def _read_scene(folder: Path) -> SceneSnapshot:
    document = _json_file(folder, "scene.json")
    names = {row.get("geometry") for row in document.get("objects", []) if isinstance(row.get("geometry"), str)}
    document["geometries"] = {name: decode_ply(_inside(folder, name).read_bytes()) for name in sorted(names)}
    return scene_json.from_document(document)


def _override_rows(bundle: HapticBundle, folder: Path, written: list[str]) -> dict[str, Any]:
    rows: dict[str, Any] = {}
    for object_id, wish in bundle.overrides.items():
        row: dict[str, Any] = {"vibrates": wish.vibrates, "gain_db": wish.gain_db}
        row["material"] = asdict(wish.material) if wish.material is not None else None
        row["clip"] = None
        if wish.clip is not None:
            name = f"sounds/{file_stem(object_id)}.override.wav"
            write_wav(folder / name, wish.clip.samples, wish.clip.sample_rate_hz)
            written.append(name)
            row["clip"] = {"file": name, "credit": asdict(wish.clip.credit)}
        rows[object_id] = {field: value for field, value in row.items() if value is not None}
    return rows


def read_overrides(folder: Path) -> dict[str, Override]:
    """What a person has overridden in the bundle of a folder, by id; nothing where no bundle is.

    Raises: BundleError and its children: the file cannot be read, so that it would be lost.
    """
    if not (folder / "overrides.json").is_file():
        return {}
    overrides = {}
    for object_id, row in _json_file(folder, "overrides.json").items():
        fields = dict(row)
        if isinstance(fields.get("material"), dict):
            fields["material"] = Material(**fields["material"])
        if isinstance(fields.get("clip"), dict):
            clip = fields["clip"]
            fields["clip"] = read_clip(_inside(folder, clip["file"]), Credit(**clip["credit"]))
        overrides[object_id] = Override(**fields)
    return overrides


def _read_loop(folder: Path, row: dict[str, Any]) -> HapticLoop:
    credit = Credit(**row["credit"])
    audible, tactile = (read_clip(_inside(folder, row[kind]), credit) for kind in ("audible", "tactile"))
    return HapticLoop(audible, tactile, row["frequency_raw_hz"], row["frequency_tactile_hz"])


def _json_file(folder: Path, name: str) -> dict[str, Any]:
    try:
        document = json.loads((folder / name).read_text(encoding="utf-8"))
    except FileNotFoundError as cause:
        raise BundleIncomplete(
            f"{folder} has no {name}: not a bundle, or one that was not written to its end."
        ) from cause
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as cause:
        raise BundleIncomplete(f"{folder / name} cannot be read: {cause}. Bake again, or mend the file.") from cause
    if not isinstance(document, dict):
        raise BundleError(f"{folder / name} must hold a JSON object.")
    return document


def _inside(folder: Path, name: str) -> Path:
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise BundleError(f"{folder} refers to {name!r}, outside itself; a bundle only reads its own files.")
    return path


def file_stem(text: str) -> str:
    """A file name for any id; a short digest keeps apart what the plain letters would merge."""
    plain = re.sub(r"[^A-Za-z0-9_-]+", "-", text).strip("-")[:60]
    return plain if plain == text else f"{plain or 'x'}-{hashlib.sha256(text.encode()).hexdigest()[:8]}"
