"""The start or the stop of a machine in a recording: amplitude and speed over time, relative to steady running."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.common.calls import clear_construction
from scene2hap.errors import AudioError
from scene2hap.haptics import LONGEST_PASSAGE_S

MOST_POINTS = 1000
_HIGHEST_SPEED = 4.0
"""Largest relative speed [-]; a larger number is an error of the file."""


@clear_construction
@dataclass(frozen=True)
class RunCurve:
    """A start, which rises to 1, or a stop, which falls from 1.

    Parameters:
    lasts_s : duration, above 0, at most 30 [s].
    amplitude : of the vibration, relative to steady running, at two or more equally spaced times, 0..1 [-].
    speed : pitch relative to steady running at the same times, 0..4 [-]; empty if the recording does not show it.
    inferred_s : the inferred duration that `lasts_s` replaces, 0..30 [s]; it applies again with another recording.
    Raises: AudioError: a number out of bounds, or a different number of points.
    """

    lasts_s: float
    amplitude: tuple[float, ...]
    speed: tuple[float, ...] = ()
    inferred_s: float = 0.0

    def __post_init__(self) -> None:
        lasts_s = checks.number("lasts_s", self.lasts_s, "s", above=0.0, at_most=LONGEST_PASSAGE_S, error=AudioError)
        object.__setattr__(self, "lasts_s", lasts_s)
        inferred_s = checks.number(
            "inferred_s", self.inferred_s, "s", at_least=0.0, at_most=LONGEST_PASSAGE_S, error=AudioError
        )
        object.__setattr__(self, "inferred_s", inferred_s)
        object.__setattr__(self, "amplitude", _points("amplitude", self.amplitude, 1.0))
        object.__setattr__(self, "speed", _points("speed", self.speed, _HIGHEST_SPEED))
        n, n_speeds = len(self.amplitude), len(self.speed)
        if n < 2 or n_speeds not in (0, n):
            raise AudioError(
                f"amplitude has {n} points and speed {n_speeds}; give at least two of each, as many of one as of the "
                "other, or no speed."
            )

    @property
    def keeps_pitch(self) -> bool:
        """True if the recording shows that the pitch stays constant."""
        return bool(self.speed) and all(one == 1.0 for one in self.speed)

    def instead_of(self, time_s: float, before: RunCurve | None) -> RunCurve:
        """Return this curve with the duration that it replaces: `time_s`, or the one that the former curve `before`
        replaced."""
        if before is not None and replace(before, inferred_s=self.inferred_s) == self:
            return before
        was_recorded = before is not None and time_s == before.lasts_s
        return replace(self, inferred_s=before.inferred_s if before is not None and was_recorded else time_s)

    def amplitude_at(self, x: ArrayLike) -> Floats:
        """Return the amplitude (n,) [-] at shares x (n,) of the duration, 0..1."""
        return _between(self.amplitude, x)

    def speed_at(self, x: ArrayLike) -> Floats | None:
        """Return the speed (n,) [-] at shares x (n,) of the duration, 0..1; None if it is unknown."""
        return _between(self.speed, x) if self.speed else None


def _between(points: Sequence[float], x: ArrayLike) -> Floats:
    return np.asarray(
        np.interp(np.asarray(x, dtype=np.float64), np.linspace(0.0, 1.0, len(points)), points), dtype=np.float64
    )


def _points(name: str, values: Sequence[float], at_most: float) -> tuple[float, ...]:
    given = checks.items(name, values, at_most=MOST_POINTS, error=AudioError)
    return tuple(
        checks.number(f"{name}[{i}]", value, "-", at_least=0.0, at_most=at_most, error=AudioError)
        for i, value in enumerate(given)
    )
