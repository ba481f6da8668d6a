cdef double least_of(list entries, double price_per_m, tuple point_m) except -1
cdef double nearest_of(tuple points_m, tuple point_m) except -1
