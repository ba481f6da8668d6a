"""The compiled twin of the kernel in `ramped_product`."""
# cython: boundscheck=False, wraparound=False, cdivision=True

import numpy as np

from scene2hap.render import loop_bank

cdef enum:
    CELL = 24  # known to the compiler, which has a row of it in registers

assert CELL == loop_bank.CELL


cdef class RampedProduct:
    cdef readonly object loops, gains
    cdef float[:, ::1] L
    cdef float[:, :, ::1] G, P
    cdef const float[::1] rise
    cdef Py_ssize_t n_hands, n_rows
    cdef object begin
    # The slots whose products are still to be found.
    cdef set stale

    def __init__(
        self, Py_ssize_t n_rows, Py_ssize_t n_places, Py_ssize_t n_slots, Py_ssize_t n_hands, const float[::1] rise
    ):
        self.n_hands, self.rise, self.begin, self.stale = n_hands, rise, None, set()
        self.loops = np.zeros((n_rows, CELL), dtype=np.float32)
        # The gains of a hand in a slot side by side, for they are read in a row.
        gains = np.zeros((n_slots, n_hands, n_places), dtype=np.float32)
        self.gains = gains.transpose(2, 0, 1)
        self.L, self.G, self.P = self.loops, gains, np.zeros((n_slots, n_hands, CELL), dtype=np.float32)

    def set(self, Py_ssize_t slot, const float[:, :, ::1] values, list places, Py_ssize_t n_rows):
        cdef Py_ssize_t hand, loop, band, place, n_bands = values.shape[2]
        cdef float* gains
        for hand in range(self.n_hands):
            gains = &self.G[slot, hand, 0]
            for place in range(n_rows):
                gains[place] = 0
            for loop in range(values.shape[1]):
                place = n_bands * <Py_ssize_t>places[loop]
                for band in range(n_bands):
                    gains[place + band] = values[hand, loop, band]
        self.stale.add(slot)

    def mix(self, float[:, :] x, Py_ssize_t n_rows, list slots, list starts, begin, Py_ssize_t first):
        cdef Py_ssize_t k, t, hand, slot, n = len(slots)
        cdef float weights[CELL]
        cdef const float* rising
        cdef const float* risen = &self.rise[self.rise.shape[0] - CELL]
        cdef const float* product
        if begin != self.begin or n_rows != self.n_rows:
            self.begin, self.n_rows = begin, n_rows
            self.stale.update(slots)
        for hand in range(self.n_hands):
            for t in range(first, CELL):
                x[hand, t] = 0
        for k in range(n):
            for t in range(CELL):
                weights[t] = risen[t]
            if k + 1 < n:
                rising = &self.rise[CELL + <Py_ssize_t>(begin - starts[k + 1])]
                for t in range(CELL):
                    weights[t] -= rising[t]
                risen = rising
            slot = slots[k]
            if slot in self.stale:
                self.stale.discard(slot)
                for hand in range(self.n_hands):
                    multiply(&self.P[slot, hand, 0], &self.G[slot, hand, 0], &self.L[0, 0] if n_rows else NULL, n_rows)
            for hand in range(self.n_hands):
                product = &self.P[slot, hand, 0]
                for t in range(first, CELL):
                    x[hand, t] += weights[t] * product[t]


cdef void multiply(float* product, const float* gains, const float* loops, Py_ssize_t n_rows) noexcept:
    """The sum over all rows of their gains times their cells."""
    cdef Py_ssize_t row, t
    cdef float gain
    cdef float total[CELL]
    for t in range(CELL):
        total[t] = 0
    for row in range(n_rows):
        gain = gains[row]
        for t in range(CELL):
            total[t] += gain * loops[CELL * row + t]
    for t in range(CELL):
        product[t] = total[t]
