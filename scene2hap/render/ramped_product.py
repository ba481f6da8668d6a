"""Loops times gains that are on the way, for one cell: x(t) = sum_j w_j(t) G_j L(t).

w_j is how much of the gains in slot j counts: how far they have risen, and those after them have not.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled
from scene2hap.render.loop_bank import CELL

Block = NDArray[np.float32]

_SMALL_PRODUCT = 2**18
"""OpenBLAS starts threads for more multiplications than this, and an audio thread must not wait for them."""


@compiled
class RampedProduct:
    """`loops` L (n_rows, CELL), and `gains` G (n_places, n_slots, n_hands), of which the first n_rows are multiplied.

    Parameters: rise : what of gains counts, from CELL samples before they begin to until CELL samples after they have
    risen.
    """

    def __init__(self, n_rows: int, n_places: int, n_slots: int, n_hands: int, rise: Block) -> None:
        # scipy.linalg is slow to import, and whoever imports a session may not play it.
        from scipy.linalg.blas import sgemm

        self._sgemm = sgemm
        self._rises = np.lib.stride_tricks.sliding_window_view(rise, CELL)
        self.loops = np.zeros((n_rows, CELL), dtype=np.float32)
        self.gains = np.zeros((n_places, n_slots, n_hands), dtype=np.float32)
        self._P = np.zeros((n_slots, n_hands, CELL), dtype=np.float32)
        self._weights = np.zeros((n_slots, CELL), dtype=np.float32)
        self._weighted = np.zeros((n_slots, CELL), dtype=np.float32)
        self._sum = np.zeros(CELL, dtype=np.float32)
        self._n_rows, self._parts = 0, list[tuple[Block, Block]]()

    def set(self, slot: int, values: Block, places: Sequence[int], n_rows: int) -> None:
        """Set the gains in a slot to values (n_hands, n_loops, n_bands) of the loops at these places, and to 0 up to a
        row."""
        n_bands = values.shape[2]
        rows = np.add.outer(np.array(places, dtype=np.intp) * n_bands, np.arange(n_bands)).ravel()
        self.gains[:n_rows, slot] = 0.0
        self.gains[rows, slot] = values.reshape(len(values), -1).T

    def mix(self, x: Block, n_rows: int, slots: Sequence[int], starts: Sequence[int], begin: int, first: int) -> None:
        """Write x (n_hands, CELL) of a cell that begins at a sample, from its sample `first` on.

        Parameters: n_rows : how many rows of the loops there are; slots, starts : which gains count, in their order,
        and at what samples they begin to; those in the first slot have risen.
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
        """Products of the gains in all slots with the loops. scipy's BLAS keeps the interpreter's lock."""
        if n_rows != self._n_rows:
            self._arrange(n_rows)
        if not self._parts:
            self._P.fill(0.0)
        P, kept = self._P.reshape(-1, CELL).T, 0.0
        for loops, gains in self._parts:
            self._sgemm(1.0, loops, gains, kept, P, 0, 1, 1)
            kept = 1.0

    def _arrange(self, n_rows: int) -> None:
        """Make the views of the rows in use, once rather than for every product."""
        gains = self.gains.reshape(len(self.gains), -1)
        at_once = max(1, _SMALL_PRODUCT // (gains.shape[1] * CELL))
        spans = [slice(begin, min(begin + at_once, n_rows)) for begin in range(0, n_rows, at_once)]
        self._n_rows, self._parts = n_rows, [(self.loops[span].T, gains[span].T) for span in spans]
