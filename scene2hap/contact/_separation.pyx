"""The compiled twins of the kernels in `separation`."""

from libc.math cimport INFINITY, fabs, sqrt


cdef struct Rectangle:
    double a_u, a_v, half_1, half_2, radius


cdef Rectangle rectangle_of(footprint) except *:
    cdef Rectangle found
    found.a_u, found.a_v, found.half_1, found.half_2, found.radius = footprint
    return found


cdef double reach(Rectangle* x, double n_u, double n_v) noexcept:
    cdef double along = fabs(n_u * x.a_u + n_v * x.a_v) * x.half_1 + fabs(n_v * x.a_u - n_u * x.a_v) * x.half_2
    return along if along < x.radius else x.radius


def reach_along(footprint, double n_u, double n_v):
    cdef Rectangle x = rectangle_of(footprint)
    return reach(&x, n_u, n_v)


def separation(one, double one_u, double one_v, other, double other_u, double other_v):
    cdef Rectangle x = rectangle_of(one), y = rectangle_of(other)
    cdef double directions[5][2]
    cdef double du = other_u - one_u, dv = other_v - one_v, n_u, n_v, along, x_m, y_m, here
    cdef double away = sqrt(du * du + dv * dv), gap_m = -INFINITY
    cdef double best[5]
    cdef int k, n = 4
    directions[0][0], directions[0][1] = x.a_u, x.a_v
    directions[1][0], directions[1][1] = -x.a_v, x.a_u
    directions[2][0], directions[2][1] = y.a_u, y.a_v
    directions[3][0], directions[3][1] = -y.a_v, y.a_u
    if away > 0:
        directions[4][0], directions[4][1] = du / away, dv / away
        n = 5
    best[0], best[1], best[2], best[3], best[4] = 1, 0, -INFINITY, 0, 0
    for k in range(n):
        n_u, n_v = directions[k][0], directions[k][1]
        along = n_u * du + n_v * dv
        if along < 0:
            n_u, n_v, along = -n_u, -n_v, -along
        x_m, y_m = reach(&x, n_u, n_v), reach(&y, n_u, n_v)
        gap_m = along - x_m - y_m
        if gap_m > best[2]:
            here = n_u * one_u + n_v * one_v
            best[0], best[1], best[2], best[3], best[4] = n_u, n_v, gap_m, here + x_m, here + along - y_m
    return best[0], best[1], best[2], best[3], best[4]
