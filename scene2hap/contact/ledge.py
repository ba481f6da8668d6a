"""Ledges: the level faces of a shape at any height, such as floors, tables, shelves and seats of any outline.

An edge with triangles on one side only is part of a ledge's rim. A rectangle is covered if one of its points is covered
and no rim enters it. Badly joined meshes and overlapping faces give too many rims, never too few.

Free regions: boxes in a concave host's frame that hold nothing of the host, or one of its ledges.

    h : the height along the own axis that points up [m]; u, v : the two other own axes, in their order [m]
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats
from scene2hap.compiled import compiled
from scene2hap.contact.geometry.boxes import Boxes
from scene2hap.contact.geometry.vectors import AABB

Flat = tuple[float, float, float, float]
"""A rectangle: least u, least v, greatest u, greatest v."""

_WELD_M = 1e-6  # Corners this near to each other are merged.
_THIN_M2 = 1e-12  # Triangles with less area are ignored.
_HALVINGS = 4  # Most halvings of a stretch where slanted rims are near.
_MOST_REGIONS = 64  # of one host
_MOST_GUESTS = 256  # of which one host knows the latest region


class VerticalAxis(NamedTuple):
    """The vertical axis of a shape's frame (0, 1 or 2), its sign (1 if it points up, -1 down), and the two others."""

    axis: int
    sign: int
    u: int
    v: int


class Ledges:
    """The ledges of triangles (3, 3, m) whose vertical is an axis of their frame.

    Parameters: boxes : those of the triangles; uneven_m : largest height difference within a ledge [m].
    `number` (m,) is the ledge of each triangle, -1 for none; `tops` (m,) the greatest height of each triangle;
    `heights` the heights of the ledges, ascending.
    """

    def __init__(self, triangles: Floats, boxes: Boxes, upright: VerticalAxis, uneven_m: float) -> None:
        axis, sign, *plane = upright
        low, high = boxes.low[axis], boxes.high[axis]
        top = high if sign > 0 else -low
        self.tops: Floats = top
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
        """Return True if a ledge covers a whole rectangle."""
        return covers(*self._outline(number), foot)

    def stretch(self, number: int, foot: Flat, most: Flat) -> Flat:
        """Return a rectangle that a ledge covers, which contains `foot` and lies in `most`. `foot` must be covered."""
        _, rims = self._outline(number)
        for _ in range(_HALVINGS):
            ends = _clipped(rims, most)
            low, high = ends.min(axis=1), ends.max(axis=1)
            sides = np.stack([low - foot[2:], foot[:2] - high], axis=1).reshape(-1, 4)
            widest = sides.argmax(axis=1)
            gaps = sides[np.arange(len(sides)), widest]
            if (gaps > 0).all():
                least = [gaps[widest == side].min(initial=np.inf) * 0.999 for side in range(4)]
                return (
                    max(most[0], foot[0] - least[2]),
                    max(most[1], foot[1] - least[3]),
                    min(most[2], foot[2] + least[0]),
                    min(most[3], foot[3] + least[1]),
                )
            # The box of a slanted rim overlaps the foot. In a smaller rectangle the rim is shorter, and its box, too.
            u0, v0, u1, v1 = ((a + b) / 2 for a, b in zip(most, foot, strict=True))
            most = (u0, v0, u1, v1)
        return foot

    def _outline(self, number: int) -> tuple[Floats, Floats]:
        """Return the triangles (n, 3, 2) of a ledge and the edges (k, 2, 2) of its rim."""
        found = self._outlines.get(number)
        if found is None:
            triangles, rims = _outlined(self._corners[self.number == number])
            found = self._outlines[number] = np.ascontiguousarray(triangles), np.ascontiguousarray(rims)
        return found


class FreeRegion(NamedTuple):
    """A `box` (u, v, h) in a host's frame, valid while the host's axis `own` points up.

    The host has nothing in it if `top_m` is None. Else it has a ledge at height `top_m` [m], which covers the rectangle
    `ledge`, and nothing above that height.
    """

    own: VerticalAxis
    box: AABB
    top_m: float | None
    ledge: Flat

    def holds(self, taken: AABB) -> bool:
        """Return True if the region contains a box."""
        ((a, b, c), (d, e, f)), ((u0, v0, h0), (u1, v1, h1)) = self.box, taken
        return u0 >= a and v0 >= b and h0 >= c and u1 <= d and v1 <= e and h1 <= f

    def bears(self, foot: Flat) -> bool:
        """Return True if the ledge covers a rectangle."""
        u0, v0, u1, v1 = self.ledge
        return foot[0] >= u0 and foot[1] >= v0 and foot[2] <= u1 and foot[3] <= v1


class FreeRegions:
    """The latest free regions of a host. They depend on the host alone, so that a guest can use another guest's."""

    __slots__ = ("_latest", "_of_guests")

    def __init__(self) -> None:
        self._latest: deque[FreeRegion] = deque(maxlen=_MOST_REGIONS)
        self._of_guests: dict[str, FreeRegion] = {}

    def find(
        self, guest_id: str, serves: Callable[[FreeRegion], bool], compute: Callable[[], FreeRegion | None]
    ) -> FreeRegion | None:
        """Return a region for which `serves` is True, the guest's last one first; else compute one, if possible."""
        known = self._of_guests.get(guest_id)
        if known is not None and serves(known):
            return known
        found = next(filter(serves, self._latest), None)
        if found is None:
            found = compute()
            if found is None:
                return None
            self._latest.appendleft(found)
        if len(self._of_guests) >= _MOST_GUESTS:
            # Removed guests are not reported, so all are cleared. This costs each of the others one search.
            self._of_guests.clear()
        self._of_guests[guest_id] = found
        return found


def _outlined(triangles: Floats) -> tuple[Floats, Floats]:
    """Return the triangles (n, 3, 2) with area, and the edges (k, 2, 2) with triangles on one side only."""
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
    """Return True if triangles (n, 3, 2) cover a rectangle: they cover its middle, and no rim (k, 2, 2) enters it."""
    middle = np.array([(foot[0] + foot[2]) / 2, (foot[1] + foot[3]) / 2])
    return _is_covered(middle, triangles) and not len(_clipped(rims, foot))


def _is_covered(point: Floats, triangles: Floats) -> bool:
    """Return True if a point (2,) is in one of the triangles (n, 3, 2)."""
    away = triangles - point
    (ax, bx, cx), (ay, by, cy) = away.transpose(2, 1, 0)
    turns = np.stack([ax * by - ay * bx, bx * cy - by * cx, cx * ay - cy * ax])
    return bool(((turns >= 0).all(axis=0) | (turns <= 0).all(axis=0)).any())


def _clipped(segments: Floats, flat: Flat) -> Floats:
    """Clip segments (n, 2, 2) to a rectangle, edges included. Returns the remaining parts (k, 2, 2).

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
