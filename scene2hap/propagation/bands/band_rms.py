"""The root mean square over bands of exp(-L sqrt(2 pi f)), the paper's attenuation at a path cost L [s^(1/2)].

    mean square = 2 / (f2 - f1) * integral from u1 to u2 of u exp(-b u) du,  u = sqrt(f),  b = 2 L sqrt(2 pi)
                = 2 / ((f2 - f1) b^2) * (g(b u1) - g(b u2)),                 g(x) = (1 + x) exp(-x)

The difference of two values of g loses digits where b is small. There it is computed from functions of b (u2 - u1)
that stay exact as their argument goes to 0, which takes longer.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled

_MOST = 700.0  # Beyond this exp(-x) becomes a denormal number, which processors handle slowly.
# Least x dx of a band for which the difference of g keeps 12 digits: it is about x dx exp(-x), with an error of 2e-16.
_LEAST = 1e-3


def band_rms(costs: NDArray[np.float64], edges_hz: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the gains of any bands to full precision.

    Parameters: costs : L (...) float64 [s^(1/2)], >= 0, may be infinite; edges_hz : (n_bands, 2) [Hz].
    Returns: (..., n_bands) float64 [-], in [0, 1].
    """
    b = 2 * math.sqrt(2 * math.pi) * np.minimum(costs, 1e6)[..., None]  # beyond 1e6 nothing is left of exp(-b u)
    u1, u2 = np.sqrt(edges_hz[:, 0]), np.sqrt(edges_hz[:, 1])
    width = u2 - u1
    x = b * width
    safe = np.where(x < 1e-2, 1.0, x)
    first = np.where(x < 1e-2, 1 - x / 2 + x**2 / 6 - x**3 / 24 + x**4 / 120, -np.expm1(-safe) / safe)
    second = np.where(
        x < 1e-2, 1 / 2 - x / 3 + x**2 / 8 - x**3 / 30 + x**4 / 144, (-np.expm1(-safe) - safe * np.exp(-safe)) / safe**2
    )
    mean_square = 2 * np.exp(-b * u1) * (u1 * width * first + width**2 * second) / (u2**2 - u1**2)
    gains: NDArray[np.float64] = np.sqrt(np.clip(mean_square, 0.0, 1.0))
    gains[costs == 0] = 1.0  # exactly 1: the source itself
    return gains


@compiled
class BandRms:
    """Gains of adjacent bands between rising edges [Hz], for a few path costs at a time.

    They are computed by the difference of g where it keeps 12 digits.
    """

    def __init__(self, edges_hz: Sequence[float]) -> None:
        edges = np.array(edges_hz)
        self._bands_hz = np.stack([edges[:-1], edges[1:]], axis=1)
        b = 2 * np.sqrt(2 * math.pi * edges)
        self._least = math.sqrt(_LEAST / float((b[:-1] * np.diff(b)).min()))
        # Bands first: the values of one edge are contiguous, so that adjacent edges are subtracted in one stride.
        self._minus_edges = -b[:, None]
        self._scales = np.sqrt(2 / np.diff(edges) / (8 * math.pi))[:, None]

    def __call__(self, costs: Sequence[float]) -> NDArray[np.float64]:
        """Gains (n, n_bands) [-] for n costs [s^(1/2)], >= 0, may be infinite."""
        given = np.array(costs)
        small = np.flatnonzero(given < self._least)
        by_difference = given.copy()
        by_difference[small] = self._least
        minus_x = self._minus_edges * by_difference
        np.maximum(minus_x, -_MOST, out=minus_x)
        minus_g = np.exp(minus_x)
        minus_x -= 1
        minus_g *= minus_x
        found = np.sqrt(minus_g[1:] - minus_g[:-1])
        found *= self._scales
        found /= by_difference
        gains: NDArray[np.float64] = np.ascontiguousarray(found.T)
        if small.size:
            gains[small] = band_rms(given[small], self._bands_hz)
        return gains
