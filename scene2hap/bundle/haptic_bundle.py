"""A baked scene, to change, save and load."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Self

from scene2hap import checks
from scene2hap.audio.clip import AudioClip
from scene2hap.bundle.checking import require_plausible
from scene2hap.bundle.contents import BundleContents
from scene2hap.bundle.folder import read_bundle, write_bundle
from scene2hap.bundle.override import Override
from scene2hap.calls import clear_calls
from scene2hap.errors import BundleError
from scene2hap.materials import Material
from scene2hap.scene.scene_warning import warn_of


@clear_calls
@dataclass(frozen=True)
class HapticBundle(BundleContents):
    """A baked scene: what is in it, what inference says of each object, and the loops of each source by state.

    `overrides` are what a person says against inference; `choices` tell why each sound was chosen, as a table of its
    candidates in text, by id and state; `made_with` are the settings that all loops share, None where nobody knows.
    """

    def override(
        self,
        object_id: str,
        *,
        vibrates: bool | None = None,
        gain_db: float | None = None,
        material: Material | str | None = None,
        clip: AudioClip | str | os.PathLike[str] | None = None,
        keep: bool | None = None,
        locked: bool | None = None,
    ) -> Self:
        """The bundle with a correction to one object, on top of earlier ones; None leaves a field as it is.

        A clip, or the path of one, stays at its own frequency unless `keep=False` allows to move it clear of the
        scene's other sources. Kept in the folder and by `rebake`. Level, material and silence count at once; a new
        sound, or vibration where none was inferred, counts after `rebake(bundle)`, which makes its loops. While an
        object is locked, its loops stay as they are, byte for byte, whatever is baked again.
        Raises: UnknownObject; BundleError: a field out of bounds; UnknownMaterial. Warns: SceneWarning: a clip for what
        does not vibrate, or a level that looks like a percentage.
        """
        self.snapshot.object(object_id)
        wish = self.overrides.get(object_id, Override()).changed(
            {
                "vibrates": vibrates,
                "gain_db": gain_db,
                "material": material,
                "clip": clip,
                "keep": keep,
                "locked": locked,
            }
        )
        vibrates = self.objects[object_id].vibrates if wish.vibrates is None else wish.vibrates
        if clip is not None and not vibrates:
            warn_of(
                f"{object_id!r} does not vibrate, so that its clip is not played; write override({object_id!r}, "
                "vibrates=True, clip=...)."
            )
        return replace(self, overrides={**self.overrides, object_id: wish}).with_overrides()

    def with_overrides(self) -> Self:
        """With every correction in force, as far as no new loops are needed for it."""
        objects = {
            object_id: self.overrides[object_id].applied(haptics) if object_id in self.overrides else haptics
            for object_id, haptics in self.objects.items()
        }
        silenced = {object_id for object_id, wish in self.overrides.items() if wish.vibrates is False}
        loops = {object_id: states for object_id, states in self.loops.items() if object_id not in silenced}
        return replace(self, objects=objects, loops=loops)

    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Write the folder whole or not at all; a bundle that is there already is replaced, and what is not ours stays.

        Raises: BundleVersionError: a bundle of a newer scene2hap is there; BundleError: the folder holds something
        else, is the one that the process works in, or cannot be written.
        """
        return write_bundle(self, checks.path("folder", folder, error=BundleError))

    @classmethod
    def load(cls, folder: str | os.PathLike[str]) -> Self:
        """Read a folder that `save` wrote, edited or not.

        Raises: BundleIncomplete: a file is missing or cut short; BundleVersionError: written by a newer scene2hap;
        BundleError: a file says something that cannot be.
        Warns: BundleWarning: a state waits for a contact that nothing in the scene can give.
        """
        path = checks.path("folder", folder, error=BundleError)
        found = read_bundle(path)
        require_plausible(found, path)
        return cls(**vars(found))
