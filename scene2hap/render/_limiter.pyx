"""The compiled twin of the kernel in `limiter`."""

from libc.math cimport copysign, fabs, tanh

ctypedef fused Sample:
    float
    double


def limit_in_place(Sample[:, ::1] mix, scratch, double threshold):
    cdef Py_ssize_t i, k
    for i in range(mix.shape[0]):
        for k in range(mix.shape[1]):
            if fabs(mix[i, k]) > threshold:
                mix[i, k] = <Sample>limited(mix[i, k], threshold)


cdef double limited(double x, double threshold) noexcept:
    """What becomes of a sample beyond the threshold."""
    cdef double rest = 1 - threshold
    return copysign(threshold + rest * tanh((fabs(x) - threshold) / rest), x)
