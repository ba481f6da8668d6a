"""The interface of exporters, and the registry of their kinds."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

from scene2hap.export.fidelity import Played
from scene2hap.export.track import Track
from scene2hap.plugins import PluginGroup


@dataclass(frozen=True, eq=False)
class Exported:
    """The files of one track in one format.

    Parameters: files : content by name; played : the signal that a player makes of them, by channel, from which the
        error of the export is measured; empty if unknown.
    """

    files: Mapping[str, bytes]
    played: Mapping[str, Played] = field(default_factory=dict)


class Exporter(Protocol):
    """Interface of writers of tracks in one format. Configuration belongs to the constructor."""

    def export(self, track: Track, /) -> Exported:
        """Return the files of a track. Their names begin with the track's. Raises: ExportError."""
        ...


_KINDS = "scene2hap.export.kinds"

_OPENXR = ("openxr_pcm", "openxr_envelope", "openxr_parametric")

_SYNONYMS: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(("quest", "quest2", "quest3", "metaquest", "meta", "oculus", "unity", "unreal"), ("haptic",)),
    **dict.fromkeys(("iphone", "ios", "apple", "corehaptics"), ("ahap",)),
    **dict.fromkeys(("ps5", "playstation", "psvr", "psvr2"), ("dualsense",)),
    **dict.fromkeys(("openxr", "steamvr", "index", "vive", "pico"), _OPENXR),
    **dict.fromkeys(("mpeg", "hmpg"), ("hjif",)),
    **dict.fromkeys(("phone", "phones", "mobile"), ("ahap", "android")),
    **dict.fromkeys(("sound", "audio", "flac", "mp3"), ("wav", "pcm")),
}
"""Devices and programs, without case, blanks and dashes, and the kinds of files that they play."""

EXPORTS = PluginGroup(
    "scene2hap.exports",
    {
        "haptic": f"{_KINDS}.haptic:HapticExport",
        "ahap": f"{_KINDS}.ahap:AhapExport",
        "hjif": f"{_KINDS}.hjif:HjifExport",
        "openxr_pcm": f"{_KINDS}.openxr_pcm:OpenXrPcmExport",
        "openxr_envelope": f"{_KINDS}.openxr_envelope:OpenXrEnvelopeExport",
        "openxr_parametric": f"{_KINDS}.openxr_parametric:OpenXrParametricExport",
        "android": f"{_KINDS}.android:AndroidExport",
        "dualsense": f"{_KINDS}.dualsense:DualSenseExport",
        "wav": f"{_KINDS}.wav:WavExport",
        "pcm": f"{_KINDS}.pcm:PcmExport",
    },
    {},
    {"export": ("track",)},
    synonyms=_SYNONYMS,
)


def file_name(track: Track, channel: str, suffix: str) -> str:
    """Return the name of a file that holds one channel of a track."""
    return f"{track.name}.{channel}{suffix}" if channel else f"{track.name}{suffix}"


def json_bytes(document: Any) -> bytes:
    """Encode a JSON document. Numbers that JSON cannot represent raise here, not in the reader."""
    return (json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode()


def nanoseconds(time_s: float) -> int:
    """Return a time in whole nanoseconds."""
    return math.floor(time_s * 1e9 + 0.5)
