"""The compiled twins of the kernels in `audibility`."""


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


def leave_out(float[:, :, ::1] gains, const float[:, :] peaks, double least):
    cdef Py_ssize_t i, j, k, n_new = 0
    cdef double felt
    for i in range(gains.shape[0]):
        for j in range(gains.shape[1]):
            felt = 0
            for k in range(gains.shape[2]):
                felt += <double>gains[i, j, k] * peaks[j, k]
            if felt < least:
                n_new += felt != 0
                for k in range(gains.shape[2]):
                    gains[i, j, k] = 0
    return n_new


def sounding(const float[:, :, :] gains):
    cdef Py_ssize_t i, j, k
    cdef bint is_heard
    found = []
    for j in range(gains.shape[1]):
        is_heard = False
        for i in range(gains.shape[0]):
            for k in range(gains.shape[2]):
                if gains[i, j, k] != 0:
                    is_heard = True
                    break
        if is_heard:
            found.append(j)
    return found
