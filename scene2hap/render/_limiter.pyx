"""The compiled twin of the kernel in `limiter`."""

from libc.math cimport copysign, fabs, tanh

from scene2hap.render import limiter

cdef double NOTHING = limiter.NOTHING

ctypedef fused Sample:
    float
    double


def limit_in_place(Sample[:, :] mix, scratch, double threshold):
    cdef Py_ssize_t i, k
    for i in range(mix.shape[0]):
        for k in range(mix.shape[1]):
            if fabs(mix[i, k]) > threshold:
                mix[i, k] = <Sample>limited(mix[i, k], threshold)


def turn_down_in_place(Sample[:, :] mix, double[::1] held, scratch, double threshold, powers):
    cdef Py_ssize_t i, k
    cdef double u, release
    if not mix.shape[1]:
        return
    release = powers[0]
    for i in range(mix.shape[0]):
        u = held[i]
        for k in range(mix.shape[1]):
            mix[i, k] = <Sample>turned_down(mix[i, k], &u, threshold, release)
        held[i] = u if u >= NOTHING else 0


cdef double turned_down(double x, double *u, double threshold, double release) noexcept:
    """Turn down the next sample. `u` is the reduction of the last sample (0 for none) and is updated."""
    cdef double level = fabs(x)
    u[0] *= release
    if level > threshold and 1 - threshold / level > u[0]:
        u[0] = 1 - threshold / level
    return x * (1 - u[0])


cdef double limited(double x, double threshold) noexcept:
    """Limit a sample beyond the threshold."""
    cdef double rest = 1 - threshold
    return copysign(threshold + rest * tanh((fabs(x) - threshold) / rest), x)
