"""Distance, contact points and fall distances of two posed triangle meshes.

Meshes are surfaces, not volumes. Intersecting surfaces have distance 0. An object inside a closed mesh, out of reach of
its surface, does not touch it: a chair in a room does not touch the room's walls.

The kernels work in the frame of one mesh, the host, so that a rigid motion of both changes only the last bits. They
compare pairs of triangles whose boxes are within reach. The order has no effect: results are minima over all pairs,
with ties broken by coordinates or by the triangles' columns. The compiled kernels find the pairs by descending two
`TriangleTree`s at once, the plain ones by comparing boxes.

Farthest-point sampling (`spread`) chooses a few of many contact points, beginning with the one farthest from the lowest
corner of the guest's box.

    turn, shift : rotation matrix in rows and position [m] of the guest in the host's frame
    p, q        : a triangle of the guest, of the host
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.compiled import compiled
from scene2hap.contact.body import Body
from scene2hap.contact.geometry.boxes import Boxes, box_pairs, boxes_of
from scene2hap.contact.geometry.spread import spread
from scene2hap.contact.geometry.triangles import heights, meetings
from scene2hap.contact.geometry.vectors import (
    Rows,
    Triple,
    cross,
    dot,
    rotated,
    transposed,
    upright_frame,
)
from scene2hap.contact.shape import Shape

ROUNDING_M = 1e-9
"""Distances below this are rounding errors."""


class Gap(NamedTuple):
    """The least distance of two surfaces [m], and the vector (3,) from `a` to `b` between the nearest points [m]."""

    distance_m: float
    way_m: Triple


class ContactPoint(NamedTuple):
    """A contact point: its end points on the surfaces of a and of b in the world [m]."""

    on_a_m: Triple
    on_b_m: Triple

    @property
    def middle_m(self) -> Triple:
        """The point half way between the two ends [m]."""
        (a, b, c), (d, e, f) = self
        return ((a + d) / 2, (b + e) / 2, (c + f) / 2)


class MeshPair:
    """Two posed meshes. The larger is the host; a, if they have the same size."""

    def __init__(self, a: Body, b: Body) -> None:
        self.guest_is_a: bool = a.size_m < b.size_m
        self.guest: Body
        self.host: Body
        self.guest, self.host = (a, b) if self.guest_is_a else (b, a)
        self._rows = self.host.stance.rows
        back = self._back = transposed(self._rows)
        (x, y, z), (u, v, w) = self.guest.position_m, self.host.position_m
        self._turn = _product(back, self.guest.stance.rows)
        self._shift = rotated(back, (x - u, y - v, z - w))

    def gap(self, within_m: float) -> Gap | None:
        """Return the least distance, None if it is more than `within_m`."""
        found = closest_points(self.host.shape, self.guest.shape, self._turn, self._shift, max(within_m, ROUNDING_M))
        if found is None:
            return None
        distance, (x, y, z), (u, v, w) = found
        if distance <= ROUNDING_M:
            return Gap(0.0, (0.0, 0.0, 0.0))
        sign = 1.0 if self.guest_is_a else -1.0
        return Gap(distance, rotated(self._rows, (sign * (u - x), sign * (v - y), sign * (w - z))))

    def patch(self, way_m: Triple, within_m: float) -> list[ContactPoint]:
        """Return the contact manifold that results when `a` moves by `way_m` [m] in the world.

        These are up to `spread.MAX_POINTS` points, far from each other, at which the moved surfaces are at most
        `within_m` apart. Their ends are given for the bodies' present poses.
        """
        x, y, z = rotated(self._back, way_m)
        way = (x, y, z) if self.guest_is_a else (-x, -y, -z)
        host, guest, place = self.host, self.guest, (self._rows, self.host.position_m)
        ends = contact_points(host.shape, guest.shape, self._turn, self._shift, way, max(within_m, ROUNDING_M), place)
        if self.guest_is_a:
            return [ContactPoint(on_guest, on_host) for on_guest, on_host in ends]
        return [ContactPoint(on_host, on_guest) for on_guest, on_host in ends]

    def drops(self, faller: Body, reach_m: float, touch_m: float) -> Floats | None:
        """Return the fall distance of each triangle (m,) of `faller`, one of the two, onto the other [m].

        None if no triangle meets the other within `reach_m`. Only triangles within `reach_m` above the faller's lowest
        point are dropped, and only onto triangles level enough to hold them. A triangle that is sunk in by up to
        `touch_m` has a negative distance, one that is sunk in deeper 0. A distance of more than `touch_m` above the
        least becomes inf, since the faller rests before.
        """
        return drops(*self._falling(faller, reach_m, touch_m))

    def first_drop_m(self, faller: Body, reach_m: float, touch_m: float) -> float:
        """Return the least of the distances of `drops` [m], inf if there is none."""
        return first_drop(*self._falling(faller, reach_m, touch_m))

    def _falling(
        self, faller: Body, reach_m: float, touch_m: float
    ) -> tuple[Shape, Shape, Rows, Triple, Rows, Triple, bool]:
        up = faller.up_axis
        limits = (faller.low[up] - self.host.position_m[up], reach_m, touch_m)
        frame = upright_frame(self._rows[up])
        return self.host.shape, self.guest.shape, self._turn, self._shift, frame, limits, faller is self.guest


@compiled
def closest_points(
    host: Shape, guest: Shape, turn: Rows, shift: Triple, within: float
) -> tuple[float, Triple, Triple] | None:
    """Return the least distance of two meshes and its end points on guest and host, None beyond `within`.

    All [m], in the host's frame. Of equal distances, the pair with the lowest column of the guest, then of the host, is
    chosen. If the distance is below `ROUNDING_M`, any pair may be chosen.
    """
    best: tuple[float, int, int] | None = None
    ends = None
    posed = _posed(guest.triangles, turn, shift)
    for i, j in box_pairs(boxes_of(posed).grown(within + ROUNDING_M), host.boxes):
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
def contact_points(
    host: Shape, guest: Shape, turn: Rows, shift: Triple, way: Triple, within: float, place: tuple[Rows, Triple]
) -> list[tuple[Triple, Triple]]:
    """Return up to `spread.MAX_POINTS` pairs of points on guest and host that are at most `within` apart once the guest
    has moved by `way`. The points on the guest are given before that movement.

    Parameters: way, within : in the host's frame [m]; place : rotation and position [m] of the host in the world, in
    which the points are returned.
    """
    x, y, z = shift
    u, v, w = rotated(turn, _triple(guest.low))
    posed = _posed(guest.triangles, turn, (x + way[0], y + way[1], z + way[2]))
    # Loose crossings count where there is nothing else.
    ends = _ends_within(host, guest, posed, way, within, within)
    if not ends.size:
        ends = _ends_within(host, guest, posed, way, within, -1.0)
    ends = ends[:, np.lexsort(ends[::-1])]
    middles = ((ends[:3] + ends[3:]) / 2).T.tolist()
    chosen = spread(middles, (u + x, v + y, w + z)) if middles else []
    return [(_placed(ends[:3, k], *place), _placed(ends[3:, k], *place)) for k in chosen]


def _ends_within(host: Shape, guest: Shape, posed: Floats, way: Triple, within: float, loose: float) -> Floats:
    """Return the ends (6, n) of contact points without crossings between ends within `loose`."""
    found = [np.empty((6, 0))]
    for i, j in box_pairs(boxes_of(posed).grown(within + ROUNDING_M), host.boxes):
        p, q = posed.take(i, axis=2), host.triangles.take(j, axis=2)
        every = meetings(p, q, guest.features[i], host.features[j], loose)
        near = every.distance <= within
        found.append(np.concatenate([every.on_p[:, near] - np.array(way)[:, None], every.on_q[:, near]]))
    return np.concatenate(found, axis=1)


@compiled
def drops(
    host: Shape, guest: Shape, turn: Rows, shift: Triple, frame: Rows, limits: Triple, guest_falls: bool
) -> Floats | None:
    """Return the fall distances of `MeshPair.drops` (m,) [m].

    Parameters: frame : two level axes and up, as rows in the host's frame; limits : height of the faller's lowest point
    over the host's position, reach and touch [m].
    """
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
        least, most = heights(p.take(i, axis=2), q.take(j, axis=2))
        meets = (least >= -reach) & (least <= reach) & (most >= -touch)
        fall = np.where(least >= -touch, least, 0.0)
        np.minimum.at(each, fallers[i[meets]], fall[meets])
    first = each.min(initial=np.inf)
    each[each > first + touch] = np.inf
    return each if first < np.inf else None


@compiled
def first_drop(
    host: Shape, guest: Shape, turn: Rows, shift: Triple, frame: Rows, limits: Triple, guest_falls: bool
) -> float:
    """Return the least of `drops` [m], inf if there is none."""
    each = drops(host, guest, turn, shift, frame, limits, guest_falls)
    return math.inf if each is None else float(each.min())


# Least cosine of a slope that holds an object (assumed). A wall's triangles hold nothing.
_HOLDING = 0.5
# A falling triangle is shrunk by this share, and by at most this length [m]. Then equal boxes on each other, whose rims
# coincide, surely overlap in plan, and boxes exactly side by side surely do not.
INSET, INSET_M = 1e-4, 1e-4


def _is_level(triangles: Floats) -> Floats:
    """Mark the triangles (3, 3, m), in an upright frame, that are level enough to hold an object."""
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
    """Transform triangles (3, 3, m). Sums are spelled out, for bits equal to those of the compiled kernels."""
    x, y, z = triangles
    posed = np.empty(triangles.shape)
    for axis, ((a, b, c), d) in enumerate(zip(turn, shift, strict=True)):
        posed[axis] = a * x + b * y + c * z + d
    return posed


def _product(one: Rows, other: Rows) -> Rows:
    """Return the matrix product."""
    columns = transposed(other)
    return (rotated(columns, one[0]), rotated(columns, one[1]), rotated(columns, one[2]))


def _placed(point: Floats, turn: Rows, shift: Triple) -> Triple:
    (x, y, z), (u, v, w) = rotated(turn, _triple(point)), shift
    return (x + u, y + v, z + w)


def _triple(point: Floats) -> Triple:
    x, y, z = point.tolist()
    return (x, y, z)
