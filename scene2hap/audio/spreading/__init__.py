"""Moving a scene's sources apart in frequency and level, as little as possible, so that hands can distinguish them.

Two sources are apart when they differ by two JNDs of frequency, or by one and two of level (`distinctness`). The order
of levels is kept, and nobody is moved to where the actuator cannot bring its level. They are placed by the widest
published JND of frequency if there is room, else by the middle one, by which distinctness is measured. Where that takes
too much room as well, those that differ in rhythm may share a frequency. A crowded scene comes out as distinct as the
limits let it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from scene2hap.audio.distinctness import FREQUENCY_WEBER, WIDEST_WEBER
from scene2hap.audio.spreading.programme import Programme
from scene2hap.audio.spreading.room import Room, SpreadLimits, Voice
from scene2hap.audio.spreading.yielding import give_way
from scene2hap.haptics import ActuatorProfile

__all__ = ["Placement", "SpreadLimits", "Voice", "spread"]

_ENOUGH_OCT = 1e-4
_EXACT_PAIRS = 28
"""Up to so many pairs (eight voices in one another's way) are placed exactly, within a second or two."""


@dataclass(frozen=True)
class Placement:
    """Where a source is to be felt: frequency [Hz] and sensation level [dB]."""

    target_hz: float
    level_db: float


def spread(
    voices: Sequence[Voice], actuator: ActuatorProfile | None = None, limits: SpreadLimits | None = None
) -> tuple[Placement, ...]:
    """Placements of a scene's sources, in their order; the same for the same input on every run."""
    limits = limits or SpreadLimits()
    stay = {voice: Placement(voice.own_hz, voice.level_db) for voice in voices}
    if len(stay) < 2 or limits.octaves == limits.level_db == 0.0:
        return tuple(stay[voice] for voice in voices)
    for weber, counts_rhythm in ((WIDEST_WEBER, False), (FREQUENCY_WEBER, False), (FREQUENCY_WEBER, True)):
        room = Room.of(tuple(stay), actuator or ActuatorProfile(), limits, weber, counts_rhythm=counts_rhythm)
        outcome = Programme(room).solve() if len(room.pairs) <= _EXACT_PAIRS else give_way(room)
        if outcome.shortage_oct < _ENOUGH_OCT:
            break
    placed = {
        voice: stay[voice] if voice.is_placed else Placement(float(2.0**x), float(level_db))
        for voice, x, level_db in zip(room.voices, outcome.x, outcome.level_db, strict=True)
    }
    return tuple(placed[voice] for voice in voices)
