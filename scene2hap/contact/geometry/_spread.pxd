cdef enum:
    MAX_POINTS = 4  # as in `spread`

cdef double SPREAD_M
cdef double TIE_M

cdef double distance_between(const double* x, const double* y, int n_axes) noexcept
cdef Py_ssize_t farthest(const double* points, const double* apart, Py_ssize_t n, int n_axes) noexcept
