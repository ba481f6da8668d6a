"""The root mean square of exp(-L sqrt(2 pi f)) over bands that share their edges, for a few L at a time.

    mean square = 2 / (f2 - f1) * integral from u1 to u2 of u exp(-b u) du,  u = sqrt(f),  b = 2 L sqrt(2 pi)
                = 2 / ((f2 - f1) b^2) * (g(b u1) - g(b u2)),                 g(x) = (1 + x) exp(-x)

The difference of two values of g loses digits where b is small; there the caller's slower formula is taken.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled

_MOST = 700.0  # Beyond this exp(-x) is no normal number, which processors handle slowly.
# Least x dx of a band for which the difference keeps 12 digits: it is about x dx exp(-x), with an error of 2e-16.
_LEAST = 1e-3


@compiled
class Differences:
    """The gains by the difference, for lengths at which it loses no digits.

    Parameters: edges : b / L at the edges of the bands, rising; scales : what the root of each band's difference is
    multiplied with; least : the least length that is worked out.
    """

    def __init__(self, edges: NDArray[np.float64], scales: NDArray[np.float64], least: float) -> None:
        # Bands first: what belongs to one edge lies side by side, so that neighbours are subtracted in one stride.
        self._minus_edges, self._scales, self._least = -edges[:, None], scales[:, None], least

    def fill(self, gains: NDArray[np.float64], lengths: Sequence[float]) -> list[int]:
        """Fill gains (n, n_bands) for n lengths, with 1 for those below the least; which of these are not 0."""
        length = np.array(lengths)
        is_small = length < self._least
        length[is_small] = self._least
        minus_x = self._minus_edges * length
        np.maximum(minus_x, -_MOST, out=minus_x)
        minus_g = np.exp(minus_x)
        minus_x -= 1
        minus_g *= minus_x
        found = np.sqrt(minus_g[1:] - minus_g[:-1])
        found *= self._scales
        found /= length
        # What touches a source feels all of it.
        found[:, is_small] = 1.0
        gains[:] = found.T
        return [i for i, x in enumerate(lengths) if 0 < x < self._least]


class BandRms:
    """The gains of neighbouring bands between these rising edges [Hz]; `exact` is asked where digits would be lost."""

    def __init__(
        self, edges_hz: tuple[float, ...], exact: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    ) -> None:
        edges = np.array(edges_hz)
        self._exact = exact
        b = 2 * np.sqrt(2 * math.pi * edges)
        least = math.sqrt(_LEAST / float((b[:-1] * np.diff(b)).min()))
        self._n_bands = len(edges) - 1
        self._differences = Differences(b, np.sqrt(2 / np.diff(edges) / (8 * math.pi)), least)

    def __call__(self, lengths: Sequence[float]) -> NDArray[np.float64]:
        """Gains (n, n_bands) [-] for n lengths, >= 0, may be infinite."""
        gains = np.empty((len(lengths), self._n_bands))
        small = self._differences.fill(gains, lengths)
        if small:
            gains[small] = self._exact(np.array([lengths[i] for i in small]))
        return gains
