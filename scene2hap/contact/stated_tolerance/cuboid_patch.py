"""Contact manifolds of cuboids: up to four points for each of many pairs.

Near or slightly penetrating cuboids touch in the overlap of their nearest faces, or, without an overlap, at the nearest
corners and edges. Deeper ones touch at the corners of the curve in which their surfaces intersect. The points are
chosen in the host's frame, so that they move along with any motion of both.

Sources: D. Gregorius, The separating axis test between convex polyhedra, Game Developers Conference (2013), for the
faces; for the clipping of an edge by planes, M. Cyrus, J. Beck, Computers & Graphics 3 (1978) 23.

    k     : the axis normal to the reference face; p, q, h : coordinates in that face, and height over it [m]
    turn, shift, a, b : see `cuboids`
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from scene2hap.contact.geometry.spread import spread_each
from scene2hap.contact.geometry.vectors import Floats, Indices, Marks, dot
from scene2hap.contact.stated_tolerance.cuboids import (
    AXES,
    FLUSH_M,
    MIDDLES,
    Ends,
    Gaps,
    Pairs,
    all_ends,
    ends_of,
    nearest_axis,
    picked,
)

# Gaps this close count as equal, so that rounding does not choose a face; and points this near a rim count as inside.
_TIE, _RIM_M, _RIM = 1e-6, 1e-9, 1e-9
# The corners of a rectangle in half edges, counter-clockwise.
_RING = np.array([[1.0, -1.0, -1.0, 1.0], [1.0, 1.0, -1.0, -1.0]])[..., None]
_ENDS = np.array([-1.0, 1.0])[:, None, None]
# Rows of `Pairs.table`, extended by the shift in the guest's frame, that express a pair relative to face k of the host
# (0-2) or of the guest (3-5), axis k last; and rows (u, v, w) of the other's axes (p, q, h), by which of them is w.
_ORDERS = [[1, 2, 0], [2, 0, 1], [0, 1, 2]]
_SEEN_ROWS = np.array(
    [[3 * p + q for p in ps for q in range(3)] + [m + p for m in (9, 12) for p in ps] + [15, 16, 17] for ps in _ORDERS]
    + [
        [3 * q + p for p in ps for q in range(3)] + [m + p for m in (18, 15) for p in ps] + [12, 13, 14]
        for ps in _ORDERS
    ]
).T
_WAY_ROWS = np.array([[3 * p + q for q in qs for p in range(3)] for qs in _ORDERS]).T


class Spots(NamedTuple):
    """Points of each pair (3, k, n) [m], in the host's frame unless stated otherwise; marks (k, n) of valid ones."""

    points_m: Floats
    counts: Marks

    def packed(self) -> Spots:
        """Return the valid points in as few rows as possible."""
        k, n = self.counts.shape
        if not k:
            return self
        # numpy counts and takes faster along one axis than along two.
        n_each = np.count_nonzero(self.counts, axis=0)
        counts = np.arange(n_each.max(initial=0))[:, None] < n_each
        rows = np.zeros((n, len(counts)), dtype=np.intp)
        rows[counts.T] = np.flatnonzero(self.counts.T) - np.repeat(np.arange(0, k * n, k), n_each)
        return Spots(self.taken(rows.T), counts)

    def taken(self, rows: Indices) -> Floats:
        """Return the points (3, m, n) in rows (m, n) of each pair."""
        n = rows.shape[1]
        points: Floats = self.points_m.reshape(3, -1).take(rows * n + np.arange(n), axis=1)
        return points


def patches(pairs: Pairs, gaps: Gaps, reach_m: Floats, sunk_m: float) -> Spots:
    """Return up to four contact points of each pair, half way between the surfaces.

    Parameters: reach_m : (n,) largest distance of the surfaces at a contact point, at least the distance of the pair
    [m]; sunk_m : pairs with less penetration than this touch by their faces, as if they did not intersect [m].
    """
    inside = gaps.inner.min(axis=0) > -FLUSH_M
    ways: tuple[tuple[Marks, Callable[[Pairs, Gaps, Floats], Spots]], ...] = (
        (inside, _inner_spots),
        (~inside & (gaps.least_m > -sunk_m), _face_spots),
        (~inside & (gaps.least_m <= -sunk_m), _cut_spots),
        (np.ones(len(inside), dtype=bool), _end_spots),
    )
    parts, open_ = [], np.ones(len(inside), dtype=bool)
    for applies, spots in ways:
        rows = np.flatnonzero(applies & open_)
        if len(rows):
            part = spots(pairs.rows(rows), gaps.rows(rows), reach_m[rows])
            if len(part.counts):
                parts.append((rows, part))
                open_[rows] = ~part.counts[0]
    every = _merged(parts, len(inside))
    chosen, counts = spread_each(*every)
    return Spots(every.taken(chosen), counts)


def _merged(parts: Sequence[tuple[Indices, Spots]], n: int) -> Spots:
    """Merge the points of several sets of pairs, given with their rows, into one array for n pairs.

    Each pair has valid points in one set at most.
    """
    most = max((len(part.counts) for _, part in parts), default=1)
    every = Spots(np.zeros((3, most, n)), np.zeros((most, n), dtype=bool))
    for rows, (points, counts) in parts:
        k = len(counts)
        if len(rows) == n:
            every.points_m[:, :k], every.counts[:k] = points, counts
            continue
        some = np.flatnonzero(counts[0])
        rows = rows[some]
        every.points_m[:, :k, rows], every.counts[:k, rows] = points[..., some], counts[:, some]
    return every


def _face_spots(pairs: Pairs, gaps: Gaps, reach_m: Floats) -> Spots:
    """Return the corners of the overlap of the nearest faces, projected along the normal of one."""
    from_guest = gaps.on_guest.max(axis=0) > gaps.on_host.max(axis=0) + _TIE
    k = nearest_axis(-np.where(from_guest, gaps.on_guest, gaps.on_host))
    # The table has all data relative to the guest, too, except for the shift.
    table = np.concatenate([pairs.table, -dot(pairs.turn, pairs.shift[:, None])])
    seen = picked(table, _SEEN_ROWS.take(k + 3 * from_guest, axis=1))
    turn, shift, a, b = seen[:9].reshape(3, 3, -1), seen[9:12], seen[12:15], seen[15:]
    side = np.where(shift[2] < 0, -1.0, 1.0)
    turn[2] *= side
    shift[2] = shift[2] * side - a[2]
    j = nearest_axis(-np.abs(turn[2]))
    u, v, w = picked((turn * b).reshape(9, -1), _WAY_ROWS.take(j, axis=1)).reshape(3, 3, -1)
    middle = shift - np.where(w[2] < 0, -1.0, 1.0) * w
    with np.errstate(divide="ignore", invalid="ignore"):
        shared = _shared(middle, u, v, a)
        near = shared.counts & (shared.points_m[2] <= reach_m)
    points, counts = Spots(shared.points_m, near).packed()
    points[2] = side * (points[2] / 2 + a[2])
    placed = np.where(k == 0, points[[2, 0, 1]], np.where(k == 1, points[[1, 2, 0]], points))
    return Spots(np.where(from_guest, pairs.to_host(placed), placed), counts)


def _shared(middle: Floats, u: Floats, v: Floats, half: Floats) -> Spots:
    """Clip a parallelogram, given by its middle and half sides (3, n), to a rectangle with half edges `half`.

    Returns the corners (p, q, h) of the result: up to eight valid ones of 24.
    """
    n = middle.shape[1]
    found = Spots(np.empty((3, 24, n)), np.empty((24, n), dtype=bool))
    points, counts = found
    points[:, :4] = middle[:, None] + _RING[0] * u[:, None] + _RING[1] * v[:, None]
    (np.abs(points[:2, :4]) <= half[:2, None] + _RIM_M).all(axis=0, out=counts[:4])
    tips = _RING * half[:2, None]
    points[:2, 4:8] = tips
    dp, dq = tips - middle[:2, None]
    area = u[0] * v[1] - u[1] * v[0]
    alpha, beta = (dp * v[1] - dq * v[0]) / area, (u[0] * dq - u[1] * dp) / area
    points[2, 4:8] = middle[2] + alpha * u[2] + beta * v[2]
    counts[4:8] = (np.abs(alpha) <= 1 + _RIM) & (np.abs(beta) <= 1 + _RIM)
    # The parallelogram's four sides, each with the two lines p = +-half and the two lines q = +-half.
    start, along = np.empty((2, 3, 4, n))
    start[:, 0], start[:, 1], start[:, 2], start[:, 3] = middle - v, middle + v, middle - u, middle + u
    along[:, :2], along[:, 2:] = u[:, None], v[:, None]
    # A side parallel to a line has no crossing: the share is inf or nan, and the comparisons below are False.
    share = (_ENDS * half[:2, None, None] - start[:2, None]) / along[:2, None]
    other = start[1::-1, None] + share * along[1::-1, None]
    meets = (np.abs(share) <= 1) & (np.abs(other) <= half[1::-1, None, None])
    counts[8:] = meets.reshape(16, n)
    crossings = points[:, 8:].reshape(3, 2, 2, 4, n)
    np.multiply(share, along[:, None, None], out=crossings)
    crossings += start[:, None, None]
    return found


def _cut_spots(pairs: Pairs, gaps: Gaps, reach_m: Floats) -> Spots:
    """Return the points where edges of either cuboid intersect faces of the other."""
    back = _crossings(pairs.swapped())
    return _joined([_crossings(pairs), Spots(pairs.to_host(back.points_m), back.counts)]).packed()


def _crossings(pairs: Pairs) -> Spots:
    """Return the points where the guest's edges intersect the host's faces."""
    start = pairs.to_host(MIDDLES[..., None] * pairs.b[:, None])
    along, length, half = pairs.turn[:, AXES], pairs.b[AXES], pairs.a[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (-half - start) / along, (half - start) / along
    # 0 / 0 where an edge lies in the plane of a face: the whole edge is between the two planes.
    one, other = np.where(np.isnan(one), -other, one), np.where(np.isnan(other), -one, other)
    enters, leaves = np.minimum(one, other).max(axis=0), np.maximum(one, other).min(axis=0)
    parts = []
    for place in (enters, leaves):
        meets = (enters <= leaves) & (np.abs(place) <= length)
        parts.append(Spots(start + np.where(meets, place, 0.0) * along, meets))
    return _joined(parts)


def _inner_spots(pairs: Pairs, gaps: Gaps, reach_m: Floats) -> Spots:
    """Return the corners of a guest inside its host that are nearest to a face."""
    columns, corners = np.arange(len(gaps.distance_m)), pairs.guest_corners()
    k = nearest_axis(gaps.inner)
    side = np.where(pairs.shift[k, columns] < 0, -1.0, 1.0)
    height = corners[k, :, columns].T
    face = side * pairs.a[k, columns]
    corners[k[None], np.arange(8)[:, None], columns] = (height + face) / 2
    return Spots(corners, side * (face - height) <= reach_m).packed()


def _end_spots(pairs: Pairs, gaps: Gaps, reach_m: Floats) -> Spots:
    """Return the meetings of the nearest corners and edges."""
    known = gaps.ends if (gaps.kept >= 0).all() else None
    ends = known.rows(gaps.kept) if known is not None else _ends(pairs, gaps.edges)
    near = ends.distance_m <= np.maximum(reach_m, ends.distance_m.min(axis=0))
    return Spots((ends.on_host + ends.on_guest) / 2, near).packed()


def _ends(pairs: Pairs, edges: Indices) -> Ends:
    ends, unsure = ends_of(pairs, edges)
    if unsure.any():
        # Unsure pairs get all edges; the others get invalid rows.
        every = all_ends(pairs)
        every.distance_m[16:, ~unsure] = np.inf
        ends = ends.joined(Ends(*(part[..., 16:, :] for part in every)))
        ends.distance_m[16, unsure] = np.inf
    return ends


def _joined(parts: Sequence[Spots]) -> Spots:
    points, counts = zip(*parts, strict=True)
    return Spots(np.concatenate(points, axis=1), np.concatenate(counts))
