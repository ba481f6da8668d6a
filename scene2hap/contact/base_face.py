"""Base face and top face of a shape: its lowest and highest level face for a given direction of up.

Most objects stand on level faces. Their contacts follow from convex outlines; only the others need triangles. A base
face is a shape's lowest face, or its lowest corners, like the feet of a stool. A top face is its highest face. Where
the two overlap in plan, no other parts of the two shapes are nearer.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats
from scene2hap.contact.geometry.level_plane import Point, turned_outline
from scene2hap.contact.geometry.spread import spread
from scene2hap.contact.geometry.vectors import Rows, Triple, along, cross, highest, upright_frame

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
    frame = upright_frame(up)
    bearing = _lowest_corners(corners, lowest, frame)
    corners_m = tuple(bearing)
    if len(corners_m) == 1:
        return BaseFace(corners_m, corners_m, corners_m[0], 0.0, False, False)
    around, area = _outlined(corners_m, frame)
    face = _lowest_face(bearing, triangles, uneven, frame)
    if face is not None and face.area_m2 < area * (_CRUMB if face.is_filled else 1 - _COVER):
        face = None
    if face is not None:
        around = face.outline_m
    x, y, z = [(min(row) + max(row)) / 2 for row in zip(*around, strict=True)]
    radius = max([math.dist(corner, (x, y, z)) for corner in around])
    points = tuple([around[row] for row in spread(around)])
    return BaseFace(points, around, (x, y, z), radius, face is not None and face.is_filled, face is not None)


def top_of(corners: Floats, triangles: Floats, uneven: float, up: Triple) -> tuple[Triple, ...] | None:
    """Return the convex outline [m] of the highest level face while the shape's own direction `up` points up.

    None if there is no such face, or if it does not fill its outline.
    """
    u, v, (x, y, z) = upright_frame(up)
    frame = (u, v, (-x, -y, -z))
    face = _lowest_face(_lowest_corners(corners, uneven, frame), triangles, uneven, frame)
    return face.outline_m if face is not None and face.is_filled else None


def across(up: Triple) -> Triple:
    """Return a level direction of the shape's frame, which shows its heading while its direction `up` points up."""
    return upright_frame(up)[0]


def _lowest_corners(corners: Floats, within: float, frame: Rows) -> dict[Triple, float]:
    """Return the corners (n, 3) up to `within` above the lowest one, and how far; a corner that meshes repeat, once."""
    heights = corners @ frame[2]
    heights -= heights.min()
    rows = np.flatnonzero(heights <= within)
    return dict(zip(triples(corners[rows]), heights[rows].tolist(), strict=True))


class _Face(NamedTuple):
    """A level face: its outline [m], the area of that [m2], and whether the face fills it."""

    outline_m: tuple[Triple, ...]
    area_m2: float
    is_filled: bool


def _lowest_face(lowest: Mapping[Triple, float], triangles: Floats, uneven: float, frame: Rows) -> _Face | None:
    """Return the lowest level face, None if it has no area, or if only a part of it is level.

    Parameters: lowest : the lowest corners and their heights, at least those up to `uneven`.
    """
    if sum([height <= uneven for height in lowest.values()]) < 3:  # as of most shapes that tumble
        return None
    heights = along(frame[2], triangles)
    is_level = highest(heights) <= heights.min() + uneven
    level = triangles[..., is_level]
    a, b, c = np.stack([along(way, level) for way in frame[:2]], axis=1)
    u, v = b - a, c - a
    area = float(np.abs(u[0] * v[1] - u[1] * v[0]).sum()) / 2
    if area <= 0 or _goes_on(triangles, is_level, _FLAT * uneven, frame[2]):
        return None
    around, filled = _outlined(tuple(dict.fromkeys(triples(level.reshape(3, -1).T))), frame)
    # A face drawn from both sides has its area twice.
    return _Face(around, filled, any(abs(area - n * filled) <= _COVER * filled for n in (1, 2)))


def _outlined(corners: tuple[Triple, ...], frame: Rows) -> tuple[tuple[Triple, ...], float]:
    """Return the convex outline of corners in the level plane of a frame, and its area [m2]."""
    plan = turned_outline(corners, frame[0], frame[1])
    rows = outline(plan)
    sides = [(*plan[row], *plan[before]) for row, before in zip(rows, [rows[-1], *rows], strict=False)]
    return tuple([corners[row] for row in rows]), abs(sum([a * d - b * c for a, b, c, d in sides])) / 2


def _goes_on(triangles: Floats, is_level: NDArray[np.bool_], flat: float, upwards: Triple) -> bool:
    """Return True if other triangles lie in the plane of the level ones.

    A flat face that is tilted by about the tolerance has such triangles. Which of its triangles are level depends on
    how the face is cut into triangles.
    """
    a, b, c = triangles[..., is_level].transpose(1, 0, 2)
    normals = cross(b - a, c - a)
    # Triangles may face either way.
    normal = (normals * np.sign(along(upwards, normals))).sum(axis=1)
    depths = along((normal / np.linalg.norm(normal)).tolist(), triangles)
    in_plane = highest(np.abs(depths - depths[:, is_level].mean())) <= flat
    return bool((in_plane & ~is_level).any())


def triples(points: Floats) -> tuple[Triple, ...]:
    """Return points (n, 3) as tuples of floats."""
    return tuple([(x, y, z) for x, y, z in points.tolist()])


def outline(points: Sequence[Point]) -> list[int]:
    """Return the rows of the points on their convex hull, counter-clockwise, without collinear points. The hull
    of a single point is that point.

    A point within `_COLLINEAR_M` of the line between its neighbours is collinear. So a side that is cut into pieces has
    no corner where rounding bends it. Collinear points are left out of the finished hull only: before, the neighbours
    of the end of a side may lie on one side of it.

    Source: A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions (1979).
    """
    order = sorted(range(len(points)), key=points.__getitem__)
    hull = _corners(order, points, _turns_left)[:-1] + _corners(order[::-1], points, _turns_left)[:-1]
    if len(hull) < 3:
        return hull or order[:1]
    # The point farthest from the middle is no point of a side.
    middle = [sum(ends) / len(hull) for ends in zip(*[points[row] for row in hull], strict=True)]
    first = max(range(len(hull)), key=lambda k: math.dist(points[hull[k]], middle))
    return _corners([*hull[first:], *hull[: first + 1]], points, _is_beside)[:-1]


def _corners(rows: list[int], at: Sequence[Point], is_corner: Callable[..., bool]) -> list[int]:
    """Return the rows of a path that are corners between those kept before and after them, and both ends."""
    kept: list[int] = []
    for row in rows:
        while len(kept) > 1 and not is_corner(at[kept[-2]], at[kept[-1]], at[row]):
            kept.pop()
        kept.append(row)
    return kept


def _turns_left(a: Point, b: Point, c: Point) -> bool:
    """Return True if b is to the right of the line from a to c."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0


def _is_beside(a: Point, b: Point, c: Point) -> bool:
    """Return True if b is off the straight line between a and c, by more than rounding."""
    u, v, x, y = c[0] - a[0], c[1] - a[1], b[0] - a[0], b[1] - a[1]
    share = min(max((u * x + v * y) / max(u * u + v * v, 1e-300), 0.0), 1.0)
    return math.hypot(x - share * u, y - share * v) > _COLLINEAR_M
