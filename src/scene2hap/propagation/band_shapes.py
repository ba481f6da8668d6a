"""The rms over bands of what known forces do to a body, as lengths of short vectors.

    g_b(x)^2 = sum over f in b of w_f |u(x, f)|^2 = |R_b Q_b^T s(x)|^2        u(x, f) = sum over i of s_i(x) W_i(f)

In a band a body moves in a few shapes only, those of the modes nearby, however many contacts push it and frequencies
resolve its resonances. Q_b is an orthonormal basis of the columns W(f) of all sources, of which none then misses more
than `CLOSE` of itself, and R_b^T R_b the sum of w_f Q_b^T W W^H Q_b for one source. A basis that holds nearly all of
many columns is found by mixing them at random.

Letters: s shapes [m^-2 or m^2], W weights, u [-], w [-] part of its band that a frequency stands for.
Source: Halko, Martinsson, Tropp, Finding structure with randomness, SIAM Review 53 (2011) 217, algorithm 4.1.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled
from scene2hap.propagation.asked import Gains
from scene2hap.propagation.sampling import Sampling
from scene2hap.propagation.span import Span

CLOSE = 1e-3
"""Part of each source's motion in a band, over the whole body, that may be missed: 60 dB below."""
_MORE = 8
"""Mixed columns over those that the band below needed; twice as many where they do not hold enough."""
_ROUNDING = 1e-13
"""Added to what each shape carries, since a source may need fewer than all sources together."""

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]


@compiled
class BandLengths:
    """Lengths of vectors, several for each of some spaces that stand side by side, in single precision.

    Parameters: sides : from points (n_points, 2) [m] to vectors (n_points, sum of all n_own); factors : R of each
    space, at least one, upper triangles (n, n_own, n_own).
    """

    def __init__(self, sides: Callable[[Floats], NDArray[np.float32]], factors: Sequence[Floats]) -> None:
        self._sides, self._factors = sides, factors

    def __call__(self, points_m: Floats) -> Floats:
        """|R v| at points (n_points, 2) [m]: (n_points, n, n_spaces)."""
        sides, found, begin = self._sides(points_m), [], 0
        for factor in self._factors:
            n, n_own, _ = factor.shape
            own = sides[:, begin : begin + n_own]
            turned = own @ factor.reshape(n * n_own, n_own).T
            found.append(np.sqrt(np.square(turned.reshape(len(own), n, n_own)).sum(axis=2)))
            begin += n_own
        return np.stack(found, axis=-1)


def band_gains(span: Span, forces: Complex, sampling: Sampling) -> Gains:
    """Gains of sources at points of a body, by the forces that each of them makes there.

    Parameters: forces : (n_frequencies, n_forces, n_sources).
    """
    sizes, bases, factors = span.sizes[:, None], [], []
    for band in sampling.bands:
        own = forces[band] * np.sqrt(sampling.weights[band])[:, None, None]
        weights = span.weights(sampling.frequencies_hz[band], own.transpose(1, 2, 0))
        n_before = factors[-1].shape[1] if factors else 0
        basis, factor = _basis(weights.view(np.float64) * sizes[:, :, None], n_before + _MORE)
        bases.append(basis / sizes)
        factors.append(factor)
    # Single precision is a thousand times as good as what is left out, and half of what has to be looked up.
    return BandLengths(span.mixed(np.concatenate(bases, axis=1, dtype=np.float32)), factors)


def _basis(weights: Floats, n_mixed: int) -> tuple[Floats, Floats]:
    """Q (n_shapes, n_own) and R of each source (n_sources, n_own, n_own), of weights (n_shapes, n_sources, n)."""
    n_shapes, n_sources, n = weights.shape
    sizes = np.sqrt(np.square(weights).sum(axis=(0, 2)))
    columns = (weights / np.where(sizes > 0, sizes, 1.0)[:, None]).reshape(n_shapes, n_sources * n)
    basis = _range_of(columns, n_mixed)
    within = basis.T @ columns
    # What little the shapes carry that all sources together need least is left out.
    carried, turned = np.linalg.eigh(within @ within.T)
    few = turned[:, np.cumsum(carried) > CLOSE**2 / 2]
    within = (few.T @ within).reshape(-1, n_sources, n).transpose(1, 0, 2)
    carried = within @ within.transpose(0, 2, 1) + _ROUNDING * np.eye(within.shape[1])
    return basis @ few, np.linalg.cholesky(carried).transpose(0, 2, 1) * sizes[:, None, None]


def _range_of(columns: Floats, n_mixed: int) -> Floats:
    """An orthonormal basis that holds all of some columns (m, n), each source's of length 1, but for half of what may
    be missed."""
    most, whole = min(columns.shape), np.square(columns).sum()
    random = np.random.default_rng(0)
    while n_mixed < most:
        basis, _ = np.linalg.qr(columns @ random.standard_normal((columns.shape[1], n_mixed)))
        if whole - np.square(basis.T @ columns).sum() < CLOSE**2 / 2:
            return basis
        n_mixed *= 2
    return np.linalg.qr(columns)[0] if columns.shape[1] <= len(columns) else np.eye(len(columns))
