"""Just noticeable differences (JND) of frequency and level, and the rhythm of a sound.

    frequency   |ln(f_1 / f_2)| / ln(1 + W)      W = 0.22 [-]
    level       |L_1 - L_2| / 2.5 dB             L [dB] sensation levels

Published Weber fractions of frequency are 0.18 to 0.25; the middle is used. Level JNDs are 2.2 to 2.5 dB; the larger is
used (Israr, Tan and Reed 2006). For the rate of an envelope the Weber fraction of frequency is assumed.
"""

from __future__ import annotations

import math

import numpy as np
import scipy
from numpy.typing import ArrayLike

from scene2hap.common import checks
from scene2hap.errors import AudioError

FREQUENCY_WEBER = 0.22
WIDEST_WEBER = 0.25
"""The largest published Weber fraction: everybody can distinguish two sources with this difference."""
LEVEL_JND_DB = 2.5

_RATE_HZ = (0.5, 60.0)
SURE_DEPTH = 0.25
"""Modulation index of an envelope [-] from which every loop cut from a sound has its rate."""


def frequency_jnds(one_hz: float, other_hz: float) -> float:
    """Return the number of JNDs between two frequencies [-]."""
    a = checks.number("one_hz", one_hz, "Hz", above=0.0, error=AudioError)
    b = checks.number("other_hz", other_hz, "Hz", above=0.0, error=AudioError)
    return abs(math.log(a / b)) / math.log1p(FREQUENCY_WEBER)


def rhythm_hz(samples: ArrayLike, sample_rate_hz: float, least_depth: float = SURE_DEPTH) -> float | None:
    """Return the strongest rate in the Hilbert envelope of a sound (n_samples,) [Hz].

    None if its modulation index is below `least_depth` [-].
    """
    x = np.asarray(samples, dtype=np.float64)
    envelope = np.abs(scipy.signal.hilbert(x - x.mean()))
    rates = np.fft.rfftfreq(len(x), 1.0 / sample_rate_hz)
    inside = (rates >= _RATE_HZ[0]) & (rates <= _RATE_HZ[1])
    depth = 2.0 * np.abs(scipy.fft.rfft(envelope)) / len(x) / envelope.mean()
    depth[~inside] = 0.0
    k = int(np.argmax(depth))
    return float(rates[k]) if depth[k] >= least_depth else None
