"""The compiled twins of the kernels in `prepared_paths`."""

import numpy as np

from libc.math cimport INFINITY, sqrt

cdef double WITHIN = 1e-12
cdef enum:
    AT_ONCE = 8


def search(network, const Py_ssize_t[::1] out, double[::1] costs, Py_ssize_t[::1] hops, Py_ssize_t[::1] before):
    cdef const Py_ssize_t[::1] owner = network.owner, own_sides = network.own, first = network.first
    cdef const double[::1] cost_per_m = network.cost_per_m, crossing = network.crossing
    cdef const unsigned char[::1] leads_on = network.leads_on.view("uint8")
    cdef const double[:, ::1] points = network.points_m
    cdef Py_ssize_t k, side, own, across, here, n_hops
    cdef double within, onward, x, y, z
    cdef Waiting waiting = Waiting(owner.shape[0])
    for k in range(out.shape[0]):
        across = out[k] ^ 1
        costs[across], hops[across] = crossing[across // 2], 1
        if leads_on[across]:
            waiting.put(across, costs[across])
    while True:
        side = waiting.nearest(hops)
        if side < 0:
            break
        waiting.costs[side] = INFINITY
        here, n_hops = owner[side], hops[side] + 1
        for k in range(first[here], first[here + 1]):
            own = own_sides[k]
            across = own ^ 1
            x = points[side // 2, 0] - points[own // 2, 0]
            y = points[side // 2, 1] - points[own // 2, 1]
            z = points[side // 2, 2] - points[own // 2, 2]
            within = costs[side] + cost_per_m[here] * sqrt(x * x + y * y + z * z)
            onward = within + crossing[own // 2]
            if not onward < costs[across] * (1.0 - WITHIN):
                if not (onward <= costs[across] * (1.0 + WITHIN) and n_hops < hops[across]):
                    continue
            if within < costs[own] * (1.0 - WITHIN):
                waiting.costs[own] = INFINITY
            costs[across], hops[across], before[across] = onward, n_hops, side
            if leads_on[across] and not costs[own] - crossing[own // 2] <= onward:
                waiting.put(across, onward)


cdef class Waiting:
    """The sides that a search goes on from: their costs, infinite for all others, and a list that has all of them."""
    cdef double[::1] costs
    cdef unsigned char[::1] is_listed
    cdef Py_ssize_t[::1] listed
    cdef Py_ssize_t n_listed

    def __init__(self, Py_ssize_t n_sides):
        self.costs = np.full(n_sides, np.inf)
        self.is_listed, self.listed = np.zeros(n_sides, np.uint8), np.empty(n_sides, np.intp)

    cdef void put(self, Py_ssize_t side, double cost) noexcept:
        self.costs[side] = cost
        if not self.is_listed[side]:
            self.is_listed[side] = True
            self.listed[self.n_listed] = side
            self.n_listed += 1

    cdef Py_ssize_t nearest(self, Py_ssize_t[::1] hops) noexcept:
        """Return the side of the least cost, of equal ones that with the fewest contacts; -1 if none waits."""
        cdef double least = INFINITY, most
        cdef Py_ssize_t i = 0, side, best = -1
        while i < self.n_listed:
            side = self.listed[i]
            if self.costs[side] == INFINITY:
                self.is_listed[side] = False
                self.n_listed -= 1
                self.listed[i] = self.listed[self.n_listed]
                continue
            if self.costs[side] < least:
                least = self.costs[side]
            i += 1
        most = least * (1.0 + WITHIN)
        for i in range(self.n_listed):
            side = self.listed[i]
            if self.costs[side] <= most:
                if best < 0 or hops[side] < hops[best] or (hops[side] == hops[best] and side < best):
                    best = side
        return best


def nearest_entries(
    const double[:, :] points,
    const double[:, :] entries,
    double cost_per_m,
    costs,
    const Py_ssize_t[:, ::1] hops,
    Py_ssize_t[:, ::1] found,
    double[:, ::1] least,
):
    # By rising cost, so that a search ends at the first entry that costs more than a whole path.
    by_cost = np.argsort(costs, axis=1)
    cdef const Py_ssize_t[:, ::1] order = by_cost
    cdef const double[:, ::1] rising = np.take_along_axis(costs, by_cost, axis=1)
    cdef double[:, ::1] within = np.empty((AT_ONCE, entries.shape[0]))
    cdef Py_ssize_t first, i, k, row, n_points = points.shape[0]
    cdef double x, y, z
    # Some points at once for each source, whose costs then stay in the processor's cache.
    for first in range(0, n_points, AT_ONCE):
        for i in range(first, min(first + AT_ONCE, n_points)):
            for k in range(entries.shape[0]):
                x, y, z = points[i, 0] - entries[k, 0], points[i, 1] - entries[k, 1], points[i, 2] - entries[k, 2]
                within[i - first, k] = cost_per_m * sqrt(x * x + y * y + z * z)
        for row in range(found.shape[0]):
            for i in range(first, min(first + AT_ONCE, n_points)):
                found[row, i] = cheapest(within[i - first], rising[row], order[row], hops[row], &least[row, i])


cdef Py_ssize_t cheapest(
    const double[::1] within,
    const double[::1] rising,
    const Py_ssize_t[::1] order,
    const Py_ssize_t[::1] hops,
    double* cost,
) noexcept:
    """Return the entry on the cheapest path, of equal ones that with the fewest contacts; -1 without a path."""
    cdef double least = INFINITY, total
    cdef Py_ssize_t k, entry, best = -1
    for k in range(rising.shape[0]):
        if rising[k] == INFINITY or rising[k] > least * (1.0 + WITHIN):
            break
        entry = order[k]
        total = rising[k] + within[entry]
        if total < least * (1.0 - WITHIN):
            least, best = total, entry
        elif best >= 0 and total <= least * (1.0 + WITHIN):
            least = min(least, total)
            if hops[entry] < hops[best] or (hops[entry] == hops[best] and entry < best):
                best = entry
    cost[0] = least
    return best
