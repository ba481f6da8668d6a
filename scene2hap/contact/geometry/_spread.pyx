"""The compiled twin of the kernel in `spread`."""

from libc.math cimport INFINITY, sqrt

cdef enum:
    MAX_POINTS = 4  # as in `spread`
    MANY = 256  # twice the number of facing points of two outlines with eight corners

cdef double SPREAD_M = 0.005  # as in `spread`
cdef double TIE_M = 1e-6


def spread_few(points):
    cdef Py_ssize_t n = len(points), n_axes = len(points[0]), row, axis, last
    cdef double[3][MANY] at
    cdef double[MANY] apart
    cdef double[3] middle
    if n > MANY:
        raise ValueError(f"{n} points are more than a few")
    for row in range(n):
        point = points[row]
        for axis in range(n_axes):
            at[axis][row] = point[axis]
    for axis in range(n_axes):
        middle[axis] = 0
        for row in range(n):
            middle[axis] += at[axis][row]
        middle[axis] /= n
    for row in range(n):
        apart[row] = distance(at, n_axes, row, middle)
    last = first(at, n_axes, apart, n)
    chosen = [last]
    for row in range(n):
        apart[row] = INFINITY
    for _ in range(MAX_POINTS - 1):
        for axis in range(n_axes):
            middle[axis] = at[axis][last]
        for row in range(n):
            apart[row] = min(apart[row], distance(at, n_axes, row, middle))
        if greatest(apart, n) <= SPREAD_M:
            break
        last = first(at, n_axes, apart, n)
        chosen.append(last)
    return chosen


cdef double distance(double[3][MANY] at, Py_ssize_t n_axes, Py_ssize_t row, const double* place) noexcept:
    cdef Py_ssize_t axis
    cdef double away, square = 0
    for axis in range(n_axes):
        away = at[axis][row] - place[axis]
        square += away * away
    return sqrt(square)


cdef double greatest(const double* lengths, Py_ssize_t n) noexcept:
    cdef double most = lengths[0]
    cdef Py_ssize_t row
    for row in range(1, n):
        most = max(most, lengths[row])
    return most


cdef Py_ssize_t first(double[3][MANY] at, Py_ssize_t n_axes, const double* apart, Py_ssize_t n) noexcept:
    """Return the row with the largest distance `apart`. Ties, up to rounding, go to the least first coordinate, ..."""
    cdef bint[MANY] is_left
    cdef double limit = greatest(apart, n) - TIE_M
    cdef Py_ssize_t row, axis, found
    for row in range(n):
        is_left[row] = apart[row] >= limit
    for axis in range(n_axes):
        limit = INFINITY
        for row in range(n):
            if is_left[row]:
                limit = min(limit, at[axis][row])
        limit += TIE_M
        for row in range(n):
            is_left[row] = is_left[row] and at[axis][row] <= limit
    found = -1
    for row in range(n):
        if is_left[row] and (found < 0 or is_less(at, n_axes, row, found)):
            found = row
    return found


cdef bint is_less(double[3][MANY] at, Py_ssize_t n_axes, Py_ssize_t row, Py_ssize_t other) noexcept:
    cdef Py_ssize_t axis
    for axis in range(n_axes):
        if at[axis][row] != at[axis][other]:
            return at[axis][row] < at[axis][other]
    return False
