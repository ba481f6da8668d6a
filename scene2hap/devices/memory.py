"""A sink that keeps its samples in memory, for tests and for code that processes them."""

from __future__ import annotations

import numpy as np

from scene2hap.calls import clear_calls
from scene2hap.devices.protocol import Block, Fill, SinkFormat, SinkStats
from scene2hap.devices.whole_frames import Pulled, WholeFrames
from scene2hap.errors import DeviceError


@clear_calls
class MemorySink(Pulled):
    """Keeps the mix in memory. It has no clock of its own: `pull` requests the next frames."""

    def __init__(self) -> None:
        self._format: SinkFormat | None = None
        self._fill: Fill | None = None
        self._blocks: list[Block] = []

    def open(self, format: SinkFormat) -> None:
        """Forget what was kept, and get ready."""
        self._format = format
        self._blocks = []
        self._whole = WholeFrames(format.sample_rate_hz)

    def start(self, fill: Fill) -> None:
        """Take blocks from `fill` from now on."""
        if self._format is None:
            raise DeviceError("MemorySink is not open; call open(SinkFormat(...)) before start.")
        self._fill = fill

    def pull(self, n_frames: int) -> Block:
        """Take and keep the next frames; they are returned too."""
        if self._fill is None:
            raise DeviceError("MemorySink is not started; start the session that it belongs to first.")
        block = self._fill(n_frames)
        self._blocks.append(block)
        return block

    def stop(self) -> None:
        """Take no more blocks; what was kept stays."""
        self._fill = None

    def close(self) -> None:
        """Stop; what was kept stays."""
        self.stop()

    @property
    def samples(self) -> Block:
        """All that was taken (n_frames, n_channels) float32."""
        channels = len(self._format.channels) if self._format else 0
        return np.concatenate([np.zeros((0, channels), dtype=np.float32), *self._blocks])

    @property
    def stats(self) -> SinkStats:
        """Frames kept so far."""
        return SinkStats(frames=sum(len(block) for block in self._blocks))
