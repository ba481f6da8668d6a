"""Stance: a rotated shape without a position. It is reused while a body moves without rotation.

Written in plain Python, since a frame moves a few objects only, and numpy's cost per call would dominate. The level
plane has coordinates (u, v), along the two world axes that are not up.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import NamedTuple

import numpy as np

from scene2hap.contact.base_face import across
from scene2hap.contact.geometry.planes import Footprint
from scene2hap.contact.geometry.polygons import Point, edges_of, turned_outline
from scene2hap.contact.geometry.vectors import Rows, Triple, rotated
from scene2hap.contact.ledge import VerticalAxis
from scene2hap.contact.shape import Shape

# Digits to which the upward direction is rounded before level faces are searched. Rounding in a game, or jitter of an
# engine below 0.003 degrees, then changes nothing.
_DIGITS = 4
_MOST_LEAN = 1e-3  # [rad]; a larger tilt is no rounding error.
_MOST_TILT_M = 1e-4  # Largest lean of a host over its whole size: the error of a ledge's height.
_UPRIGHT = 1 - 1e-12  # Cosine above which an axis of the shape is vertical, so that its box has the true height.


class PosedBaseFace(NamedTuple):
    """A rotated base face, relative to the body's position [m]: contact points, height, a circle around it, and whether
    it fills its outline."""

    points: tuple[Point, ...]
    height: float
    middle: Point
    radius: float
    is_filled: bool


class TopFace(NamedTuple):
    """A rotated top face, relative to the body's position [m].

    edges : (n_u, n_v, offset) of each edge, inside where n_u u + n_v v >= offset.
    """

    outline: tuple[Point, ...]
    height: float
    edges: tuple[Triple, ...]


class Tilt(NamedTuple):
    """The vertical axis of a shape's frame, and its tilt from the vertical [rad]."""

    own: VerticalAxis
    tilt: float


class Stance:
    """A shape with a rotation.

    `middle` is that of its oriented box, `low` and `high` are the corners of its AABB, relative to its position [m].
    """

    def __init__(self, shape: Shape, rotation_xyzw: tuple[float, float, float, float], up_axis: int) -> None:
        x, y, z, w = rotation_xyzw
        self.rotation_xyzw = rotation_xyzw
        self.shape = shape
        xx, yy, zz, xy, xz, yz, wx, wy, wz = x * x, y * y, z * z, x * y, x * z, y * z, x * w, y * w, z * w
        self.rows: Rows = (
            (1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)),
            (2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)),
            (2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)),
        )
        self.up_axis = up_axis
        self.v_axis: int = 3 - up_axis
        up = self.rows[up_axis]
        self.way_up: Triple = (
            round(up[0], _DIGITS) + 0.0,
            round(up[1], _DIGITS) + 0.0,
            round(up[2], _DIGITS) + 0.0,
        )
        self.middle: Triple
        self.low: Triple
        self.high: Triple
        self.middle, self.low, self.high = self._bounds(up)

    def _bounds(self, up: Triple) -> tuple[Triple, Triple, Triple]:
        """Return the middle of the oriented box, and the corners of the AABB."""
        hx, hy, hz = self.shape.half
        (a, b, c), (d, e, f), (g, h, i) = self.rows
        u, v, w = middle = rotated(self.rows, self.shape.middle)
        x = abs(a) * hx + abs(b) * hy + abs(c) * hz
        y = abs(d) * hx + abs(e) * hy + abs(f) * hz
        z = abs(g) * hx + abs(h) * hy + abs(i) * hz
        low, high = (u - x, v - y, w - z), (u + x, v + y, w + z)
        if abs(up[0]) > _UPRIGHT or abs(up[1]) > _UPRIGHT or abs(up[2]) > _UPRIGHT:
            return middle, low, high
        heights = self.shape.corners @ np.array(up)
        least, most = float(heights.min()), float(heights.max())
        if self.up_axis == 1:
            return middle, (low[0], least, low[2]), (high[0], most, high[2])
        return middle, (low[0], low[1], least), (high[0], high[1], most)

    def turned(self, rotation_xyzw: tuple[float, float, float, float]) -> Stance:
        """Return the shape with another rotation."""
        return Stance(self.shape, rotation_xyzw, self.up_axis)

    @cached_property
    def posed_base_face(self) -> PosedBaseFace:
        """The base face at this rotation."""
        base_face = self.shape.base_face(self.way_up)
        u, v, height = self._turned(base_face.middle_m)
        if not base_face.is_level:
            height = self.low[self.up_axis]
        points = turned_outline(base_face.points_m, self.rows[0], self.rows[self.v_axis])
        return PosedBaseFace(points, height, (u, v), base_face.radius_m, base_face.is_filled)

    @cached_property
    def base_outline(self) -> tuple[Point, ...]:
        """The outline of the base face (support polygon), relative to the position [m]."""
        return turned_outline(self.shape.base_face(self.way_up).outline_m, self.rows[0], self.rows[self.v_axis])

    @cached_property
    def base_edges(self) -> tuple[Triple, ...]:
        """The edges of `base_outline`, in the form of `TopFace.edges`."""
        return edges_of(self.base_outline)

    @cached_property
    def top_face(self) -> TopFace | None:
        """The top face at this rotation, None unless it is level and convex."""
        top_m = self.shape.top(self.way_up)
        if top_m is None:
            return None
        corners = [self._turned(corner) for corner in top_m]
        outline = tuple([(u, v) for u, v, _ in corners])
        return TopFace(outline, sum(h for _, _, h in corners) / len(corners), edges_of(outline))

    @cached_property
    def lean(self) -> Tilt | None:
        """The tilt of the vertical axis of the shape's frame, None if no axis is near the vertical."""
        up = self.rows[self.up_axis]
        axis = max(range(3), key=lambda k: abs(up[k]))
        u, v = (k for k in range(3) if k != axis)
        tilt = math.hypot(up[u], up[v])
        return Tilt(VerticalAxis(axis, 1 if up[axis] > 0 else -1, u, v), tilt) if tilt <= _MOST_LEAN else None

    @cached_property
    def upright(self) -> VerticalAxis | None:
        """The vertical axis of the shape's frame, None if it leans so much that its level faces have no one height."""
        lean = self.lean
        return lean.own if lean is not None and lean.tilt * self.shape.size_m <= _MOST_TILT_M else None

    @cached_property
    def footprint(self) -> Footprint:
        """The projection onto the level plane: of the oriented box if it stands upright, else of the AABB."""
        lean, low, high, half = self.lean, self.low, self.high, self.shape.half
        if lean is None:
            half_1, half_2 = (high[0] - low[0]) / 2, (high[self.v_axis] - low[self.v_axis]) / 2
            return Footprint(1.0, 0.0, half_1, half_2, math.hypot(half_1, half_2))
        (axis, _, u, v), more_m = lean.own, lean.tilt * self.shape.size_m
        a_u, a_v = self.rows[0][u], self.rows[self.v_axis][u]
        return Footprint(a_u, a_v, half[u] + more_m, half[v] + more_m, self.shape.radius_m(axis) + more_m)

    @cached_property
    def heading(self) -> Point:
        """A unit vector in the level plane that rotates with the shape."""
        return self._turned(across(self.way_up))[:2]

    def _turned(self, point: Triple) -> Triple:
        """Return (u, v, height) of a point of the shape's frame, relative to the position."""
        return rotated((self.rows[0], self.rows[self.v_axis], self.rows[self.up_axis]), point)
