"""overrides.json: a person's overrides by object id, written and read."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import asdict, fields, replace
from pathlib import Path
from typing import Any

from scene2hap.audio.clip import Credit
from scene2hap.audio.encoding import encoded
from scene2hap.audio.files import read_clip
from scene2hap.bundle.contents import BundleContents
from scene2hap.bundle.corrections import FORMAT as CORRECTIONS_FORMAT
from scene2hap.bundle.files import own_file, read_json, reading
from scene2hap.bundle.folder_replacement import recover
from scene2hap.bundle.manifest import MANIFEST, read_manifest
from scene2hap.bundle.override import Override
from scene2hap.bundle.sounds import file_stems
from scene2hap.common import checks
from scene2hap.errors import BundleError


def override_rows(bundle: BundleContents, put: Callable[[str, bytes], None]) -> dict[str, Any]:
    """Return the rows of overrides.json; `put` writes the sound of an override, by its name and content."""
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
    with reading(path):
        rows = read_json(folder, path.name)
        if rows.get("format") == CORRECTIONS_FORMAT:
            raise BundleError(
                f"{path} is a file of corrections from a report page, and no longer the bundle's own file. Move it out "
                f"of the folder, write {{}} into {path.name}, and apply it: scene2hap edit {folder} apply FILE."
            )
    overrides = {}
    for object_id, row in rows.items():
        with reading(path, f"{object_id!r}: "):
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
