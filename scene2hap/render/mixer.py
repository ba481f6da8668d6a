"""The mixer: from gains and loops to samples for every hand.

    loops (tactile rate) ── gains ──► mix (tactile rate) ──► upsampler ──► soft limiter ──► hands (session's rate)

The clock counts frames at the session's rate. A change of gains may be stamped with any frame. It begins with the next
tactile sample, so at most one tactile sample later. Samples are behind the clock by the constant `delay_s`.

A stepped gain would put sidebands into the tactile band, so every change is ramped along a raised cosine. Overlapping
changes add up (`scene2hap.render.tactile_mix`). See Kaaresoja 2014 and Okamoto 2009 for the time budget.

Threads: `set_gains` (game) appends to a deque and `render` (audio) pops from it; neither waits for the other. If gains
are set again for one frame, they replace the waiting ones, so nothing accumulates without `render`. `render` does not
release the interpreter lock for 20 bands or fewer, so a game's Python code cannot interrupt it. `Playhead` is the part
on the audio thread: it applies the due gains, cell by cell.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.compiled import compiled
from scene2hap.errors import ConfigError, SessionError
from scene2hap.render.limiter import THRESHOLD, decays, limit_in_place, turn_down_in_place
from scene2hap.render.loop_bank import CELL, Block, LoopBank
from scene2hap.render.tactile_mix import Gains, TactileMix
from scene2hap.render.upsampler import Upsampler


@dataclass(frozen=True)
class MixerStats:
    """Counters so far.

    rows_mixed, rows_skipped : rows (bands of loops) times cells that were mixed, or skipped since their gains are 0;
    changes_merged : changes of gains that came too fast and were merged with the next one.
    """

    rows_mixed: int = 0
    rows_skipped: int = 0
    changes_merged: int = 0


@dataclass(eq=False, slots=True)
class GainChange:
    """Gains that wait for their frame."""

    at_frame: int
    gains: Gains


@compiled
class Playhead:
    """Renderer of a mix frame by frame, cell by cell; `position` is the next frame.

    Parameters: incoming : changes of gains in order of time; the thread that added the last one may replace its gains
        while it waits; rates_hz : of the mix and of the outputs.
    """

    def __init__(
        self, mix: TactileMix, upsampler: Upsampler, incoming: deque[GainChange], rates_hz: tuple[int, int]
    ) -> None:
        self.position: int = 0
        self._mix, self._upsampler, self._incoming = mix, upsampler, incoming
        self._tactile_rate_hz, self._sample_rate_hz = rates_hz
        self._outputs = upsampler.outputs(0)
        self._scratch = np.zeros((2, *self._outputs.shape))
        self._soft = np.zeros_like(self._outputs)
        # Gain reduction at the last sample, and its value before this cell, since the cell may be computed again.
        self._held, self._held_before = np.zeros((2, 2, len(self._outputs)))
        self._decays = decays(self._sample_rate_hz, self._outputs.shape[1])
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
        turn_down_in_place(cell, self._held, self._scratch[:, :, :n], THRESHOLD, self._decays[:, :n])
        limit_in_place(cell, self._soft[:, :n], THRESHOLD)

    def _enter_cell(self) -> None:
        self._held_before[:] = self._held
        self._cell_begin += CELL
        self._cell_frame = self._cell_end_frame
        self._cell_end_frame = self._upsampler.first_output_of(self._cell_begin + CELL)
        self._upsampler.next_cell()
        self._mix.enter(self._cell_begin)

    def _take_gains(self, end: int) -> None:
        """Start the gains that begin before a tactile sample. None begins within samples that are already rendered."""
        while self._incoming:
            change = self._incoming[0]
            tick = max(-(-change.at_frame * self._tactile_rate_hz // self._sample_rate_hz), self._tick)
            if tick >= end:
                break
            # The other thread may replace the gains while they wait, so they are read only after they are removed.
            self._incoming.popleft()
            self._mix.start(change.gains, tick)
            self._tick = tick
        self._tick = max(self._tick, end)


class Mixer:
    """The running mix of `n_hands` outputs.

    Parameters: bank : the loops, at the tactile rate; sample_rate_hz : rate of the outputs, at least the tactile one;
        ramp_s : length of the ramp of a gain change [s]; skip_silent : leave out loops whose gains are all 0.
    Raises: ConfigError: a rate or time that is out of bounds.
    """

    def __init__(
        self, bank: LoopBank, n_hands: int, *, sample_rate_hz: int, ramp_s: float, skip_silent: bool = True
    ) -> None:
        hint = "Mix at a tactile rate that is not above the session's."
        checks.number(
            "sample_rate_hz", sample_rate_hz, "Hz", at_least=bank.sample_rate_hz, error=ConfigError, hint=hint
        )
        checks.number("ramp_s", ramp_s, "s", above=0.0, error=ConfigError)
        self._shape = (n_hands, bank.n_rows)
        self._n_bands = bank.n_bands
        self._all_loops = range(len(bank))
        self._is_skipping = skip_silent
        upsampler = Upsampler(bank.sample_rate_hz, sample_rate_hz, n_hands)
        self._delay_s = upsampler.delay_s
        ramp = max(1, round(ramp_s * bank.sample_rate_hz))
        self._mix = TactileMix(bank, n_hands, ramp, upsampler.cell, is_skipping=skip_silent)
        self._incoming: deque[GainChange] = deque()
        self._latest: GainChange | None = None
        self._playhead = Playhead(self._mix, upsampler, self._incoming, (bank.sample_rate_hz, sample_rate_hz))

    @property
    def position(self) -> int:
        """First frame of the next `render`."""
        return self._playhead.position

    @property
    def delay_s(self) -> float:
        """Time from a frame on the clock to its sample [s]; the same for all frequencies."""
        return self._delay_s

    @property
    def stats(self) -> MixerStats:
        """Counters so far."""
        mixed, offered = self._mix.n_rows_mixed, self._mix.n_cells * self._shape[1]
        return MixerStats(mixed, offered - mixed, self._mix.n_merged)

    def set_gains(self, gains: NDArray[np.float32], loops: Sequence[int], at_frame: int) -> None:
        """Set the target gains (n_hands, n_loops, n_bands) of some loops, and 0 for all others, from a frame on.

        Frames in the past count as the next one.
        Raises: SessionError: another shape, or gains that are not finite; the audio thread could not report them.
        """
        shape, checked_gains = (self._shape[0], len(loops), self._n_bands), None
        if gains.shape == shape:
            checked_gains = Gains.of(gains, loops, loops if self._is_skipping else self._all_loops)
        if checked_gains is None:
            raise SessionError(f"gains has shape {gains.shape}; it must be finite numbers of shape {shape}.")
        latest = self._latest
        if latest is not None and latest.at_frame == at_frame:
            # Of several gains for one frame only the newest count.
            latest.gains = checked_gains
            if self._is_waiting(latest):
                return
        self._latest = GainChange(at_frame, checked_gains)
        self._incoming.append(self._latest)

    def _is_waiting(self, change: GainChange) -> bool:
        try:
            return self._incoming[-1] is change
        except IndexError:
            return False

    def render(self, n_frames: int) -> NDArray[np.float32]:
        """Return the next samples (n_frames, n_hands) float32 in [-1, 1]."""
        out = np.empty((n_frames, self._shape[0]), dtype=np.float32)
        self.render_into(out)
        return out

    def render_into(self, out: NDArray[np.float32]) -> None:
        """Write the next samples into a block (n_frames, n_hands) float32."""
        self._playhead.render_into(out)
