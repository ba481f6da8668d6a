from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap.audio.actuators import (
    ACTUATORS,
    actuator_profile,
    equalize_loop,
    inverse_db,
    read_response_csv,
    response_db,
)
from scene2hap.errors import ConfigError
from scene2hap.haptics import ActuatorProfile


def test_a_flat_actuator_changes_nothing() -> None:
    x = np.random.default_rng(0).uniform(-1, 1, 999).astype(np.float32)
    assert not response_db(ACTUATORS["flat"], [10, 250, 1000]).any()
    assert equalize_loop(x, 8000, ACTUATORS["flat"]) is x


@pytest.mark.parametrize("name", ["drake_hf", "lra", "voice_coil"])
def test_a_resonator_is_3_db_down_at_both_ends_of_its_bandwidth(name: str) -> None:
    profile = ACTUATORS[name]
    f0, width = profile.resonance_hz, profile.resonance_hz / profile.q
    middle = np.sqrt(f0**2 + width**2 / 4)
    levels = response_db(profile, [f0, middle - width / 2, middle + width / 2])
    assert levels == pytest.approx([0.0, -3.0103, -3.0103], abs=1e-3)


def test_the_inverse_makes_the_response_flat_up_to_its_limit() -> None:
    profile = ACTUATORS["drake_hf"]
    f = np.geomspace(40, 800, 200)
    together = response_db(profile, f) + inverse_db(profile, f)
    well = response_db(profile, f) >= -12.0
    assert well.any()
    assert not well.all()
    np.testing.assert_allclose(together[well], 0.0, atol=1e-12)
    np.testing.assert_allclose(together[~well], response_db(profile, f[~well]) + 12.0)
    assert inverse_db(profile, [39.0, 801.0]).tolist() == [0.0, 0.0]


def test_equalized_loop_has_its_original_spectrum_on_the_actuator() -> None:
    profile = ActuatorProfile("resonant", 20.0, 1000.0, 160.0, 2.0)
    t = np.arange(8000) / 8000
    x = (0.1 * np.sin(2 * np.pi * 100 * t) + 0.1 * np.sin(2 * np.pi * 240 * t)).astype(np.float32)
    spectrum = np.abs(np.fft.rfft(equalize_loop(x, 8000, profile))) / 4000
    for f in (100, 240):
        gain = 1 / np.sqrt(1 + 4 * (f / 160 - 160 / f) ** 2)
        assert spectrum[f] * gain == pytest.approx(0.1, rel=1e-5)


def test_a_csv_file_is_read_with_or_without_a_heading(tmp_path: Path) -> None:
    path = tmp_path / "mine.csv"
    path.write_text("frequency,level\n# measured by hand\n50,-6\n200,3\n800,-9\n")
    profile = actuator_profile(str(path))
    assert (profile.name, profile.min_frequency_hz, profile.max_frequency_hz) == ("mine", 50.0, 800.0)
    assert response_db(profile, [50, 100, 200, 800, 5000]) == pytest.approx([-9, -4.5, 0, -12, -12])
    path.write_text("50,-6\n200,3\n")
    assert read_response_csv(path).response_db == ((50.0, -6.0), (200.0, 3.0))


@pytest.mark.parametrize("tab", [";", "\t"])
@pytest.mark.parametrize("heading", ["", "# Messung, 20 °C\n", "Hz{tab}dB\n"])
def test_a_csv_file_of_a_country_that_writes_decimals_after_a_comma(tmp_path: Path, heading: str, tab: str) -> None:
    """As Excel saves it in Germany, with a byte-order mark and CRLF."""
    path = tmp_path / "mine.csv"
    text = f"{heading}50,5{{tab}}-6,25\n200{{tab}}3\n".format(tab=tab)
    path.write_text(text, encoding="utf-8-sig", newline="\r\n")
    assert read_response_csv(path).response_db == ((50.5, -6.25), (200.0, 3.0))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("50,-6\n", "fewer than two rows"),
        ("50,-6\n200,loud\n", "must be a frequency"),
        ("200,0\n100,0\n", r"wrong\.csv: response_db has 100 Hz after 200 Hz"),
        ("100,0\n50,-6\n200,-6\n", r"wrong\.csv: response_db has 50 Hz after 100 Hz"),
        ("0,0\n100,-6\n", r"wrong\.csv: response_db\[0\]\[0\] is 0 Hz"),
        ("kHz,dB\n0.04,-12\n0.8,0\n", r"wrong\.csv: max_frequency_hz is 0\.8 Hz.* in Hz, not in kHz"),
        ("Hz dB\n50 -6\n200 0\n", r"a row '50 -6'; .* separated by a comma, or by a semicolon or a tab"),
        ("50,0\n200\n", "must be a frequency"),
        ("50,0\n100,nan\n", "finite"),
    ],
)
def test_a_wrong_csv_file_is_refused(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / "wrong.csv"
    path.write_text(text)
    with pytest.raises(ConfigError, match=said):
        read_response_csv(path)


def test_profile_is_built_from_name_fields_or_object() -> None:
    assert actuator_profile("lra") is ACTUATORS["lra"]
    assert actuator_profile(ACTUATORS["lra"]) is ACTUATORS["lra"]
    assert actuator_profile({"kind": "lra", "q": 20.0}).q == 20.0
    assert actuator_profile({"name": "own", "resonance_hz": 100.0, "q": 2.0}).resonance_hz == 100.0
    for wrong in ("speaker", "absent.csv", 3, {"colour": "red"}):
        with pytest.raises(ConfigError):
            actuator_profile(wrong)
    with pytest.raises(ConfigError, match="rising"):
        ActuatorProfile("odd", response_db=((100.0, 0.0), (100.0, 1.0)))


@pytest.mark.parametrize(
    "limits", [{"max_frequency_hz": 15.0}, {"rms_window_s": 0.01}, {"max_rms": 0.001}, {"name": 3}], ids=str
)
def test_limits_that_cannot_be_played_are_refused_by_the_profile(limits: dict[str, Any]) -> None:
    """The safety layer refuses them too, but only when a session starts, after the bake."""
    with pytest.raises(ConfigError, match=next(iter(limits))):
        actuator_profile(limits)
