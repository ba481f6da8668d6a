"""Where a body that slides on another may go, and where it is then: the arithmetic of a glide, in plain numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from scene2hap.compiled import compiled
from scene2hap.contact.ledge import Flat
from scene2hap.contact.stance import Stance
from scene2hap.contact.vectors import Triple

Rotation = tuple[float, float, float, float]


MOST_CORNERS = 8
"""An outline of more is taken for the circle around it, as `free_space` does."""
SURELY_M = 1e-9
"""How far inside of all edges a base face is to be, that `rest_on` surely tells so too."""


class Bounds(NamedTuple):
    """Where a slide is sure.

    lane : where in the level plane the box of the body may be; heights : between which it may be; middle_m : twice the
    height of its middle is above this; edges : inside of which its base face is, (n_u, n_v, offset); top_m : how high
    these are; least_m, most_m : between which the body may be to fall there. All in the world [m].
    """

    lane: Flat
    heights: tuple[float, float]
    middle_m: float
    edges: Sequence[Triple]
    top_m: float
    least_m: float
    most_m: float


Slid = tuple[Triple, Triple, float, tuple[Triple, ...]]
"""The box of a body that slid, low and high, how far it is to fall [m], and where it touches what it slides on."""


@compiled
class Track:
    """A body that slides, turned as it was last, between bounds that it is to be given first."""

    def __init__(self, stance: Stance) -> None:
        self.stance = stance
        self._bounds: Bounds

    def bind(self, bounds: Bounds) -> None:
        """Go on between these bounds."""
        self._bounds = bounds

    def slid(self, position_m: Triple, rotation_xyzw: Rotation) -> Slid | None:
        """Where the body is there, None if that is not surely a slide."""
        stance = self.stance
        if rotation_xyzw != stance.rotation_xyzw:
            turned = stance.turned(rotation_xyzw)
            if turned.way_up != stance.way_up:
                return None
            stance = self.stance = turned
        (u0, v0, u1, v1), (lowest, highest), middle_m, edges, top_m, least_m, most_m = self._bounds
        up, flat = stance.up_axis, stance.v_axis
        x, y, z = position_m
        (a, b, c), (d, e, f) = stance.low, stance.high
        low, high = (x + a, y + b, z + c), (x + d, y + e, z + f)
        if low[0] < u0 or high[0] > u1 or low[flat] < v0 or high[flat] > v1:
            return None
        down, over = low[up], high[up]
        if down < lowest or over > highest or down + over <= middle_m:
            return None
        points, base_face, (mu, mv), radius, _ = stance.posed_base_face
        h, u, v = position_m[up], x, position_m[flat]
        fall_m = h + base_face - top_m
        if not least_m < fall_m < most_m:
            return None
        cu, cv = mu + u, mv + v
        for nu, nv, offset in edges:
            if nu * cu + nv * cv - offset < radius:
                # The circle around the base face is over an edge; the base face itself need not be.
                if len(stance.base_outline) > MOST_CORNERS:
                    return None
                for pu, pv in stance.base_outline:
                    for mu, mv, most in edges:
                        if mu * (u + pu) + mv * (v + pv) - most < SURELY_M:
                            return None
                break
        # As in `rest_points`, to the last bit.
        height = (h + base_face + top_m) / 2
        if up == 1:
            places = tuple([(u + pu, height, v + pv) for pu, pv in points])
        else:
            places = tuple([(u + pu, v + pv, height) for pu, pv in points])
        return low, high, fall_m, places
