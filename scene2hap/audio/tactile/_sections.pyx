"""The compiled twin of the kernel in `sections`."""

import numpy as np

from libc.math cimport fabs

cdef double VANISHED = 1e-200  # as in `sections`
cdef Py_ssize_t STRETCH = 1024  # samples after which the state is checked


def through_sections(const double[:, ::1] sections, const double[:, ::1] x, double[:, :, ::1] state):
    found = np.empty((x.shape[0], x.shape[1]))
    cdef double[:, ::1] y = found
    cdef const double* before
    cdef const double* below
    cdef Py_ssize_t row, at, n, k, n_sections = sections.shape[0], n_rows = x.shape[0]
    for row in range(0, n_rows - 1, 2):
        for at in range(0, x.shape[1], STRETCH):
            n = min(STRETCH, x.shape[1] - at)
            before, below = &x[row, at], &x[row + 1, at]
            # Two sections and two rows at a time, since each step of one waits for the result of its previous step.
            for k in range(0, n_sections - 1, 2):
                two_of_both(
                    &sections[k, 0], before, below, &y[row, at], &y[row + 1, at], n, &state[k, row, 0],
                    &state[k + 1, row, 0],
                )
                before, below = &y[row, at], &y[row + 1, at]
            if n_sections % 2:
                k = n_sections - 1
                one_of_both(&sections[k, 0], before, below, &y[row, at], &y[row + 1, at], n, &state[k, row, 0])
            for k in range(n_sections):
                forget(&state[k, row, 0])
                forget(&state[k, row + 1, 0])
    if n_rows % 2:
        row = n_rows - 1
        for at in range(0, x.shape[1], STRETCH):
            n = min(STRETCH, x.shape[1] - at)
            before = &x[row, at]
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


cdef void one_of_both(
    const double* c, const double* x, const double* p, double* y, double* q, Py_ssize_t n, double* state
) noexcept nogil:
    """One section on rows x to y and p to q, with the state of both rows."""
    cdef double z0 = state[0], z1 = state[1], s0 = state[2], s1 = state[3], u, v, t, r
    cdef double b0 = c[0], b1 = c[1], b2 = c[2], a1 = c[4], a2 = c[5]
    cdef Py_ssize_t i
    for i in range(n):
        u, t = x[i], p[i]
        v, r = b0 * u + z0, b0 * t + s0
        z0, s0 = (b1 * u + z1) - a1 * v, (b1 * t + s1) - a1 * r
        z1, s1 = b2 * u - a2 * v, b2 * t - a2 * r
        y[i], q[i] = v, r
    state[0], state[1], state[2], state[3] = z0, z1, s0, s1


cdef void two_of_both(
    const double* c,
    const double* x,
    const double* p,
    double* y,
    double* q,
    Py_ssize_t n,
    double* first,
    double* second,
) noexcept nogil:
    """Two sections in series on rows x to y and p to q, with the states of both rows."""
    cdef double z0 = first[0], z1 = first[1], s0 = first[2], s1 = first[3], u, v, t, r
    cdef double w0 = second[0], w1 = second[1], m0 = second[2], m1 = second[3]
    cdef double b0 = c[0], b1 = c[1], b2 = c[2], a1 = c[4], a2 = c[5]
    cdef double d0 = c[6], d1 = c[7], d2 = c[8], e1 = c[10], e2 = c[11]
    cdef Py_ssize_t i
    for i in range(n):
        u, t = x[i], p[i]
        v, r = b0 * u + z0, b0 * t + s0
        z0, s0 = (b1 * u + z1) - a1 * v, (b1 * t + s1) - a1 * r
        z1, s1 = b2 * u - a2 * v, b2 * t - a2 * r
        u, t = d0 * v + w0, d0 * r + m0
        w0, m0 = (d1 * v + w1) - e1 * u, (d1 * r + m1) - e1 * t
        w1, m1 = d2 * v - e2 * u, d2 * r - e2 * t
        y[i], q[i] = u, t
    first[0], first[1], first[2], first[3] = z0, z1, s0, s1
    second[0], second[1], second[2], second[3] = w0, w1, m0, m1


cdef inline void forget(double* state) noexcept nogil:
    if fabs(state[0]) < VANISHED:
        state[0] = 0.0
    if fabs(state[1]) < VANISHED:
        state[1] = 0.0
