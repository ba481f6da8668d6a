"""Bodies joined two at a time, until all joints are solved; at many frequencies at once.

    A g = b,   A = sum over bodies of their signed receptances at their joints, + Z on the diagonal

Every joint belongs to two bodies. The two whose union has the fewest joints are joined first: the joints that they
share are eliminated, and what is left is one body with the joints of both. A room needs fronts as wide as its floor has
contacts, however many there are in all. Narrow fronts are eliminated row by row, in products of vectors over all
frequencies; wide ones by LAPACK, frequency by frequency. A resonance of a part may cost digits: frequencies at which a
row grows by it are solved again, whole and with pivoting.

Letters: A (n, n) symmetric, g forces, b free deflections, Z (n,) compliance of the joints; all at each frequency.
Source: Duff, Reid, The multifrontal solution of indefinite sparse symmetric linear equations, ACM TOMS 9 (1983) 302,
whose elements are our bodies.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

WORST_GROWTH = 1e4
"""Largest part of a row that may be taken from another: it costs four digits of fifteen."""
_SLACK = 1e-13
"""Compliance added to each joint, as a part of what its two bodies yield there: it keeps four rigid feet under a rigid
body, whose forces statics cannot tell apart, from dividing by zero, and is nine digits below anything else."""
_NARROW = 16
"""Widest front for vectors. Tuned: between 12 and 24 both ways take the same time."""
_FRONT = 170_000
"""Complex numbers of a front at the frequencies that are solved together, 3 MB."""

Complex: TypeAlias = NDArray[np.complex128]
Rows: TypeAlias = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Element:
    """A body as its joints see it: which they are (n_own,), +1 or -1 where it is their first or second body, and its
    receptance there (n_own, n_own, n_f)."""

    rows: Rows
    signs: NDArray[np.float64]
    receptance: Complex

    def matrix(self, part: slice | Rows) -> Complex:
        """Its part of A at some frequencies."""
        signed: Complex = np.multiply.outer(self.signs, self.signs)[:, :, None] * self.receptance[:, :, part]
        return signed


@dataclass(frozen=True, eq=False)
class Joining:
    """Two elements become one, which is numbered after all others.

    rows : joints of both, the `n_shared` that are eliminated first; at : where the rows of each are among them.
    """

    parts: tuple[int, int]
    rows: Rows
    n_shared: int
    at: tuple[Rows, Rows]


def solve(elements: Sequence[Element], compliance: Complex, free: NDArray[np.float64]) -> Complex:
    """Forces (n, n_sources, n_f) for compliances (n, n_f) [m/N] and free deflections (n, n_sources).

    Every row 0..n-1 must belong to exactly two elements.
    """
    n, n_f = compliance.shape
    plan = joinings([element.rows for element in elements])
    forces = np.empty((n, free.shape[1], n_f), dtype=np.complex128)
    widest = max((len(joining.rows) for joining in plan), default=1)
    step = max(16, _FRONT // widest**2)
    for begin in range(0, n_f, step):
        part = slice(begin, begin + step)
        matrices = [element.matrix(part) for element in elements]
        way = _by_vectors if widest <= _NARROW else _by_lapack
        forces[:, :, part], growth = way(plan, matrices, compliance[:, part], free)
        bad = begin + np.flatnonzero(~(growth <= WORST_GROWTH))  # also what is not a number
        if len(bad):
            forces[:, :, bad] = _whole(elements, compliance, free, bad)
    return forces


def joinings(rows_of: Sequence[Rows]) -> list[Joining]:
    """The order in which elements are joined, by their rows alone: narrow fronts first."""
    live = {key: set(rows.tolist()) for key, rows in enumerate(rows_of)}
    ordered = {key: rows.tolist() for key, rows in enumerate(rows_of)}
    owners: dict[int, set[int]] = {}
    for key, own in live.items():
        for row in own:
            owners.setdefault(row, set()).add(key)

    def fronts_with(key: int) -> set[tuple[int, int, int]]:
        others = {other for row in live[key] for other in owners[row]} - {key}
        return {(len(live[key] | live[x]), min(key, x), max(key, x)) for x in others}

    waiting = list({front for key in live for front in fronts_with(key)})
    heapify(waiting)
    plan: list[Joining] = []
    while waiting:
        _, first, second = heappop(waiting)
        if first not in live or second not in live:
            continue
        a, b = live.pop(first), live.pop(second)
        shared, rest = sorted(a & b), sorted(a ^ b)
        place = {row: i for i, row in enumerate([*shared, *rest])}
        at_a, at_b = (np.array([place[row] for row in ordered.pop(part)], dtype=np.intp) for part in (first, second))
        key = len(rows_of) + len(plan)
        plan.append(Joining((first, second), np.array([*shared, *rest], dtype=np.intp), len(shared), (at_a, at_b)))
        live[key], ordered[key] = set(rest), rest
        for row in rest:
            owners[row] = (owners[row] - {first, second}) | {key}
        for front in fronts_with(key):
            heappush(waiting, front)
    return plan


def _by_vectors(
    plan: Sequence[Joining], matrices: list[Complex], compliance: Complex, free: NDArray[np.float64]
) -> tuple[Complex, NDArray[np.float64]]:
    """Forces, and the largest part of a row that was taken from another at each frequency (n_f,)."""
    n_f = compliance.shape[1]
    x = np.broadcast_to(free[:, :, None].astype(np.complex128), (*free.shape, n_f)).copy()
    growth = np.zeros(n_f)
    widest = max((len(joining.rows) for joining in plan), default=0)
    space = np.empty((widest, widest, n_f), dtype=np.complex128)  # fresh memory would cost more than the product
    live = dict(enumerate(matrices))
    done: list[tuple[int, Rows, Complex, Complex]] = []
    with np.errstate(all="ignore"):  # a pivot may vanish; growth tells
        for number, joining in enumerate(plan, start=len(matrices)):
            rows, n = joining.rows, joining.n_shared
            front = np.zeros((len(rows), len(rows), n_f), dtype=np.complex128)
            for part, at in zip(joining.parts, joining.at, strict=True):
                front[at[:, None], at] += live.pop(part)
            _yield_more(front, compliance[rows[:n]])
            for i in range(n):
                others, pivot, across = rows[i + 1 :], front[i, i], front[i, i + 1 :]
                scaled = across / pivot
                change = np.multiply(scaled[:, None], across, out=space[: len(across), : len(across)])
                front[i + 1 :, i + 1 :] -= change
                x[others] -= scaled[:, None] * x[rows[i]]
                growth = np.maximum(growth, np.abs(scaled).max(axis=0, initial=0.0))
                done.append((int(rows[i]), others, pivot.copy(), scaled))
            live[number] = front[n:, n:]
        for row, others, pivot, scaled in reversed(done):
            x[row] /= pivot
            x[row] -= (scaled[:, None] * x[others]).sum(axis=0)
    return x, growth


def _by_lapack(
    plan: Sequence[Joining], matrices: list[Complex], compliance: Complex, free: NDArray[np.float64]
) -> tuple[Complex, NDArray[np.float64]]:
    """As `_by_vectors`, with frequencies first: a batch of small matrices."""
    n_f = compliance.shape[1]
    x = np.broadcast_to(free.astype(np.complex128), (n_f, *free.shape)).copy()
    growth = np.zeros(n_f)
    live = {number: matrix.transpose(2, 0, 1) for number, matrix in enumerate(matrices)}
    done: list[tuple[Rows, Rows, Complex]] = []
    with np.errstate(all="ignore"):
        for number, joining in enumerate(plan, start=len(matrices)):
            own, others = np.split(joining.rows, [joining.n_shared])
            front = np.zeros((n_f, len(joining.rows), len(joining.rows)), dtype=np.complex128)
            for part, at in zip(joining.parts, joining.at, strict=True):
                front[:, at[:, None], at] += live.pop(part)
            n = len(own)
            _yield_more(front.transpose(1, 2, 0), compliance[own])
            solved = np.linalg.solve(front[:, :n, :n], np.concatenate([front[:, :n, n:], x[:, own]], axis=2))
            across = np.asarray(solved[:, :, : len(others)], dtype=np.complex128)
            x[:, own] = solved[:, :, len(others) :]
            growth = np.maximum(growth, np.abs(across).max(axis=(1, 2), initial=0.0))
            live[number] = front[:, n:, n:] - front[:, n:, :n] @ across
            x[:, others] -= front[:, n:, :n] @ x[:, own]
            done.append((own, others, across))
        for own, others, across in reversed(done):
            x[:, own] -= across @ x[:, others]
    return x.transpose(1, 2, 0), growth


def _whole(elements: Sequence[Element], compliance: Complex, free: NDArray[np.float64], at: Rows) -> Complex:
    """Forces at a few frequencies, by LAPACK and with pivoting."""
    n = len(compliance)
    forces = np.empty((n, free.shape[1], len(at)), dtype=np.complex128)
    matrices = [element.matrix(at) for element in elements]
    for i, frequency in enumerate(at):
        system = np.zeros((n, n, 1), dtype=np.complex128)
        for element, matrix in zip(elements, matrices, strict=True):
            system[element.rows[:, None], element.rows, 0] += matrix[:, :, i]
        _yield_more(system, compliance[:, frequency, None])
        forces[:, :, i] = np.linalg.solve(system[:, :, 0], free)
    return forces


def _yield_more(front: Complex, compliance: Complex) -> None:
    """Add the compliance of joints (n, n_f) to the diagonal of their rows, the first of a front."""
    diagonal = np.arange(len(compliance))
    yielding = front[diagonal, diagonal]
    front[diagonal, diagonal] = yielding + compliance + (_SLACK * np.abs(yielding) + 1e-200)
