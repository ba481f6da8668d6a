"""The compiled twin of the kernel in `limiter`."""
# cython: boundscheck=False, wraparound=False, cdivision=True

from libc.math cimport copysign, fabs, tanh

ctypedef fused Sample:
    float
    double


def limit_in_place(Sample[:, ::1] mix, scratch, double threshold):
    cdef Py_ssize_t i, k
    cdef double size, rest = 1 - threshold
    for i in range(mix.shape[0]):
        for k in range(mix.shape[1]):
            size = fabs(mix[i, k])
            if size > threshold:
                mix[i, k] = <Sample>copysign(threshold + rest * tanh((size - threshold) / rest), mix[i, k])
