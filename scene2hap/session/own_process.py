"""The process of a session. A fork copies no threads, and shares the sink's file or device with the parent."""

from __future__ import annotations

import os

from scene2hap.errors import SessionError


class OwnProcess:
    """The process in which a session was made."""

    __slots__ = ("_pid",)

    def __init__(self) -> None:
        self._pid = os.getpid()

    @property
    def is_here(self) -> bool:
        """Whether this is the process, and not a fork of it."""
        return os.getpid() == self._pid

    def require(self) -> None:
        """Raises: SessionError: this is a fork of the process."""
        if not self.is_here:
            raise SessionError(
                f"this session was made in process {self._pid}, and this is its fork {os.getpid()}, which has no "
                "copy of the session's threads. Make another session here, of its bundle, or start processes by "
                "multiprocessing.get_context('spawn') and make the session there."
            )
