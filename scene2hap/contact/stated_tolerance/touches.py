"""Contacts as arrays, so that junctions and pairs of ids are made only when they are read."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.geometry.spread import MAX_POINTS
from scene2hap.contact.geometry.vectors import Floats, Indices, Marks, Triple
from scene2hap.contact.junction import Junction, Pair

_BITS = 32
_LOW = (1 << _BITS) - 1


class Touches(NamedTuple):
    """The contacts of n pairs of objects, sorted by code.

    codes : (n,) two columns of the finder in one number, that of the lower id above `_BITS`; points_m : (n, 4, 3) world
    [m], of which the first `counts` (n,) are valid, the others 0; weights : (n,) [-]; normals : (n, 3) from the lower
    id to the other, 0 where unknown.
    """

    codes: NDArray[np.int64]
    points_m: Floats
    counts: Indices
    weights: Floats
    normals: Floats

    @classmethod
    def none(cls) -> Touches:
        """Return contacts of no pair."""
        return cls(
            np.empty(0, dtype=np.int64),
            np.empty((0, MAX_POINTS, 3)),
            np.empty(0, dtype=np.intp),
            np.empty(0),
            np.empty((0, 3)),
        )

    @classmethod
    def of(
        cls, first: Indices, second: Indices, points_m: Floats, counts: Marks, more: tuple[Floats, Floats]
    ) -> Touches:
        """Build from pairs in any order: points (3, 4, n), marks (4, n) of valid ones, (weights, normals (3, n))."""
        codes = (first.astype(np.int64) << _BITS) | second
        points = np.where(counts, points_m, 0.0).transpose(2, 1, 0)
        return cls(codes, points, counts.sum(axis=0), more[0], more[1].T).rows(np.argsort(codes))

    def rows(self, rows: Indices | Marks) -> Touches:
        """Return the contacts of some pairs."""
        if rows.dtype == np.bool_:
            rows = np.flatnonzero(rows)
        codes, points, counts, weights, normals = self
        return Touches(
            codes.take(rows),
            points.take(rows, axis=0),
            counts.take(rows),
            weights.take(rows),
            normals.take(rows, axis=0),
        )

    def with_more(self, more: Touches) -> Touches:
        """Return these contacts and those of other pairs."""
        if not len(self.codes) or not len(more.codes):
            return self if len(self.codes) else more
        codes, points, counts, weights, normals = (np.concatenate(columns) for columns in zip(self, more, strict=True))
        joined = Touches(
            codes.astype(np.int64, copy=False), points, counts.astype(np.intp, copy=False), weights, normals
        )
        return joined.rows(np.argsort(joined.codes))

    def columns(self) -> tuple[Indices, Indices]:
        """Return the columns of the two objects of each pair."""
        return self.codes >> _BITS, self.codes & _LOW

    def junctions(self) -> list[Junction]:
        """Return the contacts as junctions, one for each pair."""
        found = []
        for points, n, share, (x, y, z) in zip(
            self.points_m.tolist(), self.counts.tolist(), self.weights.tolist(), self.normals.tolist(), strict=True
        ):
            normal: Triple | None = (x, y, z) if x or y or z else None
            found.append(Junction(tuple([(u, v, w) for u, v, w in points[:n]]), (share,) * n, (normal,) * n))
        return found


class Difference(NamedTuple):
    """The codes of pairs that appeared, vanished, or changed their points, weight or normal."""

    appeared: list[int]
    vanished: list[int]
    shifted: list[int]


def difference(before: Touches, now: Touches) -> Difference:
    """Compare two sets of contacts."""
    if len(before.codes) == len(now.codes) and (before.codes == now.codes).all():
        return Difference([], [], now.codes[~_same(before, now)].tolist())
    place = np.searchsorted(before.codes, now.codes)
    place[place == len(before.codes)] = 0
    known = before.codes[place] == now.codes if len(before.codes) else np.zeros(len(now.codes), dtype=bool)
    then, still = before.rows(place[known]), now.rows(known)
    gone = np.ones(len(before.codes), dtype=bool)
    gone[place[known]] = False
    return Difference(
        now.codes[~known].tolist(), before.codes[gone].tolist(), still.codes[~_same(then, still)].tolist()
    )


def _same(then: Touches, now: Touches) -> Marks:
    """Mark the pairs with unchanged contacts; both arguments hold the same pairs."""
    same: Marks = (then.points_m == now.points_m).all(axis=(1, 2)) & (then.normals == now.normals).all(axis=1)
    same &= (then.counts == now.counts) & (then.weights == now.weights)
    return same


class PairNames:
    """A cache of pairs of ids by code."""

    def __init__(self, id_of: Callable[[int], str]) -> None:
        self._id_of = id_of
        self._known: dict[int, Pair] = {}

    def forget(self) -> None:
        """Clear the cache, because a column now belongs to another object."""
        self._known.clear()

    def of(self, codes: Sequence[int]) -> list[Pair]:
        """Return the pairs of these codes."""
        known = self._known
        try:
            return [known[code] for code in codes]
        except KeyError:
            if len(known) > _MANY + 4 * len(codes):
                known.clear()
        for code in codes:
            if code not in known:
                known[code] = (self._id_of(code >> _BITS), self._id_of(code & _LOW))
        return [known[code] for code in codes]


_MANY = 1 << 14
