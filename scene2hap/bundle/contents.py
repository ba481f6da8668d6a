"""The data of a baked scene, without methods to change or save it. Reading and writing depend only on this module."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from scene2hap.audio.clip import Credit
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle.by_name import ByName, by_name
from scene2hap.bundle.made_with import MadeWith
from scene2hap.bundle.override import Override
from scene2hap.common import checks
from scene2hap.errors import BundleError, UnknownObject
from scene2hap.haptics import ActuatorProfile, ObjectHaptics
from scene2hap.scene.snapshot import SceneSnapshot


@dataclass(frozen=True)
class BundleContents:
    """The fields of a `HapticBundle`, which says what they are."""

    snapshot: SceneSnapshot
    scene_category: str
    objects: Mapping[str, ObjectHaptics]
    loops: Mapping[str, Mapping[str, HapticLoop]]
    overrides: Mapping[str, Override] = field(default_factory=dict)
    choices: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    made_with: MadeWith | None = None
    inferred: Mapping[str, ObjectHaptics] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not isinstance(self.snapshot, SceneSnapshot):
            raise BundleError(f"snapshot is {checks.described(self.snapshot)}; it must be a SceneSnapshot.")
        for name in ("objects", "loops", "overrides", "choices", "inferred"):
            if not isinstance(getattr(self, name), Mapping):
                raise BundleError(f"{name} is {checks.described(getattr(self, name))}; it must be a mapping by id.")
        loops = {key: by_name(states, "state", f"of {key!r}") for key, states in self.loops.items()}
        object.__setattr__(self, "objects", by_name(self.objects, "object"))
        object.__setattr__(self, "loops", ByName(loops, "source"))
        for object_id in (*self.objects, *self.loops, *self.overrides, *self.inferred):
            self.snapshot.object(object_id)

    @property
    def actuator(self) -> ActuatorProfile | None:
        """The actuator for which all tactile loops were converted; None if unknown."""
        return self.made_with.actuator if self.made_with is not None else None

    @property
    def credits(self) -> tuple[Credit, ...]:
        """Credits of the sounds, each once, in order of source and state."""
        return tuple(dict.fromkeys(loop.audible.credit for states in self.loops.values() for loop in states.values()))

    def is_muted(self, object_id: str) -> bool:
        """Return True if a source is silent until a game unmutes it."""
        wish = self.overrides.get(object_id) if isinstance(object_id, str) else None
        return wish is not None and wish.muted

    def gain_db(self, object_id: str) -> float:
        """Return the level of a source at the hand, relative to the inferred one [dB]."""
        wish = self.overrides.get(object_id) if isinstance(object_id, str) else None
        return wish.gain_db if wish is not None and wish.gain_db is not None else 0.0


def require_same_scene(scene: SceneSnapshot, bundle: BundleContents) -> None:
    """Raise an UnknownObject if a scene lacks objects of the bundle's loops, or shares no object with the bundle."""
    ids = {item.id for item in scene.objects}
    baked = bundle.loops if bundle.loops or ids & bundle.objects.keys() else bundle.objects
    lacking = [object_id for object_id in baked if object_id not in ids]
    if lacking:
        near = checks.did_you_mean(lacking[0], ids)
        raise UnknownObject(
            f"the bundle was baked for another scene: {scene.name!r} has no object {lacking[0]!r} ({len(lacking)} "
            f"of {len(baked)} are missing). {near}{' ' if near else ''}Give the scene that was baked, "
            "the `snapshot` of the bundle, or bake this one."
        )
