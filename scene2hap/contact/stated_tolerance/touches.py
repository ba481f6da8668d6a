"""Where things touch, as columns of numbers: kept so while nobody asks for the pairs one by one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.junction import Junction, Pair
from scene2hap.contact.spread import MAX_POINTS
from scene2hap.contact.vectors import Floats, Indices, Marks, Triple

_BITS = 32
_LOW = (1 << _BITS) - 1


class Touches(NamedTuple):
    """Pairs of columns (n,), each as one number, ascending: that of the thing with the lower id above `_BITS`; points
    (n, 4, 3) world [m], of which the first `counts` (n,) are any, the others 0; weights (n,) [-]; normals (n, 3) from
    the lower id to the other, 0 where unknown."""

    codes: NDArray[np.int64]
    points_m: Floats
    counts: Indices
    weights: Floats
    normals: Floats

    @classmethod
    def none(cls) -> Touches:
        """No pair."""
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
        """Of pairs in any order, with points (3, 4, n), those that count (4, n), and (weights, normals (3, n))."""
        codes = (first.astype(np.int64) << _BITS) | second
        points = np.where(counts, points_m, 0.0).transpose(2, 1, 0)
        return cls(codes, points, counts.sum(axis=0), more[0], more[1].T).rows(np.argsort(codes))

    def rows(self, rows: Indices | Marks) -> Touches:
        """Some of them."""
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
        """These and others."""
        if not len(self.codes) or not len(more.codes):
            return self if len(self.codes) else more
        codes, points, counts, weights, normals = (np.concatenate(columns) for columns in zip(self, more, strict=True))
        joined = Touches(
            codes.astype(np.int64, copy=False), points, counts.astype(np.intp, copy=False), weights, normals
        )
        return joined.rows(np.argsort(joined.codes))

    def columns(self) -> tuple[Indices, Indices]:
        """The columns of either side."""
        return self.codes >> _BITS, self.codes & _LOW

    def junctions(self) -> list[Junction]:
        """The same one by one."""
        found = []
        for points, n, share, (x, y, z) in zip(
            self.points_m.tolist(), self.counts.tolist(), self.weights.tolist(), self.normals.tolist(), strict=True
        ):
            normal: Triple | None = (x, y, z) if x or y or z else None
            found.append(Junction(tuple([(u, v, w) for u, v, w in points[:n]]), (share,) * n, (normal,) * n))
        return found


class Difference(NamedTuple):
    """Codes of pairs that came, went, and are elsewhere or otherwise than before."""

    appeared: list[int]
    vanished: list[int]
    shifted: list[int]


def difference(before: Touches, now: Touches) -> Difference:
    """What has changed."""
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
    """Which of the same pairs touch as before."""
    same: Marks = (then.points_m == now.points_m).all(axis=(1, 2)) & (then.normals == now.normals).all(axis=1)
    same &= (then.counts == now.counts) & (then.weights == now.weights)
    return same


class PairNames:
    """Pairs of ids by code; each made once."""

    def __init__(self, id_of: Callable[[int], str]) -> None:
        self._id_of = id_of
        self._known: dict[int, Pair] = {}

    def forget(self) -> None:
        """A column has come to be another thing's."""
        self._known.clear()

    def of(self, codes: Sequence[int]) -> list[Pair]:
        """The pairs of these codes."""
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
