"""How an object looks: materials and textures of its faces, for pictures alone.

Nothing here is part of a scene's JSON or of its equality: a snapshot that lost its looks is still the same scene.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.errors import SceneError


@dataclass(frozen=True, eq=False)
class FaceMaterial:
    """What some faces are painted with.

    `color_rgba` : sRGB and opacity, 0..1 [-]; `texture` : (height, width, 3 or 4) uint8 sRGB, or None; both multiply.
    """

    color_rgba: tuple[float, float, float, float] = (0.8, 0.8, 0.8, 1.0)
    texture: NDArray[np.uint8] | None = None


@dataclass(frozen=True, eq=False)
class Appearance:
    """The looks of a mesh of m faces.

    `face_material` : (m,) int32, which of `materials` each face has; `uv` : (m, 3, 2) float32, texture coordinates of
    each face's corners with (0, 0) at the texture's upper left, repeating beyond 0..1; None without textures.
    Raises: SceneError: the arrays do not fit each other.
    """

    materials: tuple[FaceMaterial, ...]
    face_material: NDArray[np.int32]
    uv: NDArray[np.float32] | None = None

    def __post_init__(self) -> None:
        m = len(self.face_material)
        if m and not 0 <= int(self.face_material.min()) <= int(self.face_material.max()) < len(self.materials):
            raise SceneError(f"face_material names a material beyond the {len(self.materials)} there are.")
        if self.uv is not None and self.uv.shape != (m, 3, 2):
            raise SceneError(f"uv has shape {self.uv.shape}; it must be ({m}, 3, 2), one pair per corner.")
