from scene2hap.render._ramped_product cimport RampedProduct


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
