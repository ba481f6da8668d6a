"""Groups of pieces as rigidly posed meshes: scale, shear and mirroring go into the vertices, instances share one mesh."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from scene2hap.errors import SceneError
from scene2hap.scene import limits
from scene2hap.scene.grouping import Group
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import TriMesh
from scene2hap.scene.tree import Matrix, Piece, digest

# Matrices that went through float32 differ in the seventh digit; instances may differ by this part of their size.
_SAME_PLACE = 1e-6
# Smaller than this [m], an object is a point: no surface can be measured on it (assumed; a hair is 5e-5 wide).
_MIN_EXTENT_M = 1e-9


@dataclass(frozen=True, eq=False)
class Placed:
    """An object's mesh in its own frame, where that frame stands, and what is equal for its copies."""

    pose: Pose
    mesh: TriMesh
    instance_key: str


@dataclass(eq=False)
class MeshPool:
    """Bakes groups, and gives groups that bake to the same mesh one and the same TriMesh."""

    unit_m: float
    _by_pieces: dict[tuple[object, ...], list[tuple[NDArray[np.float64], float, Placed]]] = field(default_factory=dict)
    _by_digest: dict[str, TriMesh] = field(default_factory=dict)

    def place(self, group: Group) -> Placed:
        """The group's mesh and pose.

        Raises: SceneError: a coordinate is too large, or all vertices are in one point; the message names the object.
        """
        scale = np.diag([self.unit_m, self.unit_m, self.unit_m, 1.0])
        with np.errstate(over="ignore", invalid="ignore"):
            world = np.stack([scale @ matrix for matrix, _ in group.parts])
            frame = scale @ group.frame
        if not (np.abs(world) <= limits.MAX_COORDINATE_M).all() or not np.isfinite(frame).all():
            raise SceneError(
                f"object {group.name!r} is placed or scaled beyond {limits.MAX_COORDINATE_M:g} m; check its node."
            )
        rigid = rigid_part(frame)
        own = np.linalg.inv(rigid) @ world
        copies = self._by_pieces.setdefault(tuple(piece.key for _, piece in group.parts), [])
        for other, tolerance, placed in copies:
            if np.allclose(own, other, rtol=0.0, atol=tolerance):
                return Placed(Pose.from_matrix(rigid), placed.mesh, placed.instance_key)
        placed = self._bake(group, own, Pose.from_matrix(rigid))
        size = float(np.ptp(placed.mesh.bounds_m, axis=0).max())
        copies.append((own, _SAME_PLACE * min(size, float(np.abs(own[:, :3, :3]).max())), placed))
        return placed

    def _bake(self, group: Group, own: NDArray[np.float64], pose: Pose) -> Placed:
        pieces = [piece for _, piece in group.parts]
        baked = [_baked(piece, matrix) for piece, matrix in zip(pieces, own, strict=True)]
        starts = np.cumsum([0, *(len(vertices) for vertices, _ in baked)])
        vertices = np.concatenate([vertices for vertices, _ in baked])
        faces = np.concatenate([faces + start for (_, faces), start in zip(baked, starts[:-1], strict=True)])
        reach = float(np.abs(vertices).max())
        if not reach <= limits.MAX_COORDINATE_M:
            raise SceneError(
                f"object {group.name!r} reaches {reach:g} m from its node; "
                f"coordinates of up to {limits.MAX_COORDINATE_M:g} m are read. Check its vertices, or give unit_m."
            )
        if not np.ptp(vertices, axis=0).max() > _MIN_EXTENT_M:
            raise SceneError(
                f"object {group.name!r} has no size: all its vertices are in one point. Remove it, or check its scale."
            )
        mesh = TriMesh(vertices, faces)
        mesh = self._by_digest.setdefault(mesh.digest, mesh)
        return Placed(pose, mesh, f"{mesh.digest}-{digest(*(piece.material for piece in pieces))}")


def rigid_part(matrix: Matrix) -> Matrix:
    """The rotation and translation of an affine matrix, without scale, shear and mirroring.

    L = Q P with Q orthogonal and P symmetric (polar decomposition); a mirroring Q gives up its x axis, so that what
    stood upright still does.
    """
    left, _, right = np.linalg.svd(matrix[:3, :3])
    rotation = left @ right
    if np.linalg.det(rotation) < 0:
        rotation = rotation * [-1.0, 1.0, 1.0]
    rigid: Matrix = np.eye(4)
    rigid[:3, :3], rigid[:3, 3] = rotation, matrix[:3, 3]
    return rigid


def _baked(piece: Piece, matrix: Matrix) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Vertices and faces of a piece under a matrix; faces still turn outwards if it mirrors."""
    with np.errstate(over="ignore", invalid="ignore"):
        vertices = piece.vertices @ matrix[:3, :3].T + matrix[:3, 3]
        is_mirror = np.linalg.det(matrix[:3, :3]) < 0
    return vertices, piece.faces[:, ::-1] if is_mirror else piece.faces
