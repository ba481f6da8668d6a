"""Differences of tactile loops as they are felt, in just noticeable differences (JND).

    by frequency   |ln(f_1 / f_2)| / ln(1 + W)      W = 0.22 [-]
    by envelope    the same formula for the rates of both envelopes, if both vary
    by level       |L_1 - L_2| / 2.5 dB             L [dB] sensation levels

Levels fall with distance; frequency and rate do not. Hence there are two criteria.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.audio.analysis import rhythm_hz
from scene2hap.audio.levels import felt_level_db, felt_spectrum
from scene2hap.audio.threshold import LEVEL_JND_DB, frequency_jnds
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile

FAR_DB = 12.0
"""Attenuation at which sources must still be distinct [dB]."""
LEAST_DEPTH = 0.2
"""Modulation index below which an envelope counts as steady [-]: 3.5 dB from trough to crest, assumed."""


@dataclass(frozen=True)
class Percept:
    """A source as it is felt: dominant frequency [Hz], rate of its envelope [Hz] or None, sensation level [dB]."""

    frequency_hz: float
    envelope_hz: float | None
    level_db: float


@dataclass(frozen=True)
class Difference:
    """The differences of two sources in JNDs."""

    first: str
    second: str
    by_frequency: float
    by_envelope: float
    by_level: float
    fainter_db: float

    @property
    def without_level(self) -> float:
        """The larger of the differences in frequency and rate, which do not depend on distance."""
        return max(self.by_frequency, self.by_envelope)

    @property
    def is_distinct(self) -> bool:
        """True for 2 JND in frequency or envelope rate, or for 1 JND there and 2 in level."""
        return self.without_level >= 2.0 or (self.without_level >= 1.0 and self.by_level >= 2.0)

    @property
    def far_away(self) -> float:
        """The difference without level after 12 dB of attenuation; 0 if one of the two is no longer felt."""
        return self.without_level if self.fainter_db > FAR_DB else 0.0


def percept_of(loop_samples: ArrayLike, sample_rate_hz: float, actuator: ActuatorProfile | None = None) -> Percept:
    """Return the sensation of a tactile loop (n_samples,) on an actuator.

    The dominant frequency is that of the component furthest above its own threshold.
    Raises: AudioError: nothing lies between 10 and 1000 Hz.
    """
    x = np.asarray(loop_samples, dtype=np.float64)
    f, felt = felt_spectrum(x, sample_rate_hz, actuator)
    if not felt.any():
        raise AudioError("the loop is silent between 10 and 1000 Hz; there is nothing to tell apart.")
    level_db = felt_level_db(x, sample_rate_hz, actuator)
    return Percept(float(f[np.argmax(felt)]), rhythm_hz(x, sample_rate_hz, LEAST_DEPTH), level_db)


def difference(first: str, one: Percept, second: str, other: Percept) -> Difference:
    """Return the differences of two sources."""
    by_envelope = 0.0
    if one.envelope_hz is not None and other.envelope_hz is not None:
        by_envelope = frequency_jnds(one.envelope_hz, other.envelope_hz)
    by_level = abs(one.level_db - other.level_db) / LEVEL_JND_DB
    by_frequency = frequency_jnds(one.frequency_hz, other.frequency_hz)
    return Difference(first, second, by_frequency, by_envelope, by_level, min(one.level_db, other.level_db))


def distinctness(percepts: Mapping[str, Percept]) -> tuple[Difference, ...]:
    """Return the differences of all pairs of sources, the least distinct first."""
    pairs = [difference(a, percepts[a], b, percepts[b]) for a, b in combinations(percepts, 2)]
    return tuple(sorted(pairs, key=lambda pair: (pair.is_distinct, pair.without_level)))
