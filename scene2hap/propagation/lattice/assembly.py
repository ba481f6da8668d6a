"""Assembly of sparse matrices from the small matrices of pieces.

A row's neighbours lie within a few steps of it in the grid. Each of its entries therefore has its own slot, given by
the step and by the number of the copy at that place. The values of all pieces are added up in slots at once, and empty
slots are left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from scene2hap.common.arrays import Floats, Indices

if TYPE_CHECKING:
    from scipy.sparse import csr_array

Block = tuple[Floats, int, int]
"""Values (n_pieces, a, b, c, d), `first` and `other`: rows start at `first` and are counted (a, c), columns start at
`other` and are counted (b, d)."""


class Pattern:
    """Sparsity pattern of the sum of the matrices of all pieces.

    Parameters: number : (n_pieces, k) index of each row and column of a piece among all n; local : (k,) place of each
    in the grid, relative to its piece; place : (n,) place of all in the grid, rising.
    """

    def __init__(self, number: Indices, local: Indices, place: Indices) -> None:
        self._place = place
        copy = copies_of(place)
        self._n_copies = int(copy.max(initial=0)) + 1
        self._copy = copy[number] if self._n_copies > 1 else None
        self._steps, step = np.unique(local - local[:, None], return_inverse=True)
        self._step = step.reshape(len(local), -1)
        self._width = len(self._steps) * self._n_copies
        self._first = number * self._width
        self._at = np.zeros((int(place[-1]) + 1) * self._n_copies, dtype=np.int32)
        self._at[place * self._n_copies + copy] = np.arange(len(place))

    def __len__(self) -> int:
        return len(self._place)

    def summed(self, *matrices: Sequence[Block]) -> tuple[Indices, Indices, list[Floats]]:
        """Sum each of several matrices over all pieces.

        Parameters: matrices : the blocks of each, all in the same order.
        Returns: rows, rising, columns, and the values of each sum at the entries that are not 0 in the first.
        """
        sums = [np.zeros(len(self._place) * self._width) for _ in matrices]
        for several in zip(*matrices, strict=True):
            values, first, other = several[0]
            _, a, b, c, d = values.shape
            i, j, k, m = np.indices((a, b, c, d)).reshape(4, -1)
            row, column = first + c * i + k, other + d * j + m
            slot = np.take(self._first, row, axis=1)
            slot += self._step[row, column] * self._n_copies
            if self._copy is not None:
                slot += np.take(self._copy, column, axis=1)
            for total, (each, _, _) in zip(sums, several, strict=True):
                total += np.bincount(slot.ravel(), each.ravel(), len(total))
        filled = np.flatnonzero(sums[0])
        rows, slots = np.divmod(filled, self._width)
        step, copy = np.divmod(slots, self._n_copies)
        columns = self._at[(self._place[rows] + self._steps[step]) * self._n_copies + copy]
        return rows, columns, [total[filled] for total in sums]


def copies_of(places: Indices) -> Indices:
    """Number of each copy (n,) among those at the same place, given rising places (n,)."""
    copies: Indices = np.arange(len(places)) - np.searchsorted(places, places)
    return copies


def sparse(rows: Indices, columns: Indices, values: Floats, shape: tuple[int, int]) -> csr_array:
    """Return a sparse matrix from its entries, given with rising rows."""
    from scipy.sparse import csr_array

    starts = np.searchsorted(rows, np.arange(shape[0] + 1))
    return csr_array((values, columns.astype(np.int32), starts.astype(np.int32)), shape=shape)
