"""The compiled twin of the kernel in `plate_terms`."""
# cython: boundscheck=False, wraparound=False, cdivision=True

from libc.math cimport acos, cos, fmax, fmin


def fill_cosines(
    double[:, ::1] found,
    const double[:, :] points_m,
    double per_length,
    double per_width,
    Py_ssize_t n_x,
    Py_ssize_t n_y,
):
    cdef Py_ssize_t point, i, j
    cdef double along, across, cosine
    cdef double* row
    for point in range(points_m.shape[0]):
        along = acos(fmin(fmax(points_m[point, 0] * per_length - 1, -1.0), 1.0))
        across = acos(fmin(fmax(points_m[point, 1] * per_width - 1, -1.0), 1.0))
        row = &found[point, 0]
        # The first row holds those across, from which all others are made.
        for j in range(n_y):
            row[j] = cos(j * across)
        for i in range(n_x - 1, -1, -1):
            cosine = cos(i * along)
            for j in range(n_y):
                row[i * n_y + j] = cosine * row[j]
