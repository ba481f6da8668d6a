"""Ring buffer of a sound card's callback: samples rendered ahead, and a fade at every start and end.

One thread writes and one reads. Each owns one counter, which only grows, and reads the other's. No thread ever waits.
`play` allocates no array: it copies and multiplies in the sound card's own buffer.

       write ──► [ rendered ahead ] ──► play
    fade in : at the first samples, and after every gap
    fade out: when `closing` is set, and from the last sample on when samples run out
"""

from __future__ import annotations

import math

import numpy as np

from scene2hap.devices.protocol import Block


class PlaybackRing:
    """A ring of n_frames for n_channels, with fades of n_fade frames."""

    def __init__(self, n_frames: int, n_channels: int, n_fade: int) -> None:
        self._data: Block = np.zeros((n_frames, n_channels), dtype=np.float32)
        phase = np.arange(n_fade + 1) / n_fade
        self._rise = (0.5 - 0.5 * np.cos(math.pi * phase)).astype(np.float32)[:, None]
        self._fall = np.ascontiguousarray(self._rise[::-1])
        self._last = np.zeros((1, n_channels), dtype=np.float32)
        self._written = self._read = 0
        self._top = n_fade
        self._place = 0
        self._is_dry = False
        self.closing: bool = False
        """Set by the writer to fade out. Samples written after that are not played."""
        self.gaps: int = 0
        """Number of times that samples ran out while playing."""

    def restart(self) -> None:
        """Reset the ring for another stream, except for the count of gaps."""
        self._written = self._read = self._place = 0
        self.closing = False

    @property
    def shape(self) -> tuple[int, int]:
        """Number of frames and of channels."""
        return self._data.shape[0], self._data.shape[1]

    @property
    def level(self) -> int:
        """Number of frames written and not yet played."""
        return self._written - self._read

    @property
    def is_silent(self) -> bool:
        """True if a fade-out has ended, or nothing was played yet."""
        return self._place == 0

    def write(self, block: Block) -> None:
        """Append frames (n, n_channels). If they exceed the free space, they overwrite frames that were not played
        yet."""
        size = len(self._data)
        at = self._written % size
        first = min(len(block), size - at)
        self._data[at : at + first] = block[:first]
        self._data[: len(block) - first] = block[first:]
        self._written += len(block)

    def play(self, out: Block, *, after_gap: bool = False) -> None:
        """Fill `out` (n, n_channels) with the next frames, or with a fade and silence.

        Parameters: after_gap : the device was silent before, since it ran out of samples.
        """
        n_frames = len(out)
        if after_gap:
            self._place = 0
        if self._place == 0:
            self._is_dry = False
            if self.closing or self.level < n_frames:
                out.fill(0.0)
                return
        have = 0 if self._is_dry else min(n_frames, self.level)
        self._copy(out, have)
        if self.closing:
            self._fade_out(out[:have], out[:have])
        elif self._place < self._top:
            self._fade_in(out[:have])
        if have < n_frames:
            if not self._is_dry and not self.closing:
                self.gaps += 1
            self._is_dry = True
            self._fade_out(self._last, out[have:])

    def _copy(self, out: Block, n_frames: int) -> None:
        if n_frames == 0:
            return
        size = len(self._data)
        at = self._read % size
        first = min(n_frames, size - at)
        out[:first] = self._data[at : at + first]
        out[first:n_frames] = self._data[: n_frames - first]
        self._last[0] = out[n_frames - 1]
        self._read += n_frames

    def _fade_in(self, out: Block) -> None:
        n = min(len(out), self._top - self._place)
        np.multiply(out[:n], self._rise[self._place + 1 : self._place + 1 + n], out=out[:n])
        self._place += n

    def _fade_out(self, signal: Block, out: Block) -> None:
        """Write `signal` (the frames of `out`, or one repeated frame), faded out."""
        n = min(len(out), self._place)
        begin = self._top - self._place + 1
        np.multiply(signal[:n], self._fall[begin : begin + n], out=out[:n])
        out[n:].fill(0.0)
        self._place -= n
