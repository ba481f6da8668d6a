"""Bodies joined two at a time, until all joints are solved; at many frequencies at once.

    A g = b,   A = sum over bodies of their signed receptances at their joints, + Z on the diagonal

Every joint belongs to two bodies. The two whose union has the fewest joints are joined first: the joints that they
share are eliminated, and what is left is one body with the joints of both. A room needs fronts as wide as its floor has
contacts, however many there are in all; `vector_fronts` and `fronts` eliminate them. A resonance of a part may cost
digits: frequencies at which a row grows by it are solved again, whole and with pivoting.

Letters: A (n, n) symmetric, g forces, b free deflections, Z (n,) compliance of the joints; all at each frequency.
Source: Duff, Reid, The multifrontal solution of indefinite sparse symmetric linear equations, ACM TOMS 9 (1983) 302,
whose elements are our bodies.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from heapq import heapify, heappop, heappush

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.fronts import Complex, Rows, by_lapack, whole
from scene2hap.propagation.vector_fronts import Step, by_vectors, numbers_held, schedule
from scene2hap.propagation.workspace import ROOM, Workspace, workspace

WORST_GROWTH = 1e4
"""Largest part of a row that may be taken from another: it costs four digits of fifteen."""
SLACK = 1e-13
"""Compliance added to each joint, as a part of what its two bodies yield there: it keeps four rigid feet under a rigid
body, whose forces statics cannot tell apart, from dividing by zero, and is nine digits below anything else."""
_NARROW = 16
"""Widest front for vectors. Tuned: between 12 and 24 both ways take the same time."""
_FRONT = 170_000
"""Complex numbers of a front at the frequencies that are solved together, 3 MB."""
_FEWEST = 128
"""Frequencies of narrow fronts that are solved together at least, in memory of their own if need be: fewer cost more to
call for than to solve."""
_JOINING = 3000
"""Products that cost as much as a front costs by itself, where fronts are eliminated by LAPACK. Measured."""


@dataclass(frozen=True, eq=False)
class Element:
    """A body as its joints see it: which they are (n_own,), +1 or -1 where it is their first or second body, and its
    receptance there (n_own, n_own, n_f), in another order `at` if that is given."""

    rows: Rows
    signs: NDArray[np.float64]
    receptance: Complex
    at: Rows | None = None

    def sorted_by(self, order: Rows) -> Element:
        """The same with its rows in rising order (n,)."""
        at = np.argsort(order[self.rows])
        if (at == np.arange(len(at))).all():
            return self
        return Element(self.rows[at], self.signs[at], self.receptance, at if self.at is None else self.at[at])

    def yielding(self) -> Complex:
        """What it yields at each joint by itself (n_own, n_f)."""
        at = np.arange(len(self.rows)) if self.at is None else self.at
        own: Complex = self.receptance[at, at]
        return own

    def matrix(self, part: slice | Rows, room: Workspace) -> Complex:
        """Its part of A at some frequencies, a copy."""
        own = self.receptance[:, :, part]
        if self.at is not None:
            own = own[self.at[:, None], self.at]
        matrix = room.array(*own.shape)
        if (self.signs == self.signs[0]).all():
            np.copyto(matrix, own)
        else:
            np.multiply(np.multiply.outer(self.signs, self.signs)[:, :, None], own, out=matrix)
        return matrix


@dataclass(frozen=True, eq=False)
class Joining:
    """Two elements become one, which is numbered after all others.

    parts : the one with more rows first; rows : joints of both in the order of elimination, the `n_shared` that are
    eliminated first; at : where the rows of each are among them, rising.
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
    plan = joinings(tuple(tuple(element.rows.tolist()) for element in elements))
    order = np.empty(n, dtype=np.intp)
    order[[row for joining in plan for row in joining.rows[: joining.n_shared].tolist()]] = np.arange(n)
    elements = [element.sorted_by(order) for element in elements]
    rows_of = [element.rows for element in elements]
    yielding = compliance + _slack(elements, compliance.shape)
    forces = np.empty((n, free.shape[1], n_f), dtype=np.complex128)
    widest = max((len(joining.rows) for joining in plan), default=1)
    steps: Sequence[Step] = ()
    if widest <= _NARROW:
        moving: list[list[int]] = [[] for _ in range(n)]
        for row, source in np.argwhere(free).tolist():
            moving[row].append(source)
        steps = schedule(plan, len(elements), tuple(map(tuple, moving)))
        at_once = max(_FEWEST, ROOM // numbers_held(steps, [len(rows) for rows in rows_of]))
    else:
        at_once = max(16, _FRONT // (n if _is_one(n, plan) else widest) ** 2)
    n_parts = math.ceil(n_f / at_once)
    for part in (slice(n_f * i // n_parts, n_f * (i + 1) // n_parts) for i in range(n_parts)):
        room = workspace()
        matrices = _matrices(elements, yielding, part, room)
        if steps:
            growth = by_vectors(steps, matrices, free, forces[:, :, part], room)
        elif _is_one(n, plan):
            forces[:, :, part] = whole(matrices, rows_of, free)
            continue
        else:
            growth = by_lapack(plan, matrices, free, forces[:, :, part])
        bad = part.start + np.flatnonzero(~(growth <= WORST_GROWTH))  # also what is not a number
        for some in np.array_split(bad, math.ceil(len(bad) * n**2 / _FRONT)) if len(bad) else ():
            forces[:, :, some] = whole(_matrices(elements, yielding, some, workspace()), rows_of, free)
    return forces


def _is_one(n: int, plan: Sequence[Joining]) -> bool:
    """Whether the whole system of n joints costs less than its fronts."""
    fronts = sum(2 * joining.n_shared * len(joining.rows) ** 2 + _JOINING for joining in plan)
    return n**3 / 3 < fronts


def _slack(elements: Sequence[Element], shape: tuple[int, ...]) -> NDArray[np.float64]:
    own = np.zeros(shape, dtype=np.complex128)
    for element in elements:
        own[element.rows] += element.yielding()
    slack: NDArray[np.float64] = np.abs(own)
    slack *= SLACK
    slack += 1e-200
    return slack


def _matrices(elements: Sequence[Element], yielding: Complex, part: slice | Rows, room: Workspace) -> list[Complex]:
    """The part of A of every element; that of joints is counted as their first one's."""
    known: set[int] = set()
    matrices = []
    for element in elements:
        matrix = element.matrix(part, room)
        new = [i for i, row in enumerate(element.rows.tolist()) if row not in known]
        if new:
            rows = element.rows[new]
            matrix[new, new] += yielding[rows, part] if isinstance(part, slice) else yielding[rows[:, None], part]
            known.update(rows.tolist())
        matrices.append(matrix)
    return matrices


@lru_cache(maxsize=16)
def joinings(rows_of: tuple[tuple[int, ...], ...]) -> tuple[Joining, ...]:
    """The order in which elements are joined, by their rows alone: narrow fronts first. Remembered, since things that
    move seldom change what touches what."""
    live = {key: set(rows) for key, rows in enumerate(rows_of)}
    owners: dict[int, set[int]] = {}
    for key, own in live.items():
        for row in own:
            owners.setdefault(row, set()).add(key)

    def fronts_with(key: int) -> set[tuple[int, int, int]]:
        others = {other for row in live[key] for other in owners[row]} - {key}
        return {(len(live[key] | live[x]), min(key, x), max(key, x)) for x in others}

    waiting = list({front for key in live for front in fronts_with(key)})
    heapify(waiting)
    pairs: list[tuple[int, int]] = []
    rows = dict(live)
    while waiting:
        _, first, second = heappop(waiting)
        if first not in live or second not in live:
            continue
        a, b = live.pop(first), live.pop(second)
        key = len(rows_of) + len(pairs)
        pairs.append((first, second) if len(a) >= len(b) else (second, first))
        live[key] = rows[key] = a ^ b
        for row in live[key]:
            owners[row] = (owners[row] - {first, second}) | {key}
        for front in fronts_with(key):
            heappush(waiting, front)
    return _in_order(pairs, rows)


def _in_order(pairs: Sequence[tuple[int, int]], rows: Mapping[int, set[int]]) -> tuple[Joining, ...]:
    """Joinings whose rows are in the order in which they are eliminated, so that those that remain are the last."""
    shared = [sorted(rows[a] & rows[b]) for a, b in pairs]
    order = {row: i for i, row in enumerate(row for several in shared for row in several)}
    plan = []
    for (a, b), several in zip(pairs, shared, strict=True):
        both = sorted(rows[a] | rows[b], key=order.__getitem__)
        place = {row: i for i, row in enumerate(both)}
        at_a, at_b = (np.array(sorted(place[row] for row in rows[part]), dtype=np.intp) for part in (a, b))
        plan.append(Joining((a, b), np.array(both, dtype=np.intp), len(several), (at_a, at_b)))
    return tuple(plan)
