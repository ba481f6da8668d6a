"""Nodes that no viewer shows: collision shapes, lower levels of detail, and nodes without size.

Formats without a field for the first two use names. A collision shape is larger than its object and would be felt in
its place. Levels of detail are copies of one thing at one place, of which an engine draws one. Nodes without size have
scale 0, by which games and editors hide objects, or all vertices in one point, which are left in files by mistake.

Source: Unreal Engine, "FBX static mesh pipeline" (`UCX_`); Godot, "Node type customization" (`-colonly`); Unity, "Level
of detail" (`_LOD0`).
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from scene2hap.common.counted import counted, first_of
from scene2hap.common.warning import warn_of
from scene2hap.scene.tree import AuthoredNode, Matrix

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
_SHOWN = 5  # nodes that a warning lists
# Smaller than the unit of any file by far, and above the rounding of single precision at small coordinates [file unit].
_NO_SIZE = 1e-9


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


def without_collapsed(roots: Sequence[AuthoredNode]) -> tuple[list[AuthoredNode], list[str]]:
    """Return the nodes without those of scale 0, with all below, and without meshes in one point; and their names.

    Nodes and pieces that stay are the given ones. A mesh keeps all its pieces if any has a size.
    """
    names: list[str] = []

    def kept(node: AuthoredNode, above: Matrix) -> AuthoredNode | None:
        with np.errstate(all="ignore"):  # the transforms of a broken file may overflow, which is refused later
            frame = above @ node.matrix
            scale = float(np.abs(frame[:3, :3]).max())
            is_point = bool(node.pieces) and all(scale * piece.extent <= _NO_SIZE for piece in node.pieces)
        if scale <= _NO_SIZE or (is_point and not node.children):
            if node.with_geometry() is not None:
                names.append(node.name)
            return None
        children = [kept(child, frame) for child in node.children]
        left = tuple(child for child in children if child is not None)
        if is_point:
            names.append(node.name)
            return replace(node, pieces=(), children=left)
        is_whole = len(left) == len(children) and all(a is b for a, b in zip(left, node.children, strict=True))
        return node if is_whole else replace(node, children=left)

    return [node for root in roots if (node := kept(root, np.eye(4))) is not None], names


def warn_of_collapsed(scene_name: str, names: Sequence[str]) -> None:
    """Warn of the nodes that `without_collapsed` left out, if there are any."""
    if names:
        shown = first_of([repr(name) if name else "one without a name" for name in names], _SHOWN)
        warn_of(
            f"{scene_name!r} is read without {counted(len(names), 'node')} that no viewer shows (scale 0, or all "
            f"vertices in one point): {shown}. Give a size to what should be felt."
        )
