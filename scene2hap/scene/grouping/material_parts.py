"""Meshes that a tool has cut by material when it wrote the file again.

In glTF a mesh has one primitive for each material. trimesh, three.js and Babylon.js make a child node of each primitive
and write these nodes: `washer` becomes a node without a mesh, with `washer_8b4d74` and `washer_99b2ca` (trimesh),
`Mesh_washer` and `Mesh_washer_1` (three.js), or `washer_primitive0` and `washer_primitive1` (Babylon.js).

Such children have no children, the frame of their parent, names that differ only in a serial number, and different
materials. Separate things of one name, such as two stools, share a material or have frames of their own.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from scene2hap.scene.grouping.split import Member, stand_apart
from scene2hap.scene.names import names_a_thing
from scene2hap.scene.tree import AuthoredNode

_SERIAL = r"(?:_primitive)?[ ._-]?(?:\d+|[0-9a-f]{6})"
_ENDS_IN_SERIAL = re.compile(_SERIAL + "$")
_SERIAL_OR_NOTHING = re.compile(f"(?:{_SERIAL})?")
# Matrices that were stored as float32 differ in the seventh digit.
_SAME_FRAME = 1e-6


def rejoined(node: AuthoredNode) -> AuthoredNode:
    """Return a tree in which the mesh of each node that names a thing is whole again."""
    node = replace(node, children=tuple(rejoined(child) for child in node.children))
    cut = _primitives(node)
    if not cut:
        return node
    which = {id(child) for child in cut}
    rest = tuple(child for child in node.children if id(child) not in which)
    return replace(node, pieces=tuple(piece for child in cut for piece in child.pieces), children=rest)


def _primitives(node: AuthoredNode) -> list[AuthoredNode]:
    """Return the children that are the primitives of the node's own mesh; none if it was not cut.

    Names that do not continue the node's prove less. Then all children in the node's frame must be primitives of one
    mesh, and touch.
    """
    if node.pieces or not names_a_thing(node.name):
        return []
    found = [child for child in node.children if _may_be_primitive(child)]
    named = [child for child in found if _are_a_series([child.name], node.name)]
    if _differ_in_material(named):
        return named
    if not _differ_in_material(found):
        return []
    names = [child.name for child in found]
    shortest = min(names, key=len)
    if not any(stem and _are_a_series(names, stem) for stem in (shortest, _ENDS_IN_SERIAL.sub("", shortest))):
        return []
    members = [Member(child.name, child.matrix, child.pieces) for child in found]
    return [] if stand_apart(members, members) else found


def _may_be_primitive(node: AuthoredNode) -> bool:
    is_bare = not node.children and not node.is_object and node.mass_kg is None and len(node.pieces) == 1
    return is_bare and bool(np.abs(node.matrix - np.eye(4)).max() <= _SAME_FRAME)


def _differ_in_material(nodes: Sequence[AuthoredNode]) -> bool:
    return len(nodes) > 1 and len({node.pieces[0].paint for node in nodes}) == len(nodes)


def _are_a_series(names: Sequence[str], stem: str) -> bool:
    """Return True if each name is the stem, or continues it by a serial number only."""
    return all(name.startswith(stem) and _SERIAL_OR_NOTHING.fullmatch(name[len(stem) :]) for name in names)
