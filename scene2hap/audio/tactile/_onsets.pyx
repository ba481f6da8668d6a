"""The compiled twins of the kernels in `onsets`."""

import numpy as np

from libc.math cimport INFINITY, sqrt

from scene2hap.audio.tactile import onsets

cdef double QUIETEST = onsets.QUIETEST, FORGET = onsets.FORGET
cdef double RISE = onsets.RISE, FAINTEST = onsets.FAINTEST, LOUDER = onsets.LOUDER, SUSTAINED = onsets.SUSTAINED
cdef double LOWERED = onsets.LOWERED
cdef Py_ssize_t WARM = onsets.WARM, LOOK = onsets.LOOK, APART = onsets.APART, SPARED = onsets.SPARED
cdef Py_ssize_t FIRST_AFTER = onsets.AFTER[0], LAST_AFTER = onsets.AFTER[1]


def followed(const double[:, ::1] energies, double[:, ::1] memory, Py_ssize_t n_known):
    cdef Py_ssize_t band, k, n = energies.shape[1]
    cdef double energy, most, mean, loudest
    found = np.empty((2, 3, n))
    cdef double[:, :, ::1] each = found
    for band in range(2):
        mean, loudest = memory[band, 0], memory[band, 1]
        for k in range(n):
            energy = energies[band, k]
            each[band, 0, k], each[band, 1, k], each[band, 2, k] = energy, mean, loudest
            if n_known + k < WARM:
                mean += (energy - mean) / (n_known + k + 1)
            else:
                most = 8.0 * mean + QUIETEST
                mean += ((energy if energy < most else most) - mean) / WARM
            loudest *= FORGET
            if energy > loudest:
                loudest = energy
        memory[band, 0], memory[band, 1] = mean, loudest
    return found


cdef struct Onset:
    double height
    double left
    bint is_sustained


def onsets_among(
    const double[:, :, ::1] steps,
    Py_ssize_t n,
    Py_ssize_t n_known,
    double[::1] memory,
    bint spares_sustained,
):
    cdef Py_ssize_t k
    cdef const double[:, ::1] sound = steps[0], ticks = steps[1]
    cdef double last = memory[0], before = memory[1], height_before = memory[2], lowest = memory[3]
    cdef double began = memory[4], sustained = memory[5], hidden = memory[6], of_sustained, since, energy
    cdef Onset onset
    found, lowered = [], np.empty(n)
    cdef double[::1] shares = lowered
    cdef bint is_lowered = False
    for k in range(n):
        shares[k] = 1.0
        if n_known + k >= WARM and (sound[0, k] > RISE * sound[1, k] or ticks[0, k] > RISE * ticks[1, k]):
            onset.height, onset.left, onset.is_sustained = 0.0, 0.0, False
            highest(sound, k, spares_sustained, &onset)
            highest(ticks, k, spares_sustained, &onset)
            since = n_known + k - last
            of_sustained = max(sustained if n_known + k - began >= APART else 0.0, hidden)
            if onset.is_sustained and (sustained > 0.0 or not is_hidden(sound, ticks, k)):
                if sustained == 0.0:
                    began = n_known + k
                sustained = max(sustained, onset.height)
            elif onset.height > LOUDER * (of_sustained if since >= APART else max(of_sustained, height_before)):
                if since >= SPARED:
                    before = sound[1, k]
                last, height_before, lowest = n_known + k, onset.height, INFINITY
                hidden = onset.height if onset.is_sustained else 0.0
                found.append((k, onset.height, onset.left))
        energy, since = sound[0, k], n_known + k - last
        if RISE * energy < sustained:
            sustained = 0.0
        if since > LOOK and RISE * ticks[0, k] < hidden:
            hidden = 0.0
        if hidden > 0.0 and not is_hidden(sound, ticks, k):
            lowest = 0.0
        if since > LOOK:
            if spares_sustained and since >= APART and energy > RISE * lowest:
                lowest = 0.0
            else:
                lowest = min(lowest, max(energy, QUIETEST))
        if since < SPARED and lowest > 0.0 and energy > LOWERED * before:
            shares[k] = sqrt(before / energy)
            is_lowered = True
    memory[0], memory[1], memory[2], memory[3] = last, before, height_before, lowest
    memory[4], memory[5], memory[6] = began, sustained, hidden
    return found, lowered if is_lowered else None


cdef bint is_hidden(const double[:, ::1] sound, const double[:, ::1] ticks, Py_ssize_t k) noexcept:
    """Return True if the energy of the whole sound hardly rises at an onset, so that no bed follows it."""
    cdef Py_ssize_t i
    cdef double whole = 0.0, rest = 0.0
    for i in range(k, k + LOOK + 1):
        if sound[0, i] > RISE * sound[1, k]:
            return False
        whole += sound[0, i]
        rest += sound[0, i] - ticks[0, i]
    return RISE * rest >= whole


cdef void highest(const double[:, ::1] band, Py_ssize_t k, bint spares_sustained, Onset* onset) noexcept:
    """Replace an onset by that of this band, if it is higher."""
    cdef Py_ssize_t i, at = k
    cdef double most = RISE * band[1, k], after = 0.0
    most = max(most, QUIETEST, FAINTEST * band[2, k])
    if band[0, k] <= most:
        return
    for i in range(k + 1, k + LOOK + 1):
        if band[0, i] > band[0, at]:
            at = i
    if band[0, at] - band[1, k] <= onset.height:
        return
    onset.height, onset.left = band[0, at] - band[1, k], min(band[0, k + LOOK] / band[0, at], 1.0)
    onset.is_sustained = False
    if spares_sustained:
        for i in range(at + FIRST_AFTER, at + LAST_AFTER + 1):
            after = max(after, band[0, i])
        onset.is_sustained = after > SUSTAINED * band[0, at]
