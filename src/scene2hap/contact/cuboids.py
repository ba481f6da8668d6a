"""Cuboids, many pairs at once: how far their surfaces are apart.

Everything is told in the frame of the first of a pair, the host, and the pairs are the last axis of all arrays. Sums
are spelled out, since numpy's own take another order when there is but one pair: a pair's answer, to the last bit, must
not depend on which others are asked for with it.

Sources: S. Gottschalk, M. C. Lin, D. Manocha, OBBTree, SIGGRAPH (1996) 171 (15 axes); C. Ericson, Real-Time Collision
Detection (2005), sections 4.4.1 and 5.1.9.

    turn  : (3, 3, n) [-], the guest's axes in its columns     a, b   : (3, n), half edges of host and guest [m]
    shift : (3, n) [m], the guest's middle                     s, u   : place on an edge of host, of guest [m]
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
Marks = NDArray[np.bool_]

NEXT, LAST = np.array([1, 2, 0]), np.array([2, 0, 1])
SIGNS = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]).T
"""The corners (3, 8) of a cuboid in half edges."""
# Twelve edges: their axis, and their middles (3, 12) in half edges.
AXES = np.repeat(np.arange(3), 4)
MIDDLES = np.zeros((3, 12))
for _edge in range(12):
    _axis = _edge // 4
    MIDDLES[NEXT[_axis], _edge], MIDDLES[LAST[_axis], _edge] = 1.0 - (_edge & 1) * 2.0, 1.0 - (_edge & 2)
# Squared sine below which two edges are parallel: corners then tell the same.
_PARALLEL = 1e-12
# Cosine below which a normal of two edges may be one of a face as well, of which any edge could be meant.
_ASKEW = 1e-6
_ROWS = np.arange(3)[:, None]
FLUSH_M = 1e-9
"""What is inside another but for rounding is inside."""
# A corner as near as the faces' planes are apart has no nearer rival.
_SETTLED_M = 1e-12


class Pairs:
    """Pairs of cuboids; see the table above. All is one array (18, n), since numpy's cost is per call."""

    __slots__ = ("a", "b", "shift", "table", "turn")

    def __init__(self, table: Floats) -> None:
        self.table = table
        self.turn, self.shift, self.a, self.b = table[:9].reshape(3, 3, -1), table[9:12], table[12:15], table[15:]

    @classmethod
    def of(cls, turn: Floats, shift: Floats, a: Floats, b: Floats) -> Pairs:
        """From the parts."""
        return cls(np.concatenate([turn.reshape(9, -1), shift, a, b]))

    def rows(self, rows: Indices) -> Pairs:
        """Some of the pairs."""
        return self if len(rows) == self.table.shape[1] else Pairs(self.table.take(rows, axis=1))

    def swapped(self) -> Pairs:
        """Guests as hosts."""
        return Pairs.of(self.turn.transpose(1, 0, 2), -dot(self.turn, self.shift[:, None]), self.b, self.a)

    def to_host(self, points: Floats) -> Floats:
        """Points (3, k, n) of the guest's frame in the host's."""
        return self.shift[:, None] + times(self.turn, points)

    def guest_corners(self) -> Floats:
        """(3, 8, n) [m]."""
        return self.to_host(SIGNS[..., None] * self.b[:, None])


class Ends(NamedTuple):
    """Places where the surfaces come near: distance (k, n) [m], inf for none, and the ends (3, k, n) [m]."""

    distance_m: Floats
    on_host: Floats
    on_guest: Floats

    def joined(self, more: Ends) -> Ends:
        """These and more of the same pairs."""
        return Ends(
            np.concatenate([self.distance_m, more.distance_m]),
            np.concatenate([self.on_host, more.on_host], axis=1),
            np.concatenate([self.on_guest, more.on_guest], axis=1),
        )


class Gaps:
    """How far pairs are apart, again one array (15, n).

    `distance_m` (n,) of the surfaces, 0 where they cut each other, and `way_m` (3, n) there, from host to guest;
    `least_m` (n,), how far planes between the two are apart at most, negative by how deep they are sunk in; `edges`
    (n,), as told by `edge_clearance`; `on_host`, `on_guest` and `inner` (3, n), as told by `clearance`.
    """

    __slots__ = ("distance_m", "inner", "least_m", "on_guest", "on_host", "table", "way_m")

    def __init__(self, table: Floats) -> None:
        self.table = table
        self.distance_m, self.least_m, self.way_m = table[0], table[1], table[3:6]
        self.on_host, self.on_guest, self.inner = table[6:9], table[9:12], table[12:]

    @property
    def edges(self) -> Indices:
        """See above."""
        edges: Indices = self.table[2].astype(np.intp)
        return edges

    def rows(self, rows: Indices) -> Gaps:
        """Those of some of the pairs."""
        return self if len(rows) == self.table.shape[1] else Gaps(self.table.take(rows, axis=1))


def dot(x: Floats, y: Floats) -> Floats:
    """Sum over the first axis, of length 3."""
    product: Floats = x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
    return product


def times(turn: Floats, points: Floats) -> Floats:
    """Turned points (3, k, n)."""
    turned: Floats = (
        turn[:, 0, None] * points[None, 0] + turn[:, 1, None] * points[None, 1] + turn[:, 2, None] * points[None, 2]
    )
    return turned


def clearance(pairs: Pairs) -> Floats:
    """How far pairs are apart along the axes of faces (9, n) [m], negative where they overlap: three of the host, three
    of the guest; and how deep all of the guest is inside the host along the host's, negative where not all of it is."""
    turn, shift, a, b = pairs.turn, pairs.shift, pairs.a, pairs.b
    reach = np.abs(turn)
    wide = reach[:, 0] * b[0] + reach[:, 1] * b[1] + reach[:, 2] * b[2]
    off = np.abs(shift)
    found = np.empty((9, shift.shape[1]))
    found[:3] = off - (a + wide)
    found[3:6] = np.abs(dot(turn, shift[:, None])) - (b + dot(reach, a[:, None]))
    found[6:] = a - off - wide
    return found


def edge_clearance(pairs: Pairs) -> tuple[Floats, Indices]:
    """How far pairs are apart along the nine normals of two edges (n,) [m], the most of them, and of which edges it is:
    three times the host's axis and the guest's."""
    turn, shift, a, b = pairs.turn, pairs.shift, pairs.a, pairs.b
    reach = np.abs(turn)
    on_next, on_last = turn[NEXT], turn[LAST]
    apart = np.abs(shift[LAST][:, None] * on_next - shift[NEXT][:, None] * on_last)
    apart -= a[NEXT][:, None] * reach[LAST] + a[LAST][:, None] * reach[NEXT]
    apart -= b[NEXT] * reach[:, LAST] + b[LAST] * reach[:, NEXT]
    sine2 = on_next * on_next + on_last * on_last
    skew = sine2 > _PARALLEL
    apart /= np.sqrt(np.where(skew, sine2, 1.0))
    apart = np.where(skew, apart, -np.inf).reshape(9, -1)
    edges = apart.argmax(axis=0)
    return apart[edges, np.arange(len(edges))], edges


def gaps(pairs: Pairs, within_m: float) -> tuple[Indices, Gaps]:
    """The rows of pairs whose surfaces are at most `within_m` apart, and how far they are."""
    clear = clearance(pairs)
    flat, inner = clear[:6].max(axis=0), clear[6:].min(axis=0)
    rows = np.flatnonzero((flat <= within_m) & (inner <= within_m))
    pairs, flat, inner = pairs.rows(rows), flat[rows], inner[rows]
    found = Gaps(np.zeros((15, len(rows))))
    found.table[6:] = clear.take(rows, axis=1)
    of_edges, edges = edge_clearance(pairs)
    found.table[2] = edges
    distance, way, least = found.distance_m, found.way_m, found.least_m
    np.maximum(flat, of_edges, out=least)
    inside = np.flatnonzero(inner > -FLUSH_M)
    if len(inside):
        distance[inside] = np.maximum(inner[inside], 0.0)
        way[:, inside] = _way_inside(pairs.shift[:, inside], found.inner[:, inside])
    apart = np.flatnonzero((least > 0) & (least <= within_m))
    if len(apart):
        distance[apart], way[:, apart] = _apart(pairs.rows(apart), flat[apart], edges[apart])
    near = np.flatnonzero((distance <= within_m) & (least <= within_m))
    return rows[near], found.rows(near)


def ends_of(pairs: Pairs, edges: Indices) -> tuple[Ends, Marks]:
    """Where each corner of either, and of the edges those two that could be, are nearest; and for which pairs (n,) only
    `all_ends` can tell which edges that are."""
    of_edges, unsure = _edge_ends(pairs, edges)
    return _corner_ends(pairs).joined(of_edges), unsure


def all_ends(pairs: Pairs) -> Ends:
    """All places where a corner of either or an edge of both could be the nearest."""
    return _corner_ends(pairs).joined(_all_edge_ends(pairs))


def _apart(pairs: Pairs, flat_m: Floats, edges: Indices) -> tuple[Floats, Floats]:
    """Distances (n,) and ways (3, n) of pairs that are apart."""
    distance, way = _nearest(_corner_ends(pairs))
    open_ = np.flatnonzero(distance > flat_m + _SETTLED_M)
    if len(open_):
        ends, unsure = _edge_ends(pairs.rows(open_), edges[open_])
        _shorten(distance, way, open_, ends)
        open_ = open_[unsure]
    if len(open_):
        _shorten(distance, way, open_, _all_edge_ends(pairs.rows(open_)))
    return distance, way


def _shorten(distance: Floats, way: Floats, rows: Indices, ends: Ends) -> None:
    less, ways = _nearest(ends)
    nearer = less < distance[rows]
    distance[rows[nearer]], way[:, rows[nearer]] = less[nearer], ways[:, nearer]


def _nearest(ends: Ends) -> tuple[Floats, Floats]:
    k = ends.distance_m.argmin(axis=0)
    columns = np.arange(len(k))
    return ends.distance_m[k, columns], (ends.on_guest - ends.on_host)[:, k, columns]


def _corner_ends(pairs: Pairs) -> Ends:
    """Each corner and the other's nearest point, 16 in all; corners inside the other have distance 0."""
    corners = pairs.guest_corners()
    on_host = _clamped(corners, pairs.a)
    own = pairs.swapped().guest_corners()
    tips = np.broadcast_to(SIGNS[..., None] * pairs.a[:, None], own.shape)
    on_guest = pairs.to_host(_clamped(own, pairs.b))
    return Ends(_lengths(corners - on_host), on_host, corners).joined(Ends(_lengths(on_guest - tips), tips, on_guest))


def _edge_ends(pairs: Pairs, edges: Indices) -> tuple[Ends, Marks]:
    """The two edges of these axes that face each other, where their nearest points are not their ends; and for which
    pairs (n,) there are others that face each other as well.

    Of two that are nearest each other along edges, these are the ones: their common normal parts the two farthest.
    """
    columns, (i, j) = np.arange(len(edges)), np.divmod(edges, 3)
    order = np.stack([i, NEXT[i], LAST[i]])
    turn, shift, a = pairs.turn[order[:, None], _ROWS, columns], pairs.shift[order, columns], pairs.a[order, columns]
    along, half = turn[:, j, columns], pairs.b[j, columns]
    sine2 = along[1] * along[1] + along[2] * along[2]
    side = np.where(shift[2] * along[1] < shift[1] * along[2], -1.0, 1.0) / np.sqrt(sine2)
    n1, n2 = -side * along[2], side * along[1]
    on_host = np.stack([np.zeros_like(n1), np.where(n1 < 0, -a[1], a[1]), np.where(n2 < 0, -a[2], a[2])])
    on_guest, least = shift, np.minimum(np.abs(n1), np.abs(n2))
    for axis in (NEXT[j], LAST[j]):
        other = turn[:, axis, columns]
        lean = n1 * other[1] + n2 * other[2]
        on_guest = on_guest - np.where(lean < 0, -1.0, 1.0) * pairs.b[axis, columns] * other
        least = np.minimum(least, np.abs(lean))
    between = on_guest - on_host
    on_a, on_b, cosine = between[0], dot(between, along), along[0]
    s, u = (on_a - cosine * on_b) / sine2, (cosine * on_a - on_b) / sine2
    on_host[0] = s
    on_guest = on_guest + u * along
    meets = (np.abs(s) <= a[0]) & (np.abs(u) <= half)
    distance = np.where(meets, _lengths(on_guest - on_host), np.inf)
    placed = np.empty((2, *on_host.shape))
    placed[:, order, columns] = on_host, on_guest
    return Ends(distance[None], placed[0][:, None], placed[1][:, None]), least < _ASKEW


def _all_edge_ends(pairs: Pairs) -> Ends:
    """The 144 pairs of edges, where their nearest points are not their ends."""
    turn, shift, a, b = pairs.turn, pairs.shift, pairs.a, pairs.b
    n = shift.shape[1]
    host = (MIDDLES[..., None] * a[:, None])[:, :, None]
    guest = (shift[:, None] + times(turn, MIDDLES[..., None] * b[:, None]))[:, None]
    along = turn[:, AXES][:, None]
    cosine = turn[AXES][:, AXES]
    sine2 = (turn[NEXT] ** 2 + turn[LAST] ** 2)[AXES][:, AXES]
    between = guest - host
    on_a = np.concatenate([between[axis, 4 * axis : 4 * axis + 4] for axis in range(3)])
    on_b = dot(between, along)
    skew = sine2 > _PARALLEL
    sine2 = np.where(skew, sine2, 1.0)
    s, u = (on_a - cosine * on_b) / sine2, (cosine * on_a - on_b) / sine2
    meets = skew & (np.abs(s) <= a[AXES][:, None]) & (np.abs(u) <= b[AXES])
    on_host = np.broadcast_to(host, between.shape).copy()
    for axis in range(3):
        on_host[axis, 4 * axis : 4 * axis + 4] += s[4 * axis : 4 * axis + 4]
    on_guest = guest + u * along
    distance = np.where(meets, _lengths(on_guest - on_host), np.inf)
    return Ends(distance.reshape(144, n), on_host.reshape(3, 144, n), on_guest.reshape(3, 144, n))


def _way_inside(shift: Floats, depth: Floats) -> Floats:
    """From the host's face that is nearest to a guest inside it, to the guest (3, n)."""
    axis, columns = nearest_axis(depth), np.arange(shift.shape[1])
    way = np.zeros_like(shift)
    way[axis, columns] = np.where(shift[axis, columns] < 0, 1.0, -1.0) * depth[axis, columns]
    return way


def nearest_axis(lengths: Floats) -> Indices:
    """The axis (n,) of the least of lengths (3, n), the first of those within a micrometre."""
    first: Indices = (lengths <= lengths.min(axis=0) + 1e-6).argmax(axis=0)
    return first


def _clamped(points: Floats, half: Floats) -> Floats:
    clamped: Floats = np.minimum(np.maximum(points, -half[:, None]), half[:, None])
    return clamped


def _lengths(ways: Floats) -> Floats:
    lengths: Floats = np.sqrt(dot(ways, ways))
    return lengths
