"""Corrections of a bundle that take effect with the next `rebake`."""

from __future__ import annotations

from hashlib import sha256

from scene2hap.audio.encoding import sound_digest
from scene2hap.bundle.contents import BundleContents
from scene2hap.bundle.override import ANY_STATE, Override

CORRECTIONS = "corrections"
"""Part of a loop's fingerprint: the digest of the corrections that it was made with."""


def reason_of_name(name: str) -> str:
    """Return the reason that a bake gives an object whose name a person has corrected."""
    return f"a person calls it {name!r}."


def renamed_objects(bundle: BundleContents) -> list[str]:
    """Return the ids of objects whose name a person gave or removed after they were inferred."""
    names = {key: override.name for key, override in bundle.overrides.items()}
    reasons = {key: None if name is None else reason_of_name(name) for key, name in names.items()}
    return [key for key, haptics in bundle.objects.items() if haptics.reasons.get("name") != reasons.get(key)]


def objects_without_states(bundle: BundleContents) -> list[str]:
    """Return the ids of objects that a person wants to vibrate, and that do not yet."""
    return [key for key, one in bundle.overrides.items() if one.vibrates and not bundle.objects[key].vibrates]


def objects_without_loops(bundle: BundleContents) -> list[str]:
    """Return the ids of objects that vibrate and have no loops yet, as after `vibrates=False` was taken back."""
    return [key for key, haptics in bundle.objects.items() if haptics.vibrates and not bundle.loops.get(key)]


def corrections_digest(override: Override, state: str) -> str:
    """Return the digest of a person's sound, intensity and pitch for a state; empty without any."""
    clip, by_state = override.clip, (override.intensity, override.pitch_hz)
    given = [str(numbers.get(state, numbers.get(ANY_STATE, ""))) for numbers in by_state]
    given += [] if clip is None else [sound_digest(clip), str(override.keep), str(clip.is_vibration)]
    given += [] if clip is None or clip.loop is None else [str(clip.loop)]
    return sha256(" ".join(given).encode()).hexdigest()[:16] if any(given) else ""


def objects_with_other_loops(bundle: BundleContents) -> list[str]:
    """Return the ids of objects whose sound, intensity or pitch a person corrected after their loops were made."""
    overrides = {key: bundle.overrides.get(key, Override()) for key in bundle.loops}
    return [
        key
        for key, states in bundle.loops.items()
        if not overrides[key].locked
        and any(
            corrections_digest(overrides[key], state) != loop.fingerprint[CORRECTIONS]
            for state, loop in states.items()
            if CORRECTIONS in loop.fingerprint  # not in handmade loops, and in those of earlier versions
        )
    ]
