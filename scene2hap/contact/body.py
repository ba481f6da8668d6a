"""A body: the shape of a scene object at a pose; the boxes of two bodies, and which is guest and which is host.

Written in plain Python, since it runs often for one body at a time, where numpy's cost per call would dominate.
"""

from __future__ import annotations

from scene2hap.contact.geometry.vectors import Triple, rotated
from scene2hap.contact.ledge import FreeRegions
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.contact.stance import Stance
from scene2hap.scene.objects import Hinge, SceneObject
from scene2hap.scene.pose import Pose


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
