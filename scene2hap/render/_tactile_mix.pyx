"""The compiled twins of the kernels in `tactile_mix`."""

import numpy as np

from scene2hap.render import loop_bank
from scene2hap.render.tactile_mix import rise_over, slots_for

cdef enum:
    CELL = 24  # a compile-time constant, so that the compiler keeps a row in registers
    MOST = 64

assert CELL == loop_bank.CELL


cdef class RampedProduct:
    def __init__(
        self, Py_ssize_t n_rows, Py_ssize_t n_places, Py_ssize_t n_slots, Py_ssize_t n_hands, const float[::1] rise
    ):
        assert n_slots <= MOST
        self.n_hands, self.rise, self.begin, self.n_rows = n_hands, rise, 0, -1
        self.is_stale = np.ones(n_slots, dtype=np.uint8)
        self.loops = np.zeros((n_rows, CELL), dtype=np.float32)
        # The gains of a hand in a slot are adjacent, since they are read one after the other.
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
        """Copy gains of all slots to another place."""
        self.gains[there : there + n] = self.gains[here : here + n]

    def mix(self, float[:, :] x, Py_ssize_t n_rows, list slots, list starts, long long begin, Py_ssize_t first):
        cdef Py_ssize_t k, n_slots = len(slots)
        cdef Py_ssize_t[MOST] own_slots
        cdef long long[MOST] own_starts
        assert n_slots <= MOST
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
    """Compute the sum over all rows of gain times cell."""
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


cdef class Held:
    """Gains in a slot; their ramp begins at `start` and ends at `end`."""

    cdef object heard
    cdef Py_ssize_t slot
    cdef long long start, end

    def __init__(self, heard, slot, start, end):
        self.heard, self.slot, self.start, self.end = heard, slot, start, end


cdef class TactileMix:
    def __init__(self, bank, Py_ssize_t n_hands, Py_ssize_t ramp, x, *, bint is_skipping=True):
        cdef Py_ssize_t n_slots = slots_for(ramp, bank.sample_rate_hz)
        assert n_slots <= MOST
        self.bank, self.n_bands, self.ramp = bank, bank.n_bands, ramp
        self.x = self.mixed = x
        # After the places of loops in use there is one place for the gains of unused loops.
        n_places = bank.n_rows + bank.n_bands
        self.product = RampedProduct(bank.n_rows, n_places, n_slots, n_hands, rise_over(ramp))
        silence = () if is_skipping else range(len(bank))
        self.free = list(range(n_slots - 1, 0, -1))
        self.held = [Held(silence, 0, 0, 0)]
        self.waiting = None
        self.loops, self.users, self.place_of = [], [0] * len(bank), [len(bank)] * len(bank)
        self.begin = self.first = 0
        self.is_stale = False
        self.n_cells = self.n_rows_mixed = self.n_merged = 0
        self.use(silence)

    cpdef enter(self, long long begin):
        cdef Held ended
        self.begin, self.first, self.is_stale = begin, 0, True
        while len(self.held) > 1 and (<Held>self.held[1]).end <= begin:
            ended = self.held.pop(0)
            self.free.append(ended.slot)
            if ended.heard != (<Held>self.held[0]).heard:
                self.leave(ended.heard)
        self.n_cells += 1
        self.n_rows_mixed += len(self.loops) * self.n_bands
        self.read(0)
        if self.waiting is not None and self.free:
            gains, self.waiting = self.waiting, None
            self.start(gains, begin)

    cpdef start(self, gains, long long tick):
        cdef Py_ssize_t first_new
        cdef bint is_more = False
        if not self.free:
            self.n_merged += self.waiting is not None
            self.waiting = gains
            return
        heard = gains.heard
        if heard != (<Held>self.held[len(self.held) - 1]).heard:
            for loop in heard:
                if self.users[<Py_ssize_t>loop] == 0:
                    is_more = True
                    break
            if is_more:
                # Samples before this one keep the old product; see the Python twin.
                self.compute()
                self.first = tick - self.begin
            first_new = len(self.loops)
            self.use(heard)
            if is_more:
                self.read(first_new)
        slot = self.free.pop()
        self.held.append(Held(heard, slot, tick, tick + self.ramp - 1))
        places = [self.place_of[<Py_ssize_t>loop] for loop in gains.loops]
        self.product.set(slot, gains.values, places, len(self.loops) * self.n_bands)
        self.is_stale = True

    cpdef bint compute(self) except -1:
        cdef Py_ssize_t[MOST] slots
        cdef long long[MOST] starts
        cdef Py_ssize_t k, n_held = len(self.held)
        cdef Held held
        if not self.is_stale:
            return False
        self.is_stale = False
        for k in range(n_held):
            held = self.held[k]
            slots[k], starts[k] = held.slot, held.start
        self.product.weigh(
            self.mixed, len(self.loops) * self.n_bands, slots, starts, n_held, self.begin, self.first
        )
        return True

    cdef read(self, Py_ssize_t first):
        """Read the cells of the loops in use, from the loop `first` on."""
        cdef Py_ssize_t n_loops = len(self.loops)
        if first < n_loops:
            rows = self.product.loops[first * self.n_bands : n_loops * self.n_bands]
            self.bank.read(self.loops[first:], self.begin, rows)

    cdef use(self, heard):
        for loop in heard:
            self.users[<Py_ssize_t>loop] += 1
            if self.users[<Py_ssize_t>loop] == 1:
                self.place_of[<Py_ssize_t>loop] = len(self.loops)
                self.product.clear(len(self.loops) * self.n_bands, self.n_bands)
                self.loops.append(loop)

    cdef leave(self, heard):
        cdef Py_ssize_t at
        for loop in heard:
            self.users[<Py_ssize_t>loop] -= 1
            if self.users[<Py_ssize_t>loop] == 0:
                # The last loop moves to the free place, so that loops in use stay contiguous.
                at, moved = self.place_of[<Py_ssize_t>loop], self.loops.pop()
                if moved != loop:
                    self.loops[at] = moved
                self.place_of[<Py_ssize_t>moved], self.place_of[<Py_ssize_t>loop] = at, len(self.users)
                self.product.move(at * self.n_bands, len(self.loops) * self.n_bands, self.n_bands)
