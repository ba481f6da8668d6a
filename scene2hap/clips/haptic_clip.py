"""A haptic clip: amplitude and frequency over time, and transients, as in files of designers' programs and phones."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.audio.clip import Credit
from scene2hap.common.arrays import floats
from scene2hap.common.calls import clear_construction
from scene2hap.errors import ClipError

Values = NDArray[np.float64]

RANGE_HZ = (55.0, 200.0)
"""Frequencies at 0 and 1 on Quest controllers, by their actuator file (Meta haptics SDK)."""

MAX_POINTS = 100_000
"""Most points of one curve (assumed: 60 times the longest published clip, and more than any device accepts at once)."""
MAX_CLIP_S = 600.0
"""Longest clip [s]; the same bound as for sounds."""


class ClipWarning(UserWarning):
    """A part of a haptic clip's file is not played."""


@clear_construction
@dataclass(frozen=True, eq=False)
class Curve:
    """A value over time: points times_s (n,) [s], values (n,) 0..1 [-].

    Between points the `power`-th root of the value is linear. Power 1 is linear interpolation; power 2 is that of AHAP,
    whose intensity is the root of an amplitude. Two points may share a time: the value jumps there. Before the first
    point the value is the first one, after the last point the last one.
    Raises: ClipError: no points, different lengths, a number that is not finite or out of range, or falling times.
    """

    times_s: Values
    values: Values
    power: float = 1.0

    def __post_init__(self) -> None:
        for name in ("times_s", "values"):
            unit = "s" if name == "times_s" else "-"
            given = np.array(floats(f"{name} of a curve", getattr(self, name), unit, error=ClipError))
            given.flags.writeable = False
            object.__setattr__(self, name, given)
        times, values = self.times_s, self.values
        if times.ndim != 1 or times.shape != values.shape or not times.size:
            raise ClipError(f"a curve has {times.shape} times and {values.shape} values; give one value for each time.")
        _require("times_s", times, np.isfinite(times) & (times >= 0.0) & (times <= MAX_CLIP_S), f"0 to {MAX_CLIP_S} s")
        _require("times_s", times, np.diff(times, prepend=times[0]) >= 0.0, "no earlier than the one before [s]")
        _require("values", values, np.isfinite(values) & (values >= 0.0) & (values <= 1.0), "0 to 1")

    def __len__(self) -> int:
        return len(self.times_s)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Curve):
            return NotImplemented
        pairs = (self.times_s, other.times_s), (self.values, other.values)
        return self.power == other.power and all(np.array_equal(one, two) for one, two in pairs)

    def __hash__(self) -> int:
        return hash((tuple(self.times_s.tolist()), tuple(self.values.tolist()), self.power))

    def at(self, times_s: ArrayLike) -> Values:
        """Return the values (n,) at times (n,) [s]; at a jump the later one."""
        t = np.asarray(times_s, dtype=np.float64)
        roots = self.values ** (1.0 / self.power)
        after = np.searchsorted(self.times_s, t, side="right")
        left, right = np.clip(after - 1, 0, len(self) - 1), np.clip(after, 0, len(self) - 1)
        span = self.times_s[right] - self.times_s[left]
        share = np.clip(t - self.times_s[left], 0.0, None) / np.where(span > 0.0, span, 1.0)
        return np.asarray((roots[left] + np.where(span > 0.0, share, 0.0) * (roots[right] - roots[left])) ** self.power)


def _require(name: str, values: Values, is_right: NDArray[np.bool_], bound: str) -> None:
    if not is_right.all():
        first = int(np.argmin(is_right))
        raise ClipError(f"{name}[{first}] of a curve is {values[first]:g}; it must be {bound}.")


@dataclass(frozen=True)
class Transient:
    """A short pulse: its time [s], its amplitude 0..1 [-], and its pitch 0..1 [-], from dull to sharp."""

    time_s: float
    amplitude: float
    frequency: float


@dataclass(frozen=True)
class ClipMetadata:
    """Metadata of a clip: program, author, source, project, tags, description."""

    editor: str = "scene2hap"
    author: str = ""
    source: str = ""
    project: str = ""
    tags: tuple[str, ...] = ()
    description: str = ""

    def credit(self, title: str) -> Credit:
        """Return the credit of the clip, for the credits of a bundle."""
        return Credit(title, self.author or "unknown", "unknown", origin=f"haptic clip, {self.editor or 'by hand'}")


@clear_construction
@dataclass(frozen=True)
class HapticClip:
    """A haptic clip: vibration as curves of amplitude and frequency over time, and pulses.

    Parameters:
    amplitude : curve of the peak amplitude of a sine wave, 0..1 [-]; it may begin at any time, and ends with the clip.
    frequency : curve of the frequency, 0..1 [-] from the lower to the upper end of `range_hz`; None for the middle.
    transients : pulses in order of time.
    range_hz : frequencies at 0 and 1 [Hz]; a property of the actuator that plays the clip.
    Raises: ClipError: the duration is 0, or transients are not in order of time.
    """

    amplitude: Curve
    frequency: Curve | None = None
    transients: tuple[Transient, ...] = ()
    range_hz: tuple[float, float] = RANGE_HZ
    about: ClipMetadata = field(default_factory=ClipMetadata)

    def __post_init__(self) -> None:
        object.__setattr__(self, "transients", tuple(self.transients))
        object.__setattr__(self, "range_hz", tuple(self.range_hz))
        if not self.duration_s > 0.0:
            raise ClipError("the amplitude curve ends at 0 s; a clip must be longer than 0 s.")
        times = [one.time_s for one in self.transients]
        if times != sorted(times):
            raise ClipError(f"transients are at {times[:8]} s; give them in order of time.")

    @property
    def duration_s(self) -> float:
        """End of the amplitude curve [s]."""
        return float(self.amplitude.times_s[-1])

    def frequency_hz(self, times_s: ArrayLike) -> Values:
        """Return the frequency (n,) [Hz] at times (n,) [s]; before the first point of its curve it is the middle."""
        low, high = self.range_hz
        t = np.asarray(times_s, dtype=np.float64)
        pitch = np.full(t.shape, 0.5)
        if self.frequency is not None:
            pitch = np.where(t < self.frequency.times_s[0], pitch, self.frequency.at(t))
        return np.asarray(low + (high - low) * pitch)
