"""Surface points of a scene, as many as a picture needs, connected by triangles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray

from scene2hap.scene.objects import SceneObject, UpAxis
from scene2hap.scene.pose import vertical

MOST_POINTS = 12_000
"""Most points of all patches together; assumed: a point every 5 cm in a furnished kitchen."""
FINEST_M, COARSEST_M = 0.03, 1.5
"""Bounds on the distance of points [m]; assumed: half a fingertip's step, and half a wall."""
_GROWTH = 1.3


@dataclass(frozen=True, eq=False)
class Patch:
    """Points (n, 3) [m] in the world on the surface of an object, and triangles (m, 3) over them."""

    object_id: str
    points_m: NDArray[np.float32]
    faces: NDArray[np.uint32]


def patches_of(objects: Sequence[SceneObject], most_points: int = MOST_POINTS, up_axis: UpAxis = "y") -> list[Patch]:
    """Make a patch for each object, with points as dense as `most_points` in total allows.

    The upper side of an object that is thinner than the distance of points, such as a mat, has all of its points.
    Every point is a vertex of the object's mesh, or between its vertices, at most a few steps from the mesh.
    """
    area_m2 = sum(_area_m2(item) for item in objects)
    # Distance of points in equilateral triangles on that area, if all of it were flat.
    distance_m = max(FINEST_M, float(np.sqrt(area_m2 / max(1, most_points))))
    while True:
        found = [_patch(item, distance_m, up_axis) for item in objects]
        if sum(len(patch.points_m) for patch in found) <= most_points or distance_m >= COARSEST_M:
            return found
        distance_m *= _GROWTH


def _area_m2(item: SceneObject) -> float:
    mesh = item.geometry.mesh
    a, b, c = np.moveaxis(mesh.vertices_m[mesh.faces], 1, 0)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2.0


def _patch(item: SceneObject, distance_m: float, up_axis: UpAxis) -> Patch:
    mesh = item.geometry.mesh
    up = item.pose.rotation[vertical(up_axis)]  # in the frame of the object
    # Cluster first, so that a mesh of a million triangles is not subdivided further.
    points, faces = _clustered(np.asarray(mesh.vertices_m), np.asarray(mesh.faces), up, distance_m)
    if len(faces) and np.ptp(points, axis=0).max() > distance_m:
        finer, finer_faces = trimesh.remesh.subdivide_to_size(points, faces, 1.5 * distance_m, max_iter=12)
        points, faces = _clustered(np.asarray(finer), np.asarray(finer_faces), up, distance_m)
    return Patch(item.id, item.pose.to_world(points).astype(np.float32), faces.astype(np.uint32))


def _clustered(
    vertices: NDArray[np.float64], faces: NDArray[np.integer], up: NDArray[np.float64], distance_m: float
) -> tuple[NDArray[np.float64], NDArray[np.integer]]:
    """Keep the uppermost vertex in each cell of a grid, and drop triangles within a cell."""
    downwards = np.argsort(-(vertices @ up), kind="stable")
    vertices, place = vertices[downwards], np.argsort(downwards)
    cells = np.floor((vertices - vertices.min(axis=0)) / distance_m).astype(np.int64)
    _, first, of_cell = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    joined = of_cell.reshape(-1)[place[faces]]
    a, b, c = joined.T
    kept = np.unique(joined[(a != b) & (b != c) & (a != c)], axis=0)
    used, renumbered = np.unique(kept, return_inverse=True)
    if not len(used):  # the object is smaller than a cell: keep a single point
        return vertices[first[:1]], np.zeros((0, 3), np.int64)
    return vertices[first[used]], renumbered.reshape(-1, 3)
