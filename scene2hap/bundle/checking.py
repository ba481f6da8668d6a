"""Checks of a bundle's objects against its scene, since a person may have edited the file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from scene2hap.audio.clip import Samples
from scene2hap.bundle.contents import BundleContents
from scene2hap.bundle.override import ANY_STATE, BY_STATE, NONE, Override
from scene2hap.common.checks import did_you_mean, shown
from scene2hap.common.warning import warn_of
from scene2hap.errors import BundleError
from scene2hap.haptics import ObjectHaptics, SourceState, unmet_needs
from scene2hap.materials import Material, find_row
from scene2hap.scene.surface import plate_sizes


class BundleWarning(UserWarning):
    """A bundle has a value that is probably wrong, or lacks data that `rebake` needs."""


def warn_of_unknown_fields(path: Path, answers: Mapping[str, Any]) -> None:
    """Warn about fields of objects, materials and states that do not exist: typing mistakes of an edit by hand.

    Warns: BundleWarning: a field has no effect.
    """
    for object_id, answer in answers.items():
        parts: list[tuple[type[ObjectHaptics | Material | SourceState], Any]] = [(ObjectHaptics, answer)]
        parts += [(Material, answer.get(name)) for name in ("material", "feet")]
        parts += [(SourceState, state) for state in answer.get("states", ())]
        for kind, part in parts:
            known = [field.name for field in fields(kind)]
            for name in [name for name in part or () if name not in known]:
                wrong = f"{path}: {object_id!r} has a field {name!r}, which does not exist and has no effect."
                warn_of(f"{wrong} {did_you_mean(name, known)}".rstrip(), BundleWarning)


def require_plausible(bundle: BundleContents, folder: Path) -> None:
    """Check sizes against the measured ones, corrected states, and that the scene can provide each needed contact.

    Raises: BundleError: a size that this object's plate cannot have.
    Warns: BundleWarning: a corrected thickness that it cannot have; an object that does not vibrate has loops; an
    object has the name of one material and the constants of another; a state needs a contact that no object in the
    scene can provide; a tactile loop that is silent, too loud or with ends that do not meet; a correction of a state
    that its object does not have.
    """
    objects, scene = bundle.objects, bundle.snapshot
    categories = {item.id: "" for item in scene.objects} | {key: said.object_category for key, said in objects.items()}
    for object_id, haptics in objects.items():
        # An object without a material is no plate, and earlier versions stored its measured size unchecked.
        if haptics.material is not None:
            wrong = plate_sizes.faults(haptics.estimated_size_m, scene.object(object_id).size_m)
            # `override` checked it against the mesh of then. A person may also have written it by hand.
            if "thickness" in wrong and bundle.overrides.get(object_id, NONE).thickness_m is not None:
                warn_of(
                    f"{folder / 'overrides.json'}: thickness_m of {object_id!r} is {wrong.pop('thickness')}. It is "
                    "played as it is.",
                    BundleWarning,
                )
            if wrong:
                faults = "; ".join(f"{edge} is {why}" for edge, why in wrong.items())
                raise BundleError(f"{folder / 'objects.json'}: {object_id}.estimated_size_m: {faults}.")
        if bundle.loops.get(object_id) and not haptics.vibrates:
            warn_of(
                f"{folder / 'objects.json'}: {object_id!r} does not vibrate, but it has loops, which still play. "
                f"Remove them: `scene2hap edit {folder} rebake`.",
                BundleWarning,
            )
        if haptics.material is not None and _are_two_materials(haptics.material_category, haptics.material.name):
            warn_of(
                f"{folder / 'objects.json'}: {object_id!r} has the material_category {haptics.material_category!r}, "
                f"but the constants of {haptics.material.name!r}, which are played. Write both: "
                f"`scene2hap edit {folder} material {object_id} NAME`.",
                BundleWarning,
            )
        for doubt in unmet_needs(object_id, haptics.states, categories):
            warn_of(f"{object_id!r}: {doubt}.", BundleWarning)
    warn_of_edited_loops(bundle, folder)
    for doubt in vain_corrections(objects, bundle.overrides):
        warn_of(f"{folder / 'overrides.json'}: {doubt}", BundleWarning)


def _are_two_materials(one: str, other: str) -> bool:
    """Whether the table has both names, for different materials. Words of a model that it lacks may mean anything."""
    rows = find_row(one), find_row(other)
    return rows[0] is not None and rows[1] is not None and rows[0] != rows[1]


def warn_of_edited_loops(bundle: BundleContents, folder: Path) -> None:
    """Warn of tactile loops that an audio editor has left silent, too loud, or with ends that do not meet.

    Haptic clips that a person drew are left out: they are played as they are. Warns: BundleWarning.
    """
    for object_id, states in bundle.loops.items():
        clip = bundle.overrides.get(object_id, NONE).clip
        for state, loop in states.items():
            doubt = "" if clip is not None and clip.is_vibration else _loop_doubt(loop.tactile.samples)
            if doubt:
                warn_of(f"{folder}: the tactile loop of {object_id!r}, state {state!r}, {doubt}", BundleWarning)


def require_savable(bundle: BundleContents, folder: Path) -> None:
    """Check that all loops are within full scale, as files of integers hold. Raises: BundleError."""
    for object_id, states in bundle.loops.items():
        for state, loop in states.items():
            if max(float(np.abs(clip.samples).max()) for clip in (loop.audible, loop.tactile)) > 1.0:
                raise BundleError(
                    f"{folder}: a loop of {object_id!r}, state {state!r}, peaks over full scale, so that it cannot be "
                    "saved. Lower it in your audio editor."
                )


def _loop_doubt(samples: Samples) -> str:
    """Return the end of a sentence on what is wrong with a loop; empty if nothing is."""
    peak = float(np.abs(samples).max())
    if peak == 0.0:
        return "is silent. To silence an object: `scene2hap edit BUNDLE mute ID`, or silence."
    if peak > 1.0:
        over_db = 20 * np.log10(peak)
        return f"peaks {over_db:.1f} dB over full scale; no edit can save it. Lower it in your audio editor."
    jump = float(abs(samples[0] - samples[-1]))
    if jump > max(_LEAST_JUMP, _USUAL_STEPS * float(np.abs(np.diff(samples)).max(initial=0.0))):
        return (
            f"jumps by {jump:.2g} of full scale where it is repeated, since its end does not meet its beginning; this "
            "is felt as a click. Cross-fade its ends in your audio editor, or let scene2hap find a seam: `scene2hap "
            "edit BUNDLE sound ID FILE`."
        )
    return ""


_LEAST_JUMP, _USUAL_STEPS = 0.01, 2.0
"""A jump is felt if it is above -40 dB re full scale, and above twice the largest step elsewhere; assumed."""


def vain_corrections(objects: Mapping[str, ObjectHaptics], overrides: Mapping[str, Override]) -> list[str]:
    """Return a sentence for each corrected state that a vibrating object does not have."""
    doubts = []
    for object_id, wish in overrides.items():
        states = [state.name for state in objects[object_id].states] if object_id in objects else []
        corrected = {name: [key for key in getattr(wish, name) if key != ANY_STATE] for name in BY_STATE}
        corrected["state"] = [] if wish.state is None else [wish.state]
        for name, keys in corrected.items():
            for key in [key for key in keys if states and key not in states]:
                near = did_you_mean(key, states, f"It has {', '.join(map(repr, states))}.")
                doubts.append(f"{object_id!r} has no state {shown(key)}, so that {name} has no effect. {near}")
    return doubts
