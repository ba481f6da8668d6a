"""Colours of surfaces: all materials are in one table, so that numpy colours all pixels of a picture at once.

Light comes from the eye and a little from above; both sides of a face are lit equally. Lighting multiplies sRGB values
directly, since the pictures need to be recognisable, not photometric.
"""

from __future__ import annotations

import hashlib
from colorsys import hsv_to_rgb
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from PIL import Image

from scene2hap.common.arrays import Bools, Bytes, Floats, Floats32, Ints32
from scene2hap.scene.looks.appearance import FaceMaterial

BACKGROUND_RGB = (190, 194, 200)
"""Background: light enough for black objects, dark enough for white ones (assumed)."""

AMBIENT, HEADLIGHT, SKYLIGHT = 0.40, 0.50, 0.10
"""Weights of ambient light, of light from the eye, and of light from above (minus below) (tuned by eye)."""

# Textures are reduced to this edge. A picture of 512 pixels shows no more, and memory grows with it.
_TEXTURE_PX = 512
# Brightness behind glass, in place of the objects behind it: glass must be visible as a pale surface.
_BEHIND_GLASS = 0.85


@dataclass(eq=False)
class PaletteBuilder:
    """Collector of materials, each once; `keys` are digests of the rows' content."""

    keys: list[str] = field(default_factory=list)
    _rows: list[tuple[tuple[float, float, float], Bytes, bool]] = field(default_factory=list)
    _index: dict[str, int] = field(default_factory=dict)
    _known: dict[int, tuple[int, FaceMaterial]] = field(default_factory=dict)

    def add(self, material: FaceMaterial) -> int:
        """Return the row of a material."""
        if id(material) not in self._known:
            # The material is stored too: its id must not be reused while it is a key.
            self._known[id(material)] = (self._row(material), material)
        return self._known[id(material)][0]

    def _row(self, material: FaceMaterial) -> int:
        texels = np.full((1, 1, 4), 255, np.uint8) if material.texture is None else _rgba(material.texture)
        key = hashlib.sha256(repr((material.color_rgba, texels.shape)).encode() + texels.tobytes()).hexdigest()
        if key not in self._index:
            *rgb, opacity = material.color_rgba
            is_cutout = bool(texels[..., 3].min() < 128 <= texels[..., 3].max())
            if not is_cutout:
                opacity *= float(texels[..., 3].mean()) / 255
            red, green, blue = (channel * opacity + _BEHIND_GLASS * (1 - opacity) for channel in rgb)
            self._index[key] = len(self._rows)
            self.keys.append(key)
            self._rows.append(((red, green, blue), _shrunk(texels), is_cutout))
        return self._index[key]

    def build(self) -> Palette:
        """Return the table of all materials added."""
        sizes = [texels.shape[0] * texels.shape[1] for _, texels, _ in self._rows]
        return Palette(
            rgb=np.array([rgb for rgb, _, _ in self._rows], np.float32),
            texels=np.concatenate([texels.reshape(-1, 4) for _, texels, _ in self._rows]),
            start=np.cumsum([0, *sizes[:-1]]).astype(np.int32),
            width=np.array([texels.shape[1] for _, texels, _ in self._rows], np.int32),
            height=np.array([texels.shape[0] for _, texels, _ in self._rows], np.int32),
            is_cutout=np.array([cutout for _, _, cutout in self._rows], bool),
        )


@dataclass(frozen=True, eq=False)
class Palette:
    """Materials by row: `rgb` 0..1, and a texture of `width` x `height` among the `texels` (n, 4) at `start`.

    `is_cutout` : the texture has holes, like leaves of plants.
    """

    rgb: Floats32
    texels: Bytes
    start: Ints32
    width: Ints32
    height: Ints32
    is_cutout: Bools

    def texel(self, material: Ints32, uv: Floats32) -> Ints32:
        """Return the index in `texels` of the texel nearest to uv (n, 2) for materials (n,)."""
        width, height = self.width.take(material), self.height.take(material)
        # Broken files contain NaN coordinates; any texel will do for them.
        u, v = np.nan_to_num(uv - np.floor(uv), copy=False).T
        column = np.minimum((u * width).astype(np.int32), width - 1)
        row = np.minimum((v * height).astype(np.int32), height - 1)
        where: Ints32 = self.start.take(material) + row * width + column
        return where

    def pattern(self, material: Ints32, uv: Floats32) -> Floats32:
        """Return the textures' factors of the colours (n, 3), 0..1."""
        return self.texels.take(self.texel(material, uv), axis=0)[:, :3] * np.float32(1 / 255)

    @cached_property
    def is_patterned(self) -> Bools:
        """Mask of the rows with a texture."""
        return self.width * self.height > 1


def light(normals: Floats32, forward: Floats, up: Floats) -> Floats32:
    """Return the brightness (n,) of faces with unit normals (n, 3), looking along `forward`, 0..1."""
    along = normals @ forward.astype(np.float32)
    upward = -np.sign(along) * (normals @ up.astype(np.float32))
    brightness: Floats32 = np.clip(AMBIENT + HEADLIGHT * np.abs(along) + SKYLIGHT * upward, 0.0, 1.0)
    return brightness


def neutral(key: str) -> FaceMaterial:
    """Return the paint of an object of unknown looks: a light grey whose slight hue depends on its key."""
    seed = hashlib.sha256(key.encode()).digest()
    red, green, blue = hsv_to_rgb(seed[0] / 256, 0.10 + 0.12 * seed[1] / 255, 0.68 + 0.22 * seed[2] / 255)
    return FaceMaterial((red, green, blue, 1.0))


def _rgba(texture: Bytes) -> Bytes:
    if texture.shape[2] == 4:
        return texture
    return np.dstack((texture, np.full(texture.shape[:2], 255, np.uint8)))


def _shrunk(texels: Bytes) -> Bytes:
    height, width = texels.shape[:2]
    if max(height, width) <= _TEXTURE_PX:
        return texels
    scale = _TEXTURE_PX / max(height, width)
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    return np.asarray(Image.fromarray(texels).resize(size, Image.Resampling.BOX))
