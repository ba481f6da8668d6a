"""HJIF, the JSON form of MPEG haptics coding (ISO/IEC 23090-31). One file per track, one channel per hand.

The continuous part is a band of vectorial waves: sine waves whose amplitude and frequency follow keyframes. Transients
are a band of their own. The required fields are those of the loader of MPEG's reference software (`IOJson`).
"""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from scene2hap.clips.haptic_clip import Curve, HapticClip, Transient
from scene2hap.common import checks
from scene2hap.errors import ConfigError
from scene2hap.export.curves import CurveSettings, curves_of, from_start
from scene2hap.export.protocol import Exported, json_bytes
from scene2hap.export.track import Track

SUFFIX = ".hjif"
Profile = Literal["Simple Parametric", "Main"]
_TIMESCALE = {"Simple Parametric": 1000, "Main": 48_000}
"""Ticks per second: the required number for the first profile, and the largest allowed number for the second."""
_DATE = "2023-01-01"
"""Date of the standard's edition. With the date of writing, equal exports would differ."""
_MOST_CHANNELS = 127
_BODY_PARTS = {"left": ["Left", "Hand"], "right": ["Right", "Hand"]}
_TRANSIENT_HZ = (65.0, 300.0)
"""Frequency range of transients in MPEG's encoder, from dull to sharp."""


class HjifExport:
    """Write curves as HJIF files of MPEG haptics.

    Parameters: profile : "Simple Parametric", with times in milliseconds, or "Main", with times in 1/48,000 s. Other
        settings: those of `CurveSettings`.
    Raises: ConfigError.
    """

    def __init__(self, profile: Profile = "Simple Parametric", range_hz: Any = (20.0, 1000.0), **settings: Any) -> None:
        if profile not in _TIMESCALE:
            raise ConfigError(f"profile is {checks.represented(profile)}; it must be {' or '.join(_TIMESCALE)}.")
        self.profile = profile
        self.settings: CurveSettings = CurveSettings(range_hz=range_hz, **settings)

    def export(self, track: Track) -> Exported:
        """Return one file with all channels. Raises: ConfigError: more channels than a file of level 1 may have."""
        if len(track.channels) > _MOST_CHANNELS:
            raise ConfigError(f"{track.name} has {len(track.channels)} channels; HJIF holds {_MOST_CHANNELS}.")
        ticks = _TIMESCALE[self.profile]
        clips = {name: _on_ticks(curves_of(channel, self.settings), ticks) for name, channel in track.channels.items()}
        channels = [_channel(i, name, clip, ticks) for i, (name, clip) in enumerate(clips.items())]
        document = {
            "version": "2023",
            "profile": self.profile,
            "level": 1,
            "date": _DATE,
            "description": f"{track.name}, written by scene2hap",
            "timescale": ticks,
            "avatars": [],
            "perceptions": [
                {
                    "id": 0,
                    "avatar_id": 0,
                    "description": track.name,
                    "perception_modality": "Vibrotactile",
                    "reference_devices": [],
                    "effect_library": [],
                    "channels": channels,
                }
            ],
            "syncs": [],
        }
        return Exported({f"{track.name}{SUFFIX}": json_bytes(document)}, clips)


def _on_ticks(clip: HapticClip, ticks: int) -> HapticClip:
    """Return the clip with times in whole ticks and frequencies in whole hertz, as in the file."""
    low, high = clip.range_hz
    times = np.round(clip.amplitude.times_s * ticks) / ticks
    times[-1] = max(times[-1], 1 / ticks)  # a clip must not have length 0
    amplitude = Curve(times, clip.amplitude.values)
    frequency = from_start(clip.frequency)
    if frequency is not None:
        whole_hz = np.round(low + (high - low) * frequency.values)
        values = np.clip((whole_hz - low) / (high - low), 0, 1)
        frequency = Curve(np.round(frequency.times_s * ticks) / ticks, values)
    transients = tuple(
        Transient(round(one.time_s * ticks) / ticks, one.amplitude, one.frequency) for one in clip.transients
    )
    return HapticClip(amplitude, frequency, transients, clip.range_hz, clip.about)


def _channel(index: int, name: str, clip: HapticClip, ticks: int) -> dict[str, Any]:
    low, high = (int(edge) for edge in (np.floor(clip.range_hz[0]), np.ceil(clip.range_hz[1])))
    bands = [
        {
            "band_type": "VectorialWave",
            "lower_frequency_limit": low,
            "upper_frequency_limit": high,
            "effects": [_effect(0, _keyframes(clip, ticks))],
        }
    ]
    if clip.transients:
        bands.append(
            {
                "band_type": "Transient",
                "lower_frequency_limit": int(_TRANSIENT_HZ[0]),
                "upper_frequency_limit": int(_TRANSIENT_HZ[1]),
                "effects": [_pulse(one, ticks) for one in clip.transients],
            }
        )
    channel: dict[str, Any] = {
        "id": index,
        "description": name or "vibration",
        "gain": 1.0,
        "mixing_coefficient": 1.0,
        "body_part_mask": 0,
        "bands": bands,
    }
    if name in _BODY_PARTS:
        channel["body_part_target"] = _BODY_PARTS[name]
    return channel


def _effect(position: int, keyframes: list[dict[str, Any]]) -> dict[str, Any]:
    return {
        "effect_type": "Basis",
        "position": position,
        "phase": 0.0,
        "base_signal": "Sine",
        "keyframes": keyframes,
    }


def _keyframes(clip: HapticClip, ticks: int) -> list[dict[str, Any]]:
    """Return amplitude and frequency at every point of either curve."""
    low, high = clip.range_hz
    rows = [
        (round(time * ticks), "amplitude_modulation", value)
        for time, value in zip(clip.amplitude.times_s.tolist(), clip.amplitude.values.tolist(), strict=True)
    ]
    frequency = clip.frequency or Curve(np.array([0.0]), np.array([0.5]))
    rows += [
        (round(time * ticks), "frequency_modulation", round(low + (high - low) * value))
        for time, value in zip(frequency.times_s.tolist(), frequency.values.tolist(), strict=True)
    ]
    frames: list[dict[str, Any]] = []
    for position, name, value in sorted(rows, key=lambda row: row[0]):
        # Points of both curves at one time share a keyframe; a jump has two keyframes.
        if not frames or frames[-1]["relative_position"] != position or name in frames[-1]:
            frames.append({"relative_position": position})
        frames[-1][name] = value
    for frame in frames:
        time = np.array([frame["relative_position"] / ticks])
        frame.setdefault("amplitude_modulation", round(float(clip.amplitude.at(time)[0]), 6))
        frame.setdefault("frequency_modulation", round(float(clip.frequency_hz(time)[0])))
    return frames


def _pulse(one: Transient, ticks: int) -> dict[str, Any]:
    low, high = _TRANSIENT_HZ
    keyframe = {
        "relative_position": 0,
        "amplitude_modulation": one.amplitude,
        "frequency_modulation": round(low + one.frequency * (high - low)),
    }
    return _effect(round(one.time_s * ticks), [keyframe])
