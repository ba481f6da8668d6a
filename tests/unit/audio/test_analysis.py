from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.signal import butter, resample_poly, sosfiltfilt

from others import RECORDINGS, there
from own_sounds import PITCHES_HZ
from scene2hap.audio import analysis
from scene2hap.audio.clip import AudioClip
from scene2hap.errors import AudioError

RATE = 48_000
T = np.arange(5 * RATE) / RATE
WHITE = np.random.default_rng(1).standard_normal(len(T))


def tone(frequency_hz: float) -> np.ndarray:
    return np.sin(2 * np.pi * frequency_hz * T)


# silent ends ---------------------------------------------------------------------------------------------------------


def test_silent_ends_are_found_to_within_a_frame() -> None:
    x = np.concatenate([np.zeros(RATE // 2), tone(100), 1e-4 * WHITE[: RATE // 4]])
    first, end = analysis.sounding_span(x, RATE)
    assert 0 <= RATE // 2 - first <= 0.010 * RATE
    assert 0 <= end - RATE // 2 - len(T) <= 0.010 * RATE


def test_inner_silence_and_sound_39_db_below_the_peak_are_no_silent_ends() -> None:
    x = np.concatenate([10 ** (-39 / 20) * tone(100), tone(100), np.zeros(RATE), tone(100)])
    assert analysis.sounding_span(x, RATE) == (0, len(x))


def test_an_offset_is_not_a_sound() -> None:
    x = 0.2 + np.concatenate([np.zeros(RATE), 0.1 * tone(100), np.zeros(RATE)])
    first, end = analysis.sounding_span(x, RATE)
    assert 0 <= end - first - len(T) <= 2 * 0.010 * RATE
    assert analysis.sounding_span(np.full(RATE, 0.2), RATE) == (0, 0)


@pytest.mark.parametrize("x", [np.zeros(RATE), 0.5 / 32768 * np.sign(WHITE)])
def test_digital_silence_and_dither_are_silent(x: np.ndarray) -> None:
    assert analysis.sounding_span(x, RATE) == (0, 0)


# dynamic range -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "x", "expected_db", "tolerance_db"),
    [
        ("sine", tone(100), 0.0, 0.05),
        ("white noise", WHITE, 0.3, 0.15),
        # A steady fall by 20 dB: 85 % of the fall lies between the percentiles.
        ("20 dB decay", tone(200) * 10 ** (-T / 5), 17.0, 0.3),
        # Level 20 log10(1 + m cos): an arcsine law in the envelope; P95 at cos(0.05 pi), P10 at cos(0.9 pi), m = 1/3.
        (
            "amplitude modulation",
            tone(200) * (1 + np.cos(2 * np.pi * T) / 3),
            20 * math.log10((3 + math.cos(0.05 * math.pi)) / (3 + math.cos(0.9 * math.pi))),
            0.1,
        ),
        ("a slow sine, whose cycle is longer than half a frame", tone(22), 0.0, 0.6),
    ],
)
def test_dynamic_range_of_known_sounds(name: str, x: np.ndarray, expected_db: float, tolerance_db: float) -> None:
    assert analysis.dynamic_range_db(x, RATE) == pytest.approx(expected_db, abs=tolerance_db), name


def test_clicks_with_digital_silence_between_them_are_not_steady() -> None:
    clicks = np.zeros(len(T))
    clicks[:: RATE // 2] = 1.0
    clicks[RATE // 4 :: RATE // 2] = -1.0
    assert analysis.dynamic_range_db(clicks, RATE) == pytest.approx(60.0)


def test_dynamic_range_does_not_depend_on_level_or_offset() -> None:
    x = tone(200) * (1 + 0.5 * np.cos(2 * np.pi * T))
    assert analysis.dynamic_range_db(1e-3 * x + 0.3, RATE) == pytest.approx(analysis.dynamic_range_db(x, RATE))


# flatness ------------------------------------------------------------------------------------------------------------


def test_flatness_of_white_noise_is_exp_minus_gamma_at_any_rate_or_codec() -> None:
    # A periodogram's power is exponentially distributed: geometric over arithmetic mean is exp(-Euler's gamma).
    expected = math.exp(-np.euler_gamma)
    lowpassed = sosfiltfilt(butter(8, 7500, fs=RATE, output="sos"), WHITE)
    at_16k = resample_poly(WHITE, 1, 3)
    at_44k = resample_poly(WHITE, 147, 160)
    for x, rate in ((WHITE, RATE), (lowpassed, RATE), (at_16k, 16_000), (at_44k, 44_100)):
        assert analysis.spectral_flatness(x, rate) == pytest.approx(expected, abs=0.02)


def test_flatness_does_not_depend_on_level_offset_or_silence() -> None:
    x = tone(100) + 0.01 * WHITE
    plain = analysis.spectral_flatness(x, RATE)
    assert plain < 0.01
    assert analysis.spectral_flatness(1e-4 * x, RATE) == pytest.approx(plain)
    assert analysis.spectral_flatness(x + 0.5, RATE) == pytest.approx(plain, rel=1e-3)
    with_gap = np.concatenate([x, np.zeros(5 * RATE)])
    assert analysis.spectral_flatness(with_gap, RATE) < 2 * plain


def test_band_above_half_the_sample_rate_is_refused() -> None:
    with pytest.raises(AudioError, match="20 to 7000 Hz; a sound of .* at 8000 Hz has no such band"):
        analysis.spectral_flatness(WHITE, 8000)
    assert analysis.spectral_flatness(WHITE, 8000, band_hz=(20, 3600)) == pytest.approx(0.56, abs=0.02)


# dominant frequency --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("frequency_hz", [20.5, 59.3, 100.0, 187.13, 499.9, 987.6])
@pytest.mark.parametrize(("duration_s", "tolerance_hz"), [(0.25, 0.1), (2.5, 0.01)])
def test_dominant_frequency_finds_a_tone_in_noise(frequency_hz: float, duration_s: float, tolerance_hz: float) -> None:
    n = round(duration_s * RATE)
    x = tone(frequency_hz)[:n] + 0.05 * WHITE[:n] + 3.0
    # A quarter of a second holds five cycles of 20 Hz, where the mirror image at -20 Hz shifts the peak.
    slack = 4 if frequency_hz * duration_s < 8 else 1
    assert analysis.dominant_frequency_hz(x, RATE) == pytest.approx(frequency_hz, abs=slack * tolerance_hz)


def test_the_flank_of_a_rumble_below_the_range_is_no_peak() -> None:
    x = 10 * tone(7.3) + 0.1 * tone(160)
    assert analysis.dominant_frequency_hz(x, RATE) == pytest.approx(160, abs=0.01)
    assert analysis.dominant_frequency_hz(x, RATE, range_hz=(5, 1000)) == pytest.approx(7.3, abs=0.01)


def test_a_wider_range_finds_the_peak_of_the_raw_sound() -> None:
    x = tone(3210.7) + 0.5 * tone(120)
    assert analysis.dominant_frequency_hz(x, RATE) == pytest.approx(120, abs=0.01)
    assert analysis.dominant_frequency_hz(x, RATE, range_hz=(20, 20_000)) == pytest.approx(3210.7, abs=0.01)


RECORDED = {
    # From SOURCE.md beside the recordings; an octave error would halve or double the value.
    "fridge_hum_kitchen.wav": (59.0, 1.0),
    "oven_hum.wav": (100.0, 0.5),
    # A motor on European mains; for the fan, the strongest third octave of Butterworth filters (stress/audio.py).
    "washing_machine_rinse.wav": (100.0, 0.5),
    "computer_fan_hum.wav": (39.8, 5.0),
}


@pytest.mark.parametrize(
    ("name", "expected_hz", "tolerance_hz"),
    [
        *((name, pitch_hz, 0.05) for name, pitch_hz in PITCHES_HZ.items()),
        *((name, *RECORDED[name]) for name in there(RECORDED, RECORDINGS.joinpath)),
    ],
)
def test_hums_of_machines_are_heard_in_the_right_octave(
    sound: Callable[[str], AudioClip], name: str, expected_hz: float, tolerance_hz: float
) -> None:
    clip = sound(name)
    found = analysis.dominant_frequency_hz(clip.samples, clip.sample_rate_hz)
    assert found == pytest.approx(expected_hz, abs=tolerance_hz)


# bounds --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "measure", [analysis.dynamic_range_db, analysis.spectral_flatness, analysis.dominant_frequency_hz]
)
def test_silence_has_neither_level_nor_spectrum(measure: Callable[[np.ndarray, float], float]) -> None:
    with pytest.raises(AudioError, match="all 100 samples are equal"):
        measure(np.full(100, 0.25), RATE)
    with pytest.raises(AudioError, match=r"shape \(0,\)"):
        measure(np.zeros(0), RATE)
    with pytest.raises(AudioError, match=r"shape \(2, 5\)"):
        measure(np.zeros((2, 5)), RATE)
    with pytest.raises(AudioError, match="sample_rate_hz is 0 Hz"):
        measure(WHITE, 0)


def test_frequency_ranges_without_resolved_bins_are_refused() -> None:
    with pytest.raises(AudioError, match="range_hz"):
        analysis.dominant_frequency_hz(WHITE, 1000, range_hz=(600, 900))
    with pytest.raises(AudioError, match="does not resolve"):
        analysis.dominant_frequency_hz(WHITE[:100], RATE, range_hz=(20, 30))
