"""The compiled twin of the kernel in `spread`."""

from libc.math cimport INFINITY, sqrt

cdef enum:
    MANY = 256  # twice the number of facing points of two outlines with eight corners

cdef double SPREAD_M = 0.005  # as in `spread`
cdef double TIE_M = 1e-6


def spread_few(points):
    cdef Py_ssize_t n = len(points), row
    cdef int n_axes = len(points[0]), axis, k
    cdef double[3 * MANY] at
    cdef double[MANY] apart
    cdef Py_ssize_t[MAX_POINTS] chosen
    if n > MANY:
        raise ValueError(f"{n} points are more than a few")
    for row in range(n):
        point = points[row]
        for axis in range(n_axes):
            at[n_axes * row + axis] = point[axis]
    return [chosen[k] for k in range(farthest_points(chosen, at, apart, n, n_axes))]


cdef int farthest_points(
    Py_ssize_t* chosen, const double* points, double* apart, Py_ssize_t n, int n_axes
) noexcept:
    """Choose at most MAX_POINTS of the points (n, n_axes) that are far from each other. Returns the number of chosen.

    Parameters: chosen : receives the rows of the chosen points; apart : memory for n lengths.
    """
    cdef double[3] middle
    cdef double high
    cdef Py_ssize_t row
    cdef int axis, count = 1
    if n == 0:
        return 0
    for axis in range(n_axes):
        middle[axis] = 0
        for row in range(n):
            middle[axis] += points[n_axes * row + axis]
        middle[axis] /= n
    for row in range(n):
        apart[row] = distance_between(points + n_axes * row, middle, n_axes)
    chosen[0] = farthest(points, apart, n, n_axes)
    for row in range(n):
        apart[row] = INFINITY
    while count < MAX_POINTS:
        high = 0
        for row in range(n):
            apart[row] = min(
                apart[row], distance_between(points + n_axes * row, points + n_axes * chosen[count - 1], n_axes)
            )
            high = max(high, apart[row])
        if high <= SPREAD_M:
            break
        chosen[count] = farthest(points, apart, n, n_axes)
        count += 1
    return count


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
