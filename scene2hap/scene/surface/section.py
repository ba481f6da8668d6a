"""Section of a mesh: the rings in which its triangles cross a plane."""

from __future__ import annotations

import numpy as np

from scene2hap.common.arrays import Floats, Indices
from scene2hap.scene.geometry import SAME_PLACE, welded
from scene2hap.scene.surface.outline import MOST_CORNERS, Outline
from scene2hap.scene.surface.rays import cut

_TOLERANCE = 1e-3  # of the size: corners whose removal changes the ring by less are left out


def section_outline(triangles_m: Floats, level_m: float) -> Outline | None:
    """Return the outline in which triangles (3, 3, m), axes by corners, cross the plane z = `level_m` [m].

    It is the largest ring with the holes in it. None if the mesh is not closed there.
    """
    ends = cut(triangles_m, level_m).reshape(2, -1).T
    if not len(ends):
        return None
    size = float(np.ptp(triangles_m, axis=(1, 2)).max())
    number = welded(ends, SAME_PLACE * size)
    n_corners = int(number.max()) + 1
    rings = _rings(number.reshape(2, -1), n_corners)
    if not rings:
        return None
    places = np.empty((n_corners, 2))
    places[number] = ends
    found = sorted((_simplified(places[ring], _TOLERANCE * size) for ring in rings), key=_area_m2, reverse=True)
    found = [ring for ring in found if len(ring) >= 3 and _area_m2(ring) > (10 * _TOLERANCE * size) ** 2]
    if not found or sum(map(len, found)) > MOST_CORNERS:
        return None
    largest = Outline(found[:1])
    holes = [ring for ring in found[1:] if largest.holds(ring[:1])[0]]
    return Outline((*largest.rings_m, *holes))


def _rings(segments: Indices, n_corners: int) -> list[Indices]:
    """Return closed rings of corners from segments (2, n). No ring if any corner is not the end of exactly two
    segments."""
    segments = np.unique(np.sort(segments[:, segments[0] != segments[1]], axis=0), axis=1)
    at, meets = np.unique(segments, return_counts=True)
    if not len(at) or (meets != 2).any():
        return []
    order = np.argsort(segments.ravel(), kind="stable")
    beside = np.full((n_corners, 2), -1)
    beside[at] = segments[::-1].ravel()[order].reshape(-1, 2)
    left, rings = set(at.tolist()), []
    while left:
        first = ring_end = min(left)
        before, ring = int(beside[first, 0]), []
        while True:
            ring.append(ring_end)
            left.discard(ring_end)
            one, other = beside[ring_end].tolist()
            before, ring_end = ring_end, other if one == before else one
            if ring_end == first:
                break
        rings.append(np.array(ring))
    return rings


def _simplified(ring: Floats, tolerance_m: float) -> Floats:
    """Return the ring without corners that are within the tolerance of the remaining ring.

    Source: D. Douglas, T. Peucker, Cartographica 10 (1973) 112.
    """
    far = int(np.linalg.norm(ring - ring[0], axis=1).argmax())
    kept, open_ = {0, far}, [(0, far), (far, len(ring))]
    closed = np.concatenate([ring, ring[:1]])
    while open_:
        a, b = open_.pop()
        way = closed[b] - closed[a]
        off = closed[a + 1 : b] - closed[a]
        if not len(off):
            continue
        share = (off @ way / max(float(way @ way), 1e-300)).clip(0.0, 1.0)
        beside = np.linalg.norm(off - share[:, None] * way, axis=1)
        if beside.max() > tolerance_m:
            middle = a + 1 + int(beside.argmax())
            kept.add(middle)
            open_ += [(a, middle), (middle, b)]
    return ring[sorted(kept)]


def _area_m2(ring: Floats) -> float:
    x, y = ring.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2
