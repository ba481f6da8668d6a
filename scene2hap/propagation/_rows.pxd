"""Weighted sums of rows of numbers: the inner loops of queries at a point."""

ctypedef fused real:
    float
    double


cdef inline void add_row(real* out, const real* row, real share, Py_ssize_t n) noexcept nogil:
    """Add a row (n,) times a share."""
    cdef Py_ssize_t k
    for k in range(n):
        out[k] += share * row[k]


cdef inline void add_rows(
    real* out, const real* rows, const real* shares, Py_ssize_t n_rows, Py_ssize_t n
) noexcept nogil:
    """Add rows (n_rows, n), each times its share, four at once: reading and writing the sum takes as long as a product.
    """
    cdef Py_ssize_t row = 0, k
    cdef real a, b, c, d
    while row + 4 <= n_rows:
        a, b, c, d = shares[row], shares[row + 1], shares[row + 2], shares[row + 3]
        for k in range(n):
            out[k] += (a * rows[k] + b * rows[n + k]) + (c * rows[2 * n + k] + d * rows[3 * n + k])
        rows += 4 * n
        row += 4
    while row < n_rows:
        add_row(out, rows, shares[row], n)
        rows += n
        row += 1
