"""Contacts at a stated tolerance: any two surfaces within it touch, without a rule of support or hanging.

All data of objects are in columns of arrays. An update takes a fixed number of numpy steps for any number of moved
objects: AABBs, overlapping pairs, distances (`cuboids`) and contact points (`cuboid_patch`). Only pairs with an object
that is no cuboid are compared by triangles, one by one.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from scene2hap.contact.geometry.broad import Boxes, box_pairs
from scene2hap.contact.geometry.spread import MAX_POINTS
from scene2hap.contact.geometry.vectors import Indices, Marks, Rows, Triple, dot
from scene2hap.contact.junction import ContactArrays, Junction, Pair
from scene2hap.contact.mesh_distance import ROUNDING_M, MeshPair
from scene2hap.contact.rule import CLEAR_M, PATCH_SHARE, weight, weights
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.contact.stated_tolerance.cuboid_patch import patches
from scene2hap.contact.stated_tolerance.cuboids import Pairs, gaps, times
from scene2hap.contact.stated_tolerance.touches import Difference, PairNames, Touches, difference
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.pose_table import PoseTable

# The products of a quaternion's components (x, y, z, w): the squares, then the terms of the off-diagonal entries.
_LEFT, _RIGHT = np.array([[0, 1, 2, 0, 0, 0, 1, 0, 1, 2, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 1, 2, 2, 2, 3, 3, 3, 3, 3, 3]])
_DIAGONAL = np.array([[1, 0, 0], [2, 2, 1]])
_OFF_DIAGONAL = np.array([1, 2, 3, 5, 6, 7])
_SIGNS = np.array([-1.0, 1.0, 1.0, -1.0, -1.0, 1.0])[:, None]
# Up to this many pairs of boxes, comparing all is cheaper than sorting.
_FEW = 1 << 18


class Placed(NamedTuple):
    """A shape at a pose, for `MeshPair`."""

    shape: Shape
    rows: Rows
    position_m: Triple
    size_m: float


class TouchFinder:
    """Find contacts within one tolerance.

    Parameters: tolerance_m : gap at which any two surfaces cease to touch [m].
    """

    def __init__(self, tolerance_m: float) -> None:
        self._tolerance_m = tolerance_m
        self._within_m = max(tolerance_m, ROUNDING_M)
        self._ids: list[str] = []
        self._shapes: list[Shape] = []
        self._column: dict[str, int] = {}
        self._free: list[int] = []
        self._columns_of: tuple[tuple[str, ...], Indices] = ((), np.empty(0, dtype=np.intp))
        # Poses as given; box middles in the shapes' frames; oriented boxes in the world: axes (9), middles (3) and half
        # edges (3); AABBs; size, and rank of the id.
        self._position, self._rotation = np.zeros((3, 0)), np.zeros((4, 0))
        self._own_middle, self._place = np.zeros((3, 0)), np.zeros((15, 0))
        self._low, self._high = np.zeros((3, 0)), np.zeros((3, 0))
        self._size, self._rank = np.zeros(0), np.zeros(0, dtype=np.intp)
        self._is_cuboid = np.zeros(0, dtype=bool)
        self._touches = Touches.none()
        self._names = PairNames(self._ids.__getitem__)

    def junctions(self) -> dict[Pair, Junction]:
        """Return the junctions by pair."""
        touches = self._touches
        return dict(zip(self._names.of(touches.codes.tolist()), touches.junctions(), strict=True))

    def arrays(self, ids: tuple[str, ...]) -> ContactArrays:
        """Return all contact points as arrays, sorted by pair, for objects in the order of `ids`."""
        row = np.zeros(len(self._ids), dtype=np.intp)
        row[[self._column[x] for x in ids]] = np.arange(len(ids))
        first, second = self._touches.columns()
        order = np.lexsort((self._rank[second], self._rank[first]))
        touches, first, second = self._touches.rows(order), row[first[order]], row[second[order]]
        n = touches.counts
        normals = np.where(touches.normals.any(axis=1, keepdims=True), touches.normals, np.nan)
        return ContactArrays(
            ids,
            np.repeat(first, n),
            np.repeat(second, n),
            touches.points_m[np.arange(MAX_POINTS) < n[:, None]],
            np.repeat(touches.weights, n),
            np.repeat(normals, n, axis=0),
        )

    def replace(
        self, moved: Mapping[str, Pose], added: Sequence[SceneObject] = (), gone: Iterable[str] = ()
    ) -> tuple[list[Pair], list[Pair], list[Pair]]:
        """Remove, add and move objects. Returns the pairs that appeared, vanished, and shifted."""
        left = [self._column.pop(x) for x in gone]
        if left:
            self._low[:, left], self._high[:, left] = np.inf, -np.inf
        came = [self._add(item) for item in added]
        if left or came:
            self._columns_of = ((), np.empty(0, dtype=np.intp))
            self._rank_ids()
        columns = self._move(moved)
        if came:
            columns = np.unique(np.concatenate([columns, np.array(came, dtype=np.intp)]))
        self._update_boxes(columns)
        changed = self._update_touches(columns, left)
        names = self._names.of
        changes = (names(changed.appeared), names(changed.vanished), names(changed.shifted))
        if left:
            self._free += left
            self._names.forget()
        return changes

    def _add(self, item: SceneObject) -> int:
        """Reserve and fill a column for a new object."""
        column = self._free.pop() if self._free else len(self._ids)
        if column == len(self._ids):
            self._ids.append(item.id)
            self._shapes.append(shape_of(item.geometry.mesh))
            if column == self._size.shape[0]:
                self._grow_columns()
        shape = shape_of(item.geometry.mesh)
        self._ids[column], self._shapes[column], self._column[item.id] = item.id, shape, column
        self._position[:, column], self._rotation[:, column] = item.pose.position_m, item.pose.rotation_xyzw
        self._own_middle[:, column], self._place[12:, column] = shape.middle, shape.half
        self._size[column], self._is_cuboid[column] = shape.size_m, shape.is_cuboid
        return column

    def _grow_columns(self) -> None:
        for name in (
            *("_position", "_rotation", "_own_middle", "_place"),
            *("_low", "_high", "_size", "_rank", "_is_cuboid"),
        ):
            array = getattr(self, name)
            more = np.zeros((*array.shape[:-1], max(64, array.shape[-1])), dtype=array.dtype)
            setattr(self, name, np.concatenate([array, more], axis=-1))

    def _rank_ids(self) -> None:
        for rank, x in enumerate(sorted(self._column)):
            self._rank[self._column[x]] = rank

    def _move(self, moved: Mapping[str, Pose]) -> Indices:
        """Store poses. Returns the columns of objects whose pose changed."""
        if isinstance(moved, PoseTable):
            if self._columns_of[0] is not moved.ids:
                self._columns_of = (moved.ids, np.array([self._column[x] for x in moved], dtype=np.intp))
            columns, position, rotation = self._columns_of[1], moved.positions_m.T, moved.rotations_xyzw.T
        else:
            columns = np.array([self._column[x] for x in moved], dtype=np.intp)
            position = np.array([pose.position_m for pose in moved.values()]).reshape(-1, 3).T
            rotation = np.array([pose.rotation_xyzw for pose in moved.values()]).reshape(-1, 4).T
        here = (self._position[:, columns] == position).all(axis=0) & (self._rotation[:, columns] == rotation).all(0)
        if here.any():
            columns, position, rotation = columns[~here], position[:, ~here], rotation[:, ~here]
        self._position[:, columns], self._rotation[:, columns] = position, rotation
        return columns

    def _update_boxes(self, columns: Indices) -> None:
        """Compute axes, middles and AABBs of the objects in these columns."""
        q = self._rotation.take(columns, axis=1)
        products = q.take(_LEFT, axis=0) * q.take(_RIGHT, axis=0)
        place = np.empty((12, len(columns)))
        place[0:9:4] = 1 - 2 * (products[_DIAGONAL[0]] + products[_DIAGONAL[1]])
        place[_OFF_DIAGONAL] = 2 * (products[3:9] + products[9:] * _SIGNS)
        turn = place[:9].reshape(3, 3, -1)
        middle = self._position[:, columns] + times(turn, self._own_middle[:, None, columns])[:, 0]
        wide = times(np.abs(turn), self._place[12:, None, columns])[:, 0]
        place[9:] = middle
        self._place[:12, columns] = place
        self._low[:, columns], self._high[:, columns] = middle - wide, middle + wide

    def _update_touches(self, columns: Indices, left: Sequence[int]) -> Difference:
        """Update the contacts of all objects that moved or were removed. Returns the difference."""
        stirred = np.zeros(len(self._ids), dtype=bool)
        stirred[columns] = True
        i, j = self._overlapping(columns, stirred)
        # The larger of two is the host; of equal sizes, the one with the lower id.
        swap = (self._size[i] < self._size[j]) | ((self._size[i] == self._size[j]) & (self._rank[i] > self._rank[j]))
        host, guest = np.where(swap, j, i), np.where(swap, i, j)
        blocks = self._is_cuboid[host] & self._is_cuboid[guest]
        if blocks.all():
            now = self._of_cuboids(host, guest)
        else:
            now = self._of_cuboids(host[blocks], guest[blocks])
            now = now.with_more(self._of_triangles(host[~blocks], guest[~blocks]))
        stirred[left] = True
        first, second = self._touches.columns()
        again = stirred[first] | stirred[second]
        before, others = self._touches, Touches.none()
        if not again.all():
            before, others = before.rows(again), before.rows(~again)
        self._touches = others.with_more(now)
        return difference(before, now)

    def _overlapping(self, columns: Indices, stirred: Marks) -> tuple[Indices, Indices]:
        """Return the columns of pairs whose AABBs overlap within the tolerance; the first moved; each pair once."""
        n, within_m = len(self._ids), self._within_m
        low, high = self._low[:, columns] - within_m, self._high[:, columns] + within_m
        if n * len(columns) <= _FEW:
            meets = low[0, :, None] <= self._high[0, :n]
            for axis in range(3):
                if axis:
                    meets &= low[axis, :, None] <= self._high[axis, :n]
                meets &= high[axis, :, None] >= self._low[axis, :n]
            # Faster than `np.nonzero`, or than a division.
            i = np.repeat(np.arange(len(columns)), np.count_nonzero(meets, axis=1))
            j = np.flatnonzero(meets) - i * n
        else:
            every = Boxes(self._low[:, :n], self._high[:, :n])
            parts = list(box_pairs(Boxes(low, high), every))
            i, j = (np.concatenate(side) for side in zip(*parts, strict=True)) if parts else (columns[:0],) * 2
        i = columns[i]
        once = (i < j) | ((i > j) & ~stirred[j])
        return i[once], j[once]

    def _of_cuboids(self, host: Indices, guest: Indices) -> Touches:
        """Return the contacts of pairs of cuboids."""
        one, other = self._place.take(host, axis=1), self._place.take(guest, axis=1)
        axes = one[:9].reshape(3, 3, -1)
        turn = dot(axes[:, :, None], other[:9].reshape(3, 3, -1)[:, None])
        shift = dot(axes, (other[9:12] - one[9:12])[:, None])
        pairs = Pairs.of(turn, shift, one[12:], other[12:])
        rows, near = gaps(pairs, self._within_m)
        gap_m = np.where(near.distance_m > ROUNDING_M, near.distance_m, 0.0)
        shares = weights(gap_m, self._tolerance_m)
        some = shares > 0
        if not some.all():
            rows, near, gap_m, shares = rows[some], near.rows(np.flatnonzero(some)), gap_m[some], shares[some]
        if not len(rows):
            return Touches.none()
        reach_m = near.distance_m + PATCH_SHARE * self._tolerance_m
        spots = patches(pairs.rows(rows), near, reach_m, self._tolerance_m)
        host, guest, one = host[rows], guest[rows], one.take(rows, axis=1)
        axes = one[:9].reshape(3, 3, -1)
        points = one[9:12, None] + times(axes, spots.points_m)
        in_order = self._rank[host] < self._rank[guest]
        first, second = np.where(in_order, host, guest), np.where(in_order, guest, host)
        # The length of `way_m` may differ from the gap where two faces are equally near.
        lengths = np.sqrt(dot(near.way_m, near.way_m))
        away = np.where(gap_m < CLEAR_M, 0.0, np.where(in_order, 1.0, -1.0)) / np.where(lengths > 0, lengths, 1.0)
        normals = times(axes, (near.way_m * away)[:, None])[:, 0]
        return Touches.of(first, second, points, spots.counts, (shares, normals))

    def _of_triangles(self, host: Indices, guest: Indices) -> Touches:
        """Return the contacts of pairs of which at least one is no cuboid."""
        found = Touches.none()
        for x, y in zip(host.tolist(), guest.tolist(), strict=True):
            a, b = (x, y) if self._rank[x] < self._rank[y] else (y, x)
            junction = self._of_two(self._placed(a), self._placed(b))
            if junction is not None:
                points, counts = np.zeros((3, MAX_POINTS, 1)), np.zeros((MAX_POINTS, 1), dtype=bool)
                n = len(junction.points_m)
                points[:, :n, 0], counts[:n] = np.array(junction.points_m).T, True
                normal = np.array(junction.normals[0] or (0.0, 0.0, 0.0))[:, None]
                more = (np.array(junction.weights[:1]), normal)
                found = found.with_more(Touches.of(np.array([a]), np.array([b]), points, counts, more))
        return found

    def _of_two(self, a: Placed, b: Placed) -> Junction | None:
        """Return the junction of two objects by their triangles, None without contact."""
        pair = MeshPair(a, b)
        gap = pair.gap(self._tolerance_m)
        share = 0.0 if gap is None else weight(gap.distance_m, self._tolerance_m)
        if gap is None or share <= 0:
            return None
        patch = pair.patch((0.0, 0.0, 0.0), PATCH_SHARE * self._tolerance_m + gap.distance_m)
        points = tuple([ends.middle_m for ends in patch])
        normal: Triple | None = None
        if gap.distance_m >= CLEAR_M:
            x, y, z = (np.array(gap.way_m) / np.linalg.norm(gap.way_m)).tolist()
            normal = (x, y, z)
        return Junction(points, (share,) * len(points), (normal,) * len(points)) if points else None

    def _placed(self, column: int) -> Placed:
        (x, y, z), (a, b, c, d) = self._position[:, column].tolist(), self._rotation[:, column].tolist()
        p, q, r = Pose((x, y, z), (a, b, c, d)).rotation.tolist()
        return Placed(self._shapes[column], (tuple(p), tuple(q), tuple(r)), (x, y, z), float(self._size[column]))
