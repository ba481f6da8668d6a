"""Grouping of an authored tree's nodes into objects that a user would point at.

Authors do not mark objects. Exporters split one mesh by material into several leaves, put objects into groups and add
their own nodes above. The rule "authored" undoes this. A mesh that a tool has cut by material is first made whole again
(`grouping.material_parts`). Collision shapes and lower levels of detail are left out by their names
(`grouping.not_drawn`), except by "leaf". Then:

a. A node with a mesh of its own is an object. Its leaf children with meshes (a door, a drawer, a lid) are part of it. A
   child that has children is an object by itself, as is a leaf with a noun of its own outside the node's box: a mug
   that stands on its table. Below the mesh of a place, a wall, a floor or a ceiling every leaf is one that has a
   noun, but for tiles, panels and the like.
b. A node without a mesh, and its leaf children without names or with names that begin with the node's name, are one
   object: `Cooktop` with `Cooktop_Burner_mat`. So are its children below which all names say nothing (`cube` over
   `mesh_geom`) or name parts (`seat`, `leg`, `door` over `handle`), if they are joined: prefabs, instanced collections
   and components. Rules (a) to (d) apply to all other children, such as the knobs `Controller` below `Cooktop`.
c. A node without a mesh that contains only one object, directly or through other such nodes, gives that object its name
   and place (`washing_machine` over `washer(Clone)`). The name of the outermost such node is used. Names that exporters
   give to their own nodes (`RootNode`, `Sketchfab_model`, `kitchen.fbx`) and names of places (`house`) are never used,
   and names that say nothing (`pivot`, `entity`) only in the place of another such name. Nor is an abbreviation of the
   object's own name (`bsktball` over `basketball`).
d. Every other node without a mesh is a container; its children are grouped one by one.
e. An object by (a) or (b) is split if it is a collection of separate items (`grouping.split`): a pot, two cups and
   their saucers, but not a table with its legs.
f. A node that the file itself declares an object (`AuthoredNode.is_object`) is one object with all nodes below it.
"""

from __future__ import annotations

import math
import operator
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from scene2hap.common import checks
from scene2hap.errors import SceneError
from scene2hap.scene.grouping.loose_parts import loose_parts
from scene2hap.scene.grouping.material_parts import rejoined
from scene2hap.scene.grouping.not_drawn import without_undrawn
from scene2hap.scene.grouping.split import Member, split, stand_apart
from scene2hap.scene.names import (
    abbreviates,
    names_a_place,
    names_a_thing,
    names_another_thing,
    names_part,
    names_structure,
    names_thing_in,
    says_nothing,
)
from scene2hap.scene.tree import AuthoredNode, Matrix, Piece

Grouping = Literal["authored", "leaf", "loose"] | int | Mapping[str, str]
"""The rule by which nodes become objects.

"authored": the rule above. "leaf": every node with a mesh is an object. "loose": every connected surface of a mesh is
an object, for rooms that were merged into one mesh. An int from 0: every node at that depth below the scene is one
object with all nodes below it; the scene's own nodes have depth 1, and each mesh above is an object. The depth 0 is the
scene itself: the whole file is one object, with the name of the file. A mapping from a node's name to an object's name:
that node and all below it belong to that object, and nodes mapped to one name make one object; the rest of the scene
follows "authored".
"""

# Parts of one object are at most this share of the object's diagonal apart: authors leave gaps around doors and valves
# (tuned: of 673 models by other people, 0.002 leaves 10 apart that 0.01 joins; none of them is several things).
_PART_GAP = 0.01


@dataclass(frozen=True, eq=False)
class Group:
    """The pieces of one object, each with its own world transform.

    `frame` is the world transform of the node that names the object. `mass_kg` is the object's mass in the file [kg],
    None if the file has none. `key` is the key of that node.
    """

    name: str
    frame: Matrix
    parts: tuple[tuple[Matrix, Piece], ...]
    mass_kg: float | None = None
    key: str = ""


def check_grouping(how: object) -> None:
    """Check that `how` is one of the forms of `Grouping`. Raises: SceneError: it is not."""
    is_rule = isinstance(how, str) and how in ("authored", "leaf", "loose")
    is_depth = isinstance(how, int) and not isinstance(how, bool) and how >= 0
    is_table = isinstance(how, Mapping) and all(isinstance(name, str) for pair in how.items() for name in pair)
    if not (is_rule or is_depth or is_table):
        raise SceneError(
            f"group is {checks.represented(how)}; it must be 'authored', 'leaf', 'loose', a depth from 0, or a mapping "
            "of node names to object names."
        )


def group_objects(roots: Sequence[AuthoredNode], how: Grouping = "authored", *, scene_name: str = "") -> list[Group]:
    """Return the objects of a scene in file order. `scene_name` names the object of depth 0.

    Raises: SceneError: `how` is none of the forms of `Grouping`, or names a node that the scene does not have.
    """
    check_grouping(how)
    kept = [node for root in roots if (node := root.with_geometry()) is not None]
    if how != "leaf":
        kept = without_undrawn(kept, how if isinstance(how, Mapping) else ())
    origin = np.eye(4)
    if how == "authored":
        return [group for root in kept for group in _authored(rejoined(root), origin).groups]
    if isinstance(how, Mapping):
        return _mapped(kept, how)
    depth = how if isinstance(how, int) else math.inf
    groups = _at_depth(AuthoredNode(scene_name, origin, children=tuple(kept)), origin, depth)
    return list(_loose(groups) if how == "loose" else groups)


def unique_ids(names: Sequence[str]) -> list[str]:
    """Return an id for each name: the name itself at its first occurrence, then `name#2`, `name#3`, ..."""
    given = [name.strip() or "object" for name in names]
    written = set(given)
    used: Counter[str] = Counter()
    ids = []
    for name in given:
        used[name] += 1
        candidate = name
        while used[name] > 1:
            candidate = f"{name}#{used[name]}"
            # A generated id must differ from every name that an author wrote.
            if candidate not in written:
                break
            used[name] += 1
        ids.append(candidate)
    return ids


# -- authored --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Subtree:
    """The objects at and below a node. `has_head`: the first object is the node itself, possibly under another name."""

    groups: list[Group]
    has_head: bool


def _authored(node: AuthoredNode, above: Matrix) -> _Subtree:
    frame = above @ node.matrix
    if node.is_object:
        return _Subtree(
            [Group(node.name, frame, tuple(_all_parts(node, above)), node.mass_kg, node.key)], has_head=True
        )
    members = [Member(node.name, frame, node.pieces)] if node.pieces else []
    base = Member(node.name, np.eye(4), node.pieces) if node.pieces else None
    joined = _joined_parts(node, frame)
    is_joined = frozenset(joined)
    below = []
    for child in node.children:
        if _is_part(child, node) and not (base and _is_thing_beside(child, base)):
            members.append(Member(child.name, frame @ child.matrix, child.pieces))
        elif child not in is_joined:
            below.append(_authored(child, frame))
    members += [member for child in joined for member in _members(child, frame)]
    others = [group for subtree in below for group in subtree.groups]
    if members:
        several = split(node.name, members)
        if len(several) == 1:
            mass_kg = None if others else node.mass_kg
            return _Subtree([Group(node.name, frame, _parts(members), mass_kg, node.key), *others], has_head=True)
        items = [Group(item[0].name, item[0].frame, _parts(item)) for item in several]
        return _Subtree([*items, *others], has_head=bool(node.pieces))
    if len(below) == 1 and below[0].has_head:
        own = others[0].name
        is_worse = says_nothing(node.name) or abbreviates(node.name, own)
        if names_a_thing(node.name) and (says_nothing(own) or not is_worse):
            others[0] = replace(others[0], name=node.name, frame=frame)
        if node.mass_kg is not None and len(others) == 1:
            others[0] = replace(others[0], mass_kg=node.mass_kg)
        return _Subtree(others, has_head=True)
    return _Subtree(others, has_head=False)


def _parts(members: Sequence[Member]) -> tuple[tuple[Matrix, Piece], ...]:
    return tuple((member.frame, piece) for member in members for piece in member.pieces)


def _is_part(child: AuthoredNode, node: AuthoredNode) -> bool:
    if child.children:
        return False
    if node.pieces:
        return True
    return names_a_thing(node.name) and (not child.name or _continues(child.name, node.name))


def _is_thing_beside(child: AuthoredNode, own: Member) -> bool:
    """Return True if a leaf is a thing that the author put on another, as a mug on a table: it has a noun of its own,
    and is outside the box of the other's own mesh. Both boxes are along the axes of the node.

    The box of a room holds all its furniture, and a wall has doors and shelves: these are things by their noun alone.
    """
    if _continues(child.name, own.name):
        return False
    if names_structure(own.name) or names_a_place(own.name):
        return names_thing_in(child.name, own.name)
    if not names_another_thing(child.name, own.name):
        return False
    (low, high), (own_low, own_high) = Member(child.name, child.matrix, child.pieces).box, own.box
    slack = _PART_GAP * float(np.linalg.norm(own_high - own_low))
    return bool((low >= own_high - slack).any() or (high <= own_low + slack).any())


def _joined_parts(node: AuthoredNode, frame: Matrix) -> list[AuthoredNode]:
    """Return the children below which no name is that of a thing, if they are joined.

    A group with walls or a floor joins none: a door in a wall is a thing. Below a node with a mesh of its own, a part
    with children is another object, as by rule (a). A single child with the name of a part keeps its name.
    """
    if node.pieces or not names_a_thing(node.name) or any(names_structure(x.name) for x in node.children):
        return []
    has_own_mesh = any(_is_part(child, node) for child in node.children)
    found = [child for child in node.children if _is_no_thing(child, node, has_own_mesh)]
    if len(found) == 1 and not says_nothing(found[0].name):
        return []
    members = [member for child in found for member in _members(child, frame)]
    if stand_apart(members, members, gap=_PART_GAP):
        return []
    # By name, since Blender writes the children of each copy into USD in another order.
    return sorted((child for child in found if not _is_part(child, node)), key=lambda child: child.name)


def _is_no_thing(child: AuthoredNode, node: AuthoredNode, has_own_mesh: bool) -> bool:
    may_be_part = not (child.children and has_own_mesh)
    return all(
        not each.is_object and (says_nothing(each.name) or (may_be_part and names_part(each.name, node.name)))
        for each in child.walk()
    )


def _members(node: AuthoredNode, above: Matrix) -> list[Member]:
    return [Member("", frame, (piece,)) for frame, piece in _all_parts(node, above)]


def _continues(name: str, start: str) -> bool:
    """Return True if `name` continues `start`: `Table_mat_0`, `Table.001`, `tableTop`, not `Tablet` after `Table`."""
    return name.startswith(start) and not name[len(start) :][:1].islower()


# -- the other groupings ---------------------------------------------------------------------------------------------


def _loose(leaves: Iterable[Group]) -> Iterator[Group]:
    # Copies share their pieces, so that each mesh is taken apart once.
    known: dict[tuple[int, ...], list[tuple[Piece, ...]]] = {}
    for leaf in leaves:
        pieces = [piece for _, piece in leaf.parts]
        which = tuple(map(id, pieces))
        if which not in known:
            known[which] = loose_parts(leaf.name, pieces)
        found = known[which]
        for part in found:
            mass_kg = leaf.mass_kg if len(found) == 1 else None
            yield Group(leaf.name, leaf.frame, tuple((leaf.frame, piece) for piece in part), mass_kg)


def _at_depth(node: AuthoredNode, above: Matrix, depth: float) -> Iterator[Group]:
    """Yield one group for each node at a depth below the node, and one for each mesh above that depth."""
    frame = above @ node.matrix
    is_whole = depth == 0 or not node.children
    parts = tuple(_all_parts(node, above)) if is_whole else tuple((frame, piece) for piece in node.pieces)
    if parts:
        yield Group(node.name, frame, parts, node.mass_kg if is_whole else None, node.key)
    for child in () if is_whole else node.children:
        yield from _at_depth(child, frame, depth - 1)


def _all_parts(node: AuthoredNode, above: Matrix) -> Iterator[tuple[Matrix, Piece]]:
    frame = above @ node.matrix
    for piece in node.pieces:
        yield frame, piece
    for child in node.children:
        yield from _all_parts(child, frame)


def _mapped(roots: Sequence[AuthoredNode], names: Mapping[str, str]) -> list[Group]:
    known = {node.name for root in roots for node in root.walk()}
    for wanted in names:
        if wanted not in known:
            hint = checks.did_you_mean(wanted, sorted(known), "Names are those that the author wrote.")
            raise SceneError(f"group maps the node {wanted!r}, which the scene does not have. {hint}")
    objects: dict[str, Group] = {}
    parts: dict[str, list[tuple[Matrix, Piece]]] = {}

    def take(node: AuthoredNode, above: Matrix, around: str | None) -> AuthoredNode:
        """Move the mapped pieces at and below `node` to their objects. Returns the node without these pieces.

        `around` is the object of the parent. An object has the mass of its node if it is the whole node and no more.
        """
        frame = above @ node.matrix
        owner = names.get(node.name, around)
        if owner is not None:
            if owner != around:
                for other in objects.keys() & {owner, around}:
                    objects[other] = replace(objects[other], mass_kg=None)
                objects.setdefault(owner, Group(owner, frame, (), node.mass_kg, node.key))
            parts.setdefault(owner, []).extend((frame, piece) for piece in node.pieces)
        children = tuple(take(child, frame, owner) for child in node.children)
        if owner is not None:
            return replace(node, pieces=(), children=())
        is_whole = all(map(operator.is_, children, node.children))
        return node if is_whole else replace(node, children=children, mass_kg=None)

    rest = [take(root, np.eye(4), None) for root in roots]
    found = [replace(group, parts=tuple(parts[name])) for name, group in objects.items() if parts[name]]
    return [*found, *group_objects(rest)]
