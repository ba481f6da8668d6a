cdef class PolyphaseFilter:
    cdef float[:, ::1] taps
    cdef Py_ssize_t up, down, n_taps

    cpdef advance(self, float[:, ::1] X)
    cpdef fill(self, float[:, ::1] Y, const float[:, ::1] X, Py_ssize_t offset)
