"""A bounding volume hierarchy of axis-aligned boxes over the triangles of a mesh, built once per shape.

The tree is complete and binary, in heap order: the children of node k are 2 k + 1 and 2 k + 2. Its leaves, the last
`n_leaves` nodes, hold `LEAF_SIZE` triangles each, sorted along a Morton curve through their middles. Padding leaves
have empty boxes (low = inf, high = -inf), which overlap nothing.

Source: C. Ericson, Real-Time Collision Detection (2005), section 6.6 (heap order); G. M. Morton, IBM technical report
(1966).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scene2hap.contact.broad import Boxes
from scene2hap.contact.vectors import Floats, Indices

LEAF_SIZE = 4
_MORTON_BITS = 16


class TriangleTree(NamedTuple):
    """nodes : (2 n_leaves - 1, 6) lowest and highest corners [m]; corners : (m, 9) the triangles in leaf order, three
    corners of three coordinates [m]; order : (m,) the column of each in its shape."""

    nodes: Floats
    corners: Floats
    order: Indices

    @classmethod
    def over(cls, triangles: Floats, boxes: Boxes) -> TriangleTree:
        """Build the tree over triangles (3, 3, m) in their boxes."""
        order = _along_morton_curve(boxes)
        n_leaves = 1
        while n_leaves * LEAF_SIZE < len(order):
            n_leaves *= 2
        nodes = np.empty((2 * n_leaves - 1, 6))
        nodes[:, :3], nodes[:, 3:] = np.inf, -np.inf
        low, high = boxes.low.T[order], boxes.high.T[order]
        starts = np.arange(0, len(order), LEAF_SIZE)
        if len(starts):
            leaves = nodes[n_leaves - 1 : n_leaves - 1 + len(starts)]
            leaves[:, :3] = np.minimum.reduceat(low, starts)
            leaves[:, 3:] = np.maximum.reduceat(high, starts)
        first, n = n_leaves - 1, n_leaves
        while n > 1:
            children = nodes[first : first + n].reshape(n // 2, 2, 6)
            first, n = first - n // 2, n // 2
            nodes[first : first + n, :3] = children[..., :3].min(axis=1)
            nodes[first : first + n, 3:] = children[..., 3:].max(axis=1)
        corners = np.ascontiguousarray(triangles.transpose(2, 1, 0)[order]).reshape(-1, 9)
        return cls(nodes, corners, order)


def _along_morton_curve(boxes: Boxes) -> Indices:
    middles = boxes.low + boxes.high
    low = middles.min(axis=1, keepdims=True)
    # One scale for all axes, so that thin slabs are split along their long sides.
    extent = float((middles - low).max(initial=0.0))
    cells = ((middles - low) * ((2**_MORTON_BITS - 1) / extent if extent > 0 else 0.0)).astype(np.uint64)
    code = np.zeros(middles.shape[1], dtype=np.uint64)
    for bit in range(_MORTON_BITS):
        for axis in range(3):
            code |= ((cells[axis] >> np.uint64(bit)) & np.uint64(1)) << np.uint64(3 * bit + axis)
    return np.argsort(code, kind="stable")
