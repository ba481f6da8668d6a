"""Sinks with a device: a thread that requests the mix at the device's rate, and reconnects after failures.

A device is a `Line`: five methods, about a page of code for a sound card, a serial port or a socket. `LiveSink` does
the rest. A failure of the device is a state, not an exception. The thread reports a `SinkEvent` and continues to
request the mix by the wall clock. It drops these samples, so that the session's clock, ramps and queues never stop. It
tries again after 0.1 s, 0.2 s, ... 2 s, and fades in over 50 ms when the device is back. It also fades in after a pause
of the program in which the device ran out of samples.

    unavailable ─┬─► connected ─┬─► stalled ─► resumed        (the kinds of SinkEvent)
       ▲         │              └─► lost ─┐
       └─────────┴────────────────────────┘
"""

from __future__ import annotations

import atexit
import math
import threading
import time
from collections.abc import Callable, Hashable
from typing import Protocol, Self

import numpy as np

from scene2hap.common.calls import not_pickled
from scene2hap.common.checks import represented
from scene2hap.devices.due_frames import FrameClock
from scene2hap.devices.exclusive_use import claim, give_back
from scene2hap.devices.protocol import Block, EventCallback, EventKind, Fill, SinkEvent, SinkFormat, SinkStats
from scene2hap.devices.rate import RateConverter
from scene2hap.errors import ConfigError, DeviceError, DeviceTimeout

FADE_S = 0.05
"""Length of the fade-in after each connection and silence [s]; a shorter one would be felt as a knock."""

POLL_S = 0.005
"""Longest wait inside a line [s], and so the longest time for `stop`."""

STALL_S = 0.5
"""Time without requests after which a device is reported as stalled, and the mix continues without it [s].

Before that the mix waits, so that a short stall loses no sample. On a busy machine a pseudo-terminal stalled for 0.3 s.
"""

GIVE_UP_S = 1.5
"""Time without requests after which a device is closed and opened again [s]."""

FIRST_RETRY_S, LAST_RETRY_S = 0.1, 2.0
"""Pause between attempts [s]. It doubles after each attempt until the device has played."""

ENDING_S = 0.1
"""Longest time for which `stop` waits until the device has taken the end of the mix [s]."""

_FAIR_S = 4 * POLL_S
_IDLE_BLOCK_S = 0.02
_JOIN_S = 5.0

CarryOn = Callable[[], bool]
"""Callback that a waiting line calls every few milliseconds. False means that the sink is being stopped: the line must
return."""


class Line(Protocol):
    """Connection to one device. All methods are called on the sink's thread and may raise DeviceError at any time.

    Any thread may read `underruns` and `latency_s` (None if unknown) for `stats`. Two attributes are optional, and are
    read after `connect`. `remark` is a sentence on the present connection, which the message of the event "connected"
    includes. `silent_after_s` is the time without samples after which the device is silent [s]; samples after it fade
    in. Without it the line fades in by itself. An optional method `check_format(format)`, called by the sink's `open`,
    raises a DeviceError for a format that the device can never play, such as more hands than a frame holds: an error
    of `connect` is tried again for ever.
    """

    @property
    def underruns(self) -> int:
        """Number of times that the device ran out of samples, since the line was made."""
        ...

    @property
    def latency_s(self) -> float | None:
        """Time from taking a sample to playing it [s]."""
        ...

    def connect(self, format: SinkFormat, carry_on: CarryOn, /) -> int:
        """Connect to the device. Returns the sample rate [Hz] at which it plays."""
        ...

    def wanted(self, timeout_s: float, /) -> int:
        """Return the number of frames that the device takes now, 0 for none. Waits at most `timeout_s` for a
        request."""
        ...

    def send(self, block: Block, /) -> None:
        """Pass the requested number of frames to the device."""
        ...

    def disconnect(self) -> None:
        """Silence the device if it is present, and release it. Never raises; may be called twice."""
        ...


@not_pickled(DeviceError, "it has a thread and a device")
class LiveSink:
    """An ActuatorSink on a `Line`.

    `open`, `start` and `stats` return at once, in any state of the device. `stop` waits a few milliseconds for the
    thread; if the device has another rate, also until it has taken the end of the mix, `ENDING_S` at most. Errors of
    the device are events; only wrong use of the sink raises.
    Parameters: line : connection to the device; name : its name in events; on_event : an EventCallback or None, may be
        set at any time; key : identifies a device that serves one sink at a time, None for any number.
    Raises: ConfigError: `on_event` cannot be called.
    """

    def __init__(self, line: Line, name: str, *, on_event: EventCallback | None = None, key: Hashable = None) -> None:
        if not (on_event is None or callable(on_event)):
            raise ConfigError(f"on_event is {represented(on_event)}; it must be a function of one SinkEvent, or None.")
        self.on_event = on_event
        self._key = key
        self._line = line
        self._name = name
        self._format: SinkFormat | None = None
        self._fill: Fill | None = None
        self._thread: threading.Thread | None = None
        self._stopping = threading.Event()
        self._playing = threading.Event()
        self._frames = self._dropped = self._faults = self._connects = self._earlier_underruns = 0
        self._last_event: tuple[str, str] | None = None
        self._filter_s = 0.0
        self._idle = FrameClock(1)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._name})"

    def open(self, format: SinkFormat) -> None:
        """Prepare the sink and reset the counters. `start` connects to the device, which may be missing.

        Raises: DeviceError: another sink of this program plays on it, or it can never play this format.
        """
        self.stop()
        check_format: Callable[[SinkFormat], object] | None = getattr(self._line, "check_format", None)
        if check_format is not None:
            check_format(format)
        if self._key is not None:
            refusal = f"another sink plays on the {self._name} already. Close it first, or use a TeeSink."
            claim(self._key, self, refusal)
        self._format = format
        self._frames = self._dropped = self._faults = self._connects = 0
        self._earlier_underruns = self._line.underruns

    def start(self, fill: Fill) -> None:
        """Request blocks from `fill`, on the sink's own thread. Raises: DeviceError: not open."""
        if self._format is None:
            raise DeviceError(f"{self._name} is not open; call open(SinkFormat(...)) before start.")
        self.stop()
        self._fill = fill
        self._stopping.clear()
        self._last_event = None
        self._thread = threading.Thread(target=self._work, args=(self._format,), name=self._name, daemon=True)
        self._thread.start()
        # A program may end without `stop`, and some devices repeat their last samples for ever.
        atexit.register(self.stop)

    def stop(self) -> None:
        """Silence and release the device, as at the end of the program. The thread has ended when this returns."""
        atexit.unregister(self.stop)
        self._stopping.set()
        thread, self._thread = self._thread, None
        if thread is None or thread is threading.current_thread():
            return
        thread.join(_JOIN_S)
        if thread.is_alive():
            self._report_once("fault", f"{self._name}: its driver does not return; the thread ends when it does.")

    def close(self) -> None:
        """Stop. `open` is needed before the next `start`."""
        self.stop()
        give_back(self._key, self)
        self._format = None
        self._fill = None

    def wait_connected(self, timeout_s: float) -> bool:
        """Wait at most `timeout_s` [s] for the device. Returns True if it plays."""
        return self._playing.wait(timeout_s)

    @property
    def stats(self) -> SinkStats:
        """Counters since `open`."""
        latency_s = self._line.latency_s
        return SinkStats(
            frames=self._frames,
            underruns=self._line.underruns - self._earlier_underruns,
            connected=self._playing.is_set(),
            reconnects=max(0, self._connects - 1),
            dropped_frames=self._dropped,
            faults=self._faults,
            latency_s=None if latency_s is None else latency_s + self._filter_s,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _work(self, format: SinkFormat) -> None:
        pause_s = FIRST_RETRY_S
        self._idle = FrameClock(format.sample_rate_hz)
        self._idle.restart(time.monotonic())
        while not self._stopping.is_set():
            frames = self._frames
            problem = self._attempt(format)
            if self._stopping.is_set():
                break
            pause_s = FIRST_RETRY_S if self._frames > frames else pause_s
            kind: EventKind = "lost" if self._playing.is_set() else "unavailable"
            self._playing.clear()
            self._report_once(kind, f"{problem} Trying again.")
            self._idle_until(time.monotonic() + pause_s)
            pause_s = min(2 * pause_s, LAST_RETRY_S)
        self._playing.clear()

    def _attempt(self, format: SinkFormat) -> str:
        """Connect to the device and play until it fails. Returns the reason, "" when stopped."""
        try:
            rate_hz = self._line.connect(format, self._carry_on)
            if not self._stopping.is_set():
                self._connects += 1
                self._playing.set()
                remark = getattr(self._line, "remark", "")
                self._report_once("connected", f"{self._name} plays at {rate_hz} Hz. {remark}".rstrip())
                self._play(format, rate_hz)
        except DeviceError as cause:
            return str(cause)
        except Exception as cause:  # an unknown error of a driver must not end the thread
            self._faults += 1
            return f"{self._name}: {type(cause).__name__}: {cause}."
        finally:
            self._line.disconnect()
        return ""

    def _play(self, format: SinkFormat, rate_hz: int) -> None:
        stream = _Stream(self._pull, format, rate_hz)
        self._filter_s = stream.latency_s
        silent_after_s = getattr(self._line, "silent_after_s", math.inf)
        sent = last = time.monotonic()
        waited_s = 0.0
        stalled = False
        while not self._stopping.is_set():
            n_frames = self._line.wanted(POLL_S)
            now = time.monotonic()
            # On a busy machine this thread may sleep through a request of the device. That time does not count as a
            # stall.
            waited_s += min(now - last, _FAIR_S)
            last = now
            if n_frames:
                block = stream.take(n_frames)
                # Decided last: the program may be stopped anywhere, also while it renders.
                if stalled or time.monotonic() - sent > silent_after_s:
                    stream = _Stream(self._pull, format, rate_hz)
                    block = stream.take(n_frames)
                if stalled:
                    stalled = False
                    self._report_once("resumed", f"{self._name} takes samples again.")
                self._line.send(block)
                sent = time.monotonic()
                self._frames += n_frames
                waited_s = 0.0
                self._idle.restart(now)
            elif waited_s > GIVE_UP_S:
                raise DeviceTimeout(f"{self._name} took no samples for {waited_s:.1f} s.")
            elif waited_s > STALL_S:
                if not stalled:
                    stalled = True
                    self._report_once("stalled", f"{self._name} took no samples for {waited_s:.2f} s.")
                self._drop_due(format)
        self._end(stream)

    def _end(self, stream: _Stream) -> None:
        """Send what the rate converter still holds. Without it a device of a low rate would miss the fade-out."""
        left = stream.end()
        deadline = time.monotonic() + ENDING_S
        while left > 0 and time.monotonic() < deadline:
            if n_frames := self._line.wanted(POLL_S):
                self._line.send(stream.take(n_frames))
                self._frames += n_frames
                left -= n_frames

    def _carry_on(self) -> bool:
        if self._format is not None:
            self._drop_due(self._format)
        return not self._stopping.is_set()

    def _idle_until(self, end_s: float) -> None:
        while self._carry_on() and (left := end_s - time.monotonic()) > 0:
            self._stopping.wait(min(left, _IDLE_BLOCK_S))

    def _drop_due(self, format: SinkFormat) -> None:
        """Request and drop the frames that are due, so that the session's clock continues without a device."""
        block = max(1, round(_IDLE_BLOCK_S * format.sample_rate_hz))
        while (due := self._idle.due(time.monotonic())) >= block and not self._stopping.is_set():
            n_frames = min(due, block)
            self._pull(n_frames)
            self._idle.take(n_frames)
            self._dropped += n_frames

    def _pull(self, n_frames: int) -> Block:
        n_channels = len(self._format.channels) if self._format else 0
        fill = self._fill
        try:
            block = fill(n_frames) if fill is not None else np.zeros((n_frames, n_channels), dtype=np.float32)
            if block.shape != (n_frames, n_channels):
                raise DeviceError(f"the mix has shape {block.shape}; it must be {(n_frames, n_channels)}")
            return block
        except Exception as cause:  # an error of the mix gives silence, and must not end the thread
            self._faults += 1
            self._report_once("fault", f"{self._name} plays silence: {type(cause).__name__}: {cause}.")
            return np.zeros((n_frames, n_channels), dtype=np.float32)

    def _report_once(self, kind: EventKind, message: str) -> None:
        """Report an event once, not at every attempt."""
        if self._last_event == (kind, message):
            return
        self._last_event = (kind, message)
        callback = self.on_event
        if callback is None:
            return
        try:
            callback(SinkEvent(kind, message, time.monotonic(), self._name))
        except Exception:  # an error in the game's callback must not silence the sink
            self._faults += 1


class _Stream:
    """The mix at a device's rate, with a fade-in at its start, and silence after its end."""

    def __init__(self, pull: Fill, format: SinkFormat, rate_hz: int) -> None:
        self._pull = pull
        self._n_channels = len(format.channels)
        self._rate = RateConverter(format.sample_rate_hz, rate_hz, self._n_channels)
        self.latency_s = self._rate.latency_s
        n_fade = max(1, round(FADE_S * rate_hz))
        phase = np.arange(1, n_fade + 1, dtype=np.float32) / np.float32(n_fade)
        self._fade = (0.5 - 0.5 * np.cos(np.pi * phase)).astype(np.float32)[:, None]

    def end(self) -> int:
        """Request no more of the mix. Returns the number of frames until the last of it has left the converter."""
        self._pull = lambda n_frames: np.zeros((n_frames, self._n_channels), dtype=np.float32)
        return self._rate.n_held

    def take(self, n_frames: int) -> Block:
        # The ripple of the converter's filter exceeds full scale, and samples of 8 or 16 bit would wrap around.
        block = self._rate.convert(self._pull(self._rate.needed(n_frames)), n_frames).clip(-1.0, 1.0)
        now, self._fade = self._fade[:n_frames], self._fade[n_frames:]
        block[: len(now)] *= now
        return block
