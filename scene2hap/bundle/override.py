"""What a person says of an object against inference; kept when the scene is baked again."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from scene2hap import checks
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.files import read_clip
from scene2hap.audio.gain_warning import warn_if_percent
from scene2hap.calls import clear_construction
from scene2hap.errors import BundleError
from scene2hap.haptics import ObjectHaptics
from scene2hap.materials import Material, lookup
from scene2hap.scene.sizes import with_thickness

USER = "user"
"""Provenance of an overridden field."""

_MOST_GAIN_DB = 60.0


@clear_construction
@dataclass(frozen=True)
class Override:
    """A correction; None leaves what was inferred.

    vibrates : whether the object vibrates by itself; gain_db : its level at the hand against the inferred one [dB];
    material : its material, or a name in the table; clip : the sound that its vibration is made from, in every state,
    or the path of its file; keep : whether that sound stays at its own frequency and level, and the scene's other
    sources keep clear of it; else it is moved like any other; locked : whether its loops stay as they are, whatever is
    baked again.
    Raises: BundleError: a field of another type or out of bounds. UnknownMaterial.
    """

    vibrates: bool | None = None
    gain_db: float | None = None
    material: Material | None = None
    clip: AudioClip | None = None
    keep: bool = True
    locked: bool = False

    def __post_init__(self) -> None:
        if self.vibrates is not None and not isinstance(self.vibrates, bool):
            raise BundleError(f"vibrates is {checks.represented(self.vibrates)}; it must be True, False or None.")
        if not isinstance(self.keep, bool):
            raise BundleError(f"keep is {checks.represented(self.keep)}; it must be True or False.")
        if not isinstance(self.locked, bool):
            raise BundleError(f"locked is {checks.represented(self.locked)}; it must be True or False.")
        if self.gain_db is not None:
            gain = checks.number("gain_db", self.gain_db, "dB", at_most=_MOST_GAIN_DB, error=BundleError)
            warn_if_percent(gain)
            object.__setattr__(self, "gain_db", gain)
        if isinstance(self.material, str):
            object.__setattr__(self, "material", lookup(self.material))
        if self.material is not None and not isinstance(self.material, Material):
            raise BundleError(
                f"material is {checks.represented(self.material)}; it must be a Material or a name in the table."
            )
        if isinstance(self.clip, str | os.PathLike):
            object.__setattr__(self, "clip", read_clip(Path(self.clip)))
        if self.clip is not None and not isinstance(self.clip, AudioClip):
            raise BundleError(
                f"clip is {checks.described(self.clip)}; it must be an AudioClip or the path of a sound file."
            )

    def changed(self, changes: Mapping[str, Any]) -> Override:
        """With the fields that are not None in place of what they were."""
        return replace(self, **{name: value for name, value in changes.items() if value is not None})

    def applied(self, haptics: ObjectHaptics) -> ObjectHaptics:
        """What is then said of the object. That it vibrates needs a state, which baking it again brings."""
        provenance = dict(haptics.provenance)
        if self.material is not None:
            provenance |= {"material": USER, "material_category": USER}
            # A sheet of unknown material was left without a thickness by earlier versions; what spreads needs one.
            size_m = with_thickness(haptics.estimated_size_m)
            haptics = replace(
                haptics, material=self.material, material_category=self.material.name, estimated_size_m=size_m
            )
        if self.vibrates is False:
            provenance["vibrates"] = USER
            haptics = replace(haptics, vibrates=False, states=())
        elif self.vibrates and haptics.states:
            provenance["vibrates"] = USER
        return replace(haptics, provenance=provenance)
