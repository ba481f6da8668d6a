"""Two objects at a time: how far apart their surfaces are, and where they meet.

Surfaces, not volumes: surfaces that cut each other have gap 0, but a thing wholly inside a closed other, out of reach
of its surface, does not touch it, as a chair in a room does not touch the room's walls.

Everything is computed in the frame of the larger object: a wall's long triangles have thin boxes there, and moving both
objects rigidly changes nothing but the last bits.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, Protocol

import numpy as np

from scene2hap.contact.body import Shape, boxes_of
from scene2hap.contact.broad import Boxes, are_few, box_pairs
from scene2hap.contact.spread import spread
from scene2hap.contact.triangles import TrianglePairs
from scene2hap.contact.vectors import Floats, Indices, Marks, dot, turned
from scene2hap.scene.pose import Pose

ROUNDING_M = 1e-9
"""Below this a gap is rounding."""

_BATCH = 4096  # Triangle pairs in the kernel at once: some 10 MB.
_FIRST = 64  # So many are asked for the least distance first, then 8 times more, since that may spare most others.


class Gap(NamedTuple):
    """The least distance of two surfaces [m], and the way (3,) [m] from `a` to `b` there, in the world."""

    distance_m: float
    way_m: Floats


class Near(NamedTuple):
    """Pairs of triangles, one of the guest and one of the host, in the host's frame.

    guest_columns, host_columns : (n,) which of their shapes' triangles; guest : some of the guest's triangles (3, 3, k)
    [m], and `columns` (n,) which of these; host : the host's shape.
    """

    guest_columns: Indices
    host_columns: Indices
    guest: Floats
    columns: Indices
    host: Shape

    def corners(self, pairs: Indices | slice) -> tuple[Floats, Floats]:
        """The triangles of guest and host of some pairs, both (3, 3, n) [m]."""
        guest = self.guest.take(self.columns[pairs], axis=2)
        return guest, self.host.triangles.take(self.host_columns[pairs], axis=2)

    def apart_m(self) -> Floats:
        """How far the boxes around the two triangles are apart (n,)."""
        a, b = boxes_of(self.guest).some(self.columns), self.host.boxes.some(self.host_columns)
        gaps = np.maximum(np.maximum(a.low - b.high, b.low - a.high), 0.0)
        return np.sqrt(dot(gaps, gaps))


class Patch(NamedTuple):
    """Up to `MAX_POINTS` points of contact: on a's surface in a's own frame, on b's in b's own, both (n, 3) [m]."""

    on_a_m: Floats
    on_b_m: Floats


class Placed(Protocol):
    """A shape at a place: as much of a `Body` as is needed to ask for distances."""

    @property
    def shape(self) -> Shape:
        """Its triangles."""

    @property
    def pose(self) -> Pose:
        """Where it is."""

    @property
    def size_m(self) -> float:
        """Diagonal of its own bounding box."""


class Meeting:
    """Two things in the frame of the larger, the host; the other is the guest."""

    def __init__(self, a: Placed, b: Placed) -> None:
        self.a, self.b = a, b
        self.guest_is_a = a.size_m < b.size_m
        self.guest, self.host = (a, b) if self.guest_is_a else (b, a)
        host, guest = self.host.pose, self.guest.pose
        self._rotation: Floats = host.rotation.T @ guest.rotation
        self._position: Floats = host.to_own(np.asarray(guest.position_m))[:, None]
        self._around_guest = _turned_box(self.guest.shape.box, self._rotation, self._position)

    def gap(self, within_m: float) -> Gap | None:
        """The least distance, if it is at most `within_m`."""
        best = within_m = max(within_m, ROUNDING_M)
        found: tuple[Floats, Floats] | None = None
        for pairs in self.near(within_m):
            nearest = Nearest(pairs.apart_m())
            while (some := nearest.next(best)) is not None:
                close = TrianglePairs(*pairs.corners(some)).within(best)
                if not len(close):
                    continue
                distance, on_guest, on_host = close.closest()
                k = int(np.argmin(distance))
                if distance[k] < best or (found is None and distance[k] <= best):
                    best, found = float(distance[k]), (on_guest[:, k], on_host[:, k])
                if best <= ROUNDING_M:
                    return Gap(0.0, np.zeros(3))
        if found is None:
            return None
        way = self.host.pose.rotation @ (found[1] - found[0])
        return Gap(best, way if self.guest_is_a else -way)

    def patch(self, way_m: Floats, within_m: float) -> Patch:
        """Where the surfaces are at most `within_m` apart once `a` has gone `way_m` (3,) [m] in the world.

        The points are told for the bodies where they are now. They are spread by farthest-point sampling: first the one
        farthest from the middle of all, then ever the one farthest from those taken.
        """
        within_m = max(within_m, ROUNDING_M)
        way = self.host.pose.rotation.T @ (way_m if self.guest_is_a else -way_m)
        ends = [(np.empty((3, 0)), np.empty((3, 0)))]
        for pairs in self.near(within_m, way):
            for start in range(0, len(pairs.host_columns), _BATCH):
                p, q = pairs.corners(slice(start, start + _BATCH))
                p += way[:, None, None]
                close = TrianglePairs(p, q).within(within_m)
                if not len(close):
                    continue
                on_p, on_q = close.near(within_m)
                ends.append((on_p - way[:, None], on_q))
        on_guest, on_host = (np.concatenate(side, axis=1) for side in zip(*ends, strict=True))
        chosen = spread((on_guest + on_host) / 2)
        guest_own = (self._rotation.T @ (on_guest[:, chosen] - self._position)).T
        host_own = on_host[:, chosen].T
        return Patch(guest_own, host_own) if self.guest_is_a else Patch(host_own, guest_own)

    def near(
        self,
        within_m: float,
        way: Floats | None = None,
        *,
        sweep: bool = False,
        guest_only: Marks | None = None,
        host_only: Marks | None = None,
    ) -> Iterator[Near]:
        """The pairs of triangles whose boxes are within reach, in the host's frame, in chunks.

        The guest's boxes stand at the end of `way` (3,), in the host's frame, or with `sweep` on all of it; the corners
        are told where they are. Marks (m,) restrict either side to some triangles.
        """
        way = np.zeros(3) if way is None else way
        guest, host = self.guest.shape, self.host.shape
        # By one box first: of a room, next to nothing is near a thing in it, and of that thing what is near to that.
        around = _along(self._around_guest.grown(within_m), way, sweep)
        host_columns = host.boxes.meeting(around, host_only)
        if not len(host_columns):
            return
        resting = host.boxes.some(host_columns)
        reach = _along(resting.hull().common(around).grown(within_m), -way, sweep)
        back = self._rotation.T
        guest_columns = guest.boxes.meeting(_turned_box(reach, back, -(back @ self._position)), guest_only)
        if not len(guest_columns):
            return
        corners = turned(self._rotation, guest.triangles.take(guest_columns, axis=2))
        corners += self._position[:, None]
        moving = _along(boxes_of(corners).grown(within_m), way, sweep)
        if not are_few(moving, resting):
            closer = resting.meeting(moving.hull())
            if not len(closer):
                return
            host_columns, resting = host_columns[closer], resting.some(closer)
            again = moving.meeting(resting.hull())
            guest_columns, moving, corners = guest_columns[again], moving.some(again), corners.take(again, axis=2)
        for i, j in box_pairs(moving, resting):
            if len(i):
                yield Near(guest_columns[i], host_columns[j], corners, i, host)


def _turned_box(box: Boxes, rotation: Floats, position: Floats) -> Boxes:
    """The box around a single one in another frame, in which a point is its turned self plus `position` (3, 1)."""
    middle, half = rotation @ ((box.low + box.high) / 2) + position, np.abs(rotation) @ ((box.high - box.low) / 2)
    return Boxes(middle - half, middle + half)


def _along(boxes: Boxes, way: Floats, sweep: bool) -> Boxes:
    return boxes.swept(way) if sweep else Boxes(boxes.low + way[:, None], boxes.high + way[:, None])


class Nearest:
    """Pairs in batches, a few to begin with, those first that may be nearest, so that what is found of these may leave
    all others out of reach.

    Parameters: least_m : (n,) how far the two of each pair are apart at least [m].
    """

    def __init__(self, least_m: Floats) -> None:
        self._least_m, self._left = least_m, np.arange(len(least_m))
        self._n = _FIRST

    def next(self, within_m: float) -> Indices | None:
        """The next pairs within reach, None if there are no more."""
        left = self._left[self._least_m.take(self._left) <= within_m]
        if len(left) > self._n:
            order = np.argpartition(self._least_m.take(left), self._n)
            left, self._left = left[order[: self._n]], left[order[self._n :]]
        else:
            self._left = left[:0]
        self._n = min(8 * self._n, _BATCH)
        return left if len(left) else None
