"""The compiled twin of the kernel in `onsets`."""

import numpy as np

from scene2hap.audio.tactile import onsets

cdef double QUIETEST = onsets.QUIETEST, FORGET = onsets.FORGET
cdef Py_ssize_t WARM = onsets.WARM


def followed(const double[::1] energies, double mean, double loudest, Py_ssize_t n_known):
    cdef Py_ssize_t k, n = energies.shape[0]
    cdef double energy, most
    means, loudests = np.empty(n), np.empty(n)
    cdef double[::1] each_mean = means, each_loudest = loudests
    for k in range(n):
        energy, each_mean[k], each_loudest[k] = energies[k], mean, loudest
        if n_known + k < WARM:
            mean += (energy - mean) / (n_known + k + 1)
        else:
            most = 8.0 * mean + QUIETEST
            mean += ((energy if energy < most else most) - mean) / WARM
        loudest *= FORGET
        if energy > loudest:
            loudest = energy
    return means, loudests, mean, loudest
