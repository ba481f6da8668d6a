"""Frames as datagrams. Gains are sent back to the address of each frame."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable
from typing import cast

from scene2hap.bridge.hosted_session import HostedSession, error_message
from scene2hap.errors import Scene2HapError

KEY = slice(8, 16)
"""Position of the session's key in a frame."""

_SIO_UDP_CONNRESET = 0x9800000C
"""Windows, <mswsock.h>: whether a closed port of a receiver fails the sender's next read."""

Address = tuple[str, int]


def ignore_closed_ports(descriptor: int) -> None:
    """Let a UDP socket read on after an answer to a client that has gone. Does nothing but on Windows.

    Windows fails the next read there, and asyncio then reads no frame of any client (github.com/python/cpython, issue
    127057).
    """
    if sys.platform != "win32":
        return
    import ctypes

    fails, n_returned = ctypes.c_int(0), ctypes.c_ulong()
    ctypes.windll.ws2_32.WSAIoctl(
        ctypes.c_size_t(descriptor),
        ctypes.c_ulong(_SIO_UDP_CONNRESET),
        ctypes.byref(fails),
        ctypes.sizeof(fails),
        None,
        0,
        ctypes.byref(n_returned),
        None,
        None,
    )


class FrameDatagrams(asyncio.DatagramProtocol):
    """Receive frames for sessions. Datagrams without a valid session key are dropped without an answer.

    Parameters: find : returns the session with a key, None if there is none.
    """

    def __init__(self, find: Callable[[bytes], HostedSession | None]) -> None:
        self._find = find
        self._transport: asyncio.DatagramTransport | None = None
        self._tasks: set[asyncio.Task[None]] = set()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Store the transport for answers."""
        self._transport = cast("asyncio.DatagramTransport", transport)

    def datagram_received(self, data: bytes, address: Address) -> None:
        """Process one frame."""
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
