"""Skins and morph targets of glTF: the shape of a mesh at the joints' stored transforms and the stored weights.

A viewer shows this shape before any animation plays. The stored positions may differ from it in pose, unit and place,
since the transform of a skinned node does not count.

Source: glTF 2.0 specification (Khronos, 2.0.1), sections 3.7.2.2 (morph targets) and 3.7.3 (skins).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.errors import SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.gltf.accessors import vectors
from scene2hap.scene.formats.gltf.container import GltfFile, Json, mapping, natural
from scene2hap.scene.tree import Matrix


@dataclass(frozen=True, eq=False)
class Deformation:
    """How a node deforms its mesh: `weights` of its morph targets, and `joints` (n, 4, 4), which move positions to
    where a skin has them in the node's frame; None without a skin. `key` is equal for equal deformations."""

    weights: tuple[float, ...] = ()
    joints: Floats | None = None
    key: tuple[object, ...] = ()

    def deformed(
        self, file: GltfFile, row: Json, points: Floats, attribute: Callable[[str, tuple[str, ...]], Floats], place: str
    ) -> Floats:
        """Return the positions (n, 3) of a primitive after its deformation.

        Raises: SceneFormatError: targets, joints or weights do not fit the positions.
        """
        targets = row.get("targets")
        for target, weight in zip(targets if isinstance(targets, list) else [], self.weights, strict=False):
            if weight and "POSITION" in mapping(target):
                what = f"{place}: a morph target's positions"
                points = points + weight * _of_each(points, vectors(file, target["POSITION"], ("VEC3",), what), what)
        names = mapping(row.get("attributes"))
        if self.joints is None or "JOINTS_0" not in names:
            return points
        # A skin of more than four joints for each vertex has JOINTS_1 and so on.
        sets = [k for k in range(len(names)) if f"JOINTS_{k}" in names and f"WEIGHTS_{k}" in names]
        moved, total = np.zeros_like(points), np.zeros((len(points), 1))
        with np.errstate(all="ignore"):  # overflows are refused when meshes are placed
            for k in sets:
                numbers = _of_each(points, attribute(f"JOINTS_{k}", ("VEC4",)), f"{place}: its JOINTS_{k}").astype(int)
                shares = _of_each(points, attribute(f"WEIGHTS_{k}", ("VEC4",)), f"{place}: its WEIGHTS_{k}")
                for joint, share in zip(numbers.T, shares.T, strict=True):
                    used = np.flatnonzero(share)
                    if used.size and not 0 <= joint[used].min() <= joint[used].max() < len(self.joints):
                        raise SceneFormatError(
                            f"{place} uses joint {joint[used].max()} of its skin; there are {len(self.joints)}."
                        )
                    matrices = self.joints[joint[used]]
                    at = np.einsum("nij,nj->ni", matrices[:, :3, :3], points[used]) + matrices[:, :3, 3]
                    moved[used] += share[used, None] * at
                    total[used] += share[used, None]
            return np.where(total > 0, moved / total, points)


class Deformations:
    """Reader of the deformations of a file's nodes; `matrix_of(row, place)` returns a node's own transform."""

    def __init__(self, file: GltfFile, matrix_of: Callable[[Json, str], Matrix]) -> None:
        self._file, self._matrix_of = file, matrix_of
        self._skins: dict[int, Floats] = {}
        self._worlds: dict[int, Matrix] = {}

    def of(self, number: int, node: Json, mesh: Json, place: str) -> Deformation:
        """Return how node `number` deforms its mesh. Raises: SceneFormatError: its weights or skin are broken."""
        weights: tuple[float, ...] = ()
        if (given := node.get("weights", mesh.get("weights"))) is not None:
            n = len(given) if isinstance(given, list) else 1
            weights = tuple(checks.vector(f"{place}.weights", given, "-", size=n, error=SceneFormatError)) if n else ()
        weights = weights if any(weights) else ()
        if "skin" not in node:
            return Deformation(weights, None, weights)
        own = self._world(number)
        joints = self._skin(node["skin"], place)
        # Each node with a skin needs an array of its joints.
        self._file.values.spend(joints.size, f"the skin of {place}")
        with np.errstate(all="ignore"):
            if not abs(np.linalg.det(own)) > 0.0:  # a node of scale 0 shows its skin all the same
                return Deformation(weights, None, weights)
            placed = np.linalg.inv(own) @ joints
        return Deformation(weights, placed, (*weights, "skin", node["skin"], number))

    def _skin(self, number: object, place: str) -> Floats:
        """Return the matrices (n, 4, 4) that move positions of a skin to the world."""
        skin = self._file.row("skins", number, place)
        if isinstance(number, int) and number in self._skins:
            return self._skins[number]
        rows, place = skin.get("joints"), f"skins[{number}]"
        if not isinstance(rows, list) or not rows:
            raise SceneFormatError(f"{place}.joints must be a list of node numbers.")
        joints = np.stack([self._world(natural(joint, f"{place}.joints")) for joint in rows])
        if "inverseBindMatrices" in skin:
            bound = vectors(self._file, skin["inverseBindMatrices"], ("MAT4",), f"{place}: its inverseBindMatrices")
            if len(bound) < len(joints):
                raise SceneFormatError(f"{place} has {len(bound)} inverse bind matrices for {len(joints)} joints.")
            with np.errstate(all="ignore"):
                joints = joints @ bound[: len(joints)].reshape(-1, 4, 4).transpose(0, 2, 1)
        self._skins[natural(number, place)] = joints
        return joints

    @cached_property
    def _above(self) -> dict[int, int]:
        """The parent of each node that has one."""
        above: dict[int, int] = {}
        for number, row in enumerate(self._file.table("nodes")):
            children = row.get("children")
            above |= (
                {child: number for child in children if isinstance(child, int)} if isinstance(children, list) else {}
            )
        return above

    def _world(self, number: int) -> Matrix:
        """Return the transform of a node to the world. Each node is placed once, since skins share their joints."""
        self._file.row("nodes", number, "a skin")
        path = []
        while number not in self._worlds:
            path.append(number)
            limits.at_most("the depth of the node tree", len(path), "MAX_DEPTH")
            if number not in self._above:
                break
            number = self._above[number]
        world = self._worlds.get(number, np.eye(4))
        for node in reversed(path):
            with np.errstate(all="ignore"):  # as in `deformed`
                world = world @ self._matrix_of(self._file.table("nodes")[node], f"nodes[{node}]")
            self._worlds[node] = world
        return world


def _of_each(points: Floats, values: Floats, what: str) -> Floats:
    if len(values) != len(points):
        raise SceneFormatError(f"{what} has {len(values)} values for {len(points)} vertices.")
    return values
