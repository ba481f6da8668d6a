"""Changes of a scene that describe the same things in another way."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from scene2hap import Pose, SceneObject, TriMesh
from scene2hap.scene.objects import UpAxis

STILL = Pose()


@dataclass(frozen=True)
class Same:
    """A scene described in another way: its objects, the new id of each, where its points are, and its axis up."""

    objects: list[SceneObject]
    ids: Callable[[str], str] = str
    motion: Pose = STILL
    up_axis: UpAxis = "y"


def turned(objects: list[SceneObject], rng: random.Random) -> Same:
    far = (rng.uniform(-100.0, 100.0), rng.uniform(-5.0, 5.0), rng.uniform(-100.0, 100.0))
    motion = Pose.from_yaw(far, rng.choice([0.5, 1.0, 1.5, rng.random() * 2]) * math.pi)
    return Same([described_again(item, pose=motion.compose(item.pose)) for item in objects], motion=motion)


def with_z_up(objects: list[SceneObject], rng: random.Random) -> Same:
    motion = Pose((0.0, 0.0, 0.0), (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)))
    return Same([described_again(item, pose=motion.compose(item.pose)) for item in objects], motion=motion, up_axis="z")


def in_another_order(objects: list[SceneObject], rng: random.Random) -> Same:
    return Same(rng.sample(objects, len(objects)))


def renamed(objects: list[SceneObject], rng: random.Random) -> Same:
    new = [f"thing {k}" for k in range(len(objects))]
    ids = dict(zip([item.id for item in objects], rng.sample(new, len(new)), strict=True))
    return Same([described_again(item, id=ids[item.id]) for item in objects], ids.__getitem__)


def with_unused_vertices(objects: list[SceneObject], rng: random.Random) -> Same:
    def more(mesh: TriMesh) -> TriMesh:
        return TriMesh(np.concatenate([mesh.vertices_m, [[rng.uniform(-9, 9)] * 3]]), mesh.faces)

    return _meshed(objects, more)


def with_lines(objects: list[SceneObject], rng: random.Random) -> Same:
    """Triangles with a corner twice, as long as the sides and diagonals of faces."""

    def more(mesh: TriMesh) -> TriMesh:
        some = mesh.faces[rng.choices(range(len(mesh.faces)), k=4)]
        return TriMesh(mesh.vertices_m, np.concatenate([some[:, [2, 0, 0]], mesh.faces]))

    return _meshed(objects, more)


def cut_at_a_point(objects: list[SceneObject], rng: random.Random) -> Same:
    """Each triangle cut into three at a point inside it."""

    def finer(mesh: TriMesh) -> TriMesh:
        n = len(mesh.vertices_m)
        share = np.random.default_rng(rng.randrange(2**32)).dirichlet([3, 3, 3], len(mesh.faces))
        inside = (mesh.vertices_m[mesh.faces] * share[..., None]).sum(axis=1)
        rows = n + np.arange(len(mesh.faces))
        parts = [np.column_stack([mesh.faces[:, k], mesh.faces[:, k - 2], rows]) for k in range(3)]
        return TriMesh(np.concatenate([mesh.vertices_m, inside]), np.concatenate(parts))

    return _meshed(objects, finer)


def with_backs(objects: list[SceneObject], rng: random.Random) -> Same:
    """Each triangle drawn a second time with the other winding, to be seen from both sides."""

    def both(mesh: TriMesh) -> TriMesh:
        return TriMesh(mesh.vertices_m, rng.sample([*mesh.faces, *mesh.faces[:, ::-1]], 2 * len(mesh.faces)))

    return _meshed(objects, both)


def partly_drawn_twice(objects: list[SceneObject], rng: random.Random) -> Same:
    def more(mesh: TriMesh) -> TriMesh:
        return TriMesh(mesh.vertices_m, [*mesh.faces, *rng.sample([*mesh.faces], len(mesh.faces) // 3)])

    return _meshed(objects, more)


def of_mixed_winding(objects: list[SceneObject], rng: random.Random) -> Same:
    def mixed(mesh: TriMesh) -> TriMesh:
        return TriMesh(mesh.vertices_m, [face[:: rng.choice((1, 1, -1))] for face in mesh.faces])

    return _meshed(objects, mixed)


def in_loose_triangles(objects: list[SceneObject], rng: random.Random) -> Same:
    """No two triangles share a vertex, and their winding is mixed."""

    def loose(mesh: TriMesh) -> TriMesh:
        return TriMesh(mesh.vertices_m[mesh.faces.ravel()], np.arange(mesh.faces.size).reshape(-1, 3))

    return of_mixed_winding(_meshed(objects, loose).objects, rng)


def in_another_frame(objects: list[SceneObject], rng: random.Random) -> Same:
    """Vertices turned and shifted, as in a file in world coordinates; poses undo it."""
    same = []
    for item in objects:
        frame = Pose.from_yaw((rng.uniform(-3, 3), rng.uniform(-3, 3), 0.0), rng.uniform(-3, 3))
        mesh = TriMesh(frame.to_own(item.geometry.mesh.vertices_m), item.geometry.mesh.faces)
        same.append(described_again(item, pose=item.pose.compose(frame), geometry=mesh))
    return Same(same)


def trembling(objects: list[SceneObject], rng: random.Random) -> Same:
    """Poses as a physics engine gives them: up to 1e-5 m and 1e-5 rad off."""

    def near(pose: Pose) -> Pose:
        turn = Pose((0, 0, 0), (*(rng.uniform(-5e-6, 5e-6) for _ in range(3)), 1.0))
        place = (x + rng.uniform(-1e-5, 1e-5) for x in pose.position_m)
        return Pose(place, turn.compose(Pose((0, 0, 0), pose.rotation_xyzw)).rotation_xyzw)

    return Same([described_again(item, pose=near(item.pose)) for item in objects])


def _meshed(objects: list[SceneObject], change: Callable[[TriMesh], TriMesh]) -> Same:
    return Same([described_again(item, geometry=change(item.geometry.mesh)) for item in objects])


def described_again(item: SceneObject, **changes: Any) -> SceneObject:
    """The object with its surface measured again."""
    own: dict[str, Any] = {"id": item.id, "name": item.name, "pose": item.pose, "geometry": item.geometry}
    return SceneObject(**own | changes)


PLACED_AGAIN = (turned, with_z_up, in_another_order, renamed, trembling)
DRAWN_AGAIN = (with_unused_vertices, with_lines, cut_at_a_point)
MESSY = (with_backs, partly_drawn_twice, of_mixed_winding, in_loose_triangles)
ALIKE = (*PLACED_AGAIN, *DRAWN_AGAIN, *MESSY)
CHANGES = (*ALIKE, in_another_frame)
