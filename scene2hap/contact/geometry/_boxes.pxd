"""Axis-aligned boxes: inline functions for searches in trees."""


cdef struct Box:
    double low[3]
    double high[3]


cdef inline double lesser(double x, double y) noexcept:
    # C's `fmin` is not inlined, since it must handle nan.
    return x if x < y else y


cdef inline double greater(double x, double y) noexcept:
    return x if x > y else y


cdef inline bint is_within(const Box* a, const Box* b, double reach) noexcept:
    """Return True unless two boxes are farther apart than a distance along an axis."""
    return (
        a.low[0] <= b.high[0] + reach and b.low[0] <= a.high[0] + reach
        and a.low[1] <= b.high[1] + reach and b.low[1] <= a.high[1] + reach
        and a.low[2] <= b.high[2] + reach and b.low[2] <= a.high[2] + reach
    )


cdef inline double squared_distance(const Box* a, const Box* b) noexcept:
    """Return the squared distance of two boxes, inf if one is empty."""
    cdef double gap, total = 0
    cdef int axis
    for axis in range(3):
        gap = greater(greater(a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]), 0.0)
        total += gap * gap
    return total


cdef inline double longest(const Box* box) noexcept:
    return greater(greater(box.high[0] - box.low[0], box.high[1] - box.low[1]), box.high[2] - box.low[2])
