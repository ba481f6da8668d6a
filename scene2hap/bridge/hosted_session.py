"""A session that clients play and watch."""

from __future__ import annotations

import asyncio
import hmac
import logging
import secrets
from collections import deque
from collections.abc import Callable
from typing import Any, Literal, ParamSpec, Protocol, TypeVar

from scene2hap.bridge.frames import Frame, decode_frame, encode_gains
from scene2hap.bridge.played_session import PlayedSession
from scene2hap.bridge.session_warnings import Tell, forwarding_warnings
from scene2hap.errors import BridgeError, Scene2HapError, UnknownSession

P = ParamSpec("P")
Result = TypeVar("Result")

_log = logging.getLogger("scene2hap.bridge")

N_REPEATED = 64
"""Most gains that are sent again after a lost connection, with frames "every"."""

Frames = Literal["newest", "every"]
Reply = Callable[[bytes], None]


class Receiver(Protocol):
    """The part of a client that a hosted session uses. Neither method waits."""

    def send(self, document: dict[str, Any]) -> None:
        """Send a JSON message."""
        ...

    def send_gains(self, message: bytes, *, must_arrive: bool) -> None:
        """Send gains. Without `must_arrive`, newer gains may replace them."""
        ...

    def give_up(self) -> None:
        """Stop playing, since the session continues over another connection."""
        ...


class HostedSession:
    """A session, its player, and its watchers.

    Call all methods on the event loop. The session does one thing at a time, in the order of the calls. Frames are
    processed on the loop itself, since an update takes less time than a change of threads. All other work runs on a
    thread, and so do frames of sessions that may wait for their model.

    Parameters: make : makes the played session, on a thread; frames : "newest" if a newer frame may replace a waiting
    one, else "every"; keep_s : how long the session is kept after its connection is lost [s]; ended : called when the
    session is closed.
    """

    def __init__(
        self,
        make: Callable[[Tell], PlayedSession],
        frames: Frames,
        keep_s: float,
        ended: Callable[[HostedSession], None],
    ) -> None:
        self.id: str = secrets.token_hex(8)
        self.key: bytes = secrets.token_bytes(8)
        self.frames: Frames = frames
        self._keep_s, self._ended = keep_s, ended
        self.player: Receiver | None = None
        self.watchers: set[Receiver] = set()
        self._make = make
        self._loop = asyncio.get_running_loop()
        self._is_free = asyncio.Lock()
        self._waits: Frame | None = None
        self._reply: Reply | None = None
        self._taking: asyncio.Task[None] | None = None
        self._forgetting: asyncio.TimerHandle | None = None
        self.is_closed: bool = False
        # Gains that a lost connection may have dropped.
        self.last_gains: deque[bytes] = deque(maxlen=N_REPEATED if frames == "every" else 1)

    async def open(self, player: Receiver) -> None:
        """Make the session. Raises: as HapticSession; DeviceError: its sink cannot be opened."""
        self.played: PlayedSession = await self._on_a_thread(lambda: self._make(self._tell))
        self.player = player

    async def run(self, work: Callable[P, Result], *args: P.args, **kwargs: P.kwargs) -> Result:
        """Run work on the session, after all frames that came before."""
        await self.settle()
        return await self._on_a_thread(lambda: work(*args, **kwargs))

    async def _on_a_thread(self, work: Callable[[], Result]) -> Result:
        async with self._is_free:
            return await asyncio.to_thread(forwarding_warnings, self._tell, work)

    async def settle(self) -> None:
        """Wait until all received frames are processed."""
        while self._taking is not None:
            await self._taking

    async def take(self, message: bytes, reply: Reply | None = None) -> None:
        """Process a frame. With frames "every", this waits until it is processed; with "newest" it returns at once.

        Parameters: reply : receives the gains, None to send them to the player. Raises: BridgeError: not a frame of
        this session.
        """
        if self.is_closed:
            return
        frame = decode_frame(message)
        if not hmac.compare_digest(frame.key, self.key):
            raise BridgeError("a frame carries another key than that of the session; copy it from `playing`.")
        if self._waits is not None:
            if frame.sequence <= self._waits.sequence:  # datagrams may overtake each other
                self.played.drop()
                return
            self.played.n_skipped += 1
            frame = frame.after(self._waits)
        self._waits, self._reply = frame, reply
        if self._taking is None:
            self._taking = self._loop.create_task(self._take_all())
        if self.frames == "every" and reply is None:
            await self.settle()

    async def _take_all(self) -> None:
        try:
            while self._waits is not None:
                try:
                    message, reply = await self._take_newest()
                except Exception as error:
                    self._tell_player(error_message(error))
                else:
                    if message is not None:
                        self.last_gains.append(message)
                        self._send_gains(message, reply)
                await asyncio.sleep(0)  # let the loop read newer messages before the next frame is processed
        finally:
            self._taking = None

    async def _take_newest(self) -> tuple[bytes | None, Reply | None]:
        async with self._is_free:
            frame, self._waits, reply = self._waits, None, self._reply
            assert frame is not None
            if self.played.may_wait:
                return await asyncio.to_thread(forwarding_warnings, self._tell, lambda: self._taken(frame)), reply
            return forwarding_warnings(self._tell, lambda: self._taken(frame)), reply

    def _taken(self, frame: Frame) -> bytes | None:
        gains = self.played.take(frame)
        return None if gains is None else encode_gains(gains)

    def _send_gains(self, message: bytes, reply: Reply | None = None) -> None:
        if reply is not None:
            reply(message)
        elif self.player is not None:
            self.player.send_gains(message, must_arrive=self.frames == "every")
        for one in self.watchers:
            one.send_gains(message, must_arrive=False)

    async def change_layout(self, work: Callable[[], object]) -> dict[str, Any]:
        """Add or remove objects or sources, and send all watchers the new layout. Returns the message to the player."""

        def changed() -> dict[str, Any]:
            work()
            self.played.use_layout()
            return self.played.order()

        order = await self.run(changed)
        for one in self.watchers:
            one.send({"type": "order", "session": self.id, **order})
        return {"type": "order", **order}

    async def lose(self, player: Receiver) -> None:
        """Pause after the player's connection is lost, and keep the session for `keep_s`."""
        if self.player is not player or self.is_closed:
            return
        self.player = None
        # Set the timer before any await, so that a client that resumes at once can cancel it.
        self._forgetting = self._loop.call_later(self._keep_s, lambda: self._loop.create_task(self._forget()))
        await self.run(self.played.session.pause)
        if self.player is None:
            self._tell_watchers({"type": "state", "session": self.id, "is": "waiting"})
            self._send_gains(encode_gains(self.played.silence()))

    async def resume(self, player: Receiver, key: str) -> dict[str, Any]:
        """Continue over another connection. Raises: UnknownSession: wrong key."""
        if not hmac.compare_digest(key.lower(), self.key.hex()):
            raise UnknownSession(f"session {self.id} has another key; send the one that `playing` gave.")
        if self._forgetting is not None:
            self._forgetting.cancel()
            self._forgetting = None
        if self.player is not None:  # its connection is lost, but this was not noticed yet
            self.player.give_up()
        self.player = player
        if not self.played.is_paused:
            await self.run(self.played.session.resume)
        self._tell_watchers({"type": "state", "session": self.id, "is": "playing"})
        return await self.run(self.played.order)

    async def _forget(self) -> None:
        if self.player is None:  # else it was resumed in the same step of the loop
            await self.close()

    async def close(self) -> None:
        """End the session."""
        if self.is_closed:
            return
        self.is_closed = True
        await self.settle()
        if self._forgetting is not None:
            self._forgetting.cancel()
        await self._on_a_thread(self.played.close)
        self._tell_watchers({"type": "state", "session": self.id, "is": "ended"})
        self._send_gains(encode_gains(self.played.silence()))
        self.watchers.clear()
        self._ended(self)

    def _tell(self, document: dict[str, Any]) -> None:
        """Send a message to all clients, from any thread."""
        self._loop.call_soon_threadsafe(self._tell_all, document)

    def _tell_all(self, document: dict[str, Any]) -> None:
        self._tell_player(document)
        self._tell_watchers(document)

    def _tell_player(self, document: dict[str, Any]) -> None:
        if self.player is not None:
            self.player.send(document)

    def _tell_watchers(self, document: dict[str, Any]) -> None:
        for one in self.watchers:
            one.send(document)


def error_message(error: Exception) -> dict[str, Any]:
    """Return the message to a client about an error. An unexpected one is only logged, since it may reveal secrets."""
    if isinstance(error, Scene2HapError):
        return {"type": "error", "error": type(error).__name__, "message": str(error)}
    _log.error("a fault of the bridge", exc_info=error)
    return {"type": "error", "error": "InternalError", "message": "the bridge failed at this; its log has the details."}
