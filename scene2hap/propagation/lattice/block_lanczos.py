"""The largest eigenvalues of a symmetric operator, by Lanczos' method with several vectors at once.

    C A x = theta x          V^T A V = 1,  T = V^T A C A V,  V the span of X, C A X, (C A)^2 X, ...

A block of vectors takes little more time than one, and equal eigenvalues are found as long as they are no more than a
block is wide. Every block is made orthogonal to all before it: nothing is found twice, and nothing starts again.

Letters: A masses, C compliance, X a block drawn at random, V basis, T projection, theta eigenvalue, x its vector.
Source: G. H. Golub, R. Underwood, The block Lanczos method for computing eigenvalues, Mathematical Software III (1977).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from scipy.sparse import csr_array

WIDTH = 4
"""Vectors in a block: no value of a plate comes more often, the three rigid motions included. Tuned: 3 to 5 are alike,
8 take 15 % longer."""
EXACT = 1e-5
"""Residual of an eigenvector that is good, relative to its value or to the spread of all that are wanted, whichever is
less; the error of its value is about the square."""
_FINEST = 1e-7
"""Part of a value that is the least spread."""
_FIRST_LOOK, _NEXT_LOOK = 2.2, 1.12
"""When T is looked at: once it has so many columns per vector expected, and then so many times as many."""
_ROUNDING = 1e-14
_DEPENDENT = 1e-12
"""Part of the largest square by which a vector must differ from the others of its block."""
_EVEN = 1e-3
"""Smallest of the squares of a block, over the largest, from which one pass makes it orthonormal to 13 digits."""

Floats = NDArray[np.float64]


def largest(compliance: Callable[[Floats], Floats], masses: csr_array, least: float, expected: float) -> Floats:
    """Vectors (n, m) of all eigenvalues above `least`, and of the next one, the largest first; x^T A x = 1.

    Parameters: compliance : C for vectors (n, m); masses : A, sparse, symmetric, positive (n, n); expected : about how
    many there are.
    """
    n = masses.shape[0]
    basis, weighed, projected = np.empty((n, 0)), np.empty((n, 0)), np.empty((0, 0))
    # A start that has been smoothed once: of stiff waves next to nothing is left to be carried along.
    start = compliance(masses @ np.random.default_rng(0).standard_normal((n, min(WIDTH, n))))
    block, image, beyond = _orthonormal(start, masses)
    size, before, look, weight = 0, 0, _FIRST_LOOK * expected + 3 * WIDTH, float(masses.trace())
    while True:
        new = slice(size, size + block.shape[1])
        if new.stop > len(projected):
            room = min(2 * new.stop + math.ceil(3 * expected), n)
            basis, weighed, projected = _grown(basis, n, room), _grown(weighed, n, room), _grown(projected, room, room)
        basis[:, new], weighed[:, new] = block, image
        size = new.stop
        image = compliance(weighed[:, new])
        noise = (_ROUNDING * np.abs(image).max()) ** 2 * weight
        # But for rounding, an image has shares of this block and of the one before only. The second pass takes away
        # what is left of all blocks.
        for first in (before, 0):
            shares = weighed[:, first:size].T @ image
            image -= basis[:, first:size] @ shares
            projected[first:size, new] += shares
        before = new.start
        projected[new, : new.start] = projected[: new.start, new].T
        block, image, beyond = _orthonormal(image, masses, noise)
        is_whole = block.shape[1] == 0
        if size < look and not is_whole:
            continue
        look = _NEXT_LOOK * size
        values, vectors = np.linalg.eigh((projected[:size, :size] + projected[:size, :size].T) / 2)
        count = np.count_nonzero(values > least) + 1
        values, vectors = values[: -count - 1 : -1], vectors[:, : -count - 1 : -1]
        # Values that hardly differ need more digits to differ.
        scale = np.maximum(np.minimum(values, values[0] - values[-1]), _FINEST * values)
        if is_whole or (np.linalg.norm(beyond @ vectors[new], axis=0) <= EXACT * scale).all():
            found: Floats = basis[:, :size] @ vectors
            return found


def _grown(matrix: Floats, n_rows: int, n_columns: int) -> Floats:
    """The matrix with zeros behind its rows and columns; a block of columns is contiguous."""
    larger = np.zeros((n_rows, n_columns), order="F")
    larger[: matrix.shape[0], : matrix.shape[1]] = matrix
    return larger


def _orthonormal(block: Floats, masses: csr_array, least: float = 0.0) -> tuple[Floats, Floats, Floats]:
    """Vectors V (n, m) with V^T A V = 1 that span a block, A V, and R (m, n_block) with block = V R; fewer if some
    depend on the others, or if squares of their lengths are no more than `least`."""
    total = np.eye(block.shape[1])
    for _ in range(2):  # the second pass takes away the rounding of the first
        image = masses @ block
        squares, turned = np.linalg.eigh(block.T @ image)
        kept = squares > max(_DEPENDENT * squares.max(initial=0.0), least)
        root = np.sqrt(squares[kept])
        turned = turned[:, kept]
        block, image = block @ (turned / root), image @ (turned / root)
        total = root[:, None] * turned.T @ total
        if (squares > _EVEN * squares.max(initial=0.0)).all():
            break
        least = 0.0  # lengths are 1 from now on
    return block, image, total
