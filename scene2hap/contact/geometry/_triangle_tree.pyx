"""The compiled twin of the kernel in `triangle_tree`, and trees in the frame of a search.

A search of two meshes takes place in one frame. Boxes and triangles are transformed to it at the first visit.
"""

import numpy as np

from libc.math cimport INFINITY, fabs
from libc.stdlib cimport calloc, free, malloc
from libc.string cimport memset

from scene2hap.contact.geometry._boxes cimport greater, lesser


# Memory of the last searches, kept for the next ones. Otherwise, for meshes of 10,000 triangles, the system would take
# it back after each search, and new pages would take a quarter of the time.
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
    """Return memory of at least a size, NULL if out of memory; `close_tree` releases it."""
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


cdef Placement product(const Placement* frame, const Placement* at) noexcept:
    """Return a placement in another frame."""
    cdef Placement found
    cdef int i, j
    cdef const double* row
    for i in range(3):
        row = frame.turn + 3 * i
        for j in range(3):
            found.turn[3 * i + j] = at.turn[j] * row[0] + at.turn[3 + j] * row[1] + at.turn[6 + j] * row[2]
        found.shift[i] = row[0] * at.shift[0] + row[1] * at.shift[1] + row[2] * at.shift[2]
    return found


cdef void place_point(double* out, const double* point, const Placement* at) noexcept:
    cdef double x = point[0], y = point[1], z = point[2]
    out[0] = at.turn[0] * x + at.turn[1] * y + at.turn[2] * z + at.shift[0]
    out[1] = at.turn[3] * x + at.turn[4] * y + at.turn[5] * z + at.shift[1]
    out[2] = at.turn[6] * x + at.turn[7] * y + at.turn[8] * z + at.shift[2]


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
    place_point(placed, middle, at)
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
        place_point(face.corners[corner], tree.corners + 9 * leaf + 3 * corner, &tree.at)
    for axis in range(3):
        box.low[axis] = lesser(lesser(face.corners[0][axis], face.corners[1][axis]), face.corners[2][axis])
        box.high[axis] = greater(greater(face.corners[0][axis], face.corners[1][axis]), face.corners[2][axis])
    face.is_measured = False


cdef struct Query:
    const double* nodes
    const Py_ssize_t* columns
    Py_ssize_t n_leaves, n, most
    Py_ssize_t* found
    double low[3]
    double high[3]


cdef void look(Query* query, Py_ssize_t node) noexcept:
    cdef const double* box = query.nodes + 6 * node
    if query.n == query.most or not (
        box[0] <= query.high[0] and box[1] <= query.high[1] and box[2] <= query.high[2]
        and box[3] >= query.low[0] and box[4] >= query.low[1] and box[5] >= query.low[2]
    ):
        return
    if node >= query.n_leaves - 1:
        query.found[query.n] = query.columns[node - query.n_leaves + 1]
        query.n += 1
        return
    look(query, 2 * node + 1)
    look(query, 2 * node + 2)


def meeting(tree, low, high, Py_ssize_t most):
    cdef Query query
    cdef const double[:, ::1] nodes = tree[0]
    cdef const Py_ssize_t[::1] columns = tree[2]
    cdef Py_ssize_t[::1] found
    cdef Py_ssize_t k
    query.nodes, query.columns, query.n_leaves = &nodes[0, 0], &columns[0], columns.shape[0]
    query.n, query.most = 0, min(most, query.n_leaves)
    query.low[0], query.low[1], query.low[2] = low
    query.high[0], query.high[1], query.high[2] = high
    query.found = <Py_ssize_t*>malloc(max(query.most, 1) * sizeof(Py_ssize_t))
    if query.found == NULL:
        raise MemoryError
    try:
        look(&query, 0)
        columns_found = np.empty(query.n, dtype=np.intp)
        found = columns_found
        for k in range(query.n):
            found[k] = query.found[k]
    finally:
        free(query.found)
    if query.n > 1:
        columns_found.sort()
    return columns_found
