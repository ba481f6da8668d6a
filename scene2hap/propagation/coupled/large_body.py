"""Solver for the joints of a scene in which one body has hundreds of them, such as a floor with many objects on it.

The matrix of all joints is then nearly full, but it has structure. With the large body's receptance among its joints as
a sum over modes and a remainder that is smooth in frequency (`SeparatedReceptance`),

    A = D + Phi S Phi^T + E          A g = b

D has a block for each group of joints that are connected without the large body, as the feet of one object: the other
bodies, the compliances of the joints, and the remainder within the block. E is the remainder between blocks. It is
small compared with the compliance of the joints, so that conjugate residuals converge in some ten steps with the
preconditioner

    P = D + Phi S Phi^T          P^-1 = D^-1 - D^-1 Phi (S^-1 + Phi^T D^-1 Phi)^-1 Phi^T D^-1

E is a sum of the same few real matrices at all frequencies, so that one real product serves all of them. No full matrix
is factored, nor is the receptance of the large body computed at any frequency.

Letters: A, D, E [m/N], g [N/m] forces, b [-] free deflections (see `coupling`), Phi shapes of the modes at the joints,
S their modal receptances.
Source: Eisenstat, Elman, Schultz, SIAM J. Numer. Anal. 20 (1983) 345, generalized conjugate residuals; Woodbury's
identity for P^-1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.propagation.coupled.elimination import Element, slack
from scene2hap.propagation.elastic_body import SeparatedReceptance, real_times

CONVERGED = 1e-12
"""Residual of the preconditioned system, relative to its right side, at which a column is solved."""
WRONG = 1e-10
"""Residual of A g = b itself, relative to b, above which a column is not solved."""
MOST_STEPS = 48
"""Most steps; more would take as long as LAPACK."""
_PROMISING = 12
"""Steps after which a solution is given up if no column is converging fast enough for `MOST_STEPS`."""
AT_ONCE_BYTES = 64_000_000
"""Memory of all steps of the columns that are solved at once."""
_MODES_AT_ONCE = 64
"""Rows of a symmetric product that are computed at once: what is left of the diagonal is a copy."""


def blocks_of(elements: Sequence[NDArray[np.intp]]) -> list[NDArray[np.intp]]:
    """Return the groups of rows that elements, given by their rows, connect."""
    group_of: dict[int, list[int]] = {}
    for rows in elements:
        parts = {id(own): own for row in rows.tolist() for own in [group_of.setdefault(row, [row])]}
        merged = [row for own in parts.values() for row in own]
        group_of |= dict.fromkeys(merged, merged)
    return [np.sort(own) for own in {id(own): own for own in group_of.values()}.values()]


def is_faster(large: SeparatedReceptance, others: Sequence[NDArray[np.intp]]) -> bool:
    """Whether this solver takes less time than LAPACK for a nearly full matrix, from the rows of all other bodies."""
    n, n_modes = large.shapes.shape
    largest = max(len(block) for block in blocks_of(others))
    return bool(3 * n_modes <= 2 * n) and 4 * largest <= n


def solve(
    large: SeparatedReceptance,
    rows: NDArray[np.intp],
    signs: Floats,
    others: Sequence[Element],
    compliance: Complex,
    free: Floats,
    wanted: NDArray[np.bool_],
) -> tuple[Complex, NDArray[np.bool_]]:
    """Forces (n, n_sources, n_f) where they are wanted, 0 elsewhere, and whether each frequency is solved (n_f,).

    Parameters: rows, signs : of the large body, as in `Element`; others : all other bodies; compliance : (n, n_f)
    [m/N]; free : (n, n_sources); wanted : (n_sources, n_f).
    """
    n, n_f = compliance.shape
    forces, good = np.zeros((n, free.shape[1], n_f), dtype=np.complex128), np.ones(n_f, dtype=bool)
    matrices = _matrices(large, rows, signs, others, compliance)
    n_columns = max(1, int(wanted.sum(axis=0).max(initial=0)))
    at_once = max(1, AT_ONCE_BYTES // (16 * n * MOST_STEPS * n_columns))
    for begin in range(0, n_f, at_once):
        source, at = np.nonzero(wanted[:, begin : begin + at_once])
        if len(at):
            columns = _Columns(matrices, begin + at)
            found, is_solved = columns.solved(free[:, source].astype(np.complex128))
            forces[:, source, begin + at] = found
            good[begin + at[~is_solved]] = False
    return forces, good


@dataclass(frozen=True, eq=False)
class _Matrices:
    """D, Phi, S and E at all frequencies.

    blocks : by size m, the rows (n_blocks, m) and D (n_blocks, m, m, n_f); shapes : Phi (n, n_modes); resonance : S
    (n_modes, n_f); rows : of the large body (n_own,); rest : E (n_own, n_smooth n_own), for the spectra `between`
    (n_smooth, n_f).
    """

    blocks: Sequence[tuple[NDArray[np.intp], Complex]]
    shapes: Floats
    resonance: Complex
    rows: NDArray[np.intp]
    rest: Floats
    between: Complex


def _matrices(
    large: SeparatedReceptance, rows: NDArray[np.intp], signs: Floats, others: Sequence[Element], compliance: Complex
) -> _Matrices:
    n, n_f = compliance.shape
    shapes = np.zeros((n, large.shapes.shape[1]))
    shapes[rows] = signs[:, None] * large.shapes
    rest = np.multiply(large.smooth.transpose(0, 2, 1), signs, order="C")
    rest *= signs[:, None, None]
    by_size: dict[int, list[NDArray[np.intp]]] = {}
    for block in blocks_of([one.rows for one in others]):
        by_size.setdefault(len(block), []).append(block)
    diagonal, place = compliance + slack(others, compliance.shape), np.full(n, -1)
    place[rows] = np.arange(len(rows))
    blocks, part_of, place_in = [], dict[int, Complex](), np.empty(n, dtype=np.intp)
    among = rest.transpose(0, 2, 1)
    for m, several in by_size.items():
        d = np.zeros((len(several), m, m, n_f), dtype=np.complex128)
        for part, block in zip(d, several, strict=True):
            part[np.arange(m), np.arange(m)] = diagonal[block]
            inside = np.flatnonzero(place[block] >= 0)
            square = np.ix_(place[block[inside]], place[block[inside]])
            part[np.ix_(inside, inside)] += among[square] @ large.between
            among[square] = 0.0
            for i, row in enumerate(block.tolist()):
                part_of[row], place_in[row] = part, i
        blocks.append((np.array(several), d))
    for one in others:
        at = place_in[one.rows]
        signed = np.multiply.outer(one.signs, one.signs)[..., None] * one.receptance.transpose(1, 2, 0)
        part_of[int(one.rows[0])][np.ix_(at, at)] += signed
    return _Matrices(blocks, shapes, large.resonance, rows, rest.reshape(len(rest), -1), large.between)


class _Columns:
    """A system A g = b for each column, at its frequency. Columns of one frequency are next to each other.

    Parameters: at : (n_columns,) frequency of each column.
    """

    def __init__(self, matrices: _Matrices, at: NDArray[np.intp]) -> None:
        from scipy.linalg.lapack import zgetrf

        self._of, self._at = matrices, at
        self._between = matrices.between[:, at]
        which, number = np.unique(at, return_inverse=True)
        self._each = [np.flatnonzero(number == k) for k in range(len(which))]
        inverses = [np.linalg.inv(d[..., which].transpose(3, 0, 1, 2)) for _, d in matrices.blocks]
        self._factors = [
            zgetrf(_among_modes(matrices, [one[k] for one in inverses], f).T, overwrite_a=1)[:2]
            for k, f in enumerate(which.tolist())
        ]
        self._inverses = [np.ascontiguousarray(one.transpose(1, 2, 3, 0)[..., number]) for one in inverses]

    def solved(self, free: Complex) -> tuple[Complex, NDArray[np.bool_]]:
        """Solutions (n, n_columns) for right sides b, and whether each is solved; all columns at once."""
        left = self._preconditioned(free)
        size, found = np.linalg.norm(left, axis=0), np.zeros_like(left)
        steps: list[tuple[Complex, Complex]] = []
        while len(steps) < MOST_STEPS:
            residual = np.linalg.norm(left, axis=0)
            is_late = residual > CONVERGED ** (len(steps) / MOST_STEPS) * size
            if (residual <= CONVERGED * size).all() or (len(steps) >= _PROMISING and is_late.all()):
                break
            step, image = left.copy(), left + self._preconditioned(self._rest(left))
            for one, its in steps:
                share = _inner(its, image)
                step -= share * one
                image -= share * its
            length = np.linalg.norm(image, axis=0)
            length[length == 0] = 1.0
            step /= length
            image /= length
            steps.append((step, image))
            share = _inner(image, left)
            found += share * step
            left -= share * image
        wrong = np.linalg.norm(free - self._times(found), axis=0)
        return found, wrong <= WRONG * np.linalg.norm(free, axis=0)

    def _times(self, columns: Complex) -> Complex:
        """A times columns (n, n_columns)."""
        of = self._of
        modal = of.resonance[:, self._at] * real_times(of.shapes.T, columns)
        answer = self._rest(columns) + real_times(of.shapes, modal)
        for rows, d in of.blocks:
            answer[rows] += np.einsum("kabj,kbj->kaj", d[..., self._at], columns[rows])
        return answer

    def _rest(self, columns: Complex) -> Complex:
        """E times columns (n, n_columns)."""
        of, answer = self._of, np.zeros_like(columns)
        weighted = columns[of.rows] * self._between[:, None]
        answer[of.rows] = real_times(of.rest, weighted.reshape(-1, columns.shape[1]))
        return answer

    def _preconditioned(self, columns: Complex) -> Complex:
        """P^-1 times columns (n, n_columns)."""
        from scipy.linalg.lapack import zgetrs

        alone, shapes = self._without_large_body(columns), self._of.shapes
        modal = real_times(shapes.T, alone)
        for (factor, pivots), own in zip(self._factors, self._each, strict=True):
            modal[:, own] = zgetrs(factor, pivots, modal[:, own])[0]
        return alone - self._without_large_body(real_times(shapes, modal))

    def _without_large_body(self, columns: Complex) -> Complex:
        """D^-1 times columns (n, n_columns)."""
        answer = np.empty_like(columns)
        for (rows, _), inverse in zip(self._of.blocks, self._inverses, strict=True):
            answer[rows] = np.einsum("kabj,kbj->kaj", inverse, columns[rows])
        return answer


def _among_modes(matrices: _Matrices, inverses: Sequence[Complex], frequency: int) -> Complex:
    """S^-1 + Phi^T D^-1 Phi (n_modes, n_modes) at one frequency, from D^-1 there, (n_blocks, m, m) of each size."""
    shapes = matrices.shapes
    n, n_modes = shapes.shape
    held = np.empty((2, n, n_modes))
    for (rows, _), inverse in zip(matrices.blocks, inverses, strict=True):
        both = np.concatenate([inverse.real, inverse.imag], axis=1) @ shapes[rows]
        held[0, rows], held[1, rows] = both[:, : rows.shape[1]], both[:, rows.shape[1] :]
    found = np.empty((n_modes, n_modes), dtype=np.complex128)
    for begin in range(0, n_modes, _MODES_AT_ONCE):
        end = begin + _MODES_AT_ONCE
        real, imaginary = shapes[:, begin:end].T @ held[:, :, begin:]
        found.real[begin:end, begin:], found.imag[begin:end, begin:] = real, imaginary
        found[begin:, begin:end] = found[begin:end, begin:].T
    found[np.arange(n_modes), np.arange(n_modes)] += 1 / matrices.resonance[:, frequency]
    return found


def _inner(one: Complex, other: Complex) -> Complex:
    """Inner products of columns (n, n_columns)."""
    products: Complex = np.einsum("nj,nj->j", one.conj(), other)
    return products
