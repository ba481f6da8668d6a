"""The server: who may connect, and which sessions there are."""

from __future__ import annotations

import asyncio
import hmac
import http
import json
import logging
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from scene2hap import __version__, checks
from scene2hap.bridge.config import BridgeConfig, is_loopback
from scene2hap.bridge.connection import Connection
from scene2hap.bridge.hosted import HostedSession, error_message
from scene2hap.bridge.jobs import Jobs
from scene2hap.bridge.messages import VERSION, Hello, parse_request, read_document
from scene2hap.bridge.udp import FrameDatagrams
from scene2hap.errors import BridgeError, ConfigError, MissingExtra, Scene2HapError, UnknownSession
from scene2hap.propagation import MODELS

try:
    from websockets.asyncio.server import ServerConnection, serve
    from websockets.exceptions import ConnectionClosed
    from websockets.http11 import Request, Response
except ImportError as cause:
    raise MissingExtra(
        "the bridge needs the extra `bridge`. Install it with: python -m pip install 'scene2hap[bridge]'"
    ) from cause

HELLO_WITHIN_S = 5.0
MAX_HELLO_BYTES = 4096
NO_HELLO, OTHER_VERSION, WRONG_TOKEN, TOO_MANY = 4000, 4001, 4003, 4009


class BridgeServer:
    """Serves clients until it is closed; use `async with server.listening():`.

    Parameters: config : a BridgeConfig, its settings, or the path of a file with a table `bridge`.
    Raises: ConfigError; MissingExtra: `websockets` is not installed.
    """

    def __init__(self, config: BridgeConfig | dict[str, Any] | str | None = None) -> None:
        self.config = BridgeConfig.parse(config)
        self.port = self.config.port
        self.udp_port: int | None = None
        self.connections: set[Connection] = set()
        self._n_clients = 0
        self._sessions: dict[str, HostedSession] = {}
        self._plays_sink: HostedSession | None = None
        self._takes_sink = False

    @asynccontextmanager
    async def listening(self) -> AsyncIterator[BridgeServer]:
        """Listen, and end everything afterwards. Raises: ConfigError: host or port cannot be used."""
        config = self.config
        self.jobs = Jobs()
        datagrams: asyncio.DatagramTransport | None = None
        try:
            listening = await serve(
                self._serve,
                config.host,
                config.port,
                process_request=self._refusal,
                compression=None,  # Numbers in frames are nearly random; it would cost more than it saves.
                max_size=config.max_message_bytes,
                open_timeout=HELLO_WITHIN_S,
                ping_interval=config.heartbeat_s,
                ping_timeout=2 * config.heartbeat_s,
                close_timeout=1.0,
                server_header=None,
                logger=logging.getLogger("scene2hap.bridge.websockets"),
            )
        except OSError as cause:
            raise ConfigError(
                f"host {config.host!r}, port {config.port} cannot be used: {cause.strerror}. Name others."
            ) from cause
        try:
            self.port = listening.sockets[0].getsockname()[1]
            if config.udp:
                datagrams = await self._open_udp()
            yield self
        finally:
            if datagrams is not None:
                datagrams.close()
            listening.close()
            await listening.wait_closed()
            for hosted in [*self._sessions.values()]:
                await hosted.close()
            await self.jobs.close()

    @property
    def url(self) -> str:
        """The address for clients."""
        host = f"[{self.config.host}]" if ":" in self.config.host else self.config.host
        return f"ws://{host}:{self.port}/"

    @property
    def sink_kind(self) -> str | None:
        """The kind of the server's sink, None if it has none."""
        spec = self.config.sink
        if isinstance(spec, dict):
            return str(spec.get("kind"))
        return spec if spec is None or isinstance(spec, str) else type(spec).__name__

    def below_root(self, path: str) -> Path:
        """A path of a client. Raises: BridgeError: there is no root, or the path leaves it."""
        root = self.config.root
        if root is None:
            raise BridgeError("this bridge reads and writes no files; start it with --root FOLDER.")
        try:
            found = (root / path).resolve()
        except (OSError, ValueError, RuntimeError) as cause:  # a null byte, or links that go round
            raise BridgeError(f"the path {checks.represented(path)} cannot be used.") from cause
        if found == root or not found.is_relative_to(root):
            raise BridgeError(
                f"the path {checks.represented(path)} is not below the bridge's root; give a path below it."
            )
        return found

    def hosted(self, session_id: str) -> HostedSession:
        """A session. Raises: UnknownSession."""
        if session_id not in self._sessions:
            raise UnknownSession(
                f"there is no session {checks.represented(session_id)}: it ended, or the bridge was restarted. Send "
                "`play` again."
            )
        return self._sessions[session_id]

    def host(self, hosted: HostedSession, *, plays_sink: bool) -> None:
        """Take in a session that was opened."""
        self._sessions[hosted.id] = hosted
        if plays_sink:
            self._plays_sink, self._takes_sink = hosted, False

    def forget(self, hosted: HostedSession) -> None:
        """Let a closed session go."""
        self._sessions.pop(hosted.id, None)
        if self._plays_sink is hosted:
            self._plays_sink = None

    async def take_sink(self) -> object:
        """What a session is to play on, None if the server has no sink; a session that waits for its player gives way.

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
        """Let others take the sink, since a session could not be opened."""
        self._takes_sink = False

    def plays_sink(self, hosted: HostedSession) -> bool:
        """Whether a session plays on the server's sink."""
        return self._plays_sink is hosted

    async def _open_udp(self) -> asyncio.DatagramTransport:
        loop = asyncio.get_running_loop()

        def find(key: bytes) -> HostedSession | None:
            return next((one for one in self._sessions.values() if hmac.compare_digest(one.key, key)), None)

        transport, _ = await loop.create_datagram_endpoint(
            lambda: FrameDatagrams(find), local_addr=(self.config.host, self.port)
        )
        self.udp_port = transport.get_extra_info("sockname")[1]
        return transport

    def _refusal(self, connection: ServerConnection, request: Request) -> Response | None:
        """The answer to a page that may not connect, None for all others."""
        for origin in request.headers.get_all("Origin"):
            if origin not in self.config.origins and not is_loopback(_host_of(origin)):
                text = f"The bridge admits no page of {checks.represented(origin)}. Start it with --origin to do so.\n"
                return connection.respond(http.HTTPStatus.FORBIDDEN, text)
        return None

    async def _serve(self, socket: ServerConnection) -> None:
        if self._n_clients >= self.config.max_clients:
            await socket.close(TOO_MANY, f"there are {self.config.max_clients} clients already")
            return
        self._n_clients += 1
        try:
            if await self._greeted(socket):
                connection = Connection(socket, self)
                self.connections.add(connection)
                try:
                    await connection.run()
                finally:
                    self.connections.discard(connection)
        except ConnectionClosed:
            pass
        finally:
            self._n_clients -= 1

    async def _greeted(self, socket: ServerConnection) -> bool:
        """Whether a client said hello as it must; else the connection is closed."""
        try:
            async with asyncio.timeout(HELLO_WITHIN_S):
                message = await socket.recv()
        except TimeoutError:
            await socket.close(NO_HELLO, f"no hello within {HELLO_WITHIN_S:g} s")
            return False
        if isinstance(message, bytes) or len(message) > MAX_HELLO_BYTES:
            await socket.close(NO_HELLO, f"the first message must be a hello of at most {MAX_HELLO_BYTES} bytes")
            return False
        try:
            document = read_document(message)
            # First, since another version may have other fields.
            if document.get("type") == "hello" and document.get("version") != VERSION:
                told = checks.represented(document.get("version"))
                wrong = BridgeError(f"version is {told}; this bridge speaks version {VERSION}. Use a client for it.")
                await _close_with(socket, wrong, OTHER_VERSION, f"this bridge speaks version {VERSION}")
                return False
            hello = parse_request(document)
        except Scene2HapError as error:
            await _close_with(socket, error, NO_HELLO, "the first message must be a hello")
            return False
        if not isinstance(hello, Hello):
            await socket.close(NO_HELLO, "the first message must be a hello")
            return False
        if not self._is_right(hello.token):
            wrong = BridgeError("the token is wrong or missing; use the one that the bridge was started with.")
            await _close_with(socket, wrong, WRONG_TOKEN, "wrong token")
            return False
        await socket.send(self._welcome(hello.id))
        return True

    def _is_right(self, token: str | None) -> bool:
        if self.config.token is None:
            return True
        return hmac.compare_digest((token or "").encode(), self.config.token.reveal().encode())

    def _welcome(self, re: int | None) -> str:
        document = {
            "type": "welcome",
            "version": VERSION,
            "server": f"scene2hap {__version__}",
            "max_message_bytes": self.config.max_message_bytes,
            "heartbeat_s": self.config.heartbeat_s,
            "sink": self.sink_kind,
            "udp_port": self.udp_port,
            "models": [*MODELS.kinds()],
        }
        return json.dumps(document if re is None else {**document, "re": re})


async def _close_with(socket: ServerConnection, error: Scene2HapError, code: int, reason: str) -> None:
    await socket.send(json.dumps(error_message(error)))
    await socket.close(code, reason)


def _host_of(origin: str) -> str:
    try:
        return urlsplit(origin).hostname or ""
    except ValueError:
        return ""
