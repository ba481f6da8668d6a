cdef double distance(tuple place, double x, double y, double z) except -1
cdef bint is_entered(list entries, double price_per_m, double x, double y, double z, double cost) except -1
cdef double least_of(list entries, double price_per_m, tuple point_m) except -1
cdef double nearest_of(tuple points_m, tuple point_m) except -1
