"""The winding of a mesh: which side of each triangle is outside, so that rays can count when they enter and leave.

In a well-wound mesh each edge runs at most once each way. Files break this rule in two ways: faces drawn twice, with
either winding, to be seen from both sides; and triangles whose winding differs from their neighbours'.

A patch is a set of triangles that are connected across edges of exactly two triangles. It is closed if it has no other
edges. A patch of both windings is turned to face the side with more free space, in a cavity the inside; any other keeps
its winding. Coincident triangles become one. A patch of which each triangle is drawn with both windings keeps both
copies if it is open, and if other triangles of the mesh are drawn once: it is a sheet with two sides, or the wall
between two solids. A triangle drawn twice with one winding keeps both copies if its edges need both: two solids that
overlap share it.

Source: K. Takayama, A. Jacobson, L. Kavan, O. Sorkine-Hornung, A simple method for correcting facet orientations in
polygon meshes based on ray casting (JCGT 3, 2014).
Differs: rays run along three axes only, and the lengths of all of them count.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Bools, Floats, Ints
from scene2hap.scene.geometry import SAME_PLACE, welded
from scene2hap.scene.surface.rays import free_space

_RAYS_PER_SIDE = 32


def well_wound(points: Floats, faces: Ints, spend: Callable[[int], None] = lambda n_pairs: None) -> Ints:
    """Return triangles (3, k), indices into points (3, n), of faces (3, m): each once, wound like its neighbours.

    A well-wound mesh is returned unchanged.
    """
    corners = welded(points.T, SAME_PLACE * float(np.ptp(points, axis=1).max()))[faces]
    edges = np.sort(_directed(corners, np.roll(corners, -1, axis=0)), axis=None)
    has_area = (corners != np.roll(corners, -1, axis=0)).all(axis=0)
    if (edges[1:] != edges[:-1]).all() or not has_area.any():
        return faces
    lines, faces, corners = faces[:, ~has_area], faces[:, has_area], corners[:, has_area]
    is_balanced = _are_balanced(corners)
    first, copies, turns = _distinct(corners)
    faces, corners = faces[:, first], corners[:, first]
    is_balanced = is_balanced[first]
    patches = _Patches.of(corners)
    faces = np.where(patches.outwards(points[:, faces], spend), faces, faces[::-1])
    # Copies count relative to the whole mesh: if all of it is drawn twice, a sheet is a sheet, drawn twice.
    is_twice = copies >= 2 * copies.min()
    has_single = np.bincount(patches.number, ~is_twice | (turns != 0)) > 0
    is_two_sided = (patches.is_open & ~has_single)[patches.number]
    is_shared = is_twice & (turns != 0) & is_balanced
    return np.concatenate((faces, faces[::-1, is_two_sided], faces[:, is_shared], lines), axis=1)


class _Patches(NamedTuple):
    """Patches of triangles.

    number : (m,) the patch of each triangle; turn : (m,) +1 or -1, equal for triangles of a patch that are wound alike;
    is_open : (n_patches,) True if the patch has an edge of one triangle, or of more than two.
    """

    number: Ints
    turn: Ints
    is_open: Bools

    @classmethod
    def of(cls, corners: Ints) -> _Patches:
        """Find the patches of triangles (3, m) of welded corners."""
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components

        m = corners.shape[1]
        start, _, keys = edges_of(corners)
        order = np.argsort(keys, kind="stable")
        begins = np.flatnonzero(np.diff(keys[order], prepend=-1))
        count = np.diff(begins, append=len(keys))
        one, other = order[begins[count == 2]], order[begins[count == 2] + 1]
        # Two nodes for each triangle, as it is and turned, so that each component holds triangles wound alike.
        is_alike = (start[one] != start[other]).astype(np.int64)
        a, b = one % m, other % m
        ends = np.concatenate((a, a + m)), np.concatenate((b + m * (1 - is_alike), b + m * is_alike))
        links = coo_array((np.ones(len(ends[0]), dtype=np.int8), ends), shape=(2 * m, 2 * m))
        found = connected_components(links, directed=False)[1].astype(np.int64).reshape(2, m)
        _, number = np.unique(found.min(axis=0), return_inverse=True)
        is_rim = np.repeat(count != 2, count)
        is_open = np.zeros(number.max() + 1, dtype=bool)
        is_open[number[order[is_rim] % m]] = True
        return cls(number, np.where(found[0] <= found[1], 1, -1), is_open)

    def outwards(self, triangles: Floats, spend: Callable[[int], None]) -> Bools:
        """Return False (m,) for triangles (3, 3, m) to turn, so that patches of both windings face free space."""
        is_mixed = np.abs(np.bincount(self.number, self.turn)) < np.bincount(self.number)
        if not is_mixed.any():
            return np.ones(len(self.turn), dtype=bool)
        free_m3 = sum(free_space(np.roll(triangles, axis, axis=0), _RAYS_PER_SIDE, spend) for axis in range(3))
        wanted = np.where(np.bincount(self.number, self.turn * free_m3) >= 0, 1, -1)[self.number]
        alike: Bools = ~is_mixed[self.number] | (self.turn == wanted)
        return alike


def _are_balanced(corners: Ints) -> Bools:
    """Return True (m,) for triangles (3, m) whose edges run as often one way as the other in the mesh."""
    start, end, keys = edges_of(corners)
    _, edge = np.unique(keys, return_inverse=True)
    balanced: Bools = (np.bincount(edge, np.where(start < end, 1, -1)) == 0)[edge].reshape(3, -1).all(axis=0)
    return balanced


def _distinct(corners: Ints) -> tuple[Ints, Ints, Ints]:
    """Return the first (k,) of the triangles (3, m) between the same corners, how many (k,) there are, and the
    difference (k,) between the numbers of both windings."""
    low, middle, high = np.sort(corners, axis=0)
    order = np.lexsort((high, middle, low))
    is_new = np.diff(np.stack((low, middle, high))[:, order], axis=1, prepend=-1).any(axis=0)
    begins = np.flatnonzero(is_new)
    # A turn through three different numbers rises twice in one direction, once in the other.
    turn = 2 * (corners < np.roll(corners, -1, axis=0)).sum(axis=0) - 3
    first, copies = order[begins], np.diff(begins, append=len(order))
    in_file = np.argsort(first)
    return first[in_file], copies[in_file], np.add.reduceat(turn[order], begins)[in_file]


def _directed(start: Ints, end: Ints) -> Ints:
    """Return a number for each pair of corners, from start to end."""
    keys: Ints = (start << 32) | end
    return keys


def edges_of(corners: Ints) -> tuple[Ints, Ints, Ints]:
    """Return start and end (3 m,) of the edges of triangles (3, m), and a number that is equal for both directions."""
    start, end = corners.ravel(), np.roll(corners, -1, axis=0).ravel()
    return start, end, _directed(np.minimum(start, end), np.maximum(start, end))
