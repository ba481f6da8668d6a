"""The compiled twin of the kernel in `step_energies`."""

import numpy as np


def mean_squares(const double[::1] x, Py_ssize_t step):
    cdef Py_ssize_t k, n = x.shape[0] // step
    found = np.empty(n)
    cdef double[::1] energies = found
    for k in range(n):
        energies[k] = sum_of_squares(&x[k * step], step) / step
    return found


cdef double sum_of_squares(const double* x, Py_ssize_t n) noexcept nogil:
    """Sum of squares by eight partial sums, so that no addition waits for the result of the previous one."""
    cdef double sums[8]
    cdef double rest = 0.0
    cdef Py_ssize_t i, k
    for k in range(8):
        sums[k] = 0.0
    for i in range(0, n - 7, 8):
        for k in range(8):
            sums[k] += x[i + k] * x[i + k]
    for i in range(n - n % 8, n):
        rest += x[i] * x[i]
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7])) + rest
