"""The compiled twins of the kernels in `plate_terms`."""

import numpy as np

from libc.math cimport acos, cos, fmax, fmin

from scene2hap.propagation.modal._near_field cimport Dimples, near_of
from scene2hap.propagation._rows cimport add_rows, real


cdef class ContractedShapes:
    cdef double per_length, per_width
    cdef Py_ssize_t n_x, n_y, n
    cdef double[:, ::1] smooth, beyond
    cdef float[:, ::1] smooth_single, beyond_single
    cdef double[::1] k2, cosines, nears
    cdef float[::1] cosines_single, nears_single
    cdef Dimples dimples
    cdef bint is_single

    def __init__(self, size, smooth, Dimples dimples, k2, beyond):
        self.per_length, self.per_width, self.n_x, self.n_y = size
        self.is_single, self.n = smooth.dtype == np.float32, smooth.shape[1]
        if self.is_single:
            self.smooth_single, self.beyond_single = smooth, beyond
        else:
            self.smooth, self.beyond = smooth, beyond
        self.dimples, self.k2 = dimples, k2
        self.cosines, self.nears = np.empty(len(smooth)), np.empty(len(k2))
        self.cosines_single, self.nears_single = np.empty(len(smooth), np.float32), np.empty(len(k2), np.float32)

    def __call__(self, const double[:, :] points_m):
        cdef Py_ssize_t point
        cdef double[:, ::1] out
        cdef float[:, ::1] out_single
        found = np.zeros((points_m.shape[0], self.n), np.float32 if self.is_single else np.float64)
        if self.n == 0:
            return found
        if self.is_single:
            out_single = found
            for point in range(points_m.shape[0]):
                self.fill(points_m[point, 0], points_m[point, 1])
                fold(
                    self, &out_single[point, 0], &self.smooth_single[0, 0], &self.cosines_single[0],
                    &self.beyond_single[0, 0] if self.beyond_single.shape[0] else NULL, &self.nears_single[0],
                    points_m[point, 0], points_m[point, 1],
                )
        else:
            out = found
            for point in range(points_m.shape[0]):
                self.fill(points_m[point, 0], points_m[point, 1])
                fold(
                    self, &out[point, 0], &self.smooth[0, 0], &self.cosines[0],
                    &self.beyond[0, 0] if self.beyond.shape[0] else NULL, &self.nears[0],
                    points_m[point, 0], points_m[point, 1],
                )
        return found

    cdef void fill(self, double x, double y) noexcept:
        """Compute the cosines at a point."""
        cdef Py_ssize_t k
        fill_point(&self.cosines[0], x * self.per_length - 1, y * self.per_width - 1, self.n_x, self.n_y)
        if self.is_single:
            for k in range(self.cosines.shape[0]):
                self.cosines_single[k] = <float>self.cosines[k]


cdef void fold(
    ContractedShapes self,
    real* out,
    const real* smooth,
    const real* cosines,
    const real* beyond,
    real* nears,
    double x,
    double y,
) noexcept:
    """Add the response of a plate at a point: the smooth part from its cosines, and near fields."""
    cdef Py_ssize_t drive, node, n_k2 = self.k2.shape[0]
    cdef double cut, share, here2
    add_rows(out, smooth, cosines, self.cosines.shape[0], self.n)
    if beyond is NULL:
        return
    here2 = self.dimples.cutoff_squared(x, y)
    for drive in range(self.dimples.cut2.shape[0]):
        cut = fmax(here2, self.dimples.cut2[drive])
        share = self.dimples.share(x, y, drive, cut)
        if share == 0:  # too far away
            continue
        for node in range(n_k2):
            nears[node] = <real>near_of(self.k2[node], cut, share)
        add_rows(out, beyond + drive * n_k2 * self.n, nears, n_k2, self.n)


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
    # The first n_y entries hold the cosines across the plate; all others are products with them.
    for j in range(n_y):
        row[j] = cos(j * across)
    for i in range(n_x - 1, -1, -1):
        cosine = cos(i * along)
        for j in range(n_y):
            row[i * n_y + j] = cosine * row[j]
