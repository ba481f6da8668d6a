"""Closed forms for bodies with level faces above each other: fall distance and contact points.

The bodies are compared by their convex outlines. The results equal those of the triangles.

    u, v : the world's level axes; h : the height [m]
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from scene2hap.contact.body import Body
from scene2hap.contact.geometry.polygons import Point, clipped, inside_edges
from scene2hap.contact.geometry.spread import spread_few
from scene2hap.contact.geometry.vectors import Triple
from scene2hap.contact.stance import Stance

# Least overlap of two outlines, as a share of the upper one's radius, and its upper bound. Without it, equal boxes side
# by side, whose rims coincide, would lie over each other.
_RIM, _RIM_M = 1e-4, 1e-4
_ROUNDING_M = 1e-9
_SLACK_M = 1e-6  # Margin of circle tests, so that rounding never makes them contradict the corners.


class Rest(NamedTuple):
    """How a body may rest on a face at height `top_m` [m]: its fall distance [m], and whether the face is under its
    whole base face."""

    fall_m: float
    wholly: bool
    top_m: float


def rest_on(x: Body, y: Body) -> Rest | None:
    """Return how the base face of x rests on the top face of y.

    None where the outlines do not decide it; a fall distance of inf where two blocks are beside each other.
    """
    base_face, top_face = x.stance.posed_base_face, y.stance.top_face
    if top_face is None:
        return None
    a, v_axis = x.up_axis, x.v_axis
    px, py = x.position_m, y.position_m
    top_m = py[a] + top_face.height
    fall_m = px[a] + base_face.height - top_m
    du, dv = px[0] - py[0], px[v_axis] - py[v_axis]
    cu, cv = base_face.middle[0] + du, base_face.middle[1] + dv
    radius = base_face.radius
    for nu, nv, offset in top_face.edges:
        if nu * cu + nv * cv - offset < radius:
            break
    else:
        return Rest(fall_m, True, top_m)
    rim = min(_RIM * radius, _RIM_M)
    mu, mv = top_face.middle
    if math.hypot(cu - mu, cv - mv) > radius + top_face.radius + _SLACK_M:
        return _beside(x, y)
    outermost_m, innermost_m = inside_edges(x.stance.base_outline, du, dv, top_face.edges)
    if innermost_m <= rim:
        return _beside(x, y)
    if outermost_m >= -_ROUNDING_M:
        return Rest(fall_m, True, top_m)
    if not base_face.is_filled:
        return None
    _, innermost_m = inside_edges(top_face.outline, -du, -dv, x.stance.base_edges)
    if innermost_m <= rim:
        return _beside(x, y)
    return Rest(fall_m, False, top_m)


def _beside(x: Body, y: Body) -> Rest | None:
    # Other shapes may extend beyond the outlines of their base and top faces.
    return Rest(math.inf, False, -math.inf) if x.stance.is_block and y.stance.is_block else None


def rest_points(x: Body, y: Body, rest: Rest, slack_m: float) -> tuple[Triple, ...]:
    """Return contact points in the world, half way between x's base face and y's top face where these overlap.

    Corners of the base face up to `slack_m` outside the top face count.
    """
    base_face = x.stance.posed_base_face
    a, v_axis = x.up_axis, x.v_axis
    px, py = x.position_m, y.position_m
    height = (px[a] + base_face.height + rest.top_m) / 2
    u, v = px[0], px[v_axis]
    if rest.wholly:
        if a == 1:
            return tuple([(u + pu, height, v + pv) for pu, pv in base_face.points])
        level: Sequence[Point] = [(u + pu, v + pv) for pu, pv in base_face.points]
    else:
        top_face = y.stance.top_face
        assert top_face is not None
        ring = clipped(x.stance.base_outline, u - py[0], v - py[v_axis], top_face.edges, slack_m)
        level = [(pu + py[0], pv + py[v_axis]) for pu, pv in _chosen(ring, y.stance)]
    if a == 1:
        return tuple([(pu, height, pv) for pu, pv in level])
    return tuple([(pu, pv, height) for pu, pv in level])


def _chosen(ring: Sequence[Point], stance: Stance) -> list[Point]:
    return [ring[k] for k in spread_few(_own(ring, stance))]


def _own(ring: Sequence[Point], stance: Stance) -> list[Point]:
    """Coordinates that turn with the stance, so that the rotation of a whole scene does not change the result."""
    c, s = stance.heading
    return [(c * u + s * v, c * v - s * u) for u, v in ring]
