from libc.string cimport memcpy

from scene2hap.contact.geometry._boxes cimport Box, longest
from scene2hap.contact.geometry._triangles cimport Face, measure_face, shrink


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
    bint is_placed             # if False, the tree is already in the frame of the search
    Placement at
    Role role
    # Filled at the first visit of a node: boxes of a placed tree, faces of leaves. NULL while the tree is not open.
    Face* faces
    Box* boxes
    char* is_known
    Memory* memory


cdef struct Nodes:
    Py_ssize_t guest, host
    const Box* of_guest
    const Box* of_host


cdef int open_tree(Tree* tree, shape, Role role, const Placement* at) except -1
cdef void close_tree(Tree* tree) noexcept
cdef Placement placement_of(rows, position) except *
cdef Placement product(const Placement* frame, const Placement* at) noexcept
cdef void place_point(double* out, const double* point, const Placement* at) noexcept
cdef void place_box(Box* box, const double* corners, const Placement* at) noexcept
cdef void place_face(Tree* tree, Py_ssize_t leaf, Box* box) noexcept


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


cdef inline Nodes roots_of(Tree* guest, Tree* host) noexcept:
    return Nodes(0, 0, box_of(guest, 0), box_of(host, 0))


cdef inline bint halve(Nodes* halves, Tree* guest, Tree* host, const Nodes* whole) noexcept:
    """Replace the longer of two nodes by its children. Returns False if both are leaves."""
    cdef bint is_leaf_g = whole.guest >= guest.n_leaves - 1
    cdef bint is_leaf_h = whole.host >= host.n_leaves - 1
    cdef int k
    if is_leaf_g and is_leaf_h:
        return False
    halves[0] = halves[1] = whole[0]
    if is_leaf_h or (not is_leaf_g and longest(whole.of_guest) > longest(whole.of_host)):
        for k in range(2):
            halves[k].guest = 2 * whole.guest + 1 + k
            halves[k].of_guest = box_of(guest, halves[k].guest)
    else:
        for k in range(2):
            halves[k].host = 2 * whole.host + 1 + k
            halves[k].of_host = box_of(host, halves[k].host)
    return True
