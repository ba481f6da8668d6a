"""The compiled twin of the kernel in `near_field`."""

import numpy as np

from libc.math cimport M_PI, atan2, atanh, fabs, fmax, sqrt

cdef double FAR = 20.0  # as in `near_field`, whose table ends there


cdef class Dimples:
    def __init__(self, drive_m, x_weights, y_weights, cut2, extent, pieces):
        self.drive_m = np.ascontiguousarray(drive_m)
        self.x_weights, self.y_weights, self.cut2, self.pieces = x_weights, y_weights, cut2, pieces
        self.per_length, self.per_width, self.kx, self.ky = extent
        self.length2, self.width2 = 4 / self.per_length, 4 / self.per_width
        self.per_piece = (len(pieces) - 1) / sqrt(FAR)

    def at(self, const double[:, :] points_m):
        cdef Py_ssize_t n_points = points_m.shape[0], n_drives = self.cut2.shape[0], i, k
        found = np.empty((2, n_points, n_drives))
        cdef double[:, :, ::1] out = found
        cdef double here2, cut
        for i in range(n_points):
            here2 = self.cutoff_squared(points_m[i, 0], points_m[i, 1])
            for k in range(n_drives):
                cut = fmax(here2, self.cut2[k])
                out[0, i, k] = self.share(points_m[i, 0], points_m[i, 1], k, cut)
                out[1, i, k] = cut
        return found[0], found[1]

    def near(self, const double[:, :] points_m, const double[::1] k2):
        cdef Py_ssize_t n_points = points_m.shape[0], n_drives = self.cut2.shape[0], n_k2 = k2.shape[0], i, drive, k
        found = np.empty((n_points, n_drives, n_k2))
        cdef double[:, :, ::1] out = found
        cdef double here2, cut, share
        for i in range(n_points):
            here2 = self.cutoff_squared(points_m[i, 0], points_m[i, 1])
            for drive in range(n_drives):
                cut = fmax(here2, self.cut2[drive])
                share = self.share(points_m[i, 0], points_m[i, 1], drive, cut)
                for k in range(n_k2):
                    out[i, drive, k] = near_of(k2[k], cut, share)
        return found

    cdef double cutoff_squared(self, double x, double y) noexcept:
        cdef double xi = x * self.per_length - 1, eta = y * self.per_width - 1
        cdef double kx = self.kx / sqrt(fmax(1 - xi * xi, 1e-30)), ky = self.ky / sqrt(fmax(1 - eta * eta, 1e-30))
        cdef double corner = atan2(ky, kx), half = kx * ky / (kx * kx + ky * ky)
        return M_PI / ((corner + half) / (kx * kx) + (M_PI / 2 - corner + half) / (ky * ky))

    cdef double share(self, double x, double y, Py_ssize_t drive, double cut2) noexcept:
        """Return the sum over a force and its fifteen images."""
        cdef Py_ssize_t i, j, piece, last = self.pieces.shape[0] - 1
        cdef double dx2[4]
        cdef double dy2[4]
        cdef double t, total = 0, far2 = FAR * FAR / cut2
        separate(dx2, x, self.drive_m[drive, 0], self.length2)
        separate(dy2, y, self.drive_m[drive, 1], self.width2)
        for i in range(4):
            if dx2[i] >= far2:  # true of most images
                continue
            for j in range(4):
                if dx2[i] + dy2[j] >= far2:
                    continue
                # The table of g has equal steps of the root of K r.
                t = self.per_piece * sqrt(sqrt((dx2[i] + dy2[j]) * cut2))
                if t < last:
                    piece = <Py_ssize_t>t
                    t = self.pieces[piece, 0] + (t - piece) * self.pieces[piece, 1]
                    total += self.x_weights[i] * self.y_weights[j] * t
        if dx2[0] == 0 and dy2[0] == 0:
            return fmax(total, 0.0)
        return total


cdef void separate(double* squares, double x, double drive, double length2) noexcept:
    """Compute squared distances along an axis of a point from a force and its images. length2 : twice the length."""
    cdef double apart = fabs(x - drive), sum = x + drive
    squares[0], squares[1] = apart * apart, sum * sum
    squares[2], squares[3] = (length2 - sum) * (length2 - sum), (length2 - apart) * (length2 - apart)


cdef double near_of(double k2, double cut2, double share) noexcept:
    """Return the near field of a force from its share. See `_beyond`."""
    return atanh(k2 / cut2) * share / (4 * M_PI * k2)
