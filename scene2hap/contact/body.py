"""Bodies: a shape, rotated (`Stance`) and placed (`Body`); the boxes of two bodies, and which is guest and which host.

Written in plain Python, since it runs often for one body at a time, where numpy's cost per call would dominate. The
level plane has coordinates (u, v), along the two world axes that are not up.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import NamedTuple

import numpy as np

from scene2hap.contact.base_face import across
from scene2hap.contact.geometry.level_plane import Footprint, Point, edges_of, turned_outline
from scene2hap.contact.geometry.vectors import Rows, Triple, rotated
from scene2hap.contact.ledge import FreeRegions, VerticalAxis
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.scene.objects import Hinge, SceneObject
from scene2hap.scene.pose import Pose

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
    """A shape with a rotation, without a position. It is reused while a body moves without rotation.

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


class Body:
    """A shape at a pose. A moved object gets a new body, unless a certificate moves the old one in place (`put`).

    `low` and `high` are the corners of its AABB in the world [m]; the vertical extent is exact, the others may be too
    wide. The world's axes 0 and `v_axis` are level.
    """

    __slots__ = (
        "_stance",
        "free_regions",
        "high",
        "hinge",
        "id",
        "low",
        "pose",
        "position_m",
        "shape",
        "size_m",
        "up_axis",
        "v_axis",
    )

    def __init__(self, object_id: str, shape: Shape, pose: Pose, up_axis: int, hinge: Hinge | None = None) -> None:
        self.id: str = object_id
        self.hinge: Hinge | None = hinge
        self.shape: Shape = shape
        self.size_m: float = shape.size_m
        self.pose: Pose = pose
        self.up_axis: int = up_axis
        self.v_axis: int = 3 - up_axis
        self.free_regions: FreeRegions = FreeRegions()  # see `contact.free_space`
        stance = self._stance = Stance(shape, pose.rotation_xyzw, up_axis)
        x, y, z = pose.position_m
        self.position_m: Triple = pose.position_m
        low, high = stance.low, stance.high
        self.low: Triple = (x + low[0], y + low[1], z + low[2])
        self.high: Triple = (x + high[0], y + high[1], z + high[2])

    @classmethod
    def of(cls, item: SceneObject, up_axis: int) -> Body:
        """Build the body of an object in a scene whose axis `up_axis` (1 or 2) points up."""
        return cls(item.id, shape_of(item.geometry.mesh), item.pose, up_axis, item.hinge)

    def at(self, pose: Pose) -> Body:
        """Return a body of the same shape at another pose."""
        # Attributes are copied one by one, since this runs for every moved object in every frame.
        body = Body.__new__(Body)
        body.id, body.shape, body.size_m = self.id, self.shape, self.size_m
        body.up_axis, body.v_axis, body.hinge = self.up_axis, self.v_axis, self.hinge
        body.pose, body._stance, body.free_regions = pose, self._stance, self.free_regions
        stance = body.stance
        x, y, z = body.position_m = pose.position_m
        (a, b, c), (d, e, f) = stance.low, stance.high
        body.low, body.high = (x + a, y + b, z + c), (x + d, y + e, z + f)
        return body

    def put(self, pose: Pose, low: Triple, high: Triple) -> None:
        """Move in place to a pose whose AABB is already known."""
        self.pose, self.position_m, self.low, self.high = pose, pose.position_m, low, high

    @property
    def stance(self) -> Stance:
        """The shape at the body's rotation; recomputed only after a rotation."""
        stance, rotation_xyzw = self._stance, self.pose.rotation_xyzw
        if stance.rotation_xyzw is not rotation_xyzw and stance.rotation_xyzw != rotation_xyzw:
            stance = self._stance = stance.turned(rotation_xyzw)
        return stance

    @property
    def middle_m(self) -> Triple:
        """The middle of the oriented box in the world."""
        (x, y, z), (u, v, w) = self.stance.middle, self.position_m
        return (u + x, v + y, w + z)

    def to_world(self, point_m: Triple) -> Triple:
        """Return a point of the shape's frame in the world."""
        (x, y, z), (u, v, w) = rotated(self.stance.rows, point_m), self.position_m
        return (u + x, v + y, w + z)


def roles(x: Body, y: Body) -> tuple[Body, Body]:
    """Return guest and host, the smaller and the larger body; ids decide between equal sizes."""
    return (x, y) if (x.size_m, y.id) < (y.size_m, x.id) else (y, x)


def box_distance_m(x: Body, y: Body) -> float:
    """Return the largest gap of two AABBs along an axis [m], negative if they overlap: a lower bound of distance."""
    (a, b, c), (d, e, f), (g, h, i), (j, k, m) = x.low, x.high, y.low, y.high
    return max(a - j, g - d, b - k, h - e, c - m, i - f)


def apart_by(x: Body, y: Body, margin_m: float) -> bool:
    """Return True if two AABBs are more than `margin_m` apart along some axis."""
    return box_distance_m(x, y) > margin_m


def box_in_frame(guest: Body, host: Body) -> tuple[Triple, Triple]:
    """Return middle and half edges [m], along the host's axes, of a box around the guest's oriented box."""
    (x, y, z), (u, v, w), (p, q, r) = guest.middle_m, host.position_m, guest.shape.half
    x, y, z = x - u, y - v, z - w
    (a, b, c), (d, e, f), (g, h, i) = guest.stance.rows
    (j, k, ll), (m, n, o), (s, t, u) = host.stance.rows
    return (
        (j * x + m * y + s * z, k * x + n * y + t * z, ll * x + o * y + u * z),
        (
            abs(j * a + m * d + s * g) * p + abs(j * b + m * e + s * h) * q + abs(j * c + m * f + s * i) * r,
            abs(k * a + n * d + t * g) * p + abs(k * b + n * e + t * h) * q + abs(k * c + n * f + t * i) * r,
            abs(ll * a + o * d + u * g) * p + abs(ll * b + o * e + u * h) * q + abs(ll * c + o * f + u * i) * r,
        ),
    )
