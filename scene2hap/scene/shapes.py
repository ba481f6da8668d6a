"""Shapes of objects: boxes, triangle meshes and their dominant surfaces, in metres and in the object's own frame."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import PlainSerializer, PlainValidator

from scene2hap.common import checks
from scene2hap.common.arrays import Floats, floats
from scene2hap.common.calls import clear_construction
from scene2hap.common.json_fields import Real
from scene2hap.errors import SceneError
from scene2hap.scene.geometry import bounds_of, frozen
from scene2hap.scene.pose import Pose
from scene2hap.scene.surface import plate_sizes
from scene2hap.scene.surface.outline import Outline

SurfaceFlag = Literal["open-mesh", "zero-thickness", "box-fallback"]
"""Reasons to review a measured dominant surface.

"open-mesh": the mesh has a boundary. "zero-thickness": such as a floor of two triangles. "box-fallback": the shape has
no rectangle of medians (an L, a curtain), so its bounding box was used.
"""

_JsonArray = (PlainValidator(lambda value: value), PlainSerializer(lambda array: array.tolist()))
if TYPE_CHECKING:
    Vertices = NDArray[np.float64]
    Faces = NDArray[np.int32]
else:
    Vertices = Annotated[Any, *_JsonArray]
    Faces = Annotated[Any, *_JsonArray]


@clear_construction
@dataclass(frozen=True)
class Box:
    """A cuboid centred on its object's pose, with axes along the object's own.

    Raises: SceneError: an edge is not positive and finite.
    """

    size_m: tuple[Real, Real, Real]
    kind: Literal["box"] = "box"

    if TYPE_CHECKING:

        def __init__(self, size_m: Iterable[float], kind: Literal["box"] = "box") -> None: ...

    def __post_init__(self) -> None:
        size = checks.vector("size_m", self.size_m, "m", size=3, above=0.0, error=SceneError)
        object.__setattr__(self, "size_m", size)

    def __repr__(self) -> str:
        return f"Box({self.size_m})"

    @cached_property
    def mesh(self) -> TriMesh:
        """The box as twelve triangles, facing outwards."""
        half = np.asarray(self.size_m) / 2
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        faces = [triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))]
        return TriMesh(corners * half, np.array(faces, dtype=np.int32))


@clear_construction
@dataclass(frozen=True, eq=False, repr=False)
class TriMesh:
    """A triangle mesh in its object's own frame.

    Parameters: vertices_m : (n, 3) float64 [m]; faces : (m, 3) int, indices into the vertices.
    Raises: SceneError: a vertex is not finite, a face points outside the vertices, or there is no face.
    """

    vertices_m: Vertices
    faces: Faces
    kind: Literal["mesh"] = "mesh"

    if TYPE_CHECKING:

        def __init__(self, vertices_m: ArrayLike, faces: ArrayLike, kind: Literal["mesh"] = "mesh") -> None: ...

    def __post_init__(self) -> None:
        vertices = _frozen_array("vertices_m", self.vertices_m, np.float64)
        faces = _frozen_array("faces", self.faces, np.int32)
        if len(faces) == 0:
            raise SceneError("faces is empty; a mesh needs at least one triangle.")
        if not np.isfinite(vertices).all():
            row = int(np.argwhere(~np.isfinite(vertices).all(axis=1))[0, 0])
            raise SceneError(f"vertices_m[{row}] is {vertices[row].tolist()}; every coordinate must be finite [m].")
        low, high = int(faces.min()), int(faces.max())
        if low < 0 or high >= len(vertices):
            raise SceneError(
                f"faces refer to vertex {low if low < 0 else high}; the mesh has {len(vertices)} vertices (from 0)."
            )
        object.__setattr__(self, "vertices_m", vertices)
        object.__setattr__(self, "faces", faces)

    def __repr__(self) -> str:
        return f"TriMesh({len(self.vertices_m)} vertices, {len(self.faces)} faces)"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TriMesh) and self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    @property
    def mesh(self) -> TriMesh:
        """This mesh itself, so that boxes and meshes have the same interface."""
        return self

    @cached_property
    def digest(self) -> str:
        """A hash of the content: equal for equal meshes only."""
        content = hashlib.sha256(self.vertices_m.tobytes())
        content.update(self.faces.tobytes())
        return content.hexdigest()[:16]

    @property
    def corners_m(self) -> Floats:
        """The vertices (n, 3) [m] that faces use."""
        is_used = np.zeros(len(self.vertices_m), dtype=bool)  # a tenth of the time of numpy.unique
        is_used[self.faces] = True
        return self.vertices_m[is_used]

    @cached_property
    def bounds_m(self) -> Floats:
        """Lowest and highest corner (2, 3) [m] in the own frame, of the vertices that faces use. Read-only."""
        return frozen(bounds_of(self.corners_m))

    @cached_property
    def reach_m(self) -> float:
        """The largest absolute coordinate [m], of the vertices that faces use."""
        return float(np.abs(self.bounds_m).max())

    @cached_property
    def volume_m3(self) -> float:
        """The volume [m3] if the mesh is closed and its faces face outwards; else a number of any sign."""
        a, b, c = (self.vertices_m - self.bounds_m.mean(axis=0))[self.faces].transpose(1, 0, 2)
        return float(np.vdot(a, np.cross(b, c))) / 6


Geometry = Box | TriMesh


class MeshLike(Protocol):
    """A mesh of another package, such as trimesh."""

    @property
    def vertices(self) -> ArrayLike:
        """Points (n, 3) [m]."""
        ...

    @property
    def faces(self) -> ArrayLike:
        """Indices into the vertices (m, 3)."""
        ...


def geometry_of(value: object, owner: str) -> Geometry:
    """Return a Box or TriMesh unchanged. A pair of vertices and faces, or an object with both, becomes a TriMesh.

    Raises: SceneError: it is something else; the message names the owner.
    """
    if isinstance(value, Box | TriMesh):
        return value
    if hasattr(value, "vertices") and hasattr(value, "faces"):
        return TriMesh(value.vertices, value.faces)
    if isinstance(value, tuple | list) and len(value) == 2:
        return TriMesh(value[0], value[1])
    how = "is missing" if value is None else f"is {checks.described(value)}"
    are_points = hasattr(value, "vertices") or isinstance(value, np.ndarray)
    raise SceneError(
        f"geometry of {owner} {how}; it must be a Box((x, y, z)) of edges [m], a TriMesh, or (vertices_m, faces)."
        + " Points have no surface; their hull is trimesh.PointCloud(points_m).convex_hull." * are_points
    )


@clear_construction
@dataclass(frozen=True)
class DominantSurface:
    """The plate of an object, such as the top of a table, and its pose in the object's own frame.

    `pose` maps the plate's corner frame to the object's own frame: its origin is a corner of the plate's mid-plane, x
    runs along the length, y along the width, z along the thickness (the plate's normal). `flags` are reasons to review
    a measured surface; a stated surface has none. `outline` is the area of a surface that is no rectangle, from the
    same corner along length and width. It may extend beyond the rectangle. Length and width are then the edges of an
    equivalent rectangle.
    Raises: SceneError: a size is negative, or the thickness is 0 without the flag for it.
    """

    pose: Pose
    length_m: Real
    width_m: Real
    thickness_m: Real
    flags: tuple[SurfaceFlag, ...] = ()
    outline: Outline | None = None
    # Of a surface that was measured with y up, before the scene is known: the geometry, and the upward direction in its
    # frame. It is no dataclass field, so that it is not stored.
    assumed_for: ClassVar[tuple[Geometry, tuple[float, ...]] | None] = None

    def __post_init__(self) -> None:
        if not isinstance(self.pose, Pose):
            raise SceneError(f"pose of the surface is {checks.described(self.pose)}; it must be a Pose.")
        for name in ("length_m", "width_m", "thickness_m"):
            object.__setattr__(
                self, name, checks.number(name, getattr(self, name), "m", at_least=0.0, error=SceneError)
            )
        object.__setattr__(self, "flags", checks.items("flags", self.flags, error=SceneError))
        if self.outline is not None and not isinstance(self.outline, Outline):
            raise SceneError(f"outline of the surface is {checks.described(self.outline)}; it must be an Outline.")
        least_m = plate_sizes.NOTHING * min(self.length_m, self.width_m)
        if "zero-thickness" not in self.flags and self.thickness_m <= least_m:
            raise SceneError(
                f"thickness_m is {self.thickness_m:g} m; it must be above {least_m:g} [m]. State what the real "
                'thing has, leave the surface out to have it measured, or flag it "zero-thickness".'
            )


def _frozen_array(name: str, value: object, dtype: type[np.generic]) -> NDArray[Any]:
    array = np.array(floats(name, value, "m" if dtype is np.float64 else "-", error=SceneError))
    if array.size == 0:
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise SceneError(f"{name} has shape {array.shape}; it must be (n, 3).")
    if dtype is np.int32 and not (np.isfinite(array).all() and (np.abs(array) < 2**31).all()):
        raise SceneError(f"{name} holds values that are not vertex numbers; they must be integers from 0.")
    if dtype is np.int32 and (array != np.rint(array)).any():
        raise SceneError(f"{name} holds {array[array != np.rint(array)][0]:g}; vertex numbers must be integers from 0.")
    return frozen(array.astype(dtype))
