"""Rms over bands of a body's deflection under known forces, as lengths of short vectors.

    g_b(x)^2 = sum over f in b of w_f |u(x, f)|^2 = |R_b Q_b^T P^T s(x)|^2       u(x, f) = sum over i of s_i(x) W_i(f)

In a band a body moves only in a few shapes, those of the modes nearby, for any number of contacts and frequencies. In
all bands together these shapes are few, too. P is an orthonormal basis of all columns W(f), and P Q_b a basis of the
columns in band b; at most `CLOSE` of each source is lost in any band. R_b^T R_b is the sum of w_f (P Q_b)^T W W^H P Q_b
for one source. Random combinations of the columns give a basis that holds nearly all of them.

Letters: s shapes [m^-2 or m^2], W weights, u [-], w [-] part of its band that a frequency represents.
Source: Halko, Martinsson, Tropp, Finding structure with randomness, SIAM Review 53 (2011) 217, algorithm 4.1.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.compiled import compiled
from scene2hap.propagation.bands.sampling import Band, Gains, Sampling
from scene2hap.propagation.elastic_body import ResponseBasis

CLOSE = 1e-3
"""Part of each source's motion in a band, over the whole body, that may be lost: 60 dB below the motion."""
_MISSED = CLOSE**2 / 3
"""Part of the square of each source's motion that each of three steps may lose."""
_MORE = 8
"""Number of random combinations in addition to those that the band below needed; doubled until they hold enough."""
_AT_ONCE = 64
"""Random columns that are drawn at once, and cached."""
_ROUNDING = 1e-13
"""Added to the diagonal of R^T R, since a source may need fewer shapes than all sources together."""


@compiled
class BandLengths:
    """Lengths |R v| of vectors in several spaces, with n factors R for each space, in single precision.

    Parameters: shapes : function from points (n_points, 2) [m] to values (n_points, n_shapes); mixing : (n_shapes, sum
    of all n_own) from these values to the vectors v of all spaces, side by side; factors : R of each space, at least
    one, upper triangles (n, n_own, n_own).
    """

    def __init__(
        self,
        shapes: Callable[[Floats], NDArray[np.float32]],
        mixing: NDArray[np.float32],
        factors: Sequence[Floats],
    ) -> None:
        self._shapes, self._mixing, self._factors = shapes, mixing, factors

    def __call__(self, points_m: Floats) -> Floats:
        """|R v| at points (n_points, 2) [m]: (n_points, n, n_spaces)."""
        sides, found, begin = self._shapes(points_m) @ self._mixing, [], 0
        for factor in self._factors:
            n, n_own, _ = factor.shape
            own = sides[:, begin : begin + n_own]
            turned = own @ factor.reshape(n * n_own, n_own).T
            found.append(np.sqrt(np.square(turned.reshape(len(own), n, n_own)).sum(axis=2)))
            begin += n_own
        return np.stack(found, axis=-1)


def band_gains(response: ResponseBasis, forces: Complex, sampling: Sampling, columns: NDArray[np.intp]) -> Gains:
    """Gains of sources at points of a body, from the contact forces of each source.

    Parameters: forces : (n_frequencies, n_forces, n_sources); columns : (n_sources,) indices of the sources.
    """
    # A shape of size 0, as of a force on an edge that is held, contributes nothing.
    sizes, n_before = np.where(response.sizes > 0, response.sizes, 1.0)[:, None], 0
    bases, carried, factors = [], [], []
    for (at, weights), sources in _spaces(sampling, columns):
        own = forces[at, :, sources] * np.sqrt(weights)[:, None, None]
        moved = response.weights(sampling.frequencies_hz[at], own.transpose(1, 2, 0)).view(np.float64)
        turned, lengths = _of_length_one(moved * sizes[:, :, None])
        basis, share = _few(turned.reshape(len(turned), -1), n_before + _MORE)
        bases.append(basis)
        carried.append(share)
        factors.append(_factors(np.tensordot(basis.T, turned, axes=1)) * lengths[:, None, None])
        n_before = basis.shape[1]
    every = np.concatenate(bases, axis=1)
    common, _ = _few(every * np.concatenate(carried), 2 * n_before + _MORE)
    # Single precision is a thousand times finer than the part left out, and halves the data that a touch reads.
    shapes = response.mixed((common / sizes).astype(np.float32))
    gains = BandLengths(shapes, (common.T @ every).astype(np.float32), factors)
    # Otherwise each source has a space of its own, which is its only band.
    return gains if sampling.is_shared else lambda points_m: gains(points_m).transpose(0, 2, 1)


def _spaces(sampling: Sampling, columns: NDArray[np.intp]) -> Iterator[tuple[Band, slice]]:
    """List each band with its sources."""
    if sampling.is_shared:
        return ((band, slice(None)) for band in sampling.bands)
    return ((sampling.bands[number], slice(k, k + 1)) for k, number in enumerate(columns.tolist()))


def _of_length_one(weights: Floats) -> tuple[Floats, Floats]:
    """Weights (n_shapes, n_sources, n), scaled to length 1 for each source unless 0, and their lengths before."""
    lengths = np.sqrt(np.square(weights).sum(axis=(0, 2)))
    return weights / np.where(lengths > 0, lengths, 1.0)[:, None], lengths


def _few(columns: Floats, n_mixed: int) -> tuple[Floats, Floats]:
    """Orthonormal basis of columns (m, n), up to a loss of twice `_MISSED`, and the length of the columns along each of
    its directions."""
    basis = _range_of(columns, n_mixed)
    within = basis.T @ columns
    squares, turned = np.linalg.eigh(within @ within.T)
    is_kept = np.cumsum(squares) > _MISSED
    return basis @ turned[:, is_kept], np.sqrt(np.maximum(squares[is_kept], 0.0))


def _factors(within: Floats) -> Floats:
    """R of each source (n_sources, n_own, n_own) for columns (n_own, n_sources, n)."""
    own = within.transpose(1, 0, 2)
    squares = own @ own.transpose(0, 2, 1) + _ROUNDING * np.eye(len(within))
    upper: Floats = np.linalg.cholesky(squares).transpose(0, 2, 1).astype(np.float64)
    return upper


def _range_of(columns: Floats, n_mixed: int) -> Floats:
    """Orthonormal basis of columns (m, n), up to a loss of `_MISSED`."""
    most, whole = min(columns.shape), np.square(columns).sum()
    while n_mixed < most:
        basis, _ = np.linalg.qr(columns @ _mixing(columns.shape[1], n_mixed))
        if whole - np.square(basis.T @ columns).sum() < _MISSED:
            return basis
        n_mixed *= 2
    return np.linalg.qr(columns)[0] if columns.shape[1] <= len(columns) else np.eye(len(columns))


@lru_cache(maxsize=16)
def _random(n: int, n_mixed: int) -> Floats:
    return np.random.default_rng(0).standard_normal((n, n_mixed))


def _mixing(n: int, n_mixed: int) -> Floats:
    """Random matrix (n, n_mixed) that combines columns; cached, since drawing it takes as long as the product."""
    return _random(n, -n_mixed // _AT_ONCE * -_AT_ONCE)[:, :n_mixed]
