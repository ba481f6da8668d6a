"""The compiled twins of the kernels in `entries`."""

from libc.math cimport INFINITY, fmin, sqrt


cdef double distance(tuple place, double x, double y, double z) except -1:
    cdef double a = place[0], b = place[1], c = place[2]
    a, b, c = a - x, b - y, c - z
    return sqrt(a * a + b * b + c * c)


cdef double least_of(list entries, double price_per_m, tuple point_m) except -1:
    cdef double least = INFINITY, cost, x, y, z
    cdef tuple entry
    x, y, z = point_m
    for entry in entries:
        cost = entry[1]
        least = fmin(least, cost + price_per_m * distance(entry[0], x, y, z))
    return least


cdef double nearest_of(tuple points_m, tuple point_m) except -1:
    cdef double least = INFINITY, x, y, z
    x, y, z = point_m
    for place in points_m:
        least = fmin(least, distance(place, x, y, z))
    return least


def least_cost(list entries, double price_per_m, tuple point_m):
    return least_of(entries, price_per_m, point_m)


def nearest_m(tuple points_m, tuple point_m):
    return nearest_of(points_m, point_m)


def is_within(list entries, double price_per_m, tuple point_m, double cost):
    cdef double x, y, z
    x, y, z = point_m
    return bool(is_entered(entries, price_per_m, x, y, z, cost))


cdef bint is_entered(list entries, double price_per_m, double x, double y, double z, double cost) except -1:
    cdef double entered
    cdef tuple entry
    for entry in entries:
        entered = entry[1]
        if entered + price_per_m * distance(entry[0], x, y, z) <= cost:
            return True
    return False
