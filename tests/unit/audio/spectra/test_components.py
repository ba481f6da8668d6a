"""Lines and bands of noise in a spectrum."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap.audio.spectra.components import components, magnitudes, strongest_bands_hz

RATE = 8000
RANGE = (20.0, 1000.0)


@pytest.mark.parametrize("seed", range(8))
def test_components_marks_a_hum_in_noise_as_a_line(seed: int) -> None:
    rng, t = np.random.default_rng(seed), np.arange(5 * RATE) / RATE
    noise = rng.standard_normal(len(t))
    assert not any(one.is_line for one in components(magnitudes(noise), RATE, RANGE, -14.0))
    hum = noise + 0.3 * np.sin(2 * np.pi * 97.3 * t)
    strongest = components(magnitudes(hum), RATE, RANGE, -14.0)[0]
    assert strongest.is_line
    assert strongest.hz == pytest.approx(97.3, abs=0.1)


def test_noise_seldom_has_a_line() -> None:
    """With a bound of 12 dB, one noise in ten had a line, and boiling water was felt at the line's frequency."""
    rate = 2400
    noises = np.random.default_rng(5).standard_normal((200, 5 * rate))
    found = [components(magnitudes(noise), rate, RANGE, -14.0) for noise in noises]
    assert sum(any(one.is_line for one in of_noise) for of_noise in found) <= 2


def test_strongest_bands_are_sorted_and_faint_bands_left_out() -> None:
    rng = np.random.default_rng(3)
    spectrum = np.fft.rfft(rng.standard_normal(5 * RATE))
    f = np.fft.rfftfreq(5 * RATE, 1 / RATE)
    x = np.fft.irfft(np.where((f > 143) & (f < 176), spectrum, 0.01 * spectrum), 5 * RATE)
    assert strongest_bands_hz(magnitudes(x), RATE, RANGE, -14.0) == [pytest.approx(158.5, abs=0.1)]
    assert strongest_bands_hz(magnitudes(np.zeros(RATE)), RATE, RANGE, -14.0) == []


def test_bands_below_and_above_the_range_are_left_out() -> None:
    """A rumble of 10 Hz and a hiss of 1.6 kHz are stronger than the band within the range."""
    rng = np.random.default_rng(3)
    spectrum = np.fft.rfft(rng.standard_normal(5 * RATE))
    f = np.fft.rfftfreq(5 * RATE, 1 / RATE)
    strength = np.select([f < 12, (f > 143) & (f < 176), f > 1500], [100.0, 1.0, 3.0], 0.001)
    x = np.fft.irfft(spectrum * strength, 5 * RATE)
    assert strongest_bands_hz(magnitudes(x), RATE, RANGE, -14.0) == [pytest.approx(158.5, abs=0.1)]


@pytest.mark.parametrize(("weaker_db", "n_found"), [(12.0, 2), (16.0, 1)])
def test_bands_are_compared_by_their_energy(weaker_db: float, n_found: int) -> None:
    rng = np.random.default_rng(3)
    spectrum = np.fft.rfft(rng.standard_normal(5 * RATE))
    f = np.fft.rfftfreq(5 * RATE, 1 / RATE)
    x = np.zeros(5 * RATE)
    for low, high, level_db in ((143.0, 176.0, 0.0), (450.0, 550.0, -weaker_db)):
        part = np.fft.irfft(np.where((f > low) & (f < high), spectrum, 0.0), 5 * RATE)
        x += 10 ** (level_db / 20) * part / np.sqrt((part**2).mean())
    found = strongest_bands_hz(magnitudes(x), RATE, RANGE, -14.0)
    assert found == pytest.approx([158.5, 501.2][:n_found], abs=0.1)
