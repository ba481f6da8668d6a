"""Conversion of a signal's envelope to a haptic clip with few points."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from scene2hap.audio.threshold import FREQUENCY_WEBER
from scene2hap.clips.haptic_clip import RANGE_HZ, Curve, HapticClip, Transient
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.common.calls import clear_construction
from scene2hap.errors import ConfigError
from scene2hap.export.envelope import FLOOR_DB, SMOOTHED_S, Envelope, Pulse, decibels
from scene2hap.export.fidelity import fidelity
from scene2hap.export.simplify import simplified
from scene2hap.export.track import Channel

_SILENT = 1e-5
"""A smaller amplitude counts as silence [-]: -100 dB re full scale."""


@clear_construction
@dataclass(frozen=True)
class CurveSettings:
    """Accuracy of curves, and their number of points.

    Parameters:
    range_hz : frequencies at 0 and 1 on the actuator [Hz]; others are moved to the nearer end.
    tolerance_db, tolerance_jnd : largest errors of amplitude [dB] and frequency [JND].
    amplitude_points, frequency_points : most points a second; by default those of Meta's Haptics Studio.
    transients : turn pulses into transients if the result is closer to the signal.
    Raises: ConfigError: a setting out of bounds.
    """

    range_hz: tuple[float, float] = RANGE_HZ
    tolerance_db: float = 0.5
    tolerance_jnd: float = 0.25
    amplitude_points: int = 40
    frequency_points: int = 30
    transients: bool = True

    def __post_init__(self) -> None:
        low, high = checks.vector("range_hz", self.range_hz, "Hz", size=2, above=0.0, error=ConfigError)
        checks.number("range_hz[1]", high, "Hz", above=low, at_most=1000.0, error=ConfigError)
        object.__setattr__(self, "range_hz", (low, high))
        for name, unit in (("tolerance_db", "dB"), ("tolerance_jnd", "JND")):
            value = checks.number(name, getattr(self, name), unit, above=0.0, at_most=20.0, error=ConfigError)
            object.__setattr__(self, name, value)
        for name in ("amplitude_points", "frequency_points"):
            checks.whole(name, getattr(self, name), "-", at_least=4, at_most=200, error=ConfigError)
        checks.flag("transients", self.transients, error=ConfigError)


def curves_of(channel: Channel, settings: CurveSettings, *, power: float = 1.0) -> HapticClip:
    """Return the clip of a channel: its own if a person drew one, otherwise curves that follow its envelope.

    Parameters: power : of the curves; 2 for formats that store roots (`Curve`). The points of a drawn clip stay, with
        the lines of the format between them.
    """
    if channel.clip is not None:
        lines = {name: getattr(channel.clip, name) for name in ("amplitude", "frequency")}
        return replace(channel.clip, **{name: curve and replace(curve, power=power) for name, curve in lines.items()})
    envelope = channel.envelope_over(min(SMOOTHED_S, 1.0 / settings.amplitude_points))
    plain = _clip(envelope, settings, power, with_pulses=False)
    if not settings.transients or not envelope.pulses:
        return plain
    pulsed = _clip(envelope, settings, power, with_pulses=True)
    errors = [fidelity(channel, clip) for clip in (plain, pulsed)]
    missed_db = [one.median_db + one.p95_db for one in errors]
    return plain if missed_db[0] <= missed_db[1] else pulsed


def from_start(frequency: Curve | None, before: float = 0.5) -> Curve | None:
    """Return a curve of frequency that begins at time 0; before its own first point it is `before`, by default the
    middle."""
    if frequency is None or frequency.times_s[0] == 0.0:
        return frequency
    times = np.append([0.0, frequency.times_s[0]], frequency.times_s)
    values = np.append([before, before], frequency.values)
    return replace(frequency, times_s=times, values=values)


def _clip(envelope: Envelope, settings: CurveSettings, power: float, *, with_pulses: bool) -> HapticClip:
    times = envelope.times_s
    amplitude = np.minimum(envelope.without_pulses() if with_pulses else envelope.sharpened(), 1.0)
    peak = float(envelope.amplitude.max())
    low, high = settings.range_hz
    pulses = envelope.pulses if with_pulses else ()
    kept = [int(np.argmin(np.abs(times - pulse.start_s))) for pulse in pulses]
    transients = tuple(_transient(times[i], pulse, settings) for i, pulse in zip(kept, pulses, strict=True))

    def level(roots: Floats) -> Floats:
        return decibels(roots**power, peak)

    def pitch(roots: Floats) -> Floats:
        return np.asarray(np.log(low + (high - low) * roots**power) / np.log1p(FREQUENCY_WEBER))

    amplitude[(decibels(amplitude, peak) <= FLOOR_DB) | (amplitude < _SILENT)] = 0.0
    roots = amplitude ** (1.0 / power)
    chosen = simplified(times, roots, level, settings.tolerance_db, per_second=settings.amplitude_points, kept=kept)
    pitches = np.clip((envelope.frequency_hz - low) / (high - low), 0.0, 1.0) ** (1.0 / power)
    bends = simplified(times, pitches, pitch, settings.tolerance_jnd, per_second=settings.frequency_points)
    return HapticClip(
        Curve(_rounded(times[chosen]), _rounded(roots[chosen] ** power), power),
        Curve(_rounded(times[bends]), _rounded(pitches[bends] ** power), power),
        transients,
        settings.range_hz,
    )


def _transient(time_s: float, pulse: Pulse, settings: CurveSettings) -> Transient:
    low, high = settings.range_hz
    pitch = min(max((pulse.frequency_hz - low) / (high - low), 0.0), 1.0)
    return Transient(round(float(time_s), 6), min(round(pulse.amplitude, 6), 1.0), round(pitch, 6))


def _rounded(values: Floats) -> Floats:
    return np.round(values, 6)
