"""The compiled twin of the kernel in `elimination`."""

import numpy as np

from cpython.mem cimport PyMem_Free, PyMem_Malloc
from libc.math cimport INFINITY
from libc.string cimport memset

# Four frequencies at a time: an entry holds their real parts and then their imaginary parts, one cache line.
cdef extern from *:
    """
    static void s2h_take(double* __restrict to, const double* __restrict a, const double* __restrict b) {
        int w;
        for (w = 0; w < 4; ++w) {
            to[w] -= a[w] * b[w] - a[w + 4] * b[w + 4];
            to[w + 4] -= a[w] * b[w + 4] + a[w + 4] * b[w];
        }
    }
    static void s2h_scale(double* __restrict to, const double* __restrict a) {
        int w;
        for (w = 0; w < 4; ++w) {
            double re = to[w] * a[w] - to[w + 4] * a[w + 4];
            to[w + 4] = to[w] * a[w + 4] + to[w + 4] * a[w];
            to[w] = re;
        }
    }
    """
    void s2h_take(double* to, const double* a, const double* b) noexcept nogil
    void s2h_scale(double* to, const double* a) noexcept nogil


cdef struct Part:
    const double* receptance
    const double* signs
    const int* at
    double* inverse
    int n


def factored(elements, diagonal, const double[:, ::1] free, pattern, double worst_growth, forces, inverses_at):
    cdef const int[::1] begins = pattern.begins, columns = pattern.columns, place = pattern.place
    cdef const int[:, ::1] entry = pattern.entry
    # Complex numbers as pairs of numbers, since not every C compiler supports complex ones.
    cdef const double[:, ::1] yielding = np.ascontiguousarray(diagonal).view(np.float64)
    cdef double[:, :, ::1] found = forces.view(np.float64)
    cdef const double[:, :, ::1] receptance
    cdef double[:, :, ::1] block
    cdef const double[::1] signs
    cdef const int[::1] at
    cdef int n = free.shape[0], n_f = forces.shape[2], n_sources = free.shape[1], n_parts = len(elements), k
    cdef int n_inverses = len(inverses_at)
    good = np.ones(n_f, dtype=np.uint8)
    if n == 0 or n_f == 0:
        return good.astype(bool)
    cdef unsigned char[::1] is_good = good
    cdef Part* parts = <Part*>PyMem_Malloc((n_parts + 1) * sizeof(Part))
    cdef double* matrix = <double*>PyMem_Malloc(8 * <size_t>columns.shape[0] * sizeof(double))
    cdef double* x = <double*>PyMem_Malloc(8 * <size_t>(n * n_sources + 1) * sizeof(double))
    cdef double* inverses = <double*>PyMem_Malloc(8 * <size_t>n * sizeof(double))
    cdef double* factors = <double*>PyMem_Malloc(8 * <size_t>n * sizeof(double))
    cdef list kept = []
    try:
        if parts == NULL or matrix == NULL or x == NULL or inverses == NULL or factors == NULL:
            raise MemoryError
        for k, element in enumerate(elements):
            receptance = np.ascontiguousarray(element.receptance, dtype=np.complex128).view(np.float64)
            signs = np.ascontiguousarray(element.signs, dtype=np.float64)
            at = pattern.place[element.rows]
            kept.append((receptance, signs, at))
            parts[k] = Part(&receptance[0, 0, 0], &signs[0], &at[0], NULL, at.shape[0])
        for k in inverses_at:
            block = inverses_at[k].view(np.float64)
            kept.append(block)
            parts[k].inverse = &block[0, 0, 0]
        with nogil:
            for k in range(0, n_f, 4):
                memset(matrix, 0, 8 * <size_t>columns.shape[0] * sizeof(double))
                assemble(matrix, parts, n_parts, &entry[0, 0], n, k, n_f)
                fill(matrix, x, yielding, free, place, begins, k, n_f)
                eliminate(matrix, x, inverses, factors, &begins[0], &columns[0], &entry[0, 0], n, n_sources)
                substitute(matrix, x, inverses, &begins[0], &columns[0], n, n_sources)
                read(matrix, x, found, place, begins, is_good, worst_growth * worst_growth, k, n_f)
                if n_inverses:
                    invert(matrix, inverses, factors, &begins[0], &columns[0], &entry[0, 0], n)
                    read_inverses(matrix, parts, n_parts, &entry[0, 0], n, k, n_f)
    finally:
        PyMem_Free(parts)
        PyMem_Free(matrix)
        PyMem_Free(x)
        PyMem_Free(inverses)
        PyMem_Free(factors)
    return good.astype(bool)


cdef void assemble(
    double* matrix, const Part* parts, int n_parts, const int* entry, int n, int first, int n_f
) noexcept nogil:
    """Add the receptances of all bodies at four frequencies. Beyond the last frequency, the last one is repeated."""
    cdef int e, i, j, w, low, high
    cdef Py_ssize_t f
    cdef double sign
    cdef double* to
    cdef const double* given
    cdef const Part* part
    for e in range(n_parts):
        part = &parts[e]
        for w in range(4):
            f = min(first + w, n_f - 1)
            for i in range(part.n):
                given = part.receptance + 2 * (f * part.n + i) * part.n
                for j in range(i, part.n):
                    low, high = part.at[i], part.at[j]
                    if low > high:
                        low, high = high, low
                    sign = part.signs[i] * part.signs[j]
                    to = matrix + 8 * <Py_ssize_t>entry[<Py_ssize_t>low * n + high]
                    to[w] += sign * given[2 * j]
                    to[w + 4] += sign * given[2 * j + 1]


cdef void fill(
    double* matrix, double* x, const double[:, ::1] diagonal, const double[:, ::1] free, const int[::1] place,
    const int[::1] begins, int first, int n_f
) noexcept nogil:
    """Add the diagonal to the matrix, and write the free deflections into x."""
    cdef int row, column, w, f
    cdef double* to
    for row in range(diagonal.shape[0]):
        for w in range(4):
            f = min(first + w, n_f - 1)
            to = matrix + 8 * <Py_ssize_t>begins[place[row]]
            to[w] += diagonal[row, 2 * f]
            to[w + 4] += diagonal[row, 2 * f + 1]
            for column in range(free.shape[1]):
                to = x + 8 * (<Py_ssize_t>place[row] * free.shape[1] + column)
                to[w], to[w + 4] = free[row, column], 0


cdef void eliminate(
    double* matrix, double* x, double* inverses, double* factors, const int* begins, const int* columns,
    const int* entry, int n, int n_sources
) noexcept nogil:
    """Factor A = L D L^T in place: rows of L^T beside the diagonal, 1 / D in `inverses`. Also compute x = L^-1 b."""
    cdef int i, p, q, m, w, column
    cdef double size
    cdef double* row
    cdef double* inverse
    cdef double* to
    cdef const int* across
    cdef const int* own
    for i in range(n):
        row, own, m = matrix + 8 * <Py_ssize_t>begins[i], columns + begins[i], begins[i + 1] - begins[i]
        inverse = inverses + 8 * <Py_ssize_t>i
        for w in range(4):
            size = row[w] * row[w] + row[w + 4] * row[w + 4]
            inverse[w], inverse[w + 4] = row[w] / size, -row[w + 4] / size
        for p in range(8, 8 * m):
            factors[p] = row[p]
        for p in range(1, m):
            s2h_scale(factors + 8 * p, inverse)
        for p in range(1, m):
            across = entry + <Py_ssize_t>own[p] * n
            for q in range(p, m):
                s2h_take(matrix + 8 * <Py_ssize_t>across[own[q]], factors + 8 * p, row + 8 * q)
            to = x + 8 * <Py_ssize_t>own[p] * n_sources
            for column in range(n_sources):
                s2h_take(to + 8 * column, factors + 8 * p, x + 8 * (<Py_ssize_t>i * n_sources + column))
        for p in range(8, 8 * m):
            row[p] = factors[p]


cdef void substitute(
    const double* matrix, double* x, const double* inverses, const int* begins, const int* columns, int n, int n_sources
) noexcept nogil:
    """Compute x = L^-T D^-1 x."""
    cdef int i, p, m, column
    cdef const double* row
    cdef const int* own
    cdef double* to
    for i in range(n - 1, -1, -1):
        row, own, m = matrix + 8 * <Py_ssize_t>begins[i], columns + begins[i], begins[i + 1] - begins[i]
        for column in range(n_sources):
            to = x + 8 * (<Py_ssize_t>i * n_sources + column)
            s2h_scale(to, inverses + 8 * <Py_ssize_t>i)
            for p in range(1, m):
                s2h_take(to, row + 8 * p, x + 8 * (<Py_ssize_t>own[p] * n_sources + column))


cdef void read(
    const double* matrix, const double* x, double[:, :, ::1] forces, const int[::1] place,
    const int[::1] begins, unsigned char[::1] is_good, double worst_square, int first, int n_f
) noexcept nogil:
    """Write the forces, and mark the frequencies at which a factor is too large or a number is not finite."""
    cdef int row, column, w, p, i, n_sources = forces.shape[1]
    cdef const double* at
    for w in range(min(4, n_f - first)):
        for i in range(place.shape[0]):
            for p in range(begins[i] + 1, begins[i + 1]):
                at = matrix + 8 * <Py_ssize_t>p
                if not at[w] * at[w] + at[w + 4] * at[w + 4] <= worst_square:
                    is_good[first + w] = False
        for row in range(place.shape[0]):
            for column in range(n_sources):
                at = x + 8 * (<Py_ssize_t>place[row] * n_sources + column)
                forces[row, column, 2 * (first + w)] = at[w]
                forces[row, column, 2 * (first + w) + 1] = at[w + 4]
                if not at[w] * at[w] + at[w + 4] * at[w + 4] < INFINITY:
                    is_good[first + w] = False


cdef void invert(
    double* matrix, const double* inverses, double* factors, const int* begins, const int* columns, const int* entry,
    int n
) noexcept nogil:
    """Compute A^-1 in place at the entries of L, the last row first, since each row needs only rows behind it."""
    cdef int i, p, q, m, w, low, high
    cdef double* row
    cdef const int* own
    for i in range(n - 1, -1, -1):
        row, own, m = matrix + 8 * <Py_ssize_t>begins[i], columns + begins[i], begins[i + 1] - begins[i]
        for p in range(8, 8 * m):
            factors[p], row[p] = row[p], 0
        for p in range(1, m):
            for q in range(1, m):
                low, high = own[min(p, q)], own[max(p, q)]
                s2h_take(row + 8 * p, factors + 8 * q, matrix + 8 * <Py_ssize_t>entry[<Py_ssize_t>low * n + high])
        for w in range(8):
            row[w] = inverses[8 * <Py_ssize_t>i + w]
        for q in range(1, m):
            s2h_take(row, factors + 8 * q, row + 8 * q)


cdef void read_inverses(
    const double* matrix, const Part* parts, int n_parts, const int* entry, int n, int first, int n_f
) noexcept nogil:
    """Write the entries of A^-1 among the joints of each body that has memory for them."""
    cdef int e, i, j, w, low, high
    cdef const Part* part
    cdef const double* at
    cdef double* to
    for e in range(n_parts):
        part = &parts[e]
        if part.inverse == NULL:
            continue
        for i in range(part.n):
            for j in range(part.n):
                low, high = part.at[i], part.at[j]
                if low > high:
                    low, high = high, low
                at = matrix + 8 * <Py_ssize_t>entry[<Py_ssize_t>low * n + high]
                for w in range(min(4, n_f - first)):
                    to = part.inverse + 2 * ((<Py_ssize_t>(first + w) * part.n + i) * part.n + j)
                    to[0], to[1] = at[w], at[w + 4]
