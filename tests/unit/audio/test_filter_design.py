from __future__ import annotations

import math

import numpy as np
import pytest
import scipy
from hypothesis import given, settings, strategies as st

from scene2hap.audio.filter_design import butterworth, butterworth_band, elliptic

RATES_HZ = st.sampled_from([8000.0, 22_050.0, 48_000.0, 192_000.0])


def gain(sections: np.ndarray, frequencies_hz: np.ndarray, rate_hz: float) -> np.ndarray:
    """The gain of each section is taken from its formula at z, since rounding would grow in their product."""
    z = np.exp(-2j * np.pi * frequencies_hz / rate_hz)
    found = np.ones(len(z))
    for b0, b1, b2, a0, a1, a2 in sections:
        assert a0 == 1.0
        found = found * np.abs((b0 + b1 * z + b2 * z * z) / (1.0 + a1 * z + a2 * z * z))
    return found


def warped(frequencies_hz: np.ndarray | float, rate_hz: float) -> np.ndarray:
    return np.tan(np.pi * np.asarray(frequencies_hz) / rate_hz)


@settings(max_examples=60, deadline=None)
@given(st.sampled_from([2, 4, 6]), st.floats(0.001, 0.45), RATES_HZ, st.sampled_from(["low", "high"]))
def test_butterworth_has_the_gain_of_its_formula(order: int, share: float, rate_hz: float, kind: str) -> None:
    """|H|^2 = 1 / (1 + (w / w_c)^(2 n)) with the warped frequencies w; w and w_c change places in a high-pass."""
    f = np.geomspace(0.05 * share, 0.49, 200) * rate_hz
    ratio = warped(f, rate_hz) / warped(share * rate_hz, rate_hz)
    expected = (1.0 + (ratio if kind == "low" else 1.0 / ratio) ** (2 * order)) ** -0.5
    found = gain(butterworth(order, share * rate_hz, rate_hz, kind), f, rate_hz)
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-9)


@settings(max_examples=60, deadline=None)
@given(st.sampled_from([2, 3, 4]), st.floats(20.0, 400.0), st.floats(1.1, 9.0), RATES_HZ)
def test_butterworth_band_has_the_gain_of_its_formula(order: int, low_hz: float, ratio: float, rate_hz: float) -> None:
    """The low-pass at (w^2 - w_0^2) / (w (w_2 - w_1)); a band wider than 5.8 to 1 has a section of two real poles."""
    low, high = warped(low_hz, rate_hz), warped(ratio * low_hz, rate_hz)
    f = np.geomspace(0.2 * low_hz, min(5.0 * ratio * low_hz, 0.49 * rate_hz), 200)
    w = warped(f, rate_hz)
    expected = (1.0 + ((w * w - low * high) / (w * (high - low))) ** (2 * order)) ** -0.5
    found = gain(butterworth_band(order, low_hz, ratio * low_hz, rate_hz), f, rate_hz)
    assert found == pytest.approx(expected, rel=1e-5, abs=1e-9)


@settings(max_examples=60, deadline=None)
@given(st.floats(5.0, 1500.0), st.floats(1.08, 3.0), st.sampled_from([(0.05, 70.0), (1.0, 40.0)]), RATES_HZ)
def test_elliptic_keeps_its_ripple_and_its_attenuation(
    edge_hz: float, ratio: float, decibels: tuple[float, float], rate_hz: float
) -> None:
    ripple_db, stop_db = decibels
    stop_hz = min(ratio * edge_hz, 0.49 * rate_hz)
    sections = elliptic(edge_hz, stop_hz, ripple_db, stop_db, rate_hz)
    inside = gain(sections, np.linspace(0.0, edge_hz, 4001), rate_hz)
    outside = gain(sections, np.geomspace(stop_hz, 0.4999 * rate_hz, 4001), rate_hz)
    assert inside.max() <= 1.0 + 1e-6
    # The ripple reaches its bound: the order is no higher than needed for the edges.
    assert 20.0 * math.log10(inside.min()) == pytest.approx(-ripple_db, rel=0.01)
    assert 20.0 * math.log10(outside.max()) <= -stop_db + 1e-3
    order, _ = scipy.signal.ellipord(edge_hz, stop_hz, ripple_db, stop_db, fs=rate_hz)
    assert len(sections) == math.ceil(order / 2)
    expected = np.abs(
        scipy.signal.sosfreqz(
            scipy.signal.ellip(order, ripple_db, stop_db, edge_hz, fs=rate_hz, output="sos"),
            np.linspace(0.3 * edge_hz, 1.05 * stop_hz, 99),
            fs=rate_hz,
        )[1]
    )
    found = gain(sections, np.linspace(0.3 * edge_hz, 1.05 * stop_hz, 99), rate_hz)
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-7)
