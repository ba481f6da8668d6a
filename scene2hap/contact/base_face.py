"""Base face and top face of a shape: its lowest and highest level face for a given direction of up.

Most objects stand on level faces. Their contacts follow from convex outlines; only the others need triangles. A base
face is a shape's lowest face, or its lowest corners, like the feet of a stool. A top face is its highest face. Where
the two overlap in plan, no other parts of the two shapes are nearer.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.geometry.spread import spread
from scene2hap.contact.geometry.vectors import Floats, Triple, along, cross, highest, upright_frame

# How uneven a level face may be, as a share of the shape's size and at most (assumed).
_UNEVEN, _UNEVEN_M = 1e-4, 2e-4
_FLAT = 0.01  # Triangles lie in one plane if they leave it by less than this share of the unevenness (assumed).
# Without a level base face, corners up to this height above the lowest one bear as well: at least, as a share of the
# shape's size, and at most (assumed: a little more than the slack of triangle patches, `rule.slack_m`, since feet of
# models are often 1 mm uneven).
_FEET_M, _FEET_SIZES, _MOST_FEET_M = 0.0012, 1.2e-3, 0.0048
# A level face smaller than this share of the outline of those corners is no base face: the lowest face of a vase may be
# a tiny triangle. Nor is one of several feet if another foot bears as well, as that of a table with one short leg.
_CRUMB = 0.5
_COLLINEAR_M = 1e-6  # rounding of float32 for coordinates of some metres
_COVER = 1e-3  # An outline is filled if the area of its triangles differs from its own by less than this share.


class BaseFace(NamedTuple):
    """The base face of a shape in its own frame [m].

    points_m : up to four contact points; outline_m : convex outline (support polygon), with fewer than three corners if
    there are no more; middle_m, radius_m : a ball around it; is_filled : True if the face fills its outline, False for
    the feet of a chair; is_level : True for a face, False for a few corners.
    """

    points_m: tuple[Triple, ...]
    outline_m: tuple[Triple, ...]
    middle_m: Triple
    radius_m: float
    is_filled: bool
    is_level: bool


def uneven_m(size_m: float) -> float:
    """Return how uneven a level face may be [m] in a shape whose bounding box has this diagonal."""
    return min(_UNEVEN * size_m, _UNEVEN_M)


def feet_m(size_m: float) -> float:
    """Return how far above the lowest corner others bear as well [m] in a shape with this diagonal."""
    return min(max(_FEET_M, _FEET_SIZES * size_m), _MOST_FEET_M)


def base_face_of(corners: Floats, triangles: Floats, uneven: float, lowest: float, up: Triple) -> BaseFace:
    """Return the base face while the shape's own direction `up` points up: its lowest level face, or its lowest corners
    if that face is tiny.

    Parameters: corners (n, 3), triangles (3, 3, m) of the shape [m]; uneven : see `uneven_m`; lowest : see `feet_m`.
    """
    upwards, plane = _frame(up)
    heights = corners @ upwards
    # Meshes repeat a corner where normals or colours differ.
    least = heights.min()
    bearing = tuple(dict.fromkeys(triples(corners[heights <= least + lowest])))
    if len(bearing) == 1:
        return BaseFace(bearing, bearing, bearing[0], 0.0, False, False)
    corners = np.array(bearing)
    around = corners[outline(corners @ plane)]
    has_face = np.count_nonzero(corners @ upwards <= least + uneven) > 2
    face = _lowest_face(triangles, uneven, upwards, plane) if has_face else None
    if face is not None:
        share = _CRUMB if face.is_filled else 1 - _COVER
        if polygon_area(face.outline_m @ plane) < share * polygon_area(around @ plane):
            face = None
    if face is not None:
        bearing, around = triples(face.corners_m), face.outline_m
    middle = (around.min(axis=0) + around.max(axis=0)) / 2
    radius = float(np.linalg.norm(around - middle, axis=1).max())
    corners_m = triples(around)
    points = tuple([corners_m[row] for row in spread(corners_m)])
    is_filled = face is not None and face.is_filled
    return BaseFace(points, triples(around), triples(middle[None])[0], radius, is_filled, face is not None)


def top_of(triangles: Floats, uneven: float, up: Triple) -> tuple[Triple, ...] | None:
    """Return the convex outline [m] of the highest level face while the shape's own direction `up` points up.

    None if there is no such face, or if it does not fill its outline.
    """
    upwards, plane = _frame(up)
    face = _lowest_face(triangles, uneven, -upwards, plane)
    return triples(face.outline_m) if face is not None and face.is_filled else None


def across(up: Triple) -> Triple:
    """Return a level direction of the shape's frame, which shows its heading while its direction `up` points up."""
    return triples(_frame(up)[1].T[:1])[0]


def _frame(up: Triple) -> tuple[Floats, Floats]:
    """Return the unit vector (3,) along `up`, and two perpendicular ones as columns (3, 2)."""
    frame = np.array(upright_frame(up))
    return frame[2], frame[:2].T.copy()


class _Face(NamedTuple):
    """A level face: its corners (n, 3) and their outline (m, 3) [m]."""

    corners_m: Floats
    outline_m: Floats
    is_filled: bool


def _lowest_face(triangles: Floats, uneven: float, upwards: Floats, plane: Floats) -> _Face | None:
    """Return the lowest level face, None if it has no area, or if only a part of it is level."""
    heights = along(upwards, triangles)
    is_level = highest(heights) <= heights.min() + uneven
    level = triangles[..., is_level]
    a, b, c = np.stack([along(way, level) for way in plane.T], axis=1)
    u, v = b - a, c - a
    area = float(np.abs(u[0] * v[1] - u[1] * v[0]).sum()) / 2
    if area <= 0 or _goes_on(triangles, is_level, _FLAT * uneven, upwards):
        return None
    corners = np.unique(level.reshape(3, -1).T, axis=0)
    rows = outline(corners @ plane)
    around = polygon_area((corners @ plane)[rows])
    # A face drawn from both sides has its area twice.
    is_filled = any(abs(area - n * around) <= _COVER * around for n in (1, 2))
    return _Face(corners, corners[rows], is_filled)


def _goes_on(triangles: Floats, is_level: NDArray[np.bool_], flat: float, upwards: Floats) -> bool:
    """Return True if other triangles lie in the plane of the level ones.

    A flat face that is tilted by about the tolerance has such triangles. Which of its triangles are level depends on
    how the face is cut into triangles.
    """
    a, b, c = triangles[..., is_level].transpose(1, 0, 2)
    normals = cross(b - a, c - a)
    # Triangles may face either way.
    normal = (normals * np.sign(along(upwards, normals))).sum(axis=1)
    depths = along(normal / np.linalg.norm(normal), triangles)
    in_plane = highest(np.abs(depths - depths[:, is_level].mean())) <= flat
    return bool((in_plane & ~is_level).any())


def triples(points: Floats) -> tuple[Triple, ...]:
    """Return points (n, 3) as tuples of floats."""
    return tuple((x, y, z) for x, y, z in points.tolist())


def outline(points: Floats) -> list[int]:
    """Return the rows of the points (n, 2) on their convex hull, counter-clockwise, without collinear points. The hull
    of a single point is that point.

    A point within `_COLLINEAR_M` of the line between its neighbours is collinear. So a side that is cut into pieces has
    no corner where rounding bends it. Collinear points are left out of the finished hull only: before, the neighbours
    of the end of a side may lie on one side of it.

    Source: A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions (1979).
    """
    order, at = np.lexsort((points[:, 1], points[:, 0])).tolist(), points.tolist()
    hull = _corners(order, at, _turns_left)[:-1] + _corners(order[::-1], at, _turns_left)[:-1]
    if len(hull) < 3:
        return hull or order[:1]
    # The point farthest from the middle is no point of a side.
    away = points[hull] - points[hull].mean(axis=0)
    first = int((away * away).sum(axis=1).argmax())
    return _corners([*hull[first:], *hull[: first + 1]], at, _is_beside)[:-1]


def _corners(rows: list[int], at: list[list[float]], is_corner: Callable[..., bool]) -> list[int]:
    """Return the rows of a path that are corners between those kept before and after them, and both ends."""
    kept: list[int] = []
    for row in rows:
        while len(kept) > 1 and not is_corner(at[kept[-2]], at[kept[-1]], at[row]):
            kept.pop()
        kept.append(row)
    return kept


def polygon_area(corners: Floats) -> float:
    """Return the area of a polygon (n, 2)."""
    x, y = corners.T
    return abs(float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())) / 2


def _turns_left(a: list[float], b: list[float], c: list[float]) -> bool:
    """Return True if b is to the right of the line from a to c."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0


def _is_beside(a: list[float], b: list[float], c: list[float]) -> bool:
    """Return True if b is off the straight line between a and c, by more than rounding."""
    u, v, x, y = c[0] - a[0], c[1] - a[1], b[0] - a[0], b[1] - a[1]
    share = min(max((u * x + v * y) / max(u * u + v * v, 1e-300), 0.0), 1.0)
    return math.hypot(x - share * u, y - share * v) > _COLLINEAR_M
