"""Factors of a sparse, symmetric, positive-definite matrix: in a band if that is small, otherwise sparse.

A lattice's nodes are numbered along the shorter side of its grid, so that its matrix is a band of three lines of nodes.
LAPACK factorises a band without a search for an elimination order. With some hundred nodes, this search takes most of
the time of a sparse factorisation.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np

from scene2hap.common.arrays import Floats

if TYPE_CHECKING:
    from scipy.sparse import csr_array
    from scipy.sparse.linalg import SuperLU

MOST_IN_BAND = 200_000
"""Numbers in a band up to which it is faster, because it fits into a processor's cache. Tuned."""


class Factors(Protocol):
    """Factors of a matrix A."""

    def solve(self, rhs: Floats) -> Floats:
        """Solve A x = b for x, with b (n,) or (n, m)."""
        ...


class BandFactors:
    """Cholesky factors of a lower band (n, width), given by columns from the diagonal on. `is_good` says whether the
    matrix was positive definite."""

    def __init__(self, band: Floats) -> None:
        from scipy.linalg import lapack

        self._factors, info = lapack.dpbtrf(band.T, lower=1, overwrite_ab=1)
        self.is_good: bool = info == 0

    def solve(self, rhs: Floats) -> Floats:
        """See `Factors`."""
        from scipy.linalg import lapack

        found: Floats = lapack.dpbtrs(self._factors, rhs, lower=1)[0]
        return found


def positive_factors(matrix: csr_array) -> Factors:
    """Factors of a symmetric, positive-definite matrix."""
    row = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    below = row - matrix.indices
    width = int(below.max(initial=0)) + 1
    if width * matrix.shape[0] <= MOST_IN_BAND:
        band = np.zeros((matrix.shape[0], width))
        is_lower = below >= 0
        band[matrix.indices[is_lower], below[is_lower]] = matrix.data[is_lower]
        factors = BandFactors(band)
        if factors.is_good:
            return factors
    return diagonal_factors(matrix)


def diagonal_factors(matrix: csr_array) -> SuperLU:
    """Sparse factors of a symmetric matrix, with pivots on the diagonal."""
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import splu

    columns = csc_array((matrix.data, matrix.indices, matrix.indptr), shape=matrix.shape)  # its own transpose
    return splu(columns, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
