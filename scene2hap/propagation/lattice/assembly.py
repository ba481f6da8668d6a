"""Sums of small matrices of pieces in sparse ones.

A row's neighbours lie within a few steps of it in the grid, so that each of its entries has a slot of its own: which
step, and which copy of what is there. Values are added up in slots, all pieces at once, and the empty ones left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from scipy.sparse import csr_array

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]
Block = tuple[Floats, int, int]
"""Values (n_pieces, a, b, c, d) of the rows from `first` on, counted (a, c), and the columns from `other` on, counted
(b, d); `first` and `other`."""


class Pattern:
    """Where the matrices of all pieces add up.

    Parameters: number : of each row and column of a piece (n_pieces, k), among n; local : its place in the grid,
    relative to its piece (k,); place : of each of the n, rising.
    """

    def __init__(self, number: Ints, local: Ints, place: Ints) -> None:
        self._number, self._place = number, place
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

    def summed(self, *matrices: Sequence[Block]) -> tuple[Ints, Ints, list[Floats]]:
        """Rows, columns and values of the sums over all pieces of matrices given by their blocks, each in order.
        Entries are those that are not 0 in the first."""
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


def copies_of(places: Ints) -> Ints:
    """Which copy each one is (n,) of those at the same place, given the places (n,), rising."""
    copies: Ints = np.arange(len(places)) - np.searchsorted(places, places)
    return copies


def sparse(rows: Ints, columns: Ints, values: Floats, shape: tuple[int, int]) -> csr_array:
    """A sparse matrix from its entries, their rows rising."""
    from scipy.sparse import csr_array

    starts = np.searchsorted(rows, np.arange(shape[0] + 1))
    return csr_array((values, columns.astype(np.int32), starts.astype(np.int32)), shape=shape)
