"""The compiled twin of the kernel in `triangle_tree`."""

import numpy as np

from libc.stdlib cimport free, malloc


cdef struct Query:
    const double* nodes
    const Py_ssize_t* columns
    Py_ssize_t n_leaves, n, most
    Py_ssize_t* found
    double low[3]
    double high[3]


cdef void look(Query* query, Py_ssize_t node) noexcept:
    cdef const double* box = query.nodes + 6 * node
    if query.n == query.most or not (
        box[0] <= query.high[0] and box[1] <= query.high[1] and box[2] <= query.high[2]
        and box[3] >= query.low[0] and box[4] >= query.low[1] and box[5] >= query.low[2]
    ):
        return
    if node >= query.n_leaves - 1:
        query.found[query.n] = query.columns[node - query.n_leaves + 1]
        query.n += 1
        return
    look(query, 2 * node + 1)
    look(query, 2 * node + 2)


def meeting(tree, low, high, Py_ssize_t most):
    cdef Query query
    cdef const double[:, ::1] nodes = tree[0]
    cdef const Py_ssize_t[::1] columns = tree[2]
    cdef Py_ssize_t[::1] found
    cdef Py_ssize_t k
    query.nodes, query.columns, query.n_leaves = &nodes[0, 0], &columns[0], columns.shape[0]
    query.n, query.most = 0, min(most, query.n_leaves)
    query.low[0], query.low[1], query.low[2] = low
    query.high[0], query.high[1], query.high[2] = high
    query.found = <Py_ssize_t*>malloc(max(query.most, 1) * sizeof(Py_ssize_t))
    if query.found == NULL:
        raise MemoryError
    try:
        look(&query, 0)
        columns_found = np.empty(query.n, dtype=np.intp)
        found = columns_found
        for k in range(query.n):
            found[k] = query.found[k]
    finally:
        free(query.found)
    if query.n > 1:
        columns_found.sort()
    return columns_found
