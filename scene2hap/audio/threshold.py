"""Thresholds of touch: the least vibration that is felt, by frequency, and just noticeable differences (JND).

T(f) = A / lg(b)^2 * lg(f / 550 + b)^2 - e      [dB re full scale], b = 6/11, A = 50, e = 45, at most 0

Source: the psychohaptic model of the MPEG haptics reference software (ISO/IEC 23090-31), whose convention is that full
scale is 45 dB over the threshold at 250 Hz.

    frequency   |ln(f_1 / f_2)| / ln(1 + W)      W = 0.22 [-]
    level       |L_1 - L_2| / 2.5 dB             L [dB] sensation levels

Published Weber fractions of frequency are 0.18 to 0.25; the middle is used. Level JNDs are 2.2 to 2.5 dB; the larger is
used (Israr, Tan and Reed 2006). For the rate of an envelope the Weber fraction of frequency is assumed.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.errors import AudioError

TACTILE_RANGE_HZ = (10.0, 1000.0)
"""Range that touch perceives as vibration, and that the bands cover."""

FREQUENCY_WEBER = 0.22
WIDEST_WEBER = 0.25
"""The largest published Weber fraction: everybody can distinguish two sources with this difference."""
LEVEL_JND_DB = 2.5
NOTICED_DB = 3.0
"""Tolerance of levels [dB], a little more than a JND: smaller errors and changes of level do not matter."""

_A, _B, _E = 50.0, 6.0 / 11.0, 45.0


def threshold_db(frequencies_hz: ArrayLike) -> Floats:
    """Return T(f), the least drive that is felt [dB re full scale], in the shape of `frequencies_hz`."""
    f = np.asarray(frequencies_hz, dtype=np.float64)
    return np.minimum(0.0, _A / math.log10(_B) ** 2 * np.log10(f / 550.0 + _B) ** 2 - _E)


def frequency_jnds(one_hz: float, other_hz: float) -> float:
    """Return the number of JNDs between two frequencies [-]."""
    a = checks.number("one_hz", one_hz, "Hz", above=0.0, error=AudioError)
    b = checks.number("other_hz", other_hz, "Hz", above=0.0, error=AudioError)
    return abs(math.log(a / b)) / math.log1p(FREQUENCY_WEBER)
