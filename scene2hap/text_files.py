"""Files of text: read if they are files and not too large, written whole or not at all."""

from __future__ import annotations

import os
import stat
import uuid
from contextlib import suppress
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


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file that takes its place once it is on the disk; an earlier one stays where that fails.

    Raises: OSError.
    """
    beside = path.with_name(f".{path.name}.{uuid.uuid4().hex}.part")
    try:
        with beside.open("wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    except BaseException:
        with suppress(OSError):
            beside.unlink(missing_ok=True)
        raise
