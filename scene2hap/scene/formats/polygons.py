"""Triangulation of faces with any number of corners.

A face is cut as a fan from its first corner if all triangles of the fan have one orientation, as in convex faces. A
concave quadrilateral is cut as a fan from its second corner, any other concave face by ear clipping.

Source: Meisters, "Polygons have ears", American Mathematical Monthly 82(6), 1975; Newell's normal as in Foley et al.,
"Computer Graphics: Principles and Practice", 2nd edition, section 11.1.3.
"""

from __future__ import annotations

import numpy as np

from scene2hap.common.arrays import Bools, Floats, Ints
from scene2hap.scene.geometry import cross_2d

MAX_EAR_CORNERS = 512
"""A concave face of more corners is cut as a fan (assumed; time grows with the square)."""
_MAX_EAR_WORK = 4_000_000
# A triangle of a fan may have the opposite orientation by this share of its face's area, due to rounding.
_ROUNDING = 1e-7


def triangulated(points: Floats, counts: Ints, indices: Ints) -> tuple[Ints, Ints]:
    """Return the triangles of faces.

    Parameters: points (n, 3); counts (k,) : corners of each face; indices (sum of counts,) : the point at each corner.
    Returns: (m, 3) corners as positions in `indices`, and (m,) the face of each triangle, in the order of the faces.
        Faces of fewer than three corners give no triangles.
    """
    starts = np.cumsum(counts) - counts
    corners, faces = [np.zeros((0, 3), np.int64)], [np.zeros(0, np.int64)]
    work = 0
    for n in np.unique(counts[counts >= 3]).tolist():
        rows = np.flatnonzero(counts == n)
        fan = np.stack((np.zeros(n - 2, np.int64), np.arange(1, n - 1), np.arange(2, n)), axis=1)
        order = np.broadcast_to(fan, (len(rows), n - 2, 3))
        if n > 3:
            outlines = points[indices[starts[rows][:, None] + np.arange(n)]]
            order, concave = order.copy(), np.flatnonzero(~_is_fan(outlines))
            for row in concave.tolist():
                work += n * n
                if n == 4:
                    order[row] = (fan + 1) % 4
                elif n <= MAX_EAR_CORNERS and work <= _MAX_EAR_WORK:
                    order[row] = _ears(_flat(outlines[row]))
        corners.append((order + starts[rows][:, None, None]).reshape(-1, 3))
        faces.append(np.repeat(rows, n - 2))
    face_of = np.concatenate(faces)
    by_face = np.argsort(face_of, kind="stable")
    return np.concatenate(corners)[by_face], face_of[by_face]


def _normals(outlines: Floats) -> Floats:
    """Return Newell's normals (k, 3) of outlines (k, n, 3); their length is twice the area."""
    spokes = outlines - outlines[:, :1]
    normals: Floats = _cross_3d(spokes[:, :-1], spokes[:, 1:]).sum(axis=1)
    return normals


def _is_fan(outlines: Floats) -> Bools:
    """Return a mask of the outlines (k,) whose triangles from the first corner all have the outline's orientation."""
    with np.errstate(all="ignore"):
        spokes, normals = outlines - outlines[:, :1], _normals(outlines)
        areas = np.einsum("kni,ki->kn", _cross_3d(spokes[:, 1:-1], spokes[:, 2:]), normals)
        whole = np.einsum("ki,ki->k", normals, normals)
        # Faces without area, or with NaN coordinates, stay fans.
        is_fan: Bools = ~(areas < -_ROUNDING * whole[:, None]).any(axis=1)
    return is_fan


def _flat(outline: Floats) -> Floats:
    """Return an outline (n, 3) in its own plane (n, 2), counter-clockwise."""
    normal = _normals(outline[None])[0]
    drop = int(np.abs(normal).argmax())
    flat = outline[:, [(drop + 1) % 3, (drop + 2) % 3]]
    return flat if normal[drop] > 0 else flat * [1.0, -1.0]


def _ears(outline: Floats) -> Ints:
    """Return the triangles (n - 2, 3) of a counter-clockwise outline (n, 2). If it crosses itself, the rest is cut as a
    fan."""
    left = list(range(len(outline)))
    triangles = []
    while len(left) > 3:
        points = outline[left]
        before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
        turns = cross_2d(points - before, after - points)
        reflex = np.flatnonzero(turns <= 0)
        for at in np.flatnonzero(turns > 0).tolist():
            a, b, c = before[at], points[at], after[at]
            near = reflex[(reflex != (at - 1) % len(left)) & (reflex != (at + 1) % len(left))]
            p = points[near]
            if not (
                (cross_2d(b - a, p - a) >= 0) & (cross_2d(c - b, p - b) >= 0) & (cross_2d(a - c, p - c) >= 0)
            ).any():
                break
        else:
            break
        triangles.append((left[at - 1], left[at], left[(at + 1) % len(left)]))
        del left[at]
    triangles += [(left[0], left[i], left[i + 1]) for i in range(1, len(left) - 1)]
    return np.array(triangles, np.int64)


def _cross_3d(a: Floats, b: Floats) -> Floats:
    # Five times faster than numpy's own function, which matters for thousands of small meshes.
    product: Floats = a[..., [1, 2, 0]] * b[..., [2, 0, 1]] - a[..., [2, 0, 1]] * b[..., [1, 2, 0]]
    return product
