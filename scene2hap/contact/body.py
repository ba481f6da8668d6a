"""A body: the shape of a scene object at a pose."""

from __future__ import annotations

from scene2hap.contact.free_region import FreeRegions
from scene2hap.contact.geometry.vectors import Rows, Triple
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.contact.stance import Stance
from scene2hap.scene.objects import SceneObject
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
        "id",
        "low",
        "pose",
        "position_m",
        "shape",
        "size_m",
        "up_axis",
        "v_axis",
    )

    def __init__(self, object_id: str, shape: Shape, pose: Pose, up_axis: int) -> None:
        self.id = object_id
        self.shape = shape
        self.size_m = shape.size_m
        self.pose = pose
        self.up_axis, self.v_axis = up_axis, 3 - up_axis
        self.free_regions = FreeRegions()  # see `contact.free_space`
        stance = self._stance = Stance(shape, pose.rotation_xyzw, up_axis)
        x, y, z = self.position_m = pose.position_m
        low, high = stance.low, stance.high
        self.low = (x + low[0], y + low[1], z + low[2])
        self.high = (x + high[0], y + high[1], z + high[2])

    @classmethod
    def of(cls, item: SceneObject, up_axis: int) -> Body:
        """Build the body of an object in a scene whose axis `up_axis` (1 or 2) points up."""
        return cls(item.id, shape_of(item.geometry.mesh), item.pose, up_axis)

    def at(self, pose: Pose) -> Body:
        """Return a body of the same shape at another pose."""
        # Attributes are copied one by one, since this runs for every moved object in every frame.
        body = Body.__new__(Body)
        body.id, body.shape, body.size_m = self.id, self.shape, self.size_m
        body.up_axis, body.v_axis = self.up_axis, self.v_axis
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
    def lowest_m(self) -> float:
        """Height of the lowest point."""
        return self.low[self.up_axis]

    @property
    def highest_m(self) -> float:
        """Height of the highest point."""
        return self.high[self.up_axis]

    @property
    def rows(self) -> Rows:
        """The rotation matrix, as rows."""
        return self.stance.rows
