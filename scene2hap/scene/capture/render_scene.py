"""A scene prepared for renderers: triangles in one frame, colours in one table, and digests of the content."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scene2hap.common.arrays import Floats, Floats32, Ints32
from scene2hap.errors import SceneError
from scene2hap.scene.capture.colour_table import Palette, PaletteBuilder, neutral
from scene2hap.scene.capture.views import axes_of
from scene2hap.scene.geometry import bounds_of, joined, vector
from scene2hap.scene.looks.appearance import Appearance
from scene2hap.scene.objects import SceneObject, UpAxis
from scene2hap.scene.snapshot import SceneSnapshot

# Distance by which faces of objects are moved inwards, as a share of the scene's diagonal: 0.03 mm in a room of 10 m.
# It is far below a pixel, and larger than the errors of float32 and of a ray's step.
_INSET = 3e-6


@dataclass(frozen=True, eq=False)
class RenderObject:
    """One object: triangles (m, 3, 3) [m] relative to the `RenderScene` origin, rows of the palette (m,), uv (m, 3, 2).

    `digest` covers its rotated shape and its looks, but not its position.
    """

    id: str
    triangles_m: Floats32
    material: Ints32
    uv: Floats32
    digest: str

    @cached_property
    def box_m(self) -> Floats:
        """Lowest and highest corner (2, 3) [m]."""
        return bounds_of(self.triangles_m.reshape(-1, 3))

    @cached_property
    def points_m(self) -> Floats:
        """All corners (n, 3) [m], each once."""
        # Rows as plain bytes, which numpy sorts three times faster.
        corners = np.ascontiguousarray(self.triangles_m).reshape(-1, 3)
        each_once = np.unique(corners.view(np.dtype((np.void, corners.strides[0]))))
        return each_once.view(corners.dtype).reshape(-1, 3).astype(np.float64)

    @property
    def diagonal_m(self) -> float:
        """Diagonal of the object's box [m]."""
        return float(np.linalg.norm(np.ptp(self.box_m, axis=0)))


@dataclass(frozen=True, eq=False)
class RenderScene:
    """All objects of a scene, in scene order, as plain arrays that can be sent to worker processes.

    Coordinates are relative to the middle of the scene. Renderers use float32, which would lose precision in scenes far
    from the world's origin.
    """

    objects: tuple[RenderObject, ...]
    palette: Palette
    up_axis: UpAxis
    origin_m: tuple[float, float, float]

    @classmethod
    def of(cls, scene: SceneSnapshot) -> RenderScene:
        """Prepare a scene."""
        low, high = joined([item.bounds_m for item in scene.objects])
        origin = (low + high) / 2
        palette = PaletteBuilder()
        inset_m = _INSET * float(np.linalg.norm(high - low))
        objects = tuple(_render_object(item, origin, inset_m, palette) for item in scene.objects)
        return cls(objects, palette.build(), scene.up_axis, vector(origin))

    @cached_property
    def index(self) -> dict[str, int]:
        """Number of each object by its id."""
        return {item.id: number for number, item in enumerate(self.objects)}

    @cached_property
    def everyone(self) -> frozenset[int]:
        """The numbers of all objects."""
        return frozenset(range(len(self.objects)))

    @cached_property
    def boxes_m(self) -> Floats:
        """Lowest and highest corner (n, 2, 3) [m] of each object."""
        return np.array([item.box_m for item in self.objects])

    @cached_property
    def box_m(self) -> Floats:
        """Lowest and highest corner (2, 3) [m] of all objects."""
        return joined(self.boxes_m)

    @property
    def diagonal_m(self) -> float:
        """Diagonal of the scene's box [m]."""
        return float(np.linalg.norm(np.ptp(self.box_m, axis=0)))

    @property
    def up(self) -> Floats:
        """The unit vector (3,) that points up."""
        up: Floats = axes_of(self.up_axis)[1]
        return up

    @cached_property
    def digest(self) -> str:
        """A digest of everything that a picture of the whole scene can show."""
        parts: list[object] = [self.up_axis]
        for item in self.objects:
            parts += (item.digest, item.box_m.tobytes())
        return _named(parts)


def _render_object(item: SceneObject, origin: Floats, inset_m: float, palette: PaletteBuilder) -> RenderObject:
    mesh = item.geometry.mesh
    corners = _drawn_in(item.pose.to_world(mesh.vertices_m) - origin, item.bounds_m - origin, inset_m)
    looks = item.appearance
    if looks is None:
        looks = Appearance.plain(neutral(item.instance_key or item.id), len(mesh.faces))
    if len(looks.face_material) != len(mesh.faces):
        raise SceneError(
            f"the appearance of {item.id!r} has {len(looks.face_material)} faces, its mesh has {len(mesh.faces)}; "
            "give one material number per face."
        )
    rows = np.array([palette.add(material) for material in looks.materials], np.int32)
    material = rows[looks.face_material]
    uv = np.zeros((len(mesh.faces), 3, 2), np.float32) if looks.uv is None else np.asarray(looks.uv, np.float32)
    paints, which = np.unique(material, return_inverse=True)
    named = [palette.keys[row] for row in paints]
    digest = _named([mesh.digest, item.pose.rotation_xyzw, named, which.astype(np.int32).tobytes(), uv.tobytes()])
    return RenderObject(item.id, corners[mesh.faces], material, uv, digest)


def _drawn_in(corners_m: Floats, box_m: Floats, inset_m: float) -> Floats32:
    """Scale corners (n, 3) about their box's middle, so that its faces move in by the inset, at most a tenth of its
    size.

    Otherwise faces of touching objects would be in one plane, and the first hit of a ray would depend on rounding. A
    room in one piece, whose box contains the scene's middle, is not scaled: its walls would move towards its contents.
    """
    low, high = box_m
    if (low < 0).all() and (high > 0).all():
        return corners_m.astype(np.float32)
    middle, size = (low + high) / 2, high - low
    factor = 1 - 2 * np.minimum(np.divide(inset_m, size, out=np.zeros(3), where=size > 0), 0.1)
    drawn_in: Floats32 = (middle + (corners_m - middle) * factor).astype(np.float32)
    return drawn_in


def _named(parts: Iterable[object]) -> str:
    content = hashlib.sha256()
    for part in parts:
        content.update(part if isinstance(part, bytes) else repr(part).encode())
        content.update(b"\0")
    return content.hexdigest()[:32]
