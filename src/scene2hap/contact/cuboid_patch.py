"""Where cuboids touch: up to four points for each of many pairs.

What one's face shares with the other's where they are near or sunk in a little, and where faces share nothing the
nearest corners and edges; of what is sunk in deeper, the corners of the curve along which the surfaces cut each other.
The points are chosen in the frame of one of the two, so that they go along with any motion of both.

Sources: D. Gregorius, The separating axis test between convex polyhedra, Game Developers Conference (2013), for the
faces; for the clipping of an edge by planes, M. Cyrus, J. Beck, Computers & Graphics 3 (1978) 23.

    k     : the axis of the face that is looked from; p, q, h : across it, and over it [m]
    turn, shift, a, b : see `cuboids`
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from scene2hap.contact.cuboids import (
    AXES,
    FLUSH_M,
    LAST,
    MIDDLES,
    NEXT,
    Ends,
    Floats,
    Gaps,
    Marks,
    Pairs,
    all_ends,
    ends_of,
    nearest_axis,
)
from scene2hap.contact.spread import spread_each

# Faces this much less far apart than others are as good, so that rounding does not choose; and rims this near count.
_TIE, _RIM_M, _RIM = 1e-6, 1e-9, 1e-9
# The corners of a rectangle and its sides' middles, in half edges, against the clock.
_RING = np.array([[1.0, -1.0, -1.0, 1.0], [1.0, 1.0, -1.0, -1.0]])[..., None]
_ENDS = np.array([-1.0, 1.0])[:, None, None]
_ROWS = np.arange(3)[:, None]


class Spots(NamedTuple):
    """Points of each pair (3, k, n) [m], in the host's frame if not said otherwise, and which of them count (k, n)."""

    points_m: Floats
    counts: Marks

    def packed(self) -> Spots:
        """The same in as few rows as they need."""
        if not len(self.counts):
            return self
        slot, column = np.nonzero(self.counts)
        place = self.counts.cumsum(axis=0)
        n_each = place[-1]
        counts = np.arange(n_each.max(initial=0))[:, None] < n_each
        points = np.zeros((3, *counts.shape))
        points[:, place[slot, column] - 1, column] = self.points_m[:, slot, column]
        return Spots(points, counts)


def patches(pairs: Pairs, gaps: Gaps, reach_m: Floats, sunk_m: float) -> Spots:
    """Up to four points of each pair, half way between the surfaces.

    They are where the surfaces are at most `reach_m` (n,) apart, which is no less than their distance. Pairs sunk in by
    less than `sunk_m` touch as if their faces were not.
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
            part = spots(pairs.rows(rows), gaps.rows(rows), reach_m[rows]).packed()
            if len(part.counts):
                parts.append((rows, part))
                open_[rows] = ~part.counts[0]
    most = max([len(part.counts) for _, part in parts], default=1)
    every = Spots(np.zeros((3, most, len(inside))), np.zeros((most, len(inside)), dtype=bool))
    for rows, part in parts:
        every.points_m[:, : len(part.counts), rows], every.counts[: len(part.counts), rows] = part
    chosen, counts = spread_each(*every)
    return Spots(every.points_m[:, chosen, np.arange(len(inside))], counts)


def _face_spots(pairs: Pairs, gaps: Gaps, reach_m: Floats) -> Spots:
    """The corners of what the nearest faces share, seen from one along its normal."""
    columns = np.arange(len(gaps.distance_m))
    from_guest = gaps.on_guest.max(axis=0) > gaps.on_host.max(axis=0) + _TIE
    seen = Pairs(np.where(from_guest, pairs.swapped().table, pairs.table))
    turn, shift, a, b = seen.turn, seen.shift, seen.a, seen.b
    k = nearest_axis(-np.where(from_guest, gaps.on_guest, gaps.on_host))
    order = np.stack([NEXT[k], LAST[k], k])
    side = np.where(shift[k, columns] < 0, -1.0, 1.0)
    turn, shift, a = turn[order[:, None], _ROWS, columns], shift[order, columns], a[order, columns]
    turn[2] *= side
    shift[2] = shift[2] * side - a[2]
    j = nearest_axis(-np.abs(turn[2]))
    u, v, w = (turn[:, row, columns] * b[row, columns] for row in (NEXT[j], LAST[j], j))
    middle = shift - np.where(w[2] < 0, -1.0, 1.0) * w
    shared = _shared(middle, u, v, a)
    points, counts = Spots(shared.points_m, shared.counts & (shared.points_m[2] <= reach_m)).packed()
    points[2] = side * (points[2] / 2 + a[2])
    placed = np.empty_like(points)
    placed[order[:, None], np.arange(len(counts))[:, None], columns] = points
    return Spots(np.where(from_guest, pairs.to_host(placed), placed), counts)


def _shared(middle: Floats, u: Floats, v: Floats, half: Floats) -> Spots:
    """The corners, as (p, q, h), of a parallelogram, given by its middle and half sides (3, n), cut to a rectangle of
    half edges `half` about the origin: up to eight of 24."""
    corners = middle[:, None] + _RING[0] * u[:, None] + _RING[1] * v[:, None]
    wide = half[:2, None] + _RIM_M
    parts = [(corners, (np.abs(corners[:2]) <= wide).all(axis=0))]
    tips = np.stack([_RING[0] * half[0], _RING[1] * half[1]])
    dp, dq = tips - middle[:2, None]
    area = u[0] * v[1] - u[1] * v[0]
    alpha, beta = (dp * v[1] - dq * v[0]) / area, (u[0] * dq - u[1] * dp) / area
    height = middle[2] + alpha * u[2] + beta * v[2]
    parts.append((np.stack([*tips, height]), (np.abs(alpha) <= 1 + _RIM) & (np.abs(beta) <= 1 + _RIM)))
    # The parallelogram's four sides, each with the two lines p = +-half and the two lines q = +-half.
    start = np.stack([middle - v, middle + v, middle - u, middle + u], axis=1)
    along = np.stack([u, u, v, v], axis=1)
    share = (_ENDS * half[:2, None, None] - start[:2, None]) / np.where(along[:2] == 0, np.nan, along[:2])[:, None]
    other = start[1::-1, None] + share * along[1::-1, None]
    meets = (np.abs(share) <= 1) & (np.abs(other) <= half[1::-1, None, None])
    crossings = start[:, None, None] + np.where(meets, share, 0.0) * along[:, None, None]
    n = middle.shape[1]
    parts.append((crossings.reshape(3, 16, n), meets.reshape(16, n)))
    return _joined([Spots(*part) for part in parts])


def _cut_spots(pairs: Pairs, gaps: Gaps, reach_m: Floats) -> Spots:
    """Where edges of either run through faces of the other."""
    back = _crossings(pairs.swapped())
    return _joined([_crossings(pairs), Spots(pairs.to_host(back.points_m), back.counts)])


def _crossings(pairs: Pairs) -> Spots:
    """Where the guest's edges run through the host's faces."""
    start = pairs.to_host(MIDDLES[..., None] * pairs.b[:, None])
    along, length, half = pairs.turn[:, AXES], pairs.b[AXES], pairs.a[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (-half - start) / along, (half - start) / along
    # 0 / 0 where an edge lies in the plane of a face: it is between the planes all along.
    one, other = np.where(np.isnan(one), -other, one), np.where(np.isnan(other), -one, other)
    enters, leaves = np.minimum(one, other).max(axis=0), np.maximum(one, other).min(axis=0)
    parts = []
    for place in (enters, leaves):
        meets = (enters <= leaves) & (np.abs(place) <= length)
        parts.append(Spots(start + np.where(meets, place, 0.0) * along, meets))
    return _joined(parts)


def _inner_spots(pairs: Pairs, gaps: Gaps, reach_m: Floats) -> Spots:
    """The corners of a guest inside its host that are nearest to a face."""
    columns, corners = np.arange(len(gaps.distance_m)), pairs.guest_corners()
    k = nearest_axis(gaps.inner)
    side = np.where(pairs.shift[k, columns] < 0, -1.0, 1.0)
    height = corners[k, :, columns].T
    face = side * pairs.a[k, columns]
    corners[k[None], np.arange(8)[:, None], columns] = (height + face) / 2
    return Spots(corners, side * (face - height) <= reach_m)


def _end_spots(pairs: Pairs, gaps: Gaps, reach_m: Floats) -> Spots:
    """The nearest corners and edges."""
    ends, unsure = ends_of(pairs, gaps.edges)
    if unsure.any():
        # For some, all edges; for the others more that do not count.
        every = all_ends(pairs)
        every.distance_m[16:, ~unsure] = np.inf
        ends = ends.joined(Ends(*(part[..., 16:, :] for part in every)))
        ends.distance_m[16, unsure] = np.inf
    near = ends.distance_m <= np.maximum(reach_m, ends.distance_m.min(axis=0))
    return Spots((ends.on_host + ends.on_guest) / 2, near)


def _joined(parts: Sequence[Spots]) -> Spots:
    points, counts = zip(*parts, strict=True)
    return Spots(np.concatenate(points, axis=1), np.concatenate(counts))
