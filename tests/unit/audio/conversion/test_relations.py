"""Relations between conversions: other rates, levels, delays, polarity and channels of one sound."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d
from scipy.signal import hilbert

from scene2hap import audio

pytestmark = pytest.mark.filterwarnings("ignore::scene2hap.audio.sensation.LevelWarning")

RATE = 48_000
BEGIN_S, GAP_S, LASTS_S = 0.3, 0.45, 1.3
STEP_S = 1e-4
KINDS = ("adaptive", "auto", "envelope", "frequency_shift", "lowpass", "svf_bandpass")
FIXED = ("envelope", "frequency_shift", "lowpass", "svf_bandpass")
"""Converters that do the same whenever a sound begins; the others look for its frequency."""
Signal = NDArray[np.float64]


def strokes(rate: int) -> Signal:
    """Two strokes of 310 Hz, which rise within 5 ms and decay within 60 ms."""
    t = np.arange(round(LASTS_S * rate)) / rate
    x = np.zeros_like(t)
    for k in range(2):
        since = np.maximum(t - BEGIN_S - k * GAP_S, 0.0)
        rise = 0.5 - 0.5 * np.cos(np.pi * np.minimum(since / 0.005, 1.0))
        x += 0.5 * rise * np.exp(-since / 0.06) * np.sin(2 * np.pi * 310 * since)
    return x


def converted(folder: Path, x: Signal, kind: str, rate: int = RATE, **settings: bool) -> Signal:
    source, output = folder / "sound.wav", folder / "felt.wav"
    soundfile.write(source, x, rate, subtype="FLOAT")
    audio.convert(source, output, converter=kind, overwrite=True, **settings)
    return soundfile.read(output)[0]


@pytest.fixture(scope="module")
def reference(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Signal]:
    """The vibration of the strokes at 48 kHz, by converter and settings, each converted once."""
    folder = tmp_path_factory.mktemp("reference")
    return cache(lambda kind, **settings: converted(folder, strokes(RATE), kind, **settings))


def envelope(felt: Signal, rate: int) -> Signal:
    """The amplitude (n,), smoothed over 10 ms, in steps of 0.1 ms."""
    power = gaussian_filter1d(np.abs(hilbert(felt)) ** 2, 0.01 * rate)
    at_s = np.arange(0.1, LASTS_S - 0.1, STEP_S)
    return np.sqrt(np.interp(at_s, np.arange(len(felt)) / rate, power))


@pytest.mark.parametrize("kind", KINDS)
def test_the_same_sound_at_other_rates_is_felt_alike(
    tmp_path: Path, reference: Callable[..., Signal], kind: str
) -> None:
    expected = envelope(reference(kind), RATE)
    for rate in (44_100, 96_000):
        found = envelope(converted(tmp_path, strokes(rate), kind, rate), rate)
        lags = np.arange(-50, 51)
        likeness = [float(np.dot(expected[100:-100], np.roll(found, -lag)[100:-100])) for lag in lags.tolist()]
        assert abs(lags[int(np.argmax(likeness))]) * STEP_S <= 1e-3
        assert 10 * np.log10((found**2).mean() / (expected**2).mean()) == pytest.approx(0.0, abs=0.5)


@pytest.mark.parametrize("kind", KINDS)
def test_half_the_sound_gives_half_the_raw_vibration_and_the_same_level(
    tmp_path: Path, reference: Callable[..., Signal], kind: str
) -> None:
    x = 0.5 * strokes(RATE)
    whole, half = (envelope(felt, RATE) for felt in (reference(kind, raw=True), converted(tmp_path, x, kind, raw=True)))
    assert 10 * np.log10((half**2).mean() / (whole**2).mean()) == pytest.approx(-6.02, abs=0.5)
    whole, half = (envelope(felt, RATE) for felt in (reference(kind), converted(tmp_path, x, kind)))
    np.testing.assert_allclose(half, whole, atol=0.01 * whole.max())


@pytest.mark.parametrize("kind", FIXED)
def test_a_delayed_or_inverted_sound_gives_the_delayed_or_inverted_vibration(
    tmp_path: Path, reference: Callable[..., Signal], kind: str
) -> None:
    n, x = 1234, strokes(RATE)
    felt = reference(kind, raw=True)
    inverted = converted(tmp_path, -x, kind, raw=True)
    np.testing.assert_allclose(inverted, felt if kind == "envelope" else -felt, atol=1e-6)
    late = converted(tmp_path, np.concatenate([np.zeros(n), x]), kind, raw=True)
    assert np.abs(felt).max() > 0.01
    if kind in ("lowpass", "svf_bandpass"):
        np.testing.assert_allclose(late[n:], felt, atol=1e-6)
    # A carrier has the phase of the clock, so only the amplitude is delayed.
    np.testing.assert_allclose(envelope(late[n:], RATE), envelope(felt, RATE), atol=0.01 * np.abs(felt).max())


@pytest.mark.parametrize("kind", KINDS)
def test_equal_channels_are_felt_as_one(tmp_path: Path, reference: Callable[..., Signal], kind: str) -> None:
    x, alone = strokes(RATE), reference(kind)
    np.testing.assert_array_equal(converted(tmp_path, np.stack([x, x], axis=1), kind), np.stack([alone, alone], axis=1))
    np.testing.assert_array_equal(converted(tmp_path, np.stack([x, x], axis=1), kind, mono=True), alone)
