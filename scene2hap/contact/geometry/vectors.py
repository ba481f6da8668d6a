"""Vectors with the axes first, (3, ...), so that numpy's inner loops run over many vectors, not over three coordinates.

Sums are spelled out, since numpy adds in another order for a single vector. The bits of a result must not depend on
what else is computed in the same call.
"""

from __future__ import annotations

import math

import numpy as np

from scene2hap.common.arrays import Floats

Triple = tuple[float, float, float]
Rows = tuple[Triple, Triple, Triple]
AABB = tuple[Triple, Triple]
"""Lowest and highest corner of an axis-aligned box [m]."""


def dot(x: Floats, y: Floats) -> Floats:
    """Return the dot products over the first axis, of length 3."""
    products = x * y
    summed: Floats = products[0]
    summed += products[1]
    summed += products[2]
    return summed


def cross(x: Floats, y: Floats) -> Floats:
    """Return the cross products over the first axis, of length 3."""
    (a, b, c), (d, e, f) = x, y
    across = np.empty(np.broadcast_shapes(x.shape, y.shape))
    np.subtract(b * f, c * e, out=across[0])
    np.subtract(c * d, a * f, out=across[1])
    np.subtract(a * e, b * d, out=across[2])
    return across


def along(way: Triple, points: Floats) -> Floats:
    """Return the dot products of points (3, ...) with one vector."""
    x, y, z = way
    lengths: Floats = x * points[0]
    lengths += y * points[1]
    lengths += z * points[2]
    return lengths


def lowest(rows: Floats) -> Floats:
    """Return the minimum of three rows (3, ...); numpy's own reduction is slow along short axes."""
    found: Floats = np.minimum(np.minimum(rows[0], rows[1]), rows[2])
    return found


def highest(rows: Floats) -> Floats:
    """Return the maximum of three rows (3, ...)."""
    found: Floats = np.maximum(np.maximum(rows[0], rows[1]), rows[2])
    return found


def upright_frame(up: Triple) -> Rows:
    """Return an orthonormal frame as rows: two directions perpendicular to `up`, and `up`."""
    x, y, z = up
    length = math.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    # Perpendicular to the axis that is farthest from up, which keeps the length from 0.
    if abs(x) <= abs(y) and abs(x) <= abs(z):
        a, b, c = 0.0, z, -y
    elif abs(y) <= abs(z):
        a, b, c = -z, 0.0, x
    else:
        a, b, c = y, -x, 0.0
    length = math.sqrt(a * a + b * b + c * c)
    a, b, c = a / length, b / length, c / length
    return ((a, b, c), (y * c - z * b, z * a - x * c, x * b - y * a), (x, y, z))


def rotated(rows: Rows, point: Triple) -> Triple:
    """Return a matrix, given as rows, times a vector."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    x, y, z = point
    return (a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z)


def transposed(rows: Rows) -> Rows:
    """Return the transpose of a matrix, given as rows."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    return ((a, d, g), (b, e, h), (c, f, i))
