"""Roughness: amplitude modulation of a bed (the continuous part of a vibration) by a low component of its sound."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy
from numpy.typing import NDArray

from scene2hap.audio.tactile.stages import Chain, Signal, SosStage, Stage
from scene2hap.compiled import compiled

DEPTH = 0.5
"""Depth of the modulation. It is felt as roughness (the least depth of a rhythm is 0.2, see `distinctness`). Its side
bands are 12 dB below the bed, so that they do not dominate at frequencies to which touch is more sensitive."""
NOTHING = 1e-6
"""Amplitude below which there is no component (-120 dB re full scale)."""
_SLOWER = 4.0
"""Frequency of a rough component over the cut-off of its envelope [-]."""


class Roughened(Stage):
    """A bed of stages in series without latency, modulated by the output of a band-pass at `rough_hz`.

    If the bed's first stage is this band-pass, it runs once for both.
    """

    def __init__(self, bed: Sequence[Stage], band: Stage, rough_hz: float, sample_rate_hz: float) -> None:
        self._band, self._is_shared = band, bed[0] is band
        self._bed = Chain(bed[1:] if self._is_shared else bed)
        self._envelope = SosStage(scipy.signal.butter(2, rough_hz / _SLOWER, fs=sample_rate_hz, output="sos"))

    def run(self, x: Signal) -> Signal:
        """Return the modulated bed."""
        low = self._band.run(x)
        return modulated(self._bed.run(low if self._is_shared else x), low, self._envelope.run(np.abs(low)))


@compiled
def modulated(bed: NDArray[np.float64], low: NDArray[np.float64], mean: NDArray[np.float64]) -> NDArray[np.float64]:
    """Modulate a bed (n,) by a low component (n,), divided by its envelope. Returns: (n,).

    Parameters: mean : the low-passed absolute value of the component (n,), from which the envelope follows.
    """
    envelope = np.maximum(mean * (0.5 * np.pi), NOTHING)
    return np.asarray(bed * (1.0 + DEPTH * np.clip(low / envelope, -1.0, 1.0)))
