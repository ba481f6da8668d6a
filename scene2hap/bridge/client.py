"""A client's session, and the queue of messages to it."""

from __future__ import annotations

import asyncio
import json
from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

from scene2hap.bridge.hosted_session import HostedSession
from scene2hap.bridge.pictures import SentPictures

MAX_WAITING = 1000
"""Most JSON messages that wait for a client; a client that reads more slowly is disconnected."""
MAX_GAINS_WAITING = 64
"""Most gains that wait for a client with frames "every". Beyond it, no more of its frames are read."""


class Client:
    """A client after its hello.

    Parameters: pictures : stores the pictures that it sends; as_told : returns the text of an error or of a warning as
    the client may read it. `is_too_slow` is set if too many messages wait.
    """

    def __init__(self, pictures: SentPictures, as_told: Callable[[str], str]) -> None:
        self._as_told = as_told
        self.hosted: HostedSession | None = None
        self.watched: HostedSession | None = None
        self.pictures = pictures
        self.is_too_slow: asyncio.Event = asyncio.Event()
        self._waiting: deque[str | bytes] = deque()
        self._gains: bytes | None = None
        self._repeated: tuple[bytes, ...] = ()
        self._n_gains_waiting = 0
        self._has_room, self._has_work = asyncio.Event(), asyncio.Event()
        self._has_room.set()

    @property
    def n_waiting(self) -> int:
        """Number of messages that wait to be sent."""
        return len(self._waiting)

    def send(self, document: dict[str, Any]) -> None:
        """Send a JSON message, in order."""
        if len(self._waiting) >= MAX_WAITING:
            self.is_too_slow.set()
            return
        if "message" in document:
            document = {**document, "message": self._as_told(document["message"])}
        self._waiting.append(json.dumps(document, allow_nan=False))
        self._has_work.set()

    def send_gains(self, message: bytes, *, must_arrive: bool) -> None:
        """Send gains. Without `must_arrive`, newer gains replace waiting ones."""
        if must_arrive:
            self._waiting.append(message)
            self._n_gains_waiting += 1
            if self._n_gains_waiting >= MAX_GAINS_WAITING:
                self._has_room.clear()
        else:
            self._gains = message
        self._has_work.set()

    def watch(self, hosted: HostedSession | None) -> None:
        """Watch a session, or none, in place of the one before."""
        if self.watched is not None:
            self.watched.watchers.discard(self)
            self._gains = None  # in the order of the other session, they would be read as those of this one
        self.watched = hosted
        if hosted is not None:
            hosted.watchers.add(self)

    def give_up(self) -> None:
        """Stop playing, since the session continues over another connection."""
        self.hosted = None

    def repeat(self, gains: Iterable[bytes]) -> None:
        """Schedule gains to be sent again after the next answer, since a lost connection may have dropped them."""
        self._repeated = tuple(gains)

    def answer(self, document: dict[str, Any]) -> None:
        """Send the answer to a request, and then the scheduled gains."""
        self.send(document)
        for gains in self._repeated:
            self.send_gains(gains, must_arrive=True)
        self._repeated = ()

    async def room(self) -> None:
        """Wait until the queue has space for the gains of another frame."""
        await self._has_room.wait()

    async def next(self) -> str | bytes:
        """Wait for the next message to send, and return it."""
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
