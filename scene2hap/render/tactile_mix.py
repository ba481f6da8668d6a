"""The mix at the tactile rate: gains that change along raised cosines, and loops, one matrix product at a time.

    x(t) = sum_j (r_j(t) - r_(j+1)(t)) P_j(t)     r_j(t) = r((t - t_j + 1) / T),   r(x) = (1 - cos(pi x)) / 2 on [0, 1]
    P = G L

This is g(t) = g_0 + sum_j (g_j - g_(j-1)) r_j(t) in another order: the gains in transition are rows of one matrix.
Nothing is summed over time, so no rounding error accumulates.

Time is divided into cells of CELL samples, counted from 0. In a cell the products have one shape for any size of
`render` calls. Gains that have not begun weigh 0, and numbers are added in the order of slots. So blocks of any size
give the same bits. Gains whose ramp has ended are dropped at the next cell. Loops whose gains are all 0 are skipped;
that is exact, since their products are 0.

Symbols: t tactile sample, G gains (slots * hands, rows), L loops (rows, CELL), P products (slots * hands, CELL), r ramp
(0 before it begins, 1 after), T its length, x mix (hands, CELL).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled
from scene2hap.render.loop_bank import CELL, Block, LoopBank

MOST_SLOTS = 40
"""Most sets of gains in transition at once, which bounds the product of a cell; see `TactileMix`."""

_SMALL_PRODUCT = 2**18
"""OpenBLAS starts threads for more multiplications than this, and an audio thread must not wait for them."""


@dataclass(frozen=True, eq=False)
class Gains:
    """Target gains of the mix.

    values : (n_hands, n_loops, n_bands) of some loops, 0 for all others; loops : numbers of these loops; heard :
        numbers of the loops that are mixed.
    """

    values: Block
    loops: Sequence[int]
    heard: Sequence[int]

    @classmethod
    def of(cls, values: Block, loops: Sequence[int], heard: Sequence[int]) -> Gains | None:
        """Return a checked copy of gains, None if they are not finite. The check runs on the thread that sets them."""
        own = np.array(values, dtype=np.float32, order="C")
        # A square may be infinite although its root is finite.
        if not math.isfinite(np.vdot(own, own)) and not np.isfinite(own).all():
            return None
        return cls(own, loops, heard)


def slots_for(ramp: int, sample_rate_hz: int) -> int:
    """Return the number of slots that hold gains during their ramps, if gains come once per millisecond."""
    return min(MOST_SLOTS, -(-1000 * (ramp + CELL) // sample_rate_hz) + 2)


def rise_over(ramp: int) -> Block:
    """Return the weights of gains over a ramp, as `RampedProduct` takes them."""
    rising = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, ramp + 1) / ramp)
    return np.concatenate([np.zeros(CELL), rising, np.ones(CELL)]).astype(np.float32)


@compiled
class RampedProduct:
    """The product of a cell: `loops` L (n_rows, CELL) times `gains` G (n_places, n_slots, n_hands), weighted by slot.

    Parameters: rise : weight of gains, from CELL samples before they begin until CELL samples after their ramp.
    """

    def __init__(self, n_rows: int, n_places: int, n_slots: int, n_hands: int, rise: Block) -> None:
        # scipy.linalg is slow to import, and a program that imports a session may never play it.
        from scipy.linalg.blas import sgemm

        self._sgemm = sgemm
        self._rises = np.lib.stride_tricks.sliding_window_view(rise, CELL)
        self.loops: NDArray[np.float32] = np.zeros((n_rows, CELL), dtype=np.float32)
        self.gains: NDArray[np.float32] = np.zeros((n_places, n_slots, n_hands), dtype=np.float32)
        self._P = np.zeros((n_slots, n_hands, CELL), dtype=np.float32)
        self._weights = np.zeros((n_slots, CELL), dtype=np.float32)
        self._weighted = np.zeros((n_slots, CELL), dtype=np.float32)
        self._sum = np.zeros(CELL, dtype=np.float32)
        self._n_rows, self._parts = 0, list[tuple[Block, Block]]()

    def set(self, slot: int, values: Block, places: Sequence[int], n_rows: int) -> None:
        """Set the gains in a slot: values (n_hands, n_loops, n_bands) for the loops at `places`, 0 for other rows below
        `n_rows`."""
        n_bands = values.shape[2]
        rows = np.add.outer(np.array(places, dtype=np.intp) * n_bands, np.arange(n_bands)).ravel()
        self.gains[:n_rows, slot] = 0.0
        self.gains[rows, slot] = values.reshape(len(values), -1).T

    def mix(self, x: Block, n_rows: int, slots: Sequence[int], starts: Sequence[int], begin: int, first: int) -> None:
        """Write x (n_hands, CELL) of a cell that begins at a sample, from its sample `first` on.

        Parameters: n_rows : number of rows of the loops; slots, starts : the gains in use, in order, and the samples at
            which they begin; the ramp of those in the first slot has ended.
        """
        self._multiply(n_rows)
        self._weigh(slots, starts, begin)
        for hand, own in enumerate(x):
            np.multiply(self._P[:, hand], self._weights, out=self._weighted)
            np.add.reduce(self._weighted, axis=0, out=self._sum)
            own[first:] = self._sum[first:]

    def _weigh(self, slots: Sequence[int], starts: Sequence[int], begin: int) -> None:
        self._weights.fill(0.0)
        risen = self._rises[-1]
        for (slot, _), (_, start) in pairwise(zip(slots, starts, strict=True)):
            rising = self._rises[CELL + begin - start]
            np.subtract(risen, rising, out=self._weights[slot])
            risen = rising
        self._weights[slots[-1]] = risen

    def _multiply(self, n_rows: int) -> None:
        """Multiply the gains in all slots by the loops. scipy's BLAS keeps the interpreter's lock."""
        if n_rows != self._n_rows:
            self._arrange(n_rows)
        if not self._parts:
            self._P.fill(0.0)
        P, kept = self._P.reshape(-1, CELL).T, 0.0
        for loops, gains in self._parts:
            self._sgemm(1.0, loops, gains, kept, P, 0, 1, 1)
            kept = 1.0

    def _arrange(self, n_rows: int) -> None:
        """Make the views of the rows in use. They are reused for every product."""
        gains = self.gains.reshape(len(self.gains), -1)
        at_once = max(1, _SMALL_PRODUCT // (gains.shape[1] * CELL))
        spans = [slice(begin, min(begin + at_once, n_rows)) for begin in range(0, n_rows, at_once)]
        self._n_rows, self._parts = n_rows, [(self.loops[span].T, gains[span].T) for span in spans]


class _Held(NamedTuple):
    """Gains in a slot; their ramp begins at `start` and ends at `end`."""

    gains: Gains
    slot: int
    start: int
    end: int


@compiled
class TactileMix:
    """The mix of `n_hands`, cell by cell, into `x` (n_hands, CELL).

    Parameters: ramp : length of the ramp of a change of gains, in samples, >= 1; is_skipping : leave out silent loops.

    If gains come faster than slots become free, they are merged: the newest of them starts when a slot is free. With
    one change per millisecond this does not happen, up to ramps of 35 ms.
    """

    def __init__(self, bank: LoopBank, n_hands: int, ramp: int, x: Block, *, is_skipping: bool = True) -> None:
        self._bank = bank
        self._ramp = ramp
        n_slots = slots_for(ramp, bank.sample_rate_hz)
        self.x = x
        # Gains of loops not in use are written to one extra place behind the places in use.
        n_places = bank.n_rows + bank.n_bands
        self._product = RampedProduct(bank.n_rows, n_places, n_slots, n_hands, rise_over(ramp))
        self._G, self._L = self._product.gains, self._product.loops
        every = range(len(bank))
        silence = Gains(np.zeros((n_hands, 0, bank.n_bands), dtype=np.float32), (), () if is_skipping else every)
        self._free = list(range(n_slots - 1, 0, -1))
        self._held = [_Held(silence, 0, 0, 0)]
        self._waiting: Gains | None = None
        self._loops: list[int] = []
        self._users = [0] * len(bank)
        self._place_of = [len(bank)] * len(bank)
        self._begin = self._from = 0
        self._is_stale = False
        self.n_cells: int = 0
        self.n_rows_mixed: int = 0
        self.n_merged: int = 0
        self._use(silence)

    def enter(self, begin: int) -> None:
        """Enter the cell that begins at a sample."""
        self._begin, self._from, self._is_stale = begin, 0, True
        while len(self._held) > 1 and self._held[1].end <= begin:
            ended = self._held.pop(0)
            self._free.append(ended.slot)
            if ended.gains.heard != self._held[0].gains.heard:
                self._leave(ended.gains)
        self.n_cells += 1
        self.n_rows_mixed += len(self._loops) * self._bank.n_bands
        self._read(0)
        if self._waiting is not None and self._free:
            gains, self._waiting = self._waiting, None
            self.start(gains, begin)

    def start(self, gains: Gains, tick: int) -> None:
        """Start gains at a sample of the present cell."""
        if not self._free:
            self.n_merged += self._waiting is not None
            self._waiting = gains
            return
        # If successive gains use the same loops, their use is counted once.
        if gains.heard != self._held[-1].gains.heard:
            is_more = not all(map(self._users.__getitem__, gains.heard))
            if is_more:
                # With more rows a product may round differently. Samples before this one keep the old product.
                self.compute()
                self._from = tick - self._begin
            first_new = len(self._loops)
            self._use(gains)
            if is_more:
                self._read(first_new)
        held = _Held(gains, self._free.pop(), tick, tick + self._ramp - 1)
        self._held.append(held)
        places = [self._place_of[loop] for loop in gains.loops]
        self._product.set(held.slot, gains.values, places, len(self._loops) * self._bank.n_bands)
        self._is_stale = True

    def compute(self) -> bool:
        """Update `x` with the gains that have started. Returns True if that was necessary."""
        if not self._is_stale:
            return False
        self._is_stale = False
        slots, starts = [held.slot for held in self._held], [held.start for held in self._held]
        n_rows = len(self._loops) * self._bank.n_bands
        self._product.mix(self.x, n_rows, slots, starts, self._begin, self._from)
        return True

    def _read(self, first: int) -> None:
        """Read the loops in use, from the number `first` on."""
        n_bands = self._bank.n_bands
        self._bank.read(self._loops[first:], self._begin, self._L[first * n_bands : len(self._loops) * n_bands])

    def _use(self, gains: Gains) -> None:
        n_bands = self._bank.n_bands
        for loop in gains.heard:
            self._users[loop] += 1
            if self._users[loop] == 1:
                self._place_of[loop] = len(self._loops)
                place = len(self._loops) * n_bands
                self._loops.append(loop)
                self._G[place : place + n_bands] = 0.0

    def _leave(self, gains: Gains) -> None:
        n_bands = self._bank.n_bands
        for loop in gains.heard:
            self._users[loop] -= 1
            if self._users[loop] == 0:
                # The last loop moves to the free place, so that the loops in use stay together.
                at, moved = self._place_of[loop], self._loops.pop()
                self._loops[at : at + 1] = [moved] if moved != loop else []
                self._place_of[moved], self._place_of[loop] = at, len(self._users)
                place, last = at * n_bands, len(self._loops) * n_bands
                self._G[place : place + n_bands] = self._G[last : last + n_bands]
