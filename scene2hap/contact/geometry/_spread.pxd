cdef enum:
    MAX_POINTS = 4  # as in `spread`

cdef int farthest_points(
    Py_ssize_t* chosen, const double* points, double* apart, Py_ssize_t n, int n_axes
) noexcept
