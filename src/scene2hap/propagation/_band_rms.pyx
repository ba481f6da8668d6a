"""The compiled twin of the kernel in `band_rms`."""
# cython: boundscheck=False, wraparound=False, cdivision=True

from libc.math cimport exp, fmax, sqrt

cdef double MOST = 700.0  # as in `band_rms`


cdef class Differences:
    cdef double[::1] edges, scales
    cdef double least

    def __init__(self, double[::1] edges, double[::1] scales, double least):
        self.edges, self.scales, self.least = edges, scales, least

    def fill(self, double[:, ::1] gains, lengths):
        cdef Py_ssize_t i = 0, k, n_bands = self.scales.shape[0]
        cdef double length, x, here, before
        cdef double* row
        cdef double* edges = &self.edges[0]
        left = []
        for length in lengths:
            row = &gains[i, 0]
            if length >= self.least:
                x = fmax(-edges[0] * length, -MOST)
                before = (x - 1) * exp(x)
                for k in range(n_bands):
                    x = fmax(-edges[k + 1] * length, -MOST)
                    here = (x - 1) * exp(x)
                    row[k] = sqrt(here - before) * self.scales[k] / length
                    before = here
            else:
                # What touches a source feels all of it.
                for k in range(n_bands):
                    row[k] = 1.0
                if length > 0:
                    left.append(i)
            i += 1
        return left
