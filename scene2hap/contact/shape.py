"""Shapes: the triangles of a mesh and the data derived from them once per mesh (boxes, features, a BVH, base faces, top
faces and ledges)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats
from scene2hap.contact.base_face import BaseFace, base_face_of, feet_m, top_of, triples, uneven_m
from scene2hap.contact.geometry.boxes import Boxes, boxes_of
from scene2hap.contact.geometry.features import Features, features_of
from scene2hap.contact.geometry.triangle_tree import TriangleTree
from scene2hap.contact.geometry.triangles import first_hits
from scene2hap.contact.geometry.vectors import Triple
from scene2hap.contact.ledge import Ledges, VerticalAxis
from scene2hap.scene.shapes import TriMesh

# Up directions for which a shape caches faces. A tumbling object has more of them, which clears the cache.
_MOST_WAYS_UP = 64
# Rays along each edge of a side of the box.
_N_RAYS = 8
_Derived = TypeVar("_Derived")


class Shape:
    """The geometry of a mesh in its own frame: triangles (3, 3, m) [m], by axis, corner and triangle; their boxes; and
    the used corners (n, 3) [m]."""

    def __init__(self, triangles: Floats, corners: Floats) -> None:
        self.triangles = triangles
        self.boxes: Boxes = boxes_of(triangles)
        self.corners = corners
        self.box: Boxes = self.boxes.hull()
        self.low: NDArray[np.float64] = self.box.low[:, 0]
        self.high: NDArray[np.float64] = self.box.high[:, 0]
        # The diagonal of the box in the shape's own frame, since a rotation would change that of the AABB.
        self.size_m: float = float(np.linalg.norm(self.high - self.low))
        self._uneven_m, self._feet_m = uneven_m(self.size_m), feet_m(self.size_m)
        self.middle: Triple = triples((self.low + self.high)[None] / 2)[0]
        self.half: Triple = triples((self.high - self.low)[None] / 2)[0]
        self._features: Features | None = None
        self._tree: TriangleTree | None = None
        self._sides: Floats | None = None
        self._base_faces: dict[Triple, BaseFace] = {}
        self._tops: dict[Triple, tuple[Triple, ...] | None] = {}
        self._ledges: dict[VerticalAxis, Ledges] = {}
        self._radii: dict[int, float] = {}

    def prepare(self) -> None:
        """Derive what contacts by triangles need, which else the first of them does. May run on another thread.

        Nothing is locked: a thread that needs the same meanwhile derives it too, with the same result.
        """
        _ = self.tree, self.sides

    @property
    def is_prepared(self) -> bool:
        """True if `prepare` has nothing left to do."""
        return self._tree is not None and self._sides is not None

    # No `cached_property`: in Python 3.11 all shapes would share its lock, and a frame that needs one shape would wait
    # for the worker that prepares another.

    @property
    def tree(self) -> TriangleTree:
        """A bounding volume hierarchy over the triangles."""
        if self._tree is None:
            self._tree = TriangleTree.over(self.triangles, self.boxes, self.features)
        return self._tree

    @property
    def features(self) -> Features:
        """The corners and edges that the narrow phase tests."""
        if self._features is None:
            self._features = features_of(self.triangles)
        return self._features

    @property
    def sides(self) -> Floats:
        """The first points of the surface that a grid of rays hits from each side of the box, (6, 64, 3) [m].

        The three lower sides come first; nan where a ray hits nothing.
        """
        if self._sides is None:
            self._sides = self._hit_sides()
        return self._sides

    def _hit_sides(self) -> Floats:
        edges = self.high - self.low
        grid = (np.arange(_N_RAYS) + 0.5) / _N_RAYS
        sides = np.empty((2, 3, _N_RAYS**2, 3))
        for axis in range(3):
            share = np.zeros((_N_RAYS**2, 3))
            share[:, (axis + 1) % 3], share[:, (axis + 2) % 3] = np.repeat(grid, _N_RAYS), np.tile(grid, _N_RAYS)
            for end in (0, 1):
                share[:, axis] = end
                # Rays start a little outside of the box, so that they surely hit a face that lies in the side.
                way = np.where(np.arange(3) == axis, (1.02 - 2.04 * end) * edges, 0.0)[None]
                start = self.low + share * edges - way / 102
                hits = first_hits(start.T, np.repeat(way.T, len(start), axis=1), self.triangles, self.boxes)
                sides[end, axis] = start + np.where(np.isfinite(hits), hits, np.nan)[:, None] * way
        return sides.reshape(6, -1, 3)

    def base_face(self, up: Triple) -> BaseFace:
        """Return the base face for the shape's direction `up`, which the caller has rounded."""
        return self._cached(
            self._base_faces, up, lambda: base_face_of(self.corners, self.triangles, self._uneven_m, self._feet_m, up)
        )

    def top(self, up: Triple) -> tuple[Triple, ...] | None:
        """Return the outline of the top face for the direction `up`, None unless it is level and convex."""
        return self._cached(self._tops, up, lambda: top_of(self.corners, self.triangles, self._uneven_m, up))

    def radius_m(self, axis: int) -> float:
        """Return the radius of the shape around the line through its box's middle along an axis [m]."""
        if axis not in self._radii:
            across = np.delete(self.corners - self.middle, axis, axis=1)
            self._radii[axis] = float(np.hypot(across[:, 0], across[:, 1]).max(initial=0.0))
        return self._radii[axis]

    def ledges(self, upright: VerticalAxis) -> Ledges:
        """Return the level faces while one of the shape's axes points up or down."""
        found = self._ledges.get(upright)
        if found is None:
            found = self._ledges[upright] = Ledges(self.triangles, self.boxes, upright, self._uneven_m)
        return found

    @staticmethod
    def _cached(known: dict[Triple, _Derived], up: Triple, derive: Callable[[], _Derived]) -> _Derived:
        if up not in known:
            if len(known) >= _MOST_WAYS_UP:
                known.clear()
            known[up] = derive()
        return known[up]


# Copies of an object and sessions over one scene share a shape, which lives as long as a body uses it.
_shapes: WeakValueDictionary[str, Shape] = WeakValueDictionary()


def shape_of(mesh: TriMesh) -> Shape:
    """Return the shape of a mesh; equal meshes share one."""
    shape = _shapes.get(mesh.digest)
    if shape is None:
        solid = _without_lines(mesh)
        triangles = np.ascontiguousarray(solid.vertices_m[solid.faces].transpose(2, 1, 0))
        shape = Shape(triangles, solid.corners_m)
        _shapes[mesh.digest] = shape
    return shape


def _without_lines(mesh: TriMesh) -> TriMesh:
    """Return the mesh without triangles that have a corner twice, unless it has no others.

    Files contain such triangles, and no surface is there. Their edges are often diagonals of a flat face, which would
    become edges of it (`features`).
    """
    corners = mesh.vertices_m[mesh.faces]
    is_line = (corners == np.roll(corners, 1, axis=1)).all(axis=2).any(axis=1)
    if is_line.all() or not is_line.any():
        return mesh
    return TriMesh(mesh.vertices_m, mesh.faces[~is_line])
