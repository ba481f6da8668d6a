"""The manifest of a bundle, bundle.json: its format and version, and the files that belong to the bundle."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

from scene2hap.bundle.files import read_json
from scene2hap.common import checks
from scene2hap.common.printable import quoted
from scene2hap.errors import BundleError, BundleIncomplete, BundleVersionError

FORMAT = "scene2hap/bundle"
VERSION = 1
MANIFEST = "bundle.json"

_OURS = re.compile(
    r"(meshes/[^/\\]+\.ply|sounds/[^/\\]+\.(wav|flac)|(scene|objects|inferred|loops|overrides)\.json|credits\.txt)"
)


def read_manifest(folder: Path) -> dict[str, Any]:
    """Read bundle.json, and check its format and version.

    Raises: BundleIncomplete: it is missing or damaged; BundleVersionError: of a newer scene2hap; BundleError: it has
    another format.
    """
    manifest = read_json(folder, MANIFEST)
    if manifest.get("format") != FORMAT:
        raise BundleError(f'{folder / MANIFEST} is not a bundle: it lacks "format": "{FORMAT}".')
    version = manifest.get("version")
    if isinstance(version, bool) or not isinstance(version, int) or version < 1:
        raise BundleError(f"{folder / MANIFEST}: version is {str(version)[:40]!r}; it must be a whole number from 1.")
    if version > VERSION:
        raise BundleVersionError(
            f"{folder} has bundle version {str(version)[:40]}; this scene2hap reads up to {VERSION}. Upgrade scene2hap."
        )
    names = manifest.get("files", [])
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise BundleError(f"{folder / MANIFEST}: files must be a list of names.")
    return manifest


def require_folder(folder: Path) -> None:
    """Raise a BundleIncomplete if a path cannot be a bundle, because nothing or a file is there."""
    if not os.path.lexists(folder):
        near = checks.near_files(folder) or "`scene2hap bake`, or `bake(scene).save(folder)`, writes one."
        raise BundleIncomplete(f"there is no folder {quoted(folder)}. {near}")
    if os.path.isfile(folder):
        how = (
            "give its folder"
            if folder.name == MANIFEST
            else "`scene2hap bake`, or `bake(scene)`, makes a bundle of a scene"
        )
        raise BundleIncomplete(f"{quoted(folder)} is a file; a bundle is a folder: {how}.")


def our_files(folder: Path) -> frozenset[str]:
    """Return the names of the files in a bundle's manifest, with forward slashes. Raises: as `read_manifest`.

    Names that scene2hap never writes are left out, even if the manifest lists them.
    """
    names = read_manifest(folder).get("files", [])
    return frozenset(name for name in names if _OURS.fullmatch(name)) | {MANIFEST}
