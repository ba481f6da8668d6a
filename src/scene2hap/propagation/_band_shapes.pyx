"""The compiled twin of the kernel in `band_shapes`."""
# cython: boundscheck=False, wraparound=False, cdivision=True

import numpy as np

from libc.math cimport sqrt


cdef class BandLengths:
    cdef Py_ssize_t n_spaces, n_each
    cdef Py_ssize_t[::1] n_own
    cdef double[::1] factors  # one after another, without what is below the diagonal

    def __init__(self, factors):
        self.n_spaces, self.n_each = len(factors), len(factors[0]) if factors else 0
        self.n_own = np.array([factor.shape[1] for factor in factors], dtype=np.intp)
        upper = [factor[:, *np.triu_indices(factor.shape[1])].ravel() for factor in factors]
        self.factors = np.concatenate([np.empty(0), *upper])

    def __call__(self, const double[:, ::1] sides):
        cdef Py_ssize_t point, space, each, row, k, n, at, begin
        cdef double turned, square
        found = np.empty((sides.shape[0], self.n_each, self.n_spaces))
        cdef double[:, :, ::1] told = found
        for point in range(sides.shape[0]):
            at, begin = 0, 0
            for space in range(self.n_spaces):
                n = self.n_own[space]
                for each in range(self.n_each):
                    square = 0
                    for row in range(n):
                        turned = 0
                        for k in range(row, n):
                            turned += self.factors[at] * sides[point, begin + k]
                            at += 1
                        square += turned * turned
                    told[point, each, space] = sqrt(square)
                begin += n
        return found
