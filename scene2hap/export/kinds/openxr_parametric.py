"""OpenXR, XR_EXT_haptic_parametric: curves and transients, similar to `.haptic`. One file per channel.

The extension is not ratified (number 776, revision 1). A clip of at most 500 points of each kind is one call; a longer
one is a stream of frames. In every frame, times count from the beginning of the clip. Only the first frame has the
frequency range; in the others it is unspecified, 0.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from scene2hap.clips.haptic_clip import Curve, HapticClip
from scene2hap.common import checks
from scene2hap.errors import ConfigError
from scene2hap.export.curves import CurveSettings, curves_of, from_start
from scene2hap.export.protocol import Exported, file_name, json_bytes, nanoseconds
from scene2hap.export.track import Track

MAX_POINTS = 500
"""Most points of each kind in one call (XR_HAPTIC_PARAMETRIC_MAX_POINTS_TRANSIENTS_EXT)."""
_LEAST_HZ = 1.0
"""XR_HAPTIC_PARAMETRIC_FREQUENCY_MIN_HZ_EXT."""

Rows = list[dict[str, Any]]


class OpenXrParametricExport:
    """Write OpenXR calls of the parametric extension, with curves of amplitude and frequency.

    Parameters:
    first_frame_s, frame_s : least length of the first frame of a stream, and of each later one [s]. A runtime reports
        the values that it needs: minimumFirstFrameDuration and idealFrameSubmissionRate of
        XrHapticParametricPropertiesEXT.
    stream : write short clips as streams of frames too.

    Other settings: those of `CurveSettings`; `range_hz` is 20 to 500 Hz.
    Raises: ConfigError.
    """

    def __init__(
        self,
        first_frame_s: float = 0.1,
        frame_s: float = 0.05,
        stream: bool = False,
        range_hz: Any = (20.0, 500.0),
        **settings: Any,
    ) -> None:
        self.first_frame_s: float
        self.frame_s: float
        self.first_frame_s, self.frame_s = (
            checks.number(name, value, "s", at_least=0.001, at_most=10.0, error=ConfigError)
            for name, value in (("first_frame_s", first_frame_s), ("frame_s", frame_s))
        )
        self.stream: bool = checks.flag("stream", stream, error=ConfigError)
        self.settings: CurveSettings = CurveSettings(range_hz=range_hz, **settings)
        checks.number("range_hz[0]", self.settings.range_hz[0], "Hz", at_least=_LEAST_HZ, error=ConfigError)

    def export(self, track: Track) -> Exported:
        """Return one file for each channel."""
        files, played = {}, {}
        for name, channel in track.channels.items():
            clip = curves_of(channel, self.settings)
            clip = replace(clip, frequency=from_start(clip.frequency))
            document = {
                "extension": "XR_EXT_haptic_parametric",
                "loop": channel.is_loop,
                "calls": self._calls(clip),
            }
            files[file_name(track, name, ".json")], played[name] = json_bytes(document), clip
        return Exported(files, played)

    def _calls(self, clip: HapticClip) -> list[dict[str, Any]]:
        amplitude, frequency, transients = _rows(clip)
        counts = max(len(amplitude), len(frequency), len(transients))
        if counts <= MAX_POINTS and not self.stream:
            return [_call("none", clip.range_hz, amplitude, frequency, transients)]
        calls: list[dict[str, Any]] = []
        end = nanoseconds(clip.duration_s)
        edges = self._edges(end, (amplitude, frequency, transients))
        start = -1
        for edge in edges:
            now = [
                [row for row in rows if start < row["time_ns"] <= edge] for rows in (amplitude, frequency, transients)
            ]
            # A runtime cannot interpolate to a point of a later frame, so each frame ends with points of its own.
            for curve, points in ((clip.amplitude, now[0]), (clip.frequency, now[1])):
                if curve is not None and (not points or points[-1]["time_ns"] < edge):
                    value = float(curve.at(np.array([edge / 1e9]))[0])
                    points.append({"time_ns": edge, "value": round(value, 6)})
            kind = "first" if not calls else "last" if edge == end else "intermediate"
            calls.append(_call(kind, clip.range_hz if not calls else (0.0, 0.0), *now))
            start = edge
        if len(calls) == 1:
            calls[0]["stream_frame_type"] = "none"
        return calls

    def _edges(self, end: int, rows: tuple[Rows, ...]) -> list[int]:
        """Return ends of frames of the requested length. A rest of less than 1 ms is added to the last frame."""
        edges = []
        length, edge = nanoseconds(self.first_frame_s), 0
        while edge < end:
            edge = min(edge + length, end)
            if end - edge < 1_000_000:
                edge = end
            edges.append(edge)
            length = nanoseconds(self.frame_s)
        for kind in rows:
            times = np.array([row["time_ns"] for row in kind])
            counts = np.diff(np.searchsorted(times, [-1, *edges], side="right"))
            if counts.size and counts.max() >= MAX_POINTS:
                raise ConfigError(
                    f"a frame of {self.frame_s:g} s has {counts.max()} points; a call holds {MAX_POINTS}. "
                    "Shorten frame_s."
                )
        return edges


def _rows(clip: HapticClip) -> tuple[Rows, Rows, Rows]:
    """Return all points and transients. The amplitude begins at time 0, as the first frame requires."""
    end = nanoseconds(clip.duration_s)
    amplitude = _points(clip.amplitude)
    if amplitude[0]["time_ns"] > 0:
        first = amplitude[0]["time_ns"]
        amplitude = [{"time_ns": 0, "value": 0.0}, {"time_ns": first, "value": 0.0}, *amplitude]
    frequency = _points(clip.frequency) if clip.frequency is not None else []
    for row in frequency:
        row["time_ns"] = min(row["time_ns"], end)
    transients: Rows = []
    for one in clip.transients:
        time = nanoseconds(one.time_s)
        if time <= end and not (transients and transients[-1]["time_ns"] >= time):
            transients.append({"time_ns": time, "amplitude": one.amplitude, "frequency": one.frequency})
    return amplitude, frequency, transients


def _points(curve: Curve) -> Rows:
    return [
        {"time_ns": nanoseconds(time), "value": value}
        for time, value in zip(curve.times_s.tolist(), curve.values.tolist(), strict=True)
    ]


def _call(
    kind: str, range_hz: tuple[float, float], amplitude: Rows, frequency: Rows, transients: Rows
) -> dict[str, Any]:
    return {
        "stream_frame_type": kind,
        "min_frequency_hz": range_hz[0],
        "max_frequency_hz": range_hz[1],
        "amplitude_points": amplitude,
        "frequency_points": frequency,
        "transients": transients,
    }
