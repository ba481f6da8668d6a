"""The compiled twins of the kernels in `mesh_distance`, which descend two `TriangleTree`s at once.

The arithmetic of one pair of triangles repeats that of `triangles`, operation by operation, for equal bits.
"""

import numpy as np

from libc.math cimport INFINITY, NAN, fabs, sqrt
from libc.stdlib cimport calloc, free, malloc, realloc
from libc.string cimport memcpy, memset

from scene2hap.contact.geometry._spread cimport MAX_POINTS, SPREAD_M, TIE_M, distance_between, farthest

# As in `triangles`, `mesh_distance` and `triangle_tree`.
cdef double PARALLEL = 1e-12
cdef double RIM = 1e-9
cdef double IN_PLANE_M = 1e-9
cdef double ROUNDING_M = 1e-9
cdef double HOLDING = 0.5
cdef double INSET = 1e-4
cdef double INSET_M = 1e-4
# A point this far outside an edge, in barycentric units, is outside despite rounding.
cdef double OUTSIDE = 1e-3


cdef struct Box:
    double low[3]
    double high[3]


cdef struct Face:
    double corners[3][3]  # by corner, then by axis; shrunk for a falling triangle
    double edges[3][3]    # from each corner to the next
    double v[3]           # from the first corner to the last; `edges[0]` is u
    double normal[3]
    double uu, uv, vv, area2, root
    bint is_level         # for `drops`
    bint is_measured      # if False, only the corners are valid
    unsigned char features


cdef inline double lesser(double x, double y) noexcept:
    # C's `fmin` is not inlined, since it must handle nan.
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


cdef inline bint is_within(const Box* a, const Box* b, double reach) noexcept:
    """Return True unless two boxes are farther apart than a distance along an axis."""
    return (
        a.low[0] <= b.high[0] + reach and b.low[0] <= a.high[0] + reach
        and a.low[1] <= b.high[1] + reach and b.low[1] <= a.high[1] + reach
        and a.low[2] <= b.high[2] + reach and b.low[2] <= a.high[2] + reach
    )


cdef inline double squared_distance(const Box* a, const Box* b) noexcept:
    """Return the squared distance of two boxes, inf if one is empty."""
    cdef double gap, total = 0
    cdef int axis
    for axis in range(3):
        gap = greater(greater(a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]), 0.0)
        total += gap * gap
    return total


# --- trees in the frame of a search ----------------------------------------------------------------------------------

cdef struct Placement:
    double turn[9]
    double shift[3]


cdef enum Role:
    SURFACE
    FALLER
    BEARER


cdef struct Memory:
    char* at
    size_t size
    bint is_used


cdef struct Tree:
    const double* nodes        # (2 n_leaves - 1, 6) lowest and highest corners
    const double* corners      # (n_leaves, 9)
    const Py_ssize_t* columns  # (n_leaves,) in the shape
    const unsigned char* features  # (n_leaves,)
    Py_ssize_t n_leaves, m
    bint is_placed             # if False, the tree is in the frame of the search already
    Placement at
    Role role
    # Filled at the first visit of a node: boxes of a placed tree, faces of leaves. NULL while the tree is not open.
    Face* faces
    Box* boxes
    char* is_known
    Memory* memory


# Memory of the last searches, kept for the next ones. For meshes of 10,000 triangles the system would take it back
# after each search, and its pages would cost a quarter of the time.
cdef Memory kept[2]
cdef enum:
    MOST_KEPT = 1 << 26  # [bytes] of each


cdef int open_tree(Tree* tree, shape, Role role, const Placement* at) except -1:
    """Open the tree of a shape at a placement, or in the shape's frame if `at` is NULL; `close_tree` frees it."""
    over = shape.tree
    cdef const double[:, ::1] nodes = over[0]
    cdef const double[:, ::1] corners = over[1]
    cdef const Py_ssize_t[::1] columns = over[2]
    cdef const unsigned char[::1] features = over[3]
    cdef Py_ssize_t n_nodes = nodes.shape[0]
    tree.m, tree.n_leaves = shape.triangles.shape[2], columns.shape[0]
    tree.nodes, tree.corners, tree.columns, tree.features = &nodes[0, 0], &corners[0, 0], &columns[0], &features[0]
    tree.role, tree.is_placed = role, at != NULL
    if tree.is_placed:
        tree.at = at[0]
    # Memory for all nodes, though a search visits few: the system provides pages on first use.
    tree.memory = reserved(tree.n_leaves * sizeof(Face) + n_nodes * (sizeof(Box) + 1))
    if tree.memory == NULL or tree.memory.at == NULL:
        raise MemoryError
    tree.faces = <Face*>tree.memory.at
    tree.boxes = <Box*>(tree.faces + tree.n_leaves)
    tree.is_known = <char*>(tree.boxes + n_nodes)
    memset(tree.is_known, 0, n_nodes)
    return 0


cdef Memory* reserved(size_t size) noexcept:
    """Return memory of at least a size, NULL if there is none; `close_tree` gives it back."""
    cdef Memory* memory = &kept[0]
    if memory.is_used:
        memory = &kept[1]
    if memory.is_used:  # another thread is within a search
        memory = <Memory*>calloc(1, sizeof(Memory))
    if memory != NULL and memory.size < size:
        free(memory.at)
        memory.at = <char*>malloc(size)
        memory.size = 0 if memory.at == NULL else size
    if memory != NULL:
        memory.is_used = True
    return memory


cdef void close_tree(Tree* tree) noexcept:
    cdef Memory* memory = tree.memory
    cdef bint is_kept = memory == &kept[0] or memory == &kept[1]
    if memory == NULL:
        return
    memory.is_used = False
    if not is_kept or memory.size > MOST_KEPT:
        free(memory.at)
        memory.at, memory.size = NULL, 0
    if not is_kept:
        free(memory)


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


cdef inline const Box* box_of(Tree* tree, Py_ssize_t node) noexcept:
    """Return the box of a node in the frame of the search."""
    if not tree.is_placed:
        return <const Box*>(tree.nodes + 6 * node)
    if not tree.is_known[node]:
        tree.is_known[node] = True
        if node >= tree.n_leaves - 1 and tree.columns[node - tree.n_leaves + 1] >= 0:
            place_face(tree, node - tree.n_leaves + 1, &tree.boxes[node])
        else:
            place_box(&tree.boxes[node], tree.nodes + 6 * node, &tree.at)
    return &tree.boxes[node]


cdef void place_box(Box* box, const double* corners, const Placement* at) noexcept:
    """Compute the AABB of a placed box."""
    cdef double middle[3]
    cdef double half[3]
    cdef double placed[3]
    cdef double reach
    cdef int axis
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


cdef void place_face(Tree* tree, Py_ssize_t leaf, Box* box) noexcept:
    """Place the triangle of a leaf and compute its AABB."""
    cdef Face* face = tree.faces + leaf
    cdef int corner, axis
    for corner in range(3):
        place(face.corners[corner], tree.corners + 9 * leaf + 3 * corner, &tree.at)
    for axis in range(3):
        box.low[axis] = lesser(lesser(face.corners[0][axis], face.corners[1][axis]), face.corners[2][axis])
        box.high[axis] = greater(greater(face.corners[0][axis], face.corners[1][axis]), face.corners[2][axis])
    face.is_measured = False


cdef inline Py_ssize_t column_of(const Tree* tree, Py_ssize_t node) noexcept:
    """Return the column of a leaf's triangle in its shape, -1 for an empty leaf."""
    return tree.columns[node - tree.n_leaves + 1]


cdef inline const Face* face_of(Tree* tree, Py_ssize_t node) noexcept:
    """Return the triangle of a leaf in the frame of the search. `box_of` must have visited the leaf before."""
    cdef Py_ssize_t leaf = node - tree.n_leaves + 1
    cdef Face* face = tree.faces + leaf
    if not tree.is_placed:
        if tree.is_known[node]:
            return face
        tree.is_known[node] = True
        memcpy(&face.corners, tree.corners + 9 * leaf, 9 * sizeof(double))
        face.is_measured = False
    if not face.is_measured:
        face.is_measured = True
        face.features = tree.features[leaf]
        if tree.role == FALLER:
            shrink(face)
        measure_face(face)
    return face


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


# --- one pair of triangles -------------------------------------------------------------------------------------------

cdef struct Meetings:
    int n
    double distance[21]
    double on_p[21][3]
    double on_q[21][3]


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


cdef void meet(Meetings* found, const Face* p, const Face* q, double within) noexcept:
    """Collect the local meetings of a pair's features within reach, in the order of `triangles.meetings`."""
    cdef double over_p[3]
    cdef double over_q[3]
    found.n = 0
    if not heights_over(over_q, q, p, within + ROUNDING_M) or not heights_over(over_p, p, q, within + ROUNDING_M):
        return
    meet_edges(found, p, q, within)
    meet_corners(found, p, q, over_q, within, False)
    meet_corners(found, q, p, over_p, within, True)
    cross_edges(found, p, q, over_q)
    cross_edges(found, q, p, over_p)


cdef inline void add(Meetings* found, double distance, const double* on_p, const double* on_q) noexcept:
    cdef int axis
    found.distance[found.n] = distance
    for axis in range(3):
        found.on_p[found.n][axis], found.on_q[found.n][axis] = on_p[axis], on_q[axis]
    found.n += 1


cdef void meet_edges(Meetings* found, const Face* p, const Face* q, double within) noexcept:
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
                add(found, sqrt(distance2), on_p, on_q)


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


cdef void cross_edges(Meetings* found, const Face* other, const Face* own, const double* heights) noexcept:
    """Add the points where the other's edges intersect a face."""
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
        if start * end < 0 and fabs(start) > in_plane and fabs(end) > in_plane:
            s = start / (start - end)
            for axis in range(3):
                point[axis] = (other.corners[(i + 1) % 3][axis] - other.corners[i][axis]) * s + other.corners[i][axis]
            if is_inside(own, point):
                add(found, 0.0, point, point)


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


# --- distance and contact points -------------------------------------------------------------------------------------

cdef enum:
    HEIGHT = 4  # of the nodes of a patch, 16 triangles each: in real scenes 2 and 3 take longer


cdef struct Nodes:
    Py_ssize_t guest, host
    const Box* of_guest
    const Box* of_host


cdef struct Patch:
    Nodes nodes
    Box around              # a box around the middles of their contact points
    double most_apart2      # upper bound of the squared distance of such a point from the nearest place


cdef struct Points:
    double* ends     # (n, 6) on guest and host
    double* middles  # (n, 3)
    double* apart    # (n,) distance from the nearest place
    Py_ssize_t n, capacity


cdef struct Search:
    Tree guest, host
    double within
    # closest_points
    double best
    Py_ssize_t best_guest, best_host
    double on_guest[3]
    double on_host[3]
    bint is_full
    # contact_points
    double way[3]
    double[MAX_POINTS][3] places  # the next point is to be far from each of these
    int n_places
    double most                   # distance of the farthest point found from the nearest place
    Points points
    Patch* patches                # those not measured at once
    Py_ssize_t n_patches, patch_capacity
    Patch** heap                  # (n_left,) those not measured yet, the one with the largest bound first
    Py_ssize_t n_left
    bint is_out_of_memory
    # drops
    bint guest_falls
    double bottom, reach, touch, first
    double later          # how far beyond the least fall distance others are searched
    double* each          # NULL if only the least is needed


cdef inline Nodes roots_of(Search* search) noexcept:
    return Nodes(0, 0, box_of(&search.guest, 0), box_of(&search.host, 0))


cdef inline bint halve(Nodes* halves, Search* search, const Nodes* whole, int height) noexcept:
    """Replace the longer of two nodes by its children. Returns False if both are at this height or below."""
    cdef bint is_low_g = whole.guest >= (search.guest.n_leaves >> height) - 1
    cdef bint is_low_h = whole.host >= (search.host.n_leaves >> height) - 1
    cdef int k
    if is_low_g and is_low_h:
        return False
    halves[0] = halves[1] = whole[0]
    if is_low_h or (not is_low_g and longest(whole.of_guest) > longest(whole.of_host)):
        for k in range(2):
            halves[k].guest = 2 * whole.guest + 1 + k
            halves[k].of_guest = box_of(&search.guest, halves[k].guest)
    else:
        for k in range(2):
            halves[k].host = 2 * whole.host + 1 + k
            halves[k].of_host = box_of(&search.host, halves[k].host)
    return True


cdef inline double longest(const Box* box) noexcept:
    return greater(greater(box.high[0] - box.low[0], box.high[1] - box.low[1]), box.high[2] - box.low[2])


cdef void descend(Search* search, const Nodes* nodes) noexcept:
    """Visit the pairs of leaves below two nodes whose boxes are within reach, the nearer half first."""
    cdef Nodes halves[2]
    cdef double apart2[2]
    cdef int k
    if not halve(halves, search, nodes, 0):
        visit(search, nodes)
        return
    for k in range(2):
        apart2[k] = squared_distance(halves[k].of_guest, halves[k].of_host)
    k = apart2[1] < apart2[0]
    if apart2[k] <= reach2(search):
        descend(search, &halves[k])
    if apart2[1 - k] <= reach2(search):
        descend(search, &halves[1 - k])


cdef void find_patches(Search* search, const Nodes* nodes) noexcept:
    """Find the pairs of small nodes below two nodes whose boxes are within reach, those far from the place first."""
    cdef Nodes halves[2]
    cdef const double* place = search.places[0]
    cdef int k
    if not halve(halves, search, nodes, HEIGHT):
        add_patch(search, nodes)
        return
    if halves[0].host == halves[1].host:
        k = most_apart2(halves[1].of_guest, place) > most_apart2(halves[0].of_guest, place)
    else:
        k = most_apart2(halves[1].of_host, place) > most_apart2(halves[0].of_host, place)
    for _ in range(2):
        if is_within(halves[k].of_guest, halves[k].of_host, search.within + ROUNDING_M):
            find_patches(search, &halves[k])
        k = 1 - k


cdef inline double most_apart2(const Box* box, const double* place) noexcept:
    """Return the largest squared distance of a point of a box from a place."""
    cdef double gap, total = 0
    cdef int axis
    for axis in range(3):
        gap = greater(fabs(box.low[axis] - place[axis]), fabs(box.high[axis] - place[axis]))
        total += gap * gap
    return total


cdef void add_patch(Search* search, const Nodes* nodes) noexcept:
    """Measure a patch if it may have a farther point than those found; else keep it for later."""
    cdef const Box* a = nodes.of_guest
    cdef const Box* b = nodes.of_host
    cdef Patch patch
    cdef Patch* patches
    cdef double reach = search.within + ROUNDING_M
    cdef int axis
    for axis in range(3):
        # Each end is within reach of the other box.
        patch.around.low[axis] = (
            greater(a.low[axis], b.low[axis] - reach) + greater(b.low[axis], a.low[axis] - reach) - search.way[axis]
        ) / 2
        patch.around.high[axis] = (
            lesser(a.high[axis], b.high[axis] + reach) + lesser(b.high[axis], a.high[axis] + reach) - search.way[axis]
        ) / 2
    patch.nodes, patch.most_apart2 = nodes[0], most_apart2(&patch.around, search.places[0])
    if is_promising(search, &patch):
        measure_patch(search, nodes)
        return
    if search.n_patches == search.patch_capacity:
        search.patch_capacity = 2 * search.patch_capacity + 64
        patches = <Patch*>realloc(search.patches, search.patch_capacity * sizeof(Patch))
        if patches == NULL:
            search.is_out_of_memory, search.patch_capacity = True, search.n_patches
            return
        search.patches = patches
    search.patches[search.n_patches] = patch
    search.n_patches += 1


cdef inline bint is_promising(const Search* search, const Patch* patch) noexcept:
    """Return True if a patch may have a point that is farther than those found, or about as far."""
    # Bounds have other rounding errors than distances.
    return patch.most_apart2 >= greater(search.most - TIE_M - ROUNDING_M, 0.0) ** 2


cdef void measure_patch(Search* search, const Nodes* nodes) noexcept:
    """Collect the contact points below two nodes."""
    cdef Nodes halves[2]
    cdef int k
    if not halve(halves, search, nodes, 0):
        collect(search, nodes)
        return
    for k in range(2):
        if is_within(halves[k].of_guest, halves[k].of_host, search.within + ROUNDING_M):
            measure_patch(search, &halves[k])


cdef inline double reach2(const Search* search) noexcept:
    cdef double reach = search.best + ROUNDING_M
    return -1.0 if search.is_full else reach * reach


cdef void visit(Search* search, const Nodes* leaves) noexcept:
    cdef Meetings found
    meet(&found, face_of(&search.guest, leaves.guest), face_of(&search.host, leaves.host), search.best)
    if found.n:
        compare(search, &found, column_of(&search.guest, leaves.guest), column_of(&search.host, leaves.host))


cdef void compare(Search* search, const Meetings* found, Py_ssize_t i, Py_ssize_t j) noexcept:
    """Keep the nearest meeting of all pairs; ties go to the lowest columns."""
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


cdef void collect(Search* search, const Nodes* leaves) noexcept:
    """Add the contact points of a pair of triangles."""
    cdef Meetings found
    cdef double[6] ends
    cdef double[3] middle
    cdef double apart
    cdef int row, axis, k
    meet(&found, face_of(&search.guest, leaves.guest), face_of(&search.host, leaves.host), search.within)
    for row in range(found.n):
        if found.distance[row] > search.within:
            continue
        for axis in range(3):
            ends[axis], ends[axis + 3] = found.on_p[row][axis] - search.way[axis], found.on_q[row][axis]
            middle[axis] = (ends[axis] + ends[axis + 3]) / 2
        apart = INFINITY
        for k in range(search.n_places):
            apart = lesser(apart, distance_between(middle, search.places[k], 3))
        search.most = greater(search.most, apart)
        if not append(&search.points, ends, middle, apart):
            search.is_out_of_memory = True


cdef bint append(Points* points, const double* ends, const double* middle, double apart) noexcept:
    """Append a point. Returns False without memory."""
    if points.n == points.capacity:
        points.capacity = 2 * points.capacity + 64
        if not (grow(&points.ends, 6 * points.capacity) and grow(&points.middles, 3 * points.capacity)
                and grow(&points.apart, points.capacity)):
            points.capacity = points.n
            return False
    memcpy(points.ends + 6 * points.n, ends, 6 * sizeof(double))
    memcpy(points.middles + 3 * points.n, middle, 3 * sizeof(double))
    points.apart[points.n] = apart
    points.n += 1
    return True


cdef inline bint grow(double** array, Py_ssize_t n) noexcept:
    cdef double* larger = <double*>realloc(array[0], n * sizeof(double))
    if larger == NULL:
        return False
    array[0] = larger
    return True


cdef int start(Search* search, host, guest, turn, shift, double within) except -1:
    """Begin a search. The caller must `close` it."""
    cdef Placement at = placement_of(turn, shift)
    open_tree(&search.guest, guest, SURFACE, &at)
    open_tree(&search.host, host, SURFACE, NULL)
    search.within = search.best = within
    search.best_guest, search.is_full = -1, False
    return 0


cdef void close(Search* search) noexcept:
    close_tree(&search.guest)
    close_tree(&search.host)
    free(search.patches)
    free(search.heap)
    free(search.points.ends)
    free(search.points.middles)
    free(search.points.apart)


def closest_points(host, guest, turn, shift, double within):
    cdef Search search
    cdef Nodes roots
    memset(&search, 0, sizeof(Search))
    try:
        start(&search, host, guest, turn, shift, within)
        if search.guest.m and search.host.m:
            roots = roots_of(&search)
            if squared_distance(roots.of_guest, roots.of_host) <= reach2(&search):
                descend(&search, &roots)
    finally:
        close(&search)
    if search.best_guest < 0:
        return None
    return search.best, triple(search.on_guest), triple(search.on_host)


def contact_points(host, guest, turn, shift, way, double within):
    cdef Search search
    cdef double[MAX_POINTS][6] chosen
    cdef Placement at = placement_of(turn, shift)
    cdef int k, n
    memset(&search, 0, sizeof(Search))
    x, y, z = shift
    u, v, w = way
    try:
        start(&search, host, guest, turn, (x + u, y + v, z + w), within)
        search.way[0], search.way[1], search.way[2] = u, v, w
        # The lowest corner of the guest's box: from its middle, all points of a ball would be about as far.
        place(search.places[0], search.guest.nodes, &at)
        n = choose(chosen, &search)
        if n < 0:
            raise MemoryError
        return [(triple(chosen[k]), triple(chosen[k] + 3)) for k in range(n)]
    finally:
        close(&search)


cdef triple(const double* point):
    return (point[0], point[1], point[2])


cdef int choose(double[6]* chosen, Search* search) noexcept:
    """Choose the ends of contact points, each the farthest from the first place or from those chosen before.

    By branch and bound: only patches that may have such a point are measured. Surfaces of 10,000 triangles that lie on
    each other have thousands of contact points, which would all be compared for the sake of four. Returns how many are
    chosen, -1 without memory.
    """
    cdef double least = -1.0
    cdef Nodes roots
    cdef Py_ssize_t row
    cdef Patch* patch
    cdef int count, axis
    search.n_places, search.most = 1, least
    if not (search.guest.m and search.host.m):
        return 0
    roots = roots_of(search)
    if is_within(roots.of_guest, roots.of_host, search.within + ROUNDING_M):
        find_patches(search, &roots)
    search.n_left, search.heap = search.n_patches, <Patch**>malloc((search.n_patches + 1) * sizeof(Patch*))
    if search.heap == NULL:
        return -1
    for row in range(search.n_patches):
        search.heap[row] = search.patches + row
    for count in range(MAX_POINTS):
        if count:
            least, search.n_places = SPREAD_M, count
            measure_from_last_place(search, least)
        while search.n_left and is_promising(search, search.heap[0]):
            patch = search.heap[0]
            search.n_left -= 1
            search.heap[0] = search.heap[search.n_left]
            sift_down(search, 0)
            measure_patch(search, &patch.nodes)
        if search.is_out_of_memory:
            return -1
        if search.most <= least:
            return count
        take_farthest(chosen[count], &search.points)
        for axis in range(3):
            search.places[count][axis] = (chosen[count][axis] + chosen[count][axis + 3]) / 2
    return MAX_POINTS


cdef void sift_down(Search* search, Py_ssize_t row) noexcept:
    """Restore the order of the heap below a row."""
    cdef Patch* patch
    cdef Patch** heap = search.heap
    cdef Py_ssize_t child
    if row >= search.n_left:
        return
    patch = heap[row]
    while True:
        child = 2 * row + 1
        if child + 1 < search.n_left and heap[child + 1].most_apart2 > heap[child].most_apart2:
            child += 1
        if child >= search.n_left or heap[child].most_apart2 <= patch.most_apart2:
            break
        heap[row] = heap[child]
        row = child
    heap[row] = patch


cdef void measure_from_last_place(Search* search, double least) noexcept:
    """Include the last place in the distances of points and patches. The first chosen one replaces the corner."""
    cdef Points* points = &search.points
    cdef Patch* patch
    cdef const double* place = search.places[search.n_places - 1]
    cdef double apart
    cdef Py_ssize_t row
    search.most = least
    for row in range(points.n):
        apart = distance_between(points.middles + 3 * row, place, 3)
        points.apart[row] = apart if search.n_places == 1 else lesser(points.apart[row], apart)
        search.most = greater(search.most, points.apart[row])
    for row in range(search.n_left):
        patch = search.heap[row]
        apart = most_apart2(&patch.around, place)
        patch.most_apart2 = apart if search.n_places == 1 else lesser(patch.most_apart2, apart)
    for row in range(search.n_left // 2 - 1, -1, -1):
        sift_down(search, row)


cdef void take_farthest(double* ends, const Points* points) noexcept:
    """Copy the ends of the farthest point, by the rule of `spread`."""
    cdef Py_ssize_t row, best = farthest(points.middles, points.apart, points.n, 3)
    for row in range(points.n):
        # Among equal middles the ends decide, so that the order of the search has no effect.
        if compared(points.middles + 3 * row, points.middles + 3 * best, 3) == 0:
            if compared(points.ends + 6 * row, points.ends + 6 * best, 6) < 0:
                best = row
    memcpy(ends, points.ends + 6 * best, 6 * sizeof(double))


cdef inline int compared(const double* x, const double* y, int n) noexcept:
    """Return -1, 0 or 1 if one row of coordinates is before, equal to or behind another."""
    cdef int k
    for k in range(n):
        if x[k] != y[k]:
            return -1 if x[k] < y[k] else 1
    return 0


# --- drops -----------------------------------------------------------------------------------------------------------

def drops(host, guest, turn, shift, frame, limits, bint guest_falls):
    cdef double first, touch = limits[2]
    cdef Py_ssize_t k
    cdef double[::1] each
    if not (host.triangles.shape[2] and guest.triangles.shape[2]):
        return None
    falls = np.full((guest if guest_falls else host).triangles.shape[2], np.inf)
    each = falls
    first = search_drops(host, guest, turn, shift, frame, limits, guest_falls, touch, &each[0])
    if first == INFINITY:
        return None
    for k in range(each.shape[0]):
        if each[k] > first + touch:
            each[k] = INFINITY
    return falls


def first_drop(host, guest, turn, shift, frame, limits, bint guest_falls):
    return search_drops(host, guest, turn, shift, frame, limits, guest_falls, 0.0, NULL)


cdef double search_drops(
    host, guest, turn, shift, frame, limits, bint guest_falls, double later, double* each
) except? -1:
    """Return the least fall distance, at least -touch, inf for none. Those up to `later` above it go into `each`."""
    cdef Search search
    cdef Nodes roots
    cdef Placement at = placement_of(turn, shift), upright = placement_of(frame, (0.0, 0.0, 0.0)), placed
    memset(&search, 0, sizeof(Search))
    try:
        multiply(&placed, &upright, &at)
        open_tree(&search.guest, guest, FALLER if guest_falls else BEARER, &placed)
        open_tree(&search.host, host, BEARER if guest_falls else FALLER, &upright)
        search.bottom, search.reach, search.touch = limits
        search.bottom += search.reach
        search.guest_falls, search.first, search.later, search.each = guest_falls, INFINITY, later, each
        if search.guest.m and search.host.m:
            roots = roots_of(&search)
            if fall(&search, &roots) < INFINITY:
                drop_down(&search, &roots)
    finally:
        close(&search)
    return search.first


cdef void multiply(Placement* found, const Placement* frame, const Placement* at) noexcept:
    """Express a placement in an upright frame."""
    cdef int i, j
    cdef const double* row
    for i in range(3):
        row = frame.turn + 3 * i
        for j in range(3):
            found.turn[3 * i + j] = at.turn[j] * row[0] + at.turn[3 + j] * row[1] + at.turn[6 + j] * row[2]
        found.shift[i] = row[0] * at.shift[0] + row[1] * at.shift[1] + row[2] * at.shift[2]


cdef inline double most_fall(const Search* search) noexcept:
    return lesser(search.reach, search.first + search.later) + ROUNDING_M


cdef inline double fall(const Search* search, const Nodes* nodes) noexcept:
    """Return a lower bound of the fall distance between the contents of two nodes, inf if surely too large."""
    cdef const Box* p = nodes.of_guest if search.guest_falls else nodes.of_host
    cdef const Box* q = nodes.of_host if search.guest_falls else nodes.of_guest
    if (
        p.low[2] <= search.bottom + ROUNDING_M
        and p.low[0] <= q.high[0] + ROUNDING_M and q.low[0] <= p.high[0] + ROUNDING_M
        and p.low[1] <= q.high[1] + ROUNDING_M and q.low[1] <= p.high[1] + ROUNDING_M
        and p.low[2] - q.high[2] <= most_fall(search) and q.low[2] - p.high[2] <= search.touch + ROUNDING_M
    ):
        return p.low[2] - q.high[2]
    return INFINITY


cdef void drop_down(Search* search, const Nodes* nodes) noexcept:
    """Visit the pairs of leaves below two nodes that may fall onto each other, the half with the least fall first."""
    cdef Nodes halves[2]
    cdef double falls[2]
    cdef int k
    if not halve(halves, search, nodes, 0):
        visit_drops(search, nodes)
        return
    for k in range(2):
        falls[k] = fall(search, &halves[k])
    k = falls[1] < falls[0]
    if falls[k] <= most_fall(search):
        drop_down(search, &halves[k])
    if falls[1 - k] <= most_fall(search):
        drop_down(search, &halves[1 - k])


cdef void visit_drops(Search* search, const Nodes* leaves) noexcept:
    cdef const Face* of_guest = face_of(&search.guest, leaves.guest)
    cdef const Face* of_host = face_of(&search.host, leaves.host)
    cdef const Face* p = of_guest if search.guest_falls else of_host
    cdef const Face* q = of_host if search.guest_falls else of_guest
    cdef const Box* around = leaves.of_guest if search.guest_falls else leaves.of_host
    cdef Py_ssize_t column
    cdef double least = INFINITY, most = -INFINITY
    if not q.is_level or around.low[2] > search.bottom:
        return
    if not (measure_corners(&least, &most, p, q, 1.0) and measure_corners(&least, &most, q, p, -1.0)):
        return
    measure_crossings(&least, &most, p, q)
    if least >= -search.reach and least <= search.reach and most >= -search.touch:
        if least < -search.touch:
            least = 0.0
        if search.each != NULL:
            if search.guest_falls:
                column = column_of(&search.guest, leaves.guest)
            else:
                column = column_of(&search.host, leaves.host)
            search.each[column] = lesser(search.each[column], least)
        search.first = lesser(search.first, least)
