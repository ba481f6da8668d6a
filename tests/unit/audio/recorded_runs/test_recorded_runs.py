"""Detection of starts and stops in recordings, with their time, level and pitch, and without false detections."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from others import RECORDINGS, there
from own_sounds import OWN_SOUNDS, own_sound
from scene2hap.audio.files import read_clip
from scene2hap.audio.recorded_runs import RecordedRuns, recorded_runs
from scene2hap.audio.run_curve import RunCurve
from scene2hap.errors import AudioError
from starting_machines import RATE_HZ, WITHOUT_RUNS, errors, machine, without_runs

MACHINES: dict[str, dict[str, Any]] = {
    "motor, 1 s": {"start_s": 1.0},
    "motor, 2 s": {"start_s": 2.0},
    "motor, 2 s, in a loud room": {"start_s": 2.0, "room_db": -20.0},
    "motor, 5 s, evenly": {"start_s": 5.0, "rise": "linear", "steady_s": 8.0},
    "compressor, level alone": {"start_s": 1.5, "spins": False, "frequency_hz": 100.0},
    "compressor, half a cosine": {"start_s": 1.5, "spins": False, "rise": "half a cosine", "hiss_db": -6.0},
    "fan, as much air as tone": {"stop_s": 3.0, "frequency_hz": 150.0, "hiss_db": 0.0, "n_harmonics": 3},
    "mixer, both": {"start_s": 1.5, "stop_s": 4.0},
}


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("name", MACHINES)
def test_start_and_stop_of_a_synthetic_machine_are_found(name: str, seed: int) -> None:
    told = MACHINES[name]
    take = machine(**told, seed=seed)
    found = recorded_runs(take.samples, RATE_HZ)
    for curve, wanted_s, at_s in (
        (found.start_up, told.get("start_s"), found.first / RATE_HZ),
        (found.wind_down, told.get("stop_s"), found.end / RATE_HZ),
    ):
        assert (curve is None) == (wanted_s is None)
        if curve is not None and wanted_s is not None:
            assert curve.lasts_s == pytest.approx(wanted_s, rel=0.15)
            level_db, speed = errors(take, curve, at_s - curve.lasts_s if curve is found.start_up else at_s)
            assert level_db < 3.0
            assert speed < 0.05
            assert curve.keeps_pitch == (told.get("spins") is False)
            # Any step between rest and steady running would be felt.
            rising = curve.amplitude if curve is found.start_up else curve.amplitude[::-1]
            assert (rising[0], rising[-1]) == (0.0, 1.0)
            assert list(rising) == sorted(rising)
    steady = take.amplitude[found.first : found.end]
    assert len(steady) >= 0.9 * told.get("steady_s", 5.0) * RATE_HZ
    assert steady.min() > 0.8


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_start_of_a_fan_in_noise_gives_a_level_curve_and_no_pitch(seed: int) -> None:
    take = machine(start_s=2.0, n_harmonics=1, hiss_db=20.0, seed=seed)
    curve = recorded_runs(take.samples, RATE_HZ).start_up
    assert curve is not None
    assert curve.speed == ()
    assert curve.lasts_s == pytest.approx(2.0, rel=0.2)


def nothing(found: RecordedRuns, n: int) -> bool:
    return found == (None, None, 0, n)


@pytest.mark.parametrize("name", WITHOUT_RUNS)
@pytest.mark.parametrize("seed", range(5))
def test_sounds_without_runs_give_no_false_start(name: str, seed: int) -> None:
    x = without_runs(seed)[name]
    assert nothing(recorded_runs(x, RATE_HZ), len(x))


@pytest.mark.parametrize("name", OWN_SOUNDS)
def test_recordings_of_running_machines_have_no_start_or_stop(name: str) -> None:
    clip = own_sound(name)
    assert nothing(recorded_runs(clip.samples, clip.sample_rate_hz), len(clip.samples))


@pytest.mark.parametrize(
    "path",
    there(sorted(RECORDINGS.glob("*.*g")) + sorted(RECORDINGS.glob("*.wav")), lambda path: path),
    ids=lambda path: path.name,
)
def test_excerpts_have_no_start_or_stop(path: Any) -> None:
    clip = read_clip(path)
    assert nothing(recorded_runs(clip.samples, clip.sample_rate_hz), len(clip.samples))


@pytest.mark.parametrize(
    "x", [[1.0], [0.0] * 50_000, [0.5] * 50_000, [1.0] * 30, [0.0, 1.0]], ids=["one", "silent", "equal", "30", "two"]
)
@pytest.mark.parametrize("rate", [1, 40, 16_000, 192_000])
def test_short_silent_or_constant_samples_have_no_start_or_stop(x: list[float], rate: int) -> None:
    assert nothing(recorded_runs(x, rate), len(x))


@pytest.mark.parametrize("x", [[], [[1.0, 2.0]], 3.0])
def test_recorded_runs_refuses_empty_or_multichannel_samples(x: Any) -> None:
    with pytest.raises(AudioError, match="at least one sample"):
        recorded_runs(x, RATE_HZ)


@settings(max_examples=3)
@given(st.floats(0.5, 4.0), st.sampled_from(["motor", "linear"]), st.floats(1e-3, 1e3), st.integers(0, 99))
def test_reversed_start_is_a_stop_at_any_loudness(start_s: float, rise: str, gain: float, seed: int) -> None:
    x = machine(start_s=round(start_s, 1), rise=rise, steady_s=3.0, seed=seed).samples
    found = recorded_runs(x, RATE_HZ)
    assert found.start_up is not None
    assert found.wind_down is None
    louder, backwards = recorded_runs(gain * x, RATE_HZ), recorded_runs(x[::-1], RATE_HZ)
    for other in (louder.start_up, backwards.wind_down):
        assert other is not None
        turned = (
            other if other is louder.start_up else RunCurve(other.lasts_s, other.amplitude[::-1], other.speed[::-1])
        )
        # In the reversed sound, analysis windows begin at other samples.
        assert turned.lasts_s == pytest.approx(found.start_up.lasts_s, rel=0.05)
        shares = np.linspace(0, 1, 50)
        np.testing.assert_allclose(turned.amplitude_at(shares), found.start_up.amplitude_at(shares), atol=0.03)


@settings(max_examples=6)
@given(st.floats(0.6, 5.0), st.floats(60.0, 300.0), st.floats(-40.0, -20.0), st.integers(0, 999))
def test_start_is_found_for_any_duration_pitch_and_reverberation(
    start_s: float, frequency_hz: float, room_db: float, seed: int
) -> None:
    take = machine(start_s=start_s, frequency_hz=frequency_hz, room_db=room_db, steady_s=4.0, seed=seed)
    curve = recorded_runs(take.samples, RATE_HZ).start_up
    assert curve is not None
    # Room noise hides the beginning of a start. A start below a second has too few periods to show its pitch there.
    assert curve.lasts_s == pytest.approx(start_s, rel=0.25 if start_s >= 1.0 else 0.4)
    assert (np.diff(curve.amplitude) >= 0).all()
    assert (np.diff(curve.speed) >= 0).all()
