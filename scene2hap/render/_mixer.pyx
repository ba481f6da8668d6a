"""The compiled twin of the kernel in `mixer`."""

from libc.math cimport fabs

from scene2hap.render._limiter cimport Reduction, limited, turned_down
from scene2hap.render._tactile_mix cimport TactileMix
from scene2hap.render._upsampler cimport PolyphaseFilter

import numpy as np

from scene2hap.render import limiter, loop_bank

cdef enum:
    CELL = 24  # a compile-time constant

assert CELL == loop_bank.CELL

cdef double THRESHOLD = limiter.THRESHOLD
cdef double NOTHING = limiter.NOTHING


cdef class Playhead:
    cdef readonly long long position
    cdef TactileMix mix
    cdef PolyphaseFilter filter
    cdef float[:, ::1] inputs, outputs
    cdef double[:, ::1] held
    cdef double release, attack
    cdef object incoming, tactile_rate_hz, sample_rate_hz
    cdef long long up, down, tick, cell_begin, cell_frame, cell_end_frame

    def __init__(self, TactileMix mix, upsampler, incoming, rates_hz):
        self.position = 0
        self.mix, self.incoming = mix, incoming
        self.filter, self.inputs, self.outputs = upsampler.filter, upsampler.inputs, upsampler.outputs(0)
        self.up, self.down = upsampler.up, upsampler.down
        self.tactile_rate_hz, self.sample_rate_hz = rates_hz
        self.held = np.zeros((2, self.outputs.shape[0]))
        self.release, self.attack = limiter.decays(rates_hz[1], 1)[:, 0]
        self.tick = self.cell_frame = self.cell_end_frame = 0
        self.cell_begin = -CELL

    def render_into(self, float[:, :] out):
        cdef long long frame = self.position, stop, begin = frame
        cdef long long end = frame + out.shape[0]
        cdef Py_ssize_t hand, k
        cdef double x
        cdef Reduction last
        while frame < end:
            if frame == self.cell_end_frame:
                self.enter_cell()
            stop = min(end, self.cell_end_frame)
            # Gains up to the newest input that the last of these outputs needs.
            self.take_gains((stop - 1) * self.down // self.up + 1)
            if self.mix.compute():
                self.filter.fill(self.outputs, self.inputs, self.cell_frame * self.down - self.cell_begin * self.up)
            for hand in range(out.shape[1]):
                last.held, last.applied = self.held[0, hand], self.held[1, hand]
                for k in range(stop - frame):
                    x = self.outputs[hand, frame - self.cell_frame + k]
                    x = turned_down(x, &last, THRESHOLD, self.release, self.attack)
                    out[frame - begin + k, hand] = <float>(limited(x, THRESHOLD) if fabs(x) > THRESHOLD else x)
                self.held[0, hand] = last.held if last.held >= NOTHING else 0
                self.held[1, hand] = last.applied if last.applied >= NOTHING else 0
            frame = stop
        self.position = end

    cdef enter_cell(self):
        self.cell_begin += CELL
        self.cell_frame = self.cell_end_frame
        # The first output that needs the next cell's first input.
        self.cell_end_frame = ((self.cell_begin + CELL) * self.up + self.down - 1) // self.down
        self.filter.advance(self.inputs)
        self.mix.enter(self.cell_begin)

    cdef take_gains(self, long long end):
        """Start the gains that are due before a tactile sample, but not before samples that are already rendered."""
        while self.incoming:
            change = self.incoming[0]
            # Python integers, since a caller may give a frame number too large for C.
            due = max(-(-change.at_frame * self.tactile_rate_hz // self.sample_rate_hz), self.tick)
            if due >= end:
                break
            self.incoming.popleft()
            self.mix.start(change.gains, due)
            self.tick = due
        self.tick = max(self.tick, end)
