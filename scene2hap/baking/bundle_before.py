"""The bundle that a bake replaces: its loops, and the bundle as a step back."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from pathlib import Path

from scene2hap.bundle import HapticBundle, Override
from scene2hap.bundle.checking import require_savable
from scene2hap.bundle.reading import read_bundle
from scene2hap.errors import BundleError


def bundle_before(folder: Path, overrides: Mapping[str, Override]) -> HapticBundle | None:
    """Return the bundle in a folder, without its overrides, from which a bake keeps loops; None if it cannot be read.

    Its overrides may be those of the next scene: a person renames objects in them before the scene is baked again.
    Raises: BundleError: it cannot be read, and a person has locked loops in it.
    """
    try:
        return _savable(folder, lambda: HapticBundle(**vars(read_bundle(folder, overrides={}))))
    except BundleError:
        if any(override.locked for override in overrides.values()):
            raise
        return None


def readable_bundle(folder: Path) -> tuple[HapticBundle | None, str]:
    """Return the bundle in a folder, or None and why there is none that can be read and saved: a bake mends it."""
    try:
        return _savable(folder, lambda: HapticBundle.load(folder)), ""
    except BundleError as cause:
        return None, str(cause)


def _savable(folder: Path, load: Callable[[], HapticBundle]) -> HapticBundle:
    """Load a bundle without warnings, which are about values that the bake replaces. Raises: BundleError."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = load()
    require_savable(found, folder)
    return found
