"""Block Lanczos method for the largest eigenvalues of a symmetric operator.

    C A x = theta x          V^T A V = 1,  T = V^T A C A V,  V the span of X, C A X, (C A)^2 X, ...

A block of vectors takes little more time than one vector. Equal eigenvalues are found if there are no more of them than
vectors in a block. Every block is made orthogonal to all blocks before it, so that no eigenvalue is found twice and no
restart is needed.

Letters: A masses, C compliance, X a block drawn at random, V basis, T projection, theta eigenvalue, x its eigenvector.
Source: G. H. Golub, R. Underwood, The block Lanczos method for computing eigenvalues, Mathematical Software III (1977).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from scene2hap.common.arrays import Floats

if TYPE_CHECKING:
    from scipy.sparse import csr_array

WIDTH = 4
"""Vectors in a block: no eigenvalue of a plate has a higher multiplicity, the three rigid motions included. Tuned: 3 to
5 are equally fast, 8 take 15 % longer."""
EXACT = 1e-5
"""Largest residual of an accepted eigenvector, relative to its eigenvalue or to the spread of all wanted eigenvalues,
whichever is less. The error of the eigenvalue is about the square of the residual."""
_FINEST = 1e-7
"""Least spread that counts, relative to the eigenvalue."""
_FIRST_LOOK, _NEXT_LOOK = 2.2, 1.12
"""Columns of T per expected vector when T is first solved, and the factor by which T grows until the next time."""
_ROUNDING = 1e-14
_DEPENDENT = 1e-12
"""Least square of the length of an independent vector of a block, relative to the largest (eigenvalues of X^T A X)."""
_EVEN = 1e-3
"""Ratio of the smallest to the largest square from which one pass makes a block orthonormal to 13 digits."""


def largest(compliance: Callable[[Floats], Floats], masses: csr_array, least: float, expected: float) -> Floats:
    """Eigenvectors (n, m) of all eigenvalues above `least`, and of the next one, the largest first; x^T A x = 1.

    Parameters: compliance : C for vectors (n, m); masses : A, sparse, symmetric, positive definite (n, n); expected :
    approximate number of these eigenvalues.
    """
    n = masses.shape[0]
    basis, weighed, projected = np.empty((n, 0)), np.empty((n, 0)), np.empty((0, 0))
    # The start is smoothed once, which leaves next to nothing of stiff waves.
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
        # Apart from rounding, an image has components along this block and the block before only. The second pass
        # removes the remainders along all blocks.
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
        # Eigenvalues that are close together need smaller residuals.
        scale = np.maximum(np.minimum(values, values[0] - values[-1]), _FINEST * values)
        if is_whole or (np.linalg.norm(beyond @ vectors[new], axis=0) <= EXACT * scale).all():
            found: Floats = basis[:, :size] @ vectors
            return found


def _grown(matrix: Floats, n_rows: int, n_columns: int) -> Floats:
    """Enlarge a matrix by zero rows and columns; a block of columns is contiguous."""
    larger = np.zeros((n_rows, n_columns), order="F")
    larger[: matrix.shape[0], : matrix.shape[1]] = matrix
    return larger


def _orthonormal(block: Floats, masses: csr_array, least: float = 0.0) -> tuple[Floats, Floats, Floats]:
    """Make a block orthonormal: V (n, m) with V^T A V = 1 that span the block, A V, and R (m, n_block) with block = V
    R. There are fewer vectors if some depend on the others, or if squares of their lengths are no more than `least`."""
    total = np.eye(block.shape[1])
    for _ in range(2):  # the second pass removes the rounding of the first
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
