"""One client: its messages in, answers and gains out."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections import deque
from typing import TYPE_CHECKING, Any

from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

from scene2hap.bridge.answers import answer
from scene2hap.bridge.frames import FRAME, PICTURE, kind_of
from scene2hap.bridge.hosted import HostedSession, error_message
from scene2hap.bridge.messages import parse_request, read_document, request_id
from scene2hap.bridge.pictures import SentPictures
from scene2hap.errors import BridgeError, Scene2HapError

if TYPE_CHECKING:
    from scene2hap.bridge.server import BridgeServer

MAX_WAITING = 1000
"""JSON messages that wait for a client which does not read."""
MAX_GAINS_WAITING = 64
"""Gains that wait for a client of which every frame is answered; then no more of its frames are read."""
TOO_SLOW = 4008


class Connection:
    """A client that said hello.

    Parameters: socket : its WebSocket; server : answers its requests.
    """

    def __init__(self, socket: ServerConnection, server: BridgeServer) -> None:
        self._socket, self._server = socket, server
        self.loop = asyncio.get_running_loop()
        self._waiting: deque[str | bytes] = deque()
        self._gains: bytes | None = None
        self._n_gains_waiting = 0
        self._has_room, self._has_work = asyncio.Event(), asyncio.Event()
        self._has_room.set()
        self._repeated: bytes | None = None
        self.hosted: HostedSession | None = None
        self.watched: HostedSession | None = None
        self.pictures = SentPictures(server.jobs.folder)

    async def run(self) -> None:
        """Serve the client until its connection ends."""
        sending = asyncio.create_task(self._send_all())
        try:
            async for message in self._socket:
                await self._take(message)
        except ConnectionClosed:
            pass
        finally:
            sending.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await sending
            await self._leave_all()

    def send(self, document: dict[str, Any]) -> None:
        """Send a JSON message, in order."""
        if len(self._waiting) >= MAX_WAITING:
            asyncio.create_task(self._socket.close(TOO_SLOW, "the client reads too slowly"))  # noqa: RUF006
            return
        self._waiting.append(json.dumps(document, allow_nan=False))
        self._has_work.set()

    def send_gains(self, message: bytes, *, must_arrive: bool) -> None:
        """Send gains; without `must_arrive`, newer ones replace those that still wait."""
        if must_arrive:
            self._waiting.append(message)
            self._n_gains_waiting += 1
            if self._n_gains_waiting >= MAX_GAINS_WAITING:
                self._has_room.clear()
        else:
            self._gains = message
        self._has_work.set()

    def repeat(self, gains: bytes | None) -> None:
        """Send gains again behind the answer that is under way: those that a lost connection may have swallowed."""
        self._repeated = gains

    def abort(self) -> None:
        """Cut the connection without a word, as a network that fails."""
        self._socket.transport.abort()

    async def _send_all(self) -> None:
        with contextlib.suppress(ConnectionClosed):
            while True:
                await self._has_work.wait()
                self._has_work.clear()
                while self._waiting or self._gains is not None:
                    await self._socket.send(self._next())

    def _next(self) -> str | bytes:
        if self._waiting:
            message = self._waiting.popleft()
            if isinstance(message, bytes):
                self._n_gains_waiting -= 1
                self._has_room.set()
            return message
        gains, self._gains = self._gains, None
        assert gains is not None
        return gains

    async def _take(self, message: str | bytes) -> None:
        if isinstance(message, bytes):
            try:
                await self._take_binary(message)
            except Scene2HapError as error:
                self.send(error_message(error))
            return
        re: int | None = None
        try:
            document = read_document(message)
            re = request_id(document)
            found = await answer(parse_request(document), self, self._server)
        except Scene2HapError as error:
            found = error_message(error)
        self.send(found if re is None else {**found, "re": re})
        if self._repeated is not None:
            self.send_gains(self._repeated, must_arrive=True)
            self._repeated = None

    async def _take_binary(self, message: bytes) -> None:
        kind = kind_of(message)
        if kind == FRAME:
            if self.hosted is None:
                raise BridgeError("a frame came without a session; send `play` first.")
            await self._has_room.wait()
            await self.hosted.take(message)
        elif kind == PICTURE:
            self.pictures.take(message)
        else:
            raise BridgeError(f"a binary message is of kind {kind}; clients send kind 1 (frame) and 3 (picture).")

    async def _leave_all(self) -> None:
        if self.watched is not None:
            self.watched.watchers.discard(self)
        if self.hosted is not None:
            await self.hosted.lose(self)
        self.pictures.clear()
