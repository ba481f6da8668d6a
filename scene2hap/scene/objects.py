"""Objects of a scene and their contacts: frozen data in metres, right-handed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike
from pydantic import InstanceOf

from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.common.calls import clear_construction
from scene2hap.common.counted import first_of
from scene2hap.common.json_fields import Real
from scene2hap.common.printable import writable
from scene2hap.errors import SceneError
from scene2hap.scene import limits
from scene2hap.scene.geometry import bounds_of, frozen
from scene2hap.scene.images import ObjectImages
from scene2hap.scene.looks.appearance import Appearance
from scene2hap.scene.pose import LEAST_LENGTH, UNIT_TOLERANCE, Pose, how_to_write
from scene2hap.scene.shapes import DominantSurface, Geometry, MeshLike, geometry_of

UpAxis = Literal["y", "z"]
"""The up axis of a scene: "y" as in glTF, "z" as in MuJoCo."""
VERTICAL: Mapping[UpAxis, int] = {"y": 1, "z": 2}
"""Index of the vertical coordinate for each up axis."""

_LEAST_WEIGHT = 1e-30
_MOST_NAMED = 10
_AT_ORIGIN = Pose()


@clear_construction
@dataclass(frozen=True)
class Contact:
    """A contact point of two objects, given by an engine or found from geometry. A pair may have several.

    Parameters: point_m : world [m]; normal : unit, from `a` to `b`; another length is normalised, and 0 gives None;
        area_m2 : of the patch that the point represents [m2]; weight : from 1 (touching) to 0 (gone) [-].
    """

    a: str
    b: str
    point_m: tuple[Real, Real, Real]
    normal: tuple[Real, Real, Real] | None = None
    area_m2: Real | None = None
    weight: Real = 1.0

    if TYPE_CHECKING:

        def __init__(
            self,
            a: str,
            b: str,
            point_m: Iterable[float],
            normal: Iterable[float] | None = None,
            area_m2: float | None = None,
            weight: float = 1.0,
        ) -> None: ...

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
            length = math.hypot(*normal)
            if abs(length - 1.0) > UNIT_TOLERANCE:
                normal = tuple(part / length for part in normal) if LEAST_LENGTH <= length < math.inf else ()
            object.__setattr__(self, "normal", normal or None)
        if self.area_m2 is not None:
            area = checks.number("area_m2", self.area_m2, "m2", at_least=0.0, error=SceneError)
            object.__setattr__(self, "area_m2", area)
        weight = checks.number("weight", self.weight, "-", at_least=0.0, at_most=1.0, error=SceneError)
        # A weight this small counts as none; its square would underflow.
        object.__setattr__(self, "weight", weight if weight > _LEAST_WEIGHT else 0.0)


@clear_construction
@dataclass(frozen=True)
class Hinge:
    """A pivot that holds an object on another: a door on its cabinet, a link of a robot on the link before it.

    The two objects are in contact at the pivot, and nowhere else, as long as its two points and their boxes are less
    than 1 cm apart.

    Parameters: to : id of the other object; point_m : the pivot in the object's own frame [m]; other_point_m : the same
        in the other's frame [m].
    Raises: SceneError: `to` is no id, or a point is not three finite numbers.
    """

    to: str
    point_m: tuple[Real, Real, Real]
    other_point_m: tuple[Real, Real, Real]

    if TYPE_CHECKING:

        def __init__(self, to: str, point_m: Iterable[float], other_point_m: Iterable[float]) -> None: ...

    def __post_init__(self) -> None:
        if not isinstance(self.to, str) or not self.to:
            raise SceneError(f"a hinge is to {checks.represented(self.to)}; give the id of the other object.")
        for name in ("point_m", "other_point_m"):
            point = checks.vector(name, getattr(self, name), "m", size=3, error=SceneError)
            object.__setattr__(self, name, point)


@clear_construction
@dataclass(frozen=True, init=False)
class SceneObject:
    """One object that a user would point at.

    `id` is unique in the scene and stable over loads. `name` is the author's name, which many objects may share; by
    default it is the id. `geometry` is a Box or a TriMesh. A pair of vertices and faces, or an object with both, such
    as a mesh of the package trimesh, becomes a TriMesh. `surface` is measured with y up if it is not given; a
    `SceneSnapshot` measures it for its own up axis. `instance_key` is equal for objects of equal mesh and
    materials. `relative_height_m` is the height of the lowest point above the lowest point of the whole scene.
    `mass_kg` is the mass from an engine or an author [kg], None if unknown. `hinge` holds the object on another, None
    if it is loose or its contacts are to be found from geometry alone. `material_names` are the authored names of
    its materials, that of the largest area first; without them, the names in `appearance` count. `appearance` is used
    for these names and for pictures, None if unknown; `images` are the pictures from `capture_images`.
    """

    id: str
    name: str
    pose: Pose
    geometry: Geometry
    surface: DominantSurface
    relative_height_m: Real = 0.0
    instance_key: str = ""
    mass_kg: Real | None = None
    hinge: Hinge | None = None
    # Not compared: it may come from the looks, which are not part of a scene's equality.
    material_names: tuple[str, ...] = field(default=(), compare=False, repr=False)
    appearance: InstanceOf[Appearance] | None = field(default=None, compare=False, repr=False)
    images: InstanceOf[ObjectImages] | None = field(default=None, compare=False, repr=False)
    _CALL_HINT = "As in SceneObject('cup', pose=Pose((x, y, z)), geometry=Box((x, y, z)))."

    def __init__(
        self,
        id: str,  # the field's name
        name: str | None = None,
        pose: Pose = _AT_ORIGIN,
        geometry: Geometry | Sequence[ArrayLike] | MeshLike | None = None,
        surface: DominantSurface | None = None,
        relative_height_m: float = 0.0,
        instance_key: str = "",
        mass_kg: float | None = None,
        appearance: Appearance | None = None,
        images: ObjectImages | None = None,
        material_names: Sequence[str] = (),
        hinge: Hinge | None = None,
    ) -> None:
        given = {"id": id, "name": id if name is None else name, "pose": pose, "surface": surface}
        given |= {"relative_height_m": relative_height_m, "instance_key": instance_key, "mass_kg": mass_kg}
        given |= {"appearance": appearance, "images": images, "material_names": material_names, "hinge": hinge}
        for key, value in given.items():
            object.__setattr__(self, key, value)
        if not isinstance(id, str):
            raise SceneError(f"id is {checks.represented(id)}; it must be a text, and every object has its own.")
        for key, kind, wanted in (
            ("name", str, "a text"),
            ("pose", Pose, f"a Pose: {how_to_write(pose)}"),
            ("surface", DominantSurface | None, "a DominantSurface"),
        ):
            if not isinstance(given[key], kind):
                raise SceneError(
                    f"{key} of object {checks.represented(id)} is {checks.described(given[key])}; it must be {wanted}. "
                    "Give what follows the id by name: SceneObject(id, pose=..., geometry=...)."
                )
        object.__setattr__(self, "geometry", geometry_of(geometry, f"object {checks.represented(id)}"))
        self.__post_init__()
        # `replace(item, geometry=...)` passes the surface of the former geometry.
        if surface is None or (surface.assumed_for is not None and surface.assumed_for[0] != self.geometry):
            object.__setattr__(self, "surface", _measured(self.geometry, _up_of(pose, "y"), is_assumed=True))

    def __post_init__(self) -> None:
        if not self.id:
            raise SceneError(f"object {checks.represented(self.name)} has an empty id; give every object its own.")
        if writable(self.id) != self.id:  # the file of a bundle would have another id, and could not be read again
            raise SceneError(
                f"id is {checks.represented(self.id)}, with half of a character, as file names of another encoding "
                f"have it; files hold none. Give another id, as {checks.represented(writable(self.id))}."
            )
        # Squares and cubes of larger coordinates lose their digits, or exceed the largest number.
        _require_bounded(self.id, self.geometry.mesh.reach_m)
        height = checks.number("relative_height_m", self.relative_height_m, "m", error=SceneError)
        object.__setattr__(self, "relative_height_m", height)
        materials = checks.texts(f"material_names of object {self.id!r}", self.material_names, error=SceneError)
        object.__setattr__(self, "material_names", materials)
        if self.hinge is not None and (not isinstance(self.hinge, Hinge) or self.hinge.to == self.id):
            given = "to itself" if isinstance(self.hinge, Hinge) else checks.described(self.hinge)
            raise SceneError(
                f"hinge of object {checks.represented(self.id)} is {given}; it must be a Hinge(to, point_m, "
                "other_point_m) to another object."
            )
        if self.mass_kg is not None:
            named = f"mass_kg of object {checks.represented(self.id)}"
            mass = checks.number(named, self.mass_kg, "kg", above=0.0, at_most=limits.MAX_MASS_KG, error=SceneError)
            object.__setattr__(self, "mass_kg", mass)

    def __repr__(self) -> str:
        """The object as it is written in code; measured and inferred fields are left out."""
        shown: dict[str, object] = {} if self.name == self.id else {"name": self.name}
        shown |= {"pose": self.pose, "geometry": self.geometry}
        shown |= {key: value for key in ("mass_kg", "hinge") if (value := getattr(self, key)) is not None}
        return f"SceneObject({', '.join([repr(self.id), *(f'{key}={value!r}' for key, value in shown.items())])})"

    @property
    def size_m(self) -> tuple[float, float, float]:
        """Length, width and thickness [m] of the dominant surface."""
        return (self.surface.length_m, self.surface.width_m, self.surface.thickness_m)

    def whole_size_m(self, up_axis: UpAxis) -> tuple[float, float, float]:
        """Return longer and shorter side and height [m] of the object's box along the axes of its dominant surface.

        Height is along the axis nearest to the vertical. So the size does not change with rotation about the vertical,
        of the pose or of the vertices: many files store furniture turned, in world coordinates.
        """
        edges = np.ptp(self.surface.pose.to_own(self.geometry.mesh.corners_m), axis=0)
        lift = self.pose.rotation[VERTICAL[up_axis]] @ self.surface.pose.rotation
        upright = int(np.abs(lift).argmax())
        shorter, longer = sorted(float(edge) for edge in np.delete(edges, upright))
        return (longer, shorter, float(edges[upright]))

    @cached_property
    def bounds_m(self) -> Floats:
        """Lowest and highest corner (2, 3) [m] in the world. Read-only."""
        return frozen(bounds_of(self.pose.to_world(self.geometry.mesh.corners_m)))

    def hinged_on(self, other: SceneObject, point_m: Iterable[float]) -> SceneObject:
        """Return the object with a hinge to another, at a world point [m] of their present poses.

        Raises: SceneError: the other is no SceneObject or has the same id, or the point is not three finite numbers.
        """
        if not isinstance(other, SceneObject):
            raise SceneError(
                f"other is {checks.described(other)}; it must be the SceneObject that holds {self.id!r}, as in "
                "door.hinged_on(wall, point_m): a hinge needs its pose."
            )
        at = [checks.vector("point_m", point_m, "m", size=3, error=SceneError)]
        own, theirs = (tuple(pose.to_own(at)[0].tolist()) for pose in (self.pose, other.pose))
        return replace(self, hinge=Hinge(other.id, own, theirs))


def require_placed(item: SceneObject) -> None:
    """Bound an object's position as in scene files. A session does not: a game may park an object far away.

    Raises: SceneError.
    """
    _require_bounded(item.id, max(map(abs, item.pose.position_m)))


def _require_bounded(object_id: str, most_m: float) -> None:
    if most_m > limits.MAX_COORDINATE_M:
        raise SceneError(
            f"object {checks.represented(object_id)} is placed or scaled beyond {limits.MAX_COORDINATE_M:g} m, at "
            f"{most_m:g} m; check its pose and its geometry."
        )


def with_known_up(item: SceneObject, up_axis: UpAxis) -> SceneObject:
    """Return an object of a scene with this up axis. A surface that was measured before the axis was known is measured
    again where axis or pose differ."""
    assumed_for = item.surface.assumed_for
    if assumed_for is None:
        return item
    now = (item.geometry, _up_of(item.pose, up_axis))
    return replace(item, surface=replace(item.surface) if assumed_for == now else _measured(*now))


def _up_of(pose: Pose, up_axis: UpAxis) -> tuple[float, ...]:
    return tuple(pose.rotation[VERTICAL[up_axis]].round(6).tolist())


@lru_cache(maxsize=512)  # two for a mesh
def _measured(geometry: Geometry, up: tuple[float, ...], *, is_assumed: bool = False) -> DominantSurface:
    if is_assumed:
        surface = replace(_measured(geometry, up))  # that one may be of a scene whose up axis is known
        object.__setattr__(surface, "assumed_for", (geometry, up))
        return surface
    from scene2hap.scene.surface.dominant_surface import (
        dominant_surface,  # given or stored surfaces need no measurement
    )

    return dominant_surface(geometry.mesh, up=up)


@dataclass(frozen=True)
class SceneData:
    """The plain data of a scene, as in its JSON; see `SceneSnapshot`."""

    name: str
    up_axis: UpAxis
    objects: tuple[SceneObject, ...]
    contacts: tuple[Contact, ...] | None = None


def unknown_object(object_id: object, known: Mapping[str, object]) -> str:
    """Return the sentence for an id that a scene does not have."""
    if not isinstance(object_id, str):
        how = ": give its .id" if isinstance(object_id, SceneObject) else ", of one object"
        some = next(iter(known), "")
        return f"an object's id is {checks.described(object_id)}; it must be a text{how}, such as {some!r}."
    hint = checks.did_you_mean(object_id, known, f"There are {first_of([*map(repr, known)], _MOST_NAMED) or 'none'}.")
    return f"the scene has no object {checks.represented(object_id)}. {hint}"


def with_relative_heights(objects: Sequence[SceneObject], up_axis: UpAxis) -> tuple[SceneObject, ...]:
    """Return the objects with `relative_height_m` measured from the lowest of them."""
    up = VERTICAL[up_axis]
    bottoms = [float(item.bounds_m[0, up]) for item in objects]
    ground = min(bottoms, default=0.0)
    heights = [bottom - ground for bottom in bottoms]
    return tuple(
        item if item.relative_height_m == height else replace(item, relative_height_m=height)
        for item, height in zip(objects, heights, strict=True)
    )
