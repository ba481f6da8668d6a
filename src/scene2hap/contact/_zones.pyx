"""The compiled twins of the kernels in `zones`."""

import numpy as np

from libc.math cimport INFINITY, fmax, fmin


cdef class Zones:
    cdef readonly object low, high
    cdef double[:, ::1] lows, highs

    def __init__(self):
        self.keep(np.full((3, 64), INFINITY), np.full((3, 64), -INFINITY))

    cdef keep(self, low, high):
        self.low, self.high = low, high
        self.lows, self.highs = low, high

    def put(self, Py_ssize_t row, low, high):
        if row == self.lows.shape[1]:
            self.keep(doubled(self.low, INFINITY), doubled(self.high, -INFINITY))
        self.lows[0, row], self.lows[1, row], self.lows[2, row] = low
        self.highs[0, row], self.highs[1, row], self.highs[2, row] = high

    def meeting(self, Py_ssize_t row):
        cdef Py_ssize_t k, n = self.lows.shape[1]
        cdef double a = self.lows[0, row], b = self.lows[1, row], c = self.lows[2, row]
        cdef double d = self.highs[0, row], e = self.highs[1, row], f = self.highs[2, row]
        cdef const double* low = &self.lows[0, 0]
        cdef const double* high = &self.highs[0, 0]
        found = []
        for k in range(n):
            if low[k] <= d and high[k] >= a and low[n + k] <= e and high[n + k] >= b:
                if low[2 * n + k] <= f and high[2 * n + k] >= c and k != row:
                    found.append(k)
        return found


cdef doubled(boxes, double value):
    return np.concatenate([boxes, np.full_like(boxes, value)], axis=1)


def room_around(tuple low, tuple high, double skin_m, tuple before, int up_axis):
    cdef double lows[3]
    cdef double highs[3]
    cdef double a, b, near = skin_m, far = 2 * skin_m
    cdef tuple least = before[0], most = before[1]
    cdef int k
    for k in range(3):
        a, b = low[k], high[k]
        lows[k], highs[k] = a - near, b + near
        if k != up_axis:
            lows[k] = fmax(fmin(lows[k], least[k]), a - far)
            highs[k] = fmin(fmax(highs[k], most[k]), b + far)
    return (lows[0], lows[1], lows[2]), (highs[0], highs[1], highs[2])
