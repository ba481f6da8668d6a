from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from scene2hap.audio.actuators import ACTUATORS
from scene2hap.audio.levels import (
    at_level,
    drive_db,
    felt_level_db,
    most_felt_hz,
    sensation_level_db,
    threshold_db,
)
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile

RATE = 8000
FLAT = ActuatorProfile()


def tone(frequency_hz: float, a: float = 0.1) -> np.ndarray:
    return (a * np.sin(2 * np.pi * frequency_hz * np.arange(RATE) / RATE)).astype(np.float32)


@pytest.mark.parametrize(
    ("frequency_hz", "expected_db"),
    [(10, -0.3), (20, -5.1), (40, -13.5), (80, -26.4), (160, -40.7), (250, -45.0), (320, -43.0), (500, -25.9)],
)
def test_the_threshold_has_the_published_values(frequency_hz: float, expected_db: float) -> None:
    assert float(threshold_db(frequency_hz)) == pytest.approx(expected_db, abs=0.06)


def test_the_most_felt_frequency_is_the_one_farthest_over_the_threshold() -> None:
    """Touch is 16 dB more sensitive at 84 Hz than at 35 Hz; an actuator that is weak at 84 Hz reverses the order."""
    hum = tone(35.0) + tone(84.0, 0.06)
    assert most_felt_hz(hum, RATE) == pytest.approx(84.0, abs=0.01)
    weak = ActuatorProfile(response_db=((35.0, 0.0), (84.0, -20.0)))
    assert most_felt_hz(hum, RATE, weak) == pytest.approx(35.0, abs=0.01)


@given(st.floats(0.1, 20_000))
def test_threshold_is_at_most_full_scale_and_lowest_at_250_hz(frequency_hz: float) -> None:
    assert -45.0 <= float(threshold_db(frequency_hz)) <= 0.0


@pytest.mark.parametrize("frequency_hz", [40, 100, 250, 500])
def test_felt_level_of_a_sine_is_its_level_above_the_threshold(frequency_hz: int) -> None:
    expected = 20 * math.log10(0.1) - float(threshold_db(frequency_hz))
    assert felt_level_db(tone(frequency_hz), RATE) == pytest.approx(expected, abs=1e-3)


def test_equally_felt_components_add_their_energy() -> None:
    a, b = (tone(f, 10 ** (float(threshold_db(f)) / 20 + 0.5)) for f in (100, 300))
    assert felt_level_db(a, RATE) == pytest.approx(10.0, abs=1e-3)
    assert felt_level_db(a + b, RATE) == pytest.approx(10.0 + 10 * math.log10(2), abs=1e-3)


def test_frequencies_outside_the_range_of_touch_are_not_felt() -> None:
    assert felt_level_db(tone(5) + tone(1500), RATE) < -40
    assert felt_level_db(np.ones(RATE), RATE) < -120
    assert felt_level_db(np.zeros(RATE), RATE) == -math.inf


def test_intensity_maps_to_a_sensation_level() -> None:
    levels = [sensation_level_db(i) for i in (0.05, 0.1, 0.5, 1.0)]
    assert levels == sorted(levels)
    assert levels[1] > 12.0  # the faintest example of the scale is still felt 12 dB lower
    assert levels[3] - levels[2] >= 5.0  # two JNDs between a phone and a washing machine
    for wrong in (0.0, 1.1, math.nan):
        with pytest.raises(AudioError, match="intensity"):
            sensation_level_db(wrong)


@pytest.mark.parametrize("name", list(ACTUATORS))
def test_at_level_sets_the_felt_level_on_the_actuator(name: str) -> None:
    actuator = ACTUATORS[name]
    y = at_level(tone(180), RATE, 20.0, actuator, 0.5)
    assert felt_level_db(y, RATE, actuator) == pytest.approx(20.0, abs=1e-3)
    assert 20 * math.log10(np.abs(y).max()) == pytest.approx(float(drive_db(180, 20.0, actuator)), abs=0.1)


def test_head_room_limits_the_level() -> None:
    y = at_level(tone(30), RATE, 30.0, FLAT, 0.5)
    assert np.abs(y).max() == pytest.approx(0.5)
    assert felt_level_db(y, RATE) < 30.0
    with pytest.raises(AudioError, match="silent"):
        at_level(np.zeros(RATE, np.float32), RATE, 20.0, FLAT, 0.5)
