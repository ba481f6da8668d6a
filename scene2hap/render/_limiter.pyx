"""The compiled twin of the kernel in `limiter`."""

from libc.math cimport copysign, exp, fabs, fmax, log, tanh

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


def turn_down_in_place(Sample[:, :] mix, double[:, ::1] held, scratch, double threshold, const double[:, :] decays):
    cdef Py_ssize_t i, k
    cdef Reduction last
    if not mix.shape[1]:
        return
    for i in range(mix.shape[0]):
        last.held, last.applied = held[0, i], held[1, i]
        for k in range(mix.shape[1]):
            mix[i, k] = <Sample>turned_down(mix[i, k], &last, threshold, decays[0, 0], decays[1, 0])
        held[0, i] = last.held if last.held >= NOTHING else 0
        held[1, i] = last.applied if last.applied >= NOTHING else 0


cdef double turned_down(double x, Reduction* last, double threshold, double release, double attack) noexcept:
    """Turn down the next sample. `last` is the reduction at the last sample [Np], and is updated."""
    cdef double level = fabs(x)
    last.held *= release
    if level > threshold:
        last.held = fmax(last.held, log(level / threshold))
    last.applied = attack * last.applied + (1 - attack) * last.held
    return x * exp(-last.applied) if last.applied else x


cdef double limited(double x, double threshold) noexcept:
    """Limit a sample beyond the threshold."""
    cdef double rest = 1 - threshold
    return copysign(threshold + rest * tanh((fabs(x) - threshold) / rest), x)
