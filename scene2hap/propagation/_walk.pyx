"""The compiled twins of the kernels in `walk`."""

from heapq import heapify, heappop, heappush

from libc.math cimport INFINITY, sqrt

from scene2hap.propagation._entries cimport distance, is_entered

cdef double ROUNDED_UP = 1 + 1e-9
cdef long long n_walks = 0


cdef class Door:
    cdef readonly object out_of, into, place
    cdef readonly double crossing
    cdef double x, y, z
    # What the cheapest way to it costs in the walk of that number.
    cdef double least
    cdef long long walk

    def __init__(self, out_of, into, tuple place, double crossing):
        self.out_of, self.into, self.place, self.crossing = out_of, into, place, crossing
        self.x, self.y, self.z = place
        self.walk = 0


def walked(list starts, exits, dict price_per_m, double limit, ends=None):
    global n_walks
    cdef double cost, price_beyond, further, x, y, z
    cdef double price = 0
    cdef Py_ssize_t n_pushed
    cdef long long walk
    cdef list known, beyond
    cdef dict entries = {}, at_most = {}, balls = {}
    cdef bint has_ends = ends is not None
    cdef double least_price = 0
    cdef Door arrived, door
    n_walks += 1
    walk = n_walks
    if has_ends:
        at_most, balls, least_price = ends
    arrivals, waiting = [], []
    for n_pushed, (start, door) in enumerate(starts):
        if start <= limit:
            waiting.append((start, n_pushed, door))
            door.walk, door.least = walk, start
    n_pushed = len(starts)
    heapify(waiting)
    while waiting:
        arrived_cost, _, arrived = heappop(waiting)
        cost = arrived_cost
        if cost > arrived.least:
            continue
        here, place, out_of = arrived.into, arrived.place, arrived.out_of
        x, y, z = arrived.x, arrived.y, arrived.z
        told = price_per_m.get(here)
        known = entries.get(here)
        if known is None:
            known = entries[here] = []
        if told is not None:
            price = told
            if is_entered(known, price, x, y, z, cost):
                continue
        arrivals.append((arrived_cost, here, place))
        if has_ends:
            balls.pop(here, None)
            if at_most.pop(here, None) is not None and not at_most:
                break
        if told is None or (has_ends and not may_lead_to(at_most, balls, least_price, x, y, z, cost)):
            continue
        known.append((place, arrived_cost))
        for other, told_beyond, doors in exits(here):
            price_beyond = told_beyond
            if price >= price_beyond and other == out_of:
                continue
            beyond = entries.get(other)
            for door in doors:
                if door.walk != walk:
                    door.walk, door.least = walk, INFINITY
                elif door.least <= cost:
                    continue
                further = cost + price * apart(door, x, y, z) + door.crossing
                if further > limit or further >= door.least:
                    continue
                if beyond is not None and is_entered(beyond, price_beyond, door.x, door.y, door.z, further):
                    continue
                door.least = further
                n_pushed += 1
                heappush(waiting, (further, n_pushed, door))
                if has_ends and other in at_most and further < <double>at_most[other]:
                    at_most[other] = further
    return arrivals


cdef double apart(Door door, double x, double y, double z) noexcept:
    cdef double a = door.x - x, b = door.y - y, c = door.z - z
    return sqrt(a * a + b * b + c * c)


cdef bint may_lead_to(
    dict at_most, dict balls, double least_price, double x, double y, double z, double cost
) except -1:
    """Whether a way on from a place may lead to any of the ends in time."""
    cdef double radius
    for end, ball in balls.items():
        middle, radius = ball
        if cost + least_price * (distance(middle, x, y, z) - radius) <= <double>at_most[end] * ROUNDED_UP:
            return True
    return False
