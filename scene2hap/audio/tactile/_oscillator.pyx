"""The compiled twins of the kernels in `oscillator`."""

import numpy as np

from libc.math cimport cos, fmod, sin

from scene2hap.audio.tactile import oscillator

cdef Py_ssize_t SIZE = oscillator.SIZE
cdef double TURN = 2.0 * np.pi


def multiplied(const double[::1] x, const double[:, ::1] table, double cycles, long long start):
    cdef Py_ssize_t at = 0, first, size, n = x.shape[0]
    found = np.empty((2, n))
    cdef double[:, ::1] y = found
    cdef double angle
    while at < n:
        first = (start + at) % SIZE
        size = min(SIZE - first, n - at)
        angle = TURN * fmod(cycles * (start + at - first), 1.0)
        multiply(&table[0, first], &table[1, first], cos(angle), sin(angle), &x[at], &y[0, at], &y[1, at], size)
        at += size
    return found


def summed(const double[:, ::1] z, const double[:, ::1] table, double cycles, long long start):
    cdef Py_ssize_t at = 0, first, size, n = z.shape[1]
    found = np.empty(n)
    cdef double[::1] y = found
    cdef double angle
    while at < n:
        first = (start + at) % SIZE
        size = min(SIZE - first, n - at)
        angle = TURN * fmod(cycles * (start + at - first), 1.0)
        add(&table[0, first], &table[1, first], cos(angle), sin(angle), &z[0, at], &z[1, at], &y[at], size)
        at += size
    return found


cdef void multiply(
    const double* cosine, const double* sine, double c, double s, const double* x, double* y, double* z, Py_ssize_t n
) noexcept nogil:
    cdef Py_ssize_t i
    for i in range(n):
        y[i] = (c * cosine[i] - s * sine[i]) * x[i]
        z[i] = (s * cosine[i] + c * sine[i]) * x[i]


cdef void add(
    const double* cosine, const double* sine, double c, double s, const double* x, const double* y, double* z,
    Py_ssize_t n
) noexcept nogil:
    cdef Py_ssize_t i
    for i in range(n):
        z[i] = x[i] * (c * cosine[i] - s * sine[i]) + y[i] * (s * cosine[i] + c * sine[i])
