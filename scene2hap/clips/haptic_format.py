"""The .haptic format, version 1 (Meta haptics SDK, `resources/haptic-file-spec.md`).

A clip has at least two amplitude points and ends with the last one. A point may have an emphasis: a transient whose
amplitude is at least that of the point. Frequency points are within the span of the amplitude points. Files of an
earlier program break only this rule; they are read with a warning.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from scene2hap.clips.fields import Fields, read_fields, rising_times
from scene2hap.clips.haptic_clip import ClipMetadata, ClipWarning, Curve, HapticClip, Transient
from scene2hap.common.warning import warn_of

SUFFIX = ".haptic"
_VERSION = 1


def read_haptic(path: Path) -> HapticClip:
    """Return the clip in a .haptic file.

    Raises: ClipError: the file breaks a rule; the message names file, field and bound.
    Warns: ClipWarning: frequency points lie outside of the amplitude curve, as in files of earlier programs.
    """
    fields = read_fields(path, needed="signals", kind=".haptic")
    version = fields.within("version").number("major", at_most=1e6)
    if version != _VERSION:
        raise fields.error("version.major", f"is {version:g}; it must be {_VERSION}. Export the clip as version 1")
    envelopes = fields.within("signals").within("continuous").within("envelopes")
    rows = envelopes.items("amplitude")
    if len(rows) < 2:
        raise envelopes.error("amplitude", f"has {len(rows)} points; it must have at least 2")
    times = rising_times(rows, "time")
    amplitude = [row.number("amplitude") for row in rows]
    if times[-1] <= times[0]:
        raise envelopes.error("amplitude", f"lasts {times[-1] - times[0]:g} s; it must be longer than 0 s")
    transients = tuple(
        _emphasis(row.within("emphasis"), time, level)
        for row, time, level in zip(rows, times, amplitude, strict=True)
        if "emphasis" in row
    )
    about = _about(fields)
    frequency = None
    if "frequency" in envelopes and (points := envelopes.items("frequency")):
        bends = rising_times(points, "time")
        frequency = Curve(np.array(bends), np.array([point.number("frequency") for point in points]))
        outside = [(at, point) for at, point in zip(bends, points, strict=True) if not times[0] <= at <= times[-1]]
        if outside:
            at, point = outside[0]
            span = f"lies outside of the amplitude curve, {times[0]:g} to {times[-1]:g} s"
            wrong = point.error("time", f"is {at:g} s, which {span}. The clip is read without what lies outside")
            warn_of(str(wrong), ClipWarning)
    return HapticClip(Curve(np.array(times), np.array(amplitude)), frequency, transients, about=about)


def compose_haptic(clip: HapticClip) -> dict[str, Any]:
    """Return the .haptic document of a clip.

    A transient becomes the emphasis of the amplitude point at its time; a missing point is added. The emphasis is at
    least as strong as the curve there. Before a curve that begins after the first transient, the amplitude is 0.
    Frequency points outside the amplitude curve are moved to its ends.
    """
    curve = clip.amplitude
    if clip.transients and clip.transients[0].time_s < curve.times_s[0]:
        silence_s = [clip.transients[0].time_s, curve.times_s[0]]
        curve = Curve(np.append(silence_s, curve.times_s), np.append([0.0, 0.0], curve.values), curve.power)
    times, values = curve.times_s, curve.values
    pulses = {one.time_s: one for one in clip.transients if times[0] <= one.time_s <= times[-1]}
    missing = sorted(set(pulses) - set(times.tolist()))
    at = np.searchsorted(times, missing, side="right")
    values = np.insert(values, at, curve.at(np.array(missing)))
    times = np.insert(times, at, missing)
    rows = []
    for time, value in zip(times.tolist(), values.tolist(), strict=True):
        row: dict[str, Any] = {"time": time, "amplitude": value}
        pulse = pulses.pop(time, None)
        if pulse is not None:
            row["emphasis"] = {"amplitude": max(pulse.amplitude, value), "frequency": pulse.frequency}
        rows.append(row)
    envelopes: dict[str, Any] = {"amplitude": rows}
    if clip.frequency is not None:
        inside = np.clip(clip.frequency.times_s, times[0], times[-1])
        pairs = zip(inside.tolist(), clip.frequency.values.tolist(), strict=True)
        envelopes["frequency"] = [{"time": time, "frequency": value} for time, value in pairs]
    about = clip.about
    return {
        "version": {"major": _VERSION, "minor": 0, "patch": 0},
        "metadata": {
            "editor": about.editor,
            "author": about.author,
            "source": about.source,
            "project": about.project,
            "tags": list(about.tags),
            "description": about.description,
        },
        "signals": {"continuous": {"envelopes": envelopes}},
    }


def _emphasis(fields: Fields, time_s: float, level: float) -> Transient:
    amplitude, frequency = fields.number("amplitude"), fields.number("frequency")
    if amplitude < level:
        raise fields.error("amplitude", f"is {amplitude:g}; it must be at least that of its point, {level:g}")
    return Transient(time_s, amplitude, frequency)


def _about(fields: Fields) -> ClipMetadata:
    if "metadata" not in fields:
        return ClipMetadata(editor="")
    metadata = fields.within("metadata")
    names = ("editor", "author", "source", "project", "description")
    return ClipMetadata(tags=metadata.texts("tags"), **{name: metadata.text(name) for name in names})
