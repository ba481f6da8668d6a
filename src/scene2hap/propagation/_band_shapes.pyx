"""The compiled twin of the kernel in `band_shapes`."""

import numpy as np

from libc.math cimport sqrt


cdef class BandLengths:
    cdef object sides
    cdef Py_ssize_t n_spaces, n_each
    cdef Py_ssize_t[::1] n_own
    cdef float[::1] factors  # one after another, by columns and without what is below the diagonal
    cdef float[::1] turned

    def __init__(self, sides, factors):
        self.sides = sides
        self.n_spaces, self.n_each = len(factors), len(factors[0])
        self.n_own = np.array([factor.shape[1] for factor in factors], dtype=np.intp)
        columns = [
            np.transpose(factor, (0, 2, 1))[:, *np.tril_indices(factor.shape[1])].ravel() for factor in factors
        ]
        self.factors = np.concatenate(columns).astype(np.float32)
        self.turned = np.empty(max(self.n_own), dtype=np.float32)

    def __call__(self, points_m):
        cdef const float[:, ::1] given = self.sides(points_m)
        cdef Py_ssize_t point, space, each, row, k, n, at, begin
        cdef float share
        cdef double square
        cdef float* turned = &self.turned[0]
        found = np.empty((given.shape[0], self.n_each, self.n_spaces))
        cdef double[:, :, ::1] told = found
        for point in range(given.shape[0]):
            at, begin = 0, 0
            for space in range(self.n_spaces):
                n = self.n_own[space]
                for each in range(self.n_each):
                    for row in range(n):
                        turned[row] = 0
                    for k in range(n):
                        share = given[point, begin + k]
                        for row in range(k + 1):
                            turned[row] += self.factors[at + row] * share
                        at += k + 1
                    square = 0
                    for row in range(n):
                        square += <double>turned[row] * turned[row]
                    told[point, each, space] = sqrt(square)
                begin += n
        return found
