"""Sums over many modes at many frequencies, octave by octave.

    sum over n of a_n / (k_n^4 - q)          q = k^4 / (1 + j eta)

Within an octave, what modes far above it say is so smooth in q that its values at `N_NODES` places, and the polynomials
through them, give it to a part in 10^12: modes from 1.5 times the octave's top frequency on lie at 2.25 times its
highest q or beyond, where each of Chebyshev's nodes gains a factor of 6.9. So the lower octaves, which hold most
frequencies of third-octave bands, need a few modes each, and the sum half of the products.

Letters: a shapes [m^-2], k [rad/m], q [m^-4], eta [-].
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

N_NODES = 16
FAR = 2.25
"""k_n^4 over the highest q of an octave from which a mode is far above it."""
CLOSE = 1e-12
"""Part by which the polynomials may be wrong; where great losses turn q away from the nodes, every mode is summed."""
FEWEST = 64
"""Frequencies below which octaves cost more than they save."""

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class _Octave:
    """Frequencies begin..end.

    n_near : how many of the lowest modes are summed one by one; far : (n_far, N_NODES) value of all others at the
    nodes; spectra : of near modes, nodes and whatever else is summed, real and imaginary part by turns.
    """

    begin: int
    end: int
    n_near: int
    far: Floats
    spectra: Floats


class OctaveSums:
    """Sums of terms: modes k_n^4 (n_modes,), rising, and others that are smooth over all frequencies, by their spectra
    (n_others, n_f), at q (n_f,); all times `scale`."""

    def __init__(self, k4: Floats, others: Complex, q: Complex, scale: complex) -> None:
        self._octaves = [_octave(k4, others, q, scale, *ends) for ends in _ends(k4, np.abs(q))]
        self._n_frequencies = len(q)
        n_modes, n_terms = len(k4), len(k4) + len(others)
        split = [one for one in self._octaves if len(one.far)]
        # Sums of far modes stand behind the terms; each octave takes its near modes, its nodes and the others.
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
        """The same, by parts of the frequencies."""
        if len(self._octaves) > 1 or self._far.size:
            terms = np.concatenate([terms, terms @ self._far], axis=1).take(self._taken, axis=1)
        for one, ends in zip(self._octaves, pairwise(self._ends), strict=True):
            yield slice(one.begin, one.end), (terms[:, slice(*ends)] @ one.spectra).view(np.complex128)


def _ends(k4: Floats, size: Floats) -> list[tuple[int, int]]:
    """Where octaves of frequency, a factor of 4 of q, begin and end, the highest first; the last holds all frequencies
    that need few modes. They are one if they do not rise."""
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
    """The polynomials through one node each (n_nodes, n_f), in their barycentric form."""
    n = len(nodes)
    weights = (-1.0) ** np.arange(n) * np.sin(np.pi * (np.arange(n) + 0.5) / n)
    with np.errstate(all="ignore"):  # on a node, to the last bit, it is not a number, and not taken
        shares = weights[:, None] / (q - nodes[:, None])
        between: Complex = shares / shares.sum(axis=0)
    return between
