"""Looks of an object: materials and textures of its faces. Only pictures use them.

Looks are not part of a scene's JSON or of its equality: a snapshot that lost its looks is still the same scene.

Source: IEC 61966-2-1:1999, the sRGB transfer function.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common.arrays import Bytes, Floats, Floats32, Indices, Ints32
from scene2hap.errors import SceneError
from scene2hap.scene.looks.textures import EncodedTexture

Rgba = tuple[float, float, float, float]

# Steps of a channel. They are tried in turn until at most this many materials are left (assumed: a picture seldom shows
# more). After the last step there may be more.
_STEPS, _FEW = (255, 31, 15, 7), 256


class FaceMaterial:
    """Colour and texture of some faces.

    `color_rgba` : sRGB and opacity, 0..1 [-], multiplied with the texture.
    `texture` : (height, width, 3 or 4) uint8 sRGB, or None. An `EncodedTexture` is decoded at the first access.
    `name` : the author's name, "" if unknown; `digest` ignores it.
    """

    def __init__(
        self,
        color_rgba: Rgba = (0.8, 0.8, 0.8, 1.0),
        texture: Bytes | EncodedTexture | None = None,
        name: str = "",
    ) -> None:
        self.color_rgba = color_rgba
        self.name = name
        self._texture = texture

    @property
    def texture(self) -> Bytes | None:
        """The pixels; None without a texture, or if the texture's file is broken."""
        return self._texture.texels if isinstance(self._texture, EncodedTexture) else self._texture

    @property
    def has_texture(self) -> bool:
        """True if a texture was given. Does not decode it."""
        return self._texture is not None

    def untextured(self) -> FaceMaterial:
        """Return the material without its texture."""
        return FaceMaterial(self.color_rgba, name=self.name)

    def tinted(self, color_rgba: Rgba) -> FaceMaterial:
        """Return the material with its colour multiplied by another."""
        r, g, b, a = (own * tint for own, tint in zip(self.color_rgba, color_rgba, strict=True))
        return FaceMaterial((r, g, b, a), self._texture, self.name)

    @cached_property
    def digest(self) -> str:
        """A hash of the content: equal for equal colours and textures."""
        texture = self._texture
        if isinstance(texture, np.ndarray):
            named = hashlib.sha256(repr(texture.shape).encode() + texture.tobytes()).hexdigest()
        else:
            named = "" if texture is None else texture.digest
        color = ", ".join(f"{channel:.4f}" for channel in self.color_rgba)
        return hashlib.sha256(f"{color} {named}".encode()).hexdigest()[:16]


@dataclass(frozen=True, eq=False)
class Appearance:
    """The looks of a mesh of m faces.

    `face_material` : (m,) int32, the index in `materials` of each face; `uv` : (m, 3, 2) float32, texture coordinates
        of each face's corners, or None without textures. (0, 0) is the texture's upper left; it repeats beyond 0..1.
    Raises: SceneError: the arrays do not fit each other.
    """

    materials: tuple[FaceMaterial, ...]
    face_material: Ints32
    uv: Floats32 | None = None

    def __post_init__(self) -> None:
        m = len(self.face_material)
        if m and not 0 <= int(self.face_material.min()) <= int(self.face_material.max()) < len(self.materials):
            raise SceneError(f"face_material names a material beyond the {len(self.materials)} there are.")
        if self.uv is not None and self.uv.shape != (m, 3, 2):
            raise SceneError(f"uv has shape {self.uv.shape}; it must be ({m}, 3, 2), one pair per corner.")

    @classmethod
    def plain(cls, material: FaceMaterial, n_faces: int, uv: Floats32 | None = None) -> Appearance:
        """Return looks with one material on all faces."""
        return cls((material,), np.zeros(n_faces, np.int32), uv)

    @cached_property
    def digest(self) -> str:
        """A hash of the content: equal for meshes with the same looks."""
        content = hashlib.sha256(" ".join(material.digest for material in self.materials).encode())
        content.update(self.face_material.tobytes())
        content.update(b"" if self.uv is None else self.uv.tobytes())
        return content.hexdigest()[:16]

    def of_faces(self, rows: Indices) -> Appearance:
        """Return the looks of some faces, without the materials that these do not have."""
        used, own = np.unique(self.face_material[rows], return_inverse=True)
        materials = tuple(self.materials[row] for row in used)
        return Appearance(materials, own.astype(np.int32), None if self.uv is None else self.uv[rows])

    @property
    def turned(self) -> Appearance:
        """The looks of the same faces with their corners in reverse order."""
        return self if self.uv is None else Appearance(self.materials, self.face_material, self.uv[:, ::-1])


def joined(looks: Sequence[Appearance | None], n_faces: Sequence[int]) -> Appearance | None:
    """Join the looks of meshes that are joined in this order. A mesh without looks is grey. None if none has looks."""
    if all(look is None for look in looks):
        return None
    unknown = FaceMaterial()
    parts = [look or Appearance.plain(unknown, n) for look, n in zip(looks, n_faces, strict=True)]
    numbers: dict[FaceMaterial, int] = {}
    face_material = []
    for part in parts:
        own = [numbers.setdefault(material, len(numbers)) for material in part.materials]
        face_material.append(np.array(own, np.int32)[part.face_material])
    uv = None
    if any(part.uv is not None for part in parts):
        uv = np.concatenate(
            [
                np.zeros((n, 3, 2), np.float32) if part.uv is None else part.uv
                for part, n in zip(parts, n_faces, strict=True)
            ]
        )
    return Appearance(tuple(numbers), np.concatenate(face_material), uv)


def srgb(linear: ArrayLike) -> Floats:
    """Convert linear light 0..1 to sRGB 0..1; values outside are clipped."""
    light = np.clip(np.asarray(linear, dtype=np.float64), 0.0, 1.0)
    # Rounded, so that white is exactly 1.
    curve: Floats = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return curve.round(9)


def painted(colors: NDArray[np.floating], base: FaceMaterial, uv: Floats32 | None = None) -> Appearance:
    """Return the looks of m faces in `colors` (m, 3 or 4), sRGB 0..1, times the base material."""
    rgba = np.ones((len(colors), 4))
    rgba[:, : colors.shape[1]] = np.clip(np.nan_to_num(colors), 0.0, 1.0)
    for steps in _STEPS:
        palette, which = np.unique(np.rint(rgba * steps).astype(np.int32), axis=0, return_inverse=True)
        if len(palette) <= _FEW:
            break
    materials = tuple(base.tinted((r, g, b, a)) for r, g, b, a in (palette / steps).tolist())
    return Appearance(materials, which.reshape(-1).astype(np.int32), uv)
