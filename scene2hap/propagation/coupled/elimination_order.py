"""Elimination order of joints, and the sparsity pattern of the factor of their matrix.

Bodies are merged two at a time, first the two whose union has the fewest joints. A merge eliminates the joints that the
two bodies share, and leaves one body with the other joints of both. The factor of a room is as wide as the fronts of
its largest bodies, whatever the number of joints.

Source: Duff, Reid, The multifrontal solution of indefinite sparse symmetric linear equations, ACM TOMS 9 (1983) 302,
whose elements are our bodies.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from heapq import heapify, heappop, heappush

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Pattern:
    """Sparsity pattern of a factored symmetric matrix of n rows, with its rows in the order of elimination.

    place : (n,) position of each row in that order; begins : (n + 1,) first entry of each position; columns :
    (n_entries,) column positions of entries, in each row the diagonal first, then rising; entry : (n, n) index of the
    entry at a row position and a column position >= row, -1 for none; blocks : (n_blocks + 1,) first position of each
    block of rows that have the same columns, those before the diagonal aside, and n; n_products : multiplications of
    one factorisation.
    """

    place: NDArray[np.int32]
    begins: NDArray[np.int32]
    columns: NDArray[np.int32]
    entry: NDArray[np.int32]
    blocks: NDArray[np.int32]
    n_products: int


@lru_cache(maxsize=16)
def pattern_of(rows_of: tuple[tuple[int, ...], ...]) -> Pattern:
    """Return the pattern for elements with these rows. Cached, since most motions change no topology."""
    fronts = merged_fronts(rows_of)
    order = [row for shared, _ in fronts for row in shared]
    n = len(order)
    place = np.empty(n, dtype=np.int32)
    place[order] = np.arange(n)
    entry = np.full((n, n), -1, dtype=np.int32)
    begins, columns = [0], [np.empty(0, dtype=np.int32)]
    for shared, others in fronts:
        both = np.concatenate([place[shared], np.sort(place[others])]).astype(np.int32)
        for i, row in enumerate(both[: len(shared)]):
            own = both[i:]
            entry[row, own] = begins[-1] + np.arange(len(own))
            begins.append(begins[-1] + len(own))
            columns.append(own)
    widths = np.diff(begins)
    n_products = int((widths * (widths + 1) // 2).sum())
    # A row has all columns of the row before but that row's diagonal, and is in its block if it has no others.
    is_next = (widths[:-1] == widths[1:] + 1) & (widths[:-1] > 1)
    blocks = np.array([0, *np.flatnonzero(~is_next) + 1, n], dtype=np.int32)
    return Pattern(place, np.array(begins, dtype=np.int32), np.concatenate(columns), entry, blocks, n_products)


def merged_fronts(rows_of: tuple[tuple[int, ...], ...]) -> list[tuple[list[int], list[int]]]:
    """Return for each merge of two elements the rows that they share, which are eliminated, and their other rows."""
    live = {key: set(rows) for key, rows in enumerate(rows_of)}
    owners: dict[int, set[int]] = {}
    for key, own in live.items():
        for row in own:
            owners.setdefault(row, set()).add(key)

    def fronts_with(key: int) -> set[tuple[int, int, int]]:
        others = {other for row in live[key] for other in owners[row]} - {key}
        return {(len(live[key] | live[x]), min(key, x), max(key, x)) for x in others}

    waiting = list({front for key in live for front in fronts_with(key)})
    heapify(waiting)
    fronts: list[tuple[list[int], list[int]]] = []
    while waiting:
        _, first, second = heappop(waiting)
        if first not in live or second not in live:
            continue
        a, b = live.pop(first), live.pop(second)
        key = len(rows_of) + len(fronts)
        live[key] = a ^ b
        fronts.append((sorted(a & b), sorted(a ^ b)))
        for row in live[key]:
            owners[row] = (owners[row] - {first, second}) | {key}
        for front in fronts_with(key):
            heappush(waiting, front)
    return fronts
