"""How one lies wholly on another without doubt: the same as `Tie.rest` and `rest_points` tell, in one go."""

from __future__ import annotations

from typing import NamedTuple

from scene2hap.compiled import compiled
from scene2hap.contact.body import Body
from scene2hap.contact.clearing import below
from scene2hap.contact.clearing import tray as clearing_tray
from scene2hap.contact.level import Rest, rest_on
from scene2hap.contact.relative import roles
from scene2hap.contact.stance import Footing, Tray
from scene2hap.contact.support import TOUCH_M, fall_reach_m, is_over
from scene2hap.contact.vectors import Triple

SURE_M = -TOUCH_M + 0.001
"""Above this a fall is surely none of a thing that stands in another: tops and soles may be 0.2 mm uneven each."""


class Slide(NamedTuple):
    """How and where x lies wholly on y, and on what of it."""

    rest: Rest
    points: tuple[Triple, ...]
    tray: Tray
    is_ledge: bool


def slide(x: Body, y: Body) -> Slide | None:
    """How x lies on y if it does so wholly, without doubt and with full weight; else None: `Tie` must tell."""
    up, footing = x.up_axis, x.stance.footing
    tray, is_ledge = y.stance.tray, False
    if tray is None or x.position_m[up] + footing.height - (y.position_m[up] + tray.height) < -TOUCH_M:
        tray, is_ledge = _ledge(x, y), True
        if tray is None:
            return None
    fall_m, top_m, is_inside, points = lying(x.position_m, footing, y.position_m, tray, up)
    if not SURE_M < fall_m < 2 / 3 * fall_reach_m(x.size_m) or not is_over(x, y):
        return None
    if not (is_ledge or is_inside):
        rest = rest_on(x, y)
        if rest is None or not rest.wholly:
            return None
    return Slide(Rest(fall_m, True, top_m), points, tray, is_ledge)


@compiled
def lying(
    position_m: Triple, sole: Footing, at_m: Triple, tray: Tray, up_axis: int
) -> tuple[float, float, bool, tuple[Triple, ...]]:
    """How far a sole is to fall to a top, how high that is, whether the circle around the sole is inside of all edges,
    and the points of the sole, half way between.

    Parameters: position_m, at_m : where the two things are whose sole and top they are.
    """
    flat = 3 - up_axis
    u, v, h = position_m[0], position_m[flat], position_m[up_axis]
    top_m = at_m[up_axis] + tray.height
    fall_m = h + sole.height - top_m
    cu, cv = sole.middle[0] + (u - at_m[0]), sole.middle[1] + (v - at_m[flat])
    is_inside = all(nu * cu + nv * cv - offset >= sole.radius for nu, nv, offset in tray.edges)
    # The same arithmetic as in `rest_points`, so that the last bits are those of building from nothing.
    height = (h + sole.height + top_m) / 2
    if up_axis == 1:
        points = tuple([(u + pu, height, v + pv) for pu, pv in sole.points])
    else:
        points = tuple([(u + pu, v + pv, height) for pu, pv in sole.points])
    return fall_m, top_m, is_inside, points


def _ledge(x: Body, y: Body) -> Tray | None:
    """The ledge of y that is wholly under x."""
    guest, host = roles(x, y)
    known = below(guest, host) if guest is x else None
    return None if known is None or known.top_m is None else clearing_tray(host, known)
