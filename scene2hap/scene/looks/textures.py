"""Textures as image files: checked when a scene is read, decoded when a picture first needs them."""

from __future__ import annotations

import hashlib
import io
import warnings
from dataclasses import dataclass, replace
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from scene2hap.common.arrays import Bytes
from scene2hap.common.warning import warn_of
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits

if TYPE_CHECKING:
    from PIL import Image

DECODED_PX = 1024
"""Most pixels a side of a decoded texture: twice the detail that a picture can show (assumed)."""

# The first bytes of each format, its name, and the Pillow plugin that reads it. Only TGA has no signature.
_FORMATS = (
    (b"\x89PNG", "PNG", "PngImagePlugin"),
    (b"\xff\xd8", "JPEG", "JpegImagePlugin"),
    (b"RIFF", "WEBP", "WebPImagePlugin"),
    (b"BM", "BMP", "BmpImagePlugin"),
    (b"GIF8", "GIF", "GifImagePlugin"),
    (b"II*\0", "TIFF", "TiffImagePlugin"),
    (b"MM\0*", "TIFF", "TiffImagePlugin"),
    (b"", "TGA", "TgaImagePlugin"),
)


class TextureWarning(UserWarning):
    """Textures of a scene that cannot be shown. The plain colours of their materials are shown instead."""


@dataclass(frozen=True, eq=False)
class EncodedTexture:
    """The bytes of an image file. `name` is for messages; `has_alpha` is False if its opacity is ignored."""

    encoded: bytes
    name: str
    has_alpha: bool

    @classmethod
    def checked(cls, encoded: bytes, name: str) -> EncodedTexture:
        """Return a texture after a check of its header; its pixels are not decoded.

        Raises: SceneFormatError: it is no image of a format that is read. SceneError: it is too large.
        """
        try:
            # Pillow warns of large images, which our own limit refuses.
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                with opened(encoded) as image:
                    edge, has_alpha = max(image.size), image.has_transparency_data
        # Broken bytes may raise any error in Pillow's plugins.
        except Exception as cause:
            known = ", ".join(dict.fromkeys(kind for _, kind, _ in _FORMATS))
            raise SceneFormatError(f"{name} is no image that is read ({known}): {pillow_reason(cause)}.") from cause
        if edge > limits.MAX_TEXTURE_PX:
            raise SceneError(
                f"{name} is {edge:,} pixels wide or high; at most {limits.MAX_TEXTURE_PX:,} are read "
                "(scene2hap.scene.limits.MAX_TEXTURE_PX). Shrink it."
            )
        return cls(encoded, name, has_alpha)

    def __reduce__(self) -> tuple[object, ...]:
        # Another process decodes the file itself, since decoded pixels would be large to send.
        return (EncodedTexture, (self.encoded, self.name, self.has_alpha))

    @property
    def opaque(self) -> EncodedTexture:
        """The image without its opacity."""
        return replace(self, has_alpha=False)

    @cached_property
    def digest(self) -> str:
        """A hash of the content."""
        return hashlib.sha256(self.encoded + bytes([self.has_alpha])).hexdigest()[:16]

    @cached_property
    def texels(self) -> Bytes | None:
        """The pixels (height, width, 3 or 4) uint8 sRGB; None, after a TextureWarning, if they cannot be decoded."""
        try:
            with opened(self.encoded) as image:
                texels = self._decoded(image)
        # Broken bytes may raise any error in Pillow.
        except Exception as cause:
            message = (
                f"{self.name} is left out, its colour stays: its pixels cannot be decoded: {pillow_reason(cause)}."
            )
            warn_of(message, TextureWarning)
            return None
        texels.flags.writeable = False
        return texels

    def _decoded(self, image: Image.Image) -> Bytes:
        from PIL import Image

        # JPEG decodes to a half, a quarter or an eighth of its size in a fraction of the time.
        image.draft(None, (DECODED_PX, DECODED_PX))
        image = eight_bits(image)
        if image.has_transparency_data:
            image = image.convert("RGBA")
        image = image.convert("RGBA" if self.has_alpha else "RGB")
        image.thumbnail((DECODED_PX, DECODED_PX), Image.Resampling.BOX)
        return np.array(image)


def pillow_reason(cause: Exception) -> str:
    """Return the reason of an error of Pillow, which for an unknown header is only the address of its bytes."""
    return "its header is damaged" if type(cause).__name__ == "UnidentifiedImageError" else str(cause)[:200]


def opened(encoded: bytes) -> Image.Image:
    """Return an image file whose pixels are not decoded yet. Raises: any error of Pillow: it is no image."""
    kind, plugin = next((kind, plugin) for start, kind, plugin in _FORMATS if encoded.startswith(start))
    # For an unknown format Pillow would import all of its plugins.
    import_module(f"PIL.{plugin}")
    from PIL import Image

    return Image.open(io.BytesIO(encoded), formats=(kind,))


def eight_bits(image: Image.Image) -> Image.Image:
    """Scale 16-bit grey to 8 bits, where Pillow would clip it. Other images are unchanged."""
    from PIL import Image

    if not image.mode.startswith("I"):
        return image
    return Image.fromarray((np.asarray(image) >> 8).clip(0, 255).astype(np.uint8))
