"""How near two triangles come, for many pairs at once.

The nearest points of two triangles lie on a vertex of one and the inside of the other, on two edges, or where an edge
of one runs through the other. All 21 such meetings are told, since the corners of a patch where faces lie on each
other are among them, and a single nearest point would hide them.

Source: C. Ericson, Real-Time Collision Detection (2005), section 5.1.9 (segments), 5.1.10 (triangles), 3.4 (barycentric
coordinates). Differs: a vertex is only measured against the inside of a face; its edges are left to the segments.

    p, q : (n, 3, 3) float64 [m], triangle k of either side is p[k], its corners the rows
    s, t : place on an edge of p, of q, 0..1 [-]
    h    : height over the other triangle's plane, in units of its normal's length
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_NEXT = [1, 2, 0]
# Squared sine below which edges are parallel and corners in line: the rest of their answer would be rounding noise.
_PARALLEL = 1e-12
# Points this little outside a triangle (in barycentric units) are inside, so that a corner on a shared edge counts.
_RIM = 1e-9
_IN_PLANE_M = 1e-9


class Meetings(NamedTuple):
    """Where triangles come near: distance (n, m) [m], inf where they do not, and both ends (n, m, 3) [m]."""

    distance: Floats
    on_p: Floats
    on_q: Floats


def meetings(p: Floats, q: Floats) -> Meetings:
    """The 21 local meetings of each pair: nine of edges, six of vertices with faces, six of edges through faces."""
    n = len(p)
    # Both directions at once, p's corners at q's faces and q's at p's: numpy's cost is per call on few triangles.
    faces, corners = _Faces(np.concatenate([q, p])), np.concatenate([p, q])
    parts = [_edges_with_edges(p, q)]
    for both in (faces.meet_vertices(corners), faces.meet_edges(corners)):
        parts.append(Meetings(both.distance[:n], both.on_p[:n], both.on_q[:n]))
        parts.append(Meetings(both.distance[n:], both.on_q[n:], both.on_p[n:]))
    return Meetings(*(np.concatenate(arrays, axis=1) for arrays in zip(*parts, strict=True)))


def closest_points(p: Floats, q: Floats) -> Meetings:
    """Distance (n,) [m] of each pair, 0 where they cut each other, and a nearest point (n, 3) on either.

    Where several points are equally near, as on parallel faces, one of them.
    """
    every = meetings(p, q)
    rows = np.arange(len(p))
    nearest = np.argmin(every.distance, axis=1)
    return Meetings(every.distance[rows, nearest], every.on_p[rows, nearest], every.on_q[rows, nearest])


def plane_gap(p: Floats, q: Floats) -> Floats:
    """A cheap bound from below (n,) [m] on the distance: how far p stays on one side of q's plane, or q of p's."""
    clear = _Faces(np.concatenate([q, p])).clear_of_plane(np.concatenate([p, q]))
    return np.maximum(clear[: len(p)], clear[len(p) :])


def height_range(p: Floats, q: Floats, up: Floats) -> tuple[Floats, Floats]:
    """Least and greatest height (n,) [m] of p over q along the unit vector `up`, of points straight over each other.

    (inf, -inf) where no vertical line meets both. The height is linear over the common shadow, so that its extremes lie
    on the shadow's corners: vertices of either triangle or crossings of edges.
    """
    across = np.eye(3)[int(np.argmin(np.abs(up)))]
    e1 = np.cross(up, across)
    e1 /= np.linalg.norm(e1)
    frame = np.stack([e1, np.cross(up, e1), up], axis=1)
    p, q = p @ frame, q @ frame
    n = len(p)
    over = _over(np.concatenate([p, q]), np.concatenate([q, p]))
    heights = np.concatenate([over[:n], -over[n:], _over_crossings(p, q)], axis=1)
    low: Floats = np.fmin.reduce(heights, axis=1, initial=np.inf)
    high: Floats = np.fmax.reduce(heights, axis=1, initial=-np.inf)
    return low, high


class _Faces:
    """Triangles (n, 3, 3) asked about points: their planes and barycentric coordinates."""

    def __init__(self, corners: Floats) -> None:
        self.origin = corners[:, None, 0]
        u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        self.u, self.v = u[:, None], v[:, None]
        self.normal = _cross(u, v)[:, None]
        self.uu, self.uv, self.vv = _dot(self.u, self.u), _dot(self.u, self.v), _dot(self.v, self.v)
        area2 = self.uu * self.vv - self.uv**2
        self.area2 = np.where(area2 > _PARALLEL * self.uu * self.vv, area2, np.nan)

    def height(self, points: Floats) -> Floats:
        """(n, m) [-]: times the normal, the way from the plane to the points (n, m, 3); nan for a face without area."""
        height: Floats = _dot(points - self.origin, self.normal) / self.area2
        return height

    def clear_of_plane(self, points: Floats) -> Floats:
        height = self.height(points)
        one_sided = np.maximum(height.min(axis=1), -height.max(axis=1)) * np.sqrt(self.area2[:, 0])
        clear: Floats = np.fmax(one_sided, 0.0)
        return clear

    def inside(self, points: Floats) -> NDArray[np.bool_]:
        w = points - self.origin
        wu, wv = _dot(w, self.u), _dot(w, self.v)
        beta = (self.vv * wu - self.uv * wv) / self.area2
        gamma = (self.uu * wv - self.uv * wu) / self.area2
        within: NDArray[np.bool_] = (beta >= -_RIM) & (gamma >= -_RIM) & (beta + gamma <= 1 + _RIM)
        return within

    def meet_vertices(self, points: Floats) -> Meetings:
        height = self.height(points)
        feet = points - height[..., None] * self.normal
        distance = np.where(self.inside(points), np.abs(height) * np.sqrt(self.area2), np.inf)
        return Meetings(distance, points, feet)

    def meet_edges(self, corners: Floats) -> Meetings:
        start, end = self.height(corners), self.height(corners[:, _NEXT])
        # An edge within rounding of the plane crosses it anywhere or nowhere; its vertices tell the same surely.
        in_plane = _IN_PLANE_M / np.sqrt(self.area2)
        crosses = (start * end < 0) & (np.abs(start) > in_plane) & (np.abs(end) > in_plane)
        s = start / np.where(crosses, start - end, 1.0)
        points = corners + s[..., None] * (corners[:, _NEXT] - corners)
        distance = np.where(crosses & self.inside(points), 0.0, np.inf)
        return Meetings(distance, points, points)


def _edges_with_edges(p: Floats, q: Floats) -> Meetings:
    """Nearest points of all nine pairs of edges; on parallel edges, those at the start of p's edge if it faces q's."""
    d, g = (p[:, _NEXT] - p)[:, :, None], (q[:, _NEXT] - q)[:, None]
    start_p, start_q = p[:, :, None], q[:, None]
    r = start_p - start_q
    a, b, e = _dot(d, d), _dot(d, g), _dot(g, g)
    c, f = _dot(d, r), _dot(g, r)
    sine2 = a * e - b * b
    skew = sine2 > _PARALLEL * a * e
    s = np.where(skew, np.clip((b * f - c * e) / np.where(skew, sine2, 1.0), 0, 1), 0.0)
    t = np.clip((b * s + f) / np.where(e > 0, e, 1.0), 0, 1)
    # For the t kept inside q's edge the best s is known; where t was not cut this gives s back.
    s = np.where(skew & (t > 0) & (t < 1), s, np.clip((b * t - c) / np.where(a > 0, a, 1.0), 0, 1))
    on_p, on_q = start_p + s[..., None] * d, start_q + t[..., None] * g
    gap = on_p - on_q
    n = len(p)
    return Meetings(np.sqrt(_dot(gap, gap)).reshape(n, 9), on_p.reshape(n, 9, 3), on_q.reshape(n, 9, 3))


def _over(p: Floats, q: Floats) -> Floats:
    """Height (n, 3) of p's vertices over q along the third axis, nan beside q."""
    u, v, w = q[:, None, 1] - q[:, None, 0], q[:, None, 2] - q[:, None, 0], p - q[:, None, 0]
    area, span2 = _cross2(u, v), _dot(u, u) * _dot(v, v)
    area = np.where(area * area > _PARALLEL * span2, area, np.nan)
    beta, gamma = _cross2(w, v) / area, _cross2(u, w) / area
    inside = (beta > _RIM) & (gamma > _RIM) & (beta + gamma < 1 - _RIM)
    return np.where(inside, w[..., 2] - beta * u[..., 2] - gamma * v[..., 2], np.nan)


def _over_crossings(p: Floats, q: Floats) -> Floats:
    """Height (n, 9) of p's edges over q's along the third axis where they cross, nan where they do not."""
    d, g = (p[:, _NEXT] - p)[:, :, None], (q[:, _NEXT] - q)[:, None]
    r = q[:, None] - p[:, :, None]
    area, span2 = _cross2(d, g), _dot(d, d) * _dot(g, g)
    area = np.where(area * area > _PARALLEL * span2, area, np.nan)
    s, t = _cross2(r, g) / area, _cross2(r, d) / area
    crosses = (s > _RIM) & (s < 1 - _RIM) & (t > _RIM) & (t < 1 - _RIM)
    height: Floats = np.where(crosses, s * d[..., 2] - t * g[..., 2] - r[..., 2], np.nan)
    return height.reshape(len(p), 9)


def _dot(x: Floats, y: Floats) -> Floats:
    product: Floats = x[..., 0] * y[..., 0] + x[..., 1] * y[..., 1] + x[..., 2] * y[..., 2]
    return product


def _cross2(x: Floats, y: Floats) -> Floats:
    product: Floats = x[..., 0] * y[..., 1] - x[..., 1] * y[..., 0]
    return product


def _cross(x: Floats, y: Floats) -> Floats:
    # numpy.cross costs several times this on small arrays.
    return np.stack(
        [
            x[..., 1] * y[..., 2] - x[..., 2] * y[..., 1],
            x[..., 2] * y[..., 0] - x[..., 0] * y[..., 2],
            x[..., 0] * y[..., 1] - x[..., 1] * y[..., 0],
        ],
        axis=-1,
    )
