"""The compiled twin of the kernel in `walk`."""

from heapq import heapify, heappop, heappush

from libc.math cimport INFINITY

from scene2hap.propagation._entries cimport distance, is_entered

cdef double ROUNDED_UP = 1 + 1e-9


def walked(list starts, exits, dict price_per_m, double limit, ends=None):
    cdef double cost, price, price_beyond, before, further, x, y, z
    cdef Py_ssize_t n_pushed
    cdef list known, beyond
    cdef dict entries = {}, least = {}, at_most = {}, balls = {}
    cdef bint has_ends = ends is not None
    cdef double least_price = 0
    if has_ends:
        at_most, balls, least_price = ends
    arrivals, waiting = [], []
    for n_pushed, (start, door) in enumerate(starts):
        if start <= limit:
            waiting.append((start, n_pushed, door))
            least[door] = start
    n_pushed = len(starts)
    heapify(waiting)
    while waiting:
        arrived_cost, _, arrived = heappop(waiting)
        cost = arrived_cost
        if cost > <double>least[arrived]:
            continue
        here, place, out_of = arrived.into, arrived.place, arrived.out_of
        x, y, z = place
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
                told_before = least.get(door)
                before = INFINITY if told_before is None else told_before
                if before <= cost:
                    continue
                there = door.place
                further = cost + price * distance(there, x, y, z) + <double>door.crossing
                if further > limit or further >= before:
                    continue
                if beyond is not None and is_entered(beyond, price_beyond, there[0], there[1], there[2], further):
                    continue
                least[door] = further
                n_pushed += 1
                heappush(waiting, (further, n_pushed, door))
                if has_ends and other in at_most and further < <double>at_most[other]:
                    at_most[other] = further
    return arrivals


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
