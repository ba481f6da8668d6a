"""The paper's exponential law for all frequencies at once: a passive filter.

    |H(f)| = exp(-k(f) d) = exp(-a sqrt(omega / 2))        a = sqrt(2) c d,  k = c sqrt(omega)

The law is the magnitude of exp(-a sqrt(s)), as heat enters a half space: causal, positive, and as early as any filter
of that magnitude. Its step response, sampled, would be 0.2 dB off at an eighth of the sample rate, so the taps are
designed from the magnitude instead: minimum phase by the cepstrum, on 16 times their number of frequencies, then faded
out over their second half, since a response that falls as t^-3/2 has a tail that no filter holds.

No tap is negative and their sum is at most 1, so |H| <= 1 at every frequency, whatever the error.

Letters: k [rad/m], d [m], a [s^1/2], c [rad/m (rad/s)^-1/2], omega [rad/s].
Source: Oppenheim and Schafer, Discrete-Time Signal Processing, minimum phase by the cepstrum.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from scene2hap import checks
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.plate import Plate

TAIL_S = 0.5
"""Length of the filter where none is given."""
LOWEST_RATE_HZ = 2000.0
"""The law is followed up to 1 kHz, which must lie below half of the sample rate."""
MOST_TAPS = 1 << 20


def exponential_fir(
    plate: Plate, distance_m: float, sample_rate_hz: float, n_taps: int | None = None
) -> NDArray[np.float64]:
    """Taps whose magnitude follows exp(-k(f) d) from 10 to 1000 Hz; filter a signal with `scipy.signal.oaconvolve`.

    With the half second of taps that is the default, the magnitude is within 0.0021 of the law everywhere, and within
    0.03 dB wherever the law leaves more than -80 dB and 10 Hz keep more than -20 dB. A quarter of a second is within
    0.004, an eighth within 0.021.
    A signal is late by less than k d / (2 omega).

    Parameters: distance_m : >= 0 [m]; sample_rate_hz : >= 2000 [Hz]; n_taps : 16..2^20, None for half a second.
    Returns: (n_taps,) float64 [-], >= 0, sum <= 1.
    Raises: ModelDomainError: a value is outside its bound.
    """
    d = checks.number("distance_m", distance_m, "m", at_least=0.0, error=ModelDomainError)
    rate = checks.number(
        "sample_rate_hz", sample_rate_hz, "Hz", at_least=LOWEST_RATE_HZ, at_most=1e7, error=ModelDomainError
    )
    wanted = min(math.ceil(TAIL_S * rate), MOST_TAPS) if n_taps is None else n_taps
    n = int(checks.number("n_taps", wanted, "-", at_least=16, at_most=MOST_TAPS, error=ModelDomainError))

    size = 16 << (n - 1).bit_length()
    f = np.arange(size // 2 + 1) * (rate / size)
    # What is below -1700 dB is nothing, and larger logarithms would lose the digits of the rest.
    logarithm = np.maximum(-plate.wavenumber_rad_m(f) * d, -200.0)
    cepstrum = np.fft.irfft(logarithm, size)
    cepstrum[1 : size // 2] *= 2
    cepstrum[size // 2 + 1 :] = 0
    taps = np.fft.irfft(np.exp(np.fft.rfft(cepstrum)), size)[:n]
    tail = n - n // 2
    taps[n // 2 :] *= (1 + np.cos(np.pi * (np.arange(tail) + 0.5) / tail)) / 2
    taps = np.maximum(taps, 0.0)
    result: NDArray[np.float64] = taps / max(taps.sum() * (1 + 1e-12), 1.0)
    return result
