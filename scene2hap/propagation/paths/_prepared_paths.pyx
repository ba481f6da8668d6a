"""The compiled twin of the kernel in `prepared_paths`."""

from cpython.mem cimport PyMem_Free, PyMem_Malloc
from libc.math cimport INFINITY, sqrt

cdef double WITHIN = 1e-12


def search(network, const Py_ssize_t[::1] out, double[::1] costs, Py_ssize_t[::1] hops):
    cdef const Py_ssize_t[::1] owner = network.owner, own_sides = network.own, first = network.first
    cdef const double[::1] prices = network.prices, crossing = network.crossing
    cdef const unsigned char[::1] leads_on = network.leads_on.view("uint8")
    cdef const double[:, ::1] points = network.points_m
    cdef Py_ssize_t n = owner.shape[0], k, side, own, across, here, n_hops
    cdef double within, onward, x, y, z
    cdef double* waiting = <double*>PyMem_Malloc((n + 1) * sizeof(double))
    if waiting == NULL:
        raise MemoryError
    for k in range(n):
        waiting[k] = INFINITY
    for k in range(out.shape[0]):
        across = out[k] ^ 1
        costs[across], hops[across] = crossing[across // 2], 1
        if leads_on[across]:
            waiting[across] = costs[across]
    while True:
        side = nearest(waiting, hops, n)
        if side < 0:
            break
        waiting[side] = INFINITY
        here, n_hops = owner[side], hops[side] + 1
        for k in range(first[here], first[here + 1]):
            own = own_sides[k]
            across = own ^ 1
            x = points[side // 2, 0] - points[own // 2, 0]
            y = points[side // 2, 1] - points[own // 2, 1]
            z = points[side // 2, 2] - points[own // 2, 2]
            within = costs[side] + prices[here] * sqrt(x * x + y * y + z * z)
            onward = within + crossing[own // 2]
            if not onward < costs[across] * (1.0 - WITHIN):
                if not (onward <= costs[across] * (1.0 + WITHIN) and n_hops < hops[across]):
                    continue
            if within < costs[own] * (1.0 - WITHIN):
                waiting[own] = INFINITY
            costs[across], hops[across] = onward, n_hops
            if leads_on[across] and not costs[own] - crossing[own // 2] <= onward:
                waiting[across] = onward
    PyMem_Free(waiting)


cdef Py_ssize_t nearest(const double* waiting, const Py_ssize_t[::1] hops, Py_ssize_t n) noexcept:
    """Return the waiting side of the least cost, of equal ones that with the fewest contacts; -1 if none waits."""
    cdef double least = INFINITY
    cdef Py_ssize_t k, best = -1
    for k in range(n):
        if waiting[k] < least:
            least = waiting[k]
    if least == INFINITY:
        return -1
    for k in range(n):
        if waiting[k] <= least * (1.0 + WITHIN) and (best < 0 or hops[k] < hops[best]):
            best = k
    return best
