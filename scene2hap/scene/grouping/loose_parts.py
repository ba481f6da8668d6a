"""Loose parts of a mesh: its connected surfaces, as the tub, the basin and the mirror of a bathroom that was merged.

Vertices at one place count as one, since files store a vertex again for each normal, texture coordinate and material.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy

from scene2hap.common.arrays import Floats, Indices, Ints, Ints32
from scene2hap.scene import limits
from scene2hap.scene.geometry import welded
from scene2hap.scene.shapes import TriMesh
from scene2hap.scene.tree import Piece

# Positions that differ by less than this share of the largest coordinate are one place: float32 has 7 digits.
_SAME_PLACE = 1e-6


def loose_parts(name: str, pieces: Sequence[Piece]) -> list[tuple[Piece, ...]]:
    """Return the pieces of each loose part of a node's mesh, in the order of the file.

    Raises: SceneError: there are more parts than a scene may have objects; the message has the node's name.
    """
    counts = [len(piece.vertices) for piece in pieces]
    starts = np.cumsum([0, *counts[:-1]])
    faces = np.concatenate([piece.faces + start for piece, start in zip(pieces, starts, strict=True)])
    owners = part_of_faces(np.concatenate([piece.vertices for piece in pieces]), faces)
    n_parts = int(owners.max()) + 1
    if n_parts == 1:
        return [tuple(pieces)]
    limits.at_most(f"the number of loose parts of {name[:80]!r}", n_parts, "MAX_OBJECTS")
    found: list[list[Piece]] = [[] for _ in range(n_parts)]
    at = 0
    for piece in pieces:
        own = owners[at : at + len(piece.faces)]
        at += len(piece.faces)
        order = np.argsort(own, kind="stable")
        for rows in np.split(order, np.flatnonzero(np.diff(own[order])) + 1):
            found[own[rows[0]]].append(_some(piece, rows, int(own[rows[0]])))
    return [tuple(each) for each in found]


def n_loose_parts(mesh: TriMesh) -> int:
    """Return the number of loose parts of a mesh."""
    return int(part_of_faces(mesh.vertices_m, mesh.faces).max()) + 1


def part_of_faces(vertices: Floats, faces: Ints32) -> Ints:
    """Return the number of the loose part (m,) of each face; parts are numbered by their first face."""
    place = welded(vertices, _SAME_PLACE * float(np.abs(vertices).max()))
    corners = place[faces]
    pairs = np.concatenate([corners[:, :2], corners[:, 1:]])
    n = int(place.max()) + 1
    _, labels = scipy.sparse.csgraph.connected_components(
        scipy.sparse.coo_array((np.ones(len(pairs)), pairs.T), shape=(n, n)), directed=False
    )
    _, first, own = np.unique(labels[corners[:, 0]], return_index=True, return_inverse=True)
    ranks = np.empty(len(first), dtype=np.int64)
    ranks[np.argsort(first)] = np.arange(len(first))
    return ranks[own]


def _some(piece: Piece, rows: Indices, number: int) -> Piece:
    part = Piece.checked((piece.key, number), piece.vertices, piece.faces[rows], piece.material, "a loose part")
    looks = None if piece.appearance is None else piece.appearance.of_faces(rows)
    return replace(part, appearance=looks)
