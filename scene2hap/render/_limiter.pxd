cdef double turned_down(double x, double *u, double threshold, double release) noexcept
cdef double limited(double x, double threshold) noexcept
