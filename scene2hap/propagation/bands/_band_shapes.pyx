"""The compiled twin of the kernel in `band_shapes`."""

import numpy as np

from libc.math cimport sqrt

from scene2hap.propagation._rows cimport add_row, add_rows


cdef class BandLengths:
    cdef object shapes
    cdef Py_ssize_t n_spaces, n_each
    cdef Py_ssize_t[::1] n_own
    # Factors by space, then by column, then by row down to the diagonal. Entries of all vectors are adjacent, so that
    # one long row is added to another.
    cdef float[::1] factors
    cdef float[:, ::1] mixing
    cdef float[::1] turned, sides  # one longer than needed, so that a first element exists
    cdef double[::1] squares

    def __init__(self, shapes, mixing, factors):
        self.shapes, self.mixing = shapes, mixing
        self.n_spaces, self.n_each = len(factors), len(factors[0])
        self.n_own = np.array([factor.shape[1] for factor in factors], dtype=np.intp)
        columns = [
            np.transpose(factor, (2, 1, 0))[np.tril_indices(factor.shape[1])].ravel() for factor in factors
        ]
        self.factors = np.concatenate([*columns, [0.0]]).astype(np.float32)
        self.turned = np.empty(self.n_each * max(self.n_own) + 1, dtype=np.float32)
        self.sides = np.empty(sum(self.n_own) + 1, dtype=np.float32)
        self.squares = np.empty(self.n_each)

    def __call__(self, points_m):
        cdef const float[:, ::1] given = self.shapes(points_m)
        cdef Py_ssize_t point, space, each, k, n, begin, n_each = self.n_each
        cdef const float* factor
        cdef float* turned = &self.turned[0]
        cdef float* sides = &self.sides[0]
        found = np.empty((given.shape[0], n_each, self.n_spaces))
        cdef double[:, :, ::1] out = found
        for point in range(given.shape[0]):
            for k in range(self.mixing.shape[1]):
                sides[k] = 0
            if self.mixing.shape[0] and self.mixing.shape[1]:
                add_rows(sides, &self.mixing[0, 0], &given[point, 0], self.mixing.shape[0], self.mixing.shape[1])
            factor, begin = &self.factors[0], 0
            for space in range(self.n_spaces):
                n = self.n_own[space]
                for k in range(n * n_each):
                    turned[k] = 0
                for k in range(n):
                    add_row(turned, factor, sides[begin + k], (k + 1) * n_each)
                    factor += (k + 1) * n_each
                self.sum_squares(n)
                for each in range(n_each):
                    out[point, each, space] = sqrt(self.squares[each])
                begin += n
        return found

    cdef void sum_squares(self, Py_ssize_t n) noexcept:
        """Compute the sum of the squares of n numbers in `turned`, for each vector."""
        cdef Py_ssize_t row, each
        cdef double one
        for each in range(self.n_each):
            self.squares[each] = 0
        for row in range(n):
            for each in range(self.n_each):
                one = self.turned[row * self.n_each + each]
                self.squares[each] += one * one
