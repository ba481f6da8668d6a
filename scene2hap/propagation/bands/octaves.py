"""Sums over many modes at many frequencies, octave by octave.

    sum over n of a_n / (k_n^4 - q)          q = k^4 / (1 + j eta)

Within an octave, the sum over modes far above it is smooth in q. Chebyshev interpolation from `N_NODES` nodes gives it
to a part in 10^12: modes from 1.5 times the octave's top frequency on lie at 2.25 times its highest q or beyond. There
each node improves the interpolation by a factor of 6.9. The lower octaves, which hold most frequencies of third-octave
bands, therefore need a few modes each, and the whole sum needs half of the products.

Letters: a shapes [m^-2], k [rad/m], q [m^-4], eta [-].
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from scene2hap.common.arrays import Complex, Floats

N_NODES = 16
FAR = 2.25
"""Ratio of k_n^4 to the highest q of an octave from which on a mode is far above the octave."""
CLOSE = 1e-12
"""Largest relative error of the interpolation; where high losses move q away from the nodes, every mode is summed."""
FEWEST = 64
"""Number of frequencies below which octaves cost more than they save."""


@dataclass(frozen=True, eq=False)
class _Octave:
    """One octave: the frequencies from index begin to end.

    n_near : number of the lowest modes that are summed one by one; far : (n_far, N_NODES) values of all other modes at
    the nodes; spectra : of near modes, nodes and the other terms, real and imaginary parts interleaved.
    """

    begin: int
    end: int
    n_near: int
    far: Floats
    spectra: Floats


class OctaveSums:
    """Sums of terms at many frequencies: first modes, then terms that are smooth over all frequencies.

    Parameters: k4 : (n_modes,) k_n^4 of the modes, rising; others : (n_others, n_f) spectra of the smooth terms; q :
    (n_f,); scale : factor of all sums.
    """

    def __init__(self, k4: Floats, others: Complex, q: Complex, scale: complex) -> None:
        self._octaves = [_octave(k4, others, q, scale, *ends) for ends in _ends(k4, np.abs(q))]
        self._n_frequencies = len(q)
        n_modes, n_terms = len(k4), len(k4) + len(others)
        split = [one for one in self._octaves if len(one.far)]
        # Sums of far modes follow the terms; each octave takes its near modes, its nodes and the other terms.
        self._far = np.zeros((n_terms, N_NODES * len(split)))
        taken, self._ends = [], [0]
        for one in self._octaves:
            nodes = np.arange(0)
            if len(one.far):
                first = N_NODES * split.index(one)
                self._far[one.n_near : n_modes, first : first + N_NODES] = one.far
                nodes = n_terms + first + np.arange(N_NODES)
            taken.append(np.concatenate([np.arange(one.n_near), nodes, np.arange(n_modes, n_terms)]))
            self._ends.append(self._ends[-1] + len(taken[-1]))
        self._taken = np.concatenate(taken)

    @property
    def nbytes(self) -> int:
        """Memory of the sums [byte]."""
        return self._far.nbytes + sum(one.far.nbytes + one.spectra.nbytes for one in self._octaves)

    def __call__(self, terms: Floats) -> Complex:
        """Sums (n, n_f) of terms (n, n_modes + n_others)."""
        sums = np.empty((len(terms), self._n_frequencies), dtype=np.complex128)
        for part, own in self.pieces(terms):
            sums[:, part] = own
        return sums

    def pieces(self, terms: Floats) -> Iterator[tuple[slice, Complex]]:
        """Yield the sums in parts: a slice of the frequencies, and the sums there."""
        if len(self._octaves) > 1 or self._far.size:
            terms = np.concatenate([terms, terms @ self._far], axis=1).take(self._taken, axis=1)
        for one, ends in zip(self._octaves, pairwise(self._ends), strict=True):
            yield slice(one.begin, one.end), (terms[:, slice(*ends)] @ one.spectra).view(np.complex128)


def _ends(k4: Floats, size: Floats) -> list[tuple[int, int]]:
    """Indices at which octaves of frequency (a factor of 4 in q) begin and end, the highest first. The last one holds
    all frequencies that need few modes. All are one octave if they do not rise or are fewer than `FEWEST`."""
    end, ends = len(size), []
    if end < FEWEST or (np.diff(size) <= 0).any():
        return [(0, end)]
    while end > 0:
        top = size[end - 1]
        is_last = np.searchsorted(k4, FAR * top) <= N_NODES
        begin = 0 if is_last else min(int(np.searchsorted(size, top / 4)), end - 1)
        ends.append((begin, end))
        end = begin
    return ends


def _octave(k4: Floats, others: Complex, q: Complex, scale: complex, begin: int, end: int) -> _Octave:
    q, others = q[begin:end], others[:, begin:end]
    top = float(np.abs(q).max(initial=0.0))
    n_near, far, between = int(np.searchsorted(k4, FAR * top)), np.zeros((0, N_NODES)), others[:0]
    if len(q) and len(k4) - n_near > N_NODES:
        nodes = top / 2 * (1 - np.cos(np.pi * (np.arange(N_NODES) + 0.5) / N_NODES))
        far, between, exact = 1 / (k4[n_near:, None] - nodes), _between(nodes, q), 1 / (k4[n_near] - q)
        if not np.abs(far[0] @ between - exact).max() <= CLOSE * np.abs(exact).max():
            far, between = far[:0], others[:0]
    if not len(far):
        n_near = len(k4)
    spectra = np.concatenate([1 / (k4[:n_near, None] - q), between, others])
    spectra *= scale
    return _Octave(begin, end, n_near, far, spectra.view(np.float64))


def _between(nodes: Floats, q: Complex) -> Complex:
    """Lagrange polynomials of the nodes (n_nodes, n_f), in barycentric form."""
    n = len(nodes)
    weights = (-1.0) ** np.arange(n) * np.sin(np.pi * (np.arange(n) + 0.5) / n)
    with np.errstate(all="ignore"):  # exactly on a node the result is NaN, and is not used
        shares = weights[:, None] / (q - nodes[:, None])
        between: Complex = shares / shares.sum(axis=0)
    return between
