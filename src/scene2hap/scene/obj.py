"""Wavefront OBJ files as authored trees: one node for each `o`, or for each `g` where a file has no `o`.

Read here rather than by trimesh (5.2), which merges objects of one name, tells them in reverse order, and counts
negative vertex numbers from the end of the file instead of from where they stand.

Source: Wavefront, Advanced Visualizer manual (1990s), appendix B1, "Object files".
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from scene2hap.errors import SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.tree import AuthoredNode, AuthoredScene, Piece

_Faces = list[tuple[int, int, int]]


@dataclass
class _Part:
    """Faces under one `o` or `g` by material, in the order in which materials are first used."""

    name: str
    faces: dict[str, _Faces] = field(default_factory=dict)


def read_obj(text: str, name: str) -> AuthoredScene:
    """The objects of an OBJ text; `name` is for faces that stand in none.

    Materials are told apart by name; material libraries and textures are not read.
    Raises: SceneFormatError: a vertex or face is not made of numbers, or a face uses a vertex that is not there; the
    message gives the line.
    """
    vertices: list[tuple[float, float, float]] = []
    objects, groups = [_Part(name)], {name: _Part(name)}
    material, group = "", name
    into_object: _Faces | None = None
    into_group: _Faces | None = None
    n_triangles = 0
    for number, keyword, rest in _statements(text):
        if keyword == "v":
            vertices.append(_vertex(rest, number))
        elif keyword == "f":
            if into_object is None or into_group is None:
                into_object = objects[-1].faces.setdefault(material, [])
                into_group = groups.setdefault(group, _Part(group)).faces.setdefault(material, [])
            triangles = _fan(rest, len(vertices), number)
            into_object += triangles
            into_group += triangles
            n_triangles += len(triangles)
            limits.at_most("the number of triangles", n_triangles, "MAX_TRIANGLES")
        elif keyword in ("o", "g", "usemtl"):
            into_object = into_group = None
            if keyword == "o":
                objects.append(_Part(rest))
            elif keyword == "g":
                group = rest
            else:
                material = rest
    parts = objects if len(objects) > 1 else list(groups.values())
    points = np.array(vertices, dtype=np.float64).reshape(-1, 3)
    nodes = (_node(i, part, points) for i, part in enumerate(parts) if part.faces)
    return AuthoredScene(tuple(nodes))


def _node(number: int, part: _Part, points: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> AuthoredNode:
    place = f"object {part.name!r}"
    pieces = [Piece.checked((number, key), points, faces, key, place) for key, faces in part.faces.items()]
    return AuthoredNode(part.name, np.eye(4), tuple(pieces))


def _statements(text: str) -> Iterator[tuple[int, str, str]]:
    """Line number, keyword and the rest of each statement."""
    continued = ""
    for number, line in enumerate(text.splitlines(), start=1):
        line = continued + line.partition("#")[0]
        if line.endswith("\\"):
            continued = line[:-1] + " "
            continue
        continued = ""
        words = line.split(None, 1)
        if words:
            yield number, words[0], words[1].strip() if len(words) > 1 else ""


def _vertex(rest: str, number: int) -> tuple[float, float, float]:
    try:
        x, y, z = map(float, rest.split()[:3])
    except ValueError as cause:
        raise SceneFormatError(f"line {number}: 'v {rest}' is no vertex; it must be three numbers.") from cause
    return x, y, z


def _fan(rest: str, n_vertices: int, number: int) -> _Faces:
    """The triangles of a convex polygon, as vertex numbers from 0."""
    try:
        corners = [int(word.partition("/")[0]) for word in rest.split()]
    except ValueError as cause:
        raise SceneFormatError(f"line {number}: 'f {rest}' is no face; it must be vertex numbers.") from cause
    corners = [corner - 1 if corner > 0 else n_vertices + corner for corner in corners]
    if len(corners) < 3 or not all(0 <= corner < n_vertices for corner in corners):
        raise SceneFormatError(
            f"line {number}: 'f {rest}' must name three or more of the {n_vertices} vertices before it (from 1)."
        )
    return [(corners[0], b, c) for b, c in pairwise(corners[1:])]
