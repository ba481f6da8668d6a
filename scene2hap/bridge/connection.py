"""One connection: reads a client's messages, and sends answers and gains."""

from __future__ import annotations

import asyncio
import contextlib

from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

from scene2hap.bridge.client import Client
from scene2hap.bridge.frames import FRAME, PICTURE, kind_of
from scene2hap.bridge.host import Host
from scene2hap.bridge.hosted_session import error_message
from scene2hap.bridge.messages import parse_request, read_document, request_id
from scene2hap.bridge.pictures import SentPictures
from scene2hap.bridge.requests import answer
from scene2hap.errors import BridgeError

TOO_SLOW, SILENT = 4008, 1011


class Connection:
    """The connection of a client after its hello."""

    def __init__(self, socket: ServerConnection, host: Host) -> None:
        self._socket, self._host = socket, host
        self.loop: asyncio.AbstractEventLoop = asyncio.get_running_loop()
        self.client: Client = Client(SentPictures(lambda: host.jobs.folder), host.as_told)
        self._n_taken, self._is_taking = 0, False

    async def run(self) -> None:
        """Serve the client until its connection ends."""
        helpers = [
            asyncio.create_task(work) for work in (self._send_all(), self._close_if_slow(), self._close_if_silent())
        ]
        try:
            with contextlib.suppress(ConnectionClosed):
                async for message in self._socket:
                    await self.client.room()
                    self._is_taking = True
                    await self._take(message)
                    self._is_taking = False
                    self._n_taken += 1
        finally:
            for one in helpers:
                one.cancel()
            await asyncio.gather(*helpers, return_exceptions=True)
            await self._leave()

    def abort(self) -> None:
        """Cut the connection without a closing message, like a network failure."""
        self._socket.transport.abort()

    async def _send_all(self) -> None:
        while True:
            message = await self.client.next()
            # After the connection ends, the queue is still emptied: the reader may wait for room in it.
            with contextlib.suppress(ConnectionClosed):
                await self._socket.send(message)

    async def _close_if_slow(self) -> None:
        await self.client.is_too_slow.wait()
        await self._socket.close(TOO_SLOW, "the client reads too slowly")

    async def _close_if_silent(self) -> None:
        heartbeat_s = self._host.config.heartbeat_s
        with contextlib.suppress(ConnectionClosed):
            while True:
                await asyncio.sleep(heartbeat_s)
                n_taken = self._n_taken
                try:
                    async with asyncio.timeout(2 * heartbeat_s):
                        await (await self._socket.ping())
                except TimeoutError:
                    # A pong is read after all messages before it, so a client whose messages still wait is alive.
                    if n_taken == self._n_taken and not self._is_taking:
                        await self._socket.close(SILENT, f"no answer to a ping within {2 * heartbeat_s:g} s")

    async def _take(self, message: str | bytes) -> None:
        re: int | None = None
        try:
            if isinstance(message, bytes):
                await self._take_binary(message)
                return
            document = read_document(message)
            re = request_id(document)
            found = await answer(parse_request(document), self.client, self._host)
        except Exception as error:
            found = error_message(error)
        self.client.answer(found if re is None else {**found, "re": re})

    async def _take_binary(self, message: bytes) -> None:
        kind, hosted = kind_of(message), self.client.hosted
        if kind == FRAME:
            if hosted is None:
                raise BridgeError("a frame came without a session; send `play` first.")
            await hosted.take(message)
        elif kind == PICTURE:
            self.client.pictures.take(message)
        else:
            raise BridgeError(f"a binary message is of kind {kind}; clients send kind 1 (frame) and 3 (picture).")

    async def _leave(self) -> None:
        client = self.client
        client.watch(None)
        if client.hosted is not None:
            await client.hosted.lose(client)
        client.pictures.clear()
