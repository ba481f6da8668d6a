"""The broadband filter against the exponential law at every frequency, and its passivity."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scene2hap import ExponentialPlate, Material, Plate, materials
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.fir import exponential_fir

PLATE = Plate(1.6, 0.8, 0.01, Material("steel", 7850.0, 210e9, 0.3))


def magnitude(taps: np.ndarray, rate: float) -> tuple[np.ndarray, np.ndarray]:
    size = 16 << len(taps).bit_length()
    return np.fft.rfftfreq(size, 1 / rate), np.abs(np.fft.rfft(taps, size))


def law(plate: Plate, distance_m: float, f: np.ndarray) -> np.ndarray:
    return ExponentialPlate().plate_transfer(plate, [0.0, 0.0], [[distance_m, 0.0]], f)[0].real


@pytest.mark.parametrize("rate", [2500.0, 8000.0, 44100.0])
@pytest.mark.parametrize("distance_m", [0.01, 0.1, 0.4, 0.8, 1.2, 5.0, 40.0])
def test_it_follows_the_law(distance_m: float, rate: float) -> None:
    f, found = magnitude(exponential_fir(PLATE, distance_m, rate), rate)
    band = (f >= 10.0) & (f <= 1000.0)
    expected = law(PLATE, distance_m, f)
    assert np.abs(found - expected)[band].max() < 2.1e-3
    loud = band & (expected > 1e-4)
    if expected[band][0] > 0.1:
        assert np.abs(20 * np.log10(found[loud] / expected[loud])).max() < 0.03


@pytest.mark.parametrize(("n_taps", "bound"), [(1000, 0.021), (2000, 0.004), (8000, 0.0011)])
def test_error_falls_with_length(n_taps: int, bound: float) -> None:
    worst = 0.0
    for distance_m in np.geomspace(0.05, 20.0, 12):
        f, found = magnitude(exponential_fir(PLATE, distance_m, 8000.0, n_taps), 8000.0)
        band = (f >= 10.0) & (f <= 1000.0)
        worst = max(worst, np.abs(found - law(PLATE, distance_m, f))[band].max())
    assert worst < bound


@settings(derandomize=True, deadline=None, max_examples=30)
@given(
    st.sampled_from([row.material for row in materials.table()]),
    st.floats(1e-6, 10.0),
    st.floats(0.0, 100.0),
    st.floats(2000.0, 96000.0),
    st.integers(16, 5000),
)
def test_it_is_passive_whatever_the_plate(
    material: Material, thickness_m: float, distance_m: float, rate: float, n_taps: int
) -> None:
    taps = exponential_fir(Plate(1.0, 1.0, thickness_m, material), distance_m, rate, n_taps)
    assert taps.shape == (n_taps,)
    assert np.isfinite(taps).all()
    assert (taps >= 0).all()
    assert taps.sum() <= 1.0  # which bounds |H| at every frequency
    assert magnitude(taps, rate)[1].max() <= 1 + 1e-12


def test_no_distance_is_no_filter() -> None:
    np.testing.assert_allclose(exponential_fir(PLATE, 0.0, 8000.0, 64), np.eye(64)[0], atol=1e-11)


def test_two_distances_in_a_row_are_their_sum() -> None:
    f, one = magnitude(exponential_fir(PLATE, 0.3, 8000.0), 8000.0)
    _, other = magnitude(exponential_fir(PLATE, 0.5, 8000.0), 8000.0)
    _, both = magnitude(exponential_fir(PLATE, 0.8, 8000.0), 8000.0)
    band = (f >= 10.0) & (f <= 1000.0)
    np.testing.assert_allclose((one * other)[band], both[band], atol=3e-4)


def test_it_is_early() -> None:
    """Group delay at 100 Hz: below k d / (2 omega), that of exp(-a sqrt(s)), and towards it as the rate grows."""
    f, delays = 100.0, []
    for rate in (4000.0, 16000.0, 96000.0):
        taps = exponential_fir(PLATE, 0.8, rate)
        n = np.arange(len(taps))
        turning = taps * np.exp(-2j * np.pi * f * n / rate)
        delays.append((np.sum(n * turning) / np.sum(turning)).real / rate)
    expected = float(PLATE.wavenumber_rad_m(f)) * 0.8 / (2 * 2 * np.pi * f)
    assert 0 < delays[0] < delays[1] < delays[2] < expected
    assert delays[2] > 0.9 * expected


def test_refusals() -> None:
    with pytest.raises(ModelDomainError, match="distance_m is -1 m"):
        exponential_fir(PLATE, -1.0, 8000.0)
    with pytest.raises(ModelDomainError, match="sample_rate_hz is 1000 Hz; it must be at least 2000"):
        exponential_fir(PLATE, 1.0, 1000.0)
    with pytest.raises(ModelDomainError, match="n_taps"):
        exponential_fir(replace(PLATE), 1.0, 8000.0, 4)
