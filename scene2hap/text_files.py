"""Files: reading of regular ones with a size limit, and writing whole files or none."""

from __future__ import annotations

import os
import stat
import uuid
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

MAX_BYTES = 1 << 24
"""Most bytes of one file; assumed: a hundred times the largest handwritten one, and parsed in seconds."""


def read_small(path: str | os.PathLike[str], max_bytes: int = MAX_BYTES) -> bytes:
    """Read a regular file. Pipes and devices are rejected, since they may have no end.

    Raises: OSError, ValueError: there is no such file, it is no regular file, or it is larger than `max_bytes`.
    """
    # O_NONBLOCK: opening a pipe would block. The open file is checked, since its path may have been replaced meanwhile.
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
    """Read a regular file as UTF-8 text, with or without a byte-order mark. Raises: OSError, ValueError."""
    return read_small(path, max_bytes).decode("utf-8-sig")


@contextmanager
def draft_of(path: Path) -> Iterator[Path]:
    """Yield a path in the same folder, with the same suffix, to write to. It replaces `path` when the block ends.

    If the block raises, the draft is removed, and an earlier file stays unchanged.
    Raises: OSError.
    """
    draft = path.with_name(f".{path.name}.{uuid.uuid4().hex}.part{path.suffix}")
    try:
        yield draft
        with draft.open("rb+") as file:
            os.fsync(file.fileno())
        os.replace(draft, path)
    except BaseException:
        with suppress(OSError):
            draft.unlink(missing_ok=True)
        raise


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file whole or not at all; see `draft_of`. Raises: OSError."""
    with draft_of(path) as draft:
        draft.write_bytes(content.encode() if isinstance(content, str) else content)
