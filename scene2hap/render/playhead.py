"""Position of a mix on its clock: due gain changes, current cell, and samples ready for the hands.

The clock counts frames at the outputs' rate; gains begin with the next tactile sample after the frame they are meant
for. Belongs to the thread that renders; gains come through a deque, which is read and never waited for.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np

from scene2hap.compiled import compiled
from scene2hap.render.limiter import THRESHOLD, limit_in_place, releases, turn_down_in_place
from scene2hap.render.loop_bank import CELL
from scene2hap.render.tactile_mix import Block, Gains, TactileMix
from scene2hap.render.upsampler import Upsampler


@dataclass(eq=False, slots=True)
class Change:
    """Gains that wait for their frame."""

    at_frame: int
    gains: Gains


@compiled
class Playhead:
    """Goes along a mix; `position` is the frame that comes next.

    Parameters: incoming : changes of gains, the first of which are due first; whoever put the last may still replace
    its gains while it waits; rates_hz : of the mix and of the outputs.
    """

    def __init__(
        self, mix: TactileMix, upsampler: Upsampler, incoming: deque[Change], rates_hz: tuple[int, int]
    ) -> None:
        self.position = 0
        self._mix, self._upsampler, self._incoming = mix, upsampler, incoming
        self._tactile_rate_hz, self._sample_rate_hz = rates_hz
        self._outputs = upsampler.outputs(0)
        self._scratch = np.zeros((2, *self._outputs.shape))
        self._soft = np.zeros_like(self._outputs)
        # How much the last sample is turned down, and what it was before this cell, which may be computed again.
        self._held, self._held_before = np.zeros((2, len(self._outputs)))
        self._releases = releases(self._sample_rate_hz, self._outputs.shape[1])
        self._tick = 0
        self._cell_begin = -CELL
        self._cell_frame = self._cell_end_frame = 0

    def render_into(self, out: Block) -> None:
        """Write the next samples into a block (n_frames, n_hands) float32, all in [-1, 1]."""
        frame, end = self.position, self.position + len(out)
        while frame < end:
            if frame == self._cell_end_frame:
                self._enter_cell()
            stop = min(end, self._cell_end_frame)
            self._take_gains(self._upsampler.input_of(stop - 1) + 1)
            if self._mix.compute():
                self._outputs = self._upsampler.outputs(self._cell_begin)
                self._limit(self._outputs[:, : self._cell_end_frame - self._cell_frame])
            ready = self._outputs[:, frame - self._cell_frame : stop - self._cell_frame]
            out[frame - self.position : stop - self.position] = ready.T
            frame = stop
        self.position = end

    def _limit(self, cell: Block) -> None:
        n = cell.shape[1]
        self._held[:] = self._held_before
        turn_down_in_place(cell, self._held, self._scratch[:2, :, :n], THRESHOLD, self._releases[:n])
        limit_in_place(cell, self._soft[:, :n], THRESHOLD)

    def _enter_cell(self) -> None:
        self._held_before[:] = self._held
        self._cell_begin += CELL
        self._cell_frame = self._cell_end_frame
        self._cell_end_frame = self._upsampler.first_output_of(self._cell_begin + CELL)
        self._upsampler.next_cell()
        self._mix.enter(self._cell_begin)

    def _take_gains(self, end: int) -> None:
        """Start the gains whose time comes before a tactile sample, none of them in what is rendered."""
        while self._incoming:
            change = self._incoming[0]
            tick = max(-(-change.at_frame * self._tactile_rate_hz // self._sample_rate_hz), self._tick)
            if tick >= end:
                break
            # Whoever sees it waiting may still replace its gains, so that these are read last.
            self._incoming.popleft()
            self._mix.start(change.gains, tick)
            self._tick = tick
        self._tick = max(self._tick, end)
