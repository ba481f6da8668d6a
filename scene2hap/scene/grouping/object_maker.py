"""Groups of pieces as scene objects with measured surfaces, for files and engines."""

from __future__ import annotations

from scene2hap.errors import SceneError
from scene2hap.scene import limits
from scene2hap.scene.grouping.groups import Group
from scene2hap.scene.grouping.rigid_meshes import MeshPool
from scene2hap.scene.objects import VERTICAL, SceneObject, UpAxis
from scene2hap.scene.pose import Pose


class ObjectMaker:
    """Maker of the objects of one scene; copies share mesh, looks and measured surface."""

    def __init__(self, up_axis: UpAxis, unit_m: float) -> None:
        self._up = VERTICAL[up_axis]
        self._pool = MeshPool(unit_m)

    def make(self, object_id: str, group: Group, pose: Pose | None = None) -> SceneObject:
        """Return the object made of a group's parts, at `pose` [m], else at the pose of the group's frame.

        Raises: SceneError: the geometry is invalid, or the object is too far away; see `MeshPool.place`.
        """
        if pose is not None and (reach_m := max(map(abs, pose.position_m))) > limits.MAX_COORDINATE_M:
            raise SceneError(
                f"object {object_id!r} is {reach_m:g} m from the origin; up to {limits.MAX_COORDINATE_M:g} m are read. "
                "Has the simulation blown up?"
            )
        placed = self._pool.place(group)
        pose = pose or placed.pose
        surface = self._pool.surfaces.of(placed.mesh, pose.rotation[self._up], f"object {object_id!r}")
        return SceneObject(
            id=object_id,
            name=group.name,
            pose=pose,
            geometry=placed.mesh,
            surface=surface,
            instance_key=placed.instance_key,
            mass_kg=group.mass_kg,
            appearance=placed.appearance,
            material_names=placed.material_names,
        )
