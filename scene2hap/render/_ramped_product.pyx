"""The compiled twin of the kernel in `ramped_product`."""

import numpy as np

from scene2hap.render import loop_bank

cdef enum:
    CELL = 24  # known to the compiler, which has a row of it in registers
    MOST_SLOTS = 64

assert CELL == loop_bank.CELL


cdef class RampedProduct:
    def __init__(
        self, Py_ssize_t n_rows, Py_ssize_t n_places, Py_ssize_t n_slots, Py_ssize_t n_hands, const float[::1] rise
    ):
        assert n_slots <= MOST_SLOTS
        self.n_hands, self.rise, self.begin, self.n_rows = n_hands, rise, 0, -1
        self.is_stale = np.ones(n_slots, dtype=np.uint8)
        self.loops = np.zeros((n_rows, CELL), dtype=np.float32)
        # The gains of a hand in a slot side by side, for they are read in a row.
        gains = np.zeros((n_slots, n_hands, n_places), dtype=np.float32)
        self.gains = gains.transpose(2, 0, 1)
        self.L, self.G, self.P = self.loops, gains, np.zeros((n_slots, n_hands, CELL), dtype=np.float32)

    cpdef set(self, Py_ssize_t slot, const float[:, :, ::1] values, list places, Py_ssize_t n_rows):
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
        self.is_stale[slot] = True

    cdef clear(self, Py_ssize_t place, Py_ssize_t n):
        """Set gains of all slots to 0."""
        self.G[:, :, place : place + n] = 0

    cdef move(self, Py_ssize_t there, Py_ssize_t here, Py_ssize_t n):
        """Take gains of all slots to another place."""
        self.gains[there : there + n] = self.gains[here : here + n]

    def mix(self, float[:, :] x, Py_ssize_t n_rows, list slots, list starts, long long begin, Py_ssize_t first):
        cdef Py_ssize_t k, n_slots = len(slots)
        cdef Py_ssize_t[MOST_SLOTS] own_slots
        cdef long long[MOST_SLOTS] own_starts
        assert n_slots <= MOST_SLOTS
        for k in range(n_slots):
            own_slots[k], own_starts[k] = slots[k], starts[k]
        self.weigh(x, n_rows, own_slots, own_starts, n_slots, begin, first)

    cdef weigh(
        self,
        float[:, :] x,
        Py_ssize_t n_rows,
        const Py_ssize_t* slots,
        const long long* starts,
        Py_ssize_t n_slots,
        long long begin,
        Py_ssize_t first,
    ):
        """See `mix`."""
        cdef Py_ssize_t k, t, hand, slot
        cdef float weights[CELL]
        cdef const float* rising
        cdef const float* risen = &self.rise[self.rise.shape[0] - CELL]
        cdef const float* product
        if begin != self.begin or n_rows != self.n_rows:
            self.begin, self.n_rows = begin, n_rows
            self.is_stale[:] = True
        for hand in range(self.n_hands):
            for t in range(first, CELL):
                x[hand, t] = 0
        for k in range(n_slots):
            for t in range(CELL):
                weights[t] = risen[t]
            if k + 1 < n_slots:
                rising = &self.rise[CELL + (begin - starts[k + 1])]
                for t in range(CELL):
                    weights[t] -= rising[t]
                risen = rising
            slot = slots[k]
            if self.is_stale[slot]:
                self.is_stale[slot] = False
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
