"""The compiled twin of the kernel in `audibility`."""
# cython: boundscheck=False, wraparound=False


def silence(float[:, :, ::1] gains, const float[:, ::1] least, columns):
    cdef Py_ssize_t i, j, k, n_silent = 0
    cdef float* row
    cdef const float* floor
    if gains.shape[2] == 0:
        return 0
    for j in range(gains.shape[1]):
        floor = &least[j if columns is None else columns[j], 0]
        for i in range(gains.shape[0]):
            row = &gains[i, j, 0]
            for k in range(gains.shape[2]):
                if not row[k] >= floor[k]:
                    n_silent += row[k] != 0
                    row[k] = 0
    return n_silent
