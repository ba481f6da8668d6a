"""From a scene and what was baked for it to what propagation models read: bodies, where they are, and what excites."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import Body, ContactNetwork, Excitation
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import Contact, SceneObject, SceneSnapshot

UNKNOWN_MASS_KG = 1.0
"""Mass of a source whose material nobody knows."""


def bodies_of(scene: SceneSnapshot, bundle: HapticBundle) -> dict[str, Body]:
    """The plate of every object whose material and thickness are known."""
    bodies: dict[str, Body] = {}
    for item in scene.objects:
        haptics = bundle.objects.get(item.id)
        if haptics is not None and haptics.material is not None and all(edge > 0 for edge in haptics.estimated_size_m):
            bodies[item.id] = Plate(*haptics.estimated_size_m, haptics.material)
    return bodies


def network_of(
    scene: SceneSnapshot, bodies: Mapping[str, Body], poses: Mapping[str, Pose], contacts: Sequence[Contact]
) -> ContactNetwork:
    """The network of a scene whose objects are at `poses` now."""
    placed = {
        item.id: plate_pose(item, poses[item.id], body)
        for item in scene.objects
        if isinstance(body := bodies.get(item.id), Plate)
    }
    return ContactNetwork(bodies, contacts, placed)


def plate_pose(item: SceneObject, pose: Pose, plate: Plate) -> Pose:
    """Where the corner of an object's plate is, for the object at `pose`.

    A plate whose size was corrected shares its middle with the surface that was measured.
    """
    surface = item.surface
    middle = ((surface.length_m - plate.length_m) / 2, (surface.width_m - plate.width_m) / 2, 0.0)
    return pose.compose(surface.pose).compose(Pose(middle))


def excitations_of(loops: Mapping[str, HapticLoop], bodies: Mapping[str, Body]) -> list[Excitation]:
    """One excitation per source, in their order."""
    return [
        Excitation(
            source_id,
            loop.frequency_raw_hz,
            loop.frequency_tactile_hz,
            bodies[source_id].mass_kg if source_id in bodies else UNKNOWN_MASS_KG,
        )
        for source_id, loop in loops.items()
    ]
