"""The compiled twins of the kernels in `points`."""
# cython: boundscheck=False, wraparound=False, cdivision=True

import numpy as np

from libc.math cimport fmax, fmin, isfinite


def are_finite(const double[:, :] points):
    cdef Py_ssize_t i, k
    for i in range(points.shape[0]):
        for k in range(points.shape[1]):
            if not isfinite(points[i, k]):
                return False
    return True


def in_rectangle(const double[:, :] points_m, pose, double length_m, double width_m):
    cdef double x, y, z, w, a, b, c, u, v, px, py, pz
    cdef Py_ssize_t i, n = points_m.shape[0]
    found = np.empty((n, 2))
    cdef double[:, ::1] told = found
    x, y, z, w = pose.rotation_xyzw
    px, py, pz = pose.position_m
    for i in range(n):
        a, b, c = points_m[i, 0] - px, points_m[i, 1] - py, points_m[i, 2] - pz
        u = a * (1 - 2 * (y * y + z * z)) + b * (2 * (x * y + z * w)) + c * (2 * (x * z - y * w))
        v = a * (2 * (x * y - z * w)) + b * (1 - 2 * (x * x + z * z)) + c * (2 * (y * z + x * w))
        told[i, 0], told[i, 1] = fmin(fmax(u, 0.0), length_m), fmin(fmax(v, 0.0), width_m)
    return found
