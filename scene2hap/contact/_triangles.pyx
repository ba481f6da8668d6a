"""The compiled twins of the kernels in `triangles`, operation by operation: the same to the last bit."""

import numpy as np

from libc.math cimport INFINITY, NAN, fabs, fmax, fmin, sqrt

# As in `triangles`.
cdef double PARALLEL = 1e-12
cdef double RIM = 1e-9
cdef double IN_PLANE_M = 1e-9


cdef struct Triangle:
    double corners[3][3]  # by corner, then by axis


cdef struct Face:
    double u[3]
    double v[3]
    double normal[3]
    double uu, uv, vv, area2
    double height[3]  # of the other's corners


cdef inline double dot(const double* x, const double* y) noexcept:
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]


cdef inline double turn(const double* x, const double* y) noexcept:
    return x[0] * y[1] - x[1] * y[0]


cdef inline void less(double* way, const double* end, const double* start) noexcept:
    way[0], way[1], way[2] = end[0] - start[0], end[1] - start[1], end[2] - start[2]


cdef inline double cut(double share) noexcept:
    return fmin(fmax(share, 0.0), 1.0)


cdef void take(Triangle* one, const double[:, :, :] many, Py_ssize_t k) noexcept:
    cdef int axis, corner
    for axis in range(3):
        for corner in range(3):
            one.corners[corner][axis] = many[axis, corner, k]


cdef void look(Face* face, const Triangle* own, const Triangle* other) noexcept:
    """A face, and how high another's corners are over it; nan for a face without area."""
    cdef double way[3]
    cdef double both
    cdef double* u = face.u
    cdef double* v = face.v
    cdef int corner
    less(u, own.corners[1], own.corners[0])
    less(v, own.corners[2], own.corners[0])
    face.normal[0] = u[1] * v[2] - u[2] * v[1]
    face.normal[1] = u[2] * v[0] - u[0] * v[2]
    face.normal[2] = u[0] * v[1] - u[1] * v[0]
    face.uu, face.uv, face.vv = dot(u, u), dot(u, v), dot(v, v)
    both = face.uu * face.vv
    face.area2 = both - face.uv * face.uv
    if not face.area2 > PARALLEL * both:
        face.area2 = NAN
    for corner in range(3):
        less(way, other.corners[corner], own.corners[0])
        face.height[corner] = dot(way, face.normal) / face.area2


cdef double clear(const Face* face) noexcept:
    cdef double lowest = fmin(fmin(face.height[0], face.height[1]), face.height[2])
    cdef double highest = fmax(fmax(face.height[0], face.height[1]), face.height[2])
    return fmax(fmax(lowest, -highest) * sqrt(face.area2), 0.0)


cdef bint is_inside(const Face* face, const double* origin, const double* point) noexcept:
    cdef double way[3]
    cdef double wu, wv, beta, gamma
    less(way, point, origin)
    wu, wv = dot(way, face.u), dot(way, face.v)
    beta = (face.vv * wu - face.uv * wv) / face.area2
    gamma = (face.uu * wv - face.uv * wu) / face.area2
    return beta >= -RIM and gamma >= -RIM and beta + gamma <= 1 + RIM


def clearances(const double[:, :, :] p, const double[:, :, :] q):
    cdef Py_ssize_t k, n = p.shape[2]
    cdef Triangle one, other
    cdef Face face
    cdef double found
    told = np.empty(n)
    cdef double[::1] out = told
    for k in range(n):
        take(&one, p, k)
        take(&other, q, k)
        look(&face, &other, &one)
        found = clear(&face)
        look(&face, &one, &other)
        out[k] = fmax(found, clear(&face))
    return told


cdef struct Meetings:
    double distance[21]
    double on_p[21][3]
    double on_q[21][3]


cdef void meet(Meetings* every, const Triangle* p, const Triangle* q) noexcept:
    meet_edges(every, p, q)
    meet_face(every.distance, every.on_p, every.on_q, 9, q, p)
    meet_face(every.distance, every.on_q, every.on_p, 12, p, q)


cdef void meet_edges(Meetings* every, const Triangle* p, const Triangle* q) noexcept:
    """Nearest points of all nine pairs of edges."""
    cdef double d[3]
    cdef double g[3]
    cdef double r[3]
    cdef double gap[3]
    cdef double a, b, c, e, f, ae, sine2, s, t
    cdef bint is_skew
    cdef int i, j, axis, row
    for i in range(3):
        less(d, p.corners[(i + 1) % 3], p.corners[i])
        a = dot(d, d)
        for j in range(3):
            row = 3 * i + j
            less(g, q.corners[(j + 1) % 3], q.corners[j])
            less(r, p.corners[i], q.corners[j])
            b, e, c, f = dot(d, g), dot(g, g), dot(d, r), dot(g, r)
            ae = a * e
            sine2 = ae - b * b
            is_skew = sine2 > PARALLEL * ae
            s = cut((b * f - c * e) / sine2) if is_skew else 0.0
            t = cut((b * s + f) / (e if e > 0 else 1.0))
            if not (is_skew and 0 < t < 1):
                s = cut((b * t - c) / (a if a > 0 else 1.0))
            for axis in range(3):
                every.on_p[row][axis] = s * d[axis] + p.corners[i][axis]
                every.on_q[row][axis] = t * g[axis] + q.corners[j][axis]
            less(gap, every.on_p[row], every.on_q[row])
            every.distance[row] = sqrt(dot(gap, gap))


cdef void meet_face(
    double* distance, double[3]* on_other, double[3]* on_own, int first, const Triangle* own, const Triangle* other
) noexcept:
    """The other's corners with their feet inside a face, and six rows on, where its edges run through that."""
    cdef Face face
    cdef double root, in_plane, start, end, s
    cdef double* point
    cdef bint crosses
    cdef int i, axis, row
    look(&face, own, other)
    root = sqrt(face.area2)
    in_plane = IN_PLANE_M / root
    for i in range(3):
        row = first + i
        start, end = face.height[i], face.height[(i + 1) % 3]
        for axis in range(3):
            on_other[row][axis] = other.corners[i][axis]
            on_own[row][axis] = other.corners[i][axis] - start * face.normal[axis]
        distance[row] = fabs(start) * root if is_inside(&face, own.corners[0], other.corners[i]) else INFINITY
        row += 6
        crosses = start * end < 0 and fabs(start) > in_plane and fabs(end) > in_plane
        s = start / (start - end if crosses else 1.0)
        point = on_other[row]
        for axis in range(3):
            point[axis] = (other.corners[(i + 1) % 3][axis] - other.corners[i][axis]) * s + other.corners[i][axis]
            on_own[row][axis] = point[axis]
        distance[row] = 0.0 if crosses and is_inside(&face, own.corners[0], point) else INFINITY


def fill_closest(
    double[::1] distance, double[:, ::1] on_p, double[:, ::1] on_q, const double[:, :, :] p, const double[:, :, :] q
):
    cdef Py_ssize_t k
    cdef Triangle one, other
    cdef Meetings every
    cdef int row, nearest, axis
    for k in range(p.shape[2]):
        take(&one, p, k)
        take(&other, q, k)
        meet(&every, &one, &other)
        nearest = 0
        for row in range(1, 21):
            if every.distance[row] < every.distance[nearest]:
                nearest = row
        distance[k] = every.distance[nearest]
        for axis in range(3):
            on_p[axis, k], on_q[axis, k] = every.on_p[nearest][axis], every.on_q[nearest][axis]


def near_ends(const double[:, :, :] p, const double[:, :, :] q, double distance_m):
    cdef Py_ssize_t k, n = p.shape[2]
    cdef Triangle one, other
    cdef Meetings every
    cdef int row
    # By meeting, since that is their order; few come so near.
    found = [[] for _ in range(21)]
    for k in range(n):
        take(&one, p, k)
        take(&other, q, k)
        meet(&every, &one, &other)
        for row in range(21):
            if every.distance[row] <= distance_m:
                (<list>found[row]).append((
                    every.on_p[row][0], every.on_p[row][1], every.on_p[row][2],
                    every.on_q[row][0], every.on_q[row][1], every.on_q[row][2],
                ))
    ends = np.array([end for ends in found for end in ends]).reshape(-1, 6).T
    return np.ascontiguousarray(ends[:3]), np.ascontiguousarray(ends[3:])


def fill_heights(double[::1] low, double[::1] high, const double[:, :, :] p, const double[:, :, :] q):
    cdef Py_ssize_t k
    cdef Triangle one, other
    cdef double least, most
    for k in range(p.shape[2]):
        take(&one, p, k)
        take(&other, q, k)
        least, most = INFINITY, -INFINITY
        measure_corners(&least, &most, &one, &other, 1.0)
        measure_corners(&least, &most, &other, &one, -1.0)
        measure_crossings(&least, &most, &one, &other)
        low[k], high[k] = least, most


cdef void measure_corners(double* least, double* most, const Triangle* p, const Triangle* q, double sign) noexcept:
    """Heights of p's corners over q, where they are over it."""
    cdef double u[3]
    cdef double v[3]
    cdef double w[3]
    cdef double area, span2, beta, gamma, height
    cdef int i
    less(u, q.corners[1], q.corners[0])
    less(v, q.corners[2], q.corners[0])
    area, span2 = turn(u, v), dot(u, u) * dot(v, v)
    if not area * area > PARALLEL * span2:
        return
    for i in range(3):
        less(w, p.corners[i], q.corners[0])
        beta, gamma = turn(w, v) / area, turn(u, w) / area
        if beta > RIM and gamma > RIM and beta + gamma < 1 - RIM:
            height = sign * (w[2] - beta * u[2] - gamma * v[2])
            least[0], most[0] = fmin(least[0], height), fmax(most[0], height)


cdef void measure_crossings(double* least, double* most, const Triangle* p, const Triangle* q) noexcept:
    """Heights of p's edges over q's, where they cross."""
    cdef double d[3]
    cdef double g[3]
    cdef double r[3]
    cdef double area, span2, s, t, height
    cdef int i, j
    for i in range(3):
        less(d, p.corners[(i + 1) % 3], p.corners[i])
        for j in range(3):
            less(g, q.corners[(j + 1) % 3], q.corners[j])
            less(r, q.corners[j], p.corners[i])
            area, span2 = turn(d, g), dot(d, d) * dot(g, g)
            if not area * area > PARALLEL * span2:
                continue
            s, t = turn(r, g) / area, turn(r, d) / area
            if RIM < s < 1 - RIM and RIM < t < 1 - RIM:
                height = s * d[2] - t * g[2] - r[2]
                least[0], most[0] = fmin(least[0], height), fmax(most[0], height)
