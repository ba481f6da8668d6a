"""Write a bundle: a folder of JSON, WAV and meshes that a person can read and edit.

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
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from scene2hap.bundle.contents import BundleContents
from scene2hap.bundle.folder_replacement import replaced
from scene2hap.bundle.history import Kind, pop, push, step_beside, steps_beside, warned_of_steps
from scene2hap.bundle.manifest import FORMAT, MANIFEST, VERSION
from scene2hap.bundle.overrides_file import override_rows
from scene2hap.bundle.ply import encode_ply
from scene2hap.bundle.reading import OBJECTS
from scene2hap.bundle.sounds import write_loops
from scene2hap.common.files import Stamp
from scene2hap.errors import BundleError, unwritable
from scene2hap.scene import json as scene_json
from scene2hap.scene.shapes import Geometry

_SURROGATE = re.compile("[\ud800-\udfff]")


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
    put("objects.json", OBJECTS.dump_python(dict(bundle.objects), mode="json"))
    if bundle.inferred:
        put("inferred.json", OBJECTS.dump_python(dict(bundle.inferred), mode="json"), _by_line)
    put("loops.json", write_loops(bundle, put_bytes))
    put("overrides.json", override_rows(bundle, put_bytes), _by_line)
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
