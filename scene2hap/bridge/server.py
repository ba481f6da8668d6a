"""The server: accepts connections and checks their hello."""

from __future__ import annotations

import asyncio
import hmac
import http
import json
import logging
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any
from urllib.parse import urlsplit

from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from scene2hap import __version__
from scene2hap.bridge.config import BridgeConfig, is_loopback
from scene2hap.bridge.connection import Connection
from scene2hap.bridge.host import Host
from scene2hap.bridge.hosted_session import error_message
from scene2hap.bridge.messages import VERSION, Hello, parse_request, read_document
from scene2hap.bridge.udp import FrameDatagrams, ignore_closed_ports
from scene2hap.common import checks
from scene2hap.errors import BridgeError, ConfigError, Scene2HapError
from scene2hap.propagation import MODELS

HELLO_WITHIN_S = 5.0
MAX_HELLO_BYTES = 4096
NO_HELLO, OTHER_VERSION, WRONG_TOKEN, TOO_MANY = 4000, 4001, 4003, 4009


class BridgeServer:
    """Serve clients until it is closed; use `async with server.listening():`.

    Parameters: config : a BridgeConfig, its settings, or the path of a file with a table `bridge`; owns_process :
    True if the process runs only the bridge, which may then control its garbage collector.
    Raises: ConfigError; MissingExtra: `websockets` is not installed.
    """

    def __init__(
        self, config: BridgeConfig | dict[str, Any] | str | None = None, *, owns_process: bool = False
    ) -> None:
        self.config: BridgeConfig = BridgeConfig.parse(config)
        self._owns_process = owns_process
        self.port: int = self.config.port
        self.connections: set[Connection] = set()
        self._n_clients = 0

    @asynccontextmanager
    async def listening(self) -> AsyncIterator[BridgeServer]:
        """Listen, and afterwards end all sessions and bakes. Raises: ConfigError: host or port cannot be used."""
        config = self.config
        self.host: Host = Host(config, owns_process=self._owns_process)
        datagrams: asyncio.DatagramTransport | None = None
        try:
            listening = await serve(
                self._serve,
                config.host,
                config.port,
                process_request=self._refusal,
                compression=None,  # numbers in frames are nearly random, so compression costs more than it saves
                max_size=config.max_message_bytes,
                open_timeout=HELLO_WITHIN_S,
                ping_interval=None,  # `Connection` sends pings; this one would close connections with a backlog
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
            await self.host.close()

    @property
    def url(self) -> str:
        """The address for clients."""
        host = f"[{self.config.host}]" if ":" in self.config.host else self.config.host
        return f"ws://{host}:{self.port}/"

    async def _open_udp(self) -> asyncio.DatagramTransport:
        loop = asyncio.get_running_loop()
        transport, _ = await loop.create_datagram_endpoint(
            lambda: FrameDatagrams(self.host.with_key), local_addr=(self.config.host, self.port)
        )
        ignore_closed_ports(transport.get_extra_info("socket").fileno())
        self.host.udp_port = transport.get_extra_info("sockname")[1]
        return transport

    def _refusal(self, connection: ServerConnection, request: Request) -> Response | None:
        """Return the refusal of a web page that may not connect, None for all others."""
        for origin in request.headers.get_all("Origin"):
            if origin not in self.config.origins and not is_loopback(_host_of(origin)):
                text = f"The bridge admits no page of {checks.represented(origin)}. Start it with --origin to do so.\n"
                return connection.respond(http.HTTPStatus.FORBIDDEN, text)
        return None

    async def _serve(self, socket: ServerConnection) -> None:
        checks.speak_json()  # to this client alone: each connection has a task of its own
        if self._n_clients >= self.config.max_clients:
            await socket.close(TOO_MANY, f"there are {self.config.max_clients} clients already")
            return
        self._n_clients += 1
        try:
            if await self._greeted(socket):
                connection = Connection(socket, self.host)
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
        """Receive and check a client's hello. Returns False if it is wrong, after closing the connection."""
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
            # Check the version first, since another version may have other fields.
            if document.get("type") == "hello" and document.get("version") != VERSION:
                version = checks.represented(document.get("version"))
                wrong = BridgeError(f"version is {version}; this bridge speaks version {VERSION}. Use a client for it.")
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
            "sink": self.host.sink_kind,
            "udp_port": self.host.udp_port,
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
