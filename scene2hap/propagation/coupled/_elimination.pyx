"""The compiled twin of the kernel in `elimination`."""

import numpy as np

from cpython.mem cimport PyMem_Free, PyMem_Malloc
from libc.math cimport INFINITY
from libc.string cimport memcpy, memset

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
    static void s2h_take_sum(double* __restrict to, const double* __restrict a, const double* __restrict b, int n) {
        double r0 = to[0], r1 = to[1], r2 = to[2], r3 = to[3], i0 = to[4], i1 = to[5], i2 = to[6], i3 = to[7];
        int k;
        for (k = 0; k < n; ++k, a += 8, b += 8) {
            r0 -= a[0] * b[0] - a[4] * b[4];
            r1 -= a[1] * b[1] - a[5] * b[5];
            r2 -= a[2] * b[2] - a[6] * b[6];
            r3 -= a[3] * b[3] - a[7] * b[7];
            i0 -= a[0] * b[4] + a[4] * b[0];
            i1 -= a[1] * b[5] + a[5] * b[1];
            i2 -= a[2] * b[6] + a[6] * b[2];
            i3 -= a[3] * b[7] + a[7] * b[3];
        }
        to[0] = r0, to[1] = r1, to[2] = r2, to[3] = r3, to[4] = i0, to[5] = i1, to[6] = i2, to[7] = i3;
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
    void s2h_take_sum(double* to, const double* a, const double* b, int n) noexcept nogil
    void s2h_scale(double* to, const double* a) noexcept nogil


cdef struct Part:
    const double* receptance
    Py_ssize_t by_frequency, by_row, by_column  # strides in numbers
    const double* signs
    const int* at
    double* inverse
    int n


def factored(elements, diagonal, const double[:, ::1] free, pattern, double worst_growth, forces, inverses_at):
    cdef const int[::1] begins = pattern.begins, columns = pattern.columns, place = pattern.place
    cdef const int[::1] blocks = pattern.blocks
    cdef const int[:, ::1] entry = pattern.entry
    # Complex numbers as pairs of numbers, since not every C compiler supports complex ones.
    cdef const double[:, ::1] yielding = np.ascontiguousarray(diagonal).view(np.float64)
    cdef double[:, :, ::1] found = forces.view(np.float64)
    cdef const double[:, :, :] receptance
    cdef double[:, :, ::1] block
    cdef const double[::1] signs
    cdef const int[::1] at
    cdef int n = free.shape[0], n_f = forces.shape[2], n_sources = free.shape[1], n_parts = len(elements), k
    cdef int n_inverses = len(inverses_at), n_blocks = blocks.shape[0] - 1, n_scratch = n, width
    for k in range(n_blocks):
        width = begins[blocks[k] + 1] - begins[blocks[k]]
        n_scratch = max(n_scratch, (blocks[k + 1] - blocks[k]) * (2 * width + n_sources))
    good = np.ones(n_f, dtype=np.uint8)
    if n == 0 or n_f == 0:
        return good.astype(bool)
    cdef unsigned char[::1] is_good = good
    cdef Part* parts = <Part*>PyMem_Malloc((n_parts + 1) * sizeof(Part))
    cdef double* matrix = <double*>PyMem_Malloc(8 * <size_t>columns.shape[0] * sizeof(double))
    cdef double* x = <double*>PyMem_Malloc(8 * <size_t>(n * n_sources + 1) * sizeof(double))
    cdef double* inverses = <double*>PyMem_Malloc(8 * <size_t>n * sizeof(double))
    cdef double* scratch = <double*>PyMem_Malloc(8 * <size_t>n_scratch * sizeof(double))
    cdef list kept = []
    try:
        if parts == NULL or matrix == NULL or x == NULL or inverses == NULL or scratch == NULL:
            raise MemoryError
        for k, element in enumerate(elements):
            # The real parts, from which the imaginary parts are the next numbers.
            receptance = np.asarray(element.receptance, dtype=np.complex128).real
            signs = np.ascontiguousarray(element.signs, dtype=np.float64)
            at = pattern.place[element.rows]
            kept.append((receptance, signs, at))
            parts[k] = Part(
                &receptance[0, 0, 0], receptance.strides[0] // 8, receptance.strides[1] // 8,
                receptance.strides[2] // 8, &signs[0], &at[0], NULL, at.shape[0],
            )
        for k in inverses_at:
            block = inverses_at[k].view(np.float64)
            kept.append(block)
            parts[k].inverse = &block[0, 0, 0]
        with nogil:
            for k in range(0, n_f, 4):
                memset(matrix, 0, 8 * <size_t>columns.shape[0] * sizeof(double))
                assemble(matrix, parts, n_parts, &entry[0, 0], n, k, n_f)
                fill(matrix, x, yielding, free, place, begins, k, n_f)
                eliminate(
                    matrix, x, inverses, scratch, &begins[0], &columns[0], &entry[0, 0], &blocks[0], n_blocks, n,
                    n_sources,
                )
                substitute(
                    matrix, x, inverses, scratch, &begins[0], &columns[0], &blocks[0], n_blocks, n_sources
                )
                read(matrix, x, found, place, begins, is_good, worst_growth * worst_growth, k, n_f)
                if n_inverses:
                    invert(matrix, inverses, scratch, &begins[0], &columns[0], &entry[0, 0], n)
                    read_inverses(matrix, parts, n_parts, &entry[0, 0], n, k, n_f)
    finally:
        PyMem_Free(parts)
        PyMem_Free(matrix)
        PyMem_Free(x)
        PyMem_Free(inverses)
        PyMem_Free(scratch)
    return good.astype(bool)


cdef void assemble(
    double* matrix, const Part* parts, int n_parts, const int* entry, int n, int first, int n_f
) noexcept nogil:
    """Add the receptances of all bodies at four frequencies. Beyond the last frequency, the last one is repeated."""
    cdef int e, i, j, w, low, high
    cdef Py_ssize_t f[4]
    cdef double sign
    cdef double* to
    cdef const double* given
    cdef const Part* part
    for w in range(4):
        f[w] = min(first + w, n_f - 1)
    for e in range(n_parts):
        part = &parts[e]
        for i in range(part.n):
            for j in range(i, part.n):
                low, high = part.at[i], part.at[j]
                if low > high:
                    low, high = high, low
                sign = part.signs[i] * part.signs[j]
                to = matrix + 8 * <Py_ssize_t>entry[<Py_ssize_t>low * n + high]
                for w in range(4):
                    given = part.receptance + f[w] * part.by_frequency + i * part.by_row + j * part.by_column
                    to[w] += sign * given[0]
                    to[w + 4] += sign * given[1]


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
    double* matrix, double* x, double* inverses, double* scratch, const int* begins, const int* columns,
    const int* entry, const int* blocks, int n_blocks, int n, int n_sources
) noexcept nogil:
    """Factor A = L D L^T in place: rows of L^T beside the diagonal, 1 / D in `inverses`. Also compute x = L^-1 b.

    The rows behind a block subtract all of its rows at once, so that each entry is read and written once for a block
    and not once for each row.
    """
    cdef int k, i, j, p, q, m, n_own, w, column
    cdef double size
    cdef double* row
    cdef double* inverse
    cdef double* to
    cdef double* lower = scratch  # (m, n_own) the block's columns of L
    cdef double* upper  # (m, n_own) those of L D
    cdef double* solved  # (n_sources, n_own) of x
    cdef const int* across
    cdef const int* own
    for k in range(n_blocks):
        i = blocks[k]
        n_own, own, m = blocks[k + 1] - i, columns + begins[i], begins[i + 1] - begins[i]
        upper = lower + 8 * <Py_ssize_t>m * n_own
        solved = upper + 8 * <Py_ssize_t>m * n_own
        for j in range(n_own):
            i = blocks[k] + j
            row, inverse = matrix + 8 * <Py_ssize_t>begins[i], inverses + 8 * <Py_ssize_t>i
            for p in range(j, m):
                s2h_take_sum(row + 8 * (p - j), lower + 8 * <Py_ssize_t>j * n_own, upper + 8 * <Py_ssize_t>p * n_own, j)
            for w in range(4):
                size = row[w] * row[w] + row[w + 4] * row[w + 4]
                inverse[w], inverse[w + 4] = row[w] / size, -row[w + 4] / size
            for p in range(j + 1, m):
                memcpy(upper + 8 * (<Py_ssize_t>p * n_own + j), row + 8 * (p - j), 8 * sizeof(double))
                s2h_scale(row + 8 * (p - j), inverse)
                memcpy(lower + 8 * (<Py_ssize_t>p * n_own + j), row + 8 * (p - j), 8 * sizeof(double))
            for column in range(n_sources):
                to = x + 8 * (<Py_ssize_t>i * n_sources + column)
                s2h_take_sum(to, lower + 8 * <Py_ssize_t>j * n_own, solved + 8 * <Py_ssize_t>column * n_own, j)
                memcpy(solved + 8 * (<Py_ssize_t>column * n_own + j), to, 8 * sizeof(double))
        for p in range(n_own, m):
            across = entry + <Py_ssize_t>own[p] * n
            for q in range(p, m):
                to = matrix + 8 * <Py_ssize_t>across[own[q]]
                s2h_take_sum(to, lower + 8 * <Py_ssize_t>p * n_own, upper + 8 * <Py_ssize_t>q * n_own, n_own)
            for column in range(n_sources):
                to = x + 8 * (<Py_ssize_t>own[p] * n_sources + column)
                s2h_take_sum(to, lower + 8 * <Py_ssize_t>p * n_own, solved + 8 * <Py_ssize_t>column * n_own, n_own)


cdef void substitute(
    const double* matrix, double* x, const double* inverses, double* scratch, const int* begins, const int* columns,
    const int* blocks, int n_blocks, int n_sources
) noexcept nogil:
    """Compute x = L^-T D^-1 x."""
    cdef int k, i, j, p, m, n_own, column
    cdef const int* own
    cdef double* to
    cdef double* behind  # (m,) the entries of x at the columns of a block
    for k in range(n_blocks - 1, -1, -1):
        i = blocks[k]
        n_own, own, m = blocks[k + 1] - i, columns + begins[i], begins[i + 1] - begins[i]
        for column in range(n_sources):
            behind = scratch
            for p in range(n_own, m):
                memcpy(behind + 8 * p, x + 8 * (<Py_ssize_t>own[p] * n_sources + column), 8 * sizeof(double))
            for j in range(n_own - 1, -1, -1):
                i = blocks[k] + j
                to = x + 8 * (<Py_ssize_t>i * n_sources + column)
                s2h_scale(to, inverses + 8 * <Py_ssize_t>i)
                s2h_take_sum(to, matrix + 8 * <Py_ssize_t>(begins[i] + 1), behind + 8 * (j + 1), m - j - 1)
                memcpy(behind + 8 * j, to, 8 * sizeof(double))


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
