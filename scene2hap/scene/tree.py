"""The authored scene graph of any file format: nodes, transforms and meshes."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common.arrays import Floats, Ints, Ints32
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene.looks.appearance import Appearance
from scene2hap.scene.objects import UpAxis

Matrix = NDArray[np.float64]
"""A (4, 4) affine transform of column vectors; its last row is (0, 0, 0, 1)."""


@dataclass(frozen=True, eq=False)
class Piece:
    """Triangles of one material, in the frame of the node that draws them.

    Parameters: key : equal for instances, which are read from one place in the file; vertices : (n, 3) float64 in the
        file's unit, finite, all used by faces; faces : (m, 3) int32; material : its name in the file;
        appearance : looks of the m faces, None if unknown; is_made : True if the file holds only a few numbers, such as
        a radius, and no vertices.
    """

    key: Hashable
    vertices: Floats
    faces: Ints32
    material: str = ""
    appearance: Appearance | None = None
    is_made: bool = False

    @property
    def paint(self) -> str:
        """A text that is equal for materials of equal name and looks."""
        return self.material if self.appearance is None else f"{self.material} {self.appearance.digest}"

    @cached_property
    def reach(self) -> float:
        """The largest coordinate [file unit]."""
        return float(np.abs(self.vertices).max(initial=0.0))

    @cached_property
    def extent(self) -> float:
        """The longest edge of its box [file unit]; 0 without vertices."""
        return float(np.ptp(self.vertices, axis=0).max()) if len(self.vertices) else 0.0

    @classmethod
    def checked(cls, key: Hashable, vertices: ArrayLike, faces: ArrayLike, material: str, place: str) -> Piece:
        """Return a piece without the vertices that no face uses.

        Raises: SceneFormatError: a face refers to a vertex that does not exist. SceneError: a vertex is not finite.
        Both messages name `place`, the node or mesh at fault.
        """
        points = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
        corners = np.asarray(faces).reshape(-1, 3)
        lowest, highest = (int(corners.min()), int(corners.max())) if corners.size else (0, -1)
        if lowest < 0 or highest >= len(points):
            wrong = lowest if lowest < 0 else highest
            raise SceneFormatError(f"{place}: a face uses vertex {wrong}; there are {len(points)} (from 0).")
        used, renumbered = _used(corners, len(points))
        compact = points[used]
        if not np.isfinite(compact).all():
            row = int(used[np.flatnonzero(~np.isfinite(compact).all(axis=1))[0]])
            raise SceneError(f"{place}: vertex {row} is {points[row].tolist()}; every coordinate must be finite.")
        return cls(key, compact, renumbered.reshape(-1, 3).astype(np.int32), material)


def _used(corners: NDArray[np.integer], n_points: int) -> tuple[Ints, Ints]:
    """Return the vertices that corners use, in order, and the corners as indices of these vertices.

    The time grows with the corners, not with the table: thousands of pieces may share one table of vertices.
    """
    if corners.size < n_points // 8:
        used, renumbered = np.unique(corners, return_inverse=True)
        return used.astype(np.int64), renumbered
    is_used = np.zeros(n_points, dtype=bool)
    is_used[corners] = True
    return np.flatnonzero(is_used), (np.cumsum(is_used) - 1)[corners]


@dataclass(frozen=True, eq=False)
class AuthoredNode:
    """A node of the author's tree: `matrix` places it in its parent; `name` is empty if the author gave none.

    `is_object` : True if the file declares that the node, with all nodes below it, is one object. `mass_kg` is the mass
        of this object in the file [kg], None if the file has none. `key` is the name by which pivots know the
        node, unique in the file; empty if none does.
    """

    name: str
    matrix: Matrix
    pieces: tuple[Piece, ...] = ()
    children: tuple[AuthoredNode, ...] = ()
    is_object: bool = False
    mass_kg: float | None = None
    key: str = ""

    def walk(self) -> Iterator[AuthoredNode]:
        """Yield the node and all nodes below it, in file order."""
        yield self
        for child in self.children:
            yield from child.walk()

    @property
    def n_triangles(self) -> int:
        """The number of triangles of the node and all nodes below it."""
        return sum(len(piece.faces) for node in self.walk() for piece in node.pieces)

    def with_geometry(self) -> AuthoredNode | None:
        """Return the node without parts that draw nothing (cameras, lights, curves); None if none is left."""
        children = tuple(kept for child in self.children if (kept := child.with_geometry()) is not None)
        pieces = tuple(piece for piece in self.pieces if len(piece.faces))
        if not children and not pieces:
            return None
        return replace(self, pieces=pieces, children=children)


@dataclass(frozen=True, eq=False)
class AuthoredPivot:
    """A joint by which one node is held on another, both given by their keys: a point (3,) of the axis in the scene's
    unit, None if the node is fixed; and the axis (3,), None for a ball."""

    key: str
    on: str
    anchor: Floats | None = None
    axis: Floats | None = None


@dataclass(frozen=True)
class AuthoredScene:
    """The top nodes of a scene, with the file's axes and units.

    `unit_m` is None if the format does not define the unit, or if its files often declare a wrong one. `left_out` has a
    sentence for each texture that could not be used. `pivots` are the joints by which objects hold others.
    """

    roots: tuple[AuthoredNode, ...]
    up_axis: UpAxis = "y"
    unit_m: float | None = None
    left_out: tuple[str, ...] = ()
    pivots: tuple[AuthoredPivot, ...] = ()

    def metres_per_unit(self, file_name: str) -> float:
        """Return the file's unit [m], 1 if it has none. Raises: SceneFormatError: the unit is not above 0."""
        if self.unit_m is None:
            return 1.0
        if not 0.0 < self.unit_m < np.inf:
            raise SceneFormatError(
                f"{file_name!r} has {self.unit_m:g} metres per unit; it must be above 0. Correct it, or give unit_m."
            )
        return self.unit_m


def transform(linear: Floats, position: ArrayLike) -> Matrix:
    """Return the (4, 4) matrix of a linear map (3, 3) and a position (3,)."""
    matrix: Matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = linear, position
    return matrix


def rigid_part(matrix: Matrix) -> Matrix:
    """Return the rotation and translation of an affine matrix, without scale, shear and mirroring.

    L = Q P with Q orthogonal and P symmetric (polar decomposition). If Q mirrors, its x axis is flipped, so that an
    upright object stays upright.
    """
    left, _, right = np.linalg.svd(matrix[:3, :3])
    rotation = left @ right
    if np.linalg.det(rotation) < 0:
        rotation = rotation * [-1.0, 1.0, 1.0]
    return transform(rotation, matrix[:3, 3])


def with_own_keys(roots: Sequence[AuthoredNode], file: Hashable) -> tuple[AuthoredNode, ...]:
    """Return the nodes of a file with keys of pieces that no other file has. A piece that nodes share stays shared."""
    seen: dict[int, Piece] = {}

    def own(piece: Piece) -> Piece:
        if id(piece) not in seen:
            seen[id(piece)] = replace(piece, key=(file, piece.key))
        return seen[id(piece)]

    def copied(node: AuthoredNode) -> AuthoredNode:
        return replace(node, pieces=tuple(map(own, node.pieces)), children=tuple(map(copied, node.children)))

    return tuple(map(copied, roots))
