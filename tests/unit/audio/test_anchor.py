"""The frequency that stands for a source: strong in its own spectrum, and within reach of touch."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.anchor import anchor_of
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.levels import sensation_level_db

RATE = 8000


def tones(**amplitudes: float) -> np.ndarray:
    t = np.arange(5 * RATE) / RATE
    return np.sum([a * np.sin(2 * np.pi * float(name[1:]) * t) for name, a in amplitudes.items()], axis=0)


def test_the_strongest_that_is_felt_stands_for_a_source() -> None:
    """40 Hz is the strongest, and needs more than full scale to be felt at that level."""
    level_db = sensation_level_db(0.5)
    found = anchor_of(tones(f40=0.5, f150=0.3, f260=0.2), RATE, level_db, actuator_profile("flat"))
    assert found is not None
    assert found.frequency_hz == pytest.approx(150.0, abs=0.1)


def test_what_is_far_below_the_strongest_is_not_what_a_source_is_known_by() -> None:
    """A hum of 50 Hz stays one, though less is felt of it, where all else is 14 dB and more below."""
    level_db = sensation_level_db(0.5)
    for faint_db, expected_hz in ((-12.0, 250.0), (-16.0, 50.0)):
        x = tones(f50=0.5, f250=0.5 * 10 ** (faint_db / 20))
        found = anchor_of(x, RATE, level_db, actuator_profile("flat"))
        assert found is not None
        assert found.frequency_hz == pytest.approx(expected_hz, abs=0.1)


@pytest.mark.parametrize("actuator", ["flat", "voice_coil"])
@pytest.mark.parametrize(
    "name", ["fridge_hum_kitchen.wav", "oven_hum.wav", "washing_machine_rinse.wav", "computer_fan_hum.wav"]
)
def test_steady_recordings_keep_what_they_are_known_by(
    sound: Callable[[str], AudioClip], name: str, actuator: str
) -> None:
    """Within 14 dB of the strongest that the actuator renders, by a plain spectrum of the whole; it was up to 21."""
    clip, profile = sound(name), actuator_profile(actuator)
    x = clip.samples.astype(float)
    magnitude = np.abs(np.fft.rfft((x - x.mean()) * np.hanning(len(x))))
    f = np.fft.rfftfreq(len(x), 1 / clip.sample_rate_hz)
    rendered = (f >= max(20.0, profile.min_frequency_hz)) & (f <= profile.max_frequency_hz)
    for intensity in (0.1, 0.3, 0.6, 1.0):
        found = anchor_of(x, clip.sample_rate_hz, sensation_level_db(intensity), profile)
        assert found is not None
        near = np.abs(f - found.frequency_hz) < 1.0
        assert 20 * np.log10(magnitude[near].max() / magnitude[rendered].max()) > -15.0


@pytest.mark.parametrize(
    ("amplitudes", "felt_hz", "rough_hz"),
    [
        ({"f40": 0.5, "f150": 0.3}, 150.0, 40.0),  # an engine, of which the firing cannot be felt as a tone
        ({"f40": 0.3, "f150": 0.4}, 150.0, None),  # the strongest is felt as itself
        ({"f200": 0.5, "f320": 0.3}, 200.0, None),
        ({"f12": 0.5, "f150": 0.3}, 150.0, None),  # too slow for roughness
    ],
)
def test_what_cannot_be_felt_as_a_tone_is_kept_as_roughness(
    amplitudes: dict[str, float], felt_hz: float, rough_hz: float | None
) -> None:
    found = anchor_of(tones(**amplitudes), RATE, sensation_level_db(0.5), actuator_profile("flat"))
    assert found is not None
    assert found.frequency_hz == pytest.approx(felt_hz, abs=0.1)
    assert found.rough_hz == (None if rough_hz is None else pytest.approx(rough_hz, abs=0.1))
