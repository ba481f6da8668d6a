"""Certificates: bounds within which a moving body keeps its contacts, so that the narrow phase can be skipped.

The bounds are a box and some separating planes. Within them, the body either rests on one support with its whole base
face and touches nothing else, or it touches nothing. The proof uses poses alone. Two certified bodies share the free
space between them in equal parts. `Track` has the arithmetic of a step.

Source: J. Basch, L. J. Guibas, J. Hershberger, Data structures for mobile data, J. Algorithms 31 (1999) 1.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

from scene2hap.compiled import compiled
from scene2hap.contact.body import Body, Stance, roles
from scene2hap.contact.free_space import MANY_CORNERS, FreeSpace
from scene2hap.contact.geometry.level_plane import (
    Plane,
    floor_at,
    inside_edges,
    reach_along,
    roof_at,
    separation,
    wall_at,
)
from scene2hap.contact.geometry.vectors import AABB, Triple
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.ledge import Flat
from scene2hap.contact.pair import NEEDS_TRIANGLES, Rest, points_at, rest_of, support_normal
from scene2hap.contact.rule import TOUCH_M, fall_reach_m, upper_of
from scene2hap.scene.pose import Pose

Rotation = tuple[float, float, float, float]

_INSIDE_M = 1e-9
"""How far inside all edges a base face must be, so that `rest_on` surely finds it inside as well."""

_SURE_M = -TOUCH_M + 0.001
"""A body with a larger fall distance surely does not stand inside its support: base and top face may each be 0.2 mm
uneven."""
_SPARE = 1.001  # covers rounding
_ONES = (1.0,) * 4


class Resting(NamedTuple):
    """A body that rests on a support: how, the pair's free space, and whether the support surely carries the whole base
    face with weight 1."""

    support: Body
    rest: Rest
    space: FreeSpace
    is_certain: bool


class Extent(NamedTuple):
    """The region in which a body may be: `box` is that of its certificate, or its AABB if it has no certificate.

    `top_m` is the height of its support's face, -inf without one. A fixed body needs no free space around it.
    """

    body: Body
    box: AABB
    top_m: float
    is_fixed: bool

    @classmethod
    def of(cls, body: Body, *, is_fixed: bool) -> Extent:
        """The extent of a body without a certificate."""
        return cls(body, (body.low, body.high), -math.inf, is_fixed)


class SupportFace(NamedTuple):
    """The face that carries a body's whole base face, and the bounds of its rest. All in the world [m].

    edges : (n_u, n_v, offset) of the face; top_m : its height; least_m, most_m : bounds of the fall distance;
    middle_m : lower bound of the sum of the body's lowest and highest height.
    """

    edges: Sequence[Triple]
    top_m: float
    least_m: float
    most_m: float
    middle_m: float


Wall = tuple[float, float, float, bool]
"""(n_u, n_v, most_m, is_square): a vertical `planes.Plane`, without its zero component."""

Moved = tuple[Triple, Triple, tuple[Triple, ...]]
"""The AABB of a moved body, low and high [m], and its contact points with the support."""


@compiled
class Track:
    """A certified body, at its last rotation, on a support or in the air. `keep_in` must set its bounds first."""

    def __init__(self, stance: Stance, standing: SupportFace | None) -> None:
        self.stance: Stance = stance
        self._standing = standing
        self._bounds: tuple[Flat, tuple[float, float], Sequence[Wall]]

    def keep_in(self, rectangle: Flat, heights: tuple[float, float], walls: Sequence[Wall]) -> None:
        """Set the bounds: a level rectangle and two heights for the AABB, and vertical planes for the footprint."""
        self._bounds = (rectangle, heights, walls)

    def moved(self, position_m: Triple, rotation_xyzw: Rotation) -> Moved | None:
        """Return AABB and contact points at a pose, None unless it is surely within the bounds."""
        stance, standing = self.stance, self._standing
        if rotation_xyzw != stance.rotation_xyzw:
            turned = stance.turned(rotation_xyzw)
            if standing is not None and turned.way_up != stance.way_up:
                return None
            stance = self.stance = turned
        (u0, v0, u1, v1), (lowest, highest), walls = self._bounds
        up, flat = stance.up_axis, stance.v_axis
        x, y, z = position_m
        (a, b, c), (d, e, f) = stance.low, stance.high
        low, high = (x + a, y + b, z + c), (x + d, y + e, z + f)
        if low[0] < u0 or high[0] > u1 or low[flat] < v0 or high[flat] > v1 or low[up] < lowest or high[up] > highest:
            return None
        h, u, v = position_m[up], x, position_m[flat]
        if walls:
            footprint = stance.footprint
            square = footprint._replace(radius=math.inf)
            mu, mv = u + (stance.low[0] + stance.high[0]) / 2, v + (stance.low[flat] + stance.high[flat]) / 2
            for nu, nv, most_m, is_square in walls:
                if nu * mu + nv * mv + reach_along(square if is_square else footprint, nu, nv) > most_m:
                    return None
        if standing is None:
            return low, high, ()
        edges, top_m, least_m, most_m, middle_m = standing
        points, base_face, (cu, cv), radius, _ = stance.posed_base_face
        fall_m = h + base_face - top_m
        if low[up] + high[up] <= middle_m or not least_m < fall_m < most_m:
            return None
        cu, cv = cu + u, cv + v
        is_circle_inside = all(nu * cu + nv * cv - offset >= radius for nu, nv, offset in edges)
        outline = stance.base_outline
        if not is_circle_inside and (len(outline) > MANY_CORNERS or inside_edges(outline, u, v, edges)[0] < _INSIDE_M):
            return None
        return low, high, points_at(points, u, v, (h + base_face + top_m) / 2, up)


class Certificate:
    """The contacts of one body within bounds. `step` moves `body` in place.

    Parameters: planes : separating planes, by the id of the body on their other side; pins : ids of the bodies whose
    movement ends the certificate; resting : how the body rests on its support, None without one.
    `n_steps` counts the steps within the bounds.
    """

    __slots__ = ("_normals", "_pair", "_planes", "_track", "body", "extent", "n_steps", "pins")

    def __init__(
        self,
        extent: Extent,
        planes: dict[str, tuple[Plane, ...]],
        pins: Collection[str],
        resting: Resting | None,
    ) -> None:
        self.extent: Extent = extent
        self._planes = planes
        self.pins: Collection[str] = pins
        body = extent.body
        self.body: Body = body
        standing, self._pair = None, None
        if resting is not None:
            self._pair = pair_of(body.id, resting.support.id)
            self._normals = (support_normal(body, resting.support),) * 4
            standing = _standing(body, resting)
        self._track = Track(body.stance, standing)
        self.n_steps: int = 0
        self._set_bounds()

    def keep_behind(self, planes: Mapping[str, tuple[Plane, ...]]) -> None:
        """Replace separating planes, given by the id of the body on their other side."""
        self._planes.update(planes)
        self._set_bounds()

    def _set_bounds(self) -> None:
        """Give the track the box, narrowed by level planes, and the vertical planes."""
        (low, high), up, flat = self.extent.box, self.body.up_axis, self.body.v_axis
        lowest, highest, walls = low[up], high[up], []
        for several in self._planes.values():
            for n_u, n_v, n_h, most_m, is_square in several:
                if n_h == 0:
                    walls.append((n_u, n_v, most_m, is_square))
                elif n_h > 0:
                    highest = min(highest, most_m)
                else:
                    lowest = max(lowest, -most_m)
        self._track.keep_in((low[0], low[flat], high[0], high[flat]), (lowest, highest), walls)

    def step(self, pose: Pose, found: dict[Pair, Junction | None]) -> bool:
        """Move the body and add its junction to `found`. Returns False, and does nothing, if the bounds are left."""
        moved = self._track.moved(pose.position_m, pose.rotation_xyzw)
        if moved is None:
            return False
        low, high, points = moved
        self.body.put(pose, low, high)
        self.n_steps += 1
        if self._pair is not None:
            found[self._pair] = Junction(points, _ONES[: len(points)], self._normals[: len(points)])
        return True


def resting_on(body: Body, support: Body) -> Resting | None:
    """Return how a body rests on `support`; None if it does not, or if only triangles can tell."""
    if upper_of(body, support) is not body:
        return None
    space, up, top_face = FreeSpace(*roles(body, support)), body.up_axis, support.stance.top_face
    rest = rest_of(body, support, space)
    if rest is None or rest is NEEDS_TRIANGLES:
        return None
    is_certain = rest.wholly and _SURE_M < rest.fall_m < 2 / 3 * fall_reach_m(body.size_m)
    if is_certain and rest.on_ledge and top_face is not None:
        # The body may slide from the ledge onto a top face that is about as high.
        is_certain = rest.top_m + rest.fall_m < support.position_m[up] + top_face.height - TOUCH_M
    return Resting(support, rest, space, is_certain)


def standing_planes(body: Body, resting: Resting) -> tuple[Plane, ...] | None:
    """Return the planes that bound a resting body, besides the edges of the face; None if they are not known."""
    support, up, planes = resting.support, body.up_axis, tuple[Plane, ...]()
    if resting.rest.on_ledge:
        free = resting.space.planes(stands=True)
        if free is None:
            return None
        planes += free
        least_m = resting.rest.top_m + _SURE_M
        if least_m <= support.low[up] + TOUCH_M and least_m < support.high[up] - TOUCH_M:
            # Here `upper_of` needs the body inside the support's AABB, with a bottom no lower than that one's.
            floor_m = support.low[up] + max(-TOUCH_M, _SPARE * TOUCH_M - (body.high[up] - body.low[up]))
            planes += _all_in(support, floor_m)
    return planes


def _all_in(support: Body, floor_m: float) -> tuple[Plane, ...]:
    """Return the planes that keep a body inside a support's AABB, with its bottom above `floor_m`."""
    low, high, flat, up = support.low, support.high, support.v_axis, support.up_axis
    return (
        wall_at(1.0, 0.0, high[0], is_square=True),
        wall_at(-1.0, 0.0, -low[0], is_square=True),
        wall_at(0.0, 1.0, high[flat], is_square=True),
        wall_at(0.0, -1.0, -low[flat], is_square=True),
        roof_at(high[up]),
        floor_at(floor_m),
    )


def _standing(body: Body, resting: Resting) -> SupportFace:
    """Return the face of a support in world coordinates, and the bounds of a body's rest on it."""
    support, up, is_on_ledge = resting.support, body.up_axis, resting.rest.on_ledge
    face = resting.space.ledge_face if is_on_ledge else support.stance.top_face
    assert face is not None
    u, v = support.position_m[0], support.position_m[body.v_axis]
    least_m = resting.rest.top_m + _SURE_M
    # `upper_of` is sure of a clearly higher bottom, and inside the support (`_all_in`); else middles decide.
    is_beyond = least_m > support.low[up] + TOUCH_M or least_m < support.high[up] - TOUCH_M
    is_sure = is_on_ledge and is_beyond
    return SupportFace(
        [(nu, nv, offset + nu * u + nv * v) for nu, nv, offset in face.edges],
        support.position_m[up] + face.height,
        _SURE_M,
        2 / 3 * fall_reach_m(body.size_m),
        -math.inf if is_sure else support.low[up] + support.high[up],
    )


class Separated(NamedTuple):
    """Separating planes of two bodies, for each of the two."""

    one: tuple[Plane, ...]
    other: tuple[Plane, ...]


_APART = Separated((), ())


def separated(one: Extent, other: Extent, reach_m: float) -> Separated | None:
    """Return planes that prove that two bodies neither touch nor hang from each other; None if they are too near.

    Parameters: reach_m : largest distance at which the two touch or hang from each other [m].
    """
    x, y = one.body, other.body
    (a, b, c), (d, e, f) = one.box
    (g, h, i), (j, k, m) = other.box
    reach_m *= _SPARE
    far_m = max(reach_m, _SPARE * fall_reach_m(max(x.size_m, y.size_m)))
    if g - d > far_m or a - j > far_m or h - e > far_m or b - k > far_m or i - f > far_m or c - m > far_m:
        return _APART
    up, flat = x.up_axis, x.v_axis
    # A body wholly below another's support cannot touch it, such as a cupboard under a worktop.
    if y.high[up] < (most_m := one.top_m - max(3 * _SPARE * TOUCH_M, reach_m)):
        return Separated((), (roof_at(most_m),))
    if x.high[up] < (most_m := other.top_m - max(3 * _SPARE * TOUCH_M, reach_m)):
        return Separated((roof_at(most_m),), ())
    n_u, n_v, gap_m, one_m, other_m = separation(
        x.stance.footprint,
        (x.low[0] + x.high[0]) / 2,
        (x.low[flat] + x.high[flat]) / 2,
        y.stance.footprint,
        (y.low[0] + y.high[0]) / 2,
        (y.low[flat] + y.high[flat]) / 2,
    )
    beside_m = gap_m - reach_m
    is_above = x.low[up] + x.high[up] > y.low[up] + y.high[up]
    upper, lower = (x, y) if is_above else (y, x)
    over_m = upper.low[up] - lower.high[up] - max(reach_m, _SPARE * fall_reach_m(upper.size_m))
    free_m = max(beside_m, over_m)
    if free_m <= 0:
        return None
    # A fixed body needs no share of the free distance.
    share_m = 0.0 if one.is_fixed else free_m if other.is_fixed else free_m / 2
    its_m = free_m - share_m
    if beside_m >= over_m:
        return Separated((wall_at(n_u, n_v, one_m + share_m),), (wall_at(-n_u, -n_v, its_m - other_m),))
    if is_above:
        return Separated((floor_at(x.low[up] - share_m),), (roof_at(y.high[up] + its_m),))
    return Separated((roof_at(x.high[up] + share_m),), (floor_at(y.low[up] - its_m),))
