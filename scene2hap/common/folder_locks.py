"""Locks on folders. The system releases them when a process dies, so that its unfinished files are known as such."""

from __future__ import annotations

import os
import sys
import time
from contextlib import ExitStack, suppress
from pathlib import Path

if sys.platform != "win32":
    import fcntl

    def _release(descriptor: int) -> None:
        # A child that was forked meanwhile has the descriptor, too, and would hold the lock until it ends.
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_UN)
        os.close(descriptor)


ABANDONED_S = 86400.0
"""Age after which a draft counts as abandoned if folders cannot be locked [s]; assumed: writing takes seconds."""


def lock_folder(folder: Path, held: ExitStack, *, wait: bool = False, shared: bool = False) -> bool | None:
    """Lock a folder until `held` is closed or the process dies. Holders of a shared lock exclude others' whole locks.

    Returns False if another process has the lock, or the folder is gone; None if the system has no locks for folders.
    """
    try:
        if sys.platform != "win32":
            descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
            held.callback(_release, descriptor)
            kind = fcntl.LOCK_SH if shared else fcntl.LOCK_EX
            fcntl.flock(descriptor, kind | (0 if wait else fcntl.LOCK_NB))
            return os.path.samestat(os.fstat(descriptor), os.stat(folder))
        # Windows has no lock for folders.
        return None if os.path.lexists(folder) else False
    except (BlockingIOError, FileNotFoundError, NotADirectoryError):
        return False
    except OSError:  # a file system without locks, or a folder that cannot be read
        return None


def is_old(path: Path) -> bool:
    """Return True if a draft is older than `ABANDONED_S`. For systems without locks."""
    with suppress(OSError):
        return path.stat().st_mtime < time.time() - ABANDONED_S
    return False
