"""Warnings of added objects that will not be felt."""

from __future__ import annotations

from collections.abc import Mapping

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.haptics import ObjectHaptics
from scene2hap.scene.scene_warning import warn_of
from scene2hap.session.network import body_of

MOST_NAMED = 10
"""Further silent objects of a session are not named: a game may spawn thousands, and Python keeps each text."""


class SilentObjects:
    """Warn of objects that neither vibrate nor carry vibration, or that should vibrate and have no loops."""

    def __init__(self) -> None:
        self._n_named = 0

    def look(self, object_id: str, haptics: ObjectHaptics | None, loops: Mapping[str, HapticLoop]) -> None:
        """Look at an object that is added. Warns: SceneWarning."""
        if loops or self._n_named == MOST_NAMED:
            return
        if haptics is not None and haptics.vibrates:
            why, what = "of which the haptics say that it vibrates", "stays silent"
        elif body_of(haptics) is None:
            why = "of which nothing is known" if haptics is None else "of unknown material"
            what = "neither vibrates nor carries vibration"
        else:
            return
        self._n_named += 1
        last = " Further silent objects are not named." if self._n_named == MOST_NAMED else ""
        warn_of(
            f"{object_id!r}, {why}, is added without loops: it {what}; give haptics= and loops=, as a bundle has "
            f"them, or bake it by bake_object and add it by session.spawn.{last}"
        )
