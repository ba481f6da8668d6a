"""Distance, contact points and drop of two posed triangle meshes.

Meshes are surfaces, not volumes: surfaces that cut each other have distance 0, but an object wholly inside a closed
other one, out of reach of its surface, does not touch it, as a chair in a room does not touch the room's walls.

The kernels work in the frame of one of the two, the host, so that moving both rigidly changes nothing but the last
bits. They look at pairs of triangles whose boxes are within reach, in any order: their answers are the least over all
pairs, with ties broken by coordinates or by the triangles' columns. The compiled kernels find these pairs by
descending two `TriangleTree`s at once, the plain ones by sorting boxes.

    turn, shift : rotation in rows and position [m] of the guest in the host's frame
    p, q        : a triangle of the guest, of the host
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple, Protocol

import numpy as np

from scene2hap.compiled import compiled
from scene2hap.contact.broad import Boxes, box_pairs
from scene2hap.contact.shape import Shape, boxes_of
from scene2hap.contact.spread import spread
from scene2hap.contact.triangles import clearances, heights, meetings
from scene2hap.contact.vectors import Floats, Indices, Rows, Triple, cross, dot, rotated, transposed

ROUNDING_M = 1e-9
"""Below this a distance is rounding."""

_POINT = Shape(np.zeros((3, 3, 1)), np.zeros((1, 3)))  # a triangle without extent
_NOT_TURNED: Rows = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_BATCH = 4096  # Pairs of triangles in a plain kernel at once: some 10 MB.


class Placed(Protocol):
    """A shape at a place."""

    @property
    def shape(self) -> Shape:
        """Its triangles."""

    @property
    def rows(self) -> Rows:
        """Its rotation, in rows."""

    @property
    def position_m(self) -> Triple:
        """Where the origin of its frame is."""

    @property
    def size_m(self) -> float:
        """Diagonal of its own bounding box."""


class Gap(NamedTuple):
    """The least distance of two surfaces [m], and the vector (3,) [m] from `a` to `b` there, in the world."""

    distance_m: float
    way_m: Triple


class Ends(NamedTuple):
    """A contact point: its ends on the surfaces of a and of b in the world [m]."""

    on_a_m: Triple
    on_b_m: Triple

    @property
    def middle_m(self) -> Triple:
        """The point half way between."""
        (a, b, c), (d, e, f) = self
        return ((a + d) / 2, (b + e) / 2, (c + f) / 2)


class MeshPair:
    """Two posed meshes. The larger of the two is the host; of equals, a."""

    def __init__(self, a: Placed, b: Placed) -> None:
        self.guest_is_a = a.size_m < b.size_m
        self.guest, self.host = (a, b) if self.guest_is_a else (b, a)
        self._rows = self.host.rows
        back = self._back = transposed(self._rows)
        (x, y, z), (u, v, w) = self.guest.position_m, self.host.position_m
        self._turn = _product(back, self.guest.rows)
        self._shift = rotated(back, (x - u, y - v, z - w))

    def gap(self, within_m: float) -> Gap | None:
        """The least distance, None if it is more than `within_m`."""
        found = closest_points(self.host.shape, self.guest.shape, self._turn, self._shift, max(within_m, ROUNDING_M))
        if found is None:
            return None
        distance, (x, y, z), (u, v, w) = found
        if distance <= ROUNDING_M:
            return Gap(0.0, (0.0, 0.0, 0.0))
        sign = 1.0 if self.guest_is_a else -1.0
        return Gap(distance, rotated(self._rows, (sign * (u - x), sign * (v - y), sign * (w - z))))

    def patch(self, way_m: Triple, within_m: float) -> list[Ends]:
        """Where the surfaces are at most `within_m` apart once `a` has moved by `way_m` [m] in the world: up to
        `spread.MAX_POINTS` points far from each other, with their ends where the bodies are now."""
        x, y, z = rotated(self._back, way_m)
        way = (x, y, z) if self.guest_is_a else (-x, -y, -z)
        found = contact_points(
            self.host.shape, self.guest.shape, self._turn, self._shift, way, max(within_m, ROUNDING_M)
        )
        ends = [(self._placed(on_guest), self._placed(on_host)) for on_guest, on_host in found]
        return [Ends(*pair) if self.guest_is_a else Ends(*reversed(pair)) for pair in ends]

    def drops(self, faller: Placed, up_axis: int, lowest_m: float, reach_m: float, touch_m: float) -> Floats | None:
        """How far each triangle (m,) of `faller`, one of the two, may fall before it meets the other [m]; None if none
        does within `reach_m`.

        Only the faller's bottom falls, all within `reach_m` of `lowest_m`, the height of its lowest point, and only
        onto triangles that are level enough to hold it. A triangle that is sunk in by up to `touch_m` falls by less
        than nothing, and one that is sunk in deeper by nothing. A triangle that would fall `touch_m` farther than
        another, which has come to rest by then, falls by inf.
        """
        return drops(*self._falling(faller, up_axis, lowest_m, reach_m, touch_m))

    def first_drop_m(self, faller: Placed, up_axis: int, lowest_m: float, reach_m: float, touch_m: float) -> float:
        """The least of these, inf if there is none."""
        return first_drop(*self._falling(faller, up_axis, lowest_m, reach_m, touch_m))

    def _falling(
        self, faller: Placed, up_axis: int, lowest_m: float, reach_m: float, touch_m: float
    ) -> tuple[Shape, Shape, Rows, Triple, Rows, Triple, bool]:
        limits = (lowest_m - self.host.position_m[up_axis], reach_m, touch_m)
        frame = upright_frame(self._rows[up_axis])
        return self.host.shape, self.guest.shape, self._turn, self._shift, frame, limits, faller is self.guest

    def _placed(self, point: Triple) -> Triple:
        (x, y, z), (u, v, w) = rotated(self._rows, point), self.host.position_m
        return (x + u, y + v, z + w)


@compiled
def closest_points(
    host: Shape, guest: Shape, turn: Rows, shift: Triple, within: float
) -> tuple[float, Triple, Triple] | None:
    """The least distance of two meshes and its ends on guest and host, None beyond `within`. All [m], in the host's
    frame. Of equal distances the pair with the lowest column of the guest, then of the host counts. Below `ROUNDING_M`
    any pair may be given."""
    best: tuple[float, int, int] | None = None
    ends = None
    posed = _posed(guest.triangles, turn, shift)
    for i, j in _near(posed, boxes_of(posed), host, within):
        p, q = posed.take(i, axis=2), host.triangles.take(j, axis=2)
        every = meetings(p, q, guest.features[i], host.features[j])
        row = every.distance.argmin(axis=0)
        distance = every.distance[row, np.arange(len(i))]
        for k in np.flatnonzero(distance <= within).tolist():
            key = (float(distance[k]), int(i[k]), int(j[k]))
            if best is None or key < best:
                best = key
                ends = _triple(every.on_p[:, row[k], k]), _triple(every.on_q[:, row[k], k])
    return None if best is None or ends is None else (best[0], *ends)


@compiled
def surface_distance(host: Shape, point: Triple, within: float) -> float | None:
    """How far a point of its frame is from a mesh's surface, None beyond `within`. All [m]."""
    found = closest_points(host, _POINT, _NOT_TURNED, point, within)
    return None if found is None else found[0]


@compiled
def contact_points(
    host: Shape, guest: Shape, turn: Rows, shift: Triple, way: Triple, within: float
) -> list[tuple[Triple, Triple]]:
    """Up to `spread.MAX_POINTS` points on guest and host that are at most `within` apart once the guest has moved by
    `way`; the guest's are given before it has. All [m], in the host's frame."""
    x, y, z = shift
    posed = _posed(guest.triangles, turn, (x + way[0], y + way[1], z + way[2]))
    found = [np.empty((6, 0))]
    for i, j in _near(posed, boxes_of(posed), host, within):
        p, q = posed.take(i, axis=2), host.triangles.take(j, axis=2)
        every = meetings(p, q, guest.features[i], host.features[j])
        near = every.distance <= within
        found.append(np.concatenate([every.on_p[:, near] - np.array(way)[:, None], every.on_q[:, near]]))
    ends = np.concatenate(found, axis=1)
    ends = ends[:, np.lexsort(ends[::-1])]
    chosen = spread((ends[:3] + ends[3:]) / 2)
    return [(_triple(ends[:3, k]), _triple(ends[3:, k])) for k in chosen]


@compiled
def drops(
    host: Shape, guest: Shape, turn: Rows, shift: Triple, frame: Rows, limits: Triple, guest_falls: bool
) -> Floats | None:
    """See `MeshPair.drops`. frame : two level axes and up, in the host's frame; limits : height of the faller's lowest
    point over the host's position, reach and touch [m]."""
    lowest, reach, touch = limits
    of_guest = _posed(guest.triangles, _product(frame, turn), rotated(frame, shift))
    of_host = _posed(host.triangles, frame, (0.0, 0.0, 0.0))
    falling, bearing = (of_guest, of_host) if guest_falls else (of_host, of_guest)
    fallers = np.flatnonzero(falling[2].min(axis=0) <= lowest + reach)
    bearers = np.flatnonzero(_is_level(bearing))
    each = np.full(falling.shape[2], np.inf)
    p, q = falling.take(fallers, axis=2), bearing.take(bearers, axis=2)
    low, high = boxes_of(p)
    margin = np.full((3, 1), ROUNDING_M)
    margin[2] += reach
    swept = Boxes(low - margin, high + touch + ROUNDING_M)
    p = _inset(p)
    for i, j in box_pairs(swept, boxes_of(q)):
        for start in range(0, len(i), _BATCH):
            some = slice(start, start + _BATCH)
            least, most = heights(p.take(i[some], axis=2), q.take(j[some], axis=2))
            meets = (least >= -reach) & (least <= reach) & (most >= -touch)
            fall = np.where(least >= -touch, least, 0.0)
            np.minimum.at(each, fallers[i[some][meets]], fall[meets])
    first = each.min(initial=np.inf)
    each[each > first + touch] = np.inf
    return each if first < np.inf else None


@compiled
def first_drop(
    host: Shape, guest: Shape, turn: Rows, shift: Triple, frame: Rows, limits: Triple, guest_falls: bool
) -> float:
    """The least of `drops` [m], inf if there is none."""
    each = drops(host, guest, turn, shift, frame, limits, guest_falls)
    return math.inf if each is None else float(each.min())


def _near(posed: Floats, boxes: Boxes, host: Shape, within: float) -> Iterator[tuple[Indices, Indices]]:
    """Columns (n,) of the pairs of posed guest's and host's triangles that may be within reach, in batches."""
    for i, j in box_pairs(boxes.grown(within + ROUNDING_M), host.boxes):
        for start in range(0, len(i), _BATCH):
            some = slice(start, start + _BATCH)
            p, q = posed.take(i[some], axis=2), host.triangles.take(j[some], axis=2)
            close = clearances(p, q) <= within + ROUNDING_M
            yield i[some][close], j[some][close]


# Least cosine of a slope that holds an object (assumed): a wall's triangles hold nothing.
_HOLDING = 0.5
# A falling triangle is shrunk by this share, by at most so much [m]: equal boxes on each other, whose rims coincide,
# then surely lie over each other, and boxes exactly side by side surely do not.
INSET, INSET_M = 1e-4, 1e-4


def _is_level(triangles: Floats) -> Floats:
    """Whether triangles (3, 3, m) in an upright frame are level enough to hold an object."""
    normals = cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.sqrt(dot(normals, normals))
    level: Floats = (length > 0) & (np.abs(normals[2]) >= _HOLDING * length)
    return level


def _inset(triangles: Floats) -> Floats:
    middles: Floats = (triangles[:, 0] + triangles[:, 1] + triangles[:, 2]) / 3
    inwards = middles[:, None] - triangles
    extent = np.abs(inwards).reshape(9, -1).max(axis=0)
    inwards *= np.minimum(INSET, INSET_M / np.maximum(extent, INSET_M))
    inwards += triangles
    return inwards


def _posed(triangles: Floats, turn: Rows, shift: Triple) -> Floats:
    """Triangles (3, 3, m) in another frame. Sums are spelled out, as the compiled kernels take them."""
    x, y, z = triangles
    posed = np.empty(triangles.shape)
    for axis, ((a, b, c), d) in enumerate(zip(turn, shift, strict=True)):
        posed[axis] = a * x + b * y + c * z + d
    return posed


def _product(one: Rows, other: Rows) -> Rows:
    """Matrix product."""
    a, b, c = (rotated(transposed(other), row) for row in one)
    return (a, b, c)


def upright_frame(up: Triple) -> Rows:
    """An orthonormal frame in rows: two directions across `up`, and that."""
    x, y, z = up
    length = math.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    # Across the axis that is farthest from up.
    if abs(x) <= abs(y) and abs(x) <= abs(z):
        a, b, c = 0.0, z, -y
    elif abs(y) <= abs(z):
        a, b, c = -z, 0.0, x
    else:
        a, b, c = y, -x, 0.0
    length = math.sqrt(a * a + b * b + c * c)
    a, b, c = a / length, b / length, c / length
    return ((a, b, c), (y * c - z * b, z * a - x * c, x * b - y * a), (x, y, z))


def _triple(point: Floats) -> Triple:
    x, y, z = point.tolist()
    return (x, y, z)
