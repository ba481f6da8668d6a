"""The interface of actuators: `ActuatorSink`, its format, events and statistics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.errors import ConfigError

Block = NDArray[np.float32]
"""Samples (n_frames, n_channels) float32 in [-1, 1]."""

Fill = Callable[[int], Block]
"""Function that returns the next n_frames of the mix."""


@clear_construction
@dataclass(frozen=True)
class SinkFormat:
    """Format of an opened sink: its sample rate and the name of each channel, such as ("left", "right").

    Raises: ConfigError: no rate of at least 1 Hz, or no channel.
    """

    sample_rate_hz: int
    channels: tuple[str, ...]

    def __post_init__(self) -> None:
        rate_hz = checks.whole(
            "sample_rate_hz", self.sample_rate_hz, "Hz", at_least=1, at_most=1_000_000, error=ConfigError
        )
        object.__setattr__(self, "sample_rate_hz", rate_hz)
        object.__setattr__(self, "channels", checks.names("channels", self.channels))


@clear_construction
@dataclass(frozen=True)
class SinkStats:
    """Statistics of a sink.

    `frames` were passed to the device, at the device's rate. `dropped_frames` were requested from the session while
    there was no device for them, at the session's rate. `underruns` counts the times that the device ran out of
    samples. `faults` counts exceptions of the fill or of `on_event`. `latency_s` is the time from taking a sample to
    playing it, None if unknown.
    """

    frames: int = 0
    underruns: int = 0
    connected: bool = True
    reconnects: int = 0
    dropped_frames: int = 0
    faults: int = 0
    latency_s: float | None = None


EventKind = Literal["connected", "unavailable", "stalled", "resumed", "lost", "fault"]


@clear_construction
@dataclass(frozen=True)
class SinkEvent:
    """An event of a sink that a game may show to its player.

    kind : "connected" (first or again), "unavailable" (cannot be reached, tried again later), "stalled" (takes no
        samples), "resumed" (takes them again), "lost" (was connected, is gone) or "fault" (the mix could not be
        rendered, a recording beside the device failed, or the driver does not return).
    message : a sentence with the next step; at_s : time [s], on the clock of `time.monotonic`; sink : name of the sink,
        as for one of a TeeSink.
    """

    kind: EventKind
    message: str
    at_s: float
    sink: str = ""


EventCallback = Callable[[SinkEvent], None]
"""Callback on a sink's own thread. It must be quick and must not call `stop` or `close`."""


@runtime_checkable
class ActuatorSink(Protocol):
    """Interface of outputs that play the mix on actuators or write it to a file.

    `stop` and `close` may be called twice.

    Optional members are looked up by name. `on_event` is an `EventCallback` or None, and may be set at any time (sinks
    with a device: see `scene2hap.devices.link`). `abort()` is called instead of `close` when a run has failed.
    `show(frame)` is called with every HapticFrame, for devices that play gains. `pull(n_frames)` requests blocks from a
    sink without a clock. `sinks` are those of a group.
    """

    def open(self, format: SinkFormat, /) -> None:
        """Prepare the sink for this format. Raises: DeviceError."""
        ...

    def start(self, fill: Fill, /) -> None:
        """Begin to request blocks. A device requests them by its own clock; a file or memory sink by `pull`."""
        ...

    def stop(self) -> None:
        """Request no more blocks."""
        ...

    def close(self) -> None:
        """Release the device, or complete the file."""
        ...

    @property
    def stats(self) -> SinkStats:
        """Statistics so far."""
        ...


def parts_of(sink: ActuatorSink) -> list[ActuatorSink]:
    """Return a sink and all sinks inside it, such as those of a TeeSink."""
    parts: tuple[ActuatorSink, ...] = getattr(sink, "sinks", ())
    return [sink, *(x for part in parts for x in parts_of(part))]


def has_clock(sink: ActuatorSink) -> bool:
    """Return True if a sink requests blocks by its own clock; False for sinks that are pulled, and for groups of them.

    Only with a clock can a watchdog detect that a game is late.
    """
    return any(not hasattr(part, "pull") for part in parts_of(sink))
