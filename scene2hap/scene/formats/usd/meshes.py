"""Gprims of USD as triangles: meshes as their control cages, and the implicit shapes.

A subdivision surface is read as its control mesh, which is a little outside the surface. Points, curves and NURBS are
left out.

Source: OpenUSD 26.11, schemas Mesh, GeomSubset, Cube, Sphere, Cylinder, Cylinder_1, Cone, Capsule, Capsule_1,
Plane.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from pxr import UsdGeom

from scene2hap.common.arrays import Floats, Ints
from scene2hap.errors import SceneFormatError
from scene2hap.scene import limits, solids
from scene2hap.scene.formats.polygons import triangulated
from scene2hap.scene.formats.usd.values import integers, positive, value, vectors

# Order of the coordinates of a shape about z, for each axis that the shape may have.
_TURNED = {"X": [2, 0, 1], "Y": [1, 2, 0], "Z": [0, 1, 2]}


@dataclass(frozen=True, eq=False)
class Triangles:
    """The triangles of one gprim.

    `points` (n, 3) float64 in the stage's unit; `vertices` (m, 3) int64, indices of `points`; `corners` (m, 3) int64,
    indices of the prim's list of corners; `face_of` (m,) int64, the authored face of each; `is_made` : True if the file
    holds only a few numbers, such as a radius; `n_faces` : number of authored faces.
    """

    points: Floats
    vertices: Ints
    corners: Ints
    face_of: Ints
    is_made: bool
    n_faces: int

    def at_corners(self, values: Floats, interpolation: str) -> Floats | None:
        """Return values (k, columns) of a primvar at each corner (m, 3, columns); None if there are too few values."""
        m = len(self.vertices)
        if interpolation == "constant" and len(values):
            return np.broadcast_to(values[0], (m, 3, values.shape[1]))
        if self.is_made and interpolation != "constant":
            return None
        if interpolation == "uniform" and len(values) >= self.n_faces:
            return np.repeat(values[self.face_of][:, None], 3, axis=1)
        if interpolation in ("vertex", "varying") and len(values) >= len(self.points):
            return values[self.vertices]
        if interpolation == "faceVarying" and len(values) > self.corners.max(initial=-1):
            return values[self.corners]
        return None


def mesh_triangles(mesh: Any, place: str, numbers: limits.Budget) -> Triangles:
    """Return the triangles of a `UsdGeom.Mesh`, counter-clockwise seen from outside; holes are left out.

    Raises: SceneFormatError: the lists of faces do not fit each other. SceneError: too many numbers are read.
    """
    counts, indices = integers(mesh.GetFaceVertexCountsAttr()), integers(mesh.GetFaceVertexIndicesAttr())
    numbers.spend(len(counts) + len(indices), place)
    points = vectors(mesh.GetPointsAttr())
    numbers.spend(points.size, place)
    if counts.min(initial=0) < 0 or counts.sum() != len(indices):
        raise SceneFormatError(
            f"{place}: faceVertexCounts come to {int(counts.sum())}, and there are {len(indices)} faceVertexIndices."
        )
    if indices.min(initial=0) < 0 or indices.max(initial=-1) >= len(points):
        wrong = int(indices.min() if indices.min() < 0 else indices.max())
        raise SceneFormatError(f"{place}: a face uses point {wrong}; there are {len(points)} (from 0).")
    limits.at_most(f"the number of triangles of {place}", int(np.maximum(counts - 2, 0).sum()), "MAX_TRIANGLES")
    corners, face_of = triangulated(points, counts, indices)
    holes = integers(mesh.GetHoleIndicesAttr())
    if len(holes):
        is_kept = ~np.isin(face_of, holes)
        corners, face_of = corners[is_kept], face_of[is_kept]
    if value(mesh.GetOrientationAttr()) == "leftHanded":
        corners = corners[:, ::-1]
    return Triangles(points, indices[corners], corners, face_of, False, len(counts))


def subsets(mesh: Any, found: Triangles) -> list[tuple[Any | None, Ints]]:
    """Return the triangles of each material: (subset prim, indices of `found`). The prim is None for the rest.

    A face of several subsets belongs to the first.
    """
    family = UsdGeom.Subset.GetGeomSubsets(mesh, UsdGeom.Tokens.face, "materialBind")
    owner = np.full(found.n_faces, -1, np.int64)
    for number, subset in reversed(list(enumerate(family))):
        faces = integers(subset.GetIndicesAttr())
        owner[faces[(faces >= 0) & (faces < found.n_faces)]] = number
    of_triangle = owner[found.face_of]
    parts = [(None, np.flatnonzero(of_triangle == -1))]
    parts += [(subset.GetPrim(), np.flatnonzero(of_triangle == number)) for number, subset in enumerate(family)]
    return [(prim, rows) for prim, rows in parts if len(rows)]


def shape_triangles(prim: Any) -> Triangles | None:
    """Return the triangles of an implicit shape; None if the prim is no shape that is read, or has no size."""
    kind = str(prim.GetTypeName())
    if kind not in _SHAPES:
        return None
    numbers = tuple(positive(prim.GetAttribute(name)) for name in _SHAPES[kind][0])
    if None in numbers:
        return None
    return _shape(kind, str(value(prim.GetAttribute("axis")) or "Z"), numbers)


# Scenes made of primitives have thousands of equal shapes.
@lru_cache(maxsize=64)
def _shape(kind: str, axis: str, numbers: tuple[float, ...]) -> Triangles:
    if kind == "Plane" and axis in ("X", "Y"):
        # Width is along x, or along z if the plane faces x; length is along y, or along z if it faces y.
        numbers = numbers[::-1]
    points, faces = _SHAPES[kind][1](*(number / 2 for number in numbers))
    vertices = faces.astype(np.int64)
    n = len(vertices)
    corners = np.arange(vertices.size).reshape(-1, 3)
    return Triangles(points[:, _TURNED.get(axis, [0, 1, 2])], vertices, corners, np.arange(n), True, n)


_SHAPES: dict[str, tuple[tuple[str, ...], Callable[..., solids.Triangles]]] = {
    "Cube": (("size",), lambda half: solids.box([half] * 3)),
    "Sphere": (("radius",), lambda half_radius: solids.ellipsoid([2 * half_radius] * 3)),
    "Cylinder": (("radius", "height"), lambda half_radius, half: solids.cylinder(2 * half_radius, half)),
    "Capsule": (("radius", "height"), lambda half_radius, half: solids.capsule(2 * half_radius, half)),
    # Later versions of two schemas, which have a radius for each end.
    "Cylinder_1": (
        ("radiusBottom", "height", "radiusTop"),
        lambda half_low, half, half_high: solids.cylinder(2 * half_low, half, 2 * half_high),
    ),
    "Capsule_1": (
        ("radiusBottom", "height", "radiusTop"),
        lambda half_low, half, half_high: solids.capsule(2 * half_low, half, 2 * half_high),
    ),
    "Cone": (("radius", "height"), lambda half_radius, half: solids.cone(2 * half_radius, half)),
    "Plane": (("width", "length"), solids.rectangle),
}
"""Attributes of each shape, and the function that makes its triangles from half of each value."""
