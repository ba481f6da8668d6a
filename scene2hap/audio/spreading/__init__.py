"""Move a scene's sources apart in frequency and level, as little as possible, so that hands can distinguish them.

Two sources are distinct if they differ by two JNDs of frequency, or by one of frequency and two of level
(`threshold`). The order of levels is kept, and no source moves to a frequency at which the actuator cannot reach its
level. The distances use the widest published JND of frequency if they fit, else the middle one, by which distinctness
is measured. If distances by the middle JND do not fit either, sources that differ in rhythm may share a frequency. In a
scene with too many sources, the result is as distinct as the limits allow.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from scene2hap.audio.spreading.best_response import iterated_best_response
from scene2hap.audio.spreading.linear_programme import LinearProgramme
from scene2hap.audio.spreading.placements import FeltSource, Problem, SpreadLimits
from scene2hap.audio.threshold import FREQUENCY_WEBER, WIDEST_WEBER
from scene2hap.haptics import ActuatorProfile

__all__ = ["FeltSource", "Placement", "SpreadLimits", "spread"]

_ENOUGH_OCT = 1e-4
_UNMOVED = 1e-6
_EXACT_PAIRS = 28
"""Up to this many pairs (eight conflicting sources) are placed exactly, within a second or two."""


@dataclass(frozen=True)
class Placement:
    """The planned frequency [Hz] and sensation level [dB] of a source."""

    target_hz: float
    level_db: float


def spread(
    sources: Sequence[FeltSource], actuator: ActuatorProfile | None = None, limits: SpreadLimits | None = None
) -> tuple[Placement, ...]:
    """Return the placements of a scene's sources, in their order. No placement depends on that order."""
    limits = limits or SpreadLimits()
    # Of several placements that are equally good, the search returns one by the order of its input.
    stay = {source: Placement(source.own_hz, source.level_db) for source in sorted(sources, key=_rank)}
    if len(stay) < 2 or limits.octaves == limits.level_db == 0.0:
        return tuple(stay[source] for source in sources)
    for weber, counts_rhythm in ((WIDEST_WEBER, False), (FREQUENCY_WEBER, False), (FREQUENCY_WEBER, True)):
        problem = Problem.of(tuple(stay), actuator or ActuatorProfile(), limits, weber, counts_rhythm=counts_rhythm)
        programme = LinearProgramme(problem) if len(problem.pairs) <= _EXACT_PAIRS else None
        is_last = counts_rhythm
        if programme is not None and not is_last and programme.is_infeasible(_ENOUGH_OCT):
            continue  # the best of these placements would be dropped
        outcome = iterated_best_response(problem) if programme is None else programme.solve()
        if outcome.shortage_oct < _ENOUGH_OCT:
            break
    placed = {
        source: stay[source] if source.is_placed else _placement(source, float(2.0**x), float(level_db))
        for source, x, level_db in zip(problem.sources, outcome.x, outcome.level_db, strict=True)
    }
    return tuple(placed[source] for source in sources)


def _rank(source: FeltSource) -> tuple[float | str, ...]:
    rhythm_hz = 0.0 if source.rhythm_hz is None else source.rhythm_hz
    return source.own_hz, source.level_db, source.crest_db, rhythm_hz, source.is_placed, source.group


def _placement(source: FeltSource, target_hz: float, level_db: float) -> Placement:
    """Return the placement of a source: exactly its own frequency if it is hardly moved, so that no shift is made."""
    return Placement(source.own_hz if abs(target_hz / source.own_hz - 1.0) < _UNMOVED else target_hz, level_db)
