"""Patch: a voice with the parameters of a real machine, and the law by which they depend on its size.

Size law: the speed of a machine is that of a reference machine times (reference / size)^(1/2), where size is the
longest side. The factor is limited to 3/4..4/3. Equal tip speeds would give the power 1, but larger machines of a kind
are not scaled copies of smaller ones. Power and bounds are assumed. Frequencies of the mains do not depend on size.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from scene2hap.audio.sources.synth.signals import Take, phase, wander
from scene2hap.common.arrays import Floats

SIZE_POWER = 0.5
SIZE_FACTOR_BOUNDS = (0.75, 4.0 / 3.0)


@dataclass(frozen=True)
class Rhythm:
    """A periodic load, as amplitude modulation: rate [Hz], depth as a share of the amplitude, irregularity of the rate.

    `on_mains`: the rate is that at a mains frequency of 50 Hz, and follows the mains exactly.
    Rates are those of the turning part or the worked material. Depths are assumed: a range below 5 dB for steady
    sounds.
    """

    rate_hz: float
    depth: float
    wavers: float = 0.03
    on_mains: bool = False

    def applied(self, y: Floats, take: Take) -> Floats:
        """Return a voice with this load."""
        nominal_hz = take.magnet_hz(self.rate_hz) if self.on_mains else take.about(self.rate_hz)
        rate = nominal_hz * (1.0 + self.wavers * wander(take.rng))
        return np.asarray(y * (1.0 + self.depth * np.cos(phase(rate) + take.rng.uniform(0.0, 2.0 * np.pi))))


@dataclass(frozen=True)
class Patch:
    """A voice with its parameters.

    `reference_m` is the longest side of the machine to which the parameters belong, None if size has no effect;
    `rhythm` is the periodic load of the whole voice, None for none.
    """

    voice: Callable[[Take], Floats]
    reference_m: float | None = None
    rhythm: Rhythm | None = None

    def size_factor(self, longest_m: float) -> float:
        """Return the factor on frequencies for a machine of this size [m]; 1 if the size is unknown (0)."""
        if self.reference_m is None or longest_m <= 0.0:
            return 1.0
        return float(np.clip((self.reference_m / longest_m) ** SIZE_POWER, *SIZE_FACTOR_BOUNDS))
