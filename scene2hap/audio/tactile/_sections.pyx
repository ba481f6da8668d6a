"""The compiled twin of the kernel in `sections`."""

import numpy as np

from libc.math cimport fabs

cdef double VANISHED = 1e-200  # as in `sections`
cdef Py_ssize_t STRETCH = 1024  # samples after which the memory is looked at


def through_sections(const double[:, ::1] sections, const double[:, ::1] x, double[:, :, ::1] state):
    found = np.empty((x.shape[0], x.shape[1]))
    cdef double[:, ::1] y = found
    cdef const double* before
    cdef Py_ssize_t row, at, n, k, n_sections = sections.shape[0]
    for row in range(x.shape[0]):
        for at in range(0, x.shape[1], STRETCH):
            n = min(STRETCH, x.shape[1] - at)
            before = &x[row, at]
            # Two at a time: the second section works while the first waits for its own last result.
            for k in range(0, n_sections - 1, 2):
                two(&sections[k, 0], before, &y[row, at], n, &state[k, row, 0], &state[k + 1, row, 0])
                before = &y[row, at]
            if n_sections % 2:
                one(&sections[n_sections - 1, 0], before, &y[row, at], n, &state[n_sections - 1, row, 0])
            for k in range(n_sections):
                forget(&state[k, row, 0])
    return found


cdef void one(const double* c, const double* x, double* y, Py_ssize_t n, double* state) noexcept nogil:
    """One section c (b0 b1 b2 1 a1 a2); x may be y."""
    cdef double z0 = state[0], z1 = state[1], u, v
    cdef double b0 = c[0], b1 = c[1], b2 = c[2], a1 = c[4], a2 = c[5]
    cdef Py_ssize_t i
    for i in range(n):
        u = x[i]
        v = b0 * u + z0
        z0 = (b1 * u + z1) - a1 * v
        z1 = b2 * u - a2 * v
        y[i] = v
    state[0], state[1] = z0, z1


cdef void two(const double* c, const double* x, double* y, Py_ssize_t n, double* first, double* second) noexcept nogil:
    """Two sections in series; x may be y."""
    cdef double z0 = first[0], z1 = first[1], w0 = second[0], w1 = second[1], u, v, w
    cdef double b0 = c[0], b1 = c[1], b2 = c[2], a1 = c[4], a2 = c[5]
    cdef double d0 = c[6], d1 = c[7], d2 = c[8], e1 = c[10], e2 = c[11]
    cdef Py_ssize_t i
    for i in range(n):
        u = x[i]
        v = b0 * u + z0
        z0 = (b1 * u + z1) - a1 * v
        z1 = b2 * u - a2 * v
        w = d0 * v + w0
        w0 = (d1 * v + w1) - e1 * w
        w1 = d2 * v - e2 * w
        y[i] = w
    first[0], first[1], second[0], second[1] = z0, z1, w0, w1


cdef inline void forget(double* state) noexcept nogil:
    if fabs(state[0]) < VANISHED:
        state[0] = 0.0
    if fabs(state[1]) < VANISHED:
        state[1] = 0.0
