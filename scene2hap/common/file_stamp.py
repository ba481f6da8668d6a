"""Detection of changes of a file or a bundle, without reading it."""

from __future__ import annotations

from pathlib import Path

Stamp = tuple[int, int, int]
"""File number, time of the last change [ns], and size [bytes]."""


def file_stamp(path: Path) -> Stamp | None:
    """Return a stamp that changes whenever a file is written or replaced; None if there is no file."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    return found.st_ino, found.st_mtime_ns, found.st_size
