"""Frames as datagrams, and gains to the address that they came from."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import cast

from scene2hap.bridge.hosted import HostedSession, error_message
from scene2hap.errors import Scene2HapError

KEY = slice(8, 16)
"""Where a frame carries the key of its session."""

Address = tuple[str, int]


class FrameDatagrams(asyncio.DatagramProtocol):
    """Takes frames for sessions. Datagrams without the key of one are dropped without an answer.

    Parameters: find : the session that has a key, None if none has.
    """

    def __init__(self, find: Callable[[bytes], HostedSession | None]) -> None:
        self._find = find
        self._transport: asyncio.DatagramTransport | None = None
        self._tasks: set[asyncio.Task[None]] = set()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Keep what answers are sent by."""
        self._transport = cast("asyncio.DatagramTransport", transport)

    def datagram_received(self, data: bytes, address: Address) -> None:
        """Take in one frame."""
        hosted = self._find(bytes(data[KEY]))
        if hosted is not None:
            task = asyncio.get_running_loop().create_task(self._take(hosted, bytes(data), address))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

    async def _take(self, hosted: HostedSession, data: bytes, address: Address) -> None:
        def reply(gains: bytes) -> None:
            if self._transport is not None and not self._transport.is_closing():
                self._transport.sendto(gains, address)

        try:
            await hosted.take(data, reply)
        except Scene2HapError as error:
            if hosted.player is not None:
                hosted.player.send(error_message(error))
