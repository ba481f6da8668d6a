"""Solver for the linear system of all joints of a group of bodies, at many frequencies.

    A g = b,   A = sum over bodies of their signed receptances at their joints, + Z on the diagonal

Every joint belongs to two bodies, so most entries of A are 0. The compiled kernel factors A = L D L^T without pivoting,
in an order that keeps L sparse (`elimination_order`). Where a resonance of a part makes an entry of L large, digits
would be lost: that frequency is solved again, dense and with pivoting. Without compiled kernels, and where hundreds of
joints are on one body, all frequencies are solved in this way.

All joints of one body are within the sparsity pattern of L. The entries of A^-1 within this pattern follow from L at
twice the cost of the factorisation, whatever the number of joints.

Letters: A (n, n) symmetric, g forces, b free deflections, Z (n,) compliance of the joints; all at each frequency.
Source: Takahashi, Fagan, Chin, Formation of a sparse bus impedance matrix (1973), for entries of the inverse.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.compiled import compiled
from scene2hap.propagation.coupled.elimination_order import Pattern, pattern_of

WORST_GROWTH = 1e4
"""Largest accepted entry of L, the factor by which a row is subtracted from another: it costs 4 digits of 15."""
SLACK = 1e-13
"""Compliance added to each joint, relative to the receptances of its two bodies there. It prevents a division by zero
where statics cannot determine the forces, as in four rigid feet of a rigid body. It is nine digits below anything
else."""
CACHE_BYTES = 2_000_000
"""Memory of the factor at four frequencies, up to which the kernel is as fast as LAPACK or faster: a core's cache."""
LAPACK_SPEED = 4
"""Multiplications of LAPACK in the time of one of the kernel, beyond `CACHE_BYTES`: 4 at 500 rows, 8 at 800."""
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
    diagonal = compliance + slack(elements, compliance.shape)
    pattern, n_f = pattern_among([one.rows for one in elements]), compliance.shape[1]
    forces = np.empty((*free.shape, n_f), dtype=np.complex128)
    bad = np.arange(n_f)
    if not is_nearly_full(pattern, free.shape[1], inverts=False):
        bad = np.flatnonzero(~factored(elements, diagonal, free, pattern, WORST_GROWTH, forces, {}))
    for at, system in dense(elements, diagonal, bad):
        forces[:, :, at] = np.linalg.solve(system, free.astype(np.complex128)).transpose(1, 2, 0)
    return forces


def inverse(
    elements: Sequence[Element], compliance: Complex, columns: NDArray[np.intp], numbers: Collection[int]
) -> tuple[Complex, dict[int, Complex]]:
    """Columns of A^-1 (n, n_columns, n_f), and A^-1 among the rows of each element in `numbers`, (n_f, n_own, n_own)
    each. For the other parameters see `solve`."""
    diagonal = compliance + slack(elements, compliance.shape)
    pattern, (n, n_f), n_columns = pattern_among([one.rows for one in elements]), compliance.shape, len(columns)
    found = np.empty((n, n_columns, n_f), dtype=np.complex128)
    parts = {k: np.empty(elements[k].receptance.shape, dtype=np.complex128) for k in numbers}
    free = np.zeros((n, n_columns))
    free[columns, np.arange(n_columns)] = 1.0
    bad = np.arange(n_f)
    if not is_nearly_full(pattern, n_columns, inverts=bool(parts)):
        bad = np.flatnonzero(~factored(elements, diagonal, free, pattern, WORST_GROWTH, found, parts))
    for at, system in dense(elements, diagonal, bad):
        if not parts:  # takes a third of the time
            found[:, :, at] = np.linalg.solve(system, free.astype(np.complex128)).transpose(1, 2, 0)
            continue
        whole = np.linalg.inv(system)
        found[:, :, at] = whole[:, :, columns].transpose(1, 2, 0)
        for k, part in parts.items():
            rows = elements[k].rows
            part[at] = whole[:, rows[:, None], rows]
    return found, parts


def is_nearly_full(pattern: Pattern, n_sources: int, *, inverts: bool) -> bool:
    """Whether LAPACK solves the whole matrix in less time than the sparse kernel: it is large and nearly full."""
    n = len(pattern.place)
    sparse = pattern.n_products * (3 if inverts else 1) + 2 * len(pattern.columns) * n_sources
    full = n**3 if inverts else n**3 // 3 + n**2 * n_sources
    return 64 * len(pattern.columns) > CACHE_BYTES and LAPACK_SPEED * sparse > full


def pattern_among(rows: Iterable[NDArray[np.intp]]) -> Pattern:
    """See `pattern_of`, for the rows of each element."""
    return pattern_of(tuple([tuple(own.tolist()) for own in rows]))


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
    """Fill in the forces (n, n_sources, n_f) and the parts of A^-1, see `inverse`.

    Returns (n_f,) whether the solution at each frequency kept its digits.
    """
    return np.zeros(diagonal.shape[1], dtype=bool)  # left to `dense`: a batched solve is the best that numpy offers


def dense(
    elements: Sequence[Element], diagonal: Complex, frequencies: NDArray[np.intp]
) -> Iterator[tuple[NDArray[np.intp], Complex]]:
    """Yield a few of these indices of frequencies, and A there (n_few, n, n), for solutions with pivoting."""
    n = len(diagonal)
    n_parts = min(len(frequencies), -(-len(frequencies) * n**2 // _DENSE))
    for few in np.array_split(frequencies, n_parts) if n_parts else ():
        system = np.zeros((len(few), n, n), dtype=np.complex128)
        system[:, np.arange(n), np.arange(n)] = diagonal[:, few].T
        for element in elements:
            signs = np.multiply.outer(element.signs, element.signs)
            system[:, element.rows[:, None], element.rows] += signs * element.receptance[few]
        yield few, system


def slack(elements: Sequence[Element], shape: tuple[int, ...]) -> Floats:
    """Return `SLACK` of each row (n, n_f) [m/N]."""
    own = np.zeros(shape, dtype=np.complex128)
    for element in elements:
        own[element.rows] += np.diagonal(element.receptance, axis1=1, axis2=2).T
    added: Floats = np.abs(own)
    added *= SLACK
    added += 1e-200
    return added
