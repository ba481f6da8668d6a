"""The interface of actuators: `ActuatorSink`, its format, events and statistics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from scene2hap.calls import clear_construction

Block = NDArray[np.float32]
"""Samples (n_frames, n_channels) float32 in [-1, 1]."""

Fill = Callable[[int], Block]
"""Gives the next n_frames of the mix."""


@dataclass(frozen=True)
class SinkFormat:
    """Format of an opened sink: its sample rate and the name of each channel, such as ("left", "right")."""

    sample_rate_hz: int
    channels: tuple[str, ...]


@clear_construction
@dataclass(frozen=True)
class SinkStats:
    """Statistics of a sink.

    `frames` were handed to the device, at the device's rate; `dropped_frames` were taken from the session while there
    was no device for them, at the session's rate; `underruns` are times at which the device ran dry; `faults` are
    exceptions of the fill or of `on_event`; `latency_s` is the time from taking a sample to playing it, None unknown.
    """

    frames: int = 0
    underruns: int = 0
    connected: bool = True
    reconnects: int = 0
    dropped_frames: int = 0
    faults: int = 0
    latency_s: float | None = None


@clear_construction
@dataclass(frozen=True)
class SinkEvent:
    """An event of a sink that a game may show to its player.

    kind : "connected" (first or again), "unavailable" (cannot be reached, tried again later), "stalled" (takes no
    samples), "resumed" (takes them again), "lost" (was there, is gone) or "fault" (the mix could not be rendered).
    message : a sentence with what to do next; at_s : when [s], on the clock of `time.monotonic`.
    """

    kind: str
    message: str
    at_s: float


EventCallback = Callable[[SinkEvent], None]
"""Is called on a sink's own thread, so it must be quick and must not call `stop` or `close`."""


@runtime_checkable
class ActuatorSink(Protocol):
    """Plays the mix on actuators, or writes it to a file. `stop` and `close` may be called twice.

    Optional members are looked up by name: `on_event`, an `EventCallback` or None that may be set at any time (sinks
    with a device: see `scene2hap.devices.link`); `abort()`, called instead of `stop` and `close` when a run has failed;
    `show(frame)`, called with every HapticFrame, for devices that play gains.
    """

    def open(self, format: SinkFormat) -> None:
        """Prepare the sink for this format. Raises: DeviceError."""
        ...

    def start(self, fill: Fill) -> None:
        """Begin to request blocks. A device requests them by its own clock; a file or memory sink by `pull`."""
        ...

    def stop(self) -> None:
        """Request no more blocks."""
        ...

    def close(self) -> None:
        """Release the device; a file is complete from then on."""
        ...

    @property
    def stats(self) -> SinkStats:
        """Statistics so far."""
        ...
