"""A bounding volume hierarchy of axis-aligned boxes over the triangles of a mesh, built once per shape.

The tree is complete and binary, in heap order: the children of node k are 2 k + 1 and 2 k + 2. Its leaves, the last
`n_leaves` nodes, hold one triangle each. Empty leaves have empty boxes (low = inf, high = -inf), which overlap nothing.
Each node is halved at the median of its triangles' middles, along the axis that gives the halves' boxes the least area.

Source: C. Ericson, Real-Time Collision Detection (2005), sections 6.2.1 (splits) and 6.6 (heap order). A tree along a
Morton curve is built ten times as fast, but its boxes overlap more: searches between meshes of 10,000 triangles take
1.2 to 1.9 times as long.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats, Indices
from scene2hap.compiled import compiled
from scene2hap.contact.geometry.boxes import Boxes
from scene2hap.contact.geometry.features import Features
from scene2hap.contact.geometry.vectors import Triple

ALL = 1 << 60
"""More triangles than any mesh has."""


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
    """Return the column of each leaf's triangle, -1 for an empty leaf.

    Each level halves all nodes at once. The columns are kept in the order of their middles along each axis, node by
    node.
    """
    n = boxes.low.shape[1]
    orders = np.argsort(boxes.low + boxes.high, axis=1, kind="stable")
    counts = np.array([n])
    while len(counts) < n:
        starts, halves = np.cumsum(counts) - counts, (counts + 1) // 2
        node, splits = np.repeat(np.arange(len(counts)), counts), np.ravel([starts, starts + halves], order="F")
        is_first = np.arange(n) < (starts + halves)[node]
        axes = np.argmin([_halves_area(boxes.some(order), splits) for order in orders], axis=0)[node]
        goes_first = np.empty(n, dtype=bool)
        goes_first[np.choose(axes, orders)] = is_first
        for order in orders:
            # In both halves of a node the columns keep their order.
            first = goes_first[order]
            ranked = np.empty_like(order)
            ranked[is_first], ranked[~is_first] = order[first], order[~first]
            order[:] = ranked
        counts = np.ravel([halves, counts - halves], order="F")
    columns = np.full(len(counts), -1, dtype=np.intp)
    columns[counts > 0] = orders[0]
    return columns


def _halves_area(boxes: Boxes, splits: Indices) -> Floats:
    """Return the sum of the areas of the boxes around both halves of each node [m2]; any number if a half is empty.

    Parameters: boxes : in the order of the nodes' halves; splits : the first box of each half.
    """
    splits = np.minimum(splits, boxes.low.shape[1] - 1)
    x, y, z = np.maximum.reduceat(boxes.high, splits, axis=1) - np.minimum.reduceat(boxes.low, splits, axis=1)
    areas: Floats = (x * y + y * z + z * x).reshape(-1, 2).sum(axis=1)
    return areas
