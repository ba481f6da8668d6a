"""The compiled twin of the kernel in `short_way`."""

from libc.math cimport INFINITY, fmin

from scene2hap.propagation._entries cimport least_of, nearest_of


cdef class ShortWay:
    cdef object via
    cdef dict out, into
    cdef object crossing, first, second
    cdef list entries
    cdef bint is_through
    cdef double price_via_per_m, least

    cdef double least_cost(self, double price_per_m, tuple point_m, double limit, double known) except -1:
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
        self.least = INFINITY
        for entry in entries:
            self.least = fmin(self.least, entry[1])


cdef class WaysInto:
    cdef object object_id, crossing
    cdef dict rows, beside, price_per_m
    cdef list by_row
    cdef bint is_through

    def __init__(self, object_id, dict rows, dict beside, dict price_per_m, crossing, *, bint is_through):
        self.object_id, self.rows, self.beside, self.is_through = object_id, rows, beside, is_through
        self.price_per_m, self.crossing = price_per_m, crossing
        self.by_row = [[] for _ in rows]
        self.follow(None)

    def follow(self, turned):
        cdef set stale = set()
        cdef dict beside
        if turned is None:
            stale.update(self.rows)
        else:
            for a, b in turned:
                if a in self.rows:
                    stale.add(a)
                if b in self.rows:
                    stale.add(b)
                if self.object_id == a or self.object_id == b:
                    via = b if self.object_id == a else a
                    for x in self.rows:
                        beside = self.beside.get(x)
                        if beside is not None and via in beside:
                            stale.add(x)
        for x in stale:
            if x != self.object_id:
                self.by_row[<Py_ssize_t>self.rows[x]] = self.found_from(x)

    cdef list found_from(self, source_id):
        cdef dict out = self.beside.get(source_id), into = self.beside.get(self.object_id)
        cdef dict fewer = into, more = out
        cdef list known = self.by_row[<Py_ssize_t>self.rows[source_id]], found = []
        if out is None or into is None:
            return found
        if self.object_id in out:
            found.append(self.way_by(self.object_id, out, into, None, known))
        if self.is_through:
            if len(out) <= len(into):
                fewer, more = out, into
            for via in fewer:
                if via in more and via in self.price_per_m:
                    found.append(self.way_by(via, out, into, self.price_per_m[via], known))
        return found

    cdef ShortWay way_by(self, via, dict out, dict into, price_via_per_m, list known):
        cdef ShortWay way
        for way in known:
            if way.via == via:
                return way
        way = ShortWay.__new__(ShortWay)
        way.via, way.out, way.into, way.crossing = via, out, into, self.crossing
        way.is_through = price_via_per_m is not None
        way.price_via_per_m = price_via_per_m if way.is_through else 0.0
        return way

    def lower(self, list found, tuple point_m, limits):
        cdef double price = self.price_per_m[self.object_id], limit = INFINITY
        cdef ShortWay way
        cdef list ways
        cdef Py_ssize_t row
        for row in range(len(self.by_row)):
            ways = self.by_row[row]
            if ways:
                if limits is not None:
                    limit = limits[row]
                for way in ways:
                    found[row] = way.least_cost(price, point_m, limit, found[row])
