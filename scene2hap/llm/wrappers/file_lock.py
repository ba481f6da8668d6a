"""FileLock: one holder at a time among processes that share a folder."""

from __future__ import annotations

import json
import os
import socket
import time
import uuid
from collections.abc import Awaitable, Callable
from pathlib import Path
from types import TracebackType

from scene2hap.errors import ConfigError

POLL_S = 0.1
"""Assumed: far below the seconds that an answer takes."""
UNWRITTEN_S = 5.0
"""How long a lock may be empty before its process is taken to have died between making and writing it; assumed."""


class FileLock:
    """Holds a file that only one can create (O_EXCL), and waits while another holds it.

    A lock is abandoned, and taken over, where its process has died on this machine or where it is older than
    `stale_after_s` [s]. Should two waiters find that out in the same moment, both may go on: what the lock guards must
    stay whole then, and be merely done twice.
    """

    def __init__(self, path: Path, stale_after_s: float, sleep: Callable[[float], Awaitable[object]]) -> None:
        self._path = path
        self._stale_after_s = stale_after_s
        self._sleep = sleep
        self._mine = json.dumps({"host": socket.gethostname(), "pid": os.getpid(), "id": uuid.uuid4().hex}).encode()

    async def __aenter__(self) -> FileLock:
        while not self._create():
            if self._abandoned():
                self._path.unlink(missing_ok=True)
            else:
                await self._sleep(POLL_S)
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if self._path.read_bytes() == self._mine:
                self._path.unlink()
        except FileNotFoundError:
            pass  # taken for abandoned, and released since

    def _create(self) -> bool:
        try:
            descriptor = os.open(self._path, os.O_CREAT | os.O_EXCL | os.O_WRONLY)
        except FileExistsError:
            return False
        except OSError as cause:
            raise ConfigError(f"cannot lock {self._path}: {cause}. Give a folder that can be written.") from cause
        with os.fdopen(descriptor, "wb") as file:
            file.write(self._mine)
        return True

    def _abandoned(self) -> bool:
        try:
            age_s = time.time() - self._path.stat().st_mtime
            content = self._path.read_bytes()
        except FileNotFoundError:
            return False
        return age_s > self._stale_after_s or _is_dead(content) or (not content and age_s > UNWRITTEN_S)


def _is_dead(content: bytes) -> bool:
    """Whether the holder was a process of this machine that is no more."""
    if os.name != "posix":
        return False  # there os.kill would end what it asks after
    try:
        holder = json.loads(content)
        if holder["host"] != socket.gethostname():
            return False
        os.kill(int(holder["pid"]), 0)
    except ProcessLookupError:
        return True
    except (OSError, OverflowError, ValueError, TypeError, KeyError):
        return False  # somebody else's process, or a lock that is being written
    return False
