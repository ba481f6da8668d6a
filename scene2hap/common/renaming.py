"""Renames of files and folders that another program may have open.

Windows then rejects the rename. Virus scanners and indexers open each new file, but only for a moment, and a session
opens the files of a bundle while it reads them. So a rejected rename is repeated for a short time.
"""

from __future__ import annotations

import os
import stat
import time
from collections.abc import Callable
from pathlib import Path
from typing import Final

from scene2hap.errors import ACCESS_DENIED, SHARING_VIOLATION

PAUSES_S: Final = (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.3)
"""Pauses before each repetition [s]; assumed: together a second, as scanners need for a file of a few megabytes."""


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
