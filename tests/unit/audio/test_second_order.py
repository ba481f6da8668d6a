"""Second-order filters against scipy's design, over the frequencies and rates that conversions use."""

import numpy as np
import pytest
from scipy.signal import butter

from scene2hap.audio.second_order import high_pass, low_pass


@pytest.mark.parametrize("rate_hz", [8_000, 44_100, 48_000, 192_000])
@pytest.mark.parametrize("cutoff_hz", [5.0, 15.0, 40.0, 1000.0, 3200.0])
def test_low_and_high_pass_are_those_of_butterworth(cutoff_hz: float, rate_hz: float) -> None:
    low, high = (butter(2, cutoff_hz, kind, fs=rate_hz, output="sos") for kind in ("lowpass", "highpass"))
    np.testing.assert_allclose(low_pass(cutoff_hz, rate_hz), low, rtol=1e-14)
    np.testing.assert_allclose(high_pass(cutoff_hz, rate_hz), high, rtol=1e-14)


@pytest.mark.parametrize("rate_hz", [8_000, 192_000])
@pytest.mark.parametrize("share", [0.4, 0.49, 0.499])
def test_they_are_so_near_half_the_rate(share: float, rate_hz: float) -> None:
    """Both designs lose digits there, since the tangent is near its pole."""
    low, high = (butter(2, share * rate_hz, kind, fs=rate_hz, output="sos") for kind in ("lowpass", "highpass"))
    np.testing.assert_allclose(low_pass(share * rate_hz, rate_hz), low, rtol=1e-11)
    np.testing.assert_allclose(high_pass(share * rate_hz, rate_hz), high, rtol=1e-11)
