"""The arithmetic of a certificate: test a new pose against the bounds, and compute the AABB and contact points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from scene2hap.compiled import compiled
from scene2hap.contact.geometry.planes import reach_along
from scene2hap.contact.geometry.polygons import inside_edges
from scene2hap.contact.geometry.vectors import Triple
from scene2hap.contact.ledge import Flat
from scene2hap.contact.level import points_at
from scene2hap.contact.stance import Stance

Rotation = tuple[float, float, float, float]

MOST_CORNERS = 8
"""An outline with more corners is replaced by the circle around it, as in `free_space`."""
SURELY_M = 1e-9
"""How far inside all edges a base face must be, so that `rest_on` surely finds it inside as well."""


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
        if not is_circle_inside and (len(outline) > MOST_CORNERS or inside_edges(outline, u, v, edges)[0] < SURELY_M):
            return None
        return low, high, points_at(points, u, v, (h + base_face + top_m) / 2, up)
