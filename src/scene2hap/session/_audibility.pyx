"""The compiled twin of the kernel in `audibility`."""
# cython: boundscheck=False, wraparound=False


def silence(float[:, :, ::1] gains, const float[:, ::1] least):
    cdef Py_ssize_t i, k, n_silent = 0, n = least.shape[0] * least.shape[1]
    cdef float* row
    cdef const float* floor
    if gains.shape[0] * n == 0:
        return 0
    floor = &least[0, 0]
    for i in range(gains.shape[0]):
        row = &gains[i, 0, 0]
        for k in range(n):
            if not row[k] >= floor[k]:
                n_silent += row[k] != 0
                row[k] = 0
    return n_silent
