"""The compiled twin of the kernel in `rule`."""

from libc.math cimport INFINITY, M_PI, cos
from libc.stdlib cimport free, malloc


cdef inline double weight(double gap, double tolerance) noexcept:
    cdef double x
    if tolerance == 0:
        return 1.0 if gap <= 0 else 0.0
    x = 3 * gap / tolerance - 2
    return 1.0 if x <= 0 else 0.0 if x >= 1 else 0.5 * (1 + cos(M_PI * x))


def support_weights(list falls_m, double reach, double touch, double hidden):
    cdef Py_ssize_t n = len(falls_m), m = len(falls_m[0]), i, j
    cdef double least = INFINITY, share, most, nearest
    cdef const double[::1] row
    cdef double* firsts = <double*>malloc(max(m, 1) * sizeof(double))
    if firsts == NULL:
        raise MemoryError
    try:
        for j in range(m):
            firsts[j] = INFINITY
        for i in range(n):
            row = falls_m[i]
            for j in range(m):
                if row[j] < firsts[j]:
                    firsts[j] = row[j]
        for j in range(m):
            if firsts[j] < least:
                least = firsts[j]
        found = []
        for i in range(n):
            row, most, nearest = falls_m[i], 0.0, INFINITY
            for j in range(m):
                if row[j] == INFINITY:
                    continue
                share = weight(row[j], reach) * weight(row[j] - least, touch) * weight(row[j] - firsts[j], hidden)
                if share > 0:
                    most = share if share > most else most
                    nearest = row[j] if row[j] < nearest else nearest
            found.append((most, nearest))
    finally:
        free(firsts)
    return found
