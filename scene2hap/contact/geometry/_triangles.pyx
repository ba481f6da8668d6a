"""One pair of triangles in the compiled kernels of `mesh_distance`.

The arithmetic repeats that of `triangles`, operation by operation, so that results are bit-identical.
"""

from libc.math cimport NAN, fabs, sqrt

from scene2hap.contact.geometry._boxes cimport Box, greater, lesser, squared_distance

# As in `triangles` and `mesh_distance`.
cdef double PARALLEL = 1e-12
cdef double RIM = 1e-9
cdef double IN_PLANE_M = 1e-9
cdef double ROUNDING_M = 1e-9
cdef double HOLDING = 0.5
cdef double INSET = 1e-4
cdef double INSET_M = 1e-4
# A point this far outside an edge, in barycentric units, is outside despite rounding.
cdef double OUTSIDE = 1e-3


cdef inline double dot(const double* x, const double* y) noexcept:
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]


cdef inline double turn(const double* x, const double* y) noexcept:
    return x[0] * y[1] - x[1] * y[0]


cdef inline void less(double* way, const double* end, const double* start) noexcept:
    way[0], way[1], way[2] = end[0] - start[0], end[1] - start[1], end[2] - start[2]


cdef inline double cut(double share) noexcept:
    return lesser(greater(share, 0.0), 1.0)


cdef void measure_face(Face* face) noexcept:
    """Compute edges, normal and products of a triangle from its corners; the area is nan if it is degenerate."""
    cdef double both, length
    cdef int corner
    cdef double* u = face.edges[0]
    for corner in range(3):
        less(face.edges[corner], face.corners[(corner + 1) % 3], face.corners[corner])
    less(face.v, face.corners[2], face.corners[0])
    face.normal[0] = u[1] * face.v[2] - u[2] * face.v[1]
    face.normal[1] = u[2] * face.v[0] - u[0] * face.v[2]
    face.normal[2] = u[0] * face.v[1] - u[1] * face.v[0]
    face.uu, face.uv, face.vv = dot(u, u), dot(u, face.v), dot(face.v, face.v)
    both = face.uu * face.vv
    face.area2 = both - face.uv * face.uv
    if not face.area2 > PARALLEL * both:
        face.area2 = NAN
    face.root = sqrt(face.area2)
    length = sqrt(dot(face.normal, face.normal))
    face.is_level = length > 0 and fabs(face.normal[2]) >= HOLDING * length


cdef void shrink(Face* face) noexcept:
    """Shrink a triangle a little, about its middle."""
    cdef double extent = 0, share
    cdef double inwards[3][3]
    cdef double middle
    cdef int axis, corner
    for axis in range(3):
        middle = (face.corners[0][axis] + face.corners[1][axis] + face.corners[2][axis]) / 3
        for corner in range(3):
            inwards[corner][axis] = middle - face.corners[corner][axis]
            extent = greater(extent, fabs(inwards[corner][axis]))
    share = lesser(INSET, INSET_M / greater(extent, INSET_M))
    for axis in range(3):
        for corner in range(3):
            face.corners[corner][axis] = inwards[corner][axis] * share + face.corners[corner][axis]


cdef inline bint heights_over(double* heights, const Face* face, const Face* other, double within) noexcept:
    """Compute the heights of another's corners over a face, in units of its normal's length; nan for a degenerate face.

    Returns False, without heights, if the other is surely farther from the plane than `within`.
    """
    cdef double way[3]
    cdef double along[3]
    cdef double far = within * face.root * 1.000001
    cdef int corner
    for corner in range(3):
        less(way, other.corners[corner], face.corners[0])
        along[corner] = dot(way, face.normal)
    if (along[0] > far and along[1] > far and along[2] > far) or (
        along[0] < -far and along[1] < -far and along[2] < -far
    ):
        return False
    for corner in range(3):
        heights[corner] = along[corner] / face.area2
    return True


cdef bint is_inside(const Face* face, const double* point) noexcept:
    cdef double way[3]
    cdef double wu, wv, beta, gamma
    less(way, point, face.corners[0])
    wu, wv = dot(way, face.edges[0]), dot(way, face.v)
    beta = (face.vv * wu - face.uv * wv) / face.area2
    gamma = (face.uu * wv - face.uv * wu) / face.area2
    return beta >= -RIM and gamma >= -RIM and beta + gamma <= 1 + RIM


cdef inline bint has_edge(const Face* face, int i) noexcept:
    return face.features >> i & 1


cdef inline bint has_corner(const Face* face, int i) noexcept:
    return face.features >> (3 + i) & 1


cdef void meet(Meetings* found, const Face* p, const Face* q, double within, double loose) noexcept:
    """Collect the local meetings of a pair's features within reach, in the order of `triangles.meetings`."""
    cdef double over_p[3]
    cdef double over_q[3]
    found.n = 0
    if not heights_over(over_q, q, p, within + ROUNDING_M) or not heights_over(over_p, p, q, within + ROUNDING_M):
        return
    meet_edges(found, p, q, within, loose)
    meet_corners(found, p, q, over_q, within, False)
    meet_corners(found, q, p, over_p, within, True)
    cross_edges(found, p, q, over_q, loose)
    cross_edges(found, q, p, over_p, loose)


cdef inline void add(Meetings* found, double distance, const double* on_p, const double* on_q) noexcept:
    cdef int axis
    found.distance[found.n] = distance
    for axis in range(3):
        found.on_p[found.n][axis], found.on_q[found.n][axis] = on_p[axis], on_q[axis]
    found.n += 1


cdef void meet_edges(Meetings* found, const Face* p, const Face* q, double within, double loose) noexcept:
    """Add the nearest points of the nine pairs of edges. The edges' boxes reject most of them early."""
    cdef Box[3] of_q
    cdef Box of_p
    cdef double r[3]
    cdef double gap[3]
    cdef double on_p[3]
    cdef double on_q[3]
    cdef double a, b, c, e, f, ae, sine2, s, t, distance2, reach2 = within * within * (1 + 1e-12)
    cdef bint is_skew
    cdef int i, j, axis
    for j in range(3):
        edge_box(&of_q[j], q, j)
    for i in range(3):
        if not has_edge(p, i):
            continue
        edge_box(&of_p, p, i)
        a = dot(p.edges[i], p.edges[i])
        for j in range(3):
            if not has_edge(q, j) or squared_distance(&of_p, &of_q[j]) > reach2:
                continue
            less(r, p.corners[i], q.corners[j])
            b, e = dot(p.edges[i], q.edges[j]), dot(q.edges[j], q.edges[j])
            c, f = dot(p.edges[i], r), dot(q.edges[j], r)
            ae = a * e
            sine2 = ae - b * b
            is_skew = sine2 > PARALLEL * ae
            s = cut((b * f - c * e) / sine2) if is_skew else 0.0
            t = cut((b * s + f) / (e if e > 0 else 1.0))
            if not (is_skew and 0 < t < 1):
                s = cut((b * t - c) / (a if a > 0 else 1.0))
            for axis in range(3):
                on_p[axis] = s * p.edges[i][axis] + p.corners[i][axis]
                on_q[axis] = t * q.edges[j][axis] + q.corners[j][axis]
            less(gap, on_p, on_q)
            distance2 = dot(gap, gap)
            if distance2 <= reach2:
                if loose >= 0 and 0 < s < 1 and 0 < t < 1 and goes_on_both_sides(r, p.edges[i], q.edges[j], loose):
                    continue
                add(found, sqrt(distance2), on_p, on_q)


cdef bint goes_on_both_sides(const double* r, const double* d, const double* g, double loose) noexcept:
    """Return True if two edges have ends within `loose` of each other's edge on both sides of their nearest points."""
    cdef double a = dot(d, d), b = dot(d, g), e = dot(g, g), c = dot(d, r), f = dot(g, r)
    cdef double loose2 = loose * loose, s, t
    cdef double[3] way
    cdef bint p0, p1, q0, q1
    cdef int axis
    a, e = a if a > 0 else 1.0, e if e > 0 else 1.0
    t = cut(f / e)
    for axis in range(3):
        way[axis] = r[axis] - t * g[axis]
    p0 = dot(way, way) <= loose2
    t = cut((f + b) / e)
    for axis in range(3):
        way[axis] = r[axis] + d[axis] - t * g[axis]
    p1 = dot(way, way) <= loose2
    s = cut(-c / a)
    for axis in range(3):
        way[axis] = r[axis] + s * d[axis]
    q0 = dot(way, way) <= loose2
    s = cut((b - c) / a)
    for axis in range(3):
        way[axis] = r[axis] + s * d[axis] - g[axis]
    q1 = dot(way, way) <= loose2
    if b >= 0:
        return (p0 or q0) and (p1 or q1)
    return (p0 or q1) and (p1 or q0)


cdef inline void edge_box(Box* box, const Face* one, int i) noexcept:
    cdef int axis
    for axis in range(3):
        box.low[axis] = lesser(one.corners[i][axis], one.corners[(i + 1) % 3][axis])
        box.high[axis] = greater(one.corners[i][axis], one.corners[(i + 1) % 3][axis])


cdef void meet_corners(
    Meetings* found, const Face* other, const Face* own, const double* heights, double within, bint own_is_p
) noexcept:
    """Add the meetings of the other's corners with the inside of a face."""
    cdef double foot[3]
    cdef double distance
    cdef int i, axis
    for i in range(3):
        if not has_corner(other, i):
            continue
        distance = fabs(heights[i]) * own.root
        if distance <= within and is_inside(own, other.corners[i]):
            for axis in range(3):
                foot[axis] = other.corners[i][axis] - heights[i] * own.normal[axis]
            if own_is_p:
                add(found, distance, foot, other.corners[i])
            else:
                add(found, distance, other.corners[i], foot)


cdef void cross_edges(
    Meetings* found, const Face* other, const Face* own, const double* heights, double loose
) noexcept:
    """Add the points where the other's edges intersect a face, but not between ends within `loose`."""
    cdef double point[3]
    cdef double start, end, s, in_plane
    cdef int i, axis
    if not (heights[0] * heights[1] < 0 or heights[1] * heights[2] < 0):
        return
    in_plane = IN_PLANE_M / own.root
    for i in range(3):
        if not has_edge(other, i):
            continue
        start, end = heights[i], heights[(i + 1) % 3]
        if fabs(start) * own.root <= loose and fabs(end) * own.root <= loose:
            continue
        if start * end < 0 and fabs(start) > in_plane and fabs(end) > in_plane:
            s = start / (start - end)
            for axis in range(3):
                point[axis] = (other.corners[(i + 1) % 3][axis] - other.corners[i][axis]) * s + other.corners[i][axis]
            if is_inside(own, point):
                add(found, 0.0, point, point)


cdef bint measure_heights(double* least, double* most, const Face* p, const Face* q) noexcept:
    """Include the heights of p over q. Returns False if the two surely do not overlap in plan."""
    if not (measure_corners(least, most, p, q, 1.0) and measure_corners(least, most, q, p, -1.0)):
        return False
    measure_crossings(least, most, p, q)
    return True


cdef bint measure_corners(double* least, double* most, const Face* p, const Face* q, double sign) noexcept:
    """Include the heights of p's corners over q. Returns False if p and q surely do not overlap in plan."""
    cdef const double* u = &q.edges[0][0]
    cdef const double* v = &q.v[0]
    cdef double w[3]
    cdef double area = turn(u, v), beta, gamma, height
    cdef int i, beyond_u = 0, beyond_v = 0, beyond_rim = 0
    if not area * area > PARALLEL * (q.uu * q.vv):
        return True
    for i in range(3):
        less(w, p.corners[i], q.corners[0])
        beta, gamma = turn(w, v) / area, turn(u, w) / area
        beyond_u += beta < -OUTSIDE
        beyond_v += gamma < -OUTSIDE
        beyond_rim += beta + gamma > 1 + OUTSIDE
        if beta > RIM and gamma > RIM and beta + gamma < 1 - RIM:
            height = sign * (w[2] - beta * u[2] - gamma * v[2])
            least[0], most[0] = lesser(least[0], height), greater(most[0], height)
    return beyond_u < 3 and beyond_v < 3 and beyond_rim < 3


cdef void measure_crossings(double* least, double* most, const Face* p, const Face* q) noexcept:
    """Include the heights of p's edges over q's, where they cross in plan."""
    cdef const double* d
    cdef const double* g
    cdef double r[3]
    cdef double area, s, t, height
    cdef int i, j
    for i in range(3):
        d = p.edges[i]
        for j in range(3):
            g = q.edges[j]
            less(r, q.corners[j], p.corners[i])
            area = turn(d, g)
            s, t = turn(r, g), turn(r, d)
            # The signs reject most pairs without a division.
            if not (s * area > 0 and t * area > 0) or not area * area > PARALLEL * (dot(d, d) * dot(g, g)):
                continue
            s, t = s / area, t / area
            if RIM < s < 1 - RIM and RIM < t < 1 - RIM:
                height = s * d[2] - t * g[2] - r[2]
                least[0], most[0] = lesser(least[0], height), greater(most[0], height)
