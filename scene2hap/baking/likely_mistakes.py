"""Warnings about bakes that succeed, but in which something is most likely a mistake."""

from __future__ import annotations

import math
from collections.abc import Mapping

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.sensation import LevelWarning, Sensation, level_doubt
from scene2hap.audio.threshold import FREQUENCY_WEBER, NOTICED_DB
from scene2hap.baking.loops import Sounds, in_band_hz
from scene2hap.bundle import BundleWarning, Override
from scene2hap.bundle.checking import vain_corrections
from scene2hap.common.counted import counted, first_of
from scene2hap.common.warning import warn_of
from scene2hap.haptics import ActuatorProfile, ObjectHaptics, is_unknown
from scene2hap.scene.names import names_a_place
from scene2hap.scene.snapshot import SceneSnapshot


def warn_of_scene(scene: SceneSnapshot, objects: Mapping[str, ObjectHaptics]) -> None:
    """Warn of a doubtful scene, or one in which nothing vibrates. Warns: SceneWarning.

    Units are left out, since `load_scene` has warned about them.
    """
    doubts = [found for found in scene.check() if found.kind != "units"]
    for found in doubts:
        warn_of(str(found))
    unknown = [key for key, haptics in objects.items() if is_unknown(haptics.object_category)]
    if len(objects) > 1 and not any(haptics.vibrates for haptics in objects.values()):
        # The loose parts of a merged room have its name.
        is_room = any(names_a_place(item.name) for item in scene.objects)
        is_one_model = 2 * len(unknown) > len(objects) and not is_room
        parts = " If the file is one model of many parts, load it with group=0." if is_one_model else ""
        warn_of(
            f"none of {len(objects)} objects of {scene.name!r} vibrates; nothing will be felt. Give objects names that "
            f"say what they are, let a model look at them (llm), or override(id, vibrates=True).{parts}"
        )
    elif len(objects) == 1 and unknown:
        is_merged = any(found.kind == "merged" for found in doubts)
        merges = "" if is_merged else " If it merges several objects, load it with group='loose' or group='leaf'."
        warn_of(
            f"{scene.name!r} is one object, {scene.objects[0].name!r}, which is unknown; nothing will be felt.{merges} "
            "If it is one object, give it a name that says what it is, or let a model look at it (llm)."
        )


def warn_of_vain_corrections(
    objects: Mapping[str, ObjectHaptics],
    overrides: Mapping[str, Override],
    before: Mapping[str, ObjectHaptics] | None = None,
) -> None:
    """Warn of corrections of absent states, except those that were in vain before. Warns: BundleWarning."""
    known = vain_corrections(before or {}, overrides)
    for doubt in vain_corrections(objects, overrides):
        if doubt not in known:
            warn_of(doubt, BundleWarning)


def warn_of_weak_loops(sounds: Sounds, overrides: Mapping[str, Override], actuator: ActuatorProfile) -> None:
    """Warn of new loops that miss their level or pitch, where a person chose the sound or the pitch.

    Warns: LevelWarning.
    """
    for key, states in sounds.remade.items():
        override = overrides.get(key, Override())
        is_own = override.clip is not None and not override.clip.is_vibration
        for state in states:
            loop, name = sounds.loops[key][state], f"{key}, {state},"
            if loop.felt is None:
                continue
            doubt = ""
            if (pitch_hz := override.pitch_of(state)) is not None:
                doubt = _pitch_doubt(name, in_band_hz(pitch_hz, actuator), loop.felt)
            if not doubt and is_own:
                doubt = level_doubt(name, loop.felt.level_db, loop.felt.asked_level_db)
            if doubt:
                warn_of(doubt, LevelWarning)


def _pitch_doubt(name: str, asked_hz: float, felt: Sensation) -> str:
    """Return the sentence that says how a loop misses its pitch; empty if a hand would notice no difference."""
    missing_db = felt.asked_level_db - felt.level_db
    if felt.own_hz is None or felt.target_hz is None:  # the converter moves nothing
        return ""
    is_elsewhere = abs(math.log(felt.target_hz / asked_hz)) > math.log1p(FREQUENCY_WEBER)
    misses = [f"most at {felt.target_hz:.0f} Hz"] if is_elsewhere else []
    misses += [f"{missing_db:.0f} dB weaker than planned"] if missing_db > NOTICED_DB else []
    if not misses:
        return ""
    return (
        f"{name} has its pitch at {asked_hz:.0f} Hz, but is felt {' and '.join(misses)}. Give a pitch at which the "
        "actuator is stronger, a smaller intensity, or a steadier sound."
    )


def all_have_fingerprints(loops: Mapping[str, Mapping[str, HapticLoop]]) -> bool:
    """Return True if every loop has a fingerprint. Warns: BundleWarning: loops without one."""
    unknown = [key for key, states in loops.items() if not all(loop.fingerprint for loop in states.values())]
    if unknown:
        warn_of(
            f"the loops of {counted(len(unknown), 'source')} ({first_of(unknown, 3)}) have no fingerprint, as in "
            "older bundles, and stay as they are. Give actuator or tactile to make them again.",
            BundleWarning,
        )
    return not unknown
