"""The compiled twins of the kernels in `loop_bank`."""

cdef enum:
    CELL = 24  # a compile-time constant


cdef class StoredLoop:
    cdef const float[:, ::1] samples
    cdef const float[::1] fade
    cdef long long length, numerator, denominator, last

    def __init__(self, const float[:, ::1] samples, length, numerator, denominator, const float[::1] fade):
        assert len(fade) == CELL
        self.samples, self.length, self.fade = samples, length, fade
        self.numerator, self.denominator = numerator, denominator
        # Up to this position no product overflows in C. With loops of minutes it is reached after days.
        self.last = 2**62 // (2 * max(numerator, denominator)) - CELL

    cdef write(self, begin, float* out):
        cdef long long here, there, b
        cdef Py_ssize_t start, other, band, t, n_bands = self.samples.shape[1]
        cdef const float* samples
        if 0 <= begin <= self.last:
            b = begin
            here = (2 * b * self.numerator + self.denominator) // (2 * self.denominator)
            there = (2 * (b + CELL) * self.numerator + self.denominator) // (2 * self.denominator) - CELL
            start, other = here % self.length, there % self.length
            if other < 0:  # a cell before the first sample
                other += self.length
        else:
            n, d = int(self.numerator), int(self.denominator)
            start = (2 * begin * n + d) // (2 * d) % self.length
            other = ((2 * (begin + CELL) * n + d) // (2 * d) - CELL) % self.length
        samples = &self.samples[start, 0]
        for band in range(n_bands):
            for t in range(CELL):
                out[CELL * band + t] = samples[n_bands * t + band]
        if other != start:
            samples = &self.samples[other, 0]
            for band in range(n_bands):
                for t in range(CELL):
                    out[CELL * band + t] += (samples[n_bands * t + band] - out[CELL * band + t]) * self.fade[t]


def read(list loops, begin, float[:, ::1] out):
    cdef Py_ssize_t row = 0, k, n_bands = out.shape[0] // len(loops) if loops else 0
    assert out.shape[1] == CELL
    for loop in loops:
        if loop is not None:
            assert (<StoredLoop?>loop).samples.shape[1] == n_bands  # else it writes beside its rows
            (<StoredLoop>loop).write(begin, &out[row, 0])
        else:
            for k in range(n_bands * CELL):
                (&out[row, 0])[k] = 0
        row += n_bands


def read_between(
    StoredLoop loop, const Py_ssize_t[::1] below, const float[:, :] weights, float[:, ::1] cell, float[:, ::1] out
):
    cdef Py_ssize_t t, tap, band, at, number, n_bands = out.shape[1], low = below[0], high = below[0]
    assert below.shape[0] == weights.shape[1] == out.shape[0] == CELL and weights.shape[0] == 4
    assert cell.shape[0] == n_bands == loop.samples.shape[1] and cell.shape[1] == CELL
    out[:] = 0
    for t in range(1, CELL):
        low, high = min(low, below[t]), max(high, below[t])
    number = (low - 1) // CELL
    if number * CELL > low - 1:  # C rounds towards 0
        number -= 1
    for number in range(number, (high + 2) // CELL + 1):
        loop.write(number * CELL, &cell[0, 0])
        for t in range(CELL):
            for tap in range(4):
                at = below[t] + tap - 1 - number * CELL
                if 0 <= at < CELL:
                    for band in range(n_bands):
                        out[t, band] += cell[band, at] * weights[tap, t]
