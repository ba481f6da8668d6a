"""Roughness: amplitude modulation of a bed (the continuous part of a vibration) by a low component of its sound.

y = bed (1 + d s / (1 + s^8)^(1/8)),   s = r / e      r: waveform of the component, e: its envelope, d: depth [-]

The root bounds a waveform that exceeds its envelope for a moment. A sharp bound at 1 has corners, which are heard as a
buzz above the band of touch.
"""

from __future__ import annotations

import numpy as np

from scene2hap.audio.second_order import low_pass
from scene2hap.audio.tactile.stages import SosStage, Stage
from scene2hap.common.arrays import Floats
from scene2hap.compiled import compiled

DEPTH = 0.5
"""Depth of the modulation. It is felt as roughness. Its side bands are 12 dB below the bed, so that they do not
dominate at frequencies to which touch is more sensitive."""
LINE_Q = 6.0
"""Quality of each of two band-passes in series that leave the rough component alone [-]: wide enough for the speed of
an engine to waver by 5 %, narrow enough to leave out the next note but one."""
NOTHING = 1e-6
"""Amplitude below which there is no component (-120 dB re full scale)."""
_SLOWER = 4.0
"""Frequency of a rough component over the cut-off of its envelope [-]."""


class Roughened(Stage):
    """A bed, modulated by the line at `rough_hz`, relative to the envelope of a wider band around it.

    Other notes in the band, as of music, hardly modulate the bed.
    Parameters: depth : of the modulation, which may exceed 1 for an actuator that renders little of it [-].
    """

    def __init__(
        self, bed: Stage, band: Stage, line: Stage, rough_hz: float, sample_rate_hz: float, *, depth: float = DEPTH
    ) -> None:
        self._bed, self._band, self._line, self._depth = bed, band, line, depth
        self._envelope = SosStage(low_pass(rough_hz / _SLOWER, sample_rate_hz))
        self._low = self._mean = np.empty(0)  # low component and its mean size, as long as the bed is late

    def run(self, x: Floats) -> Floats:
        """Return the modulated bed, as late as the bed."""
        self._low = np.concatenate([self._low, self._line.run(x)])
        self._mean = np.concatenate([self._mean, self._envelope.run(np.abs(self._band.run(x)))])
        return self._modulated(self._bed.run(x))

    def rest(self) -> Floats:
        """Return the last samples of the bed."""
        return self._modulated(self._bed.rest())

    def _modulated(self, bed: Floats) -> Floats:
        n = len(bed)
        rough = modulated(bed, self._low[:n], self._mean[:n], self._depth)
        self._low, self._mean = self._low[n:], self._mean[n:]
        return rough


@compiled
def modulated(bed: Floats, low: Floats, mean: Floats, depth: float) -> Floats:
    """Modulate a bed (n,) by a low component (n,), divided by its envelope. Returns: (n,).

    Parameters: mean : the low-passed absolute value of the component (n,), from which the envelope follows; depth : of
    the modulation [-].
    """
    envelope = np.maximum(mean * (0.5 * np.pi), NOTHING)
    share = low / envelope
    eighth = np.square(np.square(np.square(share)))
    return np.asarray(bed * (1.0 + depth * (share / np.sqrt(np.sqrt(np.sqrt(1.0 + eighth))))))
