"""Patch: a voice with the numbers of a real machine, and how they follow from its size.

Size law: the speed of a machine is that of a reference machine times (reference / size)^(1/2), size being the longest
side, within 3/4 and 4/3. Machines of equal tip speed would give the power 1, but larger ones of a kind are not scaled
copies. Power and bounds are assumed. Whatever runs on the mains' own frequency does not change with size.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from scene2hap.audio.sources.synth.signals import Signal, Take, phase, wander

SIZE_POWER = 0.5
SIZE_FACTOR_BOUNDS = (0.75, 4.0 / 3.0)


@dataclass(frozen=True)
class Rhythm:
    """A periodic load: its rate [Hz], its depth as a share of the amplitude, and the irregularity of the rate.

    Rates are those of what turns or is worked on; depths are assumed, below 5 dB of range for what is steady.
    """

    rate_hz: float
    depth: float
    wavers: float = 0.03

    def applied(self, y: Signal, take: Take) -> Signal:
        """A voice under that load."""
        rate = take.about(self.rate_hz) * (1.0 + self.wavers * wander(take.rng))
        return np.asarray(y * (1.0 + self.depth * np.cos(phase(rate) + take.rng.uniform(0.0, 2.0 * np.pi))))


@dataclass(frozen=True)
class Patch:
    """A voice with its numbers.

    `dominant_hz` bounds the strongest frequency at reference size; `reference_m` is the longest side of the machine
    meant by the numbers, None where size does not matter; `is_steady` says that it loops without ado; `rhythm` is what
    its load does to all of it, None for nothing.
    """

    voice: Callable[[Take], Signal]
    dominant_hz: tuple[float, float]
    reference_m: float | None = None
    is_steady: bool = True
    rhythm: Rhythm | None = None

    def size_factor(self, longest_m: float) -> float:
        """Return the factor on frequencies for a machine of this size [m]; 1 if the size is unknown (0)."""
        if self.reference_m is None or longest_m <= 0.0:
            return 1.0
        return float(np.clip((self.reference_m / longest_m) ** SIZE_POWER, *SIZE_FACTOR_BOUNDS))
