"""The level faces of a shape at any height: floors and tables of any outline, shelves, seats, boards with a groove.

What is known of such a ledge is where it ends: an edge with triangles on one side only is on its rim, and a stretch
that no rim enters and of which one point is covered, is covered. Where meshes are joined badly, or faces overlap, there
is a rim more than need be, never one less.

    h : the height along the own axis that points up [m]; u, v : the two other own axes, in their order [m]
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled
from scene2hap.contact.broad import Boxes
from scene2hap.contact.vectors import Floats

Flat = tuple[float, float, float, float]
"""A rectangle by its least u and v and its greatest."""

_WELD_M = 1e-6  # Corners so near to each other are one.
_THIN_M2 = 1e-12  # A triangle with less area covers nothing.
_HALVINGS = 4  # So often a stretch is halved at most where slanted rims are near.


class Upright(NamedTuple):
    """Which own axis points up (0, 1, 2), whether upwards (1) or downwards (-1), and the two others."""

    axis: int
    sign: int
    u: int
    v: int


class Ledges:
    """The level faces of triangles (3, 3, m) in their boxes, where up is along an own axis.

    Parameters: uneven_m : how much heights may differ within a face, and how far faces are apart that are two [m].
    `number` (m,) is the ledge that each triangle is part of, -1 for none, `tops` (m,) how high each reaches; `heights`
    are those of the ledges, rising.
    """

    def __init__(self, triangles: Floats, boxes: Boxes, upright: Upright, uneven_m: float) -> None:
        axis, sign, *plane = upright
        low, high = boxes.low[axis], boxes.high[axis]
        top = self.tops = high if sign > 0 else -low
        self.number: NDArray[np.intp] = np.full(triangles.shape[2], -1)
        level = np.flatnonzero(high - low <= uneven_m)
        level = level[np.argsort(top[level], kind="stable")]
        steps = np.diff(top[level]) > uneven_m
        self.number[level] = np.concatenate([[0], np.cumsum(steps)])[: len(level)]
        ends = np.append(steps, True)[: len(level)]
        self.heights: list[float] = top[level][ends].tolist()
        self._corners = triangles[plane].transpose(2, 1, 0)
        self._outlines: dict[int, tuple[Floats, Floats]] = {}

    def covers(self, number: int, foot: Flat) -> bool:
        """Whether a ledge wholly covers a rectangle."""
        return covers(*self._outline(number), foot)

    def stretch(self, number: int, foot: Flat, most: Flat) -> Flat:
        """A rectangle around `foot`, which a ledge covers, no larger than `most`, that it wholly covers."""
        _, rims = self._outline(number)
        for _ in range(_HALVINGS):
            ends = _clipped(rims, most)
            low, high = ends.min(axis=1), ends.max(axis=1)
            sides = np.stack([low - foot[2:], foot[:2] - high], axis=1).reshape(-1, 4)
            widest = sides.argmax(axis=1)
            room = sides[np.arange(len(sides)), widest]
            if (room > 0).all():
                least = [room[widest == side].min(initial=np.inf) * 0.999 for side in range(4)]
                return (
                    max(most[0], foot[0] - least[2]),
                    max(most[1], foot[1] - least[3]),
                    min(most[2], foot[2] + least[0]),
                    min(most[3], foot[3] + least[1]),
                )
            # A slanted rim passes by the foot's corner: nearer to the foot it does so no more, or has a box beside it.
            u0, v0, u1, v1 = ((a + b) / 2 for a, b in zip(most, foot, strict=True))
            most = (u0, v0, u1, v1)
        return foot

    def _outline(self, number: int) -> tuple[Floats, Floats]:
        """The triangles (n, 3, 2) of a ledge and the edges (k, 2, 2) on its rim."""
        found = self._outlines.get(number)
        if found is None:
            triangles, rims = _outlined(self._corners[self.number == number])
            found = self._outlines[number] = np.ascontiguousarray(triangles), np.ascontiguousarray(rims)
        return found


def _outlined(triangles: Floats) -> tuple[Floats, Floats]:
    (u, v), (p, q) = ((triangles[:, k] - triangles[:, 0]).T for k in (1, 2))
    triangles = triangles[np.abs(u * q - v * p) > _THIN_M2]
    if not len(triangles):
        return triangles, np.empty((0, 2, 2))
    corners, rows = np.unique(np.round(triangles.reshape(-1, 2) / _WELD_M), axis=0, return_inverse=True)
    corners, rows = corners * _WELD_M, rows.reshape(-1, 3)
    edges = np.concatenate([rows[:, [0, 1, 2]], rows[:, [1, 2, 0]], rows[:, [2, 0, 1]]])
    start, end = edges[:, :2].min(axis=1), edges[:, :2].max(axis=1)
    along, across = corners[end] - corners[start], corners[edges[:, 2]] - corners[start]
    is_left = along[:, 0] * across[:, 1] > along[:, 1] * across[:, 0]
    which, number = np.unique(start * len(corners) + end, return_inverse=True)
    has_left, has_right = np.zeros(len(which), dtype=bool), np.zeros(len(which), dtype=bool)
    has_left[number[is_left]] = has_right[number[~is_left]] = True
    rim = which[has_left != has_right]
    return triangles, np.stack([corners[rim // len(corners)], corners[rim % len(corners)]], axis=1)


@compiled
def covers(triangles: Floats, rims: Floats, foot: Flat) -> bool:
    """Whether triangles (n, 3, 2) with rims (k, 2, 2) wholly cover a rectangle: its middle, and no rim enters it."""
    middle = np.array([(foot[0] + foot[2]) / 2, (foot[1] + foot[3]) / 2])
    return _is_covered(middle, triangles) and not len(_clipped(rims, foot))


def _is_covered(point: Floats, triangles: Floats) -> bool:
    """Whether a point (2,) is in one of the triangles (n, 3, 2)."""
    away = triangles - point
    (ax, bx, cx), (ay, by, cy) = away.transpose(2, 1, 0)
    turns = np.stack([ax * by - ay * bx, bx * cy - by * cx, cx * ay - cy * ax])
    return bool(((turns >= 0).all(axis=0) | (turns <= 0).all(axis=0)).any())


def _clipped(segments: Floats, flat: Flat) -> Floats:
    """The parts (k, 2, 2) of the segments (n, 2, 2) that are in a rectangle, its edges included.

    Source: Y.-D. Liang, B. A. Barsky, A new concept and method for line clipping, ACM Trans. Graphics 3 (1984) 1.
    """
    start, way = segments[:, 0], segments[:, 1] - segments[:, 0]
    low, high = np.array(flat[:2]) - start, np.array(flat[2:]) - start
    level = way == 0
    slope = np.where(level, 1.0, way)
    first, last = np.minimum(low / slope, high / slope), np.maximum(low / slope, high / slope)
    within = (low <= 0) & (high >= 0)
    first = np.where(level, np.where(within, 0.0, np.inf), first).max(axis=1).clip(0.0)
    last = np.where(level, 1.0, last).min(axis=1).clip(None, 1.0)
    meets = first <= last
    first, last, start, way = first[meets, None], last[meets, None], start[meets], way[meets]
    return np.stack([start + first * way, start + last * way], axis=1)
