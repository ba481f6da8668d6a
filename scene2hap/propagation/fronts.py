"""Wide fronts, by LAPACK: a batch of small matrices, or one of whole systems.

If one body holds most joints, as a table does, fronts save nothing, and each frequency is solved whole.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from scene2hap.propagation.elimination import Joining

Complex: TypeAlias = NDArray[np.complex128]
Floats: TypeAlias = NDArray[np.float64]
Rows: TypeAlias = NDArray[np.intp]


def by_lapack(plan: Sequence[Joining], matrices: Sequence[Complex], free: Floats, forces: Complex) -> Floats:
    """As `vector_fronts.by_vectors`, with frequencies first."""
    n_f = forces.shape[2]
    x = np.broadcast_to(free.astype(np.complex128), (n_f, *free.shape)).copy()
    growth: Floats = np.zeros(n_f)
    live = {number: matrix.transpose(2, 0, 1) for number, matrix in enumerate(matrices)}
    done: list[tuple[Rows, Rows, Complex]] = []
    with np.errstate(all="ignore"):
        for number, joining in enumerate(plan, start=len(matrices)):
            own, others = joining.rows[: joining.n_shared], joining.rows[joining.n_shared :]
            front = np.zeros((n_f, len(joining.rows), len(joining.rows)), dtype=np.complex128)
            for part, at in zip(joining.parts, joining.at, strict=True):
                front[:, at[:, None], at] += live.pop(part)
            n = len(own)
            solved = np.linalg.solve(front[:, :n, :n], np.concatenate([front[:, :n, n:], x[:, own]], axis=2))
            across = np.asarray(solved[:, :, : len(others)], dtype=np.complex128)
            x[:, own] = solved[:, :, len(others) :]
            np.maximum(growth, np.abs(across).max(axis=(1, 2), initial=0.0), out=growth)
            live[number] = front[:, n:, n:] - front[:, n:, :n] @ across
            x[:, others] -= front[:, n:, :n] @ x[:, own]
            done.append((own, others, across))
        for own, others, across in reversed(done):
            x[:, own] -= across @ x[:, others]
    forces[:] = x.transpose(1, 2, 0)
    return growth


def whole(matrices: Sequence[Complex], rows_of: Sequence[Rows], free: Floats) -> Complex:
    """Forces (n, n_sources, n_f), with pivoting; uses up the matrices."""
    n, n_f = len(free), matrices[0].shape[2]
    widest = max(range(len(matrices)), key=lambda number: len(rows_of[number]))
    order, system = rows_of[widest], matrices[widest]
    if len(order) < n:
        order, system, widest = np.arange(n), np.zeros((n, n, n_f), dtype=np.complex128), -1
    place = np.argsort(order)
    for number, (rows, matrix) in enumerate(zip(rows_of, matrices, strict=True)):
        if number != widest:
            at = place[rows]
            system[at[:, None], at] += matrix
    forces = np.empty((n, free.shape[1], n_f), dtype=np.complex128)
    solved = np.linalg.solve(np.ascontiguousarray(system.transpose(2, 0, 1)), free[order].astype(np.complex128))
    forces[order] = solved.transpose(1, 2, 0)
    return forces
