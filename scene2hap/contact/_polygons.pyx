"""The compiled twin of the kernel in `polygons`."""

from libc.math cimport INFINITY, sqrt

cdef enum:
    MOST = 8

cdef double ROUNDING_M = 1e-9  # as in `polygons`


cdef struct Ring:
    int n
    double u[MOST]
    double v[MOST]


cdef struct Way:
    # From a point of the first outline to one of the second.
    double pu, pv, qu, qv, length


def polygon_gap(x, y, double rise_m, double within_m, double slack_m):
    cdef Ring one = ring_of(x), other = ring_of(y)
    cdef Way ways[2 * MOST * MOST]
    cdef Way best
    cdef int k, n = 0
    cdef double distance
    cdef double strip = widest(&one, &other, -INFINITY, within_m)
    if strip <= within_m:
        strip = widest(&other, &one, strip, within_m)
    if strip < -ROUNDING_M:
        return None
    # Read only once another has come before it; compilers cannot know.
    best.length, best.pu, best.pv, best.qu, best.qv = INFINITY, 0.0, 0.0, 0.0, 0.0
    if strip <= within_m:
        n = nearest(&one, &other, ways, False)
        n += nearest(&other, &one, ways + n, True)
        for k in range(n):
            if comes_before(&ways[k], &best):
                best = ways[k]
    distance = sqrt(best.length * best.length + rise_m * rise_m)
    if distance > within_m:
        return INFINITY, (0.0, 0.0), []
    middles = []
    for k in range(n):
        if sqrt(ways[k].length * ways[k].length + rise_m * rise_m) <= distance + slack_m:
            middles.append(((ways[k].pu + ways[k].qu) / 2, (ways[k].pv + ways[k].qv) / 2))
    return distance, (best.qu - best.pu, best.qv - best.pv), middles


cdef Ring ring_of(corners) except *:
    cdef Ring ring
    ring.n = len(corners)
    if ring.n > MOST:
        raise ValueError(f"an outline of {ring.n} corners; at most {MOST} are compared.")
    for k, (u, v) in enumerate(corners):
        ring.u[k], ring.v[k] = u, v
    return ring


cdef bint comes_before(const Way* way, const Way* best) noexcept:
    """The shorter of two; of equal ones the lesser by its ends."""
    if way.length != best.length:
        return way.length < best.length
    if way.pu != best.pu:
        return way.pu < best.pu
    if way.pv != best.pv:
        return way.pv < best.pv
    if way.qu != best.qu:
        return way.qu < best.qu
    return way.qv < best.qv


cdef int nearest(const Ring* corners, const Ring* ring, Way* ways, bint is_back) noexcept:
    """For each corner and each edge of the ring, the way to the edge's point nearest to it, or back."""
    cdef int i, k, after, n = 0
    cdef double u, v, eu, ev, t, a, b
    for i in range(corners.n):
        u, v = corners.u[i], corners.v[i]
        for k in range(ring.n):
            after = k + 1 if k + 1 < ring.n else 0
            eu, ev = ring.u[after] - ring.u[k], ring.v[after] - ring.v[k]
            t = ((u - ring.u[k]) * eu + (v - ring.v[k]) * ev) / (eu * eu + ev * ev)
            t = 0.0 if t < 0 else 1.0 if t > 1 else t
            a, b = ring.u[k] + t * eu, ring.v[k] + t * ev
            if is_back:
                ways[n].pu, ways[n].pv, ways[n].qu, ways[n].qv = a, b, u, v
            else:
                ways[n].pu, ways[n].pv, ways[n].qu, ways[n].qv = u, v, a, b
            a, b = ways[n].qu - ways[n].pu, ways[n].qv - ways[n].pv
            ways[n].length = sqrt(a * a + b * b)
            n += 1
    return n


cdef double widest(const Ring* ring, const Ring* other, double known, double enough) noexcept:
    """The widest strip along an edge of a ring that the other is beyond, or the first that is more than enough."""
    cdef int k, i, after
    cdef double mu = 0, mv = 0, nu, nv, offset, length, inside
    for k in range(ring.n):
        mu += ring.u[k]
        mv += ring.v[k]
    mu, mv = mu / ring.n, mv / ring.n
    for k in range(ring.n):
        after = k + 1 if k + 1 < ring.n else 0
        nu, nv = ring.v[k] - ring.v[after], ring.u[after] - ring.u[k]
        length = sqrt(nu * nu + nv * nv)
        if length == 0:
            continue
        nu, nv = nu / length, nv / length
        offset = nu * ring.u[k] + nv * ring.v[k]
        if nu * mu + nv * mv < offset:
            nu, nv, offset = -nu, -nv, -offset
        inside = -INFINITY
        for i in range(other.n):
            inside = max(inside, nu * other.u[i] + nv * other.v[i] - offset)
        known = max(known, -inside)
        if known > enough:
            return known
    return known
