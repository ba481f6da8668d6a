"""The points of triangles that are nearest to given points, and the sides on which the given points lie.

Source: C. Ericson, Real-Time Collision Detection (2005), sections 5.1.2 (segments) and 5.1.5 (triangles). Differs: the
nearest point is the foot on the plane if it lies inside the triangle, else on one of the edges.

    p : (3, n) float64 [m], the given points; triangles : (3, 3, n) float64 [m], axes, corners, and the triangle of each
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.contact.geometry.vectors import cross, dot


class Nearest(NamedTuple):
    """The nearest points (3, n) [m], their distances (n,) [m], and the heights (n,) of the given points over the planes
    [m], above 0 where the triangle's corners are counter-clockwise."""

    points: Floats
    distances: Floats
    heights: Floats


def nearest_points(p: Floats, triangles: Floats) -> Nearest:
    """Return the nearest point of each triangle to its given point. A triangle without area has height 0."""
    edges = np.roll(triangles, -1, axis=1) - triangles
    to_p = p[:, None] - triangles
    lengths2 = dot(edges, edges)
    shares = np.divide(dot(to_p, edges), lengths2, out=np.zeros_like(lengths2), where=lengths2 > 0.0)
    beside = to_p - np.clip(shares, 0.0, 1.0) * edges
    to_edges = np.sqrt(dot(beside, beside))
    normals = cross(edges[:, 0], edges[:, 1])
    areas = np.sqrt(dot(normals, normals))
    has_area = areas > 0.0
    units = np.divide(normals, areas, out=np.zeros_like(normals), where=has_area)
    heights = dot(to_p[:, 0], units)
    is_over = (dot(cross(edges, to_p), normals[:, None]) >= 0.0).all(axis=0) & has_area
    nearest_edge = to_edges.argmin(axis=0)
    columns = np.arange(len(heights))
    away = np.where(is_over, heights * units, beside[:, nearest_edge, columns])
    return Nearest(p - away, np.where(is_over, np.abs(heights), to_edges[nearest_edge, columns]), heights)
