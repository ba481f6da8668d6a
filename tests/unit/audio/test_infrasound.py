"""The slow pressure of wind is neither heard nor felt: it sets neither the level nor the choice of a sound."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import sosfreqz

from scene2hap.audio import analysis
from scene2hap.audio.felt_component import felt_component_of
from scene2hap.audio.infrasound import infrasound_filter, without_infrasound
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.haptics import ActuatorProfile

RATE = 8000
T = np.arange(6 * RATE) / RATE
HUM = 0.1 * np.sin(2 * np.pi * 120 * T)
WIND = 0.5 * np.sin(2 * np.pi * 3.1 * T) * (1 + 0.9 * np.sin(2 * np.pi * 0.23 * T))


def rms(x: np.ndarray) -> float:
    return float(np.sqrt((x**2).mean()))


@pytest.mark.parametrize(("hz", "gain_db"), [(3.0, -56.0), (15.0, -6.0), (20.0, -2.4), (30.0, -0.5), (100.0, 0.0)])
def test_both_forms_have_the_stated_gain(hz: float, gain_db: float) -> None:
    tone = np.sin(2 * np.pi * hz * T)
    middle = slice(2 * RATE, 4 * RATE)
    assert 20 * np.log10(rms(without_infrasound(tone, RATE)[middle]) / rms(tone[middle])) == pytest.approx(
        gain_db, abs=0.1
    )
    _, response = sosfreqz(infrasound_filter(RATE), [hz], fs=RATE)
    assert 20 * np.log10(abs(response[0])) == pytest.approx(gain_db, abs=0.1)


@pytest.mark.parametrize("x", [np.zeros(1), np.full(1, 0.5), np.full(100, -0.3), np.zeros(RATE)])
def test_an_offset_alone_is_not_heard(x: np.ndarray) -> None:
    assert np.abs(without_infrasound(x, RATE)).max() < 1e-12


def test_a_sound_that_begins_away_from_zero_does_not_ring() -> None:
    x = 0.4 + HUM
    assert np.abs(without_infrasound(x, RATE)[: RATE // 10]).max() < 1.2 * np.abs(HUM).max()


def test_a_hum_in_wind_is_as_steady_as_the_hum() -> None:
    alone, windy = (analysis.dynamic_range_db(x, RATE) for x in (HUM, HUM + WIND))
    assert windy == pytest.approx(alone, abs=0.5)


def test_strokes_in_wind_are_felt_as_strokes() -> None:
    """The envelope that is felt is that of the strokes, although the wind has 100 times their energy."""
    stroke = np.exp(-((T % 1.5) / 0.2)) * np.random.default_rng(7).normal(0.0, 0.1, len(T))
    x = (0.8 * WIND + stroke).astype(np.float32)
    actuator = ActuatorProfile()
    component = felt_component_of(x, RATE, 22.0, actuator)
    assert component is not None
    context = ConversionContext(
        actuator, 0.3, own_hz=component.frequency_hz, target_hz=component.carrier_hz, band_db=component.band_db
    )
    stream = CONVERTERS.build("auto").stream(RATE, context)
    felt = np.concatenate([stream.process(x), stream.finish()])
    step = RATE // 10
    levels = [np.sqrt((one[RATE:].reshape(-1, step) ** 2).mean(axis=1)) for one in (stroke, felt)]
    assert np.corrcoef(*levels)[0, 1] > 0.9
