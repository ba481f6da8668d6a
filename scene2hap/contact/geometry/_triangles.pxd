cdef double ROUNDING_M


cdef struct Face:
    double corners[3][3]  # by corner, then by axis; shrunk for a falling triangle
    double edges[3][3]    # from each corner to the next
    double v[3]           # from the first corner to the last; `edges[0]` is u
    double normal[3]
    double uu, uv, vv, area2, root
    bint is_level         # for `drops`
    bint is_measured      # if False, only the corners are valid
    unsigned char features


cdef struct Meetings:
    int n
    double distance[21]
    double on_p[21][3]
    double on_q[21][3]


cdef void measure_face(Face* face) noexcept
cdef void shrink(Face* face) noexcept
cdef void meet(Meetings* found, const Face* p, const Face* q, double within, double loose) noexcept
cdef bint measure_heights(double* least, double* most, const Face* p, const Face* q) noexcept
