"""Groups of pieces as objects with rigid poses and measured surfaces, for files and engines.

Scale, shear and mirroring go into the vertices; instances share one mesh.
"""

from __future__ import annotations

import hashlib
from bisect import bisect_left, bisect_right
from dataclasses import dataclass, field

import numpy as np

from scene2hap.common.arrays import Floats, Ints32
from scene2hap.errors import SceneError
from scene2hap.scene import limits
from scene2hap.scene.copies import names_by_area
from scene2hap.scene.grouping.groups import Group
from scene2hap.scene.looks.appearance import Appearance, joined
from scene2hap.scene.objects import VERTICAL, SceneObject, UpAxis
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import TriMesh
from scene2hap.scene.surface.surface_cache import SurfaceCache
from scene2hap.scene.tree import Matrix, Piece, rigid_part

# Matrices that were stored as float32 differ in the seventh digit, so instances may differ by this share of their size.
_SAME_PLACE = 1e-6
# An object smaller than this [m] is a point: its surface cannot be measured (assumed; a hair is 5e-5 wide).
_MIN_EXTENT_M = 1e-9
# Vertices are rounded to this many decimals of a metre. Rotating and rotating back has smaller errors, even at 1e6 m.
_DECIMALS = 9
# Two stored copies may be rounded to neighbouring steps [m].
_SAME_VERTEX_M = 1.5e-9


class ObjectMaker:
    """Maker of the objects of one scene, whose file or engine has `unit_m` metres per unit.

    Groups with equal results share one TriMesh and its surface; copies share their looks.
    """

    def __init__(self, up_axis: UpAxis, unit_m: float) -> None:
        self._up, self._unit_m = VERTICAL[up_axis], unit_m
        self._surfaces = SurfaceCache()  # its budget counts each vertex that the file stores
        self._copies: dict[tuple[object, ...], _Copies] = {}
        self._by_faces: dict[bytes, _Copies] = {}
        self._looks: dict[tuple[object, ...], Appearance | None] = {}
        self._stored: set[object] = set()
        self._baked = limits.Budget("triangles to draw", 500_000, 4.0, unit="triangles")

    def make(self, object_id: str, group: Group, pose: Pose | None = None) -> SceneObject:
        """Return the object made of a group's parts, at `pose` [m], else at the pose of the group's frame.

        Raises: SceneError: a coordinate is too large, the object is too far away, or all vertices are in one point; the
        message names the object.
        """
        if pose is not None and (reach_m := max(map(abs, pose.position_m))) > limits.MAX_COORDINATE_M:
            raise SceneError(
                f"object {object_id!r} is {reach_m:g} m from the origin; up to {limits.MAX_COORDINATE_M:g} m are read. "
                "Has the simulation blown up?"
            )
        scale = np.diag([self._unit_m, self._unit_m, self._unit_m, 1.0])
        with np.errstate(over="ignore", invalid="ignore"):
            world = np.stack([scale @ matrix for matrix, _ in group.parts])
            frame = scale @ group.frame
        if not (np.abs(world) <= limits.MAX_COORDINATE_M).all() or not np.isfinite(frame).all():
            raise SceneError(
                f"object {group.name!r} is placed or scaled beyond {limits.MAX_COORDINATE_M:g} m; check its node."
            )
        rigid = rigid_part(frame)
        own = np.linalg.inv(rigid) @ world
        mesh = self._mesh(group, own)
        pieces = [piece for _, piece in group.parts]
        paints = hashlib.sha256("\0".join(piece.paint for piece in pieces).encode()).hexdigest()[:8]
        # Looks do not name a material of which the file has no colour.
        which = np.repeat(np.arange(len(pieces)), [len(piece.faces) for piece in pieces])
        pose = pose or Pose.from_matrix(rigid)
        return SceneObject(
            id=object_id,
            name=group.name,
            pose=pose,
            geometry=mesh,
            surface=self._surfaces.of(mesh, pose.rotation[self._up], f"object {object_id!r}"),
            instance_key=f"{mesh.digest}-{paints}",
            mass_kg=group.mass_kg,
            appearance=self._appearance(pieces, own),
            material_names=names_by_area(mesh, which, [piece.material for piece in pieces]),
        )

    def _mesh(self, group: Group, own: Floats) -> TriMesh:
        """Return the mesh of a group, whose pieces `own` (n, 4, 4) places in the object's frame."""
        pieces = [piece for _, piece in group.parts]
        copies = self._copies.setdefault(tuple(piece.key for piece in pieces), _Copies())
        # The distance by which each entry moves a vertex, so that one length bounds all entries.
        with np.errstate(over="ignore"):
            moves = own[:, :3] * np.array([[[piece.reach] * 3 + [1.0]] for piece in pieces])
        reach_m = float(np.abs(moves).max())
        if not reach_m <= limits.MAX_COORDINATE_M:
            raise SceneError(
                f"object {group.name!r} reaches {reach_m:g} m from its node; "
                f"coordinates of up to {limits.MAX_COORDINATE_M:g} m are read. Check its vertices, or give unit_m."
            )
        mesh = copies.find(moves, _SAME_PLACE * reach_m)
        if mesh is None:
            mesh = self._bake(group, own)
            copies.add(moves, mesh)
        return mesh

    def _bake(self, group: Group, own: Floats) -> TriMesh:
        pieces = [piece for _, piece in group.parts]
        # A piece that occurs several times in one object is copied each time, so the budget counts each.
        for piece in pieces:
            if piece.key not in self._stored:
                self._stored.add(piece.key)
                self._baked.stored += len(piece.faces)
                self._surfaces.work.stored += 0 if piece.is_made else len(piece.vertices)
        self._baked.spend(sum(len(piece.faces) for piece in pieces), f"object {group.name!r}")
        baked = [_baked(piece, matrix) for piece, matrix in zip(pieces, own, strict=True)]
        starts = np.cumsum([0, *(len(vertices) for vertices, _ in baked)])
        vertices = np.concatenate([vertices for vertices, _ in baked])
        faces = np.concatenate([faces + start for (_, faces), start in zip(baked, starts[:-1], strict=True)])
        if not np.ptp(vertices, axis=0).max() > _MIN_EXTENT_M:
            raise SceneError(
                f"object {group.name!r} has no size: all its vertices are in one point. Remove it, or check its scale."
            )
        # Adding zero turns -0 into 0; both are equal, but their bits and so their digests differ.
        vertices = np.round(vertices, _DECIMALS) + 0.0
        stored = self._by_faces.setdefault(hashlib.sha256(faces.tobytes()).digest(), _Copies())
        mesh = stored.find(vertices, _SAME_VERTEX_M)
        if mesh is None:
            mesh = TriMesh(vertices, faces)
            stored.add(mesh.vertices_m, mesh)
        return mesh

    def _appearance(self, pieces: list[Piece], own: Floats) -> Appearance | None:
        mirrors = [_mirrors(matrix) for matrix in own]
        key = tuple((piece.key, piece.paint, is_mirror) for piece, is_mirror in zip(pieces, mirrors, strict=True))
        if key not in self._looks:
            looks = [
                piece.appearance.turned if is_mirror and piece.appearance else piece.appearance
                for piece, is_mirror in zip(pieces, mirrors, strict=True)
            ]
            self._looks[key] = joined(looks, [len(piece.faces) for piece in pieces])
        return self._looks[key]


@dataclass(eq=False)
class _Copies:
    """Meshes by tables of numbers, sorted by a mark that equal tables share, so that only few tables are compared."""

    marks: list[float] = field(default_factory=list)
    rows: list[tuple[Floats, TriMesh]] = field(default_factory=list)

    def find(self, table: Floats, tolerance: float) -> TriMesh | None:
        """Return the mesh of a table of equal shape whose entries all differ by at most the tolerance."""
        mark, spread = self._mark(table), tolerance * table.size
        first = bisect_left(self.marks, mark - spread)
        last = bisect_right(self.marks, mark + spread)
        for other, mesh in self.rows[first:last]:
            if other.shape == table.shape and (np.abs(table - other) <= tolerance).all():
                return mesh
        return None

    def add(self, table: Floats, mesh: TriMesh) -> None:
        """Add the mesh of a table."""
        mark = self._mark(table)
        at = bisect_left(self.marks, mark)
        self.marks.insert(at, mark)
        self.rows.insert(at, (table, mesh))

    @staticmethod
    def _mark(table: Floats) -> float:
        """Return a weighted sum of the entries. The weights are irrational and below 1, so that entries in simple
        ratios do not cancel."""
        return float(table.ravel() @ np.modf(np.arange(1, table.size + 1) * 0.6180339887498949)[0])


def _baked(piece: Piece, matrix: Matrix) -> tuple[Floats, Ints32]:
    """Return vertices and faces of a transformed piece. Faces are reversed under mirroring, so they still face
    outwards."""
    vertices = piece.vertices @ matrix[:3, :3].T + matrix[:3, 3]
    return vertices, piece.faces[:, ::-1] if _mirrors(matrix) else piece.faces


def _mirrors(matrix: Matrix) -> bool:
    return bool(np.linalg.det(matrix[:3, :3]) < 0)
