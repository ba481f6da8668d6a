"""The compiled twin of the kernel in `following`."""

import numpy as np


def faded(const double[::1] y, const double[::1] gains, Py_ssize_t step):
    cdef Py_ssize_t k, n = gains.shape[0] - 1
    found, shares = np.empty(n * step), np.arange(step) / step
    cdef double[::1] felt = found, rising = shares
    for k in range(n):
        fade(&y[k * step], &rising[0], gains[k + 1] - gains[k], gains[k], step, &felt[k * step])
    return found


cdef void fade(
    const double* y, const double* rising, double rise, double gain, Py_ssize_t n, double* felt
) noexcept nogil:
    cdef Py_ssize_t i
    for i in range(n):
        felt[i] = (rise * rising[i] + gain) * y[i]
