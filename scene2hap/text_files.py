"""Small files that a person wrote: settings, touches, tables. Read whole, if they are files and not too large."""

from __future__ import annotations

import os
import stat
from pathlib import Path

MAX_BYTES = 1 << 24
"""Of one file; assumed: a hundred times the largest that is written by hand, and parsed in seconds."""


def read_small(path: str | os.PathLike[str], max_bytes: int = MAX_BYTES) -> bytes:
    """The content of a regular file. Pipes and devices are refused, since they may have no end.

    Raises: OSError, ValueError: there is no such file, it is none, or it is larger than `max_bytes`.
    """
    # Without O_NONBLOCK opening a pipe blocks. The open file is checked, since its name may mean another file by now.
    descriptor = os.open(Path(path), os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    with os.fdopen(descriptor, "rb") as file:
        found = os.fstat(descriptor)
        if not stat.S_ISREG(found.st_mode):
            raise ValueError("it is a folder, a pipe or a device; give a file")
        content = file.read(max_bytes + 1)
    if len(content) > max_bytes:
        raise ValueError(f"it has {max(found.st_size, len(content))} bytes; it must have at most {max_bytes}")
    return content


def read_small_text(path: str | os.PathLike[str], max_bytes: int = MAX_BYTES) -> str:
    """The same as text in UTF-8, with or without a byte-order mark. Raises: OSError, ValueError."""
    return read_small(path, max_bytes).decode("utf-8-sig")
