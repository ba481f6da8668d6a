"""Split a group that holds several separate items, such as a pot with its lid and two cups under one node.

A member of a group is an *item* if its name has a head noun of its own that names no part. Under `tea_set`,
`tea_set_cup` is an item; `tea_set_lid` (a part), `tea_set_mat_0` (a material) and `tea_set_2` (a number) are not. A
group is a collection if the bounding boxes of its items form two or more separate sets. Then every item becomes an
object, and every other member belongs to the nearest item: the lid to its pot. A table with its legs and a hob with its
burners have no separate items, and stay one object.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.scene import limits
from scene2hap.scene.geometry import Bounds, bounds_of, distances, joined
from scene2hap.scene.names import has_own_noun
from scene2hap.scene.tree import Matrix, Piece

# Two items are separate if the gap exceeds this share of the group's diagonal (assumed).
_APART = 0.002


@dataclass(frozen=True, eq=False)
class Member:
    """A node's own pieces in a group: `frame` is its world transform."""

    name: str
    frame: Matrix
    pieces: tuple[Piece, ...]

    @cached_property
    def box(self) -> Bounds:
        """Lowest and highest corner (2, 3) in the world [file unit]."""
        points = np.concatenate([piece.vertices for piece in self.pieces]) @ self.frame[:3, :3].T + self.frame[:3, 3]
        return bounds_of(points)


def split(group_name: str, members: Sequence[Member]) -> list[list[Member]]:
    """Return one list of members for each object; the first member names it. One list for all if no collection."""
    some = [member for member in members if any(len(piece.vertices) for piece in member.pieces)]
    items = [member for member in some if member.name == group_name or has_own_noun(member.name, group_name)]
    if not stand_apart(some, items):
        return [list(members)]
    limits.at_most(f"the number of items in the group {group_name[:80]!r}", len(items), "MAX_OBJECTS")
    found = [[item] for item in items]
    boxes = _boxes(items)
    is_item = {id(item) for item in items}
    for member in some:
        if id(member) not in is_item:
            found[int(distances(boxes, member.box).argmin())].append(member)
    return found


def stand_apart(members: Sequence[Member], items: Sequence[Member], *, gap: float = _APART) -> bool:
    """Return True if the boxes of the items form at least two separate sets.

    Two boxes are separate if the distance between them exceeds `gap`, a share of the diagonal of all members.
    """
    if len(items) < 2:
        return False
    reach = gap * float(np.linalg.norm(np.ptp(joined(_boxes(members)), axis=0)))
    boxes = _boxes(items)
    # Sorted along the longest axis: only a range of the boxes can be near to one, or a long row would cost n^2.
    axis = int(np.ptp(joined(boxes), axis=0).argmax())
    boxes = boxes[boxes[:, 0, axis].argsort()]
    low, high = boxes[:, 0, axis], boxes[:, 1, axis]
    wide = reach + 1e-9 * float(np.abs(boxes).max())  # by rounding, a sum and a difference disagree
    firsts, lasts = np.searchsorted(low, [low - (high - low).max() - wide, high + wide])
    linked, is_left = [0], np.arange(len(boxes)) > 0
    for one in linked:
        first = int(firsts[one])
        within = np.flatnonzero(is_left[first : int(lasts[one])]) + first
        near = within[distances(boxes[within], boxes[one]) <= reach]
        is_left[near] = False
        linked += near.tolist()
    return len(linked) < len(boxes)


def _boxes(members: Sequence[Member]) -> Floats:
    """Return the boxes (n, 2, 3) in the world."""
    return np.array([member.box for member in members])
