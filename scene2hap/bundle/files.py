"""Safe reading of a bundle's files, which a person may have changed: only regular files inside its folder."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from scene2hap.common import checks
from scene2hap.common.files import LFS_ADVICE, is_lfs_pointer
from scene2hap.common.json_texts import parse_json
from scene2hap.errors import AudioError, BundleError, BundleIncomplete, Scene2HapError, SceneError, reason_of

MAX_FILE_BYTES = 1 << 28
"""Larger JSON and mesh files are rejected before they are read; assumed: 256 MiB are some 7 million triangles."""
_DAMAGE = (ArithmeticError, AttributeError, LookupError, MemoryError, OSError, RecursionError, TypeError, ValueError)
"""Errors that Python raises for documents of the wrong shape, for huge numbers, and for files that disappear."""


def read_json(folder: Path, name: str) -> dict[str, Any]:
    """Return the JSON object in a file of a bundle. Raises: BundleIncomplete, BundleError."""
    data = read_bytes(folder, name)
    try:
        document = parse_json(data.decode("utf-8-sig"))  # Windows editors add a byte-order mark
    except ValueError as cause:  # also not UTF-8
        raise BundleIncomplete(
            f"{folder / name} cannot be read: {reason_of(cause)}. Mend the file, or bake again."
        ) from cause
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
        is_pointer, content = is_lfs_pointer(path), path.read_bytes()
    except OSError as cause:
        raise BundleIncomplete(f"{path} cannot be read: {cause.strerror}. Bake again, or mend the file.") from cause
    if is_pointer:
        raise BundleIncomplete(f"{path} {LFS_ADVICE}.")
    return content


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


@contextmanager
def reading(path: Path, place: str = "") -> Iterator[None]:
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
