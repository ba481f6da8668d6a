"""Envelope analysis of signals with known amplitude and frequency."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap.export.curves import CurveSettings, curves_of
from scene2hap.export.envelope import analyse
from scene2hap.export.track import ANALYSIS_HZ as RATE, Channel

T = np.arange(2 * RATE) / RATE


@pytest.mark.parametrize("hertz", [25.0, 55.0, 120.0, 333.0, 800.0])
@pytest.mark.parametrize("is_loop", [True, False])
def test_a_steady_tone_has_its_amplitude_and_frequency(hertz: float, is_loop: bool) -> None:
    found = analyse(0.4 * np.sin(2 * np.pi * hertz * T), RATE, is_loop=is_loop)
    inner = slice(None) if is_loop else slice(20, -20)
    np.testing.assert_allclose(found.amplitude[inner], 0.4, rtol=0.02)
    np.testing.assert_allclose(found.frequency_hz[inner], hertz, rtol=0.01)
    assert not found.pulses
    assert found.duration_s == pytest.approx(2.0)


def test_slow_modulation_is_followed() -> None:
    amplitude = 0.5 * (1 + 0.6 * np.sin(2 * np.pi * 1.5 * T))
    found = analyse(amplitude * np.sin(2 * np.pi * 140 * T), RATE, is_loop=True)
    expected = 0.5 * (1 + 0.6 * np.sin(2 * np.pi * 1.5 * found.times_s))
    np.testing.assert_allclose(found.amplitude, expected, atol=0.01)
    assert found.amplitude[0] == pytest.approx(found.amplitude[-1])


def test_the_amplitude_of_noise_is_that_of_a_sine_of_its_power() -> None:
    rng = np.random.default_rng(3)
    x = 0.1 * rng.standard_normal(len(T))
    found = analyse(x, RATE, is_loop=True)
    assert np.sqrt(np.mean(found.amplitude**2)) == pytest.approx(np.sqrt(2) * x.std(), rel=0.05)


def test_a_glide_is_followed_and_noise_does_not_move_a_hum() -> None:
    glide = np.sin(2 * np.pi * (80 * T + 0.5 * 40 * T**2))  # 80 to 160 Hz
    found = analyse(0.5 * glide, RATE, is_loop=False)
    middle = (found.times_s > 0.2) & (found.times_s < 1.8)
    np.testing.assert_allclose(found.frequency_hz[middle], 80 + 40 * found.times_s[middle], rtol=0.03)
    rng = np.random.default_rng(5)
    noisy = 0.3 * np.sin(2 * np.pi * 100 * T) + 0.15 * rng.standard_normal(len(T))
    hum = analyse(np.clip(noisy, -1, 1), RATE, is_loop=False)
    assert np.percentile(np.abs(hum.frequency_hz / 100 - 1), 95) < 0.05


def test_pulses_are_found_and_roughness_is_not_a_pulse() -> None:
    t = np.arange(3 * RATE) / RATE
    x = 0.05 * np.sin(2 * np.pi * 90 * t)
    for at in (0.7, 1.9):
        n = round(at * RATE)
        x[n : n + 160] += 0.6 * np.sin(2 * np.pi * 150 * t[:160])
    found = analyse(x, RATE, is_loop=False)
    assert [pulse.start_s for pulse in found.pulses] == pytest.approx([0.7, 1.9], abs=0.02)
    rough = 0.5 * np.sin(2 * np.pi * 120 * t) * (1 + 0.9 * np.sin(2 * np.pi * 25 * t)) / 2
    assert not analyse(rough, RATE, is_loop=True).pulses


def test_more_points_keep_the_roughness_of_a_source() -> None:
    """A tumble dryer is felt as 250 Hz, rough at 47 Hz; 40 points a second cannot hold that."""
    rough = Channel(0.4 * np.sin(2 * np.pi * 250 * T) * (1 + 0.6 * np.sin(2 * np.pi * 47 * T)), RATE, is_loop=True)
    depths = {}
    for points in (40, 100, 200):
        curve = curves_of(rough, CurveSettings(amplitude_points=points)).amplitude
        played = np.interp(T, curve.times_s, curve.values)
        depths[points] = 2 * abs(np.mean(played * np.exp(-2j * np.pi * 47 * T))) / played.mean()
    assert depths[40] < 0.1
    assert 0.3 < depths[100] < 0.6
    assert depths[200] == pytest.approx(0.6, abs=0.05)


@pytest.mark.parametrize("n", [1, 2, 7, 400])
def test_short_and_silent_signals_have_an_envelope(n: int) -> None:
    for samples in (np.zeros(n), np.full(n, 0.5)):
        found = analyse(samples, RATE, is_loop=True)
        assert len(found.times_s) >= 2
        assert np.isfinite([*found.amplitude, *found.frequency_hz, *found.sharpened()]).all()


@pytest.mark.parametrize("rate", [2000.0, 8000.0, 11_025.0])
def test_a_loop_is_resampled_without_a_seam(rate: float) -> None:
    t = np.arange(48_000) / 48_000
    loop = Channel(0.5 * np.sin(2 * np.pi * 100 * t), 48_000, is_loop=True)
    expected = 0.5 * np.sin(2 * np.pi * 100 * np.arange(int(rate)) / rate)
    np.testing.assert_allclose(loop.at_rate(rate), expected, atol=1e-6)


def test_the_curve_of_a_loop_with_an_attack_at_its_seam_has_equal_ends() -> None:
    """A player that repeats the clip would step from the last value to the first."""
    blows = np.exp(-6.0 * (T % 0.5)) * np.sin(2 * np.pi * 100 * T)
    curve = curves_of(Channel(0.5 * blows, RATE, True), CurveSettings()).amplitude
    assert curve.values[0] == curve.values[-1]
    at = {round(float(time), 3): value for time, value in zip(curve.times_s, curve.values, strict=True)}
    assert curve.values[0] == pytest.approx(np.interp(0.5, list(at), list(at.values())), rel=0.1)
