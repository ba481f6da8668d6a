"""The files that belong to a bundle, and safe reading of files that a person may have changed."""

from __future__ import annotations

import os
import re
import stat
from pathlib import Path
from typing import Any

from scene2hap import checks
from scene2hap.errors import BundleError, BundleIncomplete, BundleVersionError, reason_of
from scene2hap.printable import parse_json

FORMAT = "scene2hap/bundle"
VERSION = 1
MANIFEST = "bundle.json"

MAX_FILE_BYTES = 1 << 28
"""Larger JSON and mesh files are rejected before they are read; assumed: 256 MiB are some 7 million triangles."""

_OURS = re.compile(
    r"(meshes/[^/\\]+\.ply|sounds/[^/\\]+\.(wav|flac)|(scene|objects|loops|overrides)\.json|credits\.txt)"
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
        near = checks.near_files(folder) or "`bake(scene).save(folder)` writes one."
        raise BundleIncomplete(f"there is no folder {str(folder)!r}. {near}")
    if os.path.isfile(folder):
        how = "give its folder" if folder.name == MANIFEST else "`bake(scene)` makes a bundle of a scene"
        raise BundleIncomplete(f"{str(folder)!r} is a file; a bundle is a folder: {how}.")


def our_files(folder: Path) -> frozenset[str]:
    """Return the names of the files in a bundle's manifest, with forward slashes. Raises: as `read_manifest`.

    Names that scene2hap never writes are left out, even if the manifest lists them.
    """
    names = read_manifest(folder).get("files", [])
    return frozenset(name for name in names if _OURS.fullmatch(name)) | {MANIFEST}


def read_json(folder: Path, name: str) -> dict[str, Any]:
    """Return the JSON object in a file of a bundle. Raises: BundleIncomplete, BundleError."""
    data = read_bytes(folder, name)
    try:
        document = parse_json(data.decode("utf-8-sig"))  # Windows editors add a byte-order mark
    except (ValueError, RecursionError) as cause:  # ValueError: not UTF-8, not JSON, or a number of thousands of digits
        raise BundleIncomplete(f"{folder / name} cannot be read: {cause}. Bake again, or mend the file.") from cause
    if not isinstance(document, dict):
        raise BundleError(f"{folder / name} must hold a JSON object.")
    return document


def read_bytes(folder: Path, name: str) -> bytes:
    """Read a file of a bundle, of at most `MAX_FILE_BYTES`. Raises: BundleIncomplete, BundleError."""
    path = own_file(folder, name)
    try:
        size = path.stat().st_size
        if size > MAX_FILE_BYTES:
            raise BundleError(f"{path} has {size} bytes; it must be at most {MAX_FILE_BYTES}. Bake again.")
        return path.read_bytes()
    except OSError as cause:
        raise BundleIncomplete(f"{path} cannot be read: {cause.strerror}. Bake again, or mend the file.") from cause


def own_file(folder: Path, name: object) -> Path:
    """Return the path of a regular file that a bundle names. Other kinds are rejected, since a pipe would block.

    Raises: BundleIncomplete: it is missing, or is no regular file; BundleError: it is outside the bundle.
    """
    path = inside(folder, name)
    try:
        mode = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError) as cause:
        raise BundleIncomplete(
            f"{folder} has no {str(name)[:80]}: not a bundle, or one that was not written to its end."
        ) from cause
    except OSError as cause:
        problem = f"{folder / str(name)[:80]} cannot be read: {cause.strerror}"
        raise BundleIncomplete(f"{problem}. Bake again, or mend the file.") from cause
    if not stat.S_ISREG(mode):
        raise BundleIncomplete(f"{path} is not a file. Bake again, or mend the folder.")
    return path


def inside(folder: Path, name: object) -> Path:
    """Return the path of a file that a bundle names. Raises: BundleError: it is outside the bundle, or is no name."""
    if not isinstance(name, str):
        raise BundleError(f"{folder} names a file {str(name)[:80]!r}; it must be a text.")
    try:
        path, home = (folder / name).resolve(), folder.resolve()
    except (OSError, RuntimeError, ValueError) as cause:  # a zero byte, a circle of links, a very long name
        raise BundleError(f"{folder} names a file {name[:80]!r}, which cannot be: {reason_of(cause)}.") from cause
    if not path.is_relative_to(home):
        raise BundleError(f"{folder} refers to {name[:80]!r}, outside itself; a bundle only reads its own files.")
    return path
