"""The outline of a flat shape that is no rectangle: rings of corners, and the covered share of each pixel."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scene2hap import checks
from scene2hap.calls import clear_construction
from scene2hap.errors import SceneError

Floats = NDArray[np.float64]
Ring = tuple[tuple[float, float], ...]

MOST_CORNERS = 4096
SHARPEST = math.radians(30.0)
"""A corner whose direction changes by less is part of a curve."""
_LINES = 4  # scan lines through a row of pixels; along a line the share is exact


@clear_construction
@dataclass(frozen=True)
class Outline:
    """The area of a plate: all points inside an odd number of rings, so a ring within another cuts a hole.

    Parameters: rings_m : rings of at least 3 corners (x, y) each [m], in either direction; the last corner joins the
        first. x and y run along the plate's length and width, from its corner.
    Raises: SceneError: no ring, a ring of fewer corners, more than `MOST_CORNERS` corners, a corner that is not finite,
    or no area.
    """

    rings_m: tuple[Ring, ...]

    def __post_init__(self) -> None:
        rings = tuple(_ring(k, ring) for k, ring in enumerate(self.rings_m))
        object.__setattr__(self, "rings_m", rings)
        n_corners = sum(map(len, rings))
        if not 3 <= n_corners <= MOST_CORNERS:
            raise SceneError(
                f"the outline has {n_corners} corners; it must have 3 to {MOST_CORNERS}. 64 are enough for a circle."
            )
        x0, y0, x1, y1 = self.box_m
        if not (x1 > x0 and y1 > y0 and self.area_m2 > 1e-6 * (x1 - x0) * (y1 - y0)):
            raise SceneError(
                f"the outline covers {self.area_m2:g} m2 of {x1 - x0:g} × {y1 - y0:g} m; it must have an area."
            )

    @cached_property
    def box_m(self) -> tuple[float, float, float, float]:
        """Least and greatest x and y of the outline: (x0, y0, x1, y1) [m]."""
        corners = np.concatenate(self.rings_m)
        (x0, y0), (x1, y1) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
        return x0, y0, x1, y1

    @cached_property
    def area_m2(self) -> float:
        """Area inside the outline [m2], to a thousandth."""
        x0, y0, x1, y1 = self.box_m
        shares = self.coverage(np.array([x0, x1]), np.linspace(y0, y1, 513))
        return float(shares.mean()) * (x1 - x0) * (y1 - y0)

    @cached_property
    def notches_m(self) -> Floats:
        """Corners (n, 2) [m] that point into the area by `SHARPEST` or more, such as the inner corner of an L."""
        corners, ways = [], []
        for ring in self.rings_m:
            at = np.array(ring)
            back, on = np.roll(at, 1, axis=0) - at, np.roll(at, -1, axis=0) - at
            back, on = (way / np.maximum(np.linalg.norm(way, axis=1), 1e-300)[:, None] for way in (back, on))
            sharp = np.einsum("ij,ij->i", back, on) > -math.cos(SHARPEST)
            corners.append(at[sharp])
            ways.append((back + on)[sharp])
        found, way = np.concatenate(corners), np.concatenate(ways)
        beside: Floats = found + 1e-5 * max(self.extent_m) * way
        return found[~self.holds(beside)]

    @property
    def extent_m(self) -> tuple[float, float]:
        """Length and width of the outline's box [m]."""
        x0, y0, x1, y1 = self.box_m
        return x1 - x0, y1 - y0

    def distance_m(self, points_m: Floats) -> Floats:
        """Return the distances (n,) of points (n, 2) from the area [m], 0 inside."""
        starts, ends = self._edges
        way = ends - starts
        off = points_m[:, None] - starts
        share = np.einsum("pei,ei->pe", off, way) / np.maximum(np.einsum("ei,ei->e", way, way), 1e-300)
        beside = np.linalg.norm(off - share.clip(0.0, 1.0)[..., None] * way, axis=2).min(axis=1)
        distance: Floats = np.where(self.holds(points_m), 0.0, beside)
        return distance

    def placed(self, scale: tuple[float, float], shift_m: tuple[float, float]) -> Outline:
        """Return the outline with each coordinate scaled and then shifted [m]."""
        (a, b), (c, d) = scale, shift_m
        return Outline(tuple(tuple((a * x + c, b * y + d) for x, y in ring) for ring in self.rings_m))

    def holds(self, points_m: Floats) -> NDArray[np.bool_]:
        """Return a mask of the points (n, 2) inside the area."""
        starts, ends = self._edges
        (xa, ya), (xb, yb) = starts.T, ends.T
        x, y = points_m[:, :1], points_m[:, 1:]
        crosses = (ya > y) != (yb > y)
        with np.errstate(divide="ignore", invalid="ignore"):
            beyond = x < xa + (y - ya) / (yb - ya) * (xb - xa)
        within: NDArray[np.bool_] = np.count_nonzero(crosses & beyond, axis=1) % 2 == 1
        return within

    @cached_property
    def _edges(self) -> tuple[Floats, Floats]:
        """The start and end points of all edges, (n_edges, 2) each [m]."""
        ends = [np.roll(np.array(ring), -1, axis=0) for ring in self.rings_m]
        return np.concatenate(self.rings_m), np.concatenate(ends)

    def coverage(self, x_m: Floats, y_m: Floats) -> Floats:
        """Return the share (nx, ny), 0..1, of each pixel that is inside the area.

        Pixels are between lines x (nx + 1,) and lines y (ny + 1,), both rising [m]. The share is exact along x, and
        from four scan lines through each row along y.
        """
        nx, ny = len(x_m) - 1, len(y_m) - 1
        scan = (y_m[:-1, None] + np.diff(y_m)[:, None] * (np.arange(_LINES) + 0.5) / _LINES).ravel()
        starts, ends = self._edges
        low, high = np.minimum(starts[:, 1], ends[:, 1]), np.maximum(starts[:, 1], ends[:, 1])
        first, last = np.searchsorted(scan, low), np.searchsorted(scan, high)
        count = last - first
        edge = np.repeat(np.arange(len(starts)), count)
        line = np.arange(len(edge)) - np.repeat(np.cumsum(count) - count - first, count)
        (xa, ya), (xb, yb) = starts[edge].T, ends[edge].T
        x = xa + (scan[line] - ya) / (yb - ya) * (xb - xa)
        # Along a line, the covered part begins at every second crossing and ends at the next.
        order = np.lexsort((x, line))
        x, row = x[order].clip(x_m[0], x_m[-1]), line[order] // _LINES
        sign = np.where(np.arange(len(x)) % 2 == 0, 1.0, -1.0)
        pixel = np.clip(np.searchsorted(x_m, x, side="right") - 1, 0, nx - 1)
        rest = (x_m[pixel + 1] - x) / np.diff(x_m)[pixel]
        changes = np.zeros((nx + 1, ny))
        np.add.at(changes, (pixel, row), sign * rest)
        np.add.at(changes, (pixel + 1, row), sign * (1 - rest))
        covered: Floats = (changes.cumsum(axis=0)[:-1] / _LINES).clip(0.0, 1.0)
        return covered


def _ring(number: int, ring: object) -> Ring:
    corners = checks.floats(f"ring {number} of the outline", ring, "m", error=SceneError)
    if corners.ndim != 2 or corners.shape[1] != 2 or len(corners) < 3 or not np.isfinite(corners).all():
        raise SceneError(
            f"ring {number} of the outline has shape {corners.shape}; it must be (n_corners, 2) finite numbers [m], of "
            "at least 3 corners. An outline is a list of rings, of one ring also: Outline([[(0, 0), (1, 0), (1, 1)]])."
        )
    return tuple((x, y) for x, y in corners.tolist())
