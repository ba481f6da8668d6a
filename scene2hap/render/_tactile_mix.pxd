cdef class RampedProduct:
    cdef readonly object loops, gains
    cdef float[:, ::1] L
    cdef float[:, :, ::1] G, P
    cdef const float[::1] rise
    cdef Py_ssize_t n_hands, n_rows
    cdef long long begin
    # Whether the product of each slot must be computed again.
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


cdef class TactileMix:
    cdef readonly object x
    cdef readonly Py_ssize_t n_cells, n_rows_mixed, n_merged
    cdef object bank, waiting
    cdef RampedProduct product
    cdef float[:, :] mixed
    cdef Py_ssize_t n_bands, ramp, first
    cdef long long begin
    cdef bint is_stale
    cdef list free, held, loops, users, place_of

    cpdef enter(self, long long begin)
    cpdef start(self, gains, long long tick)
    cpdef bint compute(self) except -1
    cdef read(self, Py_ssize_t first)
    cdef use(self, heard)
    cdef leave(self, heard)
