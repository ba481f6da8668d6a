"""A sink that keeps its samples in memory, for tests and for code that processes them."""

from __future__ import annotations

import numpy as np

from scene2hap.common.calls import clear_calls
from scene2hap.common.counted import counted
from scene2hap.devices.protocol import Block, Fill, SinkFormat, SinkStats
from scene2hap.devices.whole_frames import PulledSink, WholeFrames
from scene2hap.errors import DeviceError


@clear_calls
class MemorySink(PulledSink):
    """Store the mix in memory, where `samples` has it: 1.9 MB for each second of ten channels at 48 kHz.

    It has no clock of its own: `pull` requests the next frames.
    """

    def __init__(self) -> None:
        self._format: SinkFormat | None = None
        self._fill: Fill | None = None
        self._blocks: list[Block] = []
        self._frames = 0

    def __repr__(self) -> str:
        n_channels = len(self._format.channels) if self._format else 0
        return f"MemorySink({counted(self.stats.frames, 'frame')} of {counted(n_channels, 'channel')})"

    def open(self, format: SinkFormat) -> None:
        """Prepare the sink, and discard stored samples."""
        self._format = format
        self._blocks, self._frames = [], 0
        self._whole = WholeFrames(format.sample_rate_hz)

    def start(self, fill: Fill) -> None:
        """Set `fill` as the source of blocks."""
        if self._format is None:
            raise DeviceError("MemorySink is not open; call open(SinkFormat(...)) before start.")
        self._fill = fill

    def pull(self, n_frames: int) -> Block:
        """Request, store and return the next frames."""
        if self._fill is None:
            raise DeviceError("MemorySink is not started; start the session that it belongs to first.")
        block = self._fill(n_frames)
        self._blocks.append(block)
        self._frames += len(block)
        return block

    def stop(self) -> None:
        """Request no more blocks; stored samples stay."""
        self._fill = None

    def close(self) -> None:
        """Stop; stored samples stay."""
        self.stop()

    @property
    def samples(self) -> Block:
        """All stored samples (n_frames, n_channels) float32."""
        channels = len(self._format.channels) if self._format else 0
        return np.concatenate([np.zeros((0, channels), dtype=np.float32), *self._blocks])

    @property
    def stats(self) -> SinkStats:
        """The number of frames stored so far."""
        return SinkStats(frames=self._frames)
