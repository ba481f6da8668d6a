"""A scene as typed, frozen data: what inference reads and what playing starts from.

Metres, right-handed. An object's mesh and its dominant surface are told in the object's own frame; its pose places
that frame in the world. Scale and mirroring are baked into the mesh, so a pose is always rigid.
"""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import InstanceOf, PlainSerializer, PlainValidator

from scene2hap import checks
from scene2hap.calls import clear_construction
from scene2hap.errors import SceneError, UnknownObject
from scene2hap.scene import sizes
from scene2hap.scene.appearance import Appearance
from scene2hap.scene.images import ImageSet, ObjectImages
from scene2hap.scene.pose import Pose

UpAxis = Literal["y", "z"]
"""The axes that a scene may call up: "y" for glTF, "z" for MuJoCo."""

SurfaceFlag = Literal["open-mesh", "zero-thickness", "box-fallback"]
"""Why the measured dominant surface wants a second look: the mesh has a boundary; it has no thickness (a floor of two
triangles); its shape has no rectangle of medians (an L, a curtain), so that the box around it was taken."""

_JsonArray = (PlainValidator(lambda value: value), PlainSerializer(lambda array: array.tolist()))
if TYPE_CHECKING:
    Vertices = NDArray[np.float64]
    Faces = NDArray[np.int32]
else:
    Vertices = Annotated[Any, *_JsonArray]
    Faces = Annotated[Any, *_JsonArray]


@dataclass(frozen=True)
class Box:
    """A cuboid centred on its object's pose, axes along the object's own.

    Raises: SceneError: an edge is not positive and finite.
    """

    size_m: tuple[float, float, float]
    kind: Literal["box"] = "box"

    def __post_init__(self) -> None:
        size = checks.vector("size_m", self.size_m, "m", size=3, above=0.0, error=SceneError)
        object.__setattr__(self, "size_m", size)

    @cached_property
    def mesh(self) -> TriMesh:
        """The box as twelve triangles, facing outwards."""
        half = np.asarray(self.size_m) / 2
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        faces = [triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))]
        return TriMesh(corners * half, np.array(faces, dtype=np.int32))


@dataclass(frozen=True, eq=False, repr=False)
class TriMesh:
    """A triangle mesh in its object's own frame.

    Parameters: vertices_m : (n, 3) float64 [m]; faces : (m, 3) int, indices into the vertices.
    Raises: SceneError: a vertex is not finite, a face points outside the vertices, or there is no face.
    """

    vertices_m: Vertices
    faces: Faces
    kind: Literal["mesh"] = "mesh"

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
        """Itself, so that boxes and meshes are asked alike."""
        return self

    @cached_property
    def digest(self) -> str:
        """A name for the content: equal meshes, and only these, share it."""
        content = hashlib.sha256(self.vertices_m.tobytes())
        content.update(self.faces.tobytes())
        return content.hexdigest()[:16]

    @cached_property
    def bounds_m(self) -> NDArray[np.float64]:
        """Lowest and highest corner (2, 3) [m] of the vertices that faces use, in the own frame."""
        used = self.vertices_m[np.unique(self.faces)]
        return np.array([used.min(axis=0), used.max(axis=0)])


Geometry = Box | TriMesh


@dataclass(frozen=True)
class DominantSurface:
    """The plate of an object, such as the top of a table, and where it lies in the object's own frame.

    `pose` puts the plate's corner frame into the object's own frame: its origin is a corner of the plate's mid-plane,
    x runs along the length, y along the width, z along the thickness (the plate's normal). `flags` tell why a
    measured value wants a second look; an engine or a person who states it leaves them empty.
    Raises: SceneError: a size that is negative, or no thickness without the flag that says so.
    """

    pose: Pose
    length_m: float
    width_m: float
    thickness_m: float
    flags: tuple[SurfaceFlag, ...] = ()

    def __post_init__(self) -> None:
        for name in ("length_m", "width_m", "thickness_m"):
            object.__setattr__(
                self, name, checks.number(name, getattr(self, name), "m", at_least=0.0, error=SceneError)
            )
        object.__setattr__(self, "flags", tuple(self.flags))
        least_m = sizes.NOTHING * min(self.length_m, self.width_m)
        if "zero-thickness" not in self.flags and self.thickness_m <= least_m:
            raise SceneError(
                f"thickness_m is {self.thickness_m:g} m; it must be above {least_m:g} [m]. State what the real "
                'thing has, leave the surface out to have it measured, or flag it "zero-thickness".'
            )


@clear_construction
@dataclass(frozen=True)
class Contact:
    """Where two objects touch: given by an engine, or found from geometry. A pair may have several.

    Parameters: point_m : world [m]; normal : unit, from `a` to `b`; area_m2 of the patch that the point stands for;
    weight : how much of a contact it is, 1 touching to 0 gone [-].
    """

    a: str
    b: str
    point_m: tuple[float, float, float]
    normal: tuple[float, float, float] | None = None
    area_m2: float | None = None
    weight: float = 1.0

    def __post_init__(self) -> None:
        for name in (self.a, self.b):
            if not isinstance(name, str):
                raise SceneError(f"contact of {checks.represented(name)}; give the ids of two objects.")
        if self.a == self.b:
            raise SceneError(f"contact of {self.a!r} with itself; a contact joins two objects.")
        point = checks.vector("point_m", self.point_m, "m", size=3, error=SceneError)
        object.__setattr__(self, "point_m", point)
        if self.normal is not None:
            normal = checks.vector("normal", self.normal, "-", size=3, error=SceneError)
            object.__setattr__(self, "normal", normal)
        if self.area_m2 is not None:
            area = checks.number("area_m2", self.area_m2, "m2", at_least=0.0, error=SceneError)
            object.__setattr__(self, "area_m2", area)
        weight = checks.number("weight", self.weight, "-", at_least=0.0, at_most=1.0, error=SceneError)
        # So little is nothing; its square would be too small for a number.
        object.__setattr__(self, "weight", weight if weight > _LEAST_WEIGHT else 0.0)


@dataclass(frozen=True)
class SceneObject:
    """One thing that a user would point at.

    `id` is unique in the scene and stable over loads; `name` is what the author wrote, which many objects may share.
    `instance_key` is equal for objects of equal mesh and materials. `relative_height_m` is the height of the lowest
    point above the lowest point of the whole scene. `appearance` is for pictures alone, None where unknown; `images`
    are those pictures, once `capture_images` was asked for them.
    """

    id: str
    name: str
    pose: Pose
    geometry: Geometry
    surface: DominantSurface
    relative_height_m: float = 0.0
    instance_key: str = ""
    appearance: InstanceOf[Appearance] | None = field(default=None, compare=False, repr=False)
    images: InstanceOf[ObjectImages] | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        if not isinstance(self.id, str) or not self.id:
            raise SceneError(f"object {checks.represented(self.name)} has an empty id; give every object its own.")
        height = checks.number("relative_height_m", self.relative_height_m, "m", error=SceneError)
        object.__setattr__(self, "relative_height_m", height)

    @property
    def size_m(self) -> tuple[float, float, float]:
        """Length, width and thickness [m] of the dominant surface."""
        return (self.surface.length_m, self.surface.width_m, self.surface.thickness_m)

    def whole_size_m(self, up_axis: UpAxis) -> tuple[float, float, float]:
        """Longer and shorter side and height [m] of the object's box along its own axes.

        Height is along the axis that stands most upright, so that a thing turned about it keeps its size.
        """
        edges = np.ptp(self.geometry.mesh.vertices_m, axis=0)
        upright = int(np.abs(self.pose.rotation[{"y": 1, "z": 2}[up_axis]]).argmax())
        shorter, longer = sorted(float(edge) for edge in np.delete(edges, upright))
        return (longer, shorter, float(edges[upright]))

    @cached_property
    def bounds_m(self) -> NDArray[np.float64]:
        """Lowest and highest corner (2, 3) [m] in the world."""
        points = self.pose.to_world(self.geometry.mesh.vertices_m)
        return np.array([points.min(axis=0), points.max(axis=0)])

    def plate_coordinates(self, points_m: ArrayLike) -> NDArray[np.float64]:
        """World points (n, 3) [m] as (n, 2) [m] along length and width of the dominant surface, from its corner.

        Points beside the plate are taken to its nearest edge.
        """
        points = np.atleast_2d(checks.floats("points_m", points_m, "m", error=SceneError))
        if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
            raise SceneError(f"points_m has shape {points.shape}; it must be (n, 3) finite numbers [m].")
        flat = self.surface.pose.to_own(self.pose.to_own(points))[:, :2]
        return np.clip(flat, 0.0, [self.surface.length_m, self.surface.width_m])


@dataclass(frozen=True)
class SceneSnapshot:
    """All that is read out of a scene at one moment.

    `contacts` is None where the source of the scene does not tell them; they are then found from geometry. `images` are
    of the whole scene, None until `capture_images`.
    Raises: SceneError: no object, or two objects with one id, or a contact with an object that is not there.
    """

    name: str
    up_axis: UpAxis
    objects: tuple[SceneObject, ...]
    contacts: tuple[Contact, ...] | None = None
    images: InstanceOf[ImageSet] | None = field(default=None, compare=False, repr=False)
    _by_id: Mapping[str, SceneObject] = field(init=False, repr=False, compare=False, default_factory=dict)

    def __post_init__(self) -> None:
        if not isinstance(self.up_axis, str) or self.up_axis not in ("y", "z"):
            raise SceneError(f"up_axis is {checks.represented(self.up_axis)}; it must be 'y' or 'z'.")
        object.__setattr__(self, "objects", tuple(self.objects))
        if not self.objects:
            raise SceneError(f"scene {self.name!r} has no object with a surface; nothing in it can be touched.")
        by_id = {item.id: item for item in self.objects}
        if len(by_id) < len(self.objects):
            twice = [key for key, n in Counter(item.id for item in self.objects).items() if n > 1]
            raise SceneError(f"object id {twice[0]!r} is used more than once; ids must be unique (names need not be).")
        object.__setattr__(self, "_by_id", by_id)
        if self.contacts is not None:
            object.__setattr__(self, "contacts", tuple(self.contacts))
            for contact in self.contacts:
                self.object(contact.a)
                self.object(contact.b)

    def object(self, object_id: str) -> SceneObject:
        """The object with that id.

        Raises: UnknownObject: there is none; the message names the nearest ids.
        """
        if not isinstance(object_id, str) or object_id not in self._by_id:
            raise UnknownObject(unknown_object(object_id, self._by_id))
        return self._by_id[object_id]

    def with_poses(self, moved: Mapping[str, Pose]) -> SceneSnapshot:
        """The same scene with some objects elsewhere; heights are told anew, given contacts and images are dropped."""
        for object_id in moved:
            self.object(object_id)
        objects = [replace(item, pose=moved.get(item.id, item.pose), images=None) for item in self.objects]
        return SceneSnapshot(self.name, self.up_axis, with_relative_heights(objects, self.up_axis))

    def to_json(self) -> str:
        """The whole scene as JSON; `from_json` gives it back exactly."""
        from scene2hap.scene.json import dump

        return dump(self)

    @classmethod
    def from_json(cls, text: str) -> SceneSnapshot:
        """A scene from JSON.

        Raises: SceneError: the text is not JSON or not a scene; the message names the field.
        """
        from scene2hap.scene.json import parse

        return parse(text)


_LEAST_WEIGHT = 1e-30


def unknown_object(object_id: object, known: Mapping[str, object]) -> str:
    """The sentence for an id that a scene does not have."""
    if not isinstance(object_id, str):
        how = ": give its .id" if isinstance(object_id, SceneObject) else ", of one object"
        some = next(iter(known), "")
        return f"an object's id is {checks.described(object_id)}; it must be a text{how}, such as {some!r}."
    hint = checks.did_you_mean(object_id, known, f"`inspect` lists the {len(known)} objects.")
    return f"the scene has no object {checks.represented(object_id)}. {hint}"


def with_relative_heights(objects: list[SceneObject], up_axis: UpAxis) -> tuple[SceneObject, ...]:
    """The objects with `relative_height_m` measured against the lowest of them."""
    up = {"y": 1, "z": 2}[up_axis]
    bottoms = [float(item.bounds_m[0, up]) for item in objects]
    ground = min(bottoms, default=0.0)
    return tuple(
        replace(item, relative_height_m=bottom - ground) for item, bottom in zip(objects, bottoms, strict=True)
    )


def _frozen_array(name: str, value: object, dtype: type[np.generic]) -> NDArray[Any]:
    array = np.array(checks.floats(name, value, "m" if dtype is np.float64 else "-", error=SceneError))
    if array.size == 0:
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise SceneError(f"{name} has shape {array.shape}; it must be (n, 3).")
    if dtype is np.int32 and not (np.isfinite(array).all() and (np.abs(array) < 2**31).all()):
        raise SceneError(f"{name} holds values that are not vertex numbers; they must be integers from 0.")
    frozen = array.astype(dtype)
    frozen.flags.writeable = False
    return frozen
