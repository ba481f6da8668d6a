"""A bounding volume hierarchy of axis-aligned boxes over the triangles of a mesh, built once per shape.

The tree is complete and binary, in heap order: the children of node k are 2 k + 1 and 2 k + 2. Its leaves, the last
`n_leaves` nodes, hold one triangle each. A node's triangles are split at the median of their middles, along the axis in
which these spread most. Empty leaves have empty boxes (low = inf, high = -inf), which overlap nothing.

Source: C. Ericson, Real-Time Collision Detection (2005), sections 6.2 (median cut) and 6.6 (heap order).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scene2hap.compiled import compiled
from scene2hap.contact.broad import Boxes
from scene2hap.contact.vectors import Floats, Indices, Triple


class TriangleTree(NamedTuple):
    """nodes : (2 n_leaves - 1, 6) lowest and highest corners [m]; corners : (n_leaves, 9) the triangle of each leaf,
    three corners of three coordinates [m]; columns : (n_leaves,) its column in the shape, -1 for an empty leaf."""

    nodes: Floats
    corners: Floats
    columns: Indices

    @classmethod
    def over(cls, triangles: Floats, boxes: Boxes) -> TriangleTree:
        """Build the tree over triangles (3, 3, m) in their boxes."""
        columns = _leaves(boxes)
        n_leaves, is_full = len(columns), columns >= 0
        corners = np.zeros((n_leaves, 9))
        corners[is_full] = triangles.transpose(2, 1, 0)[columns[is_full]].reshape(-1, 9)
        nodes = np.empty((2 * n_leaves - 1, 6))
        nodes[:, :3], nodes[:, 3:] = np.inf, -np.inf
        leaves = nodes[n_leaves - 1 :]
        leaves[is_full, :3] = boxes.low.T[columns[is_full]]
        leaves[is_full, 3:] = boxes.high.T[columns[is_full]]
        first, n = n_leaves - 1, n_leaves
        while n > 1:
            children = nodes[first : first + n].reshape(n // 2, 2, 6)
            first, n = first - n // 2, n // 2
            nodes[first : first + n, :3] = children[..., :3].min(axis=1)
            nodes[first : first + n, 3:] = children[..., 3:].max(axis=1)
        return cls(nodes, corners, columns)


@compiled
def meeting(tree: TriangleTree, low: Triple, high: Triple, most: int) -> Indices:
    """Columns of up to `most` of the triangles whose boxes meet a box [m], touching included, in rising order."""
    leaves = tree.nodes[len(tree.columns) - 1 :]
    meets = ((leaves[:, :3] <= high) & (leaves[:, 3:] >= low)).all(axis=1)
    return np.sort(tree.columns[meets])[:most]


def _leaves(boxes: Boxes) -> Indices:
    """The column of each leaf's triangle, -1 for an empty leaf; level by level, all nodes of one at once."""
    middles = boxes.low + boxes.high
    m = middles.shape[1]
    node, order, n_nodes = np.zeros(m, dtype=np.intp), np.arange(m), 1
    while n_nodes < m:
        starts = np.flatnonzero(np.diff(node[order], prepend=-1))
        counts = np.diff(starts, append=m)
        sorted_middles = middles[:, order]
        spread = np.maximum.reduceat(sorted_middles, starts, axis=1) - np.minimum.reduceat(
            sorted_middles, starts, axis=1
        )
        axis = np.repeat(spread.argmax(axis=0), counts)
        order = order[np.lexsort((sorted_middles[axis, np.arange(m)], node[order]))]
        rank = np.arange(m) - np.repeat(starts, counts)
        node[order] = 2 * node[order] + (rank >= np.repeat((counts + 1) // 2, counts))
        n_nodes *= 2
    columns = np.full(n_nodes, -1, dtype=np.intp)
    columns[node] = np.arange(m)
    return columns
