"""Second-order low-pass, high-pass and band-pass, as sections (1, 6): b0 b1 b2 1 a1 a2.

    g = tan(pi f_c / f_s)   warped frequency [-]         k = 1 / Q   damping [-]
    H(z) = B(z) / (1 + g k + g^2 + 2 (g^2 - 1) z^-1 + (1 - g k + g^2) z^-2)
    B = g^2 (1 + z^-1)^2   low-pass       (1 - z^-1)^2   high-pass       g k (1 - z^-2)   band-pass, 0 dB at f_c

This is the trapezoidal (TPT) state-variable filter, written as a biquad, since a biquad runs in compiled code. While
frequency and Q are constant, both are the same filter. With Q = 1 / sqrt(2), low-pass and high-pass are Butterworth's,
as `scipy.signal.butter` gives them to rounding. They are written out since `scipy.signal` takes as long to load as all
other imports of a conversion together.

Source: A. Simper, "Linear trapezoidal state variable filter" (Cytomic, 2013); R. Bristow-Johnson, "Audio EQ cookbook".
"""

from __future__ import annotations

import math

import numpy as np

from scene2hap.common.arrays import Floats

_BUTTERWORTH_Q = 0.5**0.5


def low_pass(cutoff_hz: float, sample_rate_hz: float) -> Floats:
    """Return Butterworth's low-pass, -3 dB at `cutoff_hz`, which is below half the rate."""
    g = _warped(cutoff_hz, sample_rate_hz)
    return _section(g, _BUTTERWORTH_Q, (g * g, 2.0 * g * g, g * g))


def high_pass(cutoff_hz: float, sample_rate_hz: float) -> Floats:
    """Return Butterworth's high-pass, -3 dB at `cutoff_hz`, which is below half the rate."""
    return _section(_warped(cutoff_hz, sample_rate_hz), _BUTTERWORTH_Q, (1.0, -2.0, 1.0))


def band_pass(center_hz: float, q: float, sample_rate_hz: float) -> Floats:
    """Return a band-pass of 0 dB at `center_hz`, which is below half the rate; -3 dB at the ends of center_hz / q."""
    g, k = _warped(center_hz, sample_rate_hz), 1.0 / q
    return _section(g, q, (g * k, 0.0, -g * k))


def _warped(frequency_hz: float, sample_rate_hz: float) -> float:
    return math.tan(math.pi * frequency_hz / sample_rate_hz)


def _section(g: float, q: float, numerator: tuple[float, float, float]) -> Floats:
    k = 1.0 / q
    a0 = 1.0 + g * k + g * g
    return np.array([[*numerator, a0, 2.0 * (g * g - 1.0), 1.0 - g * k + g * g]]) / a0
