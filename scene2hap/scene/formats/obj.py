"""Wavefront OBJ files as authored trees: one node for each `o`, or for each `g` if a file has no `o`.

We do not use trimesh's reader (5.2). It merges objects of one name and returns them in reverse order. It counts
negative vertex numbers from the end of the file instead of from the current line.

Source: Wavefront, Advanced Visualizer manual (1990s), appendix B1, "Object files".
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.common.checks import represented
from scene2hap.errors import SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.mtl import MtlLibraries, without_comment
from scene2hap.scene.formats.polygons import triangulated
from scene2hap.scene.looks.texture_files import TextureFiles
from scene2hap.scene.tree import AuthoredNode, AuthoredScene, Piece

_SHIFT = 32


@dataclass
class _Faces:
    """Polygons: the corners of all, and how many each has.

    A corner is packed into one number for speed: vertex number from 0, shifted, plus coordinates number. Coordinates
    are counted from 1; 0 stands for none.
    """

    corners: list[int] = field(default_factory=list)
    counts: list[int] = field(default_factory=list)

    def add(self, polygon: list[int]) -> None:
        self.corners += polygon
        self.counts.append(len(polygon))


@dataclass
class _Part:
    """Faces under one `o` or `g` by material, in the order of first use."""

    name: str
    faces: dict[str, _Faces] = field(default_factory=dict)


def read_obj(text: str, name: str, textures: TextureFiles) -> AuthoredScene:
    """Return the objects of an OBJ text; `name` is for faces outside any object.

    Raises: SceneFormatError: a vertex or face is not made of numbers, or a face uses a vertex that does not exist; the
    message gives the line.
    """
    vertices: list[tuple[float, float, float]] = []
    coordinates: list[tuple[float, float]] = []
    libraries = MtlLibraries(textures)
    objects, groups = [_Part(name)], {name: _Part(name)}
    material, group = "", name
    into_object: _Faces | None = None
    into_group: _Faces | None = None
    size = limits.TreeSize()
    for number, keyword, rest in _statements(text):
        if keyword == "v":
            vertices.append(_vertex(rest, number))
        elif keyword == "f":
            if into_object is None or into_group is None:
                into_object = objects[-1].faces.setdefault(material, _Faces())
                into_group = groups.setdefault(group, _Part(group)).faces.setdefault(material, _Faces())
            polygon = _polygon(rest, len(vertices), len(coordinates), number)
            # Exporters write an edge as a face of two corners.
            if len(polygon) > 2:
                into_object.add(polygon)
                into_group.add(polygon)
                size.add_triangles(len(polygon) - 2)
        elif keyword == "vt":
            coordinates.append(_coordinates(rest))
        elif keyword == "mtllib":
            libraries.read(rest)
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
    # The first row is for corners without coordinates.
    uv = np.array([(0.0, 0.0), *coordinates], dtype=np.float64)
    nodes = tuple(_node(i, part, points, uv, libraries) for i, part in enumerate(parts) if part.faces)
    return AuthoredScene(nodes, left_out=textures.left_out)


def _node(number: int, part: _Part, points: Floats, uv: Floats, libraries: MtlLibraries) -> AuthoredNode:
    pieces = []
    for key, faces in part.faces.items():
        packed, counts = np.array(faces.corners, dtype=np.int64), np.array(faces.counts, dtype=np.int64)
        corners = packed[triangulated(points, counts, packed >> _SHIFT)[0]]
        piece = Piece.checked((number, key), points, corners >> _SHIFT, key, f"object {part.name!r}")
        if (material := libraries.materials.get(key)) is not None:
            mapped = corners & ((1 << _SHIFT) - 1)
            looks = material.appearance(len(corners), uv[mapped] if mapped.any() else None)
            piece = replace(piece, appearance=looks)
        pieces.append(piece)
    return AuthoredNode(part.name, np.eye(4), tuple(pieces))


def _statements(text: str) -> Iterator[tuple[int, str, str]]:
    """Yield line number, keyword and the rest of each statement."""
    # Lines are joined once per statement, since one statement may have a hundred thousand lines.
    continued: list[str] = []
    for number, line in enumerate(text.splitlines(), start=1):
        line = without_comment(line)
        if line.endswith("\\"):
            continued.append(line[:-1])
            continue
        if continued:
            line = " ".join((*continued, line))
            continued = []
        words = line.split(None, 1)
        if words:
            yield number, words[0], words[1].strip() if len(words) > 1 else ""


def _vertex(rest: str, number: int) -> tuple[float, float, float]:
    try:
        x, y, z = map(float, rest.split()[:3])
    except ValueError as cause:
        raise SceneFormatError(
            f"line {number}: {represented(f'v {rest}')} is no vertex; it must be three numbers."
        ) from cause
    return x, y, z


def _coordinates(rest: str) -> tuple[float, float]:
    """Return texture coordinates. Invalid ones become 0: only the texture is then misplaced."""
    try:
        u, v = map(float, [*rest.split(), "0"][:2])
    except ValueError:
        return 0.0, 0.0
    return (u, v) if math.isfinite(u) and math.isfinite(v) else (0.0, 0.0)


def _polygon(rest: str, n_vertices: int, n_coordinates: int, number: int) -> list[int]:
    """Return the packed corners of a face."""
    words = rest.split()
    try:
        vertices = [int(word.partition("/")[0]) for word in words]
    except ValueError as cause:
        raise SceneFormatError(
            f"line {number}: {represented(f'f {rest}')} is no face; it must be vertex numbers."
        ) from cause
    vertices = [vertex - 1 if vertex > 0 else n_vertices + vertex for vertex in vertices]
    if not vertices or not all(0 <= vertex < n_vertices for vertex in vertices):
        raise SceneFormatError(
            f"line {number}: {represented(f'f {rest}')} must name some of the {n_vertices} vertices before it (from 1)."
        )
    corners = [vertex << _SHIFT for vertex in vertices]
    if n_coordinates:
        corners = [corner + _mapped(word, n_coordinates) for corner, word in zip(corners, words, strict=True)]
    return corners


def _mapped(word: str, n_coordinates: int) -> int:
    """Return the number of a corner's texture coordinates from 1; 0 if there are none."""
    try:
        number = int(word.split("/", 2)[1])
    except (ValueError, IndexError):
        return 0
    number = number if number >= 0 else n_coordinates + number + 1
    return number if 0 <= number <= n_coordinates else 0
