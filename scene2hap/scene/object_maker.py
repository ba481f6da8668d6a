"""Groups of pieces as scene objects with measured surfaces; shared by all engines."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from scene2hap.errors import SceneError
from scene2hap.scene import limits
from scene2hap.scene.grouping import Group
from scene2hap.scene.objects import SceneObject, UpAxis
from scene2hap.scene.pose import Pose
from scene2hap.scene.rigid_meshes import MeshPool

_UP = {"y": np.array([0.0, 1.0, 0.0]), "z": np.array([0.0, 0.0, 1.0])}


@dataclass(eq=False)
class ObjectMaker:
    """Maker of the objects of one scene; copies share mesh, looks and measured surface."""

    up_axis: UpAxis
    unit_m: float = 1.0
    _pool: MeshPool = field(init=False)

    def __post_init__(self) -> None:
        self._pool = MeshPool(self.unit_m)

    def make(self, object_id: str, name: str, group: Group, pose: Pose, mass_kg: float | None = None) -> SceneObject:
        """Return the object made of a group's parts, at `pose` [m].

        Raises: SceneError: the geometry is invalid, or the object is too far away; see `MeshPool.place`.
        """
        reach_m = max(map(abs, pose.position_m))
        if reach_m > limits.MAX_COORDINATE_M:
            raise SceneError(
                f"object {object_id!r} is {reach_m:g} m from the origin; up to {limits.MAX_COORDINATE_M:g} m are read. "
                "Has the simulation blown up?"
            )
        placed = self._pool.place(group)
        up = pose.rotation.T @ _UP[self.up_axis]
        surface = self._pool.surfaces.of(placed.mesh, up, f"object {object_id!r}")
        return SceneObject(
            id=object_id,
            name=name,
            pose=pose,
            geometry=placed.mesh,
            surface=surface,
            instance_key=placed.instance_key,
            mass_kg=mass_kg,
            appearance=placed.appearance,
        )
