"""One mix on several sinks.

Each device has its own clock, so a buffer stores the mix, and each device reads it at its own rate. The fastest reader
makes the session render. A reader more than 0.1 s and the longest present block behind (a slower clock, a device that
was disconnected) jumps to the newest frame, with a cross-fade. Sinks without a clock, such as WavSink, get every block
once, in order. If one of them fails beside a device, as on a full disk, it gets no more blocks, and the device plays
on.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from typing import Any

import numpy as np

from scene2hap.common.calls import clear_calls
from scene2hap.common.checks import shown
from scene2hap.devices.protocol import (
    ActuatorSink,
    Block,
    EventCallback,
    Fill,
    SinkEvent,
    SinkFormat,
    SinkStats,
    has_clock,
    parts_of,
)
from scene2hap.devices.whole_frames import PulledSink, WholeFrames
from scene2hap.errors import ConfigError, DeviceError

MAX_LAG_S = 0.1
FADE_S = 0.005
"""Length of the cross-fade of a jump [s]."""
LONGEST_STOP_S = 2 * MAX_LAG_S
"""Longest time for which `stop` waits for the slowest device [s]; a device that requests no samples is not awaited
longer."""


@clear_calls
class TeeSink(PulledSink):
    """Pass one mix to several sinks: objects, kinds, or mappings with a `kind`.

    `stats` has their sums and the largest latency, and is connected if any sink is; `sinks` gives access to each. If no
    sink has a clock, `pull` requests frames from the session, as the sinks' own `pull` does.
    Raises: ConfigError: no sink, or an object that is no sink.
    """

    def __init__(
        self, sinks: Sequence[ActuatorSink | str | Mapping[str, Any]], *, on_event: EventCallback | None = None
    ) -> None:
        from scene2hap.devices import SINKS

        if isinstance(sinks, str | Mapping) or not isinstance(sinks, Iterable):
            raise ConfigError(f"TeeSink sinks is {shown(sinks)}; it must be a list of sinks, as [{shown(sinks)}].")
        built = [SINKS.build(sink) for sink in sinks]
        strangers = [sink for sink in built if not isinstance(sink, ActuatorSink)]
        if not built or strangers:
            raise ConfigError(f"TeeSink needs at least one sink and nothing else, got {strangers or 'none'}.")
        self.sinks: tuple[ActuatorSink, ...] = tuple(sink for sink in built if isinstance(sink, ActuatorSink))
        if len({id(part) for part in parts_of(self)}) < len(parts_of(self)):
            raise ConfigError("TeeSink was given one sink twice, which cannot play the mix twice; give each once.")
        self.on_event = on_event
        self._format: SinkFormat | None = None
        self._buffer: _Buffer | None = None
        self._faults = 0

    def __repr__(self) -> str:
        return f"TeeSink({list(self.sinks)!r})"

    def open(self, format: SinkFormat) -> None:
        """Open all sinks. Raises: DeviceError: one cannot be opened; the others are closed again."""
        self._format = format
        self._faults = 0
        self._whole = WholeFrames(format.sample_rate_hz)
        self._listen()
        for number, sink in enumerate(self.sinks):
            try:
                sink.open(format)
            except Exception:
                for opened in self.sinks[:number]:
                    getattr(opened, "abort", opened.close)()
                self._listen_no_more()
                raise

    def start(self, fill: Fill) -> None:
        """Start all sinks. Raises: DeviceError: not open."""
        if self._format is None:
            raise DeviceError("TeeSink is not open; call open(SinkFormat(...)) before start.")
        recorders = [sink for sink in self.sinks if not has_clock(sink)]
        self._buffer = buffer = _Buffer(fill, self._format, recorders, self._report_failed)
        for sink in self.sinks:
            if has_clock(sink):
                sink.start(buffer.reader().read)

    def pull(self, n_frames: int) -> Block:
        """Request the next frames and pass them on. Raises: DeviceError: not started, or a sink has a clock."""
        if self._buffer is None or has_clock(self):
            raise DeviceError("TeeSink is not started, or has a device in it that takes blocks by itself.")
        return self._buffer.advance(n_frames)

    def stop(self) -> None:
        """Stop all sinks, each after it has read the present mix, which ends with the fade-out.

        If a sink raises, the others are stopped all the same.
        """
        if self._buffer is not None:
            self._buffer.wait_read(LONGEST_STOP_S)
            self._buffer = None
        self._each("stop")

    def close(self) -> None:
        """Close all sinks."""
        self._format = None
        with ExitStack() as last:
            last.callback(self._listen_no_more)
            last.callback(self._each, "close")
            self.stop()

    def abort(self) -> None:
        """Stop all sinks, and let sinks that support it delete their files."""
        self._format = None
        with ExitStack() as last:
            last.callback(self._listen_no_more)
            last.callback(self._each, "abort", "close")
            self.stop()

    def show(self, frame: object) -> None:
        """Pass the gains of an update to the sinks that play gains."""
        for sink in self.sinks:
            if show := getattr(sink, "show", None):
                show(frame)

    @property
    def stats(self) -> SinkStats:
        """Counters of all sinks together."""
        each = [sink.stats for sink in self.sinks]
        latencies = [stats.latency_s for stats in each if stats.latency_s is not None]
        return SinkStats(
            frames=sum(stats.frames for stats in each),
            underruns=sum(stats.underruns for stats in each),
            connected=any(stats.connected for stats in each),
            reconnects=sum(stats.reconnects for stats in each),
            dropped_frames=sum(stats.dropped_frames for stats in each),
            faults=self._faults + sum(stats.faults for stats in each),
            latency_s=max(latencies, default=None),
        )

    def _each(self, *names: str) -> None:
        """Call the first of these methods that a sink has, for all sinks, even if one raises."""
        with ExitStack() as calls:
            for sink in reversed(self.sinks):
                calls.callback(next(getattr(sink, name) for name in names if hasattr(sink, name)))

    def _listen(self) -> None:
        """Pass on the events of the sinks that have no callback of their own, until `_listen_no_more`."""
        for sink in self.sinks:
            if hasattr(sink, "on_event") and getattr(sink, "on_event", None) is None:
                sink.on_event = self._pass_on

    def _listen_no_more(self) -> None:
        """Take the callback away: a sink may play alone or in another group next."""
        for sink in self.sinks:
            if getattr(sink, "on_event", None) == self._pass_on:
                sink.on_event = None  # type: ignore[attr-defined]  # looked up by name, see ActuatorSink

    def _pass_on(self, event: SinkEvent) -> None:
        if self.on_event is not None:
            self.on_event(event)

    def _report_failed(self, sink: ActuatorSink, cause: Exception) -> None:
        self._faults += 1
        name = type(sink).__name__
        message = f"{name} gets no more of the mix, the other sinks play on: {cause}"
        try:
            self._pass_on(SinkEvent("fault", message, time.monotonic(), name))
        except Exception:  # an error in the game's callback must not silence the other sinks
            self._faults += 1


class _Buffer:
    """The newest part of the mix. A reader that reaches its end renders more.

    Readers are sinks' own threads, never a sound card's callback, so a lock is allowed.
    """

    def __init__(
        self,
        fill: Fill,
        format: SinkFormat,
        recorders: Sequence[ActuatorSink],
        on_failed: Callable[[ActuatorSink, Exception], None],
    ) -> None:
        self._fill = fill
        self._recorders = list(recorders)
        self._on_failed = on_failed
        self._lag = round(MAX_LAG_S * format.sample_rate_hz)
        self._n_fade = max(1, round(FADE_S * format.sample_rate_hz))
        self._samples = np.zeros((0, len(format.channels)), dtype=np.float32)
        self._readers: list[_Reader] = []
        self.lock = threading.Condition()
        self.head = 0
        self._block: Block | None = None
        for recorder in recorders:
            recorder.start(self._present_block)

    def reader(self) -> _Reader:
        """Return the reader of one more device."""
        self._readers.append(_Reader(self, self._n_fade))
        return self._readers[-1]

    @property
    def most_lag(self) -> int:
        """Frames by which a reader may be behind. A device that requests long blocks is ahead of the others by one."""
        return self._lag + max((reader.n_requested for reader in self._readers), default=0)

    @property
    def n_stored(self) -> int:
        """Number of frames that can be read without rendering."""
        return len(self._samples)

    def wait_read(self, timeout_s: float) -> None:
        """Wait until every reader has read the frames up to the present one, but at most `timeout_s` [s]."""
        with self.lock:
            head = self.head
            self.lock.wait_for(lambda: all(reader.position >= head for reader in self._readers), timeout_s)

    def advance(self, n_frames: int) -> Block:
        """Render and store the next frames. Raises: errors of a sink without a clock, if no device must play on."""
        self._block = block = self._fill(n_frames)
        try:
            self._record(n_frames)
        finally:
            self._block = None
        self._samples = np.concatenate([self._samples[-2 * self.most_lag :], block])
        self.head += n_frames
        return block

    def _record(self, n_frames: int) -> None:
        """Let every recorder pull the present block."""
        for recorder in tuple(self._recorders):
            try:
                recorder.pull(n_frames)  # type: ignore[attr-defined]  # sinks without a clock have it
            except Exception as cause:
                if not self._readers:
                    raise
                self._recorders.remove(recorder)
                self._on_failed(recorder, cause)

    def _present_block(self, n_frames: int) -> Block:
        """Return the block that is being recorded. Raises: DeviceError: there is none: a recorder was pulled itself."""
        if self._block is None:
            raise DeviceError("this sink is part of a TeeSink, which passes it the mix; pull the TeeSink instead.")
        return self._block.copy()

    def read(self, start: int, n_frames: int) -> Block:
        """Return frames from a position on, as a copy; missing ones are rendered."""
        missing = start + n_frames - self.head
        if missing > 0:
            self.advance(missing)
        first = len(self._samples) - (self.head - start)
        # A sink may scale its block in place: the other sinks would play that, past the safety layer.
        return self._samples[first : first + n_frames].copy()


class _Reader:
    """The read position of one device in the buffer. A jump cross-fades over `n_fade` frames, in several reads."""

    def __init__(self, buffer: _Buffer, n_fade: int) -> None:
        self._buffer = buffer
        self.position = self.n_requested = 0
        self._n_fade = n_fade
        self._n_faded = n_fade
        self._old: int | None = None

    def read(self, n_frames: int) -> Block:
        with self._buffer.lock:
            self._buffer.lock.notify_all()  # `wait_read` looks once this block has been read
            self.n_requested = n_frames
            late, most = self._buffer.head - self.position, self._buffer.most_lag
            is_stored = late <= self._buffer.n_stored
            if late > most or not is_stored:
                self._old = self.position if late < 2 * most and is_stored else None
                self.position, self._n_faded = self._buffer.head, 0
            old = self._read_old(n_frames)
            block = self._buffer.read(self.position, n_frames)
            self.position += n_frames
        if self._n_faded == self._n_fade:
            return block
        place = np.arange(self._n_faded + 1, self._n_faded + 1 + n_frames, dtype=np.float32)
        rising: Block = np.minimum(place / np.float32(self._n_fade), np.float32(1.0))[:, None]
        self._n_faded = min(self._n_faded + n_frames, self._n_fade)
        mixed: Block = rising * block if old is None else rising * block + (1 - rising) * old
        return mixed

    def _read_old(self, n_frames: int) -> Block | None:
        """Read on from before the jump, while it fades out; None if that is not stored."""
        start = self._old
        if self._n_faded == self._n_fade or start is None or self._buffer.head - start > self._buffer.n_stored:
            return None
        self._old = start + n_frames
        return self._buffer.read(start, n_frames)
