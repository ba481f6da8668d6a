"""Narrow fronts, eliminated row by row in products of vectors over all frequencies.

A source adds a column b of its own, and a front carries the columns of those sources only that are among its bodies:
elsewhere they are 0. What depends on who touches whom alone is thought out once (`schedule`); numbers then take few
calls.

Letters: A (n, n) symmetric, b free deflections, x forces; all at each frequency. Row i of a front becomes
x_i = b_i / A_ii - sum over j > i of (A_ij / A_ii) x_j.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from scene2hap.propagation.fronts import Complex, Floats, Rows
from scene2hap.propagation.workspace import Workspace

if TYPE_CHECKING:
    from scene2hap.propagation.elimination import Joining

Block: TypeAlias = tuple[slice | Rows, slice | Rows]


@dataclass(frozen=True, eq=False)
class Step:
    """One joining, thought out.

    parts : numbers of the two that are joined; size : rows of the front, and columns of b; sources : which those are;
    first, second : where the matrix of each part goes and where its columns, None where it has none; the first is the
    front already if it `grows` neither rows nor columns; moving : (row, column, source) of the free deflections of rows
    that are eliminated; rows, others : which those are, and which of the front are left then.
    """

    parts: tuple[int, int]
    size: tuple[int, int]
    sources: tuple[int, ...]
    first: tuple[Block, Block | None]
    second: tuple[Block, Block | None]
    grows: bool
    moving: tuple[tuple[int, int, int], ...]
    rows: tuple[int, ...]
    others: tuple[tuple[int, ...], ...]

    @classmethod
    def of(
        cls, joining: Joining, before: tuple[tuple[int, ...], tuple[int, ...]], sources_of: Sequence[Sequence[int]]
    ) -> Step:
        """The step of a joining, from the sources of each part and of each row."""
        rows, n = joining.rows.tolist(), joining.n_shared
        own = {x for row in rows[:n] for x in sources_of[row]}
        sources = tuple(sorted({*before[0], *before[1], *own}))
        where = {x: len(rows) + column for column, x in enumerate(sources)}
        blocks = []
        for at, some in zip(joining.at, before, strict=True):
            places = np.array([where[x] for x in some], dtype=np.intp)
            blocks.append((_block(at, at), _block(at, places) if some else None))
        return cls(
            parts=joining.parts,
            size=(len(rows), len(sources)),
            sources=sources,
            first=blocks[0],
            second=blocks[1],
            grows=len(joining.at[0]) < len(rows) or sources != before[0],
            moving=tuple((i, where[x], x) for i, row in enumerate(rows[:n]) for x in sources_of[row]),
            rows=tuple(rows[:n]),
            others=tuple(tuple(rows[i + 1 :]) for i in range(n)),
        )


def _block(rows: Rows, columns: Rows) -> Block:
    """Where rising rows and columns cross: a view if they follow one another, which spares two copies."""
    if rows[-1] - rows[0] + 1 == len(rows) and columns[-1] - columns[0] + 1 == len(columns):
        return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
    return rows[:, None], columns


@lru_cache(maxsize=16)
def schedule(plan: tuple[Joining, ...], n_elements: int, sources_of: tuple[tuple[int, ...], ...]) -> tuple[Step, ...]:
    """The steps of a plan, where each row has free deflections of some sources."""
    sources: dict[int, tuple[int, ...]] = {}
    steps = []
    for number, joining in enumerate(plan, start=n_elements):
        a, b = joining.parts
        steps.append(Step.of(joining, (sources.get(a, ()), sources.get(b, ())), sources_of))
        sources[number] = steps[-1].sources
    return tuple(steps)


def numbers_held(steps: Sequence[Step], matrices: Sequence[int]) -> int:
    """Complex numbers that `by_vectors` holds for each frequency, given how many rows each element has."""
    sizes = [step.size[0] * sum(step.size) for step in steps]
    fronts = sum(size for size, step in zip(sizes, steps, strict=True) if step.grows)
    return sum(n * n for n in matrices) + fronts + max(sizes, default=0) + _n_taken(steps)


def _n_taken(steps: Sequence[Step]) -> int:
    return sum(len(others) for step in steps for others in step.others)


def by_vectors(
    steps: Sequence[Step], matrices: Sequence[Complex], free: Floats, forces: Complex, room: Workspace
) -> Floats:
    """Put forces (n, n_sources, n_f) into `forces`; return the largest part of a row that was taken from another at
    each frequency (n_f,).

    Parameters: matrices : of each element (n, n, n_f), compliance of joints included; they are worked in.
    """
    n_f = forces.shape[2]
    live = dict(enumerate(matrices))
    pivots: list[tuple[Step, int, Complex, Complex]] = []
    taken, begin = room.array(_n_taken(steps), n_f), 0
    space = room.array(max((step.size[0] * sum(step.size) for step in steps), default=0), n_f)
    with np.errstate(all="ignore"):  # a pivot may vanish; growth tells
        for number, step in enumerate(steps, start=len(matrices)):
            front = _front(step, live.pop(step.parts[0]), live.pop(step.parts[1]), free, room)
            for i, others in enumerate(step.others):
                part = taken[begin : begin + len(others)]
                begin += len(others)
                pivots.append((step, i, part, _eliminate(front, i, part, space)))
            n = len(step.rows)
            live[number] = front[n:, n:]
        _substitute(pivots, forces, room)
        growth: Floats = np.abs(taken).max(axis=0, initial=0.0)
    return growth


def _front(step: Step, first: Complex, second: Complex, free: Floats, room: Workspace) -> Complex:
    """Both parts and free deflections added up (n_rows, n_rows + n_columns, n_f)."""
    n_rows, n_columns = step.size
    front = first
    if step.grows:
        front = room.array(n_rows, n_rows + n_columns, first.shape[2])
        front[:] = 0.0
        matrix, columns = step.first
        front[matrix] = first[:, : len(first)]
        if columns is not None:
            front[columns] = first[:, len(first) :]
    matrix, columns = step.second
    front[matrix] += second[:, : len(second)]
    if columns is not None:
        front[columns] += second[:, len(second) :]
    for i, column, source in step.moving:
        front[i, column] += free[step.rows[i], source]
    return front


def _eliminate(front: Complex, i: int, taken: Complex, space: Complex) -> Complex:
    """Take row i out of those below it, `taken` times; returns what it is moved by, alone, for each column."""
    n = len(taken)
    inverse = 1 / front[i, i]
    if n:
        row = front[i, i + 1 :]
        np.multiply(row[:n], inverse, out=taken)
        change = space[: n * len(row)].reshape(n, *row.shape)
        front[i + 1 :, i + 1 :] -= np.multiply(taken[:, None], row, out=change)
    alone = front[i, i + 1 + n :]
    alone *= inverse
    return alone


def _substitute(pivots: Sequence[tuple[Step, int, Complex, Complex]], x: Complex, room: Workspace) -> None:
    """Forces, from the row eliminated last."""
    part = room.array(*x.shape[1:])
    for step, i, taken, alone in reversed(pivots):
        own = x[step.rows[i]]
        own[:] = 0.0
        own[list(step.sources)] = alone
        for other, share in zip(step.others[i], taken, strict=True):
            np.multiply(share, x[other], out=part)
            own -= part
