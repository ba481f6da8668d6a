cdef double limited(double x, double threshold) noexcept
