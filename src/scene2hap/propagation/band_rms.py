"""The root mean square of exp(-L sqrt(2 pi f)) over bands that share their edges, for a few L at a time.

    mean square = 2 / (f2 - f1) * integral from u1 to u2 of u exp(-b u) du,  u = sqrt(f),  b = 2 L sqrt(2 pi)
                = 2 / ((f2 - f1) b^2) * (g(b u1) - g(b u2)),                 g(x) = (1 + x) exp(-x)

The difference of two values of g loses digits where b is small; there the caller's slower formula is taken.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from math import exp, sqrt

import numpy as np
from numpy.typing import NDArray

_MOST = 700.0  # Beyond this exp(-x) is no normal number, which processors handle slowly.
# Least x dx of a band for which the difference keeps 12 digits: it is about x dx exp(-x), with an error of 2e-16.
_LEAST = 1e-3


# Up to so many lengths, plain numbers are quicker than calls of numpy, each of which costs as much as 30 of them.
_FEW = 4


class BandRms:
    """The gains of neighbouring bands between these rising edges [Hz]; `exact` is asked where digits would be lost."""

    def __init__(
        self, edges_hz: tuple[float, ...], exact: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    ) -> None:
        edges = np.array(edges_hz)
        u = np.sqrt(edges)
        self._exact = exact
        b = 2 * math.sqrt(2 * math.pi) * u
        scale = np.sqrt(2 / np.diff(edges) / (8 * math.pi))
        self._minus_b, self._scales = (-b).tolist(), scale.tolist()
        self._minus_edges, self._scale = -b[:, None], scale[:, None]
        self._least = math.sqrt(_LEAST / float((b[:-1] * np.diff(b)).min()))
        self._ones, self._zeros = [1.0] * len(self._scales), [0.0] * len(self._scales)

    def __call__(self, lengths: Sequence[float]) -> NDArray[np.float64]:
        """Gains (n, n_bands) [-] for n lengths, >= 0, may be infinite."""
        if 0 < len(lengths) <= _FEW:
            return np.array([self._row(length) for length in lengths])
        # Looked through one by one, which for a few numbers is quicker than as an array.
        least = self._least
        if min(lengths, default=math.inf) >= least:
            return self._by_difference(np.array(lengths))
        gains = self._by_difference(np.array([x if x >= least else 1.0 for x in lengths]))
        small = [i for i, x in enumerate(lengths) if 0 < x < least]
        if small:
            gains[small] = self._exact(np.array([lengths[i] for i in small]))
        # What touches a source feels all of it, and does so often.
        gains[[i for i, x in enumerate(lengths) if x == 0]] = 1.0
        return gains

    def _row(self, length: float) -> list[float]:
        """The gains for one length."""
        if length >= self._least:
            if length == math.inf:
                return self._zeros
            minus_g = [((minus_x := b * length) - 1.0) * exp(minus_x) for b in self._minus_b]
            edges = zip(minus_g, minus_g[1:], self._scales, strict=False)
            return [sqrt(upper - lower) * scale / length for lower, upper, scale in edges]
        row: list[float] = self._ones if length == 0 else self._exact(np.array([length]))[0].tolist()
        return row

    def _by_difference(self, length: NDArray[np.float64]) -> NDArray[np.float64]:
        # Bands first: what belongs to one edge lies side by side, so that neighbours are subtracted in one stride.
        minus_x = self._minus_edges * length
        np.maximum(minus_x, -_MOST, out=minus_x)
        minus_g = np.exp(minus_x)
        minus_x -= 1
        minus_g *= minus_x
        gains: NDArray[np.float64] = minus_g[1:] - minus_g[:-1]
        np.sqrt(gains, out=gains)
        gains *= self._scale
        gains /= length
        return gains.T
