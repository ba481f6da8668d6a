"""Detection of a moving pitch, and the frequency band that holds it.

An engine that revs from 40 to 160 Hz leaves any band that is narrow enough for a hum. The levels of the sound and of a
band of it are taken over half a second. The range of a level is that from its 5th to its 95th percentile. If the range
of the band exceeds that of the sound by a felt difference (`threshold.NOTICED_DB`), and the sound has lines, the
band must hold the strongest line at all times. With a and b the 5th and the 95th percentile of the line's frequency, in
stretches of half a second:

    centre f_0 = sqrt(a b)        r = b / f_0        Q such that B(b) = 1 / (1 + Q^2 (r - 1 / r)^2) is -3 dB

Touch hardly notices the change of level within such a band.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from scene2hap.audio.spectra.components import magnitudes, strongest_component
from scene2hap.common.arrays import Floats

STRETCH_S = 0.5
"""Length of the stretches in which levels and pitch are taken [s]."""
_LEAST_STRETCHES = 4
"""Fewest stretches from which a range is taken: a sound of two seconds."""
_LEAST_SHARE = 0.5
"""Least share of stretches with a line; a sound with fewer has no pitch [-]."""
_LEAST_Q = 0.2
"""Least Q of a band [-]: wider ones hold all that is felt."""
_LOST_DB = 3.0
"""Attenuation of the line at the ends of the band [dB]."""


class MovingPitch(NamedTuple):
    """The band that holds a moving pitch: centre [Hz], and Q of each of two band-passes in series [-]."""

    centre_hz: float
    q: float


def growth_db(sound: Floats, band: Floats, duration_s: float) -> float:
    """Return the range of a band's level minus that of its sound [dB]; 0 for a short sound.

    Parameters: sound (n,), band (m,) : of equal duration, at any rates.
    """
    n_stretches = int(duration_s / STRETCH_S)
    if n_stretches < _LEAST_STRETCHES:
        return 0.0
    return _range_db(band, n_stretches) - _range_db(sound, n_stretches)


def moving_pitch(x: Floats, sample_rate_hz: float, range_hz: tuple[float, float], most_q: float) -> MovingPitch | None:
    """Return the band that holds the strongest line of a sound (n,) in each stretch.

    None if the sound has no lines, or if a band of quality `most_q` holds them.
    """
    size = round(STRETCH_S * sample_rate_hz)
    stretches = x[: len(x) // size * size].reshape(-1, size)
    found = [strongest_component(magnitudes(one), sample_rate_hz, range_hz) for one in stretches]
    lines_hz = [one.hz for one in found if one is not None and one.is_line]
    if len(lines_hz) < max(_LEAST_STRETCHES, _LEAST_SHARE * len(stretches)):
        return None
    low, high = (float(hz) for hz in np.percentile(lines_hz, (5, 95)))
    r = math.sqrt(high / low)
    q = math.sqrt(10 ** (_LOST_DB / 20) - 1.0) / max(r - 1.0 / r, 1e-9)
    if q >= most_q:
        return None  # the pitch stays in the band, whose level varies for another reason, such as a beat
    return MovingPitch(math.sqrt(low * high), max(q, _LEAST_Q))


def _range_db(x: Floats, n_stretches: int) -> float:
    size = len(x) // n_stretches
    power = np.square(x[: n_stretches * size].reshape(n_stretches, size)).mean(axis=1)
    low, high = np.percentile(power, (5, 95))
    return 10.0 * math.log10(max(float(high), 1e-30) / max(float(low), 1e-30))
