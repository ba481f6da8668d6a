"""Split a loop into frequency bands that add up to it exactly.

A loop is periodic, so its Fourier coefficients describe it completely, and weighting them is a filter without delay and
without transients. Each inner edge has one rising step S_j(f), a raised cosine in log f; band j is S_j - S_(j+1) with
S_0 = 1 and S_N = 0, so the sum over all bands telescopes to one at every frequency. A step spans half of the narrower
band on each side. So a band's centre belongs to that band alone, and no band reaches beyond its neighbours.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.common import checks
from scene2hap.common.arrays import Floats, Floats32
from scene2hap.errors import AudioError
from scene2hap.haptics import Bands


def split_bands(loop_samples: ArrayLike, sample_rate_hz: float, bands: Bands) -> Floats32:
    """Return the part of a loop (n_samples,) in each band, (n_bands, n_samples), without delay between them.

    The lowest band extends to 0 Hz and the highest to half the rate, so that the sum is complete. For
    `Bands.dominant()`, the loop itself is the only band.
    Raises: AudioError: the loop is empty, not one channel, or not finite.
    """
    rate = checks.number("sample_rate_hz", sample_rate_hz, "Hz", above=0.0, error=AudioError)
    x = np.asarray(loop_samples, dtype=np.float64)
    if x.ndim != 1 or x.size == 0 or not np.isfinite(x).all():
        raise AudioError(f"loop_samples has shape {x.shape}; it must be one channel of finite samples, (n_samples,).")
    if bands.n_bands == 1:
        return np.array(x, dtype=np.float32)[None, :]
    spectrum = np.fft.rfft(x)
    frequencies = np.fft.rfftfreq(len(x), 1 / rate).astype(np.float64)
    weights = band_weights(frequencies, bands)
    return np.stack([np.fft.irfft(spectrum * weight, len(x)).astype(np.float32) for weight in weights])


def band_weights(frequencies_hz: ArrayLike, bands: Bands) -> Floats:
    """Return the share of each band at each frequency, (n_bands, n_frequencies), 0..1 [-]; each column adds up to 1.

    Real weights are a zero-phase filter. Bands with gains g_j add up to the loop filtered by sum_j g_j weights[j].
    """
    f = np.atleast_1d(np.asarray(frequencies_hz, dtype=np.float64))
    if bands.n_bands == 1:
        return np.ones((1, len(f)))
    log_edges = np.log(np.asarray(bands.edges_hz))
    half_widths = [0.5 * min(below, above) for below, above in pairwise(np.diff(log_edges))]
    log_f = np.log(np.maximum(f, np.finfo(float).tiny))
    steps = [np.ones_like(f)]
    for edge, half_width in zip(log_edges[1:-1], half_widths, strict=True):
        steps.append(0.5 + 0.5 * np.sin(0.5 * np.pi * np.clip((log_f - edge) / half_width, -1.0, 1.0)))
    steps.append(np.zeros_like(f))
    return np.array([below - above for below, above in pairwise(steps)])
