"""The compiled twins of the kernels in `solved_object`."""

import numpy as np

from libc.math cimport sqrt


cdef class ObjectResponse:
    cdef object place, gains
    cdef const Py_ssize_t[:] columns
    cdef Py_ssize_t n_sources, n_bands, own

    def __init__(self, place, gains, columns, shape, Py_ssize_t own):
        self.place, self.gains, self.columns, self.own = place, gains, columns, own
        self.n_sources, self.n_bands = shape

    def __call__(self, points_m):
        cdef Py_ssize_t n_points = len(points_m), point, k, band
        cdef const double[:, :, :] arriving = self.gains(self.place(points_m))
        found = np.zeros((n_points, self.n_sources, self.n_bands))
        cdef double[:, :, ::1] out = found
        for point in range(n_points):
            for k in range(self.columns.shape[0]):
                for band in range(self.n_bands):
                    out[point, self.columns[k], band] = arriving[point, k, band]
            if self.own >= 0:
                for band in range(self.n_bands):
                    out[point, self.own, band] = 1.0
        return found


cdef class Magnitudes:
    cdef object pairs

    def __init__(self, pairs):
        self.pairs = pairs

    def __call__(self, points_m):
        cdef const double[:, :] given = self.pairs(points_m)
        cdef Py_ssize_t point, k, n = given.shape[1] // 2
        sizes = np.empty((given.shape[0], n, 1))
        cdef double[:, :, ::1] out = sizes
        for point in range(given.shape[0]):
            for k in range(n):
                out[point, k, 0] = sqrt(
                    given[point, 2 * k] * given[point, 2 * k] + given[point, 2 * k + 1] * given[point, 2 * k + 1]
                )
        return sizes
