"""The compiled twin of the kernel in `band_rms`."""

import numpy as np

from libc.math cimport M_PI, exp, expm1, fmax, fmin, sqrt

cdef double MOST = 700.0  # as in `band_rms`
cdef double LEAST = 1e-3


cdef class BandRms:
    # b / L at the edges of the bands; u1, u2 - u1 and the factor before the difference for each band.
    cdef double[::1] edges, roots, widths, scales
    cdef double least

    def __init__(self, edges_hz):
        hz = np.array(edges_hz)
        b, roots = 2 * np.sqrt(2 * np.pi * hz), np.sqrt(hz)
        self.edges, self.roots, self.widths = b, roots, np.diff(roots)
        self.scales = np.sqrt(2 / np.diff(hz) / (8 * np.pi))
        self.least = sqrt(LEAST / float((b[: len(b) - 1] * np.diff(b)).min()))

    def __call__(self, costs):
        cdef Py_ssize_t i, k, n_bands = self.scales.shape[0]
        cdef double cost, x, here, before
        cdef double* row
        cdef double* edges = &self.edges[0]
        gains = np.empty((len(costs), n_bands))
        cdef double[:, ::1] rows = gains
        for i, cost in enumerate(costs):
            row = &rows[i, 0]
            if cost >= self.least:
                x = fmax(-edges[0] * cost, -MOST)
                before = (x - 1) * exp(x)
                for k in range(n_bands):
                    x = fmax(-edges[k + 1] * cost, -MOST)
                    here = (x - 1) * exp(x)
                    row[k] = sqrt(here - before) * self.scales[k] / cost
                    before = here
            else:
                for k in range(n_bands):
                    row[k] = near(cost, self.roots[k], self.widths[k]) if cost > 0 else 1.0
        return gains


cdef double near(double cost, double u1, double width) noexcept:
    """Return the gain of a band for a cost so low that the difference would lose digits."""
    cdef double b = 2 * sqrt(2 * M_PI) * cost, x = b * width, first, second
    if x < 1e-2:
        first = 1 - x / 2 + x * x / 6 - x * x * x / 24 + x * x * x * x / 120
        second = 0.5 - x / 3 + x * x / 8 - x * x * x / 30 + x * x * x * x / 144
    else:
        first = -expm1(-x) / x
        second = (-expm1(-x) - x * exp(-x)) / (x * x)
    # Divided by (u2^2 - u1^2) / width, which is u1 + u2.
    return sqrt(fmin(2 * exp(-b * u1) * (u1 * first + width * second) / (2 * u1 + width), 1.0))
