"""The compiled twin of the kernel in `upsampler`."""

import numpy as np

from scene2hap.render import loop_bank

cdef enum:
    CELL = 24  # a compile-time constant

assert CELL == loop_bank.CELL


cdef class PolyphaseFilter:
    def __init__(self, h, Py_ssize_t up, Py_ssize_t down, n_frames, offsets):
        self.up, self.down, self.n_taps = up, down, len(h) // up
        # Each phase in the order of its inputs.
        self.taps = np.ascontiguousarray(h.reshape(-1, up)[::-1].T, dtype=np.float32)

    cpdef advance(self, float[:, ::1] X):
        cdef Py_ssize_t channel, k
        for channel in range(X.shape[0]):
            for k in range(X.shape[1] - CELL):
                X[channel, k] = X[channel, k + CELL]

    cpdef fill(self, float[:, ::1] Y, const float[:, ::1] X, Py_ssize_t offset):
        cdef Py_ssize_t up = self.up, down = self.down, n_taps = self.n_taps, n_frames = Y.shape[1]
        cdef Py_ssize_t channel, frame, phase, k, n_inputs = X.shape[1]
        cdef const float* taps = &self.taps[0, 0]
        cdef const float* x
        cdef const float* end
        cdef float* y
        cdef float total
        for channel in range(Y.shape[0]):
            x, y, phase = &X[channel, offset // up], &Y[channel, 0], offset % up
            end = &X[channel, 0] + n_inputs - n_taps
            for frame in range(n_frames):
                total = 0
                # The last output of some cells belongs to the next cell and is not used here.
                if x <= end:
                    for k in range(n_taps):
                        total += taps[phase * n_taps + k] * x[k]
                y[frame] = total
                phase += down
                if phase >= up:  # never by more, since up >= down
                    phase -= up
                    x += 1
