"""The file of corrections that a report page saves.

    {"format": "scene2hap/overrides", "version": 1, "overrides": {"fridge": {"material": "oak", "gain_db": -3.0}}}

Fields are those of `HapticBundle.override`, except clips. Absent fields stay unchanged.
"""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import Any

from scene2hap.bundle.override import Override
from scene2hap.common import checks
from scene2hap.common.files import read_small_text
from scene2hap.common.json_fields import is_version
from scene2hap.common.json_texts import read_json
from scene2hap.errors import BundleError, reason_of

FORMAT, VERSION = "scene2hap/overrides", 1
FIELDS = frozenset(one.name for one in fields(Override)) - {"clip"}


def read_corrections(path: Path) -> dict[str, dict[str, Any]]:
    """Read the corrected fields by object id.

    Raises: BundleError: the file cannot be read, has another format, or has a field that cannot be corrected.
    """
    try:
        document = read_json(read_small_text(path))
    except (OSError, ValueError) as cause:
        raise BundleError(f"{path} cannot be read: {reason_of(cause)}. Save it again from the viewer.") from cause
    return parsed_corrections(document, str(path))


def parsed_corrections(document: object, place: str) -> dict[str, dict[str, Any]]:
    """Check plain data as `read_corrections` does, and return it. `place` is its name in error messages."""
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise BundleError(f'{place} is no file of corrections: it must be an object with "format": "{FORMAT}".')
    if not is_version(document.get("version"), VERSION):
        raise BundleError(f"{place} is of version {document.get('version')!r}; this scene2hap reads version {VERSION}.")
    rows = document.get("overrides")
    if not isinstance(rows, dict) or not all(isinstance(row, dict) for row in rows.values()):
        raise BundleError(f"{place}: overrides must map ids to objects with fields.")
    for object_id, row in rows.items():
        for name in row:
            if name not in FIELDS:
                near = checks.did_you_mean(name, FIELDS, f"They are {', '.join(sorted(FIELDS))}.")
                raise BundleError(f"{place}: {object_id!r} has no field {checks.shown(name)}. {near}")
    return rows
