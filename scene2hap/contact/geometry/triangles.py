"""Triangles, many at once: distances of pairs, distances to points, and hits by segments.

The nearest points of two triangles are a vertex and a point inside the other face, points on two edges, or the point
where an edge intersects the other triangle. All of these local meetings are returned. Where faces lie on each other,
they include the corners of the contact patch, which a single nearest point would miss. Only the `features` of meshes
are tested.

Two surfaces that nearly lie on each other also cross somewhere, and a rotation of 0.1 mrad moves that crossing from one
end to the other. A crossing of an edge is therefore *loose*, and no contact point, if it lies between two others: both
ends of the edge are within reach of the face, or the edges are within reach of each other on both sides of it.

Source: C. Ericson, Real-Time Collision Detection (2005), section 5.1.9 (segments), 5.1.10 (triangles), 3.4 (barycentric
coordinates), 5.1.2 and 5.1.5 (points). Differs: a vertex is only measured against the inside of a face; its edges are
left to the segments. Hits by segments: T. Möller, B. Trumbore, Journal of Graphics Tools 2 (1997) 21.

    p, q : (3, 3, n) float64 [m], axes, corners, and last the triangles, of which p[..., k] and q[..., k] are a pair
    s, t : place on an edge of p, of q, 0..1 [-]
    h    : height over the other triangle's plane, in units of its normal's length
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Bools, Floats
from scene2hap.contact.geometry.boxes import Boxes, box_pairs
from scene2hap.contact.geometry.features import Features
from scene2hap.contact.geometry.vectors import cross, dot

# Squared sine below which edges count as parallel and corners as collinear, since the result would be rounding noise;
# and share below which a segment is along a face, which it does not hit.
_PARALLEL = 1e-12
# Points this little outside a triangle (in barycentric units) count as inside, or a corner on a shared edge is missed,
# and a segment passes between the two triangles.
_RIM = 1e-9
_IN_PLANE_M = 1e-9
_N_MEETINGS = 21
_BITS = (1 << np.arange(6)).astype(np.uint8)


class Meetings(NamedTuple):
    """The m local meetings of n pairs: distance (m, n) [m], inf for none, and both end points (3, m, n) [m]."""

    distance: Floats
    on_p: Floats
    on_q: Floats


def meetings(p: Floats, q: Floats, of_p: Features, of_q: Features, loose: float = -1.0) -> Meetings:
    """Return the 21 local meetings of each pair (3, 3, n), limited to their features (n,).

    Nine are of two edges, six of a vertex and a face, six of an edge that intersects a face. Loose crossings are left
    out: those between ends within `loose` [m]; by default none.
    """
    n = p.shape[2]
    every = Meetings(np.empty((_N_MEETINGS, n)), np.empty((3, _N_MEETINGS, n)), np.empty((3, _N_MEETINGS, n)))
    _fill(every, 0, _edges_with_edges(p, q, loose))
    # Both directions at once, p's corners at q's faces and q's at p's: numpy's cost is per call on few triangles.
    faces = _Faces.of(np.concatenate([q, p], axis=2), np.concatenate([p, q], axis=2))
    for first, (distance, points, feet) in ((9, faces.meet_vertices()), (15, faces.meet_edges(loose))):
        _fill(every, first, Meetings(distance[:, :n], points[..., :n], feet[..., :n]))
        _fill(every, first + 3, Meetings(distance[:, n:], feet[..., n:], points[..., n:]))
    edges_p, corners_p = _present(of_p)
    edges_q, corners_q = _present(of_q)
    of_edges = (edges_p[:, None] & edges_q[None]).reshape(9, n)
    present = np.concatenate([of_edges, corners_p, corners_q, edges_p, edges_q])
    every.distance[~present] = np.inf
    return every


def heights(p: Floats, q: Floats) -> tuple[Floats, Floats]:
    """Return the least and greatest height (n,) [m] of p over q (3, 3, n) along the third axis, where they overlap in
    plan; (inf, -inf) if they do not.

    The height is linear over the common projection, so its extremes are at the corners of the projection: vertices of
    either triangle or crossings of edges.
    """
    n = p.shape[2]
    found = np.empty((15, n))
    over = _over(np.concatenate([p, q], axis=2), np.concatenate([q, p], axis=2))
    found[:3] = over[:, :n]
    np.negative(over[:, n:], out=found[3:6])
    found[6:] = _over_crossings(p, q)
    return np.fmin.reduce(found, axis=0, initial=np.inf), np.fmax.reduce(found, axis=0, initial=-np.inf)


class Nearest(NamedTuple):
    """The nearest points (3, n) [m], their distances (n,) [m], and the heights (n,) of the given points over the planes
    [m], above 0 where the triangle's corners are counter-clockwise."""

    points: Floats
    distances: Floats
    heights: Floats


def nearest_points(p: Floats, triangles: Floats) -> Nearest:
    """Return the nearest point of each triangle (3, 3, n) to its given point (3, n) [m].

    It is the foot on the plane if that is inside the triangle, else on one of the edges. A triangle without area has
    height 0.
    """
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
        share = _hit_shares(start.take(i, axis=1), way.take(i, axis=1), triangles.take(columns[j], axis=2))
        np.minimum.at(found, i, share)
    return found


class _Faces(NamedTuple):
    """The planes of triangles, and the heights of other triangles' corners over them; nan for a face without area.

    origin, u, v, normal : (3, n); dots : (3, n) of u u, u v and v v; area2 : (n,) square of the normal's length;
    corners : (3, 3, n) of the other triangles; height : (3, n) [-].
    """

    origin: Floats
    u: Floats
    v: Floats
    normal: Floats
    dots: Floats
    area2: Floats
    corners: Floats
    height: Floats

    @classmethod
    def of(cls, faces: Floats, corners: Floats) -> _Faces:
        """Compute the planes of faces (3, 3, n), and the heights over them of the corners (3, 3, n) of others."""
        origin = faces[:, 0]
        u, v = faces[:, 1] - origin, faces[:, 2] - origin
        normal = cross(u, v)
        dots = np.stack([dot(u, u), dot(u, v), dot(v, v)])
        uu, uv, vv = dots
        both = uu * vv
        area2 = both - uv * uv
        area2 = np.where(area2 > _PARALLEL * both, area2, np.nan)
        height = dot(corners - origin[:, None], normal[:, None])
        height /= area2
        return cls(origin, u, v, normal, dots, area2, corners, height)

    def meet_vertices(self) -> Meetings:
        """Return the meetings of the others' corners with the inside of the faces."""
        feet = self.corners - self.height * self.normal[:, None]
        distance = np.where(self._inside(self.corners), np.abs(self.height) * np.sqrt(self.area2), np.inf)
        return Meetings(distance, self.corners, feet)

    def meet_edges(self, loose: float) -> Meetings:
        """Return the points where the others' edges intersect the faces, but not between ends within `loose`."""
        start, end = self.height, _next(self.height, 0)
        # An edge in the plane, up to rounding, has no reliable crossing. Its vertices give the meeting instead.
        length = np.sqrt(self.area2)
        in_plane = _IN_PLANE_M / length
        crosses = (start * end < 0) & (np.abs(start) > in_plane) & (np.abs(end) > in_plane)
        crosses &= (np.abs(start) * length > loose) | (np.abs(end) * length > loose)
        s = start / np.where(crosses, start - end, 1.0)
        points = _next(self.corners, 1)
        points -= self.corners
        points *= s
        points += self.corners
        distance = np.where(crosses & self._inside(points), 0.0, np.inf)
        return Meetings(distance, points, points)

    def _inside(self, points: Floats) -> Bools:
        """Mark the points (3, m, n) that are inside their faces when projected along the normal."""
        uu, uv, vv = self.dots
        w = points - self.origin[:, None]
        wu, wv = dot(w, self.u[:, None]), dot(w, self.v[:, None])
        beta = (vv * wu - uv * wv) / self.area2
        gamma = (uu * wv - uv * wu) / self.area2
        within: Bools = (beta >= -_RIM) & (gamma >= -_RIM) & (beta + gamma <= 1 + _RIM)
        return within


def _present(features: Features) -> tuple[Bools, Bools]:
    """Return marks (3, n) of the edges, and of the corners, that are among the features (n,)."""
    present = (features & _BITS[:, None]) != 0
    return present[:3], present[3:]


def _fill(every: Meetings, first: int, some: Meetings) -> None:
    last = first + len(some.distance)
    every.distance[first:last], every.on_p[:, first:last], every.on_q[:, first:last] = some


def _next(corners: Floats, axis: int) -> Floats:
    """Return the next corner for each corner."""
    return corners.take([1, 2, 0], axis=axis)


def _edges_with_edges(p: Floats, q: Floats, loose: float) -> Meetings:
    """Return the nearest points of all nine pairs of edges; on parallel edges, at the start of p's edge if possible.

    Points inside both edges are left out where the edges are within `loose` of each other on both sides of them.
    """
    d, g = (_next(p, 1) - p)[:, :, None], (_next(q, 1) - q)[:, None]
    start_p, start_q = p[:, :, None], q[:, None]
    r = start_p - start_q
    a, b, e = dot(d, d), dot(d, g), dot(g, g)
    c, f = dot(d, r), dot(g, r)
    ae = a * e
    sine2 = ae - b * b
    skew = sine2 > _PARALLEL * ae
    s = np.where(skew, _cut((b * f - c * e) / np.where(skew, sine2, 1.0)), 0.0)
    t = _cut((b * s + f) / np.where(e > 0, e, 1.0))
    # Where t was clamped, or the edges are parallel, s must follow t.
    s = np.where(skew & (t > 0) & (t < 1), s, _cut((b * t - c) / np.where(a > 0, a, 1.0)))
    on_p, on_q = s * d, t * g
    on_p += start_p
    on_q += start_q
    gap = on_p - on_q
    n = p.shape[2]
    distance = np.sqrt(dot(gap, gap))
    if loose >= 0:
        is_between = (s > 0) & (s < 1) & (t > 0) & (t < 1)
        is_between &= _goes_on_both_sides(r, d, g, loose)
        distance[is_between] = np.inf
    return Meetings(distance.reshape(9, n), on_p.reshape(3, 9, n), on_q.reshape(3, 9, n))


def _goes_on_both_sides(r: Floats, d: Floats, g: Floats, loose: float) -> Bools:
    """Mark the pairs of edges d and g, whose starts are r apart, that have ends within `loose` of each other's edge on
    both sides of their nearest points."""
    a, b, e = dot(d, d), dot(d, g), dot(g, g)
    a, e = np.where(a > 0, a, 1.0), np.where(e > 0, e, 1.0)
    c, f = dot(d, r), dot(g, r)
    start_p = r - _cut(f / e) * g
    end_p = r + d - _cut((f + b) / e) * g
    start_q = r + _cut(-c / a) * d
    end_q = r + _cut((b - c) / a) * d - g
    p0, p1, q0, q1 = (dot(way, way) <= loose * loose for way in (start_p, end_p, start_q, end_q))
    goes_on: Bools = np.where(b >= 0, (p0 | q0) & (p1 | q1), (p0 | q1) & (p1 | q0))
    return goes_on


def _cut(shares: Floats) -> Floats:
    """Clamp shares to 0..1 in place."""
    np.maximum(shares, 0.0, out=shares)
    return np.minimum(shares, 1.0, out=shares)


def _over(p: Floats, q: Floats) -> Floats:
    """Return the heights (3, n) of p's vertices over q along the third axis, nan outside of q."""
    origin = q[:, 0]
    u, v, w = q[:, 1] - origin, q[:, 2] - origin, p - origin[:, None]
    area, span2 = _turn(u, v), dot(u, u) * dot(v, v)
    area = np.where(area * area > _PARALLEL * span2, area, np.nan)
    beta, gamma = _turn(w, v) / area, _turn(u, w) / area
    inside = (beta > _RIM) & (gamma > _RIM) & (beta + gamma < 1 - _RIM)
    return np.where(inside, w[2] - beta * u[2] - gamma * v[2], np.nan)


def _over_crossings(p: Floats, q: Floats) -> Floats:
    """Return the heights (9, n) of p's edges over q's along the third axis where they cross in plan, nan elsewhere."""
    d, g = (_next(p, 1) - p)[:, :, None], (_next(q, 1) - q)[:, None]
    r = q[:, None] - p[:, :, None]
    area, span2 = _turn(d, g), dot(d, d) * dot(g, g)
    area = np.where(area * area > _PARALLEL * span2, area, np.nan)
    s, t = _turn(r, g) / area, _turn(r, d) / area
    crosses = (s > _RIM) & (s < 1 - _RIM) & (t > _RIM) & (t < 1 - _RIM)
    height: Floats = np.where(crosses, s * d[2] - t * g[2] - r[2], np.nan)
    return height.reshape(9, -1)


def _turn(x: Floats, y: Floats) -> Floats:
    """Return the third component of the cross product."""
    turn: Floats = x[0] * y[1] - x[1] * y[0]
    return turn


def _hit_shares(start: Floats, way: Floats, triangles: Floats) -> Floats:
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
