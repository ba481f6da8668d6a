"""The compiled twins of the kernels in `mesh_distance`: two `TriangleTree`s are descended at once.

The arithmetic of one pair of triangles is that of `triangles`, operation by operation: the same to the last bit.
"""

import numpy as np

from libc.math cimport INFINITY, NAN, fabs, sqrt
from libc.stdlib cimport free, realloc
from libc.string cimport memcpy

# As in `triangles`, `mesh_distance`, `triangle_tree` and `spread`.
cdef double PARALLEL = 1e-12
cdef double RIM = 1e-9
cdef double IN_PLANE_M = 1e-9
cdef double ROUNDING_M = 1e-9
cdef double HOLDING = 0.5
cdef double INSET = 1e-4
cdef double INSET_M = 1e-4
cdef double SPREAD_M = 0.005
cdef double TIE_M = 1e-6
cdef enum:
    LEAF_SIZE = 4
    MAX_POINTS = 4


cdef struct Triangle:
    double corners[3][3]  # by corner, then by axis


cdef struct Face:
    double u[3]
    double v[3]
    double normal[3]
    double uu, uv, vv, area2
    double height[3]  # of the other's corners


cdef inline double lesser(double x, double y) noexcept:
    # C's own `fmin` is a call, since it has to look for nan.
    return x if x < y else y


cdef inline double greater(double x, double y) noexcept:
    return x if x > y else y


cdef inline double dot(const double* x, const double* y) noexcept:
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]


cdef inline double turn(const double* x, const double* y) noexcept:
    return x[0] * y[1] - x[1] * y[0]


cdef inline void less(double* way, const double* end, const double* start) noexcept:
    way[0], way[1], way[2] = end[0] - start[0], end[1] - start[1], end[2] - start[2]


cdef inline double cut(double share) noexcept:
    return lesser(greater(share, 0.0), 1.0)


cdef void look(Face* face, const Triangle* own, const Triangle* other) noexcept:
    """A face, and how high another's corners are over it; nan for a face without area."""
    cdef double both, way[3]
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


cdef inline double clear(const Face* face) noexcept:
    """How far the other stays on one side of a face's plane, 0 if it does not or the face has no area."""
    if face.area2 != face.area2:
        return 0.0
    cdef double lowest = lesser(lesser(face.height[0], face.height[1]), face.height[2])
    cdef double highest = greater(greater(face.height[0], face.height[1]), face.height[2])
    return greater(greater(lowest, -highest) * sqrt(face.area2), 0.0)


cdef bint is_inside(const Face* face, const double* origin, const double* point) noexcept:
    cdef double way[3]
    cdef double wu, wv, beta, gamma
    less(way, point, origin)
    wu, wv = dot(way, face.u), dot(way, face.v)
    beta = (face.vv * wu - face.uv * wv) / face.area2
    gamma = (face.uu * wv - face.uv * wu) / face.area2
    return beta >= -RIM and gamma >= -RIM and beta + gamma <= 1 + RIM


cdef struct Box:
    double low[3]
    double high[3]


cdef inline double squared_distance(const Box* a, const Box* b) noexcept:
    """How far two boxes are apart, squared; inf for an empty one."""
    cdef double gap, total = 0
    cdef int axis
    for axis in range(3):
        gap = greater(a.low[axis] - b.high[axis], b.low[axis] - a.high[axis])
        if gap > 0:
            total += gap * gap
    return total


cdef struct Meetings:
    int n
    double distance[21]
    double on_p[21][3]
    double on_q[21][3]


cdef void meet(
    Meetings* found, const Triangle* p, const Triangle* q, const Face* of_p, const Face* of_q, double within
) noexcept:
    """Those of the 21 local meetings of a pair that are within reach, in the order of `triangles.meetings`."""
    found.n = 0
    meet_edges(found, p, q, within)
    meet_corners(found, p, q, of_q, within, False)
    meet_corners(found, q, p, of_p, within, True)
    cross_edges(found, p, q, of_q)
    cross_edges(found, q, p, of_p)


cdef inline void add(Meetings* found, double distance, const double* on_p, const double* on_q) noexcept:
    cdef int axis
    found.distance[found.n] = distance
    for axis in range(3):
        found.on_p[found.n][axis], found.on_q[found.n][axis] = on_p[axis], on_q[axis]
    found.n += 1


cdef void meet_edges(Meetings* found, const Triangle* p, const Triangle* q, double within) noexcept:
    """Nearest points of all nine pairs of edges. Most are too far apart by their boxes."""
    cdef double d[3][3]
    cdef double g[3][3]
    cdef Box[3] of_p
    cdef Box[3] of_q
    cdef double r[3]
    cdef double gap[3]
    cdef double on_p[3]
    cdef double on_q[3]
    cdef double a, b, c, e, f, ae, sine2, s, t, distance2, reach2 = within * within * (1 + 1e-12)
    cdef bint is_skew
    cdef int i, j, axis
    edges(d, of_p, p)
    edges(g, of_q, q)
    for i in range(3):
        a = dot(d[i], d[i])
        for j in range(3):
            if squared_distance(&of_p[i], &of_q[j]) > reach2:
                continue
            less(r, p.corners[i], q.corners[j])
            b, e, c, f = dot(d[i], g[j]), dot(g[j], g[j]), dot(d[i], r), dot(g[j], r)
            ae = a * e
            sine2 = ae - b * b
            is_skew = sine2 > PARALLEL * ae
            s = cut((b * f - c * e) / sine2) if is_skew else 0.0
            t = cut((b * s + f) / (e if e > 0 else 1.0))
            if not (is_skew and 0 < t < 1):
                s = cut((b * t - c) / (a if a > 0 else 1.0))
            for axis in range(3):
                on_p[axis] = s * d[i][axis] + p.corners[i][axis]
                on_q[axis] = t * g[j][axis] + q.corners[j][axis]
            less(gap, on_p, on_q)
            distance2 = dot(gap, gap)
            if distance2 <= reach2:
                add(found, sqrt(distance2), on_p, on_q)


cdef inline void edges(double[3]* way, Box* boxes, const Triangle* one) noexcept:
    cdef int i, axis
    for i in range(3):
        less(way[i], one.corners[(i + 1) % 3], one.corners[i])
        for axis in range(3):
            boxes[i].low[axis] = lesser(one.corners[i][axis], one.corners[(i + 1) % 3][axis])
            boxes[i].high[axis] = greater(one.corners[i][axis], one.corners[(i + 1) % 3][axis])


cdef void meet_corners(
    Meetings* found, const Triangle* other, const Triangle* own, const Face* face, double within, bint own_is_p
) noexcept:
    """The other's corners with their feet inside a face."""
    cdef double foot[3]
    cdef double distance, root = sqrt(face.area2)
    cdef int i, axis
    for i in range(3):
        distance = fabs(face.height[i]) * root
        if distance <= within and is_inside(face, own.corners[0], other.corners[i]):
            for axis in range(3):
                foot[axis] = other.corners[i][axis] - face.height[i] * face.normal[axis]
            if own_is_p:
                add(found, distance, foot, other.corners[i])
            else:
                add(found, distance, other.corners[i], foot)


cdef void cross_edges(Meetings* found, const Triangle* other, const Triangle* own, const Face* face) noexcept:
    """Where the other's edges run through a face."""
    cdef double point[3]
    cdef double start, end, s, in_plane
    cdef int i, axis
    if not (face.height[0] * face.height[1] < 0 or face.height[1] * face.height[2] < 0):
        return
    in_plane = IN_PLANE_M / sqrt(face.area2)
    for i in range(3):
        start, end = face.height[i], face.height[(i + 1) % 3]
        if start * end < 0 and fabs(start) > in_plane and fabs(end) > in_plane:
            s = start / (start - end)
            for axis in range(3):
                point[axis] = (other.corners[(i + 1) % 3][axis] - other.corners[i][axis]) * s + other.corners[i][axis]
            if is_inside(face, own.corners[0], point):
                add(found, 0.0, point, point)


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
            least[0], most[0] = lesser(least[0], height), greater(most[0], height)


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
                least[0], most[0] = lesser(least[0], height), greater(most[0], height)


# --- trees ---------------------------------------------------------------------------------------------------------

cdef struct Tree:
    const double* nodes      # (2 n_leaves - 1, 6) lowest and highest corners
    const double* corners    # (m, 9) in leaf order
    const Py_ssize_t* order  # (m,) columns in the shape
    Py_ssize_t n_leaves, m


cdef struct Placement:
    double turn[9]
    double shift[3]


cdef struct Points:
    double* at  # (n, 6) ends on guest and host
    Py_ssize_t n, room


cdef struct Search:
    Tree guest, host
    Placement guest_at, host_at  # in the frame in which boxes are compared; the host's is used by `drops` alone
    double within
    # closest_points
    double best
    Py_ssize_t best_guest, best_host
    double on_guest[3]
    double on_host[3]
    # contact_points
    double way[3]
    Points points
    bint is_full
    # drops
    bint guest_falls
    double bottom, reach, touch, first
    double* each


cdef Tree tree_of(const double[:, ::1] nodes, const double[:, ::1] corners, const Py_ssize_t[::1] order) noexcept:
    cdef Tree tree
    tree.m = order.shape[0]
    tree.n_leaves = (nodes.shape[0] + 1) // 2
    tree.nodes = &nodes[0, 0]
    tree.corners = &corners[0, 0] if tree.m else NULL
    tree.order = &order[0] if tree.m else NULL
    return tree


cdef Placement placement_of(rows, position) except *:
    cdef Placement found
    cdef int k = 0
    for row in rows:
        for value in row:
            found.turn[k] = value
            k += 1
    found.shift[0], found.shift[1], found.shift[2] = position
    return found


cdef inline void place(double* out, const double* point, const Placement* at) noexcept:
    cdef double x = point[0], y = point[1], z = point[2]
    out[0] = at.turn[0] * x + at.turn[1] * y + at.turn[2] * z + at.shift[0]
    out[1] = at.turn[3] * x + at.turn[4] * y + at.turn[5] * z + at.shift[1]
    out[2] = at.turn[6] * x + at.turn[7] * y + at.turn[8] * z + at.shift[2]


cdef inline void node_box(Box* box, const Tree* tree, Py_ssize_t node, const Placement* at) noexcept:
    """The box around a node's box that is turned, or the same box."""
    cdef const double* corners = tree.nodes + 6 * node
    cdef double middle[3]
    cdef double half[3]
    cdef double placed[3]
    cdef double reach
    cdef int axis
    if at == NULL:
        for axis in range(3):
            box.low[axis], box.high[axis] = corners[axis], corners[axis + 3]
        return
    if not corners[0] <= corners[3]:
        for axis in range(3):
            box.low[axis], box.high[axis] = INFINITY, -INFINITY
        return
    for axis in range(3):
        middle[axis] = (corners[axis] + corners[axis + 3]) / 2
        half[axis] = (corners[axis + 3] - corners[axis]) / 2
    place(placed, middle, at)
    for axis in range(3):
        reach = (
            fabs(at.turn[3 * axis]) * half[0] + fabs(at.turn[3 * axis + 1]) * half[1]
            + fabs(at.turn[3 * axis + 2]) * half[2]
        )
        box.low[axis], box.high[axis] = placed[axis] - reach, placed[axis] + reach


cdef inline void triangle_box(Box* box, const Triangle* one) noexcept:
    cdef int axis
    for axis in range(3):
        box.low[axis] = lesser(lesser(one.corners[0][axis], one.corners[1][axis]), one.corners[2][axis])
        box.high[axis] = greater(greater(one.corners[0][axis], one.corners[1][axis]), one.corners[2][axis])


cdef inline Py_ssize_t leaf_triangles(Triangle* found, const Tree* tree, Py_ssize_t leaf, const Placement* at) noexcept:
    """The triangles of a leaf, placed. Returns how many there are."""
    cdef Py_ssize_t first = leaf * LEAF_SIZE, n = min(<Py_ssize_t>LEAF_SIZE, tree.m - leaf * LEAF_SIZE), k
    cdef int corner
    cdef const double* corners
    for k in range(n):
        corners = tree.corners + 9 * (first + k)
        if at == NULL:
            memcpy(&found[k], corners, 9 * sizeof(double))
        else:
            for corner in range(3):
                place(found[k].corners[corner], corners + 3 * corner, at)
    return max(n, <Py_ssize_t>0)


# --- distance and contact points -------------------------------------------------------------------------------------

cdef void descend(Search* search, Py_ssize_t g, Py_ssize_t h, const Box* box_g, const Box* box_h) noexcept:
    """Visit the pairs of leaves below two nodes whose boxes are within reach, the nearer child first."""
    cdef Box first, second
    cdef double near, far
    cdef bint split_guest, swap
    cdef bint is_leaf_g = g >= search.guest.n_leaves - 1, is_leaf_h = h >= search.host.n_leaves - 1
    if is_leaf_g and is_leaf_h:
        visit(search, g - search.guest.n_leaves + 1, h - search.host.n_leaves + 1)
        return
    split_guest = is_leaf_h or (not is_leaf_g and longest(box_g) > longest(box_h))
    if split_guest:
        node_box(&first, &search.guest, 2 * g + 1, &search.guest_at)
        node_box(&second, &search.guest, 2 * g + 2, &search.guest_at)
        near, far = squared_distance(&first, box_h), squared_distance(&second, box_h)
    else:
        node_box(&first, &search.host, 2 * h + 1, NULL)
        node_box(&second, &search.host, 2 * h + 2, NULL)
        near, far = squared_distance(&first, box_g), squared_distance(&second, box_g)
    swap = far < near
    if swap:
        near, far = far, near
        first, second = second, first
    if near <= reach2(search):
        if split_guest:
            descend(search, 2 * g + 1 + swap, h, &first, box_h)
        else:
            descend(search, g, 2 * h + 1 + swap, box_g, &first)
    if far <= reach2(search):
        if split_guest:
            descend(search, 2 * g + 2 - swap, h, &second, box_h)
        else:
            descend(search, g, 2 * h + 2 - swap, box_g, &second)


cdef inline double longest(const Box* box) noexcept:
    return greater(greater(box.high[0] - box.low[0], box.high[1] - box.low[1]), box.high[2] - box.low[2])


cdef inline double reach2(const Search* search) noexcept:
    cdef double reach = search.best + ROUNDING_M
    return -1.0 if search.is_full else reach * reach


cdef void visit(Search* search, Py_ssize_t leaf_g, Py_ssize_t leaf_h) noexcept:
    cdef Triangle[LEAF_SIZE] p
    cdef Triangle[LEAF_SIZE] q
    cdef Box[LEAF_SIZE] boxes
    cdef Box around
    cdef Face of_p
    cdef Face of_q
    cdef Meetings found
    cdef Py_ssize_t n = leaf_triangles(p, &search.guest, leaf_g, &search.guest_at)
    cdef Py_ssize_t m = leaf_triangles(q, &search.host, leaf_h, NULL), i, j
    for j in range(m):
        triangle_box(&boxes[j], &q[j])
    for i in range(n):
        triangle_box(&around, &p[i])
        for j in range(m):
            if squared_distance(&around, &boxes[j]) > reach2(search):
                continue
            look(&of_q, &q[j], &p[i])
            if clear(&of_q) > search.best + ROUNDING_M:
                continue
            look(&of_p, &p[i], &q[j])
            if clear(&of_p) > search.best + ROUNDING_M:
                continue
            meet(&found, &p[i], &q[j], &of_p, &of_q, search.best)
            if found.n == 0:
                continue
            if search.points.room:
                collect(search, &found)
            else:
                compare(
                    search,
                    &found,
                    search.guest.order[LEAF_SIZE * leaf_g + i],
                    search.host.order[LEAF_SIZE * leaf_h + j],
                )


cdef void compare(Search* search, const Meetings* found, Py_ssize_t i, Py_ssize_t j) noexcept:
    """Keep the nearest meeting of all pairs; of equal ones that of the lowest columns."""
    cdef int row, nearest = 0, axis
    cdef double distance
    for row in range(1, found.n):
        if found.distance[row] < found.distance[nearest]:
            nearest = row
    distance = found.distance[nearest]
    if distance > search.best:
        return
    if distance == search.best and search.best_guest >= 0:
        if i > search.best_guest or (i == search.best_guest and j > search.best_host):
            return
    search.best, search.best_guest, search.best_host = distance, i, j
    for axis in range(3):
        search.on_guest[axis], search.on_host[axis] = found.on_p[nearest][axis], found.on_q[nearest][axis]
    search.is_full = distance <= ROUNDING_M


cdef void collect(Search* search, const Meetings* found) noexcept:
    """Add the meetings of a pair."""
    cdef int row, axis
    cdef double* at
    cdef double* larger
    for row in range(found.n):
        if found.distance[row] > search.within:
            continue
        if search.points.n == search.points.room:
            larger = <double*>realloc(search.points.at, 12 * search.points.room * sizeof(double))
            if larger == NULL:
                search.is_full = True
                return
            search.points.at, search.points.room = larger, 2 * search.points.room
        at = search.points.at + 6 * search.points.n
        search.points.n += 1
        for axis in range(3):
            at[axis], at[axis + 3] = found.on_p[row][axis] - search.way[axis], found.on_q[row][axis]


cdef void start(Search* search, guest_turn, guest_shift, double within) except *:
    search.guest_at = placement_of(guest_turn, guest_shift)
    search.within = search.best = within
    search.best_guest, search.is_full = -1, False
    search.points.at, search.points.n, search.points.room = NULL, 0, 0


cdef void find(Search* search) noexcept:
    cdef Box guest, host
    node_box(&guest, &search.guest, 0, &search.guest_at)
    node_box(&host, &search.host, 0, NULL)
    if search.guest.m and search.host.m and squared_distance(&guest, &host) <= reach2(search):
        descend(search, 0, 0, &guest, &host)


def closest_points(host, guest, turn, shift, double within):
    cdef Search search
    one, other = guest.tree, host.tree
    search.guest, search.host = tree_of(one[0], one[1], one[2]), tree_of(other[0], other[1], other[2])
    start(&search, turn, shift, within)
    find(&search)
    if search.best_guest < 0:
        return None
    return search.best, triple(search.on_guest), triple(search.on_host)


def contact_points(host, guest, turn, shift, way, double within):
    cdef Search search
    cdef Py_ssize_t[MAX_POINTS] chosen
    cdef Py_ssize_t k, n
    one, other = guest.tree, host.tree
    search.guest, search.host = tree_of(one[0], one[1], one[2]), tree_of(other[0], other[1], other[2])
    search.way[0], search.way[1], search.way[2] = way
    x, y, z = shift
    start(&search, turn, (x + search.way[0], y + search.way[1], z + search.way[2]), within)
    search.points.at = <double*>realloc(NULL, 6 * 64 * sizeof(double))
    if search.points.at == NULL:
        raise MemoryError
    search.points.room = 64
    try:
        find(&search)
        if search.is_full:
            raise MemoryError
        n = spread(chosen, search.points.at, search.points.n)
        if n < 0:
            raise MemoryError
        return [
            (triple(search.points.at + 6 * chosen[k]), triple(search.points.at + 6 * chosen[k] + 3)) for k in range(n)
        ]
    finally:
        free(search.points.at)


cdef triple(const double* point):
    return (point[0], point[1], point[2])


# --- a few points that stand for many, as `spread.spread` ------------------------------------------------------------

cdef Py_ssize_t spread(Py_ssize_t* chosen, const double* ends, Py_ssize_t n) noexcept:
    """Rows of at most MAX_POINTS of the ends (n, 6), by the points half way. Returns how many, -1 without memory."""
    cdef double* points
    cdef double* apart
    cdef double[3] place
    cdef double high
    cdef Py_ssize_t row, count = 0
    cdef int axis
    if n == 0:
        return 0
    points = <double*>realloc(NULL, 4 * n * sizeof(double))
    if points == NULL:
        return -1
    apart = points + 3 * n
    for axis in range(3):
        place[axis] = 0
        for row in range(n):
            points[3 * row + axis] = (ends[6 * row + axis] + ends[6 * row + axis + 3]) / 2
            place[axis] += points[3 * row + axis]
        place[axis] /= n
    for row in range(n):
        apart[row] = apart_by(points + 3 * row, place)
    chosen[0] = farthest(points, apart, ends, n)
    count = 1
    for row in range(n):
        apart[row] = INFINITY
    while count < MAX_POINTS:
        high = 0
        for row in range(n):
            apart[row] = lesser(apart[row], apart_by(points + 3 * row, points + 3 * chosen[count - 1]))
            high = greater(high, apart[row])
        if high <= SPREAD_M:
            break
        chosen[count] = farthest(points, apart, ends, n)
        count += 1
    free(points)
    return count


cdef inline double apart_by(const double* x, const double* y) noexcept:
    cdef double way[3]
    less(way, x, y)
    return sqrt(dot(way, way))


cdef Py_ssize_t farthest(const double* points, const double* apart, const double* ends, Py_ssize_t n) noexcept:
    """Of those that are farthest apart, up to rounding, the one with the least first coordinate, up to rounding, then
    second, then third; then the least to the last bit."""
    cdef double[4] limits
    cdef Py_ssize_t row, best = -1
    cdef int axis
    limits[0] = 0
    for row in range(n):
        limits[0] = greater(limits[0], apart[row])
    limits[0] -= TIE_M
    for axis in range(3):
        limits[axis + 1] = INFINITY
        for row in range(n):
            if is_left(points, apart, row, limits, axis):
                limits[axis + 1] = lesser(limits[axis + 1], points[3 * row + axis])
        limits[axis + 1] += TIE_M
    for row in range(n):
        if is_left(points, apart, row, limits, 3) and (best < 0 or is_before(points, ends, row, best)):
            best = row
    return best


cdef inline bint is_left(
    const double* points, const double* apart, Py_ssize_t row, const double* limits, int n_axes
) noexcept:
    cdef int axis
    if apart[row] < limits[0]:
        return False
    for axis in range(n_axes):
        if points[3 * row + axis] > limits[axis + 1]:
            return False
    return True


cdef inline bint is_before(const double* points, const double* ends, Py_ssize_t row, Py_ssize_t other) noexcept:
    """By the point half way, then by the ends."""
    cdef int axis
    for axis in range(3):
        if points[3 * row + axis] != points[3 * other + axis]:
            return points[3 * row + axis] < points[3 * other + axis]
    for axis in range(6):
        if ends[6 * row + axis] != ends[6 * other + axis]:
            return ends[6 * row + axis] < ends[6 * other + axis]
    return False


# --- drops -----------------------------------------------------------------------------------------------------------

def drops(host, guest, turn, shift, frame, limits, bint guest_falls):
    cdef Search search
    cdef Box of_guest, of_host
    cdef Py_ssize_t k
    one, other = guest.tree, host.tree
    search.guest, search.host = tree_of(one[0], one[1], one[2]), tree_of(other[0], other[1], other[2])
    cdef Placement at = placement_of(turn, shift), upright = placement_of(frame, (0.0, 0.0, 0.0))
    search.guest_at, search.host_at = upright, upright
    multiply(&search.guest_at, &upright, &at)
    search.bottom, search.reach, search.touch = limits
    search.bottom += search.reach
    search.guest_falls, search.first = guest_falls, INFINITY
    told = np.full(search.guest.m if guest_falls else search.host.m, np.inf)
    cdef double[::1] each = told
    if not (search.guest.m and search.host.m):
        return None
    search.each = &each[0]
    node_box(&of_guest, &search.guest, 0, &search.guest_at)
    node_box(&of_host, &search.host, 0, &search.host_at)
    if may_fall(&search, &of_guest, &of_host):
        drop_down(&search, 0, 0, &of_guest, &of_host)
    if search.first == INFINITY:
        return None
    for k in range(each.shape[0]):
        if each[k] > search.first + search.touch:
            each[k] = INFINITY
    return told


cdef void multiply(Placement* found, const Placement* frame, const Placement* at) noexcept:
    """A placement seen from an upright frame."""
    cdef int i, j
    cdef const double* row
    for i in range(3):
        row = frame.turn + 3 * i
        for j in range(3):
            found.turn[3 * i + j] = at.turn[j] * row[0] + at.turn[3 + j] * row[1] + at.turn[6 + j] * row[2]
        found.shift[i] = row[0] * at.shift[0] + row[1] * at.shift[1] + row[2] * at.shift[2]


cdef inline bint may_fall(const Search* search, const Box* of_guest, const Box* of_host) noexcept:
    """Whether something in one box may fall onto something in the other sooner than what is known to meet."""
    cdef const Box* p = of_guest if search.guest_falls else of_host
    cdef const Box* q = of_host if search.guest_falls else of_guest
    cdef double most = lesser(search.reach, search.first + search.touch) + ROUNDING_M
    return (
        p.low[2] <= search.bottom + ROUNDING_M
        and p.low[0] <= q.high[0] + ROUNDING_M and q.low[0] <= p.high[0] + ROUNDING_M
        and p.low[1] <= q.high[1] + ROUNDING_M and q.low[1] <= p.high[1] + ROUNDING_M
        and p.low[2] - q.high[2] <= most and q.low[2] - p.high[2] <= search.touch + ROUNDING_M
    )


cdef void drop_down(Search* search, Py_ssize_t g, Py_ssize_t h, const Box* box_g, const Box* box_h) noexcept:
    cdef Box child
    cdef Py_ssize_t k
    cdef bint is_leaf_g = g >= search.guest.n_leaves - 1, is_leaf_h = h >= search.host.n_leaves - 1
    if is_leaf_g and is_leaf_h:
        visit_drops(search, g - search.guest.n_leaves + 1, h - search.host.n_leaves + 1)
    elif is_leaf_h or (not is_leaf_g and longest(box_g) > longest(box_h)):
        for k in range(2 * g + 1, 2 * g + 3):
            node_box(&child, &search.guest, k, &search.guest_at)
            if may_fall(search, &child, box_h):
                drop_down(search, k, h, &child, box_h)
    else:
        for k in range(2 * h + 1, 2 * h + 3):
            node_box(&child, &search.host, k, &search.host_at)
            if may_fall(search, box_g, &child):
                drop_down(search, g, k, box_g, &child)


cdef void visit_drops(Search* search, Py_ssize_t leaf_g, Py_ssize_t leaf_h) noexcept:
    cdef Triangle[LEAF_SIZE] of_guest
    cdef Triangle[LEAF_SIZE] of_host
    cdef Box[LEAF_SIZE] boxes_g
    cdef Box[LEAF_SIZE] boxes_h
    cdef Triangle inset
    cdef Triangle* p
    cdef Triangle* q
    cdef Py_ssize_t n = leaf_triangles(of_guest, &search.guest, leaf_g, &search.guest_at)
    cdef Py_ssize_t m = leaf_triangles(of_host, &search.host, leaf_h, &search.host_at), i, j, row
    cdef double least, most
    for i in range(n):
        triangle_box(&boxes_g[i], &of_guest[i])
    for j in range(m):
        triangle_box(&boxes_h[j], &of_host[j])
    for i in range(n):
        for j in range(m):
            if not may_fall(search, &boxes_g[i], &boxes_h[j]):
                continue
            if search.guest_falls:
                p, q, row = &of_guest[i], &of_host[j], search.guest.order[LEAF_SIZE * leaf_g + i]
                if boxes_g[i].low[2] > search.bottom:
                    continue
            else:
                p, q, row = &of_host[j], &of_guest[i], search.host.order[LEAF_SIZE * leaf_h + j]
                if boxes_h[j].low[2] > search.bottom:
                    continue
            if not is_level(q):
                continue
            shrink(&inset, p)
            least, most = INFINITY, -INFINITY
            measure_corners(&least, &most, &inset, q, 1.0)
            measure_corners(&least, &most, q, &inset, -1.0)
            measure_crossings(&least, &most, &inset, q)
            if least >= -search.reach and least <= search.reach and most >= -search.touch:
                if least < -search.touch:
                    least = 0.0
                search.each[row] = lesser(search.each[row], least)
                search.first = lesser(search.first, least)


cdef inline bint is_level(const Triangle* one) noexcept:
    cdef double u[3]
    cdef double v[3]
    cdef double normal[3]
    cdef double length
    less(u, one.corners[1], one.corners[0])
    less(v, one.corners[2], one.corners[0])
    normal[0] = u[1] * v[2] - u[2] * v[1]
    normal[1] = u[2] * v[0] - u[0] * v[2]
    normal[2] = u[0] * v[1] - u[1] * v[0]
    length = sqrt(dot(normal, normal))
    return length > 0 and fabs(normal[2]) >= HOLDING * length


cdef void shrink(Triangle* found, const Triangle* one) noexcept:
    """A triangle a little smaller, about its middle."""
    cdef double extent = 0, share
    cdef double inwards[3][3]
    cdef double middle
    cdef int axis, corner
    for axis in range(3):
        middle = (one.corners[0][axis] + one.corners[1][axis] + one.corners[2][axis]) / 3
        for corner in range(3):
            inwards[corner][axis] = middle - one.corners[corner][axis]
            extent = greater(extent, fabs(inwards[corner][axis]))
    share = lesser(INSET, INSET_M / greater(extent, INSET_M))
    for axis in range(3):
        for corner in range(3):
            found.corners[corner][axis] = inwards[corner][axis] * share + one.corners[corner][axis]
