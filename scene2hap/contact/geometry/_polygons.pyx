"""The compiled twins of the kernels in `polygons`."""

from cpython.mem cimport PyMem_Free, PyMem_Malloc
from libc.math cimport INFINITY, sqrt

cdef enum:
    MOST = 8

cdef double ROUNDING_M = 1e-9  # as in `polygons`


cdef struct Ring:
    int n
    double u[MOST]
    double v[MOST]


cdef struct Segment:
    # From a point p of the first outline to a point q of the second.
    double pu, pv, qu, qv, length


cdef struct Corner:
    double u, v


cdef Corner* corners_of(outline, Py_ssize_t capacity, double du, double dv) except NULL:
    """Return the corners of an outline, moved by (du, dv), in memory for `capacity` of them; the caller frees it."""
    cdef Corner* found = <Corner*>PyMem_Malloc((capacity + 1) * sizeof(Corner))
    cdef Py_ssize_t k = 0
    cdef double u, v
    if found is NULL:
        raise MemoryError
    for u, v in outline:
        found[k].u, found[k].v = u + du, v + dv
        k += 1
    return found


def turned_outline(corners_m, row_u, row_v):
    cdef double a, b, c, d, e, f, x, y, z
    a, b, c = row_u
    d, e, f = row_v
    found = []
    for x, y, z in corners_m:
        found.append((a * x + b * y + c * z, d * x + e * y + f * z))
    return tuple(found)


def edges_of(outline):
    cdef Py_ssize_t k, n = len(outline)
    cdef Corner* corners = corners_of(outline, n, 0.0, 0.0)
    cdef Corner here, after
    cdef double nu, nv, offset, length, mu = 0.0, mv = 0.0
    edges = []
    for k in range(n):
        mu, mv = mu + corners[k].u, mv + corners[k].v
    mu, mv = mu / n, mv / n
    for k in range(n):
        here, after = corners[k], corners[k + 1 if k + 1 < n else 0]
        nu, nv = here.v - after.v, after.u - here.u
        length = sqrt(nu * nu + nv * nv)
        if length == 0:
            continue
        nu, nv = nu / length, nv / length
        offset = nu * here.u + nv * here.v
        if nu * mu + nv * mv < offset:
            nu, nv, offset = -nu, -nv, -offset
        edges.append((nu, nv, offset))
    PyMem_Free(corners)
    return tuple(edges)


def inside_edges(outline, double du, double dv, edges):
    cdef Py_ssize_t k, n = len(outline)
    cdef Corner* corners = corners_of(outline, n, du, dv)
    cdef double nu, nv, offset, inside, most, outermost = INFINITY, innermost = INFINITY
    for nu, nv, offset in edges:
        most = -INFINITY
        for k in range(n):
            inside = nu * corners[k].u + nv * corners[k].v - offset
            outermost = inside if inside < outermost else outermost
            most = inside if inside > most else most
        innermost = most if most < innermost else innermost
    PyMem_Free(corners)
    return outermost, innermost


def clipped(outline, double du, double dv, edges):
    cdef Py_ssize_t k, m, n = len(outline)
    cdef Corner* ring = corners_of(outline, n, du, dv)
    cdef Corner* cut
    cdef Corner last
    cdef double nu, nv, offset, here, before, share
    for nu, nv, offset in edges:
        # Each corner yields at most two: itself, and an intersection before it.
        cut, m = <Corner*>PyMem_Malloc((2 * n + 1) * sizeof(Corner)), 0
        if cut is NULL:
            PyMem_Free(ring)
            raise MemoryError
        if n:
            last = ring[n - 1]
            before = nu * last.u + nv * last.v - offset
        for k in range(n):
            here = nu * ring[k].u + nv * ring[k].v - offset
            if (here < 0) != (before < 0):
                share = before / (before - here)
                cut[m].u = last.u + share * (ring[k].u - last.u)
                cut[m].v = last.v + share * (ring[k].v - last.v)
                m += 1
            if here >= 0:
                cut[m] = ring[k]
                m += 1
            last, before = ring[k], here
        PyMem_Free(ring)
        ring, n = cut, m
    found = [(ring[k].u, ring[k].v) for k in range(n)]
    PyMem_Free(ring)
    return found


def polygon_gap(x, y, double rise_m, double within_m, double slack_m):
    cdef Ring one = ring_of(x), other = ring_of(y)
    cdef Segment segments[2 * MOST * MOST]
    cdef Segment best
    cdef int k, n = 0
    cdef double distance
    cdef double strip = widest(&one, &other, -INFINITY, within_m)
    if strip <= within_m:
        strip = widest(&other, &one, strip, within_m)
    if strip < -ROUNDING_M:
        return None
    # The first segment always replaces these values. They only avoid warnings of compilers.
    best.length, best.pu, best.pv, best.qu, best.qv = INFINITY, 0.0, 0.0, 0.0, 0.0
    if strip <= within_m:
        n = nearest(&one, &other, segments, False)
        n += nearest(&other, &one, segments + n, True)
        for k in range(n):
            if comes_before(&segments[k], &best):
                best = segments[k]
    distance = sqrt(best.length * best.length + rise_m * rise_m)
    if distance > within_m:
        return INFINITY, (0.0, 0.0), []
    middles = []
    for k in range(n):
        if sqrt(segments[k].length * segments[k].length + rise_m * rise_m) <= distance + slack_m:
            middles.append(((segments[k].pu + segments[k].qu) / 2, (segments[k].pv + segments[k].qv) / 2))
    return distance, (best.qu - best.pu, best.qv - best.pv), middles


cdef Ring ring_of(corners) except *:
    cdef Ring ring
    ring.n = len(corners)
    if ring.n > MOST:
        raise ValueError(f"an outline of {ring.n} corners; at most {MOST} are compared.")
    for k, (u, v) in enumerate(corners):
        ring.u[k], ring.v[k] = u, v
    return ring


cdef bint comes_before(const Segment* one, const Segment* best) noexcept:
    """Return True if `one` is shorter than `best`; ties are decided by the coordinates of the ends."""
    if one.length != best.length:
        return one.length < best.length
    if one.pu != best.pu:
        return one.pu < best.pu
    if one.pv != best.pv:
        return one.pv < best.pv
    if one.qu != best.qu:
        return one.qu < best.qu
    return one.qv < best.qv


cdef int nearest(const Ring* corners, const Ring* ring, Segment* segments, bint is_back) noexcept:
    """Compute, for each corner and each edge of the ring, the segment to the edge's nearest point. Returns the number
    of segments, which are reversed if `is_back`."""
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
                segments[n].pu, segments[n].pv, segments[n].qu, segments[n].qv = a, b, u, v
            else:
                segments[n].pu, segments[n].pv, segments[n].qu, segments[n].qv = u, v, a, b
            a, b = segments[n].qu - segments[n].pu, segments[n].qv - segments[n].pv
            segments[n].length = sqrt(a * a + b * b)
            n += 1
    return n


cdef double widest(const Ring* ring, const Ring* other, double known, double enough) noexcept:
    """Return the largest gap along the normals of a ring's edges, at least `known`, or the first above `enough`."""
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
