"""The compiled twin of the kernel in `zones`."""

import numpy as np

from libc.math cimport INFINITY, fmax, fmin


cdef class Zones:
    cdef readonly object low, high
    cdef double[:, ::1] lows, highs, rooms
    cdef int up_axis
    cdef double skin_m
    # How far it may reach beyond what it is drawn around, along each axis.
    cdef double far_m[3]

    def __init__(self, int up_axis, double skin_m, memory_m):
        cdef double level_m, upright_m
        cdef int k
        level_m, upright_m = memory_m
        self.up_axis, self.skin_m = up_axis, skin_m
        for k in range(3):
            self.far_m[k] = skin_m + (upright_m if k == up_axis else level_m)
        # A room's lowest and then its highest corner; infinite where there is none.
        self.rooms = np.full((64, 6), INFINITY)
        self.keep(np.full((3, 64), INFINITY), np.full((3, 64), -INFINITY))

    cdef keep(self, low, high):
        self.low, self.high = low, high
        self.lows, self.highs = low, high

    def draw(self, Py_ssize_t row, tuple low, tuple high, double side_m, double down_m):
        cdef double a, b, c, d, near = self.skin_m
        cdef int k
        cdef bint has_room
        if row == self.rooms.shape[0]:
            self.rooms = np.concatenate([self.rooms, np.full((row, 6), INFINITY)])
            self.keep(doubled(self.low, INFINITY), doubled(self.high, -INFINITY))
        has_room = self.rooms[row, 0] < INFINITY
        for k in range(3):
            a, b = low[k], high[k]
            c, d = a, b
            if has_room:
                c = fmax(fmin(a - near, self.rooms[row, k]), a - self.far_m[k])
                d = fmin(fmax(b + near, self.rooms[row, 3 + k]), b + self.far_m[k])
            self.rooms[row, k], self.rooms[row, 3 + k] = c, d
            self.lows[k, row], self.highs[k, row] = c - side_m, d + side_m
        self.lows[self.up_axis, row] -= down_m

    def clear(self, Py_ssize_t row):
        self.rooms[row, :] = INFINITY
        self.lows[:, row], self.highs[:, row] = INFINITY, -INFINITY

    def room(self, Py_ssize_t row):
        cdef double* at = &self.rooms[row, 0]
        return (at[0], at[1], at[2]), (at[3], at[4], at[5])

    def holds(self, Py_ssize_t row, tuple low, tuple high):
        cdef double* at = &self.rooms[row, 0]
        cdef double a, b
        cdef int k
        for k in range(3):
            a, b = low[k], high[k]
            if not (a >= at[k] and b <= at[3 + k]):
                return False
        return True

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
