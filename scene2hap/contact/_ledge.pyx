"""The compiled twin of the kernel in `ledge`."""


def covers(const double[:, :, ::1] triangles, const double[:, :, ::1] rims, foot):
    cdef double u0 = foot[0], v0 = foot[1], u1 = foot[2], v1 = foot[3]
    cdef Py_ssize_t k
    for k in range(rims.shape[0]):
        if enters(&rims[k, 0, 0], u0, v0, u1, v1):
            return False
    for k in range(triangles.shape[0]):
        if holds(&triangles[k, 0, 0], (u0 + u1) / 2, (v0 + v1) / 2):
            return True
    return False


cdef bint holds(const double* corners, double u, double v) noexcept:
    """Return True if a point is in a triangle."""
    cdef double ax = corners[0] - u, ay = corners[1] - v, bx = corners[2] - u, by = corners[3] - v
    cdef double cx = corners[4] - u, cy = corners[5] - v
    cdef double p = ax * by - ay * bx, q = bx * cy - by * cx, r = cx * ay - cy * ax
    return (p >= 0 and q >= 0 and r >= 0) or (p <= 0 and q <= 0 and r <= 0)


cdef bint enters(const double* ends, double u0, double v0, double u1, double v1) noexcept:
    """Return True if a segment meets a rectangle (Liang, Barsky), as `ledge._clipped`."""
    cdef double first = 0, last = 1
    return (
        trim(&first, &last, u0 - ends[0], u1 - ends[0], ends[2] - ends[0])
        and trim(&first, &last, v0 - ends[1], v1 - ends[1], ends[3] - ends[1])
        and first <= last
    )


cdef bint trim(double* first, double* last, double low, double high, double way) noexcept:
    if way == 0:
        return low <= 0 and high >= 0
    first[0] = max(first[0], min(low / way, high / way))
    last[0] = min(last[0], max(low / way, high / way))
    return True
