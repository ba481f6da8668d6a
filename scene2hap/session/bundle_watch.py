"""Reload a bundle from the disk while a session plays it: a designer's changes are felt within a second."""

from __future__ import annotations

import os
from collections import deque
from functools import partial
from pathlib import Path
from threading import Event
from types import TracebackType
from typing import Self

from scene2hap.bundle import HapticBundle
from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.common.files import Stamp, file_stamp
from scene2hap.common.printable import quoted
from scene2hap.common.worker_threads import start_worker
from scene2hap.errors import BundleError, Scene2HapError
from scene2hap.session import HapticSession

POLL_S = 0.05
"""Interval between checks of the folder [s]. A saved bundle is read at once. Files edited by hand are read after they
have stayed unchanged for one interval."""


@clear_calls
class BundleWatch:
    """Pass a bundle to a session whenever its folder is written again.

    A worker checks the folder and reads it. `update`, called in the game loop, passes a new bundle to the session.
    Files that are edited by hand are reloaded too. `problem` is the reason why the present folder cannot be loaded, ""
    if it can; while there is a problem, the session plays the last bundle that was read.

    Parameters: session : plays the bundle; folder : where it was saved.
    Raises: BundleError: the folder does not exist.
    """

    def __init__(self, session: HapticSession, folder: str | os.PathLike[str]) -> None:
        self.problem: str = ""
        self._session, self._folder = session, checks.path("folder", folder, error=BundleError)
        if not os.path.isdir(self._folder):
            raise BundleError(f"there is no folder {quoted(self._folder)} to watch; `bake` and `save` write one.")
        # A deque, since the worker may publish a bundle at any step of `update`.
        self._read: deque[HapticBundle] = deque(maxlen=1)
        self._closed = Event()
        self._worker = start_worker(partial(self._watch, self._stamps()), "watch", self._closed.set)

    def update(self) -> bool:
        """Pass a newly read bundle to the session. Returns True if there was one.

        Raises: BundleError: it is of another scene.
        """
        if not self._read:
            return False
        self._session.use_bundle(self._read.pop())
        return True

    def close(self) -> None:
        """End the worker. May be called twice."""
        self._closed.set()
        self._worker.join()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _watch(self, known: frozenset[tuple[str, Stamp]]) -> None:
        last, last_folder = known, file_stamp(self._folder)
        while not self._closed.wait(POLL_S):
            folder, now = file_stamp(self._folder), self._stamps()
            is_saved = folder is not None and last_folder is not None and folder[0] != last_folder[0]  # replaced
            if now != known and (is_saved or now == last):
                known = now
                self._load()
            last, last_folder = now, folder

    def _load(self) -> None:
        try:
            self._read.append(HapticBundle.load(self._folder))
            self.problem = ""
        except Scene2HapError as error:
            self.problem = str(error)

    def _stamps(self) -> frozenset[tuple[str, Stamp]]:
        # `walk` leaves out a folder that is gone by now, as while a bundle is replaced; `rglob` would raise.
        paths = (Path(above, name) for above, folders, files in os.walk(self._folder) for name in (*folders, *files))
        found = ((str(path), file_stamp(path)) for path in paths)
        return frozenset((name, stamp) for name, stamp in found if stamp is not None)
