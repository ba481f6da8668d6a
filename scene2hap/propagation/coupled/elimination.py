"""Solver for the linear system of all joints of a group of bodies, at many frequencies.

    A g = b,   A = sum over bodies of their signed receptances at their joints, + Z on the diagonal

Every joint belongs to two bodies, so most entries of A are 0. The compiled kernel factors A = L D L^T without pivoting,
in an order that keeps L sparse (`elimination_order`). Where a resonance of a part makes an entry of L large, digits
would be lost: that frequency is solved again, dense and with pivoting. Without compiled kernels, all frequencies are
solved in this way.

All joints of one body are within the sparsity pattern of L. The entries of A^-1 within this pattern follow from L at
twice the cost of the factorisation, whatever the number of joints.

Letters: A (n, n) symmetric, g forces, b free deflections, Z (n,) compliance of the joints; all at each frequency.
Source: Takahashi, Fagan, Chin, Formation of a sparse bus impedance matrix (1973), for entries of the inverse.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled
from scene2hap.propagation.coupled.elimination_order import Pattern, pattern_of

Complex: TypeAlias = NDArray[np.complex128]
Floats: TypeAlias = NDArray[np.float64]

WORST_GROWTH = 1e4
"""Largest accepted entry of L, the factor by which a row is subtracted from another: it costs 4 digits of 15."""
SLACK = 1e-13
"""Compliance added to each joint, relative to the receptances of its two bodies there. It prevents a division by zero
where statics cannot determine the forces, as in four rigid feet of a rigid body. It is nine digits below anything
else."""
_DENSE = 170_000
"""Complex numbers of dense systems that are solved at once, 3 MB."""


@dataclass(frozen=True, eq=False)
class Element:
    """A body, reduced to its joints.

    rows : (n_own,) indices of its joints; signs : (n_own,) +1 where it is the joint's first body, -1 where the second;
    receptance : (n_f, n_own, n_own) [m/N], symmetric.
    """

    rows: NDArray[np.intp]
    signs: Floats
    receptance: Complex


def solve(elements: Sequence[Element], compliance: Complex, free: Floats) -> Complex:
    """Forces (n, n_sources, n_f) for compliances (n, n_f) [m/N] and free deflections (n, n_sources).

    Every row 0..n-1 must belong to exactly two elements.
    """
    return solve_and_invert(elements, compliance, free, ())[0]


def solve_and_invert(
    elements: Sequence[Element], compliance: Complex, free: Floats, numbers: Collection[int]
) -> tuple[Complex, dict[int, Complex]]:
    """Forces, see `solve`, and A^-1 among the rows of each element in `numbers`, (n_f, n_own, n_own) each."""
    diagonal = compliance + _slack(elements, compliance.shape)
    pattern = pattern_of(tuple([tuple(element.rows.tolist()) for element in elements]))
    forces = np.empty((*free.shape, compliance.shape[1]), dtype=np.complex128)
    inverses = {k: np.empty(elements[k].receptance.shape, dtype=np.complex128) for k in numbers}
    is_good = factored(elements, diagonal, free, pattern, WORST_GROWTH, forces, inverses)
    bad = np.flatnonzero(~is_good)
    if len(bad):
        forces[:, :, bad] = dense(elements, diagonal, free, bad)
        if inverses:
            whole = dense(elements, diagonal, np.eye(len(diagonal)), bad)
            for k, inverse in inverses.items():
                rows = elements[k].rows
                inverse[bad] = whole[rows[:, None], rows].transpose(2, 0, 1)
    return forces, inverses


@compiled
def factored(
    elements: Sequence[Element],
    diagonal: Complex,
    free: Floats,
    pattern: Pattern,
    worst_growth: float,
    forces: Complex,
    inverses_at: Mapping[int, Complex],
) -> NDArray[np.bool_]:
    """Fill in the forces (n, n_sources, n_f) and the parts of A^-1, see `solve_and_invert`.

    Returns (n_f,) whether the solution at each frequency kept its digits.
    """
    return np.zeros(diagonal.shape[1], dtype=bool)  # left to `dense`: a batched solve is the best that numpy offers


def dense(elements: Sequence[Element], diagonal: Complex, free: Floats, frequencies: NDArray[np.intp]) -> Complex:
    """Forces (n, n_sources, n_few) at the frequencies of these indices, by dense solves with pivoting."""
    n, found = len(diagonal), []
    for few in np.array_split(frequencies, -(-len(frequencies) * n**2 // _DENSE)):
        system = np.zeros((len(few), n, n), dtype=np.complex128)
        system[:, np.arange(n), np.arange(n)] = diagonal[:, few].T
        for element in elements:
            signs = np.multiply.outer(element.signs, element.signs)
            system[:, element.rows[:, None], element.rows] += signs * element.receptance[few]
        found.append(np.linalg.solve(system, free.astype(np.complex128)))
    return np.concatenate(found).transpose(1, 2, 0)


def _slack(elements: Sequence[Element], shape: tuple[int, ...]) -> Floats:
    own = np.zeros(shape, dtype=np.complex128)
    for element in elements:
        own[element.rows] += np.diagonal(element.receptance, axis1=1, axis2=2).T
    slack: Floats = np.abs(own)
    slack *= SLACK
    slack += 1e-200
    return slack
