"""Camera positions and framing.

The eye is on a sphere around the object's box. Its distance fixes the perspective. Framing is a window on the image
plane, shifted and scaled until it fits. So isolated and context images of one angle share one eye: an object that hides
the target in one hides it in the other, and framing is exact without iteration.

Letters: d is depth along the axis of view [m]; x, y are right and up on the image plane at depth 1 [-].
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from scene2hap.common.arrays import Floats, Floats32, Ints
from scene2hap.scene.geometry import bounds_of
from scene2hap.scene.objects import UpAxis

# Distance from eye to centre in radii of the bounding sphere. It is large enough for little distortion in the wider
# context images, and small enough for a sense of depth (assumed).
_DISTANCE_RADII = 4.5


@dataclass(frozen=True, eq=False)
class Camera:
    """A square pinhole camera: `axes` are rows right, up, forward; `centre`, `half` are the window at depth 1."""

    eye_m: Floats
    axes: Floats
    centre: Floats
    half: float
    size_px: int

    def directions(self, pixels: Ints, offset_px: tuple[float, float] = (0.0, 0.0)) -> Floats32:
        """Return directions (n, 3) of the rays through pixels, numbered row by row, scaled so that a step of 1 is depth
        1.

        `offset_px` moves the ray from the middle of its pixel, right and down.
        """
        step = 2 * self.half / self.size_px
        steps = (np.arange(self.size_px) + 0.5) * step - self.half
        right, up, forward = self.axes
        columns = np.outer(self.centre[0] + steps + offset_px[0] * step, right)
        rows = np.outer(self.centre[1] - steps - offset_px[1] * step, up) + forward
        row, column = np.divmod(pixels, self.size_px)
        directions: Floats32 = columns.astype(np.float32).take(column, axis=0)
        directions += rows.astype(np.float32).take(row, axis=0)
        return directions

    def project(self, points_m: Floats) -> tuple[Floats, Floats]:
        """Return pixel coordinates (n, 2), right and down, and depths (n,) [m] of points. Only depths > 0 are in
        front."""
        placed = (points_m - self.eye_m) @ self.axes.T
        depth = placed[:, 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            plane = placed[:, :2] / depth[:, None]
        pixels = (plane - self.centre) / (2 * self.half) * (1, -1) + 0.5
        return pixels * self.size_px, depth

    def window_of(self, points_m: Floats) -> tuple[int, int, int, int]:
        """Return the pixels that points can cover, as (first row, last row + 1, first column, last column + 1)."""
        pixels, depth = self.project(points_m)
        if (depth <= 0).any():
            return (0, self.size_px, 0, self.size_px)
        low = np.clip(np.floor(pixels.min(axis=0)) - 1, 0, self.size_px).astype(int)
        high = np.clip(np.ceil(pixels.max(axis=0)) + 1, 0, self.size_px).astype(int)
        return (int(low[1]), int(high[1]), int(low[0]), int(high[0]))

    def at_pixel(self, pixel: Floats) -> Camera:
        """Return a camera at the same eye, with a window of one pixel around a position (2,), right and down."""
        away = (pixel / self.size_px - 0.5) * (1, -1) * 2 * self.half
        return replace(self, centre=self.centre + away, half=self.half / self.size_px, size_px=1)

    def widened(self, factor: float) -> Camera:
        """Return a camera at the same eye and angle, with a window `factor` times as wide."""
        return replace(self, half=self.half * factor)

    def resized(self, size_px: int) -> Camera:
        """Return the view with another number of pixels."""
        return replace(self, size_px=size_px)


def axes_of(up_axis: UpAxis) -> Floats:
    """Return the world's directions right, up and front as rows; azimuth 0 looks from the front."""
    if up_axis == "y":
        return np.array([(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)])
    return np.array([(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)])


def frame(
    points_m: Floats, azimuth_deg: float, elevation_deg: float, up_axis: UpAxis, fill: float, size_px: int
) -> Camera:
    """Return the camera that looks at the middle of the points' box from an angle. The points fill `fill` of the
    picture.

    Parameters: points_m : (n, 3) [m], n >= 1; fill : larger of the width and height of their projection, as a share of
        the picture's edge [-].
    """
    low, high = bounds_of(points_m)
    middle = (low + high) / 2
    radius = max(float(np.linalg.norm(high - low)) / 2, 1e-9)
    azimuth, elevation = np.deg2rad(azimuth_deg), np.deg2rad(elevation_deg)
    world_right, world_up, world_front = axes_of(up_axis)
    level = np.sin(azimuth) * world_right + np.cos(azimuth) * world_front
    away = np.cos(elevation) * level + np.sin(elevation) * world_up
    right = np.cross(world_up, level)
    axes = np.stack((right, np.cross(away, right), -away))
    eye = middle + away * radius * _DISTANCE_RADII
    placed = (points_m - eye) @ axes.T
    plane = placed[:, :2] / placed[:, 2:]
    low, high = bounds_of(plane)
    half = max(float((high - low).max()) / 2 / fill, 1e-9)
    return Camera(eye, axes, (low + high) / 2, half, size_px)
