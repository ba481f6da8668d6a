"""The mix at the tactile rate: gains that move along raised cosines, and loops, one matrix product at a time.

    x(t) = sum_j (r_j(t) - r_(j+1)(t)) P_j(t)     r_j(t) = r((t - t_j + 1) / T),   r(x) = (1 - cos(pi x)) / 2 on [0, 1]
    P = G L

This is g(t) = g_0 + sum_j (g_j - g_(j-1)) r_j(t) in another order: the gains that are on the way are rows of one
matrix, and nothing is added up over time, so that nothing drifts.

Time is cut in cells of CELL samples, counted from 0. In a cell the products have one shape however `render` is called,
gains that do not count yet weigh 0, and numbers are added in the order of slots; so blocks of any size give the same
bits. Gains whose ramp has ended are dropped at the next cell. Loops that none of the gains lets through are neither
read nor multiplied; that is exact, their products are 0.

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

from scene2hap.render.loop_bank import CELL, LoopBank

Block = NDArray[np.float32]

MOST_SLOTS = 40

_SMALL_PRODUCT = 2**18
"""OpenBLAS starts threads for more multiplications than this, and an audio thread must not wait for them."""


@dataclass(frozen=True, eq=False)
class Gains:
    """Where the mix is going.

    values : (n_hands, n_loops, n_bands) of some loops, 0 for all others; loops : which these are; heard : which loops
    are mixed.
    """

    values: Block
    loops: Sequence[int]
    heard: Sequence[int]

    @classmethod
    def of(cls, values: Block, loops: Sequence[int], heard: Sequence[int] | None = None) -> Gains | None:
        """A copy of gains, looked through on the thread that sets them; None if they are not finite.

        Parameters: heard : all that they let through if None.
        """
        own = np.array(values, dtype=np.float32, order="C")
        # A square may be infinite where its root is not.
        if not math.isfinite(np.vdot(own, own)) and not np.isfinite(own).all():
            return None
        if heard is None:
            is_heard: list[bool] = np.any(own, axis=(0, 2)).tolist()
            heard = [loop for loop, lets_through in zip(loops, is_heard, strict=True) if lets_through]
        return cls(own, loops, heard)


class _Held(NamedTuple):
    """Gains in a slot; their ramp begins at `start` and is over at `end`."""

    gains: Gains
    slot: int
    start: int
    end: int


class TactileMix:
    """The mix of `n_hands`, cell by cell, into `x` (n_hands, CELL).

    Parameters: ramp : samples over which a change of gains is spread, >= 1; is_skipping : leave out silent loops.
    Gains that come faster than the slots empty (one per millisecond does not, up to ramps of 35 ms) are merged: the
    newest of them starts when a slot is free.
    """

    def __init__(self, bank: LoopBank, n_hands: int, ramp: int, x: Block, *, is_skipping: bool = True) -> None:
        # scipy.linalg is slow to import, and whoever imports a session may not play it.
        from scipy.linalg.blas import sgemm

        self._sgemm = sgemm
        self._bank = bank
        self._n_hands = n_hands
        self._ramp = ramp
        rise = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, ramp + 1) / ramp)
        self._rise = np.concatenate([np.zeros(CELL), rise, np.ones(CELL)]).astype(np.float32)
        self._rises = np.lib.stride_tricks.sliding_window_view(self._rise, CELL)
        n_slots = min(MOST_SLOTS, -(-1000 * (ramp + CELL) // bank.sample_rate_hz) + 2)
        n_rows = bank.n_rows
        self.x = x
        # Behind the places of loops in use there is one for gains of loops that are not.
        self._G = np.zeros((n_rows + bank.n_bands, n_slots * n_hands), dtype=np.float32)
        self._columns = [self._G[:, first : first + n_hands].T for first in range(0, n_slots * n_hands, n_hands)]
        self._rows_at = np.arange(len(self._G), dtype=np.intp).reshape(-1, bank.n_bands)
        self._rows = np.zeros((len(bank), bank.n_bands), dtype=np.intp)
        self._rows_are_of: Sequence[int] | None = None
        self._are_rows_all = False
        self._L = np.zeros((n_rows, CELL), dtype=np.float32)
        self._places = list(self._L.reshape(len(bank), bank.n_bands, CELL))
        self._P = np.zeros((n_slots, n_hands, CELL), dtype=np.float32)
        self._P_flat = self._P.reshape(-1, CELL)
        self._weights = np.zeros((n_slots, CELL), dtype=np.float32)
        self._weighted = np.zeros((n_slots, CELL), dtype=np.float32)
        self._sum = np.zeros(CELL, dtype=np.float32)
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
        self._arrange()
        self.n_cells = self.n_rows_mixed = self.n_merged = 0
        self._use(silence)

    def enter(self, begin: int) -> None:
        """Go on to the cell that begins at a sample."""
        self._begin, self._from, self._is_stale = begin, 0, True
        while len(self._held) > 1 and self._held[1].end <= begin:
            ended = self._held.pop(0)
            self._free.append(ended.slot)
            self._leave(ended.gains)
        self.n_cells += 1
        self.n_rows_mixed += len(self._loops) * self._bank.n_bands
        self._read(0)
        if self._waiting is not None and self._free:
            gains, self._waiting = self._waiting, None
            self.start(gains, begin)

    def start(self, gains: Gains, tick: int) -> None:
        """Move to gains from a sample of the present cell on."""
        if not self._free:
            self.n_merged += self._waiting is not None
            self._waiting = gains
            return
        is_more = not all(map(self._users.__getitem__, gains.heard))
        if is_more:
            # With more rows a product may round in another way; what comes before this sample keeps to the old one.
            self.compute()
            self._from = tick - self._begin
        first_new = len(self._loops)
        self._use(gains)
        if is_more:
            self._read(first_new)
        held = _Held(gains, self._free.pop(), tick, tick + self._ramp - 1)
        self._held.append(held)
        rows, n_rows = self._rows_of(gains.loops), len(self._loops) * self._bank.n_bands
        values, own = gains.values.reshape(self._n_hands, -1), self._columns[held.slot]
        if self._are_rows_all:
            own[:, :n_rows] = values
        else:
            own[:, :n_rows] = 0.0
            own[:, rows] = values
        self._is_stale = True

    def compute(self) -> bool:
        """Bring `x` up to date with the gains that have started; true if anything was to do."""
        if not self._is_stale:
            return False
        self._is_stale = False
        self._multiply()
        self._weigh()
        for hand, x in enumerate(self.x):
            np.multiply(self._P[:, hand], self._weights, out=self._weighted)
            np.add.reduce(self._weighted, axis=0, out=self._sum)
            x[self._from :] = self._sum[self._from :]
        return True

    def _weigh(self) -> None:
        """How much of each slot's gains counts: how far they have risen, and those after them have not."""
        self._weights.fill(0.0)
        risen = self._rises[CELL + self._ramp]
        for held, following in pairwise(self._held):
            rising = self._rises[CELL + self._begin - following.start]
            np.subtract(risen, rising, out=self._weights[held.slot])
            risen = rising
        self._weights[self._held[-1].slot] = risen

    def _multiply(self) -> None:
        """Products of the gains in all slots with the loops. scipy's BLAS keeps the interpreter's lock."""
        if not self._parts:
            self._P.fill(0.0)
        kept = 0.0
        for loops, gains in self._parts:
            self._sgemm(1.0, loops, gains, kept, self._P_flat.T, 0, 1, 1)
            kept = 1.0

    def _arrange(self) -> None:
        """Make the views of the rows in use, once rather than for every product."""
        n = len(self._loops) * self._bank.n_bands
        self._rows_are_of = None
        at_once = max(1, _SMALL_PRODUCT // (self._G.shape[1] * CELL))
        spans = [slice(begin, min(begin + at_once, n)) for begin in range(0, n, at_once)]
        self._parts = [(self._L[span].T, self._G[span].T) for span in spans]

    def _rows_of(self, loops: Sequence[int]) -> NDArray[np.intp]:
        """Where the bands of loops are in G; found again only when loops came or went."""
        rows = self._rows[: len(loops)]
        if self._rows_are_of is not loops:
            # "clip" has nothing to clip, and lets numpy do without a buffer.
            places = [self._place_of[loop] for loop in loops]
            self._rows_at.take(places, axis=0, out=rows, mode="clip")
            self._rows_are_of, self._are_rows_all = loops, places == list(range(len(self._loops)))
        return rows.reshape(-1)

    def _read(self, first: int) -> None:
        """Read the loops in use, from one of them on."""
        for loop, part in zip(self._loops[first:], self._places[first:], strict=False):
            self._bank.fill(loop, self._begin, part)

    def _use(self, gains: Gains) -> None:
        n_bands = self._bank.n_bands
        is_new = False
        for loop in gains.heard:
            self._users[loop] += 1
            if self._users[loop] == 1:
                is_new = True
                self._place_of[loop] = len(self._loops)
                place = len(self._loops) * n_bands
                self._loops.append(loop)
                self._G[place : place + n_bands] = 0.0
        if is_new:
            self._arrange()

    def _leave(self, gains: Gains) -> None:
        n_bands = self._bank.n_bands
        is_less = False
        for loop in gains.heard:
            self._users[loop] -= 1
            if self._users[loop] == 0:
                is_less = True
                # The last loop takes the place, so that those in use stay together.
                at, moved = self._place_of[loop], self._loops.pop()
                self._loops[at : at + 1] = [moved] if moved != loop else []
                self._place_of[moved], self._place_of[loop] = at, len(self._users)
                place, last = at * n_bands, len(self._loops) * n_bands
                self._G[place : place + n_bands] = self._G[last : last + n_bands]
        if is_less:
            self._arrange()
