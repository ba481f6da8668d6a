"""Which triangles p3tinydisplay can draw to a pixel. The others are left out, since each corner takes it time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scene2hap.common.arrays import Bools, Floats32
from scene2hap.scene.capture.views import Camera

# Assumed error of coordinates in single precision [px]. Triangles that are wrongly left out because of it are slivers.
_BLUR_PX = np.float32(0.05)
_LEAST_DEPTH_M = np.float32(1e-9)


@dataclass(frozen=True, eq=False)
class Extents:
    """Bounds of projected triangles: `low`, `high` (2, n) right and down at depth 1 [-], valid if `is_ahead`.

    `is_cut` : triangles that extend behind the eye's plane, and have no bounds.
    """

    low: Floats32
    high: Floats32
    is_ahead: Bools
    is_cut: Bools


def extents(by_axis_m: Floats32, camera: Camera) -> Extents:
    """Return the bounds of triangles (3 axes, 3 corners, n), for all cameras with this camera's eye and axes."""
    right, up, forward = camera.axes
    axes = np.stack((right, -up, forward))
    offsets = (axes @ camera.eye_m).astype(np.float32)
    placed = axes.astype(np.float32) @ by_axis_m.reshape(3, -1) - offsets[:, None]
    across, down, depth = placed.reshape(by_axis_m.shape)
    nearest = depth.min(axis=0)
    is_ahead = nearest > 0
    is_cut = ~is_ahead & (depth.max(axis=0) > 0)
    np.maximum(depth, _LEAST_DEPTH_M, out=depth)
    np.reciprocal(depth, out=depth)
    across *= depth
    down *= depth
    low, high = (np.stack((pick(across, axis=0), pick(down, axis=0))) for pick in (np.min, np.max))
    return Extents(low, high, is_ahead, is_cut)


def in_view(seen: Extents, camera: Camera) -> Bools:
    """Return a mask of the triangles (n,) that can colour a pixel, where corners are rounded down to pixels.

    Triangles behind the eye or beside the picture are left out, and triangles whose corners all are in one row or
    column of pixels. The latter are most triangles of a finely meshed scene.
    """
    # p3tinydisplay scales so that the picture's last half pixel is never reached.
    edge = np.float32(camera.size_px - 0.5)
    scale = edge / np.float32(2 * camera.half)
    visible = seen.is_ahead
    centre_right, centre_up = camera.centre.astype(np.float32)
    for low, high, centre in zip(seen.low, seen.high, (centre_right, -centre_up), strict=True):
        first = np.floor(np.clip((low - centre) * scale + (edge / 2 - _BLUR_PX), -1, camera.size_px))
        last = np.floor(np.clip((high - centre) * scale + (edge / 2 + _BLUR_PX), -1, camera.size_px))
        visible = visible & (first < last)
    return visible | seen.is_cut
