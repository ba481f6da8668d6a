"""What a shape has lowest and highest for a way that is up: the base face that it stands on and the top that bears
others.

Most things stand on level faces, and their contacts follow from flat convex outlines; only the rest needs
triangles. A base face is the lowest of a shape, level or a few corners like the feet of a stool, and a top its highest,
so that wherever they are over each other, nothing of the two shapes is nearer.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scene2hap.contact.spread import spread, spread_few
from scene2hap.contact.vectors import Floats, Triple, along, frame_along, highest

# How uneven a level face may be, as a share of the shape's size and at most (assumed).
_UNEVEN, _UNEVEN_M = 1e-4, 2e-4
# Corners of a thing without a level base face stand with the lowest up to so much above it (assumed: a little more than
# the slack that patches of triangles have, since feet of models are often 1 mm uneven).
_FEET_M = 0.0012
# A face is no base face if it takes up less than this share of what such corners do: a vase may have a crumb of a face
# that is lowest.
_CRUMB = 0.5
_FEW = 24  # So few points are spread sooner in plain numbers.
_COVER = 1e-3  # An outline is filled when its triangles' area differs by less than this share.


class BaseFace(NamedTuple):
    """What a shape stands on, in its own frame [m].

    Up to four `points_m` stand for it; `outline_m` is its convex outline, of one corner or two if there are no more;
    `middle_m` and `radius_m` are a ball around it; `is_filled` if it is all of its outline, as the feet of a chair are
    not; `is_level` if it is a face, and not a few corners.
    """

    points_m: tuple[Triple, ...]
    outline_m: tuple[Triple, ...]
    middle_m: Triple
    radius_m: float
    is_filled: bool
    is_level: bool


def uneven_m(size_m: float) -> float:
    """How uneven a level face of a shape of that diagonal may be [m]."""
    return min(_UNEVEN * size_m, _UNEVEN_M)


def base_face_of(corners: Floats, triangles: Floats, uneven: float, up: Triple) -> BaseFace:
    """What a shape stands on when its own direction `up` points up: the lowest level face, if it is no crumb, or the
    lowest corners.

    Parameters: corners (n, 3), triangles (3, 3, m) of the shape [m]; uneven : see `uneven_m`.
    """
    upwards, plane = _frame(up)
    heights = corners @ upwards
    # Where normals or colours differ, meshes have several corners at one place.
    least = heights.min()
    feet = list(dict.fromkeys(triples(corners[heights <= least + _FEET_M])))
    if len(feet) == 1:
        return BaseFace((feet[0],), (feet[0],), feet[0], 0.0, False, False)
    corners = np.array(feet)
    around = corners[outline(corners @ plane)]
    has_face = np.count_nonzero(corners @ upwards <= least + uneven) > 2
    face = _lowest_face(triangles, uneven, upwards, plane) if has_face else None
    if face is not None and polygon_area(face.outline_m @ plane) < _CRUMB * polygon_area(around @ plane):
        face = None
    if face is not None:
        corners, around = face.corners_m, face.outline_m
    middle = (around.min(axis=0) + around.max(axis=0)) / 2
    radius = float(np.linalg.norm(around - middle, axis=1).max())
    points = triples(corners[spread_few(feet) if face is None and len(feet) <= _FEW else spread(corners.T)])
    is_filled = face is not None and face.is_filled
    return BaseFace(points, triples(around), triples(middle[None])[0], radius, is_filled, face is not None)


def top_of(triangles: Floats, uneven: float, up: Triple) -> tuple[Triple, ...] | None:
    """The convex outline [m] of the highest level face of a shape when its own direction `up` points up, if it is one
    with an outline that it fills."""
    upwards, plane = _frame(up)
    face = _lowest_face(triangles, uneven, -upwards, plane)
    return triples(face.outline_m) if face is not None and face.is_filled else None


def across(up: Triple) -> Triple:
    """A level direction that shows an upright turn, when the own direction `up` points up."""
    return triples(_frame(up)[1].T[:1])[0]


def _frame(up: Triple) -> tuple[Floats, Floats]:
    """The unit vector (3,) along `up`, and two across it as columns (3, 2)."""
    frame = frame_along(up)
    return frame[2], frame[:2].T.copy()


class _Face(NamedTuple):
    """A level face: its corners (n, 3) and their outline (m, 3) [m]."""

    corners_m: Floats
    outline_m: Floats
    is_filled: bool


def _lowest_face(triangles: Floats, uneven: float, upwards: Floats, plane: Floats) -> _Face | None:
    heights = along(upwards, triangles)
    level = triangles[..., highest(heights) <= heights.min() + uneven]
    a, b, c = np.stack([along(way, level) for way in plane.T], axis=1)
    u, v = b - a, c - a
    area = float(np.abs(u[0] * v[1] - u[1] * v[0]).sum()) / 2
    if area <= 0:
        return None
    corners = np.unique(level.reshape(3, -1).T, axis=0)
    rows = outline(corners @ plane)
    around = polygon_area((corners @ plane)[rows])
    # A face drawn from both sides has its area twice.
    is_filled = any(abs(area - n * around) <= _COVER * around for n in (1, 2))
    return _Face(corners, corners[rows], is_filled)


def triples(points: Floats) -> tuple[Triple, ...]:
    """Points (n, 3) as plain numbers."""
    return tuple((x, y, z) for x, y, z in points.tolist())


def outline(points: Floats) -> list[int]:
    """Rows of the points (n, 2) on their convex outline, against the clock; none in line with its neighbours; a single
    point is its own outline.

    Source: A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions (1979).
    """
    order = np.lexsort((points[:, 1], points[:, 0])).tolist()
    at = points.tolist()
    halves: list[list[int]] = []
    for rows in (order, order[::-1]):
        half: list[int] = []
        for row in rows:
            while len(half) > 1 and _turn(at[half[-2]], at[half[-1]], at[row]) <= 0:
                half.pop()
            half.append(row)
        halves.append(half[:-1])
    return halves[0] + halves[1] or order[:1]


def polygon_area(corners: Floats) -> float:
    """Area of a polygon (n, 2)."""
    x, y = corners.T
    return abs(float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())) / 2


def _turn(a: list[float], b: list[float], c: list[float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
