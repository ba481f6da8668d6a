"""The compiled twins of the kernels in `points`."""

import numpy as np

from libc.math cimport fmax, fmin, isfinite


def are_finite(const double[:, :] points):
    cdef Py_ssize_t i, k
    for i in range(points.shape[0]):
        for k in range(points.shape[1]):
            if not isfinite(points[i, k]):
                return False
    return True


cdef class InRectangle:
    cdef double px, py, pz, length_m, width_m
    cdef double[2][3] axes

    def __init__(self, pose, double length_m, double width_m):
        cdef double x, y, z, w
        self.px, self.py, self.pz = pose.position_m
        self.length_m, self.width_m = length_m, width_m
        x, y, z, w = pose.rotation_xyzw
        self.axes[0][:] = [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)]
        self.axes[1][:] = [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)]

    def __call__(self, const double[:, :] points_m):
        cdef double a, b, c
        cdef Py_ssize_t i, n = points_m.shape[0]
        found = np.empty((n, 2))
        cdef double[:, ::1] out = found
        for i in range(n):
            a, b, c = points_m[i, 0] - self.px, points_m[i, 1] - self.py, points_m[i, 2] - self.pz
            out[i, 0] = fmin(fmax(along(self.axes[0], a, b, c), 0.0), self.length_m)
            out[i, 1] = fmin(fmax(along(self.axes[1], a, b, c), 0.0), self.width_m)
        return found


cdef double along(const double* axis, double a, double b, double c) noexcept:
    return a * axis[0] + b * axis[1] + c * axis[2]
