"""Distances of cuboids, for many pairs at once.

All data are in the frame of the first cuboid of a pair, the host. The pairs are the last axis of all arrays. Sums are
spelled out, since numpy adds in another order for a single pair. The bits of a pair's result must not depend on the
other pairs.

Sources: S. Gottschalk, M. C. Lin, D. Manocha, OBBTree, SIGGRAPH (1996) 171 (15 axes); C. Ericson, Real-Time Collision
Detection (2005), sections 4.4.1 and 5.1.9.

    turn  : (3, 3, n) [-], the guest's axes in its columns     a, b   : (3, n), half edges of host and guest [m]
    shift : (3, n) [m], the guest's middle                     s, u   : place on an edge of host, of guest [m]
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scene2hap.contact.geometry.vectors import Floats, Indices, Marks, dot

NEXT, LAST = np.array([1, 2, 0]), np.array([2, 0, 1])
SIGNS = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]).T
"""The corners (3, 8) of a cuboid in half edges."""
_BOTH = np.array([[-1.0], [1.0]])
# Twelve edges: their axis, and their middles (3, 12) in half edges.
AXES = np.repeat(np.arange(3), 4)
MIDDLES = np.zeros((3, 12))
for _edge in range(12):
    _axis = _edge // 4
    MIDDLES[NEXT[_axis], _edge], MIDDLES[LAST[_axis], _edge] = 1.0 - (_edge & 1) * 2.0, 1.0 - (_edge & 2)
# Squared sine below which two edges are parallel; the corners then give the same distance.
_PARALLEL = 1e-12
# Cosine below which the common normal of two edges may be a face normal as well, so that several edges may be nearest.
_ASKEW = 1e-6
# For each pair of axes, 3 i + j, the rows of `Pairs.table` in the order with the host's axis i and the guest's j first.
_ORDERS = [[k, (k + 1) % 3, (k + 2) % 3] for k in range(3)]
_EDGE_ROWS = np.array(
    [
        [
            *(3 * p + q for q in columns for p in rows),
            *(9 + p for p in rows),
            *(12 + p for p in rows),
            *(15 + q for q in columns),
        ]
        for rows in _ORDERS
        for columns in _ORDERS
    ]
).T
# The rows of `Pairs.table` with the axes rotated by one or two: of the host, of the guest, of shift and half edges.
_TURN = np.arange(9).reshape(3, 3)
_CROSS_ROWS = np.concatenate(
    [_TURN[NEXT].ravel(), _TURN[LAST].ravel(), _TURN[:, NEXT].ravel(), _TURN[:, LAST].ravel()]
    + [first + axes for first in (9, 12, 15) for axes in (NEXT, LAST)]
)
# The rows of `_EDGE_ROWS` with the half edges perpendicular to i and to j.
_ACROSS = np.array([13, 14, 16, 17])
FLUSH_M = 1e-9
"""A cuboid that is outside of another by no more than this rounding error counts as inside."""
# If a corner is as near as the separating faces, up to this, no other feature is nearer.
_SETTLED_M = 1e-12
# If edges separate a pair by this much more than faces, it probably meets at edges (a wrong guess costs time only).
_SURELY_M = 1e-3


class Pairs:
    """Pairs of cuboids, by the letters in the module's docstring, in one array (18, n), to save numpy calls."""

    __slots__ = ("a", "b", "shift", "table", "turn")

    def __init__(self, table: Floats) -> None:
        self.table = table
        self.turn, self.shift, self.a, self.b = table[:9].reshape(3, 3, -1), table[9:12], table[12:15], table[15:]

    @classmethod
    def of(cls, turn: Floats, shift: Floats, a: Floats, b: Floats) -> Pairs:
        """Build the table from its parts."""
        return cls(np.concatenate([turn.reshape(9, -1), shift, a, b]))

    def rows(self, rows: Indices) -> Pairs:
        """Return some of the pairs."""
        return self if len(rows) == self.table.shape[1] else Pairs(self.table.take(rows, axis=1))

    def swapped(self) -> Pairs:
        """Return the pairs with guest and host exchanged."""
        return Pairs.of(self.turn.transpose(1, 0, 2), -dot(self.turn, self.shift[:, None]), self.b, self.a)

    def to_host(self, points: Floats) -> Floats:
        """Transform points (3, k, n) from the guest's frame to the host's."""
        return self.shift[:, None] + times(self.turn, points)

    def guest_corners(self) -> Floats:
        """Return the guest's corners (3, 8, n) in the host's frame [m]."""
        return _corners(self.turn, self.shift, self.b)


class Ends(NamedTuple):
    """k local meetings of n pairs: distance (k, n) [m], inf for none, and the end points (3, k, n) [m]."""

    distance_m: Floats
    on_host: Floats
    on_guest: Floats

    def rows(self, rows: Indices) -> Ends:
        """Return the meetings of some pairs."""
        return Ends(*(part.take(rows, axis=-1) for part in self))

    def joined(self, more: Ends) -> Ends:
        """Return these and more meetings of the same pairs."""
        return Ends(
            np.concatenate([self.distance_m, more.distance_m]),
            np.concatenate([self.on_host, more.on_host], axis=1),
            np.concatenate([self.on_guest, more.on_guest], axis=1),
        )


class Gaps:
    """Distances of n pairs, in one array (15, n).

    distance_m : (n,) of the surfaces, 0 where they intersect; way_m : (3, n) vector from host to guest there; least_m :
    (n,) largest gap along a separating axis, negative by the penetration depth; edges : (n,) from `edge_clearance`;
    on_host, on_guest, inner : (3, n) from `clearance`; ends : meetings of the pairs for which they are known; kept :
    (n,) column of each pair there, -1 for none.
    """

    __slots__ = ("distance_m", "ends", "inner", "kept", "least_m", "on_guest", "on_host", "table", "way_m")

    def __init__(self, table: Floats, kept: Indices, ends: Ends | None = None) -> None:
        self.table, self.kept, self.ends = table, kept, ends
        self.distance_m, self.least_m, self.way_m = table[0], table[1], table[3:6]
        self.on_host, self.on_guest, self.inner = table[6:9], table[9:12], table[12:]

    @property
    def edges(self) -> Indices:
        """The pair of edges with the largest gap (n,), as `edge_clearance` returns it."""
        edges: Indices = self.table[2].astype(np.intp)
        return edges

    def rows(self, rows: Indices) -> Gaps:
        """Return the distances of some pairs."""
        if len(rows) == self.table.shape[1]:
            return self
        return Gaps(self.table.take(rows, axis=1), self.kept.take(rows), self.ends)


def picked(table: Floats, rows: Indices) -> Floats:
    """Take rows (k, n) of each column of a table (m, n); numpy's indexing by two arrays is slower."""
    n = table.shape[1]
    found: Floats = table.ravel().take(rows * n + np.arange(n))
    return found


def times(turn: Floats, points: Floats) -> Floats:
    """Rotate points (3, k, n)."""
    turned: Floats = (
        turn[:, 0, None] * points[None, 0] + turn[:, 1, None] * points[None, 1] + turn[:, 2, None] * points[None, 2]
    )
    return turned


def clearance(pairs: Pairs) -> Floats:
    """Return the gaps of pairs along their face normals (9, n) [m].

    Rows 0-2 : along the host's normals, negative where the two overlap; 3-5 : along the guest's; 6-8 : how deep the
    whole guest is inside the host along the host's normals, negative where part of it is outside.
    """
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
    """Return the largest gap (n,) [m] of pairs along the nine common normals of two edges, and its pair of edges (n,):
    3 i + j for the host's axis i and the guest's axis j."""
    table, n = pairs.table.take(_CROSS_ROWS, axis=0), pairs.table.shape[1]
    turns, reaches = table[:36].reshape(4, 3, 3, n), np.abs(table[:36]).reshape(4, 3, 3, n)
    on_next, on_last = turns[:2]
    (shift_next, shift_last), (a_next, a_last) = table[36:48].reshape(2, 2, 3, 1, n)
    b_next, b_last = table[48:].reshape(2, 3, n)
    apart = np.abs(shift_last * on_next - shift_next * on_last)
    apart -= a_next * reaches[1] + a_last * reaches[0]
    apart -= b_next * reaches[3] + b_last * reaches[2]
    sine2 = on_next * on_next + on_last * on_last
    skew = sine2 > _PARALLEL
    if skew.all():
        apart /= np.sqrt(sine2)
    else:
        apart = np.where(skew, apart / np.sqrt(np.where(skew, sine2, 1.0)), -np.inf)
    apart = apart.reshape(9, -1)
    edges = apart.argmax(axis=0)
    return apart[edges, np.arange(len(edges))], edges


def gaps(pairs: Pairs, within_m: float) -> tuple[Indices, Gaps]:
    """Return the rows of pairs whose surfaces are at most `within_m` apart, and their distances."""
    clear = clearance(pairs)
    flat, inner = clear[:6].max(axis=0), clear[6:].min(axis=0)
    rows = np.flatnonzero((flat <= within_m) & (inner <= within_m))
    pairs, flat, inner = pairs.rows(rows), flat[rows], inner[rows]
    found = Gaps(np.zeros((15, len(rows))), np.full(len(rows), -1))
    found.table[6:] = clear.take(rows, axis=1)
    of_edges, edges = edge_clearance(pairs)
    found.table[2] = edges
    distance, way, least = found.distance_m, found.way_m, found.least_m
    np.maximum(flat, of_edges, out=least)
    inside = np.flatnonzero(inner > -FLUSH_M)
    if len(inside):
        distance[inside] = np.maximum(inner[inside], 0.0)
        way[:, inside] = _way_inside(pairs.shift[:, inside], found.inner[:, inside])
    # Pairs that intersect with their edges first need the end points as well.
    needed = np.flatnonzero((least <= within_m) & ((least > 0) | (of_edges > flat + _SURELY_M)))
    if len(needed):
        apart = least[needed] > 0
        lengths, ways, kept, found.ends = _apart(pairs.rows(needed), flat[needed], edges[needed])
        distance[needed], way[:, needed] = (
            np.where(apart, lengths, distance[needed]),
            np.where(apart, ways, way[:, needed]),
        )
        found.kept[needed[kept]] = np.arange(len(kept))
    near = np.flatnonzero((distance <= within_m) & (least <= within_m))
    return rows[near], found.rows(near)


def ends_of(pairs: Pairs, edges: Indices) -> tuple[Ends, Marks]:
    """Return the meetings of all corners and of the two edges that may be nearest.

    Also marks the pairs (n,) for which only `all_ends` finds the nearest edges.
    """
    of_edges, unsure = _edge_ends(pairs, edges)
    return _corner_ends(pairs).joined(of_edges), unsure


def all_ends(pairs: Pairs) -> Ends:
    """Return the meetings of all corners and of all pairs of edges."""
    return _corner_ends(pairs).joined(_all_edge_ends(pairs))


def _apart(pairs: Pairs, flat_m: Floats, edges: Indices) -> tuple[Floats, Floats, Indices, Ends | None]:
    """Return distances (n,) and vectors (3, n) of pairs that are apart; and the rows for which corners did not decide,
    with their meetings."""
    corners = _corner_ends(pairs)
    distance, way = _nearest(corners)
    open_ = np.flatnonzero(distance > flat_m + _SETTLED_M)
    if not len(open_):
        return distance, way, open_, None
    ends, unsure = _edge_ends(pairs.rows(open_), edges[open_])
    _shorten(distance, way, open_, ends)
    if unsure.any():
        _shorten(distance, way, open_[unsure], _all_edge_ends(pairs.rows(open_[unsure])))
        open_, ends = open_[~unsure], ends.rows(np.flatnonzero(~unsure))
    return distance, way, open_, corners.rows(open_).joined(ends)


def _shorten(distance: Floats, way: Floats, rows: Indices, ends: Ends) -> None:
    less, ways = _nearest(ends)
    nearer = less < distance[rows]
    distance[rows[nearer]], way[:, rows[nearer]] = less[nearer], ways[:, nearer]


def _nearest(ends: Ends) -> tuple[Floats, Floats]:
    columns = np.arange(ends.distance_m.shape[1])
    place = ends.distance_m.argmin(axis=0) * len(columns) + columns
    on_guest, on_host = (part.reshape(3, -1).take(place, axis=1) for part in (ends.on_guest, ends.on_host))
    return ends.distance_m.ravel().take(place), on_guest - on_host


def _corners(turn: Floats, shift: Floats, half: Floats) -> Floats:
    """Return the corners (3, 8, n), in the order of `SIGNS`, of cuboids with these axes, middles and half edges."""
    x, y, z = (turn * half).transpose(1, 0, 2)[..., None, :] * _BOTH
    across = x[:, :, None] + y[:, None]
    corners = across[:, :, :, None] + z[:, None, None]
    placed: Floats = shift[:, None] + corners.reshape(3, 8, -1)
    return placed


def _corner_ends(pairs: Pairs) -> Ends:
    """Return the meetings of all 16 corners with the other cuboid; corners inside it have distance 0."""
    turn, shift, a, b = pairs.turn, pairs.shift, pairs.a, pairs.b
    on_host, on_guest = np.empty((2, 3, 16, shift.shape[1]))
    on_guest[:, :8] = _corners(turn, shift, b)
    on_host[:, :8] = _clamped(on_guest[:, :8], a)
    on_host[:, 8:] = SIGNS[..., None] * a[:, None]
    own = _corners(turn.transpose(1, 0, 2), -dot(turn, shift[:, None]), a)
    on_guest[:, 8:] = pairs.to_host(_clamped(own, b))
    return Ends(_lengths(on_guest - on_host), on_host, on_guest)


def _edge_ends(pairs: Pairs, edges: Indices) -> tuple[Ends, Marks]:
    """Return the meeting of the two edges along these axes that face each other, unless their ends are nearest.

    Also marks the pairs (n,) that have other facing edges. If the nearest points lie on edges, they lie on these: their
    common normal separates the two cuboids by the largest gap.
    """
    rows = _EDGE_ROWS.take(edges, axis=1)
    table = picked(pairs.table, rows)
    axes, shift, a, b = table[:9].reshape(3, 3, -1), table[9:12], table[12:15], table[15:]
    along, others = axes[0], axes[1:]
    sine2 = along[1] * along[1] + along[2] * along[2]
    side = np.where(shift[2] * along[1] < shift[1] * along[2], -1.0, 1.0) / np.sqrt(sine2)
    leans = np.empty((4, len(edges)))
    n1, n2 = np.multiply(-side, along[2], out=leans[0]), np.multiply(side, along[1], out=leans[1])
    leans[2:] = n1 * others[:, 1] + n2 * others[:, 2]
    halves = table.take(_ACROSS, axis=0)
    ends = np.where(leans < 0, -halves, halves)
    on_host = np.zeros_like(shift)
    on_host[1:] = ends[:2]
    on_guest = shift - ends[2] * others[0] - ends[3] * others[1]
    between = on_guest - on_host
    on_a, on_b, cosine = between[0], dot(between, along), along[0]
    s, u = (on_a - cosine * on_b) / sine2, (cosine * on_a - on_b) / sine2
    on_host[0] = s
    on_guest = on_guest + u * along
    meets = (np.abs(s) <= a[0]) & (np.abs(u) <= b[0])
    distance = np.where(meets, _lengths(on_guest - on_host), np.inf)
    least = np.abs(leans).min(axis=0)
    placed = np.empty((2, *on_host.shape))
    placed[:, rows[9:12] - 9, np.arange(len(edges))] = on_host, on_guest
    return Ends(distance[None], placed[0][:, None], placed[1][:, None]), least < _ASKEW


def _all_edge_ends(pairs: Pairs) -> Ends:
    """Return the meetings of all 144 pairs of edges, except where their ends are nearest."""
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
    """Return the vectors (3, n) from the host's nearest face to a guest inside it."""
    axis, columns = nearest_axis(depth), np.arange(shift.shape[1])
    way = np.zeros_like(shift)
    way[axis, columns] = np.where(shift[axis, columns] < 0, 1.0, -1.0) * depth[axis, columns]
    return way


def nearest_axis(lengths: Floats) -> Indices:
    """Return the axis (n,) of the least of lengths (3, n); the first of those within a micrometre of it."""
    first: Indices = (lengths <= lengths.min(axis=0) + 1e-6).argmax(axis=0)
    return first


def _clamped(points: Floats, half: Floats) -> Floats:
    clamped: Floats = np.minimum(np.maximum(points, -half[:, None]), half[:, None])
    return clamped


def _lengths(ways: Floats) -> Floats:
    lengths: Floats = np.sqrt(dot(ways, ways))
    return lengths
