"""How one lies wholly on another without doubt: the same as `BodyPair.rest` and `rest_points` tell, in one go."""

from __future__ import annotations

from typing import NamedTuple

from scene2hap.compiled import compiled
from scene2hap.contact.body import Body
from scene2hap.contact.free_space import ledge_under
from scene2hap.contact.free_space import top_face as clearing_tray
from scene2hap.contact.level import Rest, rest_on
from scene2hap.contact.relative import roles
from scene2hap.contact.stance import PosedBaseFace, TopFace
from scene2hap.contact.support import TOUCH_M, fall_reach_m, is_over
from scene2hap.contact.vectors import Triple

SURE_M = -TOUCH_M + 0.001
"""Above this a fall is surely none of a thing that stands in another: tops and base faces may be 0.2 mm uneven each."""


class Slide(NamedTuple):
    """How and where x lies wholly on y, and on what of it."""

    rest: Rest
    points: tuple[Triple, ...]
    top_face: TopFace
    is_ledge: bool


def slide(x: Body, y: Body) -> Slide | None:
    """How x lies on y if it does so wholly, without doubt and with full weight; else None: `BodyPair` must tell."""
    up, posed_base_face = x.up_axis, x.stance.posed_base_face
    top_face, is_ledge = y.stance.top_face, False
    if top_face is None or x.position_m[up] + posed_base_face.height - (y.position_m[up] + top_face.height) < -TOUCH_M:
        top_face, is_ledge = _ledge(x, y), True
        if top_face is None:
            return None
    fall_m, top_m, is_inside, points = lying(x.position_m, posed_base_face, y.position_m, top_face, up)
    if not SURE_M < fall_m < 2 / 3 * fall_reach_m(x.size_m) or not is_over(x, y):
        return None
    if not (is_ledge or is_inside):
        rest = rest_on(x, y)
        if rest is None or not rest.wholly:
            return None
    return Slide(Rest(fall_m, True, top_m), points, top_face, is_ledge)


@compiled
def lying(
    position_m: Triple, base_face: PosedBaseFace, at_m: Triple, top_face: TopFace, up_axis: int
) -> tuple[float, float, bool, tuple[Triple, ...]]:
    """How far a base face is to fall to a top, how high that is, whether the circle around the base face is inside of
    all edges, and the points of the base face, half way between.

    Parameters: position_m, at_m : where the two things are whose base face and top they are.
    """
    flat = 3 - up_axis
    u, v, h = position_m[0], position_m[flat], position_m[up_axis]
    top_m = at_m[up_axis] + top_face.height
    fall_m = h + base_face.height - top_m
    cu, cv = base_face.middle[0] + (u - at_m[0]), base_face.middle[1] + (v - at_m[flat])
    is_inside = all(nu * cu + nv * cv - offset >= base_face.radius for nu, nv, offset in top_face.edges)
    # The same arithmetic as in `rest_points`, so that the last bits are those of building from nothing.
    height = (h + base_face.height + top_m) / 2
    if up_axis == 1:
        points = tuple([(u + pu, height, v + pv) for pu, pv in base_face.points])
    else:
        points = tuple([(u + pu, v + pv, height) for pu, pv in base_face.points])
    return fall_m, top_m, is_inside, points


def _ledge(x: Body, y: Body) -> TopFace | None:
    """The ledge of y that is wholly under x."""
    guest, host = roles(x, y)
    known = ledge_under(guest, host) if guest is x else None
    return None if known is None or known.top_m is None else clearing_tray(host, known)
