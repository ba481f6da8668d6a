"""Objects of boxes for the contact tests."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.objects import Contact, SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box, DominantSurface, Geometry, TriMesh
from scene2hap.scene.snapshot import SceneSnapshot

Triple = tuple[float, float, float]
SURFACE = DominantSurface(Pose(), 0.1, 0.1, 0.01)


def thing(name: str, geometry: Geometry, pose: Pose) -> SceneObject:
    return SceneObject(name, name, pose, geometry, SURFACE)


def box(name: str, size_m: Triple, at_m: Triple, rotation_xyzw: Sequence[float] = (0, 0, 0, 1)) -> SceneObject:
    """A cuboid (x, y up, z) with its centre at `at_m`."""
    x, y, z, w = rotation_xyzw
    return thing(name, Box(size_m), Pose(at_m, (x, y, z, w)))


def on_floor(name: str, size_m: Triple, x: float, z: float, gap_m: float = 0.0) -> SceneObject:
    """A cuboid whose bottom is `gap_m` above y = 0."""
    return box(name, size_m, (x, size_m[1] / 2 + gap_m, z))


def boxes(name: str, *parts: tuple[Triple, Triple], at_m: Triple = (0.0, 0.0, 0.0)) -> SceneObject:
    """One object made of cuboids, each (size, centre)."""
    vertices: list[NDArray[np.float64]] = []
    faces: list[NDArray[np.int64]] = []
    for size_m, middle_m in parts:
        mesh = Box(size_m).mesh
        faces.append(mesh.faces.astype(np.int64) + 8 * len(vertices))
        vertices.append(mesh.vertices_m + np.asarray(middle_m))
    return thing(name, TriMesh(np.concatenate(vertices), np.concatenate(faces)), Pose(at_m))


def chair(at_m: Triple) -> SceneObject:
    """Four legs of 40 mm at x, z = +-0.2 m, and a seat; the feet stand at the height of `at_m`."""
    legs = [((0.04, 0.45, 0.04), (x, 0.225, z)) for x in (-0.2, 0.2) for z in (-0.2, 0.2)]
    return boxes("chair", *legs, ((0.44, 0.04, 0.44), (0.0, 0.47, 0.0)), at_m=at_m)


def quads(*corners: Sequence[Triple]) -> TriMesh:
    """Level or upright quadrilaterals, each by its four corners in order."""
    vertices = np.array(corners, dtype=float).reshape(-1, 3)
    first, halves = 4 * np.arange(len(corners))[:, None, None], np.array([[0, 1, 2], [0, 2, 3]])
    return TriMesh(vertices, (first + halves).reshape(-1, 3))


def level(x0: float, z0: float, x1: float, z1: float, y: float) -> list[Triple]:
    return [(x0, y, z0), (x0, y, z1), (x1, y, z1), (x1, y, z0)]


def house(rotation_xyzw: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)) -> SceneObject:
    """One mesh: an L-shaped floor, 3 m x 3 m without the quarter x > 0.5, z > 0.5, walls 2.4 m high around it, a podium
    0.12 m high in a corner, a board at 0.9 m on a wall, and a ceiling."""
    ring = [(-1.5, -1.5), (1.5, -1.5), (1.5, 0.5), (0.5, 0.5), (0.5, 1.5), (-1.5, 1.5)]
    walls = [
        [(a, 0.0, b), (c, 0.0, d), (c, 2.4, d), (a, 2.4, b)]
        for (a, b), (c, d) in zip(ring, ring[1:] + ring[:1], strict=True)
    ]
    podium = [(-1.5, -0.7), (-0.7, -0.7), (-0.7, -1.5)]
    risers = [[(a, 0.0, b), (c, 0.0, d), (c, 0.12, d), (a, 0.12, b)] for (a, b), (c, d) in pairwise(podium)]
    parts = [
        level(-1.5, -1.5, 0.5, 0.5, 0.0),
        level(0.5, -1.5, 1.5, 0.5, 0.0),
        level(-1.5, 0.5, 0.5, 1.5, 0.0),
        level(-1.5, -1.5, -0.7, -0.7, 0.12),
        level(0.9, -0.4, 1.5, 0.5, 0.9),
        level(0.9, -0.4, 1.5, 0.5, 0.88),
        level(-1.5, -1.5, 1.5, 1.5, 2.4),
    ]
    return thing("house", quads(*parts, *walls, *risers), Pose((0.0, 0.0, 0.0), rotation_xyzw))


def floor() -> SceneObject:
    """6 m x 6 m, 0.1 m thick, its top at y = 0."""
    return box("floor", (6.0, 0.1, 6.0), (0.0, -0.05, 0.0))


def scene(*objects: SceneObject, contacts: Iterable[Contact] | None = None) -> SceneSnapshot:
    return SceneSnapshot("test", "y", objects, None if contacts is None else tuple(contacts))


def pairs(graph: ContactGraph) -> set[tuple[str, str]]:
    return {(contact.a, contact.b) for contact in graph.contacts}


def found(*objects: SceneObject, tolerance_m: float | None = None) -> set[tuple[str, str]]:
    """The pairs in contact in a scene of these objects."""
    return pairs(ContactGraph(scene(*objects), tolerance_m=tolerance_m))


def weight(graph: ContactGraph, a: str, b: str) -> float:
    """The weight of a pair, 0 if it is not in contact."""
    return max((contact.weight for contact in graph.contacts if (contact.a, contact.b) == (a, b)), default=0.0)


def points(graph: ContactGraph, a: str, b: str) -> NDArray[np.float64]:
    """The pair's points (n, 3) [m]."""
    return np.array([contact.point_m for contact in graph.contacts if (contact.a, contact.b) == (a, b)]).reshape(-1, 3)
