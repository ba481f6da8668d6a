"""What the contact graph keeps of an object: triangles with their boxes, once per mesh, and a place."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from weakref import WeakValueDictionary

import numpy as np

from scene2hap.contact.broad import Boxes, Floats
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneObject, TriMesh


@dataclass(frozen=True, eq=False)
class Shape:
    """The triangles (m, 3, 3) [m] of a mesh in its own frame, their boxes, and the corners in use (n, 3)."""

    triangles: Floats
    boxes: Boxes
    corners: Floats

    @cached_property
    def box(self) -> Boxes:
        """The bounding box (1, 3) of all."""
        return self.boxes.hull()

    @cached_property
    def size_m(self) -> float:
        """Diagonal of the own bounding box, which no motion changes."""
        return float(np.linalg.norm(self.box.high - self.box.low))

    @cached_property
    def normals(self) -> Floats:
        """Unit normals (m, 3) of the triangles, 0 for those without area."""
        a, b, c = self.triangles[:, 0], self.triangles[:, 1], self.triangles[:, 2]
        normals = np.cross(b - a, c - a)
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        unit: Floats = normals / np.where(lengths > 0, lengths, 1.0)
        return unit


# Instances share a mesh, and sessions come and go over one scene: a shape lives as long as some body uses it.
_shapes: WeakValueDictionary[str, Shape] = WeakValueDictionary()


def shape_of(mesh: TriMesh) -> Shape:
    """The shape of a mesh, made once for equal meshes."""
    shape = _shapes.get(mesh.digest)
    if shape is None:
        triangles = mesh.vertices_m[mesh.faces]
        corners = mesh.vertices_m[np.unique(mesh.faces)]
        shape = Shape(triangles, boxes_of(triangles), corners)
        _shapes[mesh.digest] = shape
    return shape


@dataclass(frozen=True, eq=False)
class Body:
    """A shape at a place; a thing that moves gets a new body."""

    id: str
    shape: Shape
    pose: Pose
    up_axis: int

    @classmethod
    def of(cls, item: SceneObject, up_axis: int) -> Body:
        """The body of an object in a scene whose axis `up_axis` (0, 1, 2) points up."""
        return cls(item.id, shape_of(item.geometry.mesh), item.pose, up_axis)

    @cached_property
    def box(self) -> Boxes:
        """The bounding box (1, 3) in the world."""
        points = self.pose.to_world(self.shape.corners)
        return Boxes(points.min(axis=0, keepdims=True), points.max(axis=0, keepdims=True))

    @property
    def size_m(self) -> float:
        """Diagonal of the own bounding box."""
        return self.shape.size_m

    @property
    def lowest_m(self) -> float:
        """Height of the lowest point."""
        return float(self.box.low[0, self.up_axis])

    @property
    def highest_m(self) -> float:
        """Height of the highest point."""
        return float(self.box.high[0, self.up_axis])

    @property
    def up(self) -> Floats:
        """The world's upward axis (3,) in the own frame."""
        up: Floats = self.pose.rotation[self.up_axis]
        return up

    @cached_property
    def lows_m(self) -> Floats:
        """Height of the lowest corner of each triangle (m,)."""
        a, b, c = (self.shape.triangles @ self.up + self.pose.position_m[self.up_axis]).T
        lows: Floats = np.minimum(np.minimum(a, b), c)
        return lows

    @cached_property
    def slopes(self) -> Floats:
        """How flat each triangle (m,) lies: 1 level, 0 upright or without area."""
        slopes: Floats = np.abs(self.shape.normals @ self.up)
        return slopes


def boxes_of(triangles: Floats) -> Boxes:
    """The bounding box of each triangle (m, 3, 3)."""
    # numpy reduces short axes slowly.
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return Boxes(np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c))
