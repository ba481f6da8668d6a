import numpy as np
import pytest
from scipy.integrate import quad

from scene2hap.haptics import Bands
from scene2hap.propagation.bands.band_rms import BandRms, band_rms

BANDS = Bands.third_octaves(10, 1000)
GAINS = BandRms(BANDS.edges_hz)


def test_gains_are_the_mean_square_over_each_band() -> None:
    lengths = np.array([1e-4, 0.001, 0.006, 0.05, 0.4])  # short ones by a power series
    for length, row in zip(lengths, GAINS(lengths.tolist()), strict=True):
        for (low, high), gain in zip(BANDS.widths_hz(), row, strict=True):
            square = quad(lambda f, b=2 * length: np.exp(-b * np.sqrt(2 * np.pi * f)), low, high, epsrel=1e-12)[0]
            assert gain == pytest.approx(np.sqrt(square / (high - low)), rel=1e-12)


def test_fast_band_rms_equals_the_slow_formula_above_the_threshold() -> None:
    lengths = np.concatenate([[0.0, np.inf], 10 ** np.random.default_rng(0).uniform(-6, 2, 2000)])
    found, expected = GAINS(lengths.tolist()), band_rms(lengths, BANDS.widths_hz())
    np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-12)
    assert (found[0] == 1.0).all()
    assert (found[1] == 0.0).all()
    assert GAINS([]).shape == (0, 20)
