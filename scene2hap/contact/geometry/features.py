"""The corners and edges of a mesh that the narrow phase tests: each once, and none inside a flat face.

Two surfaces are nearest at a corner or an edge of one of them. A shared corner or edge is tested for its first triangle
only. A diagonal of a flat face, or a corner inside it, is never nearer than the face itself.

Source: S. Curtis, R. Tamstorf, D. Manocha, Fast collision detection for deformable models using representative
triangles (I3D 2008).

    edge : 3 t + k from corner k of triangle t to the next; its opposite is the corner after that
    twins : all edges between the same two points
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Bools, Floats, Indices
from scene2hap.contact.geometry.vectors import cross, dot

Features = NDArray[np.uint8]
"""Bits of each triangle (m,): bit k for its edge from corner k to the next, bit 3 + k for its corner k."""

# How uneven a flat face may be [m]: the rounding of float32 for coordinates of some metres.
_FLAT_M = 1e-6
# Squared sine of a triangle's first angle below which its edges are kept. In so slender a triangle rounding (2e-16 over
# this, in barycentric units) could place a point over neither triangle.
_SLENDER = 1e-6


def features_of(triangles: Floats) -> Features:
    """Return the features (m,) to test for triangles (3, 3, m)."""
    n_edges = 3 * triangles.shape[2]
    if n_edges == 0:
        return np.zeros(0, dtype=np.uint8)
    points = triangles.transpose(0, 2, 1).reshape(3, n_edges)
    corners = _welded(points)
    twins = _SharedEdges.of(corners)
    kept = twins.first[~_are_flat(points, twins)]
    marks = np.zeros(n_edges, dtype=np.uint8)
    marks[kept] = 1 << (kept % 3)
    # A corner counts if it is the end of a kept edge.
    is_end = np.zeros(n_edges, dtype=bool)
    is_end[corners[kept]] = is_end[corners[_next(kept)]] = True
    numbers, owners = np.unique(corners, return_index=True)
    owners = owners[is_end[numbers]]
    marks[owners] |= (8 << (owners % 3)).astype(np.uint8)
    found: Features = np.bitwise_or.reduce(marks.reshape(-1, 3), axis=1)
    return found


class _SharedEdges(NamedTuple):
    """Edges grouped by their two end points.

    edges : (3 m,) group by group, the lowest edge first; begins : (n,) start of each group in `edges`; group : (3 m,)
    the group of each entry of `edges`.
    """

    edges: Indices
    begins: Indices
    group: Indices

    @classmethod
    def of(cls, corners: Indices) -> _SharedEdges:
        """Group the edges that start at welded corners (3 m,)."""
        ends = corners[_next(np.arange(len(corners)))]
        keys = np.minimum(corners, ends) * len(corners) + np.maximum(corners, ends)
        edges = np.argsort(keys, kind="stable")
        is_new = np.diff(keys[edges], prepend=-1) != 0
        return cls(edges, np.flatnonzero(is_new), np.cumsum(is_new) - 1)

    @property
    def first(self) -> Indices:
        """The lowest edge (n,) of each group."""
        return self.edges[self.begins]


def _are_flat(points: Floats, twins: _SharedEdges) -> Bools:
    """Mark the groups (n,) of twins that lie inside a flat face, with triangles on both sides."""
    a, b, c = points[:, ::3], points[:, 1::3], points[:, 2::3]
    normals = cross(b - a, c - a)
    area2 = dot(normals, normals)
    is_slender = area2 <= _SLENDER * dot(b - a, b - a) * dot(c - a, c - a)
    normals /= np.sqrt(np.where(area2 > 0, area2, 1.0))
    first = twins.first
    normal, start = normals[:, first // 3], points[:, first]
    inwards = cross(normal, points[:, _next(first)] - start)
    way = points[:, _next(_next(twins.edges))] - start[:, twins.group]
    height, side = np.abs(dot(way, normal[:, twins.group])), dot(way, inwards[:, twins.group])
    flat: Bools = (
        (np.maximum.reduceat(height, twins.begins) <= _FLAT_M)
        & (np.minimum.reduceat(side, twins.begins) < 0)
        & ~np.logical_or.reduceat(is_slender[twins.edges // 3], twins.begins)
    )
    # A finely triangulated curve bends by less than `_FLAT_M` at each edge, so whole faces are checked as well.
    face = _faces(twins, flat, len(area2))
    order = np.lexsort((-area2, face))
    largest = order[np.flatnonzero(np.diff(face[order], prepend=-1))][face]
    away = np.abs(dot(points - np.repeat(a[:, largest], 3, axis=1), np.repeat(normals[:, largest], 3, axis=1)))
    is_bent = np.zeros(len(area2), dtype=bool)
    is_bent[face[np.flatnonzero(away > _FLAT_M) // 3]] = True
    return flat & ~is_bent[face[first // 3]]


def _faces(twins: _SharedEdges, flat: Bools, n_triangles: int) -> Indices:
    """Return the face number (m,) of each triangle; flat edges join triangles into faces."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    joined = flat[twins.group]
    ends = (twins.edges[joined] // 3, twins.first[twins.group[joined]] // 3)
    links = coo_array((np.ones(len(ends[0])), ends), shape=(n_triangles, n_triangles))
    faces: Indices = connected_components(links, directed=False)[1].astype(np.intp)
    return faces


def _welded(points: Floats) -> Indices:
    """Return a number (n,) for each of the points (3, n), equal for equal points."""
    order = np.lexsort(points)
    is_new = (np.diff(points[:, order], axis=1) != 0).any(axis=0)
    numbers = np.empty(points.shape[1], dtype=np.intp)
    numbers[order] = np.concatenate([[0], np.cumsum(is_new)])
    return numbers


def _next(edges: Indices) -> Indices:
    """Return the next edge of the same triangle for each edge."""
    return edges + np.where(edges % 3 == 2, -2, 1)
