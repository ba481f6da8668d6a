"""Butterworth and elliptic filters, as second-order sections (n_sections, 6) of b0 b1 b2 1 a1 a2.

Poles and zeros are those of the analog low-pass with cut-off 1, moved to the filter's edges, and mapped by
s = (z - 1) / (z + 1), so that an edge of f Hz lies at tan(pi f / f_s). An elliptic low-pass of order N has

    zeros j / (k cd(u_i, k))        poles j cd(u_i - j v, k)        u_i = (2 i - 1) / N        j v = asn(j / e, k1) / N

with its ripple e, k1 = e / sqrt(10^(stop_db / 10) - 1), and k such that the nomes q of both moduli fulfil
q(k) = q(k1)^(1/N). The arguments of cd and asn are in units of the quarter period.

`scipy.signal` designs the same filters. They are written out here since its import takes a third of the time in which
the command line converts a short sound.
Source: S. J. Orfanidis, "Lecture notes on elliptic filter design", Rutgers University 2006; for nomes, M. Abramowitz
and I. A. Stegun, Handbook of mathematical functions, 17.3.21 and 16.38.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable
from itertools import pairwise
from typing import Literal

import numpy as np

from scene2hap.common.arrays import Floats

_Pair = tuple[complex, complex]


def butterworth(order: int, edge_hz: float, sample_rate_hz: float, kind: Literal["low", "high"] = "low") -> Floats:
    """Return a low-pass or high-pass of even order with -3 dB at its edge, and 0 dB at 0 Hz or half the sample rate."""
    edge, is_low = _warped(edge_hz, sample_rate_hz), kind == "low"
    pairs = [(p, p.conjugate()) for p in _butterworth_poles(order)]
    poles = [(edge * p, edge * q) if is_low else (edge / p, edge / q) for p, q in pairs]
    end = -1.0 if is_low else 1.0
    return _sections(poles, [(end, end)] * len(poles), at=-end)


def butterworth_band(order: int, low_hz: float, high_hz: float, sample_rate_hz: float) -> Floats:
    """Return a band-pass with -3 dB at its edges and 0 dB between them, whose flanks have the given order each."""
    low, high = _warped(low_hz, sample_rate_hz), _warped(high_hz, sample_rate_hz)
    middle, half = math.sqrt(low * high), 0.5 * (high - low)
    poles = []
    for p in _butterworth_poles(order):
        root = cmath.sqrt((half * p) ** 2 - middle**2)
        both = half * p + root, half * p - root
        # A real pole of the low-pass becomes a pair by itself.
        poles += [both] if p.imag == 0.0 else [(one, one.conjugate()) for one in both]
    return _sections(poles, [(1.0, -1.0)] * len(poles), at=(1.0 + 1j * middle) / (1.0 - 1j * middle))


def elliptic(edge_hz: float, stop_hz: float, ripple_db: float, stop_db: float, sample_rate_hz: float) -> Floats:
    """Return the elliptic low-pass of least order with this ripple to its edge, and this attenuation from stop_hz on.

    Its gain is between -ripple_db and 0 dB up to the edge. The transition is as narrow as the order allows.
    """
    edge = _warped(edge_hz, sample_rate_hz)
    ripple = math.sqrt(10 ** (0.1 * ripple_db) - 1.0)
    k1 = ripple / math.sqrt(10 ** (0.1 * stop_db) - 1.0)
    order = math.ceil(math.log(_nome(k1)) / math.log(_nome(edge / _warped(stop_hz, sample_rate_hz))))
    k = _modulus(_nome(k1) ** (1.0 / order))
    v = _asn(1j / ripple, k1) / order
    places = [(2 * i - 1) / order for i in range(1, order // 2 + 1)]
    zeros = [_mapped(1j * edge / (k * _cd(u, k))) for u in places]
    poles = [1j * edge * _cd(u - v, k) for u in places]
    sections = _sections([(p, p.conjugate()) for p in poles], [(z, z.conjugate()) for z in zeros], at=1.0)
    if order % 2 == 0:
        sections[0, :3] *= 10 ** (-0.05 * ripple_db)
        return sections
    # The pole of the place u = 1, where cd is 0, is real, and its zero is infinite.
    pole = _mapped((1j * edge * _cd(1.0 - v, k)).real).real
    return np.concatenate([sections, [[0.5 * (1.0 - pole), 0.5 * (1.0 - pole), 0.0, 1.0, -pole, 0.0]]])


def _warped(hz: float, sample_rate_hz: float) -> float:
    return math.tan(math.pi * hz / sample_rate_hz)


def _mapped(s: complex) -> complex:
    return (1.0 + s) / (1.0 - s)


def _butterworth_poles(order: int) -> list[complex]:
    """Return the poles of the low-pass with cut-off 1 in the upper left quarter, with the real one of an odd order."""
    poles = [1j * cmath.exp(0.5j * math.pi * (2 * i + 1) / order) for i in range(order // 2)]
    return [*poles, complex(-1.0)] if order % 2 else poles


def _sections(poles: Iterable[_Pair], zeros: Iterable[_Pair], at: complex) -> Floats:
    """Return sections with these pairs of poles in s and of zeros in z, each with gain 1 at a point of the circle."""
    rows = []
    for pair, (z1, z2) in zip(poles, zeros, strict=True):
        p1, p2 = map(_mapped, pair)
        gain = abs((at - p1) * (at - p2) / ((at - z1) * (at - z2)))
        b1, b2 = -(z1 + z2).real, (z1 * z2).real
        rows.append([gain, gain * b1, gain * b2, 1.0, -(p1 + p2).real, (p1 * p2).real])
    return np.array(rows)


def _nome(k: float) -> float:
    """Return the nome q of a modulus, to 1e-12 up to k = 0.93."""
    root = -math.expm1(0.25 * math.log1p(-k * k))  # 1 - sqrt(k'), exact for small k
    x = 0.5 * root / (2.0 - root)
    return x + 2.0 * x**5 + 15.0 * x**9 + 150.0 * x**13 + 1707.0 * x**17


def _modulus(q: float) -> float:
    """Return the modulus of a nome."""
    above = sum(q ** (m * (m + 1)) for m in range(8))
    below = 1.0 + 2.0 * sum(q ** (m * m) for m in range(1, 8))
    return 4.0 * math.sqrt(q) * (above / below) ** 2


def _descending(k: float) -> list[float]:
    """Return the moduli of Landen's descending transformation, from k down to 0."""
    moduli = [k]
    while moduli[-1] > 1e-16:
        moduli.append((moduli[-1] / (1.0 + math.sqrt(1.0 - moduli[-1] ** 2))) ** 2)
    return moduli


def _cd(u: complex, k: float) -> complex:
    w = cmath.cos(0.5 * math.pi * u)
    for v in reversed(_descending(k)[1:]):
        w = (1.0 + v) * w / (1.0 + v * w * w)
    return w


def _asn(w: complex, k: float) -> complex:
    moduli = _descending(k)
    for before, v in pairwise(moduli):
        w = 2.0 * w / ((1.0 + v) * (1.0 + cmath.sqrt(1.0 - (before * w) ** 2)))
    return 2.0 / math.pi * cmath.asin(w)
