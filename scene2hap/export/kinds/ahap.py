"""AHAP: iPhone (Core Haptics). One file per channel, or two with transients, to be played together."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from scene2hap.clips.ahap import SUFFIX, compose_ahap
from scene2hap.export.curves import CurveSettings, curves_of, from_start
from scene2hap.export.protocol import Exported, file_name, json_bytes
from scene2hap.export.track import Track


class AhapExport:
    """Write curves as AHAP files, for iPhone. Settings: those of `CurveSettings`. Raises: ConfigError."""

    def __init__(self, **settings: Any) -> None:
        self.settings: CurveSettings = CurveSettings(**settings)

    def export(self, track: Track) -> Exported:
        """Return one or two files for each channel."""
        clips = {name: curves_of(channel, self.settings, power=2.0) for name, channel in track.channels.items()}
        files = {
            file_name(track, name, f"{ending}{SUFFIX}"): json_bytes(document)
            for name, clip in clips.items()
            for ending, document in compose_ahap(clip).items()
        }
        # Until its sharpness curve begins, an event has its own sharpness, which is 0.
        played = {name: replace(clip, frequency=from_start(clip.frequency, before=0.0)) for name, clip in clips.items()}
        return Exported(files, played)
