"""The compiled twin of the kernel in `band_shapes`."""

import numpy as np

from libc.math cimport sqrt


cdef class BandLengths:
    cdef object shapes
    cdef Py_ssize_t n_spaces, n_each
    cdef Py_ssize_t[::1] n_own
    cdef float[::1] factors  # one after another, by columns and without what is below the diagonal
    cdef float[:, ::1] mixing
    cdef float[::1] turned, sides  # one longer than is used, so that they begin somewhere

    def __init__(self, shapes, mixing, factors):
        self.shapes, self.mixing = shapes, mixing
        self.n_spaces, self.n_each = len(factors), len(factors[0])
        self.n_own = np.array([factor.shape[1] for factor in factors], dtype=np.intp)
        columns = [
            np.transpose(factor, (0, 2, 1))[:, *np.tril_indices(factor.shape[1])].ravel() for factor in factors
        ]
        self.factors = np.concatenate(columns).astype(np.float32)
        self.turned = np.empty(max(self.n_own) + 1, dtype=np.float32)
        self.sides = np.empty(sum(self.n_own) + 1, dtype=np.float32)

    def __call__(self, points_m):
        cdef const float[:, ::1] given = self.shapes(points_m)
        cdef Py_ssize_t point, space, each, row, k, n, at, begin
        cdef float share
        cdef double square
        cdef float* turned = &self.turned[0]
        cdef float* sides = &self.sides[0]
        found = np.empty((given.shape[0], self.n_each, self.n_spaces))
        cdef double[:, :, ::1] told = found
        for point in range(given.shape[0]):
            self.mix(sides, given, point)
            at, begin = 0, 0
            for space in range(self.n_spaces):
                n = self.n_own[space]
                for each in range(self.n_each):
                    for row in range(n):
                        turned[row] = 0
                    for k in range(n):
                        share = sides[begin + k]
                        for row in range(k + 1):
                            turned[row] += self.factors[at + row] * share
                        at += k + 1
                    square = 0
                    for row in range(n):
                        square += <double>turned[row] * turned[row]
                    told[point, each, space] = sqrt(square)
                begin += n
        return found

    cdef void mix(self, float* sides, const float[:, ::1] given, Py_ssize_t point) noexcept:
        cdef Py_ssize_t row, k, n = self.mixing.shape[1]
        cdef float share
        for k in range(n):
            sides[k] = 0
        for row in range(self.mixing.shape[0]):
            share = given[point, row]
            for k in range(n):
                sides[k] += share * self.mixing[row, k]
