"""The compiled twins of the kernels in `level_plane`."""

from cpython.mem cimport PyMem_Free, PyMem_Malloc
from libc.math cimport INFINITY, sqrt


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


def clipped(outline, double du, double dv, edges, double slack_m):
    cdef Py_ssize_t k, m, n = len(outline)
    cdef Corner* ring = corners_of(outline, n, du, dv)
    cdef Corner* cut
    cdef Corner last
    cdef double nu, nv, offset, here, before, share
    cdef bint is_in, was_in
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
            is_in, was_in = here >= -slack_m, before >= -slack_m
            if is_in != was_in and (here < 0) != (before < 0):
                share = before / (before - here)
                cut[m].u = last.u + share * (ring[k].u - last.u)
                cut[m].v = last.v + share * (ring[k].v - last.v)
                m += 1
            if is_in:
                cut[m] = ring[k]
                m += 1
            last, before = ring[k], here
        PyMem_Free(ring)
        ring, n = cut, m
    found = [(ring[k].u, ring[k].v) for k in range(n)]
    PyMem_Free(ring)
    return found
