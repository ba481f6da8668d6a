"""AHAP, Apple's pattern of haptic events and parameter curves ("Representing haptic patterns in AHAP files").

Intensity is the root of an amplitude, and the sharpness of continuous events the root of a frequency, as in Meta's
haptics SDK (`core/haptic_data/src/ahap.rs`); Apple publishes neither. Curves act on every event of their file, so
continuous events and transients are in two files. At a transient the continuous intensity is lowered to 0.8 of its
value, so that the two do not cancel each other.

Times of control points are relative to their curve. Some programs write them from the file's beginning instead. We
recognise such a curve if it starts after 0, and its first point has the curve's own time.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, field
from operator import itemgetter
from pathlib import Path
from typing import Any

import numpy as np

from scene2hap.clips.fields import Fields, read_fields, rising_times
from scene2hap.clips.haptic_clip import (
    MAX_CLIP_S,
    ClipMetadata,
    ClipWarning,
    Curve,
    HapticClip,
    Transient,
    Values,
)
from scene2hap.common.warning import warn_of
from scene2hap.errors import ClipError

SUFFIX = ".ahap"
MAX_EVENT_S = 30.0
"""Longest continuous event [s]."""
MAX_CURVE_POINTS = 16
"""Most points of one curve. Lofelt's exporter uses this bound; Apple's documentation names none."""
TRANSIENT_DIP = 0.8

_INTENSITY, _SHARPNESS = "HapticIntensity", "HapticSharpness"
_NEUTRAL = {"AttackTime": 0.0, "DecayTime": 0.0, "ReleaseTime": 0.0, "Sustained": 1.0}
"""Values of parameters of an event that change nothing."""
_MOST_EVENTS = 200
"""Most continuous events of one file (assumed: ten times as many as a clip of ten minutes needs)."""
_DECIMALS = 9
"""Decimals of points' times [s]. With these, adding a curve's time and subtracting it again changes nothing."""
_AFTER_S = 0.05
"""Time that a clip continues after its last transient [s]: the length of a transient's pulse."""

Points = list[tuple[float, float]]
_time_of = itemgetter(0)


@dataclass(frozen=True)
class _Event:
    """A continuous event: its start and end [s], intensity and sharpness."""

    start_s: float
    end_s: float
    intensity: float
    sharpness: float


@dataclass
class _Control:
    """The points of all curves and parameters of one kind, in order of time, and the value before them.

    Times are from the file's beginning.
    """

    neutral: float
    parts: list[Points] = field(default_factory=list)
    points: Points = field(default_factory=list)

    def join(self) -> None:
        """Join the parts, each a curve or a single parameter. Between two parts the last value holds, as on the
        phone."""
        rows = [(time, value, i == 0) for part in self.parts for i, (time, value) in enumerate(part)]
        rows.sort(key=_time_of)  # a file may have its curves in any order
        for time, value, begins in rows:
            if begins and self.points and self.points[-1] != (time, value):
                self.points.append((time, self.points[-1][1]))
            self.points.append((time, value))

    def at(self, time_s: float, *, before: bool = False) -> float:
        """Return the value at a time, or just `before` it. Before the first curve it is the neutral value."""
        after = (bisect_left if before else bisect_right)(self.points, time_s, key=_time_of)
        if after == 0:
            return self.neutral
        (t0, v0), (t1, v1) = self.points[after - 1], self.points[min(after, len(self.points) - 1)]
        return v1 if time_s >= t1 else v0 + (v1 - v0) * (time_s - t0) / (t1 - t0)


@dataclass
class _Pattern:
    """One file: its events, and the controls of intensity and sharpness. `longest_s` : the duration of an event that
    is cut [s], 0 without one."""

    continuous: list[_Event] = field(default_factory=list)
    transients: list[Transient] = field(default_factory=list)
    intensity: _Control = field(default_factory=lambda: _Control(1.0))
    sharpness: _Control = field(default_factory=lambda: _Control(0.0))
    ignored: set[str] = field(default_factory=set)
    longest_s: float = 0.0


def read_ahap(path: Path) -> HapticClip:
    """Return the clip in an AHAP file. If a pair of files holds continuous events and transients separately, both are
    read.

    The pair is found by its names, `x.continuous.ahap` and `x.transients.ahap`. As in Apple's player, values out of
    range are clamped and unknown keys ignored.
    Raises: ClipError: the file is no AHAP, or has no event.
    Warns: ClipWarning: events, curves or parameters that are not haptic; an event longer than `MAX_EVENT_S`.
    """
    parts = [_pattern(read_fields(part, needed="Pattern", kind="AHAP")) for part in _pair(path)]
    ignored = sorted(set[str]().union(*(part.ignored for part in parts)))
    if longest_s := max(part.longest_s for part in parts):
        warn_of(
            f"{path}: an event lasts {longest_s:g} s; the player ends it after {MAX_EVENT_S:g} s. Write another event "
            "for the rest.",
            ClipWarning,
        )
    if ignored:
        warning = f"{path}: {', '.join(ignored)} in it is not played; intensity and sharpness of haptic events are."
        warn_of(warning, ClipWarning)
    transients = tuple(sorted((one for part in parts for one in _felt(part)), key=lambda one: one.time_s))
    main = next((part for part in parts if part.continuous), parts[0])
    if not main.continuous and not transients:
        raise ClipError(f"{path}: Pattern has no haptic event; it must have at least one.")
    dips = {one.time_s for one in transients} if len(parts) > 1 else set()
    amplitude = _amplitude(main, dips, transients)
    return HapticClip(amplitude, _frequency(main), transients, about=ClipMetadata(editor=""))


def compose_ahap(clip: HapticClip) -> dict[str, dict[str, Any]]:
    """Return AHAP documents of a clip by the ending of their names: ".continuous" and ".transients", or "" for a single
    one.

    The clip's curves are written point by point. Continuous events last at most 30 s, and curves have at most 16
    points. Each begins at the time and value at which the previous one ended.
    """
    times, end_s = clip.amplitude.times_s, clip.duration_s
    pattern = [
        _event("HapticContinuous", start, {_INTENSITY: 1.0, _SHARPNESS: 0.0}, min(MAX_EVENT_S, end_s - start))
        for start in np.arange(times[0], end_s, MAX_EVENT_S).tolist()
    ]
    pulses = {one.time_s for one in clip.transients}
    intensity = np.sqrt(clip.amplitude.values)
    intensity[[time in pulses for time in times.tolist()]] *= TRANSIENT_DIP
    pattern += _curves(f"{_INTENSITY}Control", times, intensity)
    frequency = clip.frequency or Curve(np.array([0.0]), np.array([0.5]))
    pattern += _curves(f"{_SHARPNESS}Control", frequency.times_s, np.sqrt(frequency.values))
    transients = [
        _event("HapticTransient", one.time_s, {_INTENSITY: one.amplitude**0.5, _SHARPNESS: one.frequency})
        for one in clip.transients
    ]
    if not transients:
        return {"": _document(pattern)}
    return {".continuous": _document(pattern), ".transients": _document(transients)}


def _document(pattern: list[dict[str, Any]]) -> dict[str, Any]:
    return {"Version": 1.0, "Pattern": pattern}


def _event(kind: str, time_s: float, parameters: dict[str, float], duration_s: float | None = None) -> dict[str, Any]:
    event: dict[str, Any] = {"Time": time_s, "EventType": kind}
    if duration_s is not None:
        event["EventDuration"] = duration_s
    event["EventParameters"] = [{"ParameterID": name, "ParameterValue": value} for name, value in parameters.items()]
    return {"Event": event}


def _curves(control: str, times_s: Values, values: Values) -> list[dict[str, Any]]:
    """Return curves of at most `MAX_CURVE_POINTS` points. Each begins with the last point of the previous one."""
    curves = []
    first = 0
    while True:
        end = min(len(times_s), first + MAX_CURVE_POINTS)
        start_s = round(float(times_s[first]), _DECIMALS)
        points = [
            {"Time": round(time - start_s, _DECIMALS), "ParameterValue": value}
            for time, value in zip(times_s[first:end].tolist(), values[first:end].tolist(), strict=True)
        ]
        curve = {"ParameterID": control, "Time": start_s, "ParameterCurveControlPoints": points}
        curves.append({"ParameterCurve": curve})
        if end == len(times_s):
            return curves
        first = end - 1


def _pair(path: Path) -> tuple[Path, ...]:
    stem = path.name.removesuffix(SUFFIX)
    for ending, other in (("continuous", "transients"), ("transients", "continuous")):
        if stem.endswith((f".{ending}", f"_{ending}")):
            beside = path.with_name(f"{stem.removesuffix(ending)}{other}{SUFFIX}")
            return (path, beside) if beside.is_file() else (path,)
    return (path,)


def _pattern(fields: Fields) -> _Pattern:
    pattern = _Pattern()
    for item in fields.items("Pattern"):
        if "Event" in item:
            _read_event(item.within("Event"), pattern)
        elif "ParameterCurve" in item:
            _read_curve(item.within("ParameterCurve"), pattern)
        elif "Parameter" in item:
            one = item.within("Parameter")
            _add(pattern, one.text("ParameterID"), [(_time(one), _value(one))])
    if len(pattern.continuous) > _MOST_EVENTS:
        number = len(pattern.continuous)
        problem = f"has {number} continuous events; it must have at most {_MOST_EVENTS}. Split the clip"
        raise fields.error("Pattern", problem)
    for control in (pattern.intensity, pattern.sharpness):
        control.join()
    return pattern


def _read_event(event: Fields, pattern: _Pattern) -> None:
    kind, start = event.text("EventType"), _time(event)
    values = {_INTENSITY: 1.0, _SHARPNESS: 0.5}  # Apple's defaults
    for one in event.items("EventParameters") if "EventParameters" in event else ():
        name, value = one.text("ParameterID"), _value(one)
        if name in values:
            values[name] = _unit(value)
        elif value != _NEUTRAL.get(name):
            pattern.ignored.add(f"the parameter {name!r} of an event")
    if kind == "HapticContinuous":
        duration_s = event.number("EventDuration", at_most=MAX_CLIP_S, unit="s")
        if duration_s > MAX_EVENT_S:
            pattern.longest_s = max(pattern.longest_s, duration_s)
            duration_s = MAX_EVENT_S
        if duration_s > 0.0:
            pattern.continuous.append(_Event(start, start + duration_s, values[_INTENSITY], values[_SHARPNESS]))
    elif kind == "HapticTransient":
        pattern.transients.append(Transient(start, values[_INTENSITY], values[_SHARPNESS]))
    else:
        pattern.ignored.add(f"an event of type {kind!r}")


def _read_curve(curve: Fields, pattern: _Pattern) -> None:
    start = _time(curve)
    rows = curve.items("ParameterCurveControlPoints")
    points = [*zip(rising_times(rows, "Time", default=0.0), map(_value, rows), strict=True)]
    is_absolute = start > 0.0 and bool(points) and abs(points[0][0] - start) < 1e-9
    if not is_absolute:
        points = [(round(start + time, _DECIMALS), value) for time, value in points]
    _add(pattern, curve.text("ParameterID"), points)


def _add(pattern: _Pattern, control: str, points: Points) -> None:
    if control == f"{_INTENSITY}Control":
        pattern.intensity.parts.append(points)
    elif control == f"{_SHARPNESS}Control":
        pattern.sharpness.parts.append(points)
    else:
        pattern.ignored.add(f"the parameter {control!r}")


def _time(fields: Fields) -> float:
    return fields.number("Time", at_most=MAX_CLIP_S, unit="s", default=0.0)


def _value(fields: Fields) -> float:
    return fields.number("ParameterValue", at_least=-1e9, at_most=1e9, default=0.0)


def _unit(value: float) -> float:
    return min(max(value, 0.0), 1.0)


def _felt(pattern: _Pattern) -> list[Transient]:
    """Return the transients of a file as amplitudes, with its controls applied."""
    return [
        Transient(
            one.time_s,
            _unit(one.amplitude * pattern.intensity.at(one.time_s)) ** 2,
            _unit(one.frequency + pattern.sharpness.at(one.time_s)),
        )
        for one in pattern.transients
    ]


def _playing(pattern: _Pattern, time_s: float, *, before: bool = False) -> list[_Event]:
    return [
        one
        for one in pattern.continuous
        if (one.start_s < time_s <= one.end_s if before else one.start_s <= time_s < one.end_s)
    ]


def _amplitude(pattern: _Pattern, dips: set[float], transients: tuple[Transient, ...]) -> Curve:
    """Return amplitude over time: the square of the sum of all continuous intensities, with their control applied."""

    def level(time_s: float, *, before: bool) -> float:
        events = _playing(pattern, time_s, before=before)
        return _unit(sum(one.intensity for one in events) * pattern.intensity.at(time_s, before=before))

    last = max((one.time_s for one in transients), default=0.0)
    edges = {time for one in pattern.continuous for time in (one.start_s, one.end_s)}
    if not edges:
        return Curve(np.array([0.0, last + _AFTER_S]), np.zeros(2), 2.0)
    start, end = min(edges), max(edges)
    bends = {time for time, _ in pattern.intensity.points if start <= time <= end}
    points: Points = []
    for time in sorted(edges | bends):
        earlier, later = level(time, before=True), level(time, before=False)
        values = [later] if time == start else [earlier] if time == end or earlier == later else [earlier, later]
        if time not in bends and start < time < end and len(values) == 1:
            continue  # one event continues where another ended
        points += [(time, min(1.0, value / TRANSIENT_DIP) if time in dips else value) for value in values]
    if last > end:
        points += [(end, 0.0), (last + _AFTER_S, 0.0)]
    return _squared(points)


def _frequency(pattern: _Pattern) -> Curve | None:
    """Return frequency over time: the square of the sum of control and sharpness of the strongest continuous event."""
    if not pattern.continuous:
        return None

    def sharpness(time_s: float, *, before: bool) -> float | None:
        events = _playing(pattern, time_s, before=before)
        if not events:
            return None
        own = max(events, key=lambda one: one.intensity).sharpness
        return _unit(own + pattern.sharpness.at(time_s, before=before))

    start, end = min(one.start_s for one in pattern.continuous), max(one.end_s for one in pattern.continuous)
    bends = {min(time, end) for time, _ in pattern.sharpness.points if start <= time}
    points: Points = []
    for time in sorted(bends | {one.start_s for one in pattern.continuous}):
        # Nothing is felt in a pause, so the frequency stays constant and jumps where the next event begins.
        earlier, later = sharpness(time, before=True), sharpness(time, before=False)
        if earlier is None and points:
            earlier = points[-1][1]
        values = list(dict.fromkeys(value for value in (earlier, later) if value is not None))
        if time in bends or not points or len(values) > 1:
            points += [(time, value) for value in values]
    return _squared(points)


def _squared(points: Iterable[tuple[float, float]]) -> Curve:
    times, values = zip(*points, strict=True)
    return Curve(np.array(times), np.array(values) ** 2, 2.0)
