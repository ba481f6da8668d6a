"""The rms of a body's deflection under known forces over bands, as lengths of short vectors.

    g_b(x)^2 = sum over f in b of w_f |u(x, f)|^2 = |R_b Q_b^T P^T s(x)|^2       u(x, f) = sum over i of s_i(x) W_i(f)

In a band a body moves in a few shapes only, those of the modes nearby, however many contacts push it and frequencies
resolve its resonances; and these are few in all bands together. P is an orthonormal basis of all columns W(f), P Q_b
one of those in a band, so that no source misses more than `CLOSE` of itself in any band, and R_b^T R_b the sum of
w_f (P Q_b)^T W W^H P Q_b for one source. A basis that holds nearly all of many columns is found by mixing them at
random.

Letters: s shapes [m^-2 or m^2], W weights, u [-], w [-] part of its band that a frequency stands for.
Source: Halko, Martinsson, Tropp, Finding structure with randomness, SIAM Review 53 (2011) 217, algorithm 4.1.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled
from scene2hap.propagation.bands.sampling import Band, Sampling
from scene2hap.propagation.coupled.object_response import Gains
from scene2hap.propagation.coupled.response_basis import ResponseBasis

CLOSE = 1e-3
"""Part of each source's motion in a band, over the whole body, that may be missed: 60 dB below."""
_MISSED = CLOSE**2 / 3
"""Of the square of each source's motion, by each of three steps."""
_MORE = 8
"""Mixed columns over those that the band below needed; twice as many where they do not hold enough."""
_AT_ONCE = 64
"""Random columns that are drawn at once, and kept."""
_ROUNDING = 1e-13
"""Added to what each shape carries, since a source may need fewer than all sources together."""

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]


@compiled
class BandLengths:
    """Lengths of vectors, several for each of some spaces, in single precision.

    Parameters: shapes : from points (n_points, 2) [m] to values (n_points, n_shapes); mixing : from these to vectors in
    all spaces side by side (n_shapes, sum of all n_own); factors : R of each space, at least one, upper triangles (n,
    n_own, n_own).
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


class SourceLengths:
    """Lengths of vectors, with a space for each source."""

    def __init__(self, lengths: BandLengths) -> None:
        self._lengths = lengths

    def __call__(self, points_m: Floats) -> Floats:
        """|R v| at points (n_points, 2) [m]: (n_points, n_spaces, 1)."""
        return self._lengths(points_m).transpose(0, 2, 1)


def band_gains(response: ResponseBasis, forces: Complex, sampling: Sampling, columns: NDArray[np.intp]) -> Gains:
    """Gains of sources at points of a body, from the contact forces of each source.

    Parameters: forces : (n_frequencies, n_forces, n_sources); columns : (n_sources,) the sources' numbers.
    """
    sizes, n_before = response.sizes[:, None], 0
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
    # Single precision is a thousand times as good as what is left out, and half of what has to be looked up.
    shapes = response.mixed((common / sizes).astype(np.float32))
    lengths_of_bands = BandLengths(shapes, (common.T @ every).astype(np.float32), factors)
    return lengths_of_bands if sampling.is_shared else SourceLengths(lengths_of_bands)


def _spaces(sampling: Sampling, columns: NDArray[np.intp]) -> Iterator[tuple[Band, slice]]:
    """List each band with its sources."""
    if sampling.is_shared:
        return ((band, slice(None)) for band in sampling.bands)
    return ((sampling.bands[number], slice(k, k + 1)) for k, number in enumerate(columns.tolist()))


def _of_length_one(weights: Floats) -> tuple[Floats, Floats]:
    """Weights (n_shapes, n_sources, n), those of each source together of length 1 unless 0, and their lengths."""
    lengths = np.sqrt(np.square(weights).sum(axis=(0, 2)))
    return weights / np.where(lengths > 0, lengths, 1.0)[:, None], lengths


def _few(columns: Floats, n_mixed: int) -> tuple[Floats, Floats]:
    """An orthonormal basis of some columns (m, n) but for twice what one step may miss, and how long they are along
    each of its directions."""
    basis = _range_of(columns, n_mixed)
    within = basis.T @ columns
    squares, turned = np.linalg.eigh(within @ within.T)
    is_kept = np.cumsum(squares) > _MISSED
    return basis @ turned[:, is_kept], np.sqrt(np.maximum(squares[is_kept], 0.0))


def _factors(within: Floats) -> Floats:
    """R of each source (n_sources, n_own, n_own) of columns (n_own, n_sources, n)."""
    own = within.transpose(1, 0, 2)
    squares = own @ own.transpose(0, 2, 1) + _ROUNDING * np.eye(len(within))
    upper: Floats = np.linalg.cholesky(squares).transpose(0, 2, 1).astype(np.float64)
    return upper


def _range_of(columns: Floats, n_mixed: int) -> Floats:
    """An orthonormal basis of some columns (m, n) but for what one step may miss."""
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
    """Random numbers (n, n_mixed) by which columns are mixed; drawing them takes as long as mixing."""
    return _random(n, -n_mixed // _AT_ONCE * -_AT_ONCE)[:, :n_mixed]
