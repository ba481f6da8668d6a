"""Nodes that engines do not draw, by their names: collision shapes, and lower levels of detail.

Formats without a field for these use names. A collision shape is larger than its object and would be felt in its place.
Levels of detail are copies of one thing at one place, of which an engine draws one.

Source: Unreal Engine, "FBX static mesh pipeline" (`UCX_`); Godot, "Node type customization" (`-colonly`); Unity, "Level
of detail" (`_LOD0`).
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import replace

from scene2hap.scene.tree import AuthoredNode

# A word begins at the name's start, after a separator, or as in "TableCollider". Blender adds ".001".
_BEGINS = r"(?:^|.*[ ._$-]|.*(?-i:(?<=[a-z0-9])(?=[A-Z])))"
_COLLISION_SHAPE = re.compile(
    r"(?-i:U(?:CX|BX|CP|SP)|MCDCX)_.*"
    rf"|{_BEGINS}(?:(?:conv)?colonly|occonly|navmesh|noimp"
    r"|(?:box|mesh|sphere|capsule|convex)?[ _-]?(?:colliders?|collisions?)"
    r"(?:[ _-]?(?:mesh(?:es)?|hulls?|box(?:es)?|shapes?|geo|geom|geometry))?)(?:[ ._-]?\d+)?(?:\.\d+)?",
    re.IGNORECASE,
)
_LEVEL = re.compile(r"(.*?)(?:^|[ ._-]|(?-i:(?<=[a-z0-9])(?=LOD)))lod[ ._-]?(\d{1,2})(?:[ ._(-].*)?", re.IGNORECASE)


def without_undrawn(roots: Sequence[AuthoredNode], kept: Collection[str] = ()) -> list[AuthoredNode]:
    """Return the nodes without collision shapes and without all but the finest level of detail.

    Nodes named in `kept` stay. All nodes stay in a scene, or in an object that the file declares, which would lose its
    last mesh: a robot's link may have only collision shapes.
    """
    return _drawn(None, roots, frozenset(kept)) or list(roots)


def _drawn(above: AuthoredNode | None, nodes: Sequence[AuthoredNode], kept: frozenset[str]) -> list[AuthoredNode]:
    finest = _finest_levels(above, nodes)
    found = []
    for node in nodes:
        if _is_undrawn(node, finest) and not any(each.name in kept for each in node.walk()):
            continue
        children = _drawn(node, node.children, kept)
        if children or node.pieces:
            found.append(replace(node, children=tuple(children)))
        elif node.is_object:
            found.append(node)
    return found


def _is_undrawn(node: AuthoredNode, finest: dict[str, int]) -> bool:
    if node.is_object:
        return False
    level = _LEVEL.fullmatch(node.name)
    return bool(_COLLISION_SHAPE.fullmatch(node.name)) or (level is not None and int(level[2]) > finest[level[1]])


def _finest_levels(above: AuthoredNode | None, nodes: Sequence[AuthoredNode]) -> dict[str, int]:
    """Return the lowest number of each series `NAME_LOD<number>`. A node `NAME`, also above them, is number 0."""
    finest: dict[str, int] = {}
    for node in nodes:
        if level := _LEVEL.fullmatch(node.name):
            finest[level[1]] = min(int(level[2]), finest.get(level[1], 99))
    if finest:
        plain = {node.name for node in nodes}
        if above is not None and above.pieces:
            plain |= {above.name, ""}
        finest |= dict.fromkeys(plain & finest.keys(), 0)
    return finest
