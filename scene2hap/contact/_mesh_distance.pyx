"""The compiled twins of the kernels in `mesh_distance`, which descend two `TriangleTree`s at once."""

import numpy as np

from libc.math cimport INFINITY, fabs
from libc.stdlib cimport free, realloc
from libc.string cimport memcpy, memset

from scene2hap.contact.geometry._boxes cimport Box, greater, is_within, lesser, squared_distance
from scene2hap.contact.geometry._spread cimport MAX_POINTS, SPREAD_M, TIE_M, distance_between, farthest
from scene2hap.contact.geometry._triangle_tree cimport (
    BEARER,
    FALLER,
    SURFACE,
    Nodes,
    Placement,
    Tree,
    close_tree,
    column_of,
    face_of,
    halve,
    open_tree,
    place_point,
    placement_of,
    product,
    roots_of,
)
from scene2hap.contact.geometry._triangles cimport ROUNDING_M, Face, Meetings, measure_heights, meet


# --- distance ---------------------------------------------------------------------------------------------------------

cdef struct Nearest:
    Tree guest, host
    double best                       # least distance found; at first the largest relevant one
    Py_ssize_t best_guest, best_host  # columns of the two triangles, -1 before one is found
    double on_guest[3]
    double on_host[3]
    bint is_zero                      # the surfaces intersect, so no distance is smaller


def closest_points(host, guest, turn, shift, double within):
    cdef Nearest search
    cdef Nodes roots
    cdef Placement at = placement_of(turn, shift)
    memset(&search, 0, sizeof(Nearest))
    search.best, search.best_guest = within, -1
    try:
        open_tree(&search.guest, guest, SURFACE, &at)
        open_tree(&search.host, host, SURFACE, NULL)
        if search.guest.m and search.host.m:
            roots = roots_of(&search.guest, &search.host)
            if squared_distance(roots.of_guest, roots.of_host) <= reach2(&search):
                descend(&search, &roots)
    finally:
        close_tree(&search.guest)
        close_tree(&search.host)
    if search.best_guest < 0:
        return None
    return search.best, triple(search.on_guest), triple(search.on_host)


cdef triple(const double* point):
    return (point[0], point[1], point[2])


cdef void descend(Nearest* search, const Nodes* nodes) noexcept:
    """Visit the pairs of leaves below two nodes whose boxes are within reach, the nearer half first."""
    cdef Nodes halves[2]
    cdef double apart2[2]
    cdef int k
    if not halve(halves, &search.guest, &search.host, nodes):
        compare(search, nodes)
        return
    for k in range(2):
        apart2[k] = squared_distance(halves[k].of_guest, halves[k].of_host)
    k = apart2[1] < apart2[0]
    if apart2[k] <= reach2(search):
        descend(search, &halves[k])
    if apart2[1 - k] <= reach2(search):
        descend(search, &halves[1 - k])


cdef inline double reach2(const Nearest* search) noexcept:
    cdef double reach = search.best + ROUNDING_M
    return -1.0 if search.is_zero else reach * reach


cdef void compare(Nearest* search, const Nodes* leaves) noexcept:
    """Keep the nearest meeting of two triangles if it is the nearest of all; ties go to the lowest columns."""
    cdef Meetings found
    cdef Py_ssize_t i, j
    cdef int row, nearest = 0, axis
    cdef double distance
    meet(&found, face_of(&search.guest, leaves.guest), face_of(&search.host, leaves.host), search.best, -1.0)
    if not found.n:
        return
    for row in range(1, found.n):
        if found.distance[row] < found.distance[nearest]:
            nearest = row
    distance = found.distance[nearest]
    if distance > search.best:
        return
    i, j = column_of(&search.guest, leaves.guest), column_of(&search.host, leaves.host)
    if distance == search.best and search.best_guest >= 0:
        if i > search.best_guest or (i == search.best_guest and j > search.best_host):
            return
    search.best, search.best_guest, search.best_host = distance, i, j
    for axis in range(3):
        search.on_guest[axis], search.on_host[axis] = found.on_p[nearest][axis], found.on_q[nearest][axis]
    search.is_zero = distance <= ROUNDING_M


# --- contact points ---------------------------------------------------------------------------------------------------

cdef enum:
    HEIGHT = 6  # nodes of up to 64 triangles are measured whole, since bounds of smaller ones cost more than they save


cdef struct Part:
    Nodes nodes
    double most_apart2  # upper bound of the squared distance of the contact points below them from the nearest place


cdef struct Points:
    double* ends     # (n, 6) on guest and host
    double* middles  # (n, 3)
    double* apart    # (n,) distance from the nearest place
    Py_ssize_t n, capacity


cdef struct Spreading:
    Tree guest, host
    double within
    double loose                  # crossings between ends within this distance are left out
    double way[3]
    double[MAX_POINTS][3] places  # the next point is to be far from each of these
    int n_places
    double most                   # distance of the farthest point found from the nearest place
    Points points
    Part* heap                    # (n_left,) pairs of nodes that are not visited yet, the largest bound first
    Py_ssize_t n_left, capacity
    bint is_out_of_memory


def contact_points(host, guest, turn, shift, way, double within, place):
    found = points_without(host, guest, turn, shift, way, within, place, within)
    return found or points_without(host, guest, turn, shift, way, within, place, -1.0)


cdef points_without(host, guest, turn, shift, way, double within, place, double loose):
    """Return the contact points without crossings between ends within `loose`."""
    cdef Spreading search
    cdef double[MAX_POINTS][6] chosen
    cdef Placement at = placement_of(turn, shift), moved = at, in_world = placement_of(place[0], place[1])
    cdef int k, n
    memset(&search, 0, sizeof(Spreading))
    search.within, search.loose = within, loose
    for k in range(3):
        search.way[k] = way[k]
        moved.shift[k] = at.shift[k] + search.way[k]
    try:
        open_tree(&search.guest, guest, SURFACE, &moved)
        open_tree(&search.host, host, SURFACE, NULL)
        # First place: the lowest corner of the guest's box. All points of a ball are about as far from its middle.
        place_point(search.places[0], search.guest.nodes, &at)
        n = choose(chosen, &search)
        if n < 0:
            raise MemoryError
        for k in range(2 * n):
            place_point(chosen[0] + 3 * k, chosen[0] + 3 * k, &in_world)
        return [(triple(chosen[k]), triple(chosen[k] + 3)) for k in range(n)]
    finally:
        close_tree(&search.guest)
        close_tree(&search.host)
        free(search.heap)
        free(search.points.ends)
        free(search.points.middles)
        free(search.points.apart)


cdef int choose(double[6]* chosen, Spreading* search) noexcept:
    """Choose the ends of contact points: the farthest from the first place, then the farthest from all chosen ones.

    The search is branch and bound and visits only nodes that may have such a point. Two surfaces of 10,000 triangles
    in contact have thousands of contact points, but only four are chosen. Returns the number of chosen points, -1 if
    out of memory.
    """
    cdef double least = -1.0
    cdef Nodes nodes
    cdef int count, axis
    search.n_places, search.most = 1, least
    if not (search.guest.m and search.host.m):
        return 0
    nodes = roots_of(&search.guest, &search.host)
    if is_within(nodes.of_guest, nodes.of_host, search.within + ROUNDING_M):
        visit(search, &nodes)
    for count in range(MAX_POINTS):
        if count:
            least, search.n_places = SPREAD_M, count
            measure_from_last_place(search, least)
        while search.n_left and is_promising(search, search.heap[0].most_apart2):
            nodes = pop(search)
            visit(search, &nodes)
        if search.is_out_of_memory:
            return -1
        if search.most <= least:
            return count
        take_farthest(chosen[count], &search.points)
        for axis in range(3):
            search.places[count][axis] = (chosen[count][axis] + chosen[count][axis + 3]) / 2
    return MAX_POINTS


cdef void visit(Spreading* search, const Nodes* nodes) noexcept:
    """Collect the contact points below two nodes, the half with the larger bound first. Parts without a point that is
    farther than those found are kept for later."""
    cdef Nodes halves[2]
    cdef double most2[2]
    cdef int k, i
    if is_small(&search.guest, nodes.guest) and is_small(&search.host, nodes.host):
        measure(search, nodes)
        return
    halve(halves, &search.guest, &search.host, nodes)
    for k in range(2):
        most2[k] = -1.0
        if is_within(halves[k].of_guest, halves[k].of_host, search.within + ROUNDING_M):
            most2[k] = INFINITY
            for i in range(search.n_places):
                most2[k] = lesser(most2[k], most_apart2(search, &halves[k], search.places[i]))
    k = most2[1] > most2[0]
    for _ in range(2):
        if most2[k] >= 0:
            if is_promising(search, most2[k]):
                visit(search, &halves[k])
            else:
                push(search, &halves[k], most2[k])
        k = 1 - k


cdef inline bint is_small(const Tree* tree, Py_ssize_t node) noexcept:
    return node >= (tree.n_leaves >> HEIGHT) - 1


cdef void measure(Spreading* search, const Nodes* nodes) noexcept:
    """Collect the contact points below two nodes."""
    cdef Nodes halves[2]
    cdef int k
    if not halve(halves, &search.guest, &search.host, nodes):
        collect(search, nodes)
        return
    for k in range(2):
        if is_within(halves[k].of_guest, halves[k].of_host, search.within + ROUNDING_M):
            measure(search, &halves[k])


cdef inline bint is_promising(const Spreading* search, double most_apart2) noexcept:
    """Return True if nodes with this bound may have a point that is farther than those found, or about as far."""
    # Bounds have other rounding errors than distances.
    return most_apart2 >= greater(search.most - TIE_M - ROUNDING_M, 0.0) ** 2


cdef double most_apart2(const Spreading* search, const Nodes* nodes, const double* place) noexcept:
    """Return an upper bound of the squared distance of the contact points below two nodes from a place."""
    cdef const Box* a = nodes.of_guest
    cdef const Box* b = nodes.of_host
    cdef double reach = search.within + ROUNDING_M, low, high, gap, total = 0
    cdef int axis
    for axis in range(3):
        # The middles of the contact points are between these, since each end is within reach of the other box.
        low = (
            greater(a.low[axis], b.low[axis] - reach) + greater(b.low[axis], a.low[axis] - reach) - search.way[axis]
        ) / 2
        high = (
            lesser(a.high[axis], b.high[axis] + reach) + lesser(b.high[axis], a.high[axis] + reach) - search.way[axis]
        ) / 2
        gap = greater(fabs(low - place[axis]), fabs(high - place[axis]))
        total += gap * gap
    return total


cdef void collect(Spreading* search, const Nodes* leaves) noexcept:
    """Add the contact points of a pair of triangles."""
    cdef Meetings found
    cdef double[6] ends
    cdef double[3] middle
    cdef double apart
    cdef int row, axis, k
    meet(&found, face_of(&search.guest, leaves.guest), face_of(&search.host, leaves.host), search.within, search.loose)
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
    """Append a point. Returns False if out of memory."""
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


cdef void push(Spreading* search, const Nodes* nodes, double most_apart2) noexcept:
    """Add a pair of nodes to the heap."""
    cdef Part* heap
    cdef Py_ssize_t row = search.n_left, parent
    if row == search.capacity:
        search.capacity = 2 * search.capacity + 64
        heap = <Part*>realloc(search.heap, search.capacity * sizeof(Part))
        if heap == NULL:
            search.is_out_of_memory, search.capacity = True, row
            return
        search.heap = heap
    search.n_left += 1
    while row and search.heap[(row - 1) // 2].most_apart2 < most_apart2:
        parent = (row - 1) // 2
        search.heap[row] = search.heap[parent]
        row = parent
    search.heap[row] = Part(nodes[0], most_apart2)


cdef Nodes pop(Spreading* search) noexcept:
    """Remove the pair of nodes with the largest bound from the heap."""
    cdef Nodes nodes = search.heap[0].nodes
    search.n_left -= 1
    search.heap[0] = search.heap[search.n_left]
    sift_down(search, 0)
    return nodes


cdef void sift_down(Spreading* search, Py_ssize_t row) noexcept:
    """Restore the order of the heap below a row."""
    cdef Part* heap = search.heap
    cdef Part part
    cdef Py_ssize_t child
    if row >= search.n_left:
        return
    part = heap[row]
    while True:
        child = 2 * row + 1
        if child + 1 < search.n_left and heap[child + 1].most_apart2 > heap[child].most_apart2:
            child += 1
        if child >= search.n_left or heap[child].most_apart2 <= part.most_apart2:
            break
        heap[row] = heap[child]
        row = child
    heap[row] = part


cdef void measure_from_last_place(Spreading* search, double least) noexcept:
    """Include the last place in the distances of points and nodes. The first chosen place replaces the corner."""
    cdef Points* points = &search.points
    cdef Part* part
    cdef const double* place = search.places[search.n_places - 1]
    cdef double apart
    cdef Py_ssize_t row
    search.most = least
    for row in range(points.n):
        apart = distance_between(points.middles + 3 * row, place, 3)
        points.apart[row] = apart if search.n_places == 1 else lesser(points.apart[row], apart)
        search.most = greater(search.most, points.apart[row])
    for row in range(search.n_left):
        part = search.heap + row
        apart = most_apart2(search, &part.nodes, place)
        part.most_apart2 = apart if search.n_places == 1 else lesser(part.most_apart2, apart)
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


# --- drops ------------------------------------------------------------------------------------------------------------

cdef struct Falling:
    Tree guest, host
    bint guest_falls
    double bottom, reach, touch
    double first          # least fall distance found
    double later          # range above it in which others are searched
    double* each          # NULL if only the least is needed


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
    """Return the least fall distance, at least -touch, inf for none. Distances up to `later` above go into `each`."""
    cdef Falling search
    cdef Nodes roots
    cdef Placement at = placement_of(turn, shift), upright = placement_of(frame, (0.0, 0.0, 0.0))
    cdef Placement of_guest = product(&upright, &at)
    memset(&search, 0, sizeof(Falling))
    search.bottom, search.reach, search.touch = limits
    search.bottom += search.reach
    search.guest_falls, search.first, search.later, search.each = guest_falls, INFINITY, later, each
    try:
        open_tree(&search.guest, guest, FALLER if guest_falls else BEARER, &of_guest)
        open_tree(&search.host, host, BEARER if guest_falls else FALLER, &upright)
        if search.guest.m and search.host.m:
            roots = roots_of(&search.guest, &search.host)
            if least_fall(&search, &roots) < INFINITY:
                drop_down(&search, &roots)
    finally:
        close_tree(&search.guest)
        close_tree(&search.host)
    return search.first


cdef void drop_down(Falling* search, const Nodes* nodes) noexcept:
    """Visit the pairs of leaves below two nodes that may fall onto each other, the half with the least fall first."""
    cdef Nodes halves[2]
    cdef double falls[2]
    cdef int k
    if not halve(halves, &search.guest, &search.host, nodes):
        visit_drops(search, nodes)
        return
    for k in range(2):
        falls[k] = least_fall(search, &halves[k])
    k = falls[1] < falls[0]
    if falls[k] <= most_fall(search):
        drop_down(search, &halves[k])
    if falls[1 - k] <= most_fall(search):
        drop_down(search, &halves[1 - k])


cdef inline double least_fall(const Falling* search, const Nodes* nodes) noexcept:
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


cdef inline double most_fall(const Falling* search) noexcept:
    return lesser(search.reach, search.first + search.later) + ROUNDING_M


cdef void visit_drops(Falling* search, const Nodes* leaves) noexcept:
    cdef const Face* of_guest = face_of(&search.guest, leaves.guest)
    cdef const Face* of_host = face_of(&search.host, leaves.host)
    cdef const Face* p = of_guest if search.guest_falls else of_host
    cdef const Face* q = of_host if search.guest_falls else of_guest
    cdef const Box* around = leaves.of_guest if search.guest_falls else leaves.of_host
    cdef Py_ssize_t column
    cdef double least = INFINITY, most = -INFINITY
    if not q.is_level or around.low[2] > search.bottom:
        return
    if not measure_heights(&least, &most, p, q):
        return
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
