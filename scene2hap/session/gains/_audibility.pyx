"""The compiled twins of the kernels in `audibility`."""

from libc.math cimport INFINITY

import numpy as np


def silence(float[:, :, ::1] gains, const float[:, ::1] least, columns):
    cdef Py_ssize_t i, j, k, n_silent = 0
    cdef float* row
    cdef const float* floor
    if gains.shape[2] == 0:
        return 0
    for j in range(gains.shape[1]):
        floor = &least[j if columns is None else columns[j], 0]
        for i in range(gains.shape[0]):
            row = &gains[i, j, 0]
            for k in range(gains.shape[2]):
                if not row[k] >= floor[k]:
                    n_silent += row[k] != 0
                    row[k] = 0
    return n_silent


def sifted(const float[:, :, ::1] gains, peaks, double least_felt, least):
    cdef Py_ssize_t n = gains.shape[0], m = gains.shape[1], n_bands = gains.shape[2]
    cdef Py_ssize_t i, j, k, at = 0, n_new, n_below = 0, n_silent = 0
    cdef bint is_sifting = least is not None, is_heard
    cdef const float[:, :] peak = peaks
    cdef const float[:, :] floor = least
    # Each column is written to the next free place. If it is not felt, the following column overwrites it.
    kept = np.empty((n, m, n_bands), dtype=np.float32)
    cdef float[:, :, ::1] out = kept
    columns = []
    for j in range(m):
        is_heard = not is_sifting
        for i in range(n):
            n_new = 0
            if peaks is not None and is_below(&gains[i, j, 0], peak, j, n_bands, least_felt, &n_new):
                n_below += n_new
                for k in range(n_bands):
                    out[i, at, k] = 0
                continue
            for k in range(n_bands):
                out[i, at, k] = gains[i, j, k]
                if is_sifting:
                    if not gains[i, j, k] >= floor[j, k]:
                        n_silent += gains[i, j, k] != 0
                        out[i, at, k] = 0
                    elif gains[i, j, k] != 0:
                        is_heard = True
        if is_heard:
            columns.append(j)
            at += 1
    return kept if at == m else np.ascontiguousarray(kept[:, :at]), columns, n_below, n_silent


cdef bint is_below(
    const float* gains, const float[:, :] peak, Py_ssize_t j, Py_ssize_t n_bands, double least, Py_ssize_t* n_new
) noexcept:
    """Return True if a source is felt by less than `least`. Sets `n_new` to 1 if it is felt by more than 0."""
    cdef Py_ssize_t k
    cdef double felt = 0
    for k in range(n_bands):
        felt += <double>gains[k] * peak[j, k]
    n_new[0] = felt != 0
    return felt < least


def within(list costs, list cutoff, list sought):
    cdef Py_ssize_t n = len(cutoff), n_beyond = 0, i, x
    cdef double cost, limit
    cdef list row
    columns, each = [], [[] for _ in costs]
    for x in range(n):
        limit = cutoff[x]
        is_near = False
        for i in range(len(costs)):
            row = costs[i]
            cost = row[x]
            if cost <= limit:
                is_near = True
            elif x in sought[i]:
                n_beyond += 1
        if is_near:
            columns.append(x)
            for i in range(len(costs)):
                row = costs[i]
                cost = row[x]
                (<list>each[i]).append(cost if cost <= limit else INFINITY)
    return columns, each, n_beyond
