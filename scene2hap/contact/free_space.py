"""Free space of concave hosts: a box around a guest in which the host has nothing, or one ledge to stand on.

A room is one mesh of walls and floor; a shelf has boards below its top. The AABB of such a host contains its guests, so
only triangles show where its surface is. They are searched once around a guest. The box found is kept in the host's
frame until the guest leaves it, also when the host moves. It is valid for any pose inside it, so that the result
depends on poses alone.

    u, v : the host's own axes that are level; h : the height over its position [m]
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from scene2hap.common.arrays import Bools, Indices
from scene2hap.contact.body import Body, TopFace, box_in_frame
from scene2hap.contact.geometry.level_plane import Plane, floor_at, roof_at, wall_at
from scene2hap.contact.geometry.triangle_tree import ALL, meeting
from scene2hap.contact.geometry.vectors import AABB
from scene2hap.contact.ledge import Flat, FreeRegion, VerticalAxis
from scene2hap.contact.mesh_distance import INSET, INSET_M
from scene2hap.contact.rule import TOUCH_M, fall_reach_m, hang_reach_m, play_reach_m, upper_of

_AROUND_M = 0.8  # The host is searched this far beyond a guest, so that later guests can use the region.
MANY_CORNERS = 8
"""An outline with more corners is replaced by its circle."""
_ROUNDING_M = 2e-6
_NO_LEDGE: Flat = (math.inf, math.inf, -math.inf, -math.inf)


class FreeSpace:
    """The free space of a host around a guest, at their present poses. Each result is computed on first use."""

    def __init__(self, guest: Body, host: Body) -> None:
        self.guest: Body = guest
        self.host: Body = host
        self._own = host.stance.upright

    @cached_property
    def region_below(self) -> FreeRegion | None:
        """The free region around the guest and the path of its fall, or of the host's fall onto it.

        The region is empty, or has a ledge under the guest's whole base face. None where neither is certain.
        """
        guest, host, own = self.guest, self.host, self._own
        if own is None:
            return None
        taken = self._column
        low, high = taken[0][2], taken[1][2]

        def serves(known: FreeRegion) -> bool:
            if known.own != own or not known.holds(taken):
                return False
            return known.top_m is None or (low <= known.top_m <= high and known.bears(self._foot))

        return host.free_regions.find(guest.id, serves, lambda: _computed_region(host, own, taken, self._foot))

    @cached_property
    def empty_region(self) -> FreeRegion | None:
        """A region in which the host has nothing within the distance at which the two could touch or hang, if any."""
        guest, host, own, reach_m = self.guest, self.host, self._own, _reach_m(self.guest)
        if own is None:
            return None
        (u0, v0, h0), (u1, v1, h1) = self._column
        taken = (u0 - reach_m, v0 - reach_m, h0 - reach_m), (u1 + reach_m, v1 + reach_m, h1 + reach_m)

        def serves(known: FreeRegion) -> bool:
            return known.own == own and known.top_m is None and known.holds(taken)

        return host.free_regions.find(guest.id, serves, lambda: _empty_region(host, own, taken))

    @property
    def ledge_face(self) -> TopFace:
        """The rectangle of the ledge of `region_below` as a top face of the host, turned as the host is."""
        known, own = self.region_below, self._own
        assert known is not None
        assert known.top_m is not None
        assert own is not None
        a, b, c, d = _turn(self.host, own)
        u0, v0, u1, v1 = known.ledge
        corners = tuple([(a * u + c * v, b * u + d * v) for u, v in ((u0, v0), (u1, v0), (u1, v1), (u0, v1))])
        return TopFace(corners, known.top_m, ((a, b, u0), (c, d, v0), (-a, -b, -u1), (-c, -d, -v1)))

    @cached_property
    def _column(self) -> AABB:
        """A box (u, v, h) around the guest and the path of its fall, or of the host's onto it, in the host's frame."""
        guest, host, own, up = self.guest, self.host, self._own, self.guest.up_axis
        assert own is not None
        h, (middle, half) = host.position_m[up], box_in_frame(guest, host)
        mu, mv, hu, hv = middle[own.u], middle[own.v], half[own.u], half[own.v]
        inset_m = min(INSET * guest.size_m, INSET_M)
        hu, hv = max(hu - inset_m, 0.0), max(hv - inset_m, 0.0)
        low = guest.low[up] - h - fall_reach_m(guest.size_m) - TOUCH_M
        # The upper surface of a host into which the guest is sunk a little may be above the guest.
        high = guest.high[up] - h + TOUCH_M + (fall_reach_m(host.size_m) if upper_of(host, guest) is host else 0.0)
        return (mu - hu, mv - hv, low), (mu + hu, mv + hv, high)

    @cached_property
    def _foot(self) -> Flat:
        """A rectangle (u, v) around the guest's base face, a little smaller, so that a foot flush with a rim fits."""
        guest, host, own, v_axis = self.guest, self.host, self._own, self.guest.v_axis
        assert own is not None
        x, y = guest.position_m[0] - host.position_m[0], guest.position_m[v_axis] - host.position_m[v_axis]
        a, b, c, d = _turn(host, own)
        if len(outline := guest.stance.base_outline) > MANY_CORNERS:
            _, _, (p, q), r, _ = guest.stance.posed_base_face
            u, v, hu = a * (x + p) + b * (y + q), c * (x + p) + d * (y + q), max(r - _ROUNDING_M, 0.0)
            return (u - hu, v - hu, u + hu, v + hu)
        us = [a * (x + p) + b * (y + q) for p, q in outline]
        vs = [c * (x + p) + d * (y + q) for p, q in outline]
        u0, u1, v0, v1 = min(us), max(us), min(vs), max(vs)
        hu, hv = min(_ROUNDING_M, (u1 - u0) / 2), min(_ROUNDING_M, (v1 - v0) / 2)
        return (u0 + hu, v0 + hv, u1 - hu, v1 - hv)

    def planes(self, *, stands: bool) -> tuple[Plane, ...] | None:
        """Return the planes of the guest's free region in world coordinates; None where no region is certain.

        Parameters: stands : True if the guest stands on the host's ledge, False if the region must be empty.
        """
        guest, host, own, lean, up = self.guest, self.host, self._own, self.host.stance.lean, self.host.up_axis
        if own is None or lean is None or upper_of(host, guest) is host:
            return None
        known = self.region_below if stands else self.empty_region
        if not known or stands != (known.top_m is not None):
            return None
        a, b, c, d = _turn(host, own)
        spare_m = _ROUNDING_M + lean.tilt * host.size_m
        reach_m = spare_m if stands else spare_m + _reach_m(guest)
        (u0, v0, h0), (u1, v1, h1) = known.box
        x, y, h = host.position_m[0], host.position_m[host.v_axis], host.position_m[up]
        u, v = a * x + b * y, c * x + d * y
        # Below this height the host might be the body that falls.
        low_m = max(h + h0 + fall_reach_m(guest.size_m) + TOUCH_M + reach_m, host.low[up] - TOUCH_M + spare_m)
        return (
            wall_at(a, b, u + u1 - reach_m, is_square=True),
            wall_at(-a, -b, -(u + u0 + reach_m), is_square=True),
            wall_at(c, d, v + v1 - reach_m, is_square=True),
            wall_at(-c, -d, -(v + v0 + reach_m), is_square=True),
            floor_at(low_m),
            roof_at(h + h1 - TOUCH_M - reach_m),
        )


def _turn(host: Body, own: VerticalAxis) -> tuple[float, float, float, float]:
    """Return the components of u (a, b) and of v (c, d) along the world's two level axes."""
    first, second = host.stance.rows[0], host.stance.rows[3 - host.up_axis]
    return first[own.u], second[own.u], first[own.v], second[own.v]


def _reach_m(guest: Body) -> float:
    """Return the distance [m] within which a host must have nothing for the guest to be clear of it."""
    return max(TOUCH_M, play_reach_m(guest.size_m), hang_reach_m(guest.size_m))


def _empty_region(host: Body, own: VerticalAxis, taken: AABB) -> FreeRegion | None:
    """Return a region around `taken` in which the host has nothing, None if `taken` is not empty."""
    if len(_triangles_in(host, own, taken, most=1)):
        return None
    return FreeRegion(own, _Surroundings(host, own, taken).cut(taken), None, _NO_LEDGE)


def _computed_region(host: Body, own: VerticalAxis, taken: AABB, foot: Flat) -> FreeRegion | None:
    """Search the host's triangles. Returns None unless `taken` is empty or has one ledge under `foot`."""
    columns = _triangles_in(host, own, taken)
    if not len(columns):
        return _empty_region(host, own, taken)
    ledges = host.shape.ledges(own)
    tops = ledges.tops.take(columns)
    # The host's vertical sides reach as high as the ledge that they bound, so only level triangles name the ledge.
    number = max(ledges.number.take(columns[tops >= np.maximum.reduce(tops) - _ROUNDING_M]).tolist())
    if number < 0 or not ledges.covers(number, foot):
        return None
    top_m = ledges.heights[number]
    if ((ledges.number.take(columns) != number) & (tops > top_m + _ROUNDING_M)).any():
        return None
    near = _Surroundings(host, own, taken)
    higher = (ledges.number[near.columns] != number) & (near.high[2] > top_m + _ROUNDING_M)
    box = (u0, v0, _), (u1, v1, _) = near.cut(taken, higher)
    most = (min(u0, foot[0]), min(v0, foot[1]), max(u1, foot[2]), max(v1, foot[3]))
    return FreeRegion(own, box, top_m, ledges.stretch(number, foot, most))


def _triangles_in(host: Body, own: VerticalAxis, box: AABB, most: int = ALL) -> Indices:
    """Return the columns of up to `most` of the host's triangles whose boxes overlap a box (u, v, h)."""
    (u0, v0, h0), (u1, v1, h1) = box
    if own.sign < 0:
        h0, h1 = -h1, -h0
    if own.axis == 0:
        low, high = (h0, u0, v0), (h1, u1, v1)
    elif own.axis == 1:
        low, high = (u0, h0, v0), (u1, h1, v1)
    else:
        low, high = (u0, v0, h0), (u1, v1, h1)
    return meeting(host.shape.tree, low, high, most)


class _Surroundings:
    """The host's triangles around a guest: their `columns`, and the corners (3, n) of their boxes as (u, v, h)."""

    def __init__(self, host: Body, own: VerticalAxis, taken: AABB) -> None:
        (u0, v0, h0), (u1, v1, h1) = taken
        d = _AROUND_M
        around = (u0 - d, v0 - d, h0 - d), (u1 + d, v1 + d, h1 + d)
        self._low, self._high = np.array(around)
        self.columns = _triangles_in(host, own, around)
        near, order = host.shape.boxes.some(self.columns), [own.u, own.v, own.axis]
        self.low, self.high = near.low[order], near.high[order]
        if own.sign < 0:
            self.low[2], self.high[2] = -self.high[2], -self.low[2]

    def cut(self, taken: AABB, others: Bools | slice = slice(None)) -> AABB:
        """Return the box `taken`, enlarged within the surroundings until it meets one of the `others`.

        All of the others must be outside of `taken`.
        """
        low, high = np.array(taken)[..., None]
        sides = np.concatenate([self.low[:, others] - high, low - self.high[:, others]])
        widest = sides.argmax(axis=0)
        gaps = sides[widest, np.arange(len(widest))]
        # The factor covers rounding.
        least = np.array([0.999 * gaps[widest == side].min(initial=np.inf) for side in range(6)])
        lowest, highest = np.maximum(self._low, low[:, 0] - least[3:]), np.minimum(self._high, high[:, 0] + least[:3])
        (a, b, c), (d, e, f) = lowest.tolist(), highest.tolist()
        return (a, b, c), (d, e, f)
