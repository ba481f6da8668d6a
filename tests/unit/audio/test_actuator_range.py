from __future__ import annotations

import math

import numpy as np
from hypothesis import given, strategies as st

from scene2hap.audio.actuator_range import nearest_felt_hz
from scene2hap.audio.actuators import ACTUATORS
from scene2hap.audio.levels import drive_db
from scene2hap.haptics import ActuatorProfile


@given(st.floats(3.0, 2000.0), st.floats(-60.0, 40.0), st.sampled_from([*ACTUATORS.values()]), st.floats(0.0, 6.0))
def test_nearest_felt_frequency_is_the_nearest_that_reaches_the_level(
    frequency_hz: float, level_db: float, actuator: ActuatorProfile, accepted_db: float
) -> None:
    given_hz, levels_db = np.array([frequency_hz]), np.array([level_db])
    (found,) = nearest_felt_hz(given_hz, levels_db, actuator, -6.0, accepted_db).tolist()
    band_hz = np.geomspace(actuator.min_frequency_hz, actuator.max_frequency_hz, 4000)
    drives_db = drive_db(band_hz, level_db, actuator)
    most_db = max(-6.0, float(drives_db.min())) + accepted_db
    assert actuator.min_frequency_hz <= found <= actuator.max_frequency_hz
    assert float(drive_db(found, level_db, actuator)) <= most_db + 0.2
    reached_hz = band_hz[drives_db <= most_db]
    if len(reached_hz):
        nearest = np.abs(np.log2(reached_hz / frequency_hz)).min()
        assert abs(math.log2(found / frequency_hz)) <= nearest + 2 / 24


def test_a_frequency_that_an_actuator_plays_is_kept_exactly() -> None:
    given_hz = np.array([30.0, 77.7, 250.0])
    assert nearest_felt_hz(given_hz, np.array([3.0, 10.0, 39.0]), ActuatorProfile(), -6.0, 3.0) is given_hz
