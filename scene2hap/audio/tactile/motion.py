"""The motion of a resonant actuator for its drive: what of a band, a modulation and a burst arrives at the skin.

A coin-sized actuator with a Q of 12 at 175 Hz rings for 22 ms. The inverse of its response (`actuators.inverse_db`)
lifts the flanks of the resonance by `MAX_BOOST_DB` inside the actuator's band. There the compensated motion is within
4 dB of that of a resonator whose Q is lower by this factor. A stream that plays live is not compensated.
"""

from __future__ import annotations

import numpy as np
import scipy

from scene2hap.audio.actuators import MAX_BOOST_DB, inverse_db, response_db
from scene2hap.audio.tactile.stages import SosStage, Stage
from scene2hap.audio.tactile.svf_bandpass import SvfBandpass
from scene2hap.haptics import ActuatorProfile

_BOOST = 10 ** (MAX_BOOST_DB / 20)
_ORDER = 3
"""Order of the flanks of `played_band`: with 18 dB per octave, it delays a band of 100 Hz by some 10 ms."""
_INSIDE = 1.1
"""Ratio by which the flanks begin inside the band, so that little is left at its edges, where the inverse ends
abruptly [-]. With 1.06 and 1.1, a pitch of 60 to 240 Hz on `lra` grew in range by 6.3 and 4.6 dB, with 1 by 10."""
_HIGHEST = 0.4
"""Highest frequency of a filter, as a share of the sample rate."""


def played_band(actuator: ActuatorProfile, sample_rate_hz: float) -> Stage:
    """Return a filter that leaves what an actuator plays."""
    high_hz = min(actuator.max_frequency_hz, _HIGHEST * sample_rate_hz)
    edges_hz = min(_INSIDE * actuator.min_frequency_hz, 0.5 * high_hz), high_hz / _INSIDE
    return SosStage(scipy.signal.butter(_ORDER, edges_hz, "bandpass", fs=sample_rate_hz, output="sos"))


def motion(actuator: ActuatorProfile, sample_rate_hz: float, *, is_compensated: bool) -> Stage | None:
    """Return the motion of a resonant actuator for its drive; None without resonance, or with a measured response."""
    if actuator.response_db or actuator.resonance_hz is None or actuator.q is None:
        return None
    q = min(max(actuator.q / _BOOST if is_compensated else actuator.q, 0.1), 100.0)
    return SosStage(SvfBandpass(min(actuator.resonance_hz, _HIGHEST * sample_rate_hz), q).section(sample_rate_hz))


def ringing_s(actuator: ActuatorProfile) -> float:
    """Return the time in which the compensated motion rings down to 1/e [s]; 0 where `motion` is None.

    It is Q / (pi f_0), and as long is the time in which the motion for a sine rises to 1 - 1/e of its height.
    """
    if actuator.response_db or actuator.resonance_hz is None or actuator.q is None:
        return 0.0
    return actuator.q / _BOOST / (np.pi * actuator.resonance_hz)


def modulation_gain(actuator: ActuatorProfile, carrier_hz: float, rate_hz: float) -> float:
    """Return the depth of an amplitude modulation in the motion, as a share of that in the compensated drive [-]."""
    f = np.abs(carrier_hz + np.array([-rate_hz, 0.0, rate_hz]))
    below, middle, above = 10 ** ((response_db(actuator, f) + inverse_db(actuator, f)) / 20)
    return float(0.5 * (below + above) / middle)
