"""The shared state of a bridge's clients: sessions, bakes, the sink, and the folder of files."""

from __future__ import annotations

import hmac
import os
import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

from scene2hap.bridge.config import BridgeConfig
from scene2hap.bridge.hosted_session import HostedSession
from scene2hap.bridge.jobs import Jobs
from scene2hap.common import checks
from scene2hap.errors import BridgeError, UnknownSession


class Host:
    """The sessions and bakes of a listening bridge."""

    def __init__(self, config: BridgeConfig, *, owns_process: bool) -> None:
        self.config = config
        self.owns_process = owns_process
        self.jobs: Jobs = Jobs()
        self.udp_port: int | None = None
        # A user without a home has "~" for it, which is no path.
        of_server = [Path(__file__).parents[2], sys.prefix, sys.base_prefix, os.path.expanduser("~")]
        own = {*_absolute_paths([of_server, config.bake, config.session, config.sink])}
        # The longest first, since one may be below another.
        self._own_folders = sorted(map(Path, own), key=lambda folder: -len(folder.parts))
        self._sessions: dict[str, HostedSession] = {}
        self._plays_sink: HostedSession | None = None
        self._takes_sink = False

    async def close(self) -> None:
        """End all sessions and bakes."""
        for hosted in [*self._sessions.values()]:
            await hosted.close()
        await self.jobs.close()

    @property
    def sink_kind(self) -> str | None:
        """The kind of the server's sink, None if it has none."""
        spec = self.config.sink
        if isinstance(spec, dict):
            return str(spec.get("kind"))
        return spec if spec is None or isinstance(spec, str) else type(spec).__name__

    def below_root(self, path: str) -> Path:
        """Resolve a client's path. Raises: BridgeError: there is no root, or the path is outside it."""
        root = self.config.root
        if root is None:
            raise BridgeError("this bridge reads and writes no files; start it with --root FOLDER.")
        try:
            found = (root / path).resolve()
        except (OSError, ValueError, RuntimeError) as cause:  # a null byte, or a loop of links
            raise BridgeError(f"the path {checks.represented(path)} cannot be used.") from cause
        if found == root or not found.is_relative_to(root):
            raise BridgeError(
                f"the path {checks.represented(path)} is not below the bridge's root; give a path below it."
            )
        return found

    def as_told(self, message: str) -> str:
        """Return a message for clients. It names files as clients do, relative to the root, and not where they are.

        Files in folders of the server's settings, of Python and of the user are named without these folders. Other
        paths stay, since a client gave most of them.
        """
        named = {self.config.root: "the bridge's root", self.jobs.temporary: "a temporary folder of the bridge"}
        for folder, name in [*named.items(), *((one, "a folder of the bridge") for one in self._own_folders)]:
            # A root of / would be found everywhere. `repr` doubles each backslash of a path of Windows.
            if folder is None or folder == folder.parent:
                continue
            for spelled in {str(folder), repr(str(folder))[1:-1], folder.as_posix()}:
                here = rf"(?<![\w.-]){re.escape(spelled)}"  # not within another path, as /srv in /data/srv
                message = re.sub(rf"{here}[/\\]+", "", message)
                message = re.sub(rf"{here}(?![\w-]|\.\w)", name, message)
        return message

    def hosted(self, session_id: str) -> HostedSession:
        """Return a session by its id. Raises: UnknownSession: it has ended, or is ending."""
        found = self._sessions.get(session_id)
        if found is None or found.is_closed:
            raise UnknownSession(
                f"there is no session {checks.represented(session_id)}: it ended, or the bridge was restarted. Send "
                "`play` again."
            )
        return found

    def host(self, hosted: HostedSession, *, plays_sink: bool) -> None:
        """Register an open session."""
        self._sessions[hosted.id] = hosted
        if plays_sink:
            self._plays_sink, self._takes_sink = hosted, False

    def forget(self, hosted: HostedSession) -> None:
        """Unregister a closed session."""
        self._sessions.pop(hosted.id, None)
        if self._plays_sink is hosted:
            self._plays_sink = None

    async def take_sink(self) -> object:
        """Reserve the sink for a session. Returns None if the server has none.

        A session without a connected player is closed to free the sink.
        Raises: BridgeError: another session plays on it.
        """
        if self.config.sink is None:
            return None
        if self._plays_sink is not None and self._plays_sink.player is None:
            await self._plays_sink.close()
        if self._plays_sink is not None or self._takes_sink:
            raise BridgeError(
                'another session plays on the sink of this bridge; play with "use_sink": false, or watch that one.'
            )
        self._takes_sink = True
        return self.config.sink

    def give_sink_back(self) -> None:
        """Free the reserved sink, since its session could not be opened."""
        self._takes_sink = False

    def plays_sink(self, hosted: HostedSession) -> bool:
        """Return True if a session plays on the server's sink."""
        return self._plays_sink is hosted

    def with_key(self, key: bytes) -> HostedSession | None:
        """Return the session with a key, None if there is none."""
        return next((one for one in self._sessions.values() if hmac.compare_digest(one.key, key)), None)


def _absolute_paths(settings: object) -> Iterator[str]:
    """Yield the absolute paths among the values of nested settings."""
    if isinstance(settings, str | os.PathLike):
        if os.path.isabs(path := os.fspath(settings)):
            yield path
    elif isinstance(settings, Mapping | list | tuple):
        for one in settings.values() if isinstance(settings, Mapping) else settings:
            yield from _absolute_paths(one)
