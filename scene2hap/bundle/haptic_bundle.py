"""A baked scene."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from scene2hap import checks
from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle.made_with import MadeWith
from scene2hap.bundle.override import Override
from scene2hap.calls import clear_call
from scene2hap.errors import BundleError
from scene2hap.haptics import ActuatorProfile, ObjectHaptics
from scene2hap.materials import Material
from scene2hap.scene.snapshot import SceneSnapshot


@dataclass(frozen=True)
class HapticBundle:
    """A baked scene: what is in it, what inference says of each object, and the loops of each source by state.

    `overrides` are what a person says against inference; `choices` tell why each sound was chosen, as a table of its
    candidates in text, by id and state; `made_with` are the settings that all loops share, None where nobody knows.
    """

    snapshot: SceneSnapshot
    scene_category: str
    objects: Mapping[str, ObjectHaptics]
    loops: Mapping[str, Mapping[str, HapticLoop]]
    overrides: Mapping[str, Override] = field(default_factory=dict)
    choices: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    made_with: MadeWith | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.snapshot, SceneSnapshot):
            raise BundleError(f"snapshot is {checks.described(self.snapshot)}; it must be a SceneSnapshot.")
        for name in ("objects", "loops", "overrides", "choices"):
            if not isinstance(getattr(self, name), Mapping):
                raise BundleError(f"{name} is {checks.described(getattr(self, name))}; it must be a mapping by id.")
        for object_id in (*self.objects, *self.loops, *self.overrides):
            self.snapshot.object(object_id)

    @property
    def actuator(self) -> ActuatorProfile | None:
        """What all tactile loops were converted for; None where nobody knows."""
        return self.made_with.actuator if self.made_with is not None else None

    @property
    def credits(self) -> tuple[Credit, ...]:
        """Whom the sounds are owed to, each once, in order of source and state."""
        return tuple(dict.fromkeys(loop.audible.credit for states in self.loops.values() for loop in states.values()))

    @clear_call
    def override(
        self,
        object_id: str,
        *,
        vibrates: bool | None = None,
        gain_db: float | None = None,
        material: Material | str | None = None,
        clip: AudioClip | str | os.PathLike[str] | None = None,
        keep: bool | None = None,
    ) -> HapticBundle:
        """The bundle with a correction to one object, on top of earlier ones; None leaves a field as it is.

        A clip, or the path of one, stays at its own frequency unless `keep=False` allows to move it clear of the
        scene's other sources. Kept in the folder and by `rebake`. Level, material and silence count at once; a new
        sound, or vibration where none was inferred, counts after `rebake(bundle)`, which makes its loops.
        Raises: UnknownObject; BundleError: a field out of bounds; UnknownMaterial.
        """
        self.snapshot.object(object_id)
        wish = self.overrides.get(object_id, Override()).changed(
            {"vibrates": vibrates, "gain_db": gain_db, "material": material, "clip": clip, "keep": keep}
        )
        return replace(self, overrides={**self.overrides, object_id: wish}).with_overrides()

    def with_overrides(self) -> HapticBundle:
        """With every correction in force, as far as no new loops are needed for it."""
        objects = {
            object_id: self.overrides[object_id].applied(haptics) if object_id in self.overrides else haptics
            for object_id, haptics in self.objects.items()
        }
        silenced = {object_id for object_id, wish in self.overrides.items() if wish.vibrates is False}
        loops = {object_id: states for object_id, states in self.loops.items() if object_id not in silenced}
        return replace(self, objects=objects, loops=loops)

    def gain_db(self, object_id: str) -> float:
        """The level of a source at the hand against the inferred one [dB]."""
        wish = self.overrides.get(object_id) if isinstance(object_id, str) else None
        return wish.gain_db if wish is not None and wish.gain_db is not None else 0.0

    @clear_call
    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Write the folder whole or not at all; a bundle that is there already is replaced, and what is not ours stays.

        Raises: BundleVersionError: a bundle of a newer scene2hap is there; BundleError: the folder holds something
        else, is the one that the process works in, or cannot be written.
        """
        from scene2hap.bundle.folder import write_bundle

        return write_bundle(self, checks.path("folder", folder, error=BundleError))

    @classmethod
    @clear_call
    def load(cls, folder: str | os.PathLike[str]) -> HapticBundle:
        """Read a folder that `save` wrote, edited or not.

        Raises: BundleIncomplete: a file is missing or cut short; BundleVersionError: written by a newer scene2hap;
        BundleError: a file says something that cannot be.
        Warns: BundleWarning: a state waits for a contact that nothing in the scene can give.
        """
        from scene2hap.bundle.checking import require_plausible
        from scene2hap.bundle.folder import read_bundle

        path = checks.path("folder", folder, error=BundleError)
        bundle = read_bundle(path)
        require_plausible(bundle, path)
        return bundle
