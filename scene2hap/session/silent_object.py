"""Warning of an added object that will not be felt."""

from __future__ import annotations

from collections.abc import Mapping

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.haptics import ObjectHaptics
from scene2hap.scene.scene_warning import warn_of
from scene2hap.session.network import body_of


def warn_if_silent(object_id: str, haptics: ObjectHaptics | None, loops: Mapping[str, HapticLoop]) -> None:
    """Warn of an object that neither vibrates nor carries vibration, or that should vibrate and has no loops.

    Warns: SceneWarning.
    """
    if loops:
        return
    if haptics is not None and haptics.vibrates:
        warn_of(
            f"{object_id!r} is added without loops and stays silent, although its haptics say that it vibrates; give "
            "loops= too, as bundle.loops[id], or bake it by bake_object and add it by session.spawn."
        )
    elif body_of(haptics) is None:
        how = "nothing is known of it" if haptics is None else "its material is unknown"
        warn_of(
            f"{object_id!r} is added without loops, and {how}: it neither vibrates nor carries vibration; give "
            "haptics= and loops=, or bake it by bake_object and add it by session.spawn."
        )
