"""Receptance of a body among its joints, if it has many.

    Y(x_i, x_j) = sum over modes of phi(x_i) phi(x_j) s(f)  +  sum over m of r_m(x_i, x_j) l_m(f)

A floor with hundreds of contacts has more pairs of joints than a body with few has numbers in all. The terms of all
pairs take n^2 n_modes numbers, gigabytes for 800 joints. Mode shapes take n n_modes, and their products are summed at
one frequency after the other.

Letters: Y [m/N] receptance, phi shape of a mode, r_m shape of a smooth term, s, l_m their spectra, n number of joints.
"""

from __future__ import annotations

from itertools import pairwise
from zlib import crc32

import numpy as np

from scene2hap.common.arrays import Complex, Floats

MOST_PAIRS = 16_384
"""Pairs of joints up to which a body sums the terms of all pairs at all frequencies at once, which is faster."""
_PART = 16
"""Mean number of points in a part of `parts_of`: products of smaller parts take longer, larger ones are computed again
more often."""
_ROWS = 128
"""Rows that are computed at once: the rest of a symmetric matrix is copied."""


def has_many(points_m: Floats) -> bool:
    """Whether a body has so many joints that `among` suits it."""
    return len(points_m) ** 2 > MOST_PAIRS


def parts_of(points_m: Floats) -> list[slice]:
    """Consecutive points (n, 2) in parts of some `_PART`. A part begins at points that depend on their coordinates
    alone, so that a point that comes, goes or moves changes the parts around it, and no others."""
    begins = [i for i, point in enumerate(points_m) if not i or crc32(point.tobytes()) % _PART == 0]
    return [slice(*ends) for ends in pairwise([*begins, len(points_m)])]


def among(shapes: Floats, smooth: Floats, spectrum: Complex) -> Complex:
    """Receptance (n_frequencies, n, n), exactly symmetric.

    Parameters: shapes : (n, n_modes) of the modes; smooth : (n, n, n_smooth) of the other terms, symmetric; spectrum :
    (n_modes + n_smooth, n_frequencies) of the modes, then of the other terms.
    """
    n, n_modes = shapes.shape
    found = np.empty((spectrum.shape[1], n, n), dtype=np.complex128)
    for one, weights in zip(found, spectrum.T, strict=True):
        for begin in range(0, n, _ROWS):
            rows = slice(begin, begin + _ROWS)
            weighted = shapes[rows] * weights[:n_modes]
            # Two real products take half the time of a complex one.
            upper = np.empty((len(weighted), n - begin), dtype=np.complex128)
            upper.real = weighted.real @ shapes[begin:].T + smooth[rows, begin:] @ weights[n_modes:].real
            upper.imag = weighted.imag @ shapes[begin:].T + smooth[rows, begin:] @ weights[n_modes:].imag
            square = upper[:, : len(upper)]
            below = np.tril_indices(len(upper), -1)
            square[below] = square.T[below]
            one[rows, begin:], one[begin:, rows] = upper, upper.T
    return found
