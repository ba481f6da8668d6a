cdef class Dimples:
    cdef const double[:, ::1] drive_m, pieces
    cdef const double[::1] x_weights, y_weights, cut2
    cdef double per_length, per_width, length2, width2, kx, ky, per_piece

    cdef double cutoff_squared(self, double x, double y) noexcept
    cdef double share(self, double x, double y, Py_ssize_t drive, double cut2) noexcept


cdef double near_of(double k2, double cut2, double share) noexcept
