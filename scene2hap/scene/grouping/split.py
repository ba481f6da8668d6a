"""Split a group that holds several separate items, such as a pot with its lid and two cups under one node.

A member of a group is an *item* if its name has a head noun of its own that names no part. Under `tea_set`,
`tea_set_cup` is an item; `tea_set_lid` (a part), `tea_set_mat_0` (a material) and `tea_set_2` (a number) are not. A
group is a collection if the bounding boxes of its items form two or more separate sets. Then every item becomes an
object, and every other member belongs to the nearest item: the lid to its pot. A table with its legs and a hob with its
burners have no separate items, and stay one object.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene import limits
from scene2hap.scene.geometry import Bounds, bounds_of, distances, joined
from scene2hap.scene.tree import Matrix, Piece

# Two boxes are separate if the gap exceeds this share of the group's diagonal (assumed).
_APART = 0.002

_PARTS = """
    arm armrest axle back backrest base basket bezel blade board body bottom bulb burner button cable cap case casing
    chain control cord corner cover cushion dial display door drawer edge eye face fan feet foot frame front glass grate
    grid grill grip handle hinge holder hood hose inlay inside interior key knob label leaf led leg lens lever lid light
    lock mirror neck outlet outside pane panel part pedal pin pipe plug pole post rack rail rim ring rod roof screen
    screw seat shade shaft shelf shell side sill spout spring stand strap strip string surface switch tail top trim tube
    valve vent wall wheel window wing wire
"""
# Words for the place or the material of a piece, or words that a program gave it.
_NO_NOUNS = """
    left right upper lower middle center centre inner outer rear small big large long short up down mat material
    mesh node object obj geo geometry geom poly polygon primitive prim surface lod collision collider cube box
    sphere cylinder plane circle cone torus default none wood metal steel chrome plastic fabric leather glass
    rubber ceramic porcelain stone marble paper black white red green blue grey gray brown yellow dark bright
    clone copy instance shape group sub model item element piece
"""
_PART_WORDS, _OTHER_WORDS = frozenset(_PARTS.split()), frozenset(_NO_NOUNS.split())


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


def has_own_noun(name: str, group_name: str) -> bool:
    """Return True if a name ends in a noun that names no part (see the module). The group's name is ignored."""
    rest = name[len(group_name) :] if name.startswith(group_name) else name
    words = [word.lower() for word in re.findall(r"[A-Z]?[^\W\d_A-Z]+|[A-Z]+(?![^\W\d_A-Z])", rest)]
    nouns = [word for word in words if len(word) > 2 and word not in _OTHER_WORDS]
    return bool(nouns) and not {nouns[-1], nouns[-1].removesuffix("s"), nouns[-1].removesuffix("es")} & _PART_WORDS


def stand_apart(members: Sequence[Member], items: Sequence[Member]) -> bool:
    """Return True if the boxes of the items form at least two separate sets. The gap is relative to all members."""
    if len(items) < 2:
        return False
    reach = _APART * float(np.linalg.norm(np.ptp(joined(_boxes(members)), axis=0)))
    boxes = _boxes(items)
    linked, left = [0], np.arange(1, len(items))
    for one in linked:
        is_near = distances(boxes[left], boxes[one]) <= reach
        linked += left[is_near].tolist()
        left = left[~is_near]
        if not len(left):
            return False
    return True


def _boxes(members: Sequence[Member]) -> NDArray[np.float64]:
    """Return the boxes (n, 2, 3) in the world."""
    return np.array([member.box for member in members])
