"""What an actuator looks like to a session."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

Block = NDArray[np.float32]
"""Samples (n_frames, n_channels) float32 in [-1, 1]."""

Fill = Callable[[int], Block]
"""Gives the next n_frames of the mix."""


@dataclass(frozen=True)
class SinkFormat:
    """What a sink is opened for: its sample rate and the name of each channel, such as ("left", "right")."""

    sample_rate_hz: int
    channels: tuple[str, ...]


@dataclass(frozen=True)
class SinkStats:
    """What a sink has done so far."""

    frames: int = 0
    underruns: int = 0


@runtime_checkable
class ActuatorSink(Protocol):
    """Takes the mix to hands, or to a file. `stop` and `close` may be called twice."""

    def open(self, format: SinkFormat) -> None:
        """Get ready. Raises: DeviceError."""
        ...

    def start(self, fill: Fill) -> None:
        """Begin to take blocks. A device pulls them in its own time; a file or memory takes what `pull` asks for."""
        ...

    def stop(self) -> None:
        """Take no more blocks."""
        ...

    def close(self) -> None:
        """Give the device back; a file is complete from here on."""
        ...

    @property
    def stats(self) -> SinkStats:
        """What was done so far."""
        ...
