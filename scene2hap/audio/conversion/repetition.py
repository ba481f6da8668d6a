"""A loop that is converted as if it were repeated for ever.

A converter gets the loop with a part of its repetitions on both sides, so that it is settled when the loop begins. One
period of the output is kept, and the repetition after its end fades into its beginning.
"""

from __future__ import annotations

import numpy as np

from scene2hap.audio.clip import Samples
from scene2hap.audio.seam import Seam, apply_seam
from scene2hap.common.arrays import Floats32

_FADE_S = 0.02
"""Length of the cross-fade [s]. The oscillator of a converter may have another phase after the end than at the
beginning, and opposed waves cancel each other in a fade: the level of 30 ms falls by up to 7 dB, with 0.2 s by 15."""


def with_repetitions(loop: Floats32, n_around: int) -> Floats32:
    """Return a loop (n, ...) with `n_around` frames of its repetitions before and after it (n + 2 n_around, ...)."""
    return np.take(loop, np.arange(-n_around, len(loop) + n_around), axis=0, mode="wrap")


def one_period(felt: Samples, n_around: int, sample_rate_hz: int) -> Samples:
    """Return the loop (n,) in the conversion of `with_repetitions` (n + 2 n_around,); its end meets its beginning."""
    n = len(felt) - 2 * n_around
    seam = Seam(n_around, n, min(n // 2, round(_FADE_S * sample_rate_hz)), "linear")
    return apply_seam(felt, seam.fitted(felt))
