"""A client as sessions and answers see it: what it plays or watches, and what waits to be sent to it."""

from __future__ import annotations

import asyncio
import json
from collections import deque
from collections.abc import Iterable
from typing import Any

from scene2hap.bridge.hosted import HostedSession
from scene2hap.bridge.pictures import SentPictures

MAX_WAITING = 1000
"""JSON messages that wait for a client which does not read."""
MAX_GAINS_WAITING = 64
"""Gains that wait for a client of which every frame is answered; then no more of its frames are read."""


class Client:
    """A client that said hello.

    Parameters: pictures : keeps those that it sends. `is_too_slow` is set once too many messages wait.
    """

    def __init__(self, pictures: SentPictures) -> None:
        self.hosted: HostedSession | None = None
        self.watched: HostedSession | None = None
        self.pictures = pictures
        self.is_too_slow = asyncio.Event()
        self._waiting: deque[str | bytes] = deque()
        self._gains: bytes | None = None
        self._repeated: tuple[bytes, ...] = ()
        self._n_gains_waiting = 0
        self._has_room, self._has_work = asyncio.Event(), asyncio.Event()
        self._has_room.set()

    @property
    def n_waiting(self) -> int:
        """Messages that wait to be sent."""
        return len(self._waiting)

    def send(self, document: dict[str, Any]) -> None:
        """Send a JSON message, in order."""
        if len(self._waiting) >= MAX_WAITING:
            self.is_too_slow.set()
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

    def give_up(self) -> None:
        """Play no longer, since the session goes on over another connection."""
        self.hosted = None

    def repeat(self, gains: Iterable[bytes]) -> None:
        """Send gains again behind the answer that is under way: those that a lost connection may have swallowed."""
        self._repeated = tuple(gains)

    def answer(self, document: dict[str, Any]) -> None:
        """Send the answer to a request, and what is to follow it."""
        self.send(document)
        for gains in self._repeated:
            self.send_gains(gains, must_arrive=True)
        self._repeated = ()

    async def room(self) -> None:
        """Wait until another frame may be answered."""
        await self._has_room.wait()

    async def next(self) -> str | bytes:
        """Wait for the next message to send."""
        while not self._waiting and self._gains is None:
            self._has_work.clear()
            await self._has_work.wait()
        if not self._waiting:
            gains, self._gains = self._gains, None
            assert gains is not None
            return gains
        message = self._waiting.popleft()
        if isinstance(message, bytes):
            self._n_gains_waiting -= 1
            self._has_room.set()
        return message
