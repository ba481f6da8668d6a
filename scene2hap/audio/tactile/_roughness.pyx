"""The compiled twin of the kernel in `roughness`."""

import numpy as np

from libc.math cimport sqrt

from scene2hap.audio.tactile import roughness

cdef double NOTHING = roughness.NOTHING, QUARTER_TURN = 0.5 * np.pi


def modulated(const double[::1] bed, const double[::1] low, const double[::1] mean, double depth):
    cdef Py_ssize_t i, n = bed.shape[0]
    cdef double envelope, share, eighth
    cdef double nothing = NOTHING, quarter_turn = QUARTER_TURN
    found = np.empty(n)
    cdef double[::1] y = found
    for i in range(n):
        envelope = mean[i] * quarter_turn
        envelope = envelope if envelope > nothing else nothing
        share = low[i] / envelope
        eighth = share * share
        eighth = eighth * eighth
        eighth = eighth * eighth
        y[i] = bed[i] * (1.0 + depth * (share / sqrt(sqrt(sqrt(1.0 + eighth)))))
    return found
