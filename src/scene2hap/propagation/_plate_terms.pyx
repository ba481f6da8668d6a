"""The compiled twins of the kernels in `plate_terms`."""
# cython: boundscheck=False, wraparound=False, cdivision=True

import numpy as np

from libc.math cimport acos, cos, fmax, fmin, sqrt

from scene2hap.propagation._near_field cimport Dimples, near_of


cdef class Folded:
    cdef double per_length, per_width
    cdef Py_ssize_t n_x, n_y
    cdef double[:, ::1] smooth, beyond
    cdef double[::1] k2, cosines
    cdef Dimples dimples

    def __init__(self, size, smooth, Dimples dimples, k2, beyond):
        self.per_length, self.per_width, self.n_x, self.n_y = size
        self.smooth, self.dimples, self.k2, self.beyond = smooth, dimples, k2, beyond
        self.cosines = np.empty(len(smooth))

    def __call__(self, const double[:, :] points_m):
        cdef Py_ssize_t point
        found = np.zeros((points_m.shape[0], self.smooth.shape[1]))
        cdef double[:, ::1] told = found
        if told.shape[1]:
            for point in range(points_m.shape[0]):
                self.add_cosines(&told[point, 0], points_m[point, 0], points_m[point, 1])
                self.add_near(&told[point, 0], points_m[point, 0], points_m[point, 1])
        return found

    cdef void add_cosines(self, double* told, double x, double y) noexcept:
        cdef Py_ssize_t product, k, n = self.smooth.shape[1]
        cdef const double* row
        fill_point(&self.cosines[0], x * self.per_length - 1, y * self.per_width - 1, self.n_x, self.n_y)
        for product in range(self.smooth.shape[0]):
            row = &self.smooth[product, 0]
            for k in range(n):
                told[k] += self.cosines[product] * row[k]

    cdef void add_near(self, double* told, double x, double y) noexcept:
        cdef Py_ssize_t drive, node, k, n = self.beyond.shape[1], n_k2 = self.k2.shape[0]
        cdef double cut, share, near, here2 = self.dimples.cutoff_squared(x, y)
        cdef const double* row
        for drive in range(self.dimples.cut2.shape[0]):
            cut = sqrt(here2 * self.dimples.cut2[drive])
            share = self.dimples.share(x, y, drive, cut)
            if share == 0:  # too far away
                continue
            for node in range(n_k2):
                near = near_of(self.k2[node], cut, share)
                row = &self.beyond[drive * n_k2 + node, 0]
                for k in range(n):
                    told[k] += near * row[k]


def fill_cosines(
    double[:, ::1] found,
    const double[:, :] points_m,
    double per_length,
    double per_width,
    Py_ssize_t n_x,
    Py_ssize_t n_y,
):
    cdef Py_ssize_t point
    for point in range(points_m.shape[0]):
        fill_point(
            &found[point, 0], points_m[point, 0] * per_length - 1, points_m[point, 1] * per_width - 1, n_x, n_y
        )


cdef void fill_point(double* row, double xi, double eta, Py_ssize_t n_x, Py_ssize_t n_y) noexcept:
    cdef Py_ssize_t i, j
    cdef double cosine, along = acos(fmin(fmax(xi, -1.0), 1.0)), across = acos(fmin(fmax(eta, -1.0), 1.0))
    # The first row holds those across, from which all others are made.
    for j in range(n_y):
        row[j] = cos(j * across)
    for i in range(n_x - 1, -1, -1):
        cosine = cos(i * along)
        for j in range(n_y):
            row[i * n_y + j] = cosine * row[j]
