"""Narrow phase of two bodies: which may rest on the other, their distance, and their contact points.

Level faces are compared in closed form by their convex outlines, concave hosts by their free regions, all else by
triangles. Closed forms give the results of the triangles.

    u, v : the world's level axes; h : the height [m]
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Sequence
from functools import cached_property
from typing import NamedTuple

from scene2hap.common.arrays import Floats
from scene2hap.contact.body import Body, roles
from scene2hap.contact.enclosure import enclosed
from scene2hap.contact.free_space import FreeSpace
from scene2hap.contact.geometry.level_plane import Point, clipped, inside_edges
from scene2hap.contact.geometry.spread import spread
from scene2hap.contact.geometry.vectors import Triple
from scene2hap.contact.hinge import HingedBodies, pivot_m
from scene2hap.contact.mesh_distance import Gap, MeshPair
from scene2hap.contact.rule import TOUCH_M, fall_reach_m, is_over, upper_of

# Least overlap of two outlines, as a share of the upper one's radius, and its upper bound. Without it, equal boxes side
# by side, whose rims coincide, would lie over each other.
_RIM, _RIM_M = 1e-4, 1e-4
_ROUNDING_M = 1e-9


class Rest(NamedTuple):
    """How a body may rest on a face at height `top_m` [m]: its fall distance [m], whether the face is under its whole
    base face, and whether the face is a ledge of a concave host."""

    fall_m: float
    wholly: bool
    top_m: float
    on_ledge: bool = False


NEEDS_TRIANGLES = Rest(math.nan, False, math.nan)
"""Marks a fall distance that only triangles can give."""


def rest_of(x: Body, y: Body, space: FreeSpace) -> Rest | None:
    """Return how x may rest on y: None if it cannot, `NEEDS_TRIANGLES` if only triangles can tell.

    Parameters: x : the upper one by `upper_of`; space : the free space of the larger body around the smaller one.
    """
    if not is_over(x, y):
        return None
    up = x.up_axis
    rest = rest_on(x, y)
    if rest is None or rest.fall_m < -TOUCH_M:
        known = space.region_below
        if known is None:
            return NEEDS_TRIANGLES
        if known.top_m is None:
            return None
        top_m = y.position_m[up] + known.top_m
        rest = Rest(x.position_m[up] + x.stance.posed_base_face.height - top_m, True, top_m, True)
        if space.guest is not x or rest.fall_m < -TOUCH_M:
            return NEEDS_TRIANGLES
    return rest if rest.fall_m <= fall_reach_m(x.size_m) else None


def rest_on(x: Body, y: Body) -> Rest | None:
    """Return how the base face of x rests on the top face of y, None where the outlines do not decide it.

    Where the outlines do not overlap, other parts of the two shapes still may.
    """
    top_face = y.stance.top_face
    if top_face is None:
        return None
    base_face = x.stance.posed_base_face
    a, v_axis = x.up_axis, x.v_axis
    px, py = x.position_m, y.position_m
    top_m = py[a] + top_face.height
    fall_m = px[a] + base_face.height - top_m
    du, dv = px[0] - py[0], px[v_axis] - py[v_axis]
    cu, cv = base_face.middle[0] + du, base_face.middle[1] + dv
    radius = base_face.radius
    # The circle around the base face decides most cases.
    is_wholly_inside = True
    for nu, nv, offset in top_face.edges:
        inside_m = nu * cu + nv * cv - offset
        if inside_m < -radius:
            return None
        if inside_m < radius:
            is_wholly_inside = False
    if is_wholly_inside:
        return Rest(fall_m, True, top_m)
    rim = min(_RIM * radius, _RIM_M)
    outermost_m, innermost_m = inside_edges(x.stance.base_outline, du, dv, top_face.edges)
    if innermost_m <= rim:
        return None
    if outermost_m >= -_ROUNDING_M:
        return Rest(fall_m, True, top_m)
    if not base_face.is_filled:
        return None
    _, innermost_m = inside_edges(top_face.outline, -du, -dv, x.stance.base_edges)
    return Rest(fall_m, False, top_m) if innermost_m > rim else None


def rest_points(x: Body, y: Body, rest: Rest, slack_m: float) -> tuple[Triple, ...]:
    """Return contact points in the world, half way between x's base face and y's top face where these overlap.

    Corners of the base face up to `slack_m` outside the top face count.
    """
    base_face = x.stance.posed_base_face
    a, v_axis = x.up_axis, x.v_axis
    px, py = x.position_m, y.position_m
    height = (px[a] + base_face.height + rest.top_m) / 2
    u, v = px[0], px[v_axis]
    level: Sequence[Point] = base_face.points
    if not rest.wholly:
        top_face = y.stance.top_face
        assert top_face is not None
        ring = clipped(x.stance.base_outline, u - py[0], v - py[v_axis], top_face.edges, slack_m)
        # Chosen in coordinates that rotate with y, so that a rotation of the whole scene does not change the result,
        # nor another axis up: (u, v, h) is left-handed with y up, and right-handed with z up.
        c, s = y.stance.heading
        side = 1.0 if a == 1 else -1.0
        level = [ring[k] for k in spread([(c * pu + s * pv, side * (c * pv - s * pu)) for pu, pv in ring])]
        u, v = py[0], py[v_axis]
    return points_at(level, u, v, height, a)


def points_at(level: Iterable[Point], u: float, v: float, height: float, up_axis: int) -> tuple[Triple, ...]:
    """Return points of the level plane, moved by (u, v), as points in the world at a height."""
    if up_axis == 1:
        return tuple([(u + pu, height, v + pv) for pu, pv in level])
    return tuple([(u + pu, v + pv, height) for pu, pv in level])


def support_normal(x: Body, y: Body) -> Triple:
    """Return the normal of a contact by which y supports x, from the body with the lower id to the other."""
    way = -1.0 if x.id < y.id else 1.0
    return (0.0, way, 0.0) if x.up_axis == 1 else (0.0, 0.0, way)


class BodyPair:
    """Narrow-phase answers for two posed bodies, computed once and kept until either moves; `a` has the lower id.

    Parameters: hinged : the bodies that hinges hold, which do not rest on others.
    """

    def __init__(self, a: Body, b: Body, hinged: Container[str] = ()) -> None:
        self.a: Body = a
        self.b: Body = b
        self.space: FreeSpace = FreeSpace(*roles(a, b))
        self.pivot_m: Triple | None = None if a.hinge is None and b.hinge is None else pivot_m(a, b)
        upper = None if self.pivot_m is not None else upper_of(a, b)
        # How one body, the faller, may rest on the other; None if neither may. See `rest_of`.
        self.rest: Rest | None = None
        self.faller: str | None = None
        if upper is not None and upper.id not in hinged:
            self.rest = rest_of(upper, b if upper is a else a, self.space)
            self.faller = None if self.rest is None else upper.id
        self._first_fall_m: float | None = None
        # The distance up to which the gap was searched; -1 before the first search.
        self._gap_within_m = -1.0
        self._gap: Gap | None = None

    def first_fall_m(self, *, by_each: bool = False) -> float:
        """Return the least of the distances of `falls` [m], inf if there is none.

        Parameters: by_each : True if `falls` will be needed as well, which then is the only search.
        """
        if self._first_fall_m is None:
            if by_each:
                self._first_fall_m = math.inf if self.falls is None else float(self.falls.min())
            else:
                faller, _ = self.falling
                self._first_fall_m = self._mesh_pair.first_drop_m(faller, fall_reach_m(faller.size_m), TOUCH_M)
        return self._first_fall_m

    @cached_property
    def falls(self) -> Floats | None:
        """The fall distance of each triangle of the faller onto the other body [m]; see `MeshPair.drops`."""
        faller, _ = self.falling
        return self._mesh_pair.drops(faller, fall_reach_m(faller.size_m), TOUCH_M)

    @property
    def falling(self) -> tuple[Body, Body]:
        """The faller and the other body, of a pair that has a faller."""
        return (self.a, self.b) if self.faller == self.a.id else (self.b, self.a)

    def gap(self, within_m: float) -> Gap | None:
        """Return the distance of the surfaces, None beyond `within_m`; see `MeshPair.gap`."""
        if within_m > self._gap_within_m:
            self._gap_within_m, self._gap = within_m, self._mesh_pair.gap(within_m)
        gap = self._gap
        return gap if gap is not None and gap.distance_m <= within_m else None

    @cached_property
    def enclosed(self) -> tuple[float, float]:
        """The weight and play of a contact by enclosure; see `enclosure.enclosed`."""
        return enclosed(self.a, self.b)

    def points(self, way_m: Triple, within_m: float) -> tuple[Triple, ...]:
        """Return points half way between the surfaces where they are within `within_m` once a has moved by `way_m`;
        of two hinged bodies, their pivot alone."""
        if self.pivot_m is not None:
            return (self.pivot_m,)
        return tuple([ends.middle_m for ends in self._mesh_pair.patch(way_m, within_m)])

    @cached_property
    def _mesh_pair(self) -> MeshPair:
        return MeshPair(self.a, self.b)


class BodyPairs:
    """All bodies by id, and the pairs of near ones: `of[x][y]` and `of[y][x]` are the same pair."""

    def __init__(self) -> None:
        self.bodies: dict[str, Body] = {}
        self.of: dict[str, dict[str, BodyPair]] = {}
        self.hinged: HingedBodies = HingedBodies(self.bodies)

    def made(self, x: Body, y: Body) -> BodyPair:
        """Return the pair of two bodies at their present poses, without adding it."""
        a, b = (x, y) if x.id < y.id else (y, x)
        return BodyPair(a, b, self.hinged.on)

    def add(self, body_pair: BodyPair) -> BodyPair:
        """Add a pair, in the place of one of the same bodies. Returns the pair."""
        a, b = body_pair.a.id, body_pair.b.id
        self.of.setdefault(a, {})[b] = self.of.setdefault(b, {})[a] = body_pair
        return body_pair

    def drop(self, x: str, y: str) -> BodyPair | None:
        """Drop the pair of two bodies. Returns it, None if there was none."""
        body_pair = self.of.get(x, {}).pop(y, None)
        if body_pair is not None:
            del self.of[y][x]
        return body_pair
