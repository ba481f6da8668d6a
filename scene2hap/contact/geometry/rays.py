"""Intersection of many short line segments with triangles.

Source: T. Möller, B. Trumbore, Journal of Graphics Tools 2 (1997) 21.
"""

from __future__ import annotations

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.contact.geometry.boxes import Boxes, box_pairs
from scene2hap.contact.geometry.vectors import cross, dot

# A segment through the shared edge of two triangles must hit at least one of them; a segment along a face hits none.
_RIM, _PARALLEL = 1e-9, 1e-12


def first_hits(start: Floats, way: Floats, triangles: Floats, boxes: Boxes) -> Floats:
    """Return the first hit of each segment with the triangles (3, 3, m), as a share (n,) of its length; inf for none.

    Parameters: start, way : start point and vector of each segment, (3, n) [m]; boxes : those of the triangles.
    """
    n = start.shape[1]
    found = np.full(n, np.inf)
    end = start + way
    ways = Boxes(np.minimum(start, end), np.maximum(start, end))
    if not n or not len(columns := boxes.meeting(ways.hull())):
        return found
    for i, j in box_pairs(ways, boxes.some(columns)):
        share = _shares(start.take(i, axis=1), way.take(i, axis=1), triangles.take(columns[j], axis=2))
        np.minimum.at(found, i, share)
    return found


def _shares(start: Floats, way: Floats, triangles: Floats) -> Floats:
    """Return the shares (n,) at which segments k hit triangles k (3, 3, n); inf for a miss."""
    corner = triangles[:, 0]
    u, v, w = triangles[:, 1] - corner, triangles[:, 2] - corner, start - corner
    across = cross(way, v)
    volume = dot(u, across)
    scale = np.sqrt(dot(u, u) * dot(v, v) * dot(way, way))
    crosses = np.abs(volume) > _PARALLEL * scale
    volume = np.where(crosses, volume, 1.0)
    beside = cross(w, u)
    beta, gamma, share = dot(w, across) / volume, dot(way, beside) / volume, dot(v, beside) / volume
    crosses &= (beta >= -_RIM) & (gamma >= -_RIM) & (beta + gamma <= 1 + _RIM) & (share >= 0) & (share <= 1)
    return np.where(crosses, share, np.inf)
