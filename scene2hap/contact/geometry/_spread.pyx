"""The compiled twin of the kernel in `spread`."""

from libc.math cimport INFINITY, sqrt
from libc.stdlib cimport free, malloc

cdef double SPREAD_M = 0.005  # as in `spread`
cdef double TIE_M = 1e-6


def spread(points, middle=None):
    cdef Py_ssize_t n = len(points), row, latest
    cdef int axis, n_axes = len(points[0])
    cdef double[3] place
    cdef double high
    cdef double* at = <double*>malloc((n_axes + 1) * n * sizeof(double))
    cdef double* apart = at + n_axes * n
    if at == NULL:
        raise MemoryError
    try:
        for row in range(n):
            point = points[row]
            for axis in range(n_axes):
                at[n_axes * row + axis] = point[axis]
        for axis in range(n_axes):
            place[axis] = 0
            for row in range(n):
                place[axis] += at[n_axes * row + axis]
            place[axis] = middle[axis] if middle is not None else place[axis] / n
        for row in range(n):
            apart[row] = distance_between(at + n_axes * row, place, n_axes)
        latest = farthest(at, apart, n, n_axes)
        found = [latest]
        for row in range(n):
            apart[row] = INFINITY
        while len(found) < MAX_POINTS:
            high = 0
            for row in range(n):
                apart[row] = min(apart[row], distance_between(at + n_axes * row, at + n_axes * latest, n_axes))
                high = max(high, apart[row])
            if high <= SPREAD_M:
                break
            latest = farthest(at, apart, n, n_axes)
            found.append(latest)
        return found
    finally:
        free(at)


cdef double distance_between(const double* x, const double* y, int n_axes) noexcept:
    cdef double square = 0
    cdef int axis
    for axis in range(n_axes):
        square += (x[axis] - y[axis]) * (x[axis] - y[axis])
    return sqrt(square)


cdef Py_ssize_t farthest(const double* points, const double* apart, Py_ssize_t n, int n_axes) noexcept:
    """Return the row with the largest distance `apart`. Ties, up to rounding, go to the least first coordinate, then
    the second, then the third; then exact comparison decides."""
    cdef double[4] limits
    cdef Py_ssize_t row, best = -1
    cdef int axis
    limits[0] = 0
    for row in range(n):
        limits[0] = max(limits[0], apart[row])
    limits[0] -= TIE_M
    for axis in range(n_axes):
        limits[axis + 1] = INFINITY
        for row in range(n):
            if is_left(points + n_axes * row, apart[row], limits, axis):
                limits[axis + 1] = min(limits[axis + 1], points[n_axes * row + axis])
        limits[axis + 1] += TIE_M
    for row in range(n):
        if is_left(points + n_axes * row, apart[row], limits, n_axes):
            if best < 0 or is_less(points + n_axes * row, points + n_axes * best, n_axes):
                best = row
    return best


cdef inline bint is_left(const double* point, double apart, const double* limits, int n_axes) noexcept:
    """Return True if a point is within the limits of its distance and of its first coordinates."""
    cdef int axis
    if apart < limits[0]:
        return False
    for axis in range(n_axes):
        if point[axis] > limits[axis + 1]:
            return False
    return True


cdef inline bint is_less(const double* x, const double* y, int n_axes) noexcept:
    cdef int axis
    for axis in range(n_axes):
        if x[axis] != y[axis]:
            return x[axis] < y[axis]
    return False
