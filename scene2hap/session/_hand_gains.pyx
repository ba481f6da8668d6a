"""The compiled twin of the kernel in `hand_gains`."""


def cap(double[:, :, :] gains, double limit):
    cdef Py_ssize_t i, j, k, n_above = 0
    for i in range(gains.shape[0]):
        for j in range(gains.shape[1]):
            for k in range(gains.shape[2]):
                if gains[i, j, k] > limit:
                    gains[i, j, k] = limit
                    n_above += 1
                elif not gains[i, j, k] >= 0:
                    gains[i, j, k] = 0
    return n_above
