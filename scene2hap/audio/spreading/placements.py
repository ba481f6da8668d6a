"""Frequencies and levels of a scene's sources, their limits, and the pairs that may conflict."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from pydantic import Field

from scene2hap.audio.actuator_range import reachable_hz
from scene2hap.audio.threshold import LEVEL_JND_DB, frequency_jnds
from scene2hap.common.arrays import Floats
from scene2hap.common.settings import Settings
from scene2hap.haptics import ActuatorProfile

_MARGIN = 1.01
"""Margin of one per cent on distances and limits, since distinctness is later measured on loops of few cycles."""
LEVEL_STEP_DB = LEVEL_JND_DB * _MARGIN
_ORDER_GAP_DB = 0.5
_OTHER_RHYTHM = 2.2
"""JNDs between two rhythms that make sources distinct: two, plus the error of a loop of few cycles."""


class SpreadLimits(Settings):
    """How far a source may be moved to be distinct from the others; with 0 and 0 no source is moved.

    octaves : largest change of frequency, up or down [octaves].
    level_db : largest change of level, up or down [dB].
    """

    of_what = "spread"

    octaves: float = Field(default=1.0 / 3.0, ge=0.0, le=1.0)
    level_db: float = Field(default=3.0, ge=0.0, le=12.0)


@dataclass(frozen=True)
class FeltSource:
    """A source before it is moved: own frequency [Hz], planned sensation level [dB], and group.

    Sources of one group need not differ (the states of an object, objects of one kind). `crest_db` is its peak relative
    to that of an equally strong sine. A source that `is_placed` does not move. `rhythm_hz` is the rate of its envelope,
    None if that hardly varies.
    """

    own_hz: float
    level_db: float
    group: str = ""
    crest_db: float = 0.0
    is_placed: bool = False
    rhythm_hz: float | None = None


@dataclass(frozen=True)
class Problem:
    """Bounds of frequency x (n,) [oct, re 1 Hz] and level l (n,) [dB] around their present values, x0 and l0.

    `jnd_oct` is one JND of frequency [oct]; `octaves` and `level_db` are the limits, which also weigh the two kinds of
    moves against each other; `counts_rhythm` allows sources of two rhythms to share a frequency.
    """

    sources: tuple[FeltSource, ...]
    x0: Floats
    x_low: Floats
    x_high: Floats
    l0: Floats
    l_low: Floats
    l_high: Floats
    jnd_oct: float
    octaves: float
    level_db: float
    counts_rhythm: bool = False

    @classmethod
    def of(
        cls,
        sources: Sequence[FeltSource],
        actuator: ActuatorProfile,
        limits: SpreadLimits,
        weber: float,
        *,
        counts_rhythm: bool = False,
    ) -> Problem:
        """Build the bounds from actuator, levels and limits, for a Weber fraction of frequency."""
        octaves = limits.octaves / _MARGIN
        reach = [reachable_hz(v.own_hz, v.level_db, actuator, octaves, crest_db=v.crest_db) for v in sources]
        low, high, louder = np.array(reach, dtype=np.float64).T
        x0, l0 = np.log2([source.own_hz for source in sources]), np.array([source.level_db for source in sources])
        free = np.array([0.0 if source.is_placed else 1.0 for source in sources])
        return cls(
            tuple(sources),
            x0,
            x0 + free * (np.log2(low) - x0),
            x0 + free * (np.log2(high) - x0),
            l0,
            l0 - free * limits.level_db / _MARGIN,
            l0 + free * np.minimum(louder, limits.level_db / _MARGIN),
            float(np.log2(1.0 + weber)) * _MARGIN,
            max(limits.octaves, 1e-9),
            max(limits.level_db, 1e-9),
            counts_rhythm,
        )

    @cached_property
    def pairs(self) -> list[tuple[int, int]]:
        """The pairs that must differ and that could come within two JNDs of each other."""
        return [pair for pair in combinations(range(len(self.sources)), 2) if self._may_meet(*pair)]

    @cached_property
    def order(self) -> list[tuple[int, int, float]]:
        """(stronger, weaker, least gap [dB]) of every pair that may move and has different levels."""
        pairs = combinations([i for i, source in enumerate(self.sources) if not source.is_placed], 2)
        ranked = [(i, j) if self.l0[i] >= self.l0[j] else (j, i) for i, j in pairs]
        gaps = [(i, j, min(float(self.l0[i] - self.l0[j]), _ORDER_GAP_DB)) for i, j in ranked]
        return [row for row in gaps if row[2] > 0.0]

    def _may_meet(self, i: int, j: int) -> bool:
        one, other = self.sources[i], self.sources[j]
        if (one.group and one.group == other.group) or (one.is_placed and other.is_placed):
            return False
        if self.counts_rhythm and _differ_in_rhythm(one, other):
            return False
        gap = max(self.x_low[j] - self.x_high[i], self.x_low[i] - self.x_high[j])
        return bool(gap < 2.0 * self.jnd_oct)


def _differ_in_rhythm(one: FeltSource, other: FeltSource) -> bool:
    if one.rhythm_hz is None or other.rhythm_hz is None:
        return False
    return frequency_jnds(one.rhythm_hz, other.rhythm_hz) >= _OTHER_RHYTHM


@dataclass(frozen=True)
class Outcome:
    """The placed sources: frequency x (n,) [oct, re 1 Hz] and level (n,) [dB]."""

    problem: Problem
    x: Floats
    level_db: Floats

    @property
    def shortage_oct(self) -> float:
        """The missing distance of all pairs together [oct]."""
        one, other = np.array(self.problem.pairs, dtype=np.int64).reshape(-1, 2).T
        octaves, levels = np.abs(self.x[one] - self.x[other]), np.abs(self.level_db[one] - self.level_db[other])
        return float(shortage_oct(octaves, levels, self.problem.jnd_oct).sum())

    @property
    def moves(self) -> float:
        """The sum of all moves, each as a share of its limit [-]."""
        by_x = np.abs(self.x - self.problem.x0) / self.problem.octaves
        return float((by_x + np.abs(self.level_db - self.problem.l0) / self.problem.level_db).sum())


def shortage_oct(octaves: Floats, level_db: Floats, jnd_oct: float) -> Floats:
    """Return the distance that pairs lack for two JNDs in frequency, or for one in frequency and two in level [oct]."""
    by_frequency = np.maximum(0.0, 2.0 * jnd_oct - octaves)
    missing_level = np.maximum(0.0, 2.0 - level_db / LEVEL_STEP_DB) * jnd_oct
    return np.minimum(by_frequency, np.maximum(np.maximum(0.0, jnd_oct - octaves), missing_level))
