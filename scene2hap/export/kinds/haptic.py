"""`.haptic`, version 1: Meta Quest (Haptics SDK for Unity, Unreal), and programs that read it. One file per channel."""

from __future__ import annotations

from typing import Any

from scene2hap.clips.haptic_format import SUFFIX, compose_haptic
from scene2hap.export.curves import CurveSettings, curves_of
from scene2hap.export.protocol import Exported, file_name, json_bytes
from scene2hap.export.track import Track


class HapticExport:
    """Write curves as `.haptic` files, for Meta Quest. Settings: those of `CurveSettings`. Raises: ConfigError."""

    def __init__(self, **settings: Any) -> None:
        self.settings: CurveSettings = CurveSettings(**settings)

    def export(self, track: Track) -> Exported:
        """Return one file for each channel."""
        clips = {name: curves_of(channel, self.settings) for name, channel in track.channels.items()}
        files = {file_name(track, name, SUFFIX): json_bytes(compose_haptic(clip)) for name, clip in clips.items()}
        return Exported(files, clips)
