"""What goes into an update, and what comes out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap import checks
from scene2hap.errors import SessionError, UnknownObject


@dataclass(frozen=True)
class Touch:
    """A hand on an object at a world point [m]."""

    hand: str
    object_id: str
    point_m: tuple[float, float, float]

    def __post_init__(self) -> None:
        point = checks.vector("point_m", self.point_m, "m", size=3, error=SessionError)
        object.__setattr__(self, "point_m", point)


@dataclass(frozen=True, eq=False)
class HapticFrame:
    """What one update decided: gains (n_hands, n_sources, n_bands) float32 [-]."""

    gains: NDArray[np.float32]
    hands: tuple[str, ...]
    sources: tuple[str, ...]

    def gain(self, hand: str, source_id: str) -> float:
        """The loudest band's gain of a source at a hand [-].

        Raises: SessionError: no such hand; UnknownObject: no such source.
        """
        if hand not in self.hands:
            raise SessionError(f"no hand {hand!r}; this session has {', '.join(map(repr, self.hands))}.")
        if source_id not in self.sources:
            raise UnknownObject(unknown_source(source_id, self.sources))
        return float(self.gains[self.hands.index(hand), self.sources.index(source_id)].max())


@dataclass(frozen=True)
class SessionStats:
    """What a session has done so far; `bodiless` objects carry no vibration since their material is unknown."""

    updates: int = 0
    fields_prepared: int = 0
    gains_capped: int = 0
    bodiless: tuple[str, ...] = ()


def unknown_source(source_id: str, source_ids: Sequence[str]) -> str:
    """The sentence for an id that is not a source."""
    known = ", ".join(map(repr, source_ids)) or "none: nothing in this scene vibrates"
    return f"no source {source_id!r}; the sources are {known}."
