"""How far things of few triangles fall, as crates in a heap: what `fall` tells of one couple, of many at once.

All triangles of a faller are held against all of the other, in the world: to look first for those of either that may
matter, as `Meeting.near` does, costs more where there are few, since numpy's cost is per call. A couple's answer, to
the last bit, does not depend on the others.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import accumulate
from typing import NamedTuple

import numpy as np

from scene2hap.contact.body import Body, boxes_of
from scene2hap.contact.broad import Boxes
from scene2hap.contact.fall import falls_first, holds, met
from scene2hap.contact.support import TOUCH_M, fall_reach_m, is_over
from scene2hap.contact.vectors import Floats, Indices, Marks

Couple = tuple[Body, Body]
"""A faller, and what it may fall onto."""

_FEW = 1 << 12  # Pairs of triangles of a couple; with more, boxes are sooner.
_AT_ONCE = 1 << 15  # Pairs of triangles looked at together: some 10 MB.


def are_few(faller: Body, other: Body) -> bool:
    """Whether two have so few triangles that `falls_of` is to tell."""
    return faller.n_triangles * other.n_triangles <= _FEW


def falls_of(couples: Sequence[Couple]) -> list[Floats | None]:
    """For each couple what `fall.falls` tells, each of few triangles."""
    told: list[Floats | None] = [None] * len(couples)
    rows = [row for row, (faller, other) in enumerate(couples) if is_over(faller, other)]
    for some in _parts(rows, [couples[row][0].n_triangles * couples[row][1].n_triangles for row in rows]):
        for row, each_m in zip(some, _falls([couples[row] for row in some]), strict=True):
            if np.isfinite(each_m).any():
                told[row] = each_m
    return told


def _parts(rows: Sequence[int], sizes: Sequence[int]) -> Iterator[Sequence[int]]:
    """The rows in parts of which none is larger than `_AT_ONCE`, but for one row alone."""
    begin = total = 0
    for end, size in enumerate(sizes):
        if total and total + size > _AT_ONCE:
            yield rows[begin:end]
            begin, total = end, 0
        total += size
    if begin < len(rows):
        yield rows[begin:]


class _Pairs(NamedTuple):
    """Pairs of triangles, p of a faller and q of the other, and of which couple (n,)."""

    p: Indices
    q: Indices
    couple: Indices

    def some(self, rows: Indices | Marks) -> _Pairs:
        """Some of them."""
        return _Pairs(self.p[rows], self.q[rows], self.couple[rows])


def _falls(couples: Sequence[Couple]) -> list[Floats]:
    """How far each triangle (m,) of each faller falls, inf where it meets nothing."""
    bodies = list({id(body): body for couple in couples for body in couple}.values())
    first = dict(zip(map(id, bodies), accumulate([body.n_triangles for body in bodies], initial=0), strict=False))
    begins = np.array([first[id(faller)] for faller, _ in couples])
    triangles = np.concatenate([body.triangles_m for body in bodies], axis=2)
    pairs = _near(bodies, couples, _all_pairs(couples, first), boxes_of(triangles))
    upwards = (0.0, 1.0, 0.0) if bodies[0].up_axis == 1 else (0.0, 0.0, 1.0)
    p, q = triangles.take(pairs.p, axis=2), triangles.take(pairs.q, axis=2)
    meets, falls_m = met(p, q, upwards, _reaches_m(couples).take(pairs.couple))
    pairs = pairs.some(meets)
    # The triangles of the fallers, couple by couple.
    ends = list(accumulate([faller.n_triangles for faller, _ in couples], initial=0))
    each_m = np.full(ends[-1], np.inf)
    rows = pairs.p + (np.array(ends[:-1]) - begins).take(pairs.couple)
    np.minimum.at(each_m, rows, falls_m)
    return np.split(each_m, ends[1:-1])


def _all_pairs(couples: Sequence[Couple], first: Mapping[int, int]) -> _Pairs:
    """All triangles of each faller with all of the other, by where those of each body begin."""
    grids = [_grid(faller.n_triangles, other.n_triangles) for faller, other in couples]
    p = [grid[0] + first[id(faller)] for grid, (faller, _) in zip(grids, couples, strict=True)]
    q = [grid[1] + first[id(other)] for grid, (_, other) in zip(grids, couples, strict=True)]
    couple = np.repeat(np.arange(len(couples)), [len(grid[0]) for grid in grids])
    return _Pairs(np.concatenate(p), np.concatenate(q), couple)


def _near(bodies: Sequence[Body], couples: Sequence[Couple], pairs: _Pairs, boxes: Boxes) -> _Pairs:
    """Those of the pairs of which one is part of a bottom, the other may hold it, and both may meet."""
    up = bodies[0].up_axis
    low, high = boxes
    falling, bearing = (np.concatenate([marks(body) for body in bodies]) for marks in (falls_first, holds))
    pairs = pairs.some(falling.take(pairs.p) & bearing.take(pairs.q))
    falls_m = low[up].take(pairs.p) - high[up].take(pairs.q)
    sunk_m = low[up].take(pairs.q) - high[up].take(pairs.p)
    pairs = pairs.some((falls_m <= _reaches_m(couples).take(pairs.couple)) & (sunk_m <= TOUCH_M))
    for axis in (0, 3 - up):
        near, far = low[axis].take(pairs.p) <= high[axis].take(pairs.q), high[axis].take(pairs.p)
        pairs = pairs.some(near & (far >= low[axis].take(pairs.q)))
    return pairs


def _reaches_m(couples: Sequence[Couple]) -> Floats:
    return np.array([fall_reach_m(faller.size_m) for faller, _ in couples])


@lru_cache(maxsize=256)
def _grid(n: int, m: int) -> tuple[Indices, Indices]:
    """Each of n with each of m."""
    return np.repeat(np.arange(n), m), np.tile(np.arange(m), n)
