"""The outline of a flat shape that is no rectangle: rings of corners, and the covered share of each pixel."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.common import checks
from scene2hap.common.arrays import Bools, Floats, Indices, floats
from scene2hap.common.calls import clear_construction
from scene2hap.common.json_fields import Real
from scene2hap.errors import SceneError
from scene2hap.scene.geometry import counted_up

Ring = tuple[tuple[Real, Real], ...]

MOST_CORNERS = 4096
SHARPEST = math.radians(30.0)
"""Least change of direction at a sharp corner [rad]; corners with a smaller change are part of a curve."""
_NARROW = 2.0  # widest narrow gap [px]; the shares of pixels show wider gaps
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

    if TYPE_CHECKING:

        def __init__(self, rings_m: Iterable[ArrayLike]) -> None: ...

    def __post_init__(self) -> None:
        rings = tuple(_ring(k, ring) for k, ring in enumerate(checks.items("rings_m", self.rings_m, error=SceneError)))
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
        _, y0, _, y1 = self.box_m
        x, _ = _crossings(*self._edges, np.linspace(y0, y1, 513))
        return float((x[1::2] - x[::2]).sum()) * (y1 - y0) / (512 * _LINES)

    @cached_property
    def moments(self) -> tuple[Floats, Floats]:
        """Centroid (2,) [m] of the area, and the mean products of the distances from it along x and y (2, 2) [m2].

        To a thousandth, as the area.
        """
        _, y0, _, y1 = self.box_m
        ends, line = _crossings(*self._edges, np.linspace(y0, y1, 513))
        a, b, y = ends[::2], ends[1::2], y0 + (line[::2] + 0.5) * (y1 - y0) / (512 * _LINES)
        length = b - a
        x, area = (a + b) / 2, length.sum()
        middle = np.array([(length * x).sum(), (length * y).sum()]) / area
        u, v = x - middle[0], y - middle[1]
        xy = (length * u * v).sum()
        products = np.array([[(length * (u**2 + length**2 / 12)).sum(), xy], [xy, (length * v**2).sum()]])
        return middle, products / area

    @property
    def notches_m(self) -> Floats:
        """Corners (n, 2) [m] that point into the area by `SHARPEST` or more, such as the inner corner of an L."""
        corners, radii = self.inward
        notches: Floats = corners[radii == 0.0]
        return notches

    @cached_property
    def inward(self) -> tuple[Floats, Floats]:
        """Corners (n, 2) [m] that point into the area, and the radius of the curve at each (n,) [m].

        The radius is 0 at notches. The other corners belong to curves that turn by `SHARPEST` or more in total, such as
        the rim of a round hole.
        """
        corners, ways, turns, radii, starts = [], [], [], [], []
        for ring in self.rings_m:
            at = np.array(ring)
            back, on = np.roll(at, 1, axis=0) - at, np.roll(at, -1, axis=0) - at
            sides_m = [np.maximum(np.linalg.norm(way, axis=1), 1e-300) for way in (back, on)]
            back, on = (way / side[:, None] for way, side in zip((back, on), sides_m, strict=True))
            turn = np.pi - np.arccos(np.einsum("ij,ij->i", back, on).clip(-1.0, 1.0))
            corners.append(at)
            ways.append(back + on)
            turns.append(turn)
            radii.append(np.where(turn > SHARPEST, 0.0, sum(sides_m) / 2 / np.maximum(turn, 1e-9)))
            starts.append(len(at))
        found, way, turn = np.concatenate(corners), np.concatenate(ways), np.concatenate(turns)
        points_in = (turn > 1e-6) & ~self.holds(found + 1e-5 * max(self.extent_m) * way)
        is_kept = [
            _in_long_runs(own, angles, SHARPEST)
            for own, angles in zip(np.split(points_in, np.cumsum(starts)[:-1]), turns, strict=True)
        ]
        kept = np.concatenate(is_kept)
        return found[kept], np.concatenate(radii)[kept]

    @property
    def extent_m(self) -> tuple[float, float]:
        """Length and width of the outline's box [m]."""
        x0, y0, x1, y1 = self.box_m
        return x1 - x0, y1 - y0

    @cached_property
    def slant_rad(self) -> float:
        """Angle by which the sides of notches are turned against x and y, -pi/4 to pi/4, 0 without notches [rad]."""
        notches = {tuple(corner) for corner in self.notches_m.tolist()}
        starts, ends = self._edges
        is_beside = [
            tuple(a) in notches or tuple(b) in notches for a, b in zip(starts.tolist(), ends.tolist(), strict=True)
        ]
        way = (ends - starts)[is_beside] @ (1.0, 1.0j)
        # The fourth power makes perpendicular sides count the same.
        total = (np.abs(way) * (way / np.maximum(np.abs(way), 1e-300)) ** 4).sum()
        return float(np.angle(total)) / 4

    @cached_property
    def width_m(self) -> float:
        """Least distance of two parallel lines with the outline between them [m]."""
        starts, ends = self._edges
        way = ends - starts
        # One of the two lines is along a side of the convex hull. Sides of notches only add directions of larger width.
        normal = np.unique(np.round(_normals(way), 9), axis=0)
        across = starts @ normal.T
        return float(np.ptp(across, axis=0).min())

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
        return Outline(np.array(ring) * scale + shift_m for ring in self.rings_m)

    def turned(self, angle_rad: float) -> tuple[Outline, Floats, Floats]:
        """Return the outline turned by an angle [rad] and moved so that its box starts at (0, 0).

        Also returns the matrix R and the shift s [m] of this transform: a point x moves to R x + s.
        """
        c, s = math.cos(angle_rad), math.sin(angle_rad)
        turn = np.array([[c, -s], [s, c]])
        rings = [np.array(ring) @ turn.T for ring in self.rings_m]
        shift = -np.concatenate(rings).min(axis=0)
        return Outline(ring + shift for ring in rings), turn, shift

    def holds(self, points_m: Floats) -> Bools:
        """Return a mask of the points (n, 2) inside the area."""
        starts, ends = self._edges
        (xa, ya), (xb, yb) = starts.T, ends.T
        x, y = points_m[:, :1], points_m[:, 1:]
        crosses = (ya > y) != (yb > y)
        with np.errstate(divide="ignore", invalid="ignore"):
            beyond = x < xa + (y - ya) / (yb - ya) * (xb - xa)
        within: Bools = np.count_nonzero(crosses & beyond, axis=1) % 2 == 1
        return within

    @cached_property
    def _edges(self) -> tuple[Floats, Floats]:
        """The start and end points of all edges, (n_edges, 2) each [m]."""
        ends = [np.roll(np.array(ring), -1, axis=0) for ring in self.rings_m]
        return np.concatenate(self.rings_m), np.concatenate(ends)

    def covered(self, x_m: Floats, y_m: Floats) -> tuple[Floats, Floats]:
        """Return the share (nx, ny), 0..1, of each pixel that is inside the area, and the centroid of that part.

        The centroid (2, nx, ny) is measured from the pixel's middle, in sides of the pixel along x and y, -1/2..1/2.
        Pixels are between lines x (nx + 1,) and lines y (ny + 1,), both rising [m]. Share and centroid are exact along
        x; along y they come from four scan lines through each row.
        """
        nx, ny = len(x_m) - 1, len(y_m) - 1
        x, line = _crossings(*self._edges, y_m)
        # Along a line, the covered part begins at every second crossing and ends at the next.
        x, (row, scan) = x.clip(x_m[0], x_m[-1]), np.divmod(line, _LINES)
        sign = np.where(np.arange(len(x)) % 2 == 0, 1.0, -1.0) / _LINES
        pixel = np.clip(np.searchsorted(x_m, x, side="right") - 1, 0, nx - 1)
        rest = (x_m[pixel + 1] - x) / np.diff(x_m)[pixel]
        at, off_y = pixel * ny + row, (scan + 0.5) / _LINES - 0.5
        changes = np.stack(
            [
                np.bincount(at, weight * rest, (nx + 1) * ny) + np.bincount(at + ny, weight * (1 - rest), (nx + 1) * ny)
                for weight in (sign, sign * off_y)
            ]
        )
        shares, moments_y = changes.reshape(2, nx + 1, ny).cumsum(axis=1)[:, :-1]
        moments_x = np.bincount(at, sign * rest * (1 - rest) / 2, nx * ny).reshape(nx, ny)
        off = np.stack([moments_x, moments_y]) / np.maximum(shares, 1e-9)
        return shares.clip(0.0, 1.0), off.clip(-0.5, 0.5)

    def narrow_gaps(self, x_m: Floats, y_m: Floats) -> Bools:
        """Return a mask (nx, ny) of the pixels in the middle of narrow gaps between two parts of the area.

        A slot thinner than a pixel leaves most of the pixel covered, so the pixel's share does not show the gap. Pixels
        are as in `covered`.
        """
        starts, ends = self._edges
        return _gaps(starts, ends, x_m, y_m) | _gaps(starts[:, ::-1], ends[:, ::-1], y_m, x_m).T


def _normals(ways: Floats) -> Floats:
    """Return the unit normals (n, 2) of edges (m, 2) that have a length."""
    long = ways[np.linalg.norm(ways, axis=1) > 0.0]
    unit: Floats = long[:, ::-1] * (1.0, -1.0) / np.linalg.norm(long, axis=1)[:, None]
    return unit


def _crossings(starts: Floats, ends: Floats, y_m: Floats) -> tuple[Floats, Indices]:
    """Return where scan lines cross edges, along x (n,) [m], and the lines' numbers (n,), in the order of both."""
    scan = (y_m[:-1, None] + np.diff(y_m)[:, None] * (np.arange(_LINES) + 0.5) / _LINES).ravel()
    low, high = np.minimum(starts[:, 1], ends[:, 1]), np.maximum(starts[:, 1], ends[:, 1])
    first, last = np.searchsorted(scan, low), np.searchsorted(scan, high)
    edge, nth = counted_up(last - first)
    line = first[edge] + nth
    (xa, ya), (xb, yb) = starts[edge].T, ends[edge].T
    x = xa + (scan[line] - ya) / (yb - ya) * (xb - xa)
    order = np.lexsort((x, line))
    return x[order], line[order]


def _gaps(starts: Floats, ends: Floats, x_m: Floats, y_m: Floats) -> Bools:
    """Return a mask (nx, ny) of the pixels in the middle of gaps of at most `_NARROW` pixels along x."""
    x, line = _crossings(starts, ends, y_m)
    is_gap = line[1:-1:2] == line[2::2]
    row = line[2::2][is_gap] // _LINES
    low, high = (np.interp(each[is_gap], x_m, np.arange(len(x_m))) for each in (x[1:-1:2], x[2::2]))
    is_narrow = high - low <= _NARROW
    mask = np.zeros((len(x_m) - 1, len(y_m) - 1), dtype=bool)
    middle = ((low + high) / 2).astype(np.intp).clip(0, len(x_m) - 2)
    mask[middle[is_narrow], row[is_narrow]] = True
    return mask


def _in_long_runs(is_in: Bools, turns: Floats, least: float) -> Bools:
    """Return a mask of the corners of a ring in runs that turn by `least` or more in total."""
    if is_in.all():
        return is_in
    first = int(np.flatnonzero(~is_in)[0])
    own, angles = np.roll(is_in, -first), np.roll(turns, -first)
    run = np.cumsum(~own)
    total = np.bincount(run, np.where(own, angles, 0.0))
    kept: Bools = np.roll(own & (total[run] > least), first)
    return kept


def _ring(number: int, ring: object) -> Ring:
    corners = floats(f"ring {number} of the outline", ring, "m", error=SceneError)
    if corners.ndim != 2 or corners.shape[1] != 2 or len(corners) < 3 or not np.isfinite(corners).all():
        raise SceneError(
            f"ring {number} of the outline has shape {corners.shape}; it must be (n_corners, 2) finite numbers [m], of "
            "at least 3 corners. An outline is a list of rings, of one ring also: Outline([[(0, 0), (1, 0), (1, 1)]])."
        )
    return tuple((x, y) for x, y in corners.tolist())
