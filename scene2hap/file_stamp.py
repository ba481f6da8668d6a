"""Detect that a file or a bundle was written again, without reading it."""

from __future__ import annotations

from pathlib import Path

Stamp = tuple[int, int, int]
"""File number, time of the last change [ns], and size [bytes]."""


def file_stamp(path: Path) -> Stamp | None:
    """A stamp that changes whenever a file is written or replaced; None where no file is."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    return found.st_ino, found.st_mtime_ns, found.st_size
