"""How far a thing falls until triangles of another stop it.

Only its bottom falls, all within `fall_reach_m` of the lowest point, and only onto what is level enough to hold it.
What is sunk in by up to `TOUCH_M` falls by less than nothing, and what is sunk in deeper by nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from scene2hap.contact.body import Body
from scene2hap.contact.narrow import ROUNDING_M, Meeting, Near, Nearest
from scene2hap.contact.support import TOUCH_M, fall_reach_m, is_over
from scene2hap.contact.triangles import height_range
from scene2hap.contact.vectors import Floats, Indices, Marks, Triple

_HOLDING = 0.5  # Least cosine of a slope that holds a thing (assumed): a wall's triangles hold nothing.
# What falls is tried this share smaller, by at most so much: equal boxes on each other, whose rims coincide, then
# surely lie over each other, and boxes exactly side by side surely do not.
INSET, INSET_M = 1e-4, 1e-4


def first_fall_m(meeting: Meeting, faller: Body, other: Body) -> float:
    """How far `faller`, one of the two that meet, may fall before any triangle of it meets `other` [m], at most
    `fall_reach_m`; inf if none does."""
    first_m = math.inf
    for drop in _drops(meeting, faller, other):
        while (pairs := drop.nearest.next(min(drop.reach_m, first_m) + ROUNDING_M)) is not None:
            falls_m, _ = drop.met(pairs)
            first_m = min(first_m, float(falls_m.min(initial=math.inf)))
    return first_m


def falls(meeting: Meeting, faller: Body, other: Body) -> Floats | None:
    """The same for each triangle (m,) of `faller`, None where none does.

    A triangle that falls `TOUCH_M` farther than another, which has come to rest by then, may be told as inf.
    """
    each_m = np.full(faller.n_triangles, np.inf)
    for drop in _drops(meeting, faller, other):
        while (pairs := drop.nearest.next(min(drop.reach_m, each_m.min() + TOUCH_M) + ROUNDING_M)) is not None:
            falls_m, columns = drop.met(pairs)
            np.minimum.at(each_m, columns, falls_m)
    return each_m if np.isfinite(each_m).any() else None


class _Drop(NamedTuple):
    """Pairs of triangles of which one may fall onto the other, those first that may meet first.

    up : the world's, in the host's frame; columns : (n,) which of the faller's triangles.
    """

    near: Near
    nearest: Nearest
    columns: Indices
    is_guest: bool
    up: Triple
    reach_m: float

    def met(self, pairs: Indices) -> tuple[Floats, Indices]:
        """How far those of the pairs fall that meet (k,), and which triangles of the faller these are."""
        guest, host = self.near.corners(pairs)
        p, q = (guest, host) if self.is_guest else (host, guest)
        meets, falls_m = met(p, q, self.up, self.reach_m)
        return falls_m, self.columns[pairs[meets]]


def _drops(meeting: Meeting, faller: Body, other: Body) -> Iterator[_Drop]:
    if not is_over(faller, other):
        return
    reach_m, is_guest = fall_reach_m(faller.size_m), meeting.guest is faller
    falling, bearing = falls_first(faller), holds(other)
    up = (other if is_guest else faller).up
    way = (-reach_m if is_guest else reach_m) * up
    guest_only, host_only = (falling, bearing) if is_guest else (bearing, falling)
    x, y, z = up.tolist()
    for near in meeting.near(TOUCH_M, way, sweep=True, guest_only=guest_only, host_only=host_only):
        of_p, of_q = near.guest_columns, near.host_columns
        if not is_guest:
            of_p, of_q = of_q, of_p
        least_m = faller.lows_m.take(of_p) - other.highs_m.take(of_q)
        yield _Drop(near, Nearest(least_m), of_p, is_guest, (x, y, z), reach_m)


def falls_first(faller: Body) -> Marks:
    """Which triangles (m,) of a thing are its bottom."""
    return faller.lows_m <= faller.lowest_m + fall_reach_m(faller.size_m)


def holds(other: Body) -> Marks:
    """Which triangles (m,) of a thing are level enough to hold another."""
    return other.slopes >= _HOLDING


def met(p: Floats, q: Floats, up: Triple, reach_m: float | Floats) -> tuple[Indices, Floats]:
    """Which of the pairs of triangles p, that fall, and q (3, 3, n) [m] meet, and how far these fall (k,) [m].

    Parameters: reach_m : how far at most, and how deep p may be sunk in, of all or of each pair (n,).
    """
    low, high = height_range(_inset(p), q, up)
    meets = np.flatnonzero((low >= -reach_m) & (low <= reach_m) & (high >= -TOUCH_M))
    falls_m = low[meets]
    return meets, np.where(falls_m >= -TOUCH_M, falls_m, 0.0)


def _inset(triangles: Floats) -> Floats:
    middles: Floats = (triangles[:, 0] + triangles[:, 1] + triangles[:, 2]) / 3
    inwards = middles[:, None] - triangles
    extent = np.abs(inwards).reshape(9, -1).max(axis=0)
    inwards *= np.minimum(INSET, INSET_M / np.maximum(extent, INSET_M))
    inwards += triangles
    return inwards
