"""The contract of `ActuatorSink`."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

import numpy as np

from scene2hap.common.checks import described
from scene2hap.devices import SINKS
from scene2hap.devices.protocol import ActuatorSink, Block, SinkEvent, SinkFormat, SinkStats, has_clock
from scene2hap.plugins import lacking


def check_actuator_sink(
    make: Callable[[], ActuatorSink],
    *,
    sample_rate_hz: int = 48_000,
    channels: tuple[str, ...] = ("left", "right"),
    within_s: float = 5.0,
) -> None:
    """Check a sink against its protocol: open, start, pull, stop and close, the last two twice.

    Parameters: make : returns a new sink, called twice; within_s : longest time until a device plays frames [s].
    Raises: AssertionError: names the broken promise.
    """
    assert callable(make), (
        f"make is {described(make)}; it must be the class of the sink, or a function that makes one, since two are "
        "needed: check_actuator_sink(MySink), or check_actuator_sink(lambda: MySink(port))."
    )
    _hold_unused(make())
    sink, tone = make(), _Tone(sample_rate_hz, len(channels))
    name = type(sink).__name__
    events: list[SinkEvent] = []
    if hasattr(sink, "on_event"):
        sink.on_event = events.append
    sink.open(SinkFormat(sample_rate_hz, channels))
    try:
        sink.start(tone)
        if has_clock(sink):
            until = time.monotonic() + within_s
            # A sink may request frames for a device that still starts, and drop them.
            while (tone.n_frames == 0 or _stats(sink).frames == 0) and time.monotonic() < until:
                time.sleep(0.01)
        else:
            for n_frames in (1, 480, 4801):
                sink.pull(n_frames)  # type: ignore[attr-defined]  # a sink without a clock has this method
    finally:
        sink.stop()
    assert tone.n_frames or tone.wrong, f"{name} has requested no frames within {within_s} s of start"
    assert not tone.wrong, f"{name} requested {tone.wrong[0]!r} frames; it must be a whole number from 0"
    assert not tone.has_overlapped, f"{name} requested frames while it was being given some"
    taken = tone.n_frames
    time.sleep(0.05)
    assert tone.n_frames == taken, f"{name} requests frames after stop"
    sink.stop()
    sink.close()
    sink.close()
    stats = _stats(sink)
    last = f"; its last event: {events[-1].message}" if events else ""
    assert stats.frames > 0, f"{name}.stats has {stats.frames} frames after {taken} were taken{last}"
    assert stats.faults == 0, f"{name}.stats has {stats.faults} faults"


def _hold_unused(sink: ActuatorSink) -> None:
    """Check a sink that is closed without being opened, as in a session that ends before it begins."""
    problem = lacking(sink, SINKS.members)
    assert not problem, problem
    assert _stats(sink).frames == 0, f"{type(sink).__name__}.stats has frames before any were taken"
    sink.stop()
    sink.close()


def _stats(sink: ActuatorSink) -> SinkStats:
    stats = sink.stats
    assert isinstance(stats, SinkStats), (
        f"{type(sink).__name__}.stats is a {type(stats).__name__}; it must be SinkStats"
    )
    return stats


class _Tone:
    """A quiet tone on all channels, which detects two concurrent requests, and numbers that a session refuses."""

    def __init__(self, sample_rate_hz: int, n_channels: int) -> None:
        self.n_frames, self.has_overlapped = 0, False
        self.wrong: list[object] = []
        self._rate, self._n_channels, self._busy = sample_rate_hz, n_channels, threading.Lock()

    def __call__(self, n_frames: int) -> Block:
        if n_frames < 0 or n_frames != int(n_frames):
            self.wrong.append(n_frames)
            n_frames = max(int(n_frames), 0)
        if not self._busy.acquire(blocking=False):
            self.has_overlapped = True
            self._busy.acquire()
        try:
            t = np.arange(self.n_frames, self.n_frames + n_frames) / self._rate
            self.n_frames += n_frames
            tone = (0.01 * np.sin(2 * np.pi * 150 * t)).astype(np.float32)
            return np.tile(tone[:, None], self._n_channels)
        finally:
            self._busy.release()
