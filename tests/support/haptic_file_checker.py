"""Check decoded haptic files against the published rules of their formats, independently of the library's exporters.

Sources: Meta's haptic_data/src/v1.rs, Apple's AHAP guide, MPEG's IOJson.cpp and the text of XR_EXT_haptic_parametric.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from datetime import datetime
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

Samples = NDArray[np.float64]
JOINT = 1e-6
ABOVE_ZERO = math.ulp(0.0)
INT32, UINT32, INT64 = 2**31 - 1, 2**32 - 1, 2**63 - 1


class _Reading:
    """The faults of a document. If values are missing or of a wrong type, rules between values are not checked."""

    def __init__(self, shape: _Shape, document: object, where: str = "document") -> None:
        self.told: list[str] = []
        self.broken = False
        shape(document, where, self)

    def tell(self, where: str, sentence: str, *, breaks: bool = False) -> None:
        self.told.append(f"{where} {sentence}.")
        self.broken |= breaks

    def ordered(self, values: Iterable[float], where: str, *, strictly: bool = False) -> None:
        for before, after in pairwise(values):
            if after < before or (strictly and after == before):
                self.tell(where, f"go from {before} to {after}")
                return

    def unique(self, rows: Sequence[Any], where: str) -> None:
        if len({row["id"] for row in rows}) < len(rows):
            self.tell(where, "have ids that are not unique")


_Shape = Callable[[Any, str, _Reading], None]
_Shapes = Mapping[str, _Shape]


def _number(low: float = -math.inf, high: float = math.inf, kind: type = float) -> _Shape:
    def read(value: Any, where: str, found: _Reading) -> None:
        # JSON may write a float without a point. All formats read at most 32-bit floats.
        right = isinstance(value, int | kind) and not isinstance(value, bool)
        if not right or not abs(value) <= float(np.finfo(np.float32).max):
            found.tell(where, f"is not a finite {'number' if kind is float else 'integer'}", breaks=True)
        elif not low <= value <= high:
            found.tell(where, f"is {value}, not from {low} to {high}")

    return read


def _kind(kind: type, *allowed: str) -> _Shape:
    def read(value: Any, where: str, found: _Reading) -> None:
        if not isinstance(value, kind) or (allowed and value not in allowed):
            found.tell(where, f"is {value!r}, not {' or '.join(allowed) or f'a {kind.__name__}'}", breaks=True)

    return read


def _items(shape: _Shape, least: int = 0, most: float = math.inf) -> _Shape:
    def read(value: Any, where: str, found: _Reading) -> None:
        if not isinstance(value, list):
            found.tell(where, "is not a list", breaks=True)
            return
        if not least <= len(value) <= most:
            found.tell(where, f"has {len(value)} items, not {least} to {most}", breaks=len(value) < least)
        for i, one in enumerate(value):
            shape(one, f"{where}[{i}]", found)

    return read


def _object(needed: _Shapes, optional: _Shapes | None = None, *, others: bool = False) -> _Shape:
    """An object that has the needed keys, may have the optional ones, and unknown ones only if `others`."""
    shapes = {**needed, **(optional or {})}

    def read(value: Any, where: str, found: _Reading) -> None:
        if not isinstance(value, dict):
            found.tell(where, "is not an object", breaks=True)
            return
        for key in sorted(needed.keys() - value.keys()):
            found.tell(where, f"lacks {key}", breaks=True)
        for key, one in value.items():
            if key in shapes:
                shapes[key](one, f"{where}.{key}", found)
            elif not others:
                found.tell(where, f"has an unknown key {key!r}")

    return read


_open = partial(_object, others=True)
_integer, _text = partial(_number, kind=int), partial(_kind, str)
UNIT, TIME, TEXT, NUMBER, BOOLEAN = _number(0, 1), _number(0), _text(), _number(), _kind(bool)
TICK, ID, COUNT = _integer(0, INT32), _integer(0, INT32), _integer(0, UINT32)

# -- Meta .haptic: unknown keys are allowed, since Meta's reader ignores them ------------------------------------------
_EMPHASIS = {"emphasis": _open({"amplitude": UNIT, "frequency": UNIT})}
_ENVELOPES = _open(
    {"amplitude": _items(_open({"time": TIME, "amplitude": UNIT}, _EMPHASIS), 2)},
    {"frequency": _items(_open({"time": TIME, "frequency": UNIT}))},
)
_METADATA = {"tags": _items(TEXT)} | dict.fromkeys(["editor", "author", "source", "project", "description"], TEXT)
_VERSIONS = _open({"major": _integer(1, 1)}, {"minor": COUNT, "patch": COUNT})
_SIGNALS = _open({"continuous": _open({"envelopes": _ENVELOPES})})
_HAPTIC = _open({"version": _VERSIONS, "signals": _SIGNALS}, {"metadata": _open({}, _METADATA)})


def check_haptic(document: object, *, legacy: bool = False) -> list[str]:
    """Check a .haptic document against Meta's Strict rules; `legacy` drops the rule on the span of the frequency."""
    found = _Reading(_HAPTIC, document)
    if found.broken:
        return found.told
    points, others = _points(document, "amplitude"), _points(document, "frequency")
    found.ordered((one["time"] for one in points), "times of amplitude points")
    found.ordered((one["time"] for one in others), "times of frequency points")
    start, end = points[0]["time"], points[-1]["time"]
    # Meta reads float32, in which two close times may be equal.
    if not np.float32(end) > np.float32(start):
        found.tell("the amplitude envelope", "has no duration above 0")
    for one in points:
        if "emphasis" in one and one["emphasis"]["amplitude"] < one["amplitude"]:
            found.tell(f"the emphasis at {one['time']}", "has an amplitude below its point's")
    outside = [one["time"] for one in others if not start <= one["time"] <= end]
    if outside and not legacy:
        found.tell(f"the frequency point at {outside[0]}", f"lies outside the amplitude envelope, {start} to {end}")
    return found.told


def haptic_duration_s(document: Any) -> float:
    return float(_points(document, "amplitude")[-1]["time"])


def haptic_amplitude(document: Any, times: Samples) -> Samples:
    """Amplitudes at times. Outside the clip, the first or the last point applies."""
    return _line(_points(document, "amplitude"), "time", "amplitude", times)


def haptic_frequency(document: Any, times: Samples) -> Samples:
    """Frequencies from 0 to 1 at times, 0.5 if the clip has no points."""
    points = _points(document, "frequency")
    return _line(points, "time", "frequency", times) if points else np.full(len(times), 0.5)


def _points(document: Any, name: str) -> Any:
    return document["signals"]["continuous"]["envelopes"].get(name, [])


def _line(points: Any, time: str, value: str, times: Samples) -> Samples:
    # At a jump (two points at one time), np.interp takes the later one.
    return np.interp(times, [float(one[time]) for one in points], [float(one[value]) for one in points])


# -- Apple AHAP --------------------------------------------------------------------------------------------------------
_PARAMETER = _object({"ParameterID": _text("HapticIntensity", "HapticSharpness"), "ParameterValue": UNIT})
_EVENT = _object(
    {"Time": TIME, "EventType": _text("HapticContinuous", "HapticTransient"), "EventParameters": _items(_PARAMETER)},
    {"EventDuration": _number(ABOVE_ZERO, 30)},
)
_CONTROLS = ("HapticIntensityControl", "HapticSharpnessControl")
_CONTROL_POINTS = _items(_object({"Time": TIME, "ParameterValue": UNIT}), 1, 16)
_CURVE = _object({"ParameterID": _text(*_CONTROLS), "Time": TIME, "ParameterCurveControlPoints": _CONTROL_POINTS})


def _pattern_item(value: Any, where: str, found: _Reading) -> None:
    if isinstance(value, dict) and len(value.keys() & {"Event", "ParameterCurve"}) != 1:
        found.tell(where, "does not have exactly one of Event and ParameterCurve", breaks=True)
    else:
        _object({}, {"Event": _EVENT, "ParameterCurve": _CURVE})(value, where, found)


def check_ahap(document: Any) -> list[str]:
    """Check an AHAP document against Apple's rules, and that its events and curves join without a gap."""
    found = _Reading(_object({"Version": _number(1, 1), "Pattern": _items(_pattern_item)}), document)
    if found.broken:
        return found.told
    events = [one["Event"] for one in document["Pattern"] if "Event" in one]
    for one in events:
        if (one["EventType"] == "HapticContinuous") != ("EventDuration" in one):
            found.tell(f"the {one['EventType']} at {one['Time']}", "has an EventDuration, or lacks one, wrongly")
        # Apple allows both to be missing, but then a default applies that is not in the published rules.
        if sorted(row["ParameterID"] for row in one["EventParameters"]) != ["HapticIntensity", "HapticSharpness"]:
            found.tell(f"the event at {one['Time']}", "does not have one HapticIntensity and one HapticSharpness")
    for before, after in pairwise(one for one in events if one["EventType"] == "HapticContinuous"):
        if abs(after["Time"] - before["Time"] - before.get("EventDuration", 0)) > JOINT:
            found.tell(f"the continuous event at {after['Time']}", "does not begin where the one before ends")
    for name in _CONTROLS:
        curves = _curves(document, name)
        found.ordered((one["Time"] for one in curves), f"times of {name} curves")
        for one in curves:
            at = (point["Time"] for point in one["ParameterCurveControlPoints"])
            found.ordered(at, f"times of the control points of the {name} curve at {one['Time']}")
        for before, after in pairwise(curves):
            end, start = before["ParameterCurveControlPoints"][-1], after["ParameterCurveControlPoints"][0]
            gap = after["Time"] + start["Time"] - before["Time"] - end["Time"]
            if abs(gap) > JOINT or abs(start["ParameterValue"] - end["ParameterValue"]) > JOINT:
                found.tell(f"the {name} curve at {after['Time']}", "does not begin where the one before ends")
    return found.told


def ahap_duration_s(documents: Sequence[Any]) -> float:
    """The latest end of all events. A transient has no length, since Apple defines none."""
    events = (one["Event"] for document in documents for one in document["Pattern"] if "Event" in one)
    return max((float(one["Time"] + one.get("EventDuration", 0)) for one in events), default=0.0)


def ahap_intensity(document: Any, times: Samples, *, absolute: bool = False) -> Samples:
    """Intensity of the continuous events times its control, 0 where there is no event.

    `absolute` reads the points' times as file times in curves whose time is above 0, as Meta writes them.
    """
    return np.clip(_base(document, times, "HapticIntensity") * _control(document, times, _CONTROLS[0], absolute), 0, 1)


def ahap_sharpness(document: Any, times: Samples, *, absolute: bool = False) -> Samples:
    """Sharpness of the continuous events plus its control, the control alone where there is no event."""
    return np.clip(_base(document, times, "HapticSharpness") + _control(document, times, _CONTROLS[1], absolute), 0, 1)


def ahap_transients(document: Any) -> list[tuple[float, float, float]]:
    """Time, intensity and sharpness of each transient, in order."""
    found = _events(document, "HapticTransient")
    return sorted((one["Time"], _value(one, "HapticIntensity"), _value(one, "HapticSharpness")) for one in found)


def _events(document: Any, kind: str) -> list[Any]:
    found = [one["Event"] for one in document["Pattern"] if one.get("Event", {}).get("EventType") == kind]
    return sorted(found, key=lambda one: float(one["Time"]))


def _curves(document: Any, name: str) -> list[Any]:
    found = (one["ParameterCurve"] for one in document["Pattern"] if "ParameterCurve" in one)
    return [one for one in found if one["ParameterID"] == name]


def _value(event: Any, name: str) -> float:
    return float(next(one["ParameterValue"] for one in event["EventParameters"] if one["ParameterID"] == name))


def _base(document: Any, times: Samples, name: str) -> Samples:
    values = np.zeros(len(times))
    for one in _events(document, "HapticContinuous"):
        # Widened by the rounding tolerance, so that joints leave no gap.
        inside = (times >= one["Time"] - JOINT) & (times <= one["Time"] + one["EventDuration"] + JOINT)
        values[inside] = _value(one, name)
    return values


def _control(document: Any, times: Samples, name: str, absolute: bool) -> Samples:
    values = np.full(len(times), 1.0 if name == "HapticIntensityControl" else 0.0)
    for curve in sorted(_curves(document, name), key=lambda one: float(one["Time"])):
        points = curve["ParameterCurveControlPoints"]
        shift = 0.0 if absolute and curve["Time"] > 0 else float(curve["Time"])
        begun = times >= shift + points[0]["Time"]
        values[begun] = _line(points, "Time", "ParameterValue", times[begun] - shift)
    return values


# -- MPEG HJIF: the rules of the loader, without its JSON schema -------------------------------------------------------
_VERSION = re.compile(r"(\d{4})(-[1-9])?", re.ASCII)
_DATE = re.compile(r"\d{4}(-\d\d(-\d\d(T\d\d:\d\d(:\d\d(\.\d+)?)?(Z|[+-]\d\d:\d\d)?)?)?)?", re.ASCII)
_TIMESCALES = {"Simple Parametric": (1000, 1000), "Main": (1, 48_000)}
_MOST = {1: (127, 7), 2: (65_535, 63)}  # channels of a perception and bands of a channel, by level
_BODY_PARTS = (
    "Unknown,All,Top,Down,Right,Left,Front,Back,Arm,Head,Chest,Waist,Leg,Upper-arm,Forearm,Hand,Crane,Neck,Thigh,Calf,"
    "Foot,Palm,Finger,Sole,Toe,Thumb,Index,Middle,Ring,Pinky,Hallux,Index-toe,Middle-toe,Ring-toe,Pinky-toe,"
    "First Phalanx,Second Phalanx,Third Phalanx,Minus,Plus"
)
_CURVE_TYPES = ("Unknown", "Cubic", "Linear", "Akima", "Bezier", "Bspline")
_HERTZ = ("minimum_frequency", "resonance_frequency", "maximum_frequency")
_DEVICE_NUMBERS = "maximum_amplitude impedance maximum_voltage maximum_current maximum_displacement weight size custom"
_DEVICE_REST = {"body_part_mask": COUNT, "type": TEXT} | dict.fromkeys([*_HERTZ, *_DEVICE_NUMBERS.split()], NUMBER)
_DEVICE = _object({"id": ID, "name": TEXT}, _DEVICE_REST)
_AVATAR_TYPE = _text("Vibration", "Pressure", "Temperature", "Custom")
# 0 means "no avatar".
_AVATAR = _object({"id": _integer(1, INT32), "lod": TICK, "type": _AVATAR_TYPE}, {"mesh": TEXT})
_KEYFRAME = _object({"relative_position": TICK, "amplitude_modulation": NUMBER}, {"frequency_modulation": TICK})
_EFFECT = {"effect_type": _text("Basis"), "position": TICK, "phase": NUMBER, "keyframes": _items(_KEYFRAME, 1)} | {
    "base_signal": _text("Sine", "Square", "Triangle", "SawToothUp", "SawToothDown")
}


def _hjif(profile: str) -> _Shape:
    bands = ["Transient", "Curve", "VectorialWave"] + ["WaveletWave"] * (profile == "Main")
    effects = _items(_object(_EFFECT, {"id": ID}))
    band = _object(
        {"band_type": _text(*bands), "lower_frequency_limit": TICK, "upper_frequency_limit": TICK, "effects": effects},
        {"curve_type": _text(*_CURVE_TYPES), "block_length": _integer(1, INT32)},
    )
    channel = _object(
        {"id": ID, "description": TEXT, "body_part_mask": COUNT, "bands": _items(band)}
        | {"gain": NUMBER, "mixing_coefficient": NUMBER},
        {"frequency_sampling": COUNT, "sample_count": COUNT, "reference_device_id": ID, "vertices": _items(ID)}
        | {"body_part_target": _items(_text(*_BODY_PARTS.split(",")))}
        | {"direction": _object(dict.fromkeys("XYZ", _integer(-128, 127)))},
    )
    exponent = _integer(-INT32 - 1, INT32)
    # The loader refuses any effect_semantic_scheme, so here this key is unknown.
    perception = _object(
        {"id": ID, "avatar_id": ID, "description": TEXT, "perception_modality": _text("Vibrotactile")}
        | {"effect_library": _items(_object(_EFFECT | {"id": ID}))}
        | {"channels": _items(channel), "reference_devices": _items(_DEVICE)},
        {"unit_exponent": exponent, "perception_unit_exponent": exponent},
    )
    return _object(
        {"version": TEXT, "profile": _text(profile), "level": _integer(1, 2), "date": TEXT, "description": TEXT}
        | {"timescale": _integer(*_TIMESCALES[profile]), "avatars": _items(_AVATAR), "perceptions": _items(perception)}
        | {"syncs": _items(_object({"timestamp": TICK}, {"timescale": _integer(1, UINT32)}))}
    )


def check_hjif(document: Any, profile: str) -> list[str]:
    """Check an HJIF document of a profile against the rules of MPEG's loader."""
    found = _Reading(_hjif(profile), document)
    if found.broken:
        return found.told
    year = _VERSION.fullmatch(document["version"])
    if year is None or int(year[1]) < 2023:
        found.tell("the version", f"is {document['version']!r}, not a year from 2023 on, maybe with an amendment")
    date = document["date"]
    try:
        datetime.fromisoformat(date + "-01-01"[len(date) - 4 :] if len(date) < 10 else date)
        right = _DATE.fullmatch(date) is not None
    except ValueError:
        right = False
    if not right:
        found.tell("the date", f"is {date!r}, which is not in ISO 8601")
    found.unique(document["avatars"], "avatars")
    found.unique(document["perceptions"], "perceptions")
    most_channels, most_bands = _MOST.get(document["level"], _MOST[2])
    for one in document["perceptions"]:
        where = f"perception {one['id']}"
        if one["avatar_id"] and one["avatar_id"] not in [avatar["id"] for avatar in document["avatars"]]:
            found.tell(where, f"has the avatar {one['avatar_id']}, which does not exist")
        for name in ("effect_library", "channels", "reference_devices"):
            found.unique(one[name], f"{name} of {where}")
        for device in one["reference_devices"]:
            found.ordered((device[name] for name in _HERTZ if name in device), f"frequencies of device {device['id']}")
        for effect in one["effect_library"]:
            found.ordered(_ticks(effect), f"keyframes of library effect {effect['id']}")
        if len(one["channels"]) > most_channels:
            found.tell(where, f"has {len(one['channels'])} channels, more than {most_channels}")
        for channel in one["channels"]:
            at = f"channel {channel['id']} of {where}"
            if channel.get("reference_device_id") not in [None, *(device["id"] for device in one["reference_devices"])]:
                found.tell(at, f"has the device {channel['reference_device_id']}, which does not exist")
            # Bounds of MPEG's IOConformance.h: 127 is one unit.
            direction = channel.get("direction", {"X": 127, "Y": 0, "Z": 0})
            if not 15_692 <= sum(direction[axis] ** 2 for axis in "XYZ") <= 16_572:
                found.tell(at, "has a direction that is not a unit vector")
            if len(channel["bands"]) > most_bands:
                found.tell(at, f"has {len(channel['bands'])} bands, more than {most_bands}")
            for i, band in enumerate(channel["bands"]):
                _check_band(band, f"band {i} of {at}", found)
    return found.told


def _check_band(band: Any, where: str, found: _Reading) -> None:
    kind, low, high = band["band_type"], band["lower_frequency_limit"], band["upper_frequency_limit"]
    if low >= high:
        found.tell(where, f"has the lower limit {low}, which is not below the upper one, {high}")
    if "curve_type" in band and kind != "Curve":
        found.tell(where, f"has a curve_type but is a {kind} band")
    if ("block_length" in band) != (kind == "WaveletWave"):
        found.tell(where, f"is a {kind} band {'with' if 'block_length' in band else 'without'} a block_length")
    elif "block_length" in band and band["block_length"].bit_count() != 1:
        found.tell(where, f"has the block_length {band['block_length']}, which is not a power of 2")
    for i, effect in enumerate(band["effects"]):
        found.ordered(_ticks(effect), f"keyframes of effect {i} of {where}")
        hertz = [one.get("frequency_modulation") for one in effect["keyframes"]]
        # Curve and wavelet bands have no frequency to modulate.
        if None in hertz and kind in ("Transient", "VectorialWave"):
            found.tell(f"effect {i} of {where}", "has a keyframe without frequency_modulation")
        if any(one is not None and not low <= one <= high for one in hertz):
            found.tell(f"effect {i} of {where}", f"has a frequency_modulation outside {low} to {high}")
    if kind == "VectorialWave":
        found.ordered((one["position"] for one in band["effects"]), f"positions of effects of {where}")
        for before, after in pairwise(sorted(band["effects"], key=lambda one: int(one["position"]))):
            if after["position"] < before["position"] + _ticks(before)[-1]:
                found.tell(where, f"has an effect at {after['position']}, within another")


def _ticks(effect: Any) -> list[int]:
    return [one["relative_position"] for one in effect["keyframes"]]


def hjif_duration_s(document: Any) -> float:
    """The time of the last keyframe of all effects. A transient has no length."""
    channels = (channel for perception in document["perceptions"] for channel in perception["channels"])
    effects: Iterator[Any] = (one for channel in channels for band in channel["bands"] for one in band["effects"])
    ends = (one["position"] + _ticks(one)[-1] for one in effects)
    return float(max(ends, default=0)) / float(document["timescale"])


# -- OpenXR ------------------------------------------------------------------------------------------------------------
_PCM = _object(
    {"extension": _text("XR_FB_haptic_pcm"), "sample_rate_hz": _number(ABOVE_ZERO), "loop": BOOLEAN, "samples": TEXT}
    | {"sample_count": _integer(1, UINT32), "buffer_size": _integer(1, 4000)}
)
_ENVELOPE_CALL = _object({"duration_ns": _integer(1, INT64), "amplitudes": _items(UNIT, 1, 4000)})
_ENVELOPE = _object(
    {"extension": _text("XR_FB_haptic_amplitude_envelope"), "loop": BOOLEAN, "calls": _items(_ENVELOPE_CALL, 1)}
)
_SERIES = ("amplitude_points", "frequency_points")
_NS = _integer(0, INT64)
_PARAMETRIC_CALL = _object(
    dict.fromkeys(_SERIES, _items(_object({"time_ns": _NS, "value": UNIT}), 0, 500))
    | {"transients": _items(_object({"time_ns": _NS, "amplitude": UNIT, "frequency": UNIT}), 0, 500)}
    | dict.fromkeys(["min_frequency_hz", "max_frequency_hz"], _number(0, 1000))
    | {"stream_frame_type": _text("none", "first", "intermediate", "last")}
)
_PARAMETRIC = _object(
    {"extension": _text("XR_EXT_haptic_parametric"), "loop": BOOLEAN, "calls": _items(_PARAMETRIC_CALL, 1)}
)


def check_openxr_pcm(header: Any, samples: bytes) -> list[str]:
    """Check a header and its samples against XR_FB_haptic_pcm."""
    found = _Reading(_PCM, header, "header")
    if not found.broken and not re.fullmatch(r"[^/\\]+", header["samples"]):
        found.tell("header.samples", f"is {header['samples']!r}, not a file name")
    if not found.broken and len(samples) != 4 * header["sample_count"]:
        found.tell("the content", f"has {len(samples)} bytes, not 4 for each of {header['sample_count']} samples")
    values = np.frombuffer(samples[: len(samples) // 4 * 4], "<f4")
    if not np.all(np.abs(values) <= 1.0):  # a NaN compares as false
        found.tell("the content", "has a sample that is not from -1 to 1")
    return found.told


def check_openxr_envelope(document: object) -> list[str]:
    """Check a document against XR_FB_haptic_amplitude_envelope."""
    return _Reading(_ENVELOPE, document).told


def check_openxr_parametric(document: Any, *, first_frame_ns: int = 50_000_000) -> list[str]:
    """Check a document against XR_EXT_haptic_parametric, for a runtime that requires a first frame of so many ns."""
    found = _Reading(_PARAMETRIC, document)
    if found.broken:
        return found.told
    calls = document["calls"]
    kinds = [call["stream_frame_type"] for call in calls]
    if kinds != ["none"] and kinds != ["first", *["intermediate"] * (len(kinds) - 2), "last"]:
        found.tell("the calls", "are neither one with everything nor a first, any intermediate and a last frame")
    for i, call in enumerate(calls):
        begins = call["stream_frame_type"] in ("none", "first")
        amplitudes = call["amplitude_points"]
        if len(amplitudes) < 1 + begins:
            found.tell(f"call {i}", f"has {len(amplitudes)} amplitude points, fewer than {1 + begins}")
        for name in _SERIES:
            if begins and call[name] and call[name][0]["time_ns"] != 0:
                found.tell(f"call {i}", f"has {name} that do not start at 0")
        if call["stream_frame_type"] == "first" and amplitudes and amplitudes[-1]["time_ns"] < first_frame_ns:
            found.tell(f"call {i}", f"is a first frame shorter than {first_frame_ns} ns")
        low, high = call["min_frequency_hz"], call["max_frequency_hz"]
        if (low or high) and not (begins and 1 <= low <= high):
            found.tell(f"call {i}", f"has the range {low} to {high} Hz, not within 1 to 1000, or not in the first call")
    last = max((one["time_ns"] for call in calls for one in call["amplitude_points"]), default=-1)
    for name in (*_SERIES, "transients"):
        times = [one["time_ns"] for call in calls for one in call[name]]
        found.ordered(times, f"times of {name}", strictly=name == "transients")
        if times and times[-1] > last:
            found.tell(f"the last of the {name}", "lies after the last amplitude point")
    return found.told


def envelope_duration_s(document: Any) -> float:
    return float(sum(call["duration_ns"] for call in document["calls"])) / 1e9


def parametric_duration_s(document: Any) -> float:
    return float(document["calls"][-1]["amplitude_points"][-1]["time_ns"]) / 1e9


# -- Android -----------------------------------------------------------------------------------------------------------
_ANDROID = _object(
    {"timings_ms": _items(_integer(1, 10), 1), "amplitudes": _items(_integer(0, 255), 1), "repeat": _integer(-1, 0)}
)


def check_android(document: Any) -> list[str]:
    """Check a document against the arguments of createWaveform, in steps of 10 ms."""
    found = _Reading(_ANDROID, document)
    if not found.broken and len(document["timings_ms"]) != len(document["amplitudes"]):
        found.tell("document", "does not have as many timings as amplitudes")
    if not found.broken and any(1 <= one < 10 for one in document["timings_ms"][:-1]):
        found.tell("document.timings_ms", "has a step below 10 ms before the last one")
    return found.told


def android_duration_s(document: Any) -> float:
    return float(sum(document["timings_ms"])) / 1e3
