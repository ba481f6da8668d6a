"""Corrections of a bundle that take effect with the next `rebake`."""

from __future__ import annotations

from scene2hap.bundle.contents import BundleContents


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
