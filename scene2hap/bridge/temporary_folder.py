"""The temporary folder of a server, which is deleted when it ends, or later if it was killed.

A game may end its server by killing it, as all programs do on Windows. So a server deletes the folders that others left
behind. The lock of a folder tells whether its server still runs.
"""

from __future__ import annotations

import shutil
import tempfile
import time
from pathlib import Path

from filelock import FileLock, Timeout

_PREFIX, _LOCK = "scene2hap-bridge-", "in-use"
_NEW_S = 60.0
"""Age of a lock below which its server may not hold it yet [s]."""


class TemporaryFolder:
    """A new folder among the temporary files, held as long as this process lives. Raises: OSError."""

    def __init__(self) -> None:
        _delete_left_behind()
        self._folder = tempfile.TemporaryDirectory(prefix=_PREFIX, ignore_cleanup_errors=True)
        self.path: Path = Path(self._folder.name)
        self._lock = FileLock(self.path / _LOCK, thread_local=False)
        self._lock.acquire()

    def delete(self) -> None:
        """Delete the folder, or what the system lets go of it."""
        self._lock.release()
        self._folder.cleanup()


def _delete_left_behind() -> None:
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        lock = folder / _LOCK
        try:
            if folder.is_symlink() or time.time() - lock.stat().st_mtime < _NEW_S:
                continue
            with FileLock(lock, blocking=False):
                pass
        except (OSError, Timeout):  # another person's, or in use
            continue
        shutil.rmtree(folder, ignore_errors=True)
