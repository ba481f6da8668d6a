cdef class RampedProduct:
    cdef readonly object loops, gains
    cdef float[:, ::1] L
    cdef float[:, :, ::1] G, P
    cdef const float[::1] rise
    cdef Py_ssize_t n_hands, n_rows
    cdef long long begin
    # The slots whose products are still to be found.
    cdef unsigned char[::1] is_stale

    cpdef set(self, Py_ssize_t slot, const float[:, :, ::1] values, list places, Py_ssize_t n_rows)
    cdef clear(self, Py_ssize_t place, Py_ssize_t n)
    cdef move(self, Py_ssize_t there, Py_ssize_t here, Py_ssize_t n)
    cdef weigh(
        self,
        float[:, :] x,
        Py_ssize_t n_rows,
        const Py_ssize_t* slots,
        const long long* starts,
        Py_ssize_t n_slots,
        long long begin,
        Py_ssize_t first,
    )
