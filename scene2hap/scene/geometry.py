"""Small geometry: vectors as tuples, for which numpy takes ten times longer, axis-aligned boxes, welded points.

Bounds are boxes as arrays (2, n_axes) of the lowest and the highest corner.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common.arrays import Floats, Indices, Ints

Vector = tuple[float, float, float]
Bounds = NDArray[np.float64]
Number = TypeVar("Number", bound=np.generic)

SAME_PLACE = 1e-5
"""Corners and surfaces this close are one, as a share of the mesh's size (assumed: 20 um at a table; float32 rounds by
8 um 200 m from the origin)."""


# Which end a corner of a box has along each axis.
_ENDS = np.indices((2, 2, 2)).reshape(3, 8).T

# A point is on a triangle up to this share of its size beside it, so that rounding opens no joint between two.
_ON_EDGE = 1e-6


def vector(values: Sequence[float] | NDArray[np.floating]) -> Vector:
    """Return three numbers as a tuple of floats."""
    return (float(values[0]), float(values[1]), float(values[2]))


def frozen(array: NDArray[Number]) -> NDArray[Number]:
    """Make an array read-only, and return it. Data that never change keep their cached arrays so."""
    array.flags.writeable = False
    return array


def difference(one: Vector, other: Vector) -> Vector:
    """Return one vector less another."""
    return one[0] - other[0], one[1] - other[1], one[2] - other[2]


def dot(one: Sequence[float], other: Sequence[float]) -> float:
    """Return the dot product of two vectors."""
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]


def cross(one: Sequence[float], other: Sequence[float]) -> Vector:
    """Return the cross product of two vectors."""
    (a, b, c), (d, e, f) = one, other
    return (b * f - c * e, c * d - a * f, a * e - b * d)


def cross_2d(a: Floats, b: Floats) -> Floats:
    """Return the cross products (...) of vectors (..., 2), or of the first two coordinates of longer ones."""
    product: Floats = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product


def heights_at(points: Floats, triangles: Floats) -> Floats:
    """Return the height (n, m) of each triangle at each point (n, 2), -inf beside it or if it is vertical.

    Triangles (m, 3, 3) have two level coordinates, then the height.
    """
    a, b, c = np.moveaxis(triangles, 1, 0)
    to_b, to_c, to_point = b - a, c - a, points[:, None] - a[:, :2]
    area = cross_2d(to_b, to_c)
    with np.errstate(divide="ignore", invalid="ignore"):
        of_b, of_c = cross_2d(to_point, to_c) / area, cross_2d(to_b, to_point) / area
        heights = a[:, 2] + of_b * to_b[:, 2] + of_c * to_c[:, 2]
        is_on = (of_b >= -_ON_EDGE) & (of_c >= -_ON_EDGE) & (of_b + of_c <= 1 + _ON_EDGE)
    return np.where(is_on, heights, -np.inf)


def bounds_of(points: ArrayLike) -> Bounds:
    """Return the bounds of points (n, n_axes), n >= 1."""
    found = np.asarray(points)
    return np.array([found.min(axis=0), found.max(axis=0)], dtype=np.float64)


def joined(bounds: ArrayLike) -> Bounds:
    """Return the bounds (2, n_axes) of several (n, 2, n_axes), n >= 1."""
    found = np.asarray(bounds, dtype=np.float64)
    return np.array([found[:, 0].min(axis=0), found[:, 1].max(axis=0)])


def corners_of(bounds: Bounds) -> Floats:
    """Return the corners (8, 3) of a box (2, 3)."""
    corners: Floats = bounds[_ENDS, (0, 1, 2)]
    return corners


def distances(a: Bounds, b: Bounds) -> Floats:
    """Return the distances (...) of boxes a (..., 2, n_axes) from boxes b, broadcast; 0 where they overlap."""
    gaps = np.maximum(np.maximum(a[..., 0, :] - b[..., 1, :], b[..., 0, :] - a[..., 1, :]), 0.0)
    apart: Floats = np.linalg.norm(gaps, axis=-1)
    return apart


def welded(points: Floats, tolerance: float) -> Ints:
    """Return a number (n,) for each of the points (n, 2 or 3), equal for points in one cell of a grid.

    Cells are as wide as the tolerance, at least a millionth of the points' extent along each axis. They are numbered
    along the first axis, then the next.
    """
    cells = np.round(points / (tolerance or 1.0))  # a mesh in one point has no tolerance
    key, *others = (cells - cells.min(axis=0)).astype(np.int64).T
    # One number of 21 bits for each axis, since numpy sorts rows five times slower.
    for column in others:
        key = (key << 21) | column
    return np.unique(key, return_inverse=True)[1].astype(np.int64)


def counted_up(counts: Indices) -> tuple[Indices, Indices]:
    """Return the number k of each count, `counts[k]` times, and beside it 0, 1, ... up to `counts[k]` - 1."""
    which = np.repeat(np.arange(len(counts)), counts)
    return which, np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
