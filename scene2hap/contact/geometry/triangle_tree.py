"""A bounding volume hierarchy of axis-aligned boxes over the triangles of a mesh, built once per shape.

The tree is complete and binary, in heap order: the children of node k are 2 k + 1 and 2 k + 2. Its leaves, the last
`n_leaves` nodes, hold one triangle each, sorted along a Morton curve through their middles. Empty leaves have empty
boxes (low = inf, high = -inf), which overlap nothing.

Source: C. Ericson, Real-Time Collision Detection (2005), section 6.6 (heap order); G. M. Morton, IBM technical report
(1966). Splits at medians of the triangles' middles give the same speed and take ten times as long to build.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scene2hap.compiled import compiled
from scene2hap.contact.geometry.broad import Boxes
from scene2hap.contact.geometry.features import Features
from scene2hap.contact.geometry.vectors import Floats, Indices, Triple

_MORTON_BITS = 16


class TriangleTree(NamedTuple):
    """The arrays of a tree.

    nodes : (2 n_leaves - 1, 6) lowest and highest corners [m]; corners : (n_leaves, 9) the triangle of each leaf, three
    corners of three coordinates [m]; columns : (n_leaves,) its column in the shape, -1 for an empty leaf; features :
    (n_leaves,) its corners and edges that are tested, see `features`.
    """

    nodes: Floats
    corners: Floats
    columns: Indices
    features: Features

    @classmethod
    def over(cls, triangles: Floats, boxes: Boxes, features: Features) -> TriangleTree:
        """Build the tree over triangles (3, 3, m) with their boxes and features."""
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
        of_leaves = np.zeros(n_leaves, dtype=np.uint8)
        of_leaves[is_full] = features[columns[is_full]]
        return cls(nodes, corners, columns, of_leaves)


@compiled
def meeting(tree: TriangleTree, low: Triple, high: Triple, most: int) -> Indices:
    """Return the columns of up to `most` triangles whose boxes overlap a box [m], touching included, ascending."""
    leaves = tree.nodes[len(tree.columns) - 1 :]
    meets = ((leaves[:, :3] <= high) & (leaves[:, 3:] >= low)).all(axis=1)
    return np.sort(tree.columns[meets])[:most]


def _leaves(boxes: Boxes) -> Indices:
    """Return the column of each leaf's triangle, -1 for an empty leaf."""
    order = _along_morton_curve(boxes)
    n_leaves = 1
    while n_leaves < len(order):
        n_leaves *= 2
    columns = np.full(n_leaves, -1, dtype=np.intp)
    columns[: len(order)] = order
    return columns


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
