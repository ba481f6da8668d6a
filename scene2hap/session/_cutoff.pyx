"""The compiled twin of the kernel in `cutoff`."""

from libc.math cimport INFINITY


def within(list prices, list cutoff, list sought):
    cdef Py_ssize_t n = len(cutoff), n_beyond = 0, i, x
    cdef double price, limit
    cdef list row
    columns, each = [], [[] for _ in prices]
    for x in range(n):
        limit = cutoff[x]
        is_near = False
        for i in range(len(prices)):
            row = prices[i]
            price = row[x]
            if price <= limit:
                is_near = True
            elif x in sought[i]:
                n_beyond += 1
        if is_near:
            columns.append(x)
            for i in range(len(prices)):
                row = prices[i]
                price = row[x]
                (<list>each[i]).append(price if price <= limit else INFINITY)
    return columns, each, n_beyond
