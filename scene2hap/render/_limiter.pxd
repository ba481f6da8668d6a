cdef struct Reduction:
    double held     # h
    double applied  # u

cdef double turned_down(double x, Reduction* last, double threshold, double release, double attack) noexcept
cdef double limited(double x, double threshold) noexcept
