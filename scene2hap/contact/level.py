"""Closed forms for bodies with level faces above each other: fall distance and contact points.

The bodies are compared by their convex outlines. The results equal those of the triangles.

    u, v : the world's level axes; h : the height [m]
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from scene2hap.contact.body import Body
from scene2hap.contact.geometry.polygons import Point, clipped, inside_edges
from scene2hap.contact.geometry.spread import spread
from scene2hap.contact.geometry.vectors import Triple

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
