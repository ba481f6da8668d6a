"""Where short ways through space first meet triangles.

Source: T. Möller, B. Trumbore, Journal of Graphics Tools 2 (1997) 21.
"""

from __future__ import annotations

import numpy as np

from scene2hap.contact.broad import Boxes, Floats, box_pairs

# A way through the edge that two triangles share meets at least one of them; a way along a face meets none.
_RIM, _PARALLEL = 1e-9, 1e-12


def first_hits(start: Floats, way: Floats, triangles: Floats, boxes: Boxes) -> Floats:
    """How far along its way (n,), as a share of it, each first meets one of the triangles (m, 3, 3) in their boxes; inf
    if none. `start` and `way` are (n, 3) [m]."""
    found = np.full(len(start), np.inf)
    end = start + way
    ways = Boxes(np.minimum(start, end), np.maximum(start, end))
    if not len(start) or not len(rows := boxes.meeting(ways.hull())):
        return found
    for i, j in box_pairs(ways, boxes.rows(rows)):
        share = _shares(start[i], way[i], triangles[rows[j]])
        np.minimum.at(found, i, share)
    return found


def _shares(start: Floats, way: Floats, triangles: Floats) -> Floats:
    """The same, way (n, 3) by way, each with a triangle of its own (n, 3, 3)."""
    corner = triangles[:, 0]
    u, v, w = triangles[:, 1] - corner, triangles[:, 2] - corner, start - corner
    across = np.cross(way, v)
    volume = _dot(u, across)
    scale = np.sqrt(_dot(u, u) * _dot(v, v) * _dot(way, way))
    crosses = np.abs(volume) > _PARALLEL * scale
    volume = np.where(crosses, volume, 1.0)
    turned = np.cross(w, u)
    beta, gamma, share = _dot(w, across) / volume, _dot(way, turned) / volume, _dot(v, turned) / volume
    crosses &= (beta >= -_RIM) & (gamma >= -_RIM) & (beta + gamma <= 1 + _RIM) & (share >= 0) & (share <= 1)
    return np.where(crosses, share, np.inf)


def _dot(x: Floats, y: Floats) -> Floats:
    product: Floats = x[:, 0] * y[:, 0] + x[:, 1] * y[:, 1] + x[:, 2] * y[:, 2]
    return product
