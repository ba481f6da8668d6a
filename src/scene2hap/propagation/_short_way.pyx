"""The compiled twins of the kernels in `short_way`."""

from libc.math cimport fmin

from scene2hap.propagation._entries cimport least_of, nearest_of


cdef class ShortWay:
    cdef readonly object via, out, into
    cdef readonly list entries
    cdef object crossing, first, second
    cdef bint is_through
    cdef double price_via_per_m, least

    def __init__(self, via, out, into, price_via_per_m, crossing):
        self.via, self.out, self.into = via, out, into
        self.is_through = price_via_per_m is not None
        self.price_via_per_m = price_via_per_m if self.is_through else 0.0
        self.crossing, self.entries = crossing, []

    def least_cost(self, double price_per_m, tuple point_m, double limit, double known):
        first = self.out[self.via]
        second = self.into[self.via] if self.is_through else None
        if self.first is not first or self.second is not second:
            if second is not None and price_per_m * nearest_of(second[0], point_m) > limit:
                return known
            self.tell(first, second)
        if self.least >= known or self.least > limit:
            return known
        return fmin(known, least_of(self.entries, price_per_m, point_m))

    cdef tell(self, first, second):
        cdef double cost
        cdef list entries = [(place, self.crossing[weight]) for place, weight in zip(first[0], first[1])]
        if second is not None:
            before, entries = entries, []
            for there, weight in zip(second[0], second[1]):
                cost = self.crossing[weight]
                entries.append((there, cost + least_of(before, self.price_via_per_m, there)))
        self.first, self.second, self.entries = first, second, entries
        self.least = min([entry[1] for entry in entries])


def ways_between(dict out, dict into, object_id, price_per_m, crossing, list known, *, bint is_through):
    cdef dict fewer = into, more = out
    found = []
    if object_id in out:
        found.append(way_by(object_id, out, into, None, crossing, known))
    if is_through:
        if len(out) <= len(into):
            fewer, more = out, into
        for via in fewer:
            if via in more and via in price_per_m:
                found.append(way_by(via, out, into, price_per_m[via], crossing, known))
    return found


cdef way_by(via, out, into, price_via_per_m, crossing, list known):
    for way in known:
        if (<ShortWay?>way).via == via:
            return way
    return ShortWay(via, out, into, price_via_per_m, crossing)
