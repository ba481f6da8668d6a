"""Files: reading of regular ones with a size limit, writing whole files or none, and renames that Windows delays.

Windows rejects the rename of a file or folder that another program has open. Virus scanners and indexers open each new
file, but only for a moment, and a session opens the files of a bundle while it reads them. So a rejected rename is
repeated for a short time.
"""

from __future__ import annotations

import errno
import os
import re
import stat
import sys
import time
import uuid
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO, Final

from scene2hap.errors import ACCESS_DENIED, SHARING_VIOLATION

Stamp = tuple[int, int, int]
"""File number, time of the last change [ns], and size [bytes]."""

PAUSES_S: Final = (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.3)
"""Pauses before each repetition of a rename [s]; assumed: together a second, as scanners need for some megabytes."""

MAX_BYTES = 1 << 24
"""Most bytes of one file; assumed: a hundred times the largest handwritten one, and parsed in seconds."""

LFS_ADVICE = "is a pointer of Git LFS in place of the file; run `git lfs pull` in its repository"

_LFS_POINTER = b"version https://git-lfs"
_LONGEST_NAME = 255
"""Most bytes of a file name, on all usual systems."""


def path_in_c(path: Path) -> str | bytes:
    """Return a path for a library in C, such as libsndfile: as bytes, since a name need not be text of the locale."""
    return str(path) if os.name == "nt" else os.fsencode(path)


def is_there(path: Path) -> bool:
    """Return True if a path exists. Raises: OSError, ValueError: that cannot be known, or nothing can have that name.

    `Path.exists` returns False there from Python 3.14 on, so that a file in a locked folder would be called missing.
    """
    try:
        path.stat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    return True


def file_stamp(path: Path) -> Stamp | None:
    """Return a stamp that changes whenever a file is written or replaced; None if there is no file."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    return found.st_ino, found.st_mtime_ns, found.st_size


def read_small(path: str | os.PathLike[str], max_bytes: int = MAX_BYTES) -> bytes:
    """Read a regular file. Pipes and devices are rejected, since they may have no end.

    Raises: OSError, ValueError: there is no such file, it is no regular file, or it is larger than `max_bytes`.
    """
    with opened_regular(path) as file:
        # A read of `max_bytes` would allocate as many, however small the file is.
        size = os.fstat(file.fileno()).st_size
        content = file.read(min(size, max_bytes) + 1)
        if size < len(content) <= max_bytes:  # it is being written, or the system does not know its size
            content += file.read(max_bytes + 1 - len(content))
        size = max(size, len(content))
    if len(content) > max_bytes:
        raise ValueError(f"it has {size} bytes; it must have at most {max_bytes}")
    return content


@contextmanager
def opened_regular(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """Open a regular file for reading. Raises: OSError, ValueError: there is no such file, or it is no regular file."""
    # O_NONBLOCK: opening a pipe would block. The open file is checked, since its path may have been replaced meanwhile.
    try:
        descriptor = os.open(Path(path), os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    except PermissionError:
        if Path(path).is_dir():  # Windows opens no folder, and gives no reason
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path)) from None
        raise
    with os.fdopen(descriptor, "rb") as file:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise ValueError("it is a folder, a pipe or a device; give a file")
        yield file


def read_small_text(path: str | os.PathLike[str]) -> str:
    """Read a regular file as UTF-8 text, with or without a byte-order mark. Raises: OSError, ValueError."""
    return read_small(path).decode("utf-8-sig")


def is_lfs_pointer(path: Path) -> bool:
    """Return True if a file is the text that a clone without Git LFS has in place of a large file. Raises: OSError."""
    with path.open("rb") as file:
        return file.read(len(_LFS_POINTER)) == _LFS_POINTER


def draft_path(path: Path, kind: str = "part") -> Path:
    """Return a new path in the same folder, with the same suffix, which `drafts_of` finds if it is a "part".

    Raises: OSError: there is a device or a pipe, such as /dev/null, which a file must not replace.
    """
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise OSError(errno.EEXIST, "it is a device or a pipe")
    return path.with_name(f"{_draft_stem(path)}{uuid.uuid4().hex}.{kind}{path.suffix}")


def require_place(path: Path) -> None:
    """Check before long work that a file can be written later. Folders above it may be missing; a writer makes them.

    Raises: OSError: a folder or a device is there, one above is no folder of yours, or a name is too long.
    """
    draft_path(path)
    if sys.platform == "win32" and len(path.name) > _LONGEST_NAME:  # it calls such a name absent
        raise OSError(errno.ENAMETOOLONG, os.strerror(errno.ENAMETOOLONG))
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    above = next((folder for folder in path.absolute().parents if folder.exists()), None)
    if above is None:
        raise FileNotFoundError(errno.ENOENT, f"there is no drive or share {path.absolute().anchor}")
    if not above.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), str(above))
    if not os.access(above, os.W_OK | os.X_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))


def drafts_of(path: Path) -> list[Path]:
    """Return the drafts of a file that exist. Raises: OSError."""
    ours = re.compile(re.escape(_draft_stem(path)) + "[0-9a-f]{32}" + re.escape(f".part{path.suffix}"))
    return [found for found in path.parent.iterdir() if ours.fullmatch(found.name)]


def _draft_stem(path: Path) -> str:
    name = os.fsencode(path.name)
    room = _LONGEST_NAME - len(os.fsencode(f"..{'0' * 32}.draft{path.suffix}"))
    return f".{name[: max(room, 0)].decode(errors='ignore') if len(name) > room else path.name}."


@contextmanager
def draft_of(path: Path) -> Iterator[Path]:
    """Yield a path in the same folder, with the same suffix, to write to. It replaces `path` when the block ends.

    If the block raises, the draft is removed, and an earlier file stays unchanged.
    Raises: OSError.
    """
    draft = draft_path(path)
    try:
        yield draft
        put_in_place(draft, path)
    except BaseException:
        with suppress(OSError):
            draft.unlink(missing_ok=True)
        raise


def put_in_place(draft: Path, path: Path) -> None:
    """Replace a file by its draft, whose content is on the disk before. Raises: OSError."""
    with draft.open("rb+") as file:
        os.fsync(file.fileno())
    replace(draft, path)


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file whole or not at all; see `draft_of`. Raises: OSError."""
    with draft_of(path) as draft:
        draft.write_bytes(content.encode() if isinstance(content, str) else content)


def rename(source: Path, target: Path) -> None:
    """Rename a file or a folder. Raises: OSError: as `Path.rename`, and on Windows if it stays open."""
    _repeated(lambda: source.rename(target), target)


def replace(source: Path, target: Path) -> None:
    """Rename a file, and replace the target. Raises: OSError: as `os.replace`, and on Windows if either stays open."""
    _repeated(lambda: os.replace(source, target), target)


def _repeated(attempt: Callable[[], object], target: Path) -> None:
    for pause_s in PAUSES_S:
        try:
            attempt()
        except OSError as cause:
            if not _may_be_open(cause, target):
                raise
            time.sleep(pause_s)
        else:
            return
    attempt()


def _may_be_open(cause: OSError, target: Path) -> bool:
    """Return True for the errors of Windows for an open file, or for a folder with one, which a pause may end."""
    code = getattr(cause, "winerror", None)
    if code == ACCESS_DENIED:
        try:
            return bool(target.stat().st_mode & stat.S_IWRITE)  # a write-protected target stays so
        except OSError:
            return True
    return code == SHARING_VIOLATION
