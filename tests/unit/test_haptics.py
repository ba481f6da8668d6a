"""Plain data classes shared by baking and playing: bands, states and actuators."""

import numpy as np
import pytest

from scene2hap import ActuatorProfile, Bands, ObjectHaptics, SourceState, materials
from scene2hap.errors import ConfigError


def test_third_octaves_from_10_to_1000_hz_are_20_bands() -> None:
    bands = Bands.third_octaves(10, 1000)
    assert bands.n_bands == 20
    assert bands.edges_hz[0] == 10.0
    assert bands.edges_hz[10] == pytest.approx(100.0)
    assert bands.edges_hz[-1] == pytest.approx(1000.0)
    # Three bands are nearly an octave: 10^(3/10) = 1.995.
    np.testing.assert_allclose(bands.widths_hz()[3:, 0] / bands.widths_hz()[:-3, 0], 10**0.3)


def test_dominant_is_one_band() -> None:
    assert Bands.dominant().n_bands == 1
    assert Bands.dominant().widths_hz().shape == (0, 2)


@pytest.mark.parametrize("edges", [(), (10.0,), (20.0, 10.0), (10.0, 10.0), (-1.0, 10.0), (float("nan"), 1.0)])
def test_edges_must_rise(edges: tuple[float, ...]) -> None:
    with pytest.raises(ConfigError, match="edges_hz"):
        Bands(edges)


@pytest.mark.parametrize("intensity", [0.0, 1.1, float("nan")])
def test_intensity_is_above_0_and_at_most_1(intensity: float) -> None:
    with pytest.raises(ConfigError, match="intensity"):
        SourceState("on", intensity, "fan whirs", "fan whirring")


def test_a_vibrating_object_has_a_state() -> None:
    with pytest.raises(ConfigError, match="vibrates but has no state"):
        ObjectHaptics("fan", "plastic", materials.lookup("plastic"), (0.1, 0.1, 0.02), "cools", True)


def test_actuator_band() -> None:
    with pytest.raises(ConfigError, match="max_frequency_hz is 5 Hz"):
        ActuatorProfile("odd", 10.0, 5.0)
