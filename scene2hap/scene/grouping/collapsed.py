"""Nodes without size: of scale 0, by which games and editors hide objects, or meshes all of whose vertices are in one
point, which are left in files by mistake. No viewer shows them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from scene2hap.common.counted import counted, first_of
from scene2hap.common.warning import warn_of
from scene2hap.scene.tree import AuthoredNode, Matrix, Piece

_SHOWN = 5  # nodes that a warning lists
# Smaller than the unit of any file by far, and above the rounding of single precision at small coordinates [file unit].
_NO_SIZE = 1e-9


def without_collapsed(roots: Sequence[AuthoredNode]) -> tuple[list[AuthoredNode], list[str]]:
    """Return the nodes without those of scale 0, with all below, and without meshes in one point; and their names.

    Nodes and pieces that stay are the given ones. A mesh keeps all its pieces if any has a size.
    """
    names: list[str] = []
    sizes: dict[int, float] = {}

    def size(piece: Piece) -> float:
        if id(piece) not in sizes:
            sizes[id(piece)] = float(np.ptp(piece.vertices, axis=0).max()) if len(piece.vertices) else 0.0
        return sizes[id(piece)]

    def kept(node: AuthoredNode, above: Matrix) -> AuthoredNode | None:
        with np.errstate(all="ignore"):  # the transforms of a broken file may overflow, which is refused later
            frame = above @ node.matrix
            scale = float(np.abs(frame[:3, :3]).max())
            is_point = bool(node.pieces) and all(scale * size(piece) <= _NO_SIZE for piece in node.pieces)
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
