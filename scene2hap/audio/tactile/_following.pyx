"""The compiled twins of the kernels in `following`."""

import numpy as np

from libc.math cimport isnan, log10, pow, sqrt

from scene2hap.audio.tactile import following

cdef double FREE_DB = following.FREE_DB, HEADROOM_DB = following.HEADROOM_DB, FORGET = following.FORGET
cdef double MOST_LIFTED_DB = following.MOST_LIFTED_DB, MOST_LOWERED_DB = following.MOST_LOWERED_DB
cdef double NOTHING = following.NOTHING


def gains_of(const double[:, ::1] energies, const double[::1] window, double usual_db, double[::1] means):
    cdef Py_ssize_t k, size = window.shape[0], n = energies.shape[1] - size + 1
    cdef double sound, bed, beyond, lift, most = MOST_LIFTED_DB, usual = usual_db
    found = np.empty((2, n))
    cdef double[:, ::1] gains = found
    for k in range(n):
        sound, bed = weighted(&energies[0, k], &window[0], size), weighted(&energies[1, k], &window[0], size)
        if energies.shape[0] == 3:
            most = max(-MOST_LOWERED_DB, min(HEADROOM_DB - ratio_db(sound, bed), MOST_LIFTED_DB))
            bed = weighted(&energies[2, k], &window[0], size)
        if isnan(usual_db):
            usual = ratio_db(mean_of(sound, &means[0]), mean_of(bed, &means[1]))
        beyond = ratio_db(sound, bed) - usual
        lift = max(-FREE_DB, min(beyond, FREE_DB)) - beyond
        gains[0, k] = pow(10.0, max(-MOST_LOWERED_DB, min(lift, most)) / 20.0)
        gains[1, k] = 0.0
        if lift > most:
            gains[1, k] = sqrt(2.0 * (bed + NOTHING) * (pow(10.0, lift / 10.0) - pow(10.0, most / 10.0)))
    return found


cdef double weighted(const double* energies, const double* window, Py_ssize_t n) noexcept nogil:
    """Sum of products, in the order of `numpy.sum` for short rows."""
    cdef double sums[8]
    cdef double total = 0.0
    cdef Py_ssize_t i, k, n_eights = n - n % 8
    if n_eights:
        for k in range(8):
            sums[k] = energies[k] * window[k]
        for i in range(8, n_eights, 8):
            for k in range(8):
                sums[k] += energies[i + k] * window[i + k]
        total = ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]))
    for i in range(n_eights, n):
        total += energies[i] * window[i]
    return total


cdef double mean_of(double energy, double* kept) noexcept nogil:
    cdef double mean = kept[0] + (1.0 - FORGET) * energy
    kept[0] = FORGET * mean
    return mean


cdef double ratio_db(double sound, double bed) noexcept nogil:
    return 10.0 * log10((bed + NOTHING) / (sound + NOTHING))


def faded(const double[::1] y, const double[::1] gains, const double[::1] rising):
    cdef Py_ssize_t k, n = gains.shape[0] - 1, step = rising.shape[0]
    found = np.empty(n * step)
    cdef double[::1] felt = found
    for k in range(n):
        fade(&y[k * step], &rising[0], gains[k + 1] - gains[k], gains[k], step, &felt[k * step])
    return found


cdef void fade(
    const double* y, const double* rising, double rise, double gain, Py_ssize_t n, double* felt
) noexcept nogil:
    cdef Py_ssize_t i
    for i in range(n):
        felt[i] = (rise * rising[i] + gain) * y[i]
