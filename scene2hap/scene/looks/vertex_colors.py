"""Colours of vertices or faces, reduced to few materials.

Source: IEC 61966-2-1:1999, the sRGB transfer function.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common.arrays import Floats
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial

# Steps of a channel. They are tried in turn until at most this many materials are left (assumed: a picture seldom shows
# more). After the last step there may be more.
_STEPS, _FEW = (255, 31, 15, 7), 256


def srgb(linear: ArrayLike) -> Floats:
    """Convert linear light 0..1 to sRGB 0..1; values outside are clipped."""
    light = np.clip(np.asarray(linear, dtype=np.float64), 0.0, 1.0)
    # Rounded, so that white is exactly 1.
    curve: Floats = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return curve.round(9)


def painted(colors: NDArray[np.floating], base: FaceMaterial, uv: NDArray[np.float32] | None = None) -> Appearance:
    """Return the looks of m faces in `colors` (m, 3 or 4), sRGB 0..1, times the base material."""
    rgba = np.ones((len(colors), 4))
    rgba[:, : colors.shape[1]] = np.clip(np.nan_to_num(colors), 0.0, 1.0)
    for steps in _STEPS:
        palette, which = np.unique(np.rint(rgba * steps).astype(np.int32), axis=0, return_inverse=True)
        if len(palette) <= _FEW:
            break
    materials = tuple(base.tinted((r, g, b, a)) for r, g, b, a in (palette / steps).tolist())
    return Appearance(materials, which.reshape(-1).astype(np.int32), uv)
