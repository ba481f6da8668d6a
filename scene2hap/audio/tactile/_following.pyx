"""The compiled twins of the kernels in `following`."""

import numpy as np

from libc.math cimport isnan, log10, pow, sqrt

from scene2hap.audio.tactile import following

cdef double FREE_DB = following.FREE_DB, HEADROOM_DB = following.HEADROOM_DB, FORGET = following.FORGET
cdef double MOST_LIFTED_DB = following.MOST_LIFTED_DB, MOST_LOWERED_DB = following.MOST_LOWERED_DB
cdef double NOTHING = following.NOTHING, CHANGED = following.CHANGED


cdef struct Lift:
    double needed
    double most


def gains_of(
    const double[:, ::1] energies,
    const double[::1] window,
    Py_ssize_t n_ahead,
    double usual_db,
    double[::1] means,
):
    cdef Py_ssize_t i, k, size = window.shape[0], n = energies.shape[1] - size + 1, n_bands = energies.shape[0]
    cdef Py_ssize_t middle = size - n_ahead
    cdef double before[3]
    cdef double after[3]
    cdef double levels[3]
    cdef double early, late, now, most, usual = usual_db
    cdef bint is_late
    cdef Lift lift
    found = np.empty((2, n))
    cdef double[:, ::1] gains = found
    for k in range(n):
        for i in range(n_bands):
            before[i], after[i] = weighted(&energies[i, k], &window[0], middle), 0.0
            if n_ahead:
                after[i] = weighted(&energies[i, k + middle], &window[middle], n_ahead)
            levels[i] = before[i] + after[i]
        if isnan(usual_db):
            usual = ratio_db(mean_of(levels[0], &means[0]), mean_of(levels[n_bands - 1], &means[1]))
        lift = lifted(levels, n_bands, usual)
        gains[1, k] = 0.0
        if lift.needed > lift.most:
            gains[1, k] = sqrt(
                2.0 * (levels[n_bands - 1] + NOTHING) * (pow(10.0, lift.needed / 10.0) - pow(10.0, lift.most / 10.0))
            )
        if n_ahead:
            early, late = before[0] + NOTHING, after[0] + NOTHING
            if max(early, late) > CHANGED * min(early, late):
                now = 0.25 * (energies[0, k + middle - 1] + energies[0, k + middle]) + NOTHING
                is_late = (now * now > early * late) == (late > early)
                most = lift.most
                lift = lifted(&after[0] if is_late else &before[0], n_bands, usual)
                lift.most = min(lift.most, most)
        gains[0, k] = pow(10.0, max(-MOST_LOWERED_DB, min(lift.needed, lift.most)) / 20.0)
    return found


cdef Lift lifted(const double* levels, Py_ssize_t n_bands, double usual) noexcept nogil:
    """Return the gain that a bed needs, and the largest it may have [dB]."""
    cdef double beyond = ratio_db(levels[0], levels[n_bands - 1]) - usual
    cdef Lift lift
    lift.needed, lift.most = max(-FREE_DB, min(beyond, FREE_DB)) - beyond, MOST_LIFTED_DB
    if n_bands == 3:
        lift.most = max(-MOST_LOWERED_DB, min(HEADROOM_DB - ratio_db(levels[0], levels[1]), MOST_LIFTED_DB))
    return lift


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
