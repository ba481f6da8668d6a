"""Starts and stops in recordings: found with their time, level and pitch where they are, and nowhere else."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from others import RECORDINGS, there
from own_sounds import OWN_SOUNDS, own_sound
from scene2hap.audio.files import read_clip
from scene2hap.audio.recorded_runs import RecordedRuns, recorded_runs
from scene2hap.audio.run_curve import RunCurve
from scene2hap.errors import AudioError
from sound_draws import coloured_noise
from starting_machines import RATE_HZ, Signal, Take, machine

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


def errors(take: Take, curve: RunCurve, begin_s: float) -> tuple[float, float]:
    """The largest error of level [dB] and of speed [-] while the machine is within 20 dB of steady running."""
    x = np.linspace(0.0, 1.0, 500)
    at, t = begin_s + x * curve.lasts_s, np.arange(len(take.samples)) / RATE_HZ
    amplitude, speed = np.interp(at, t, take.amplitude), np.interp(at, t, take.speed)
    is_felt = amplitude > 0.1
    level_db = 20 * np.log10(np.maximum(curve.amplitude_at(x), 1e-6)[is_felt] / amplitude[is_felt])
    followed = curve.speed_at(x)
    assert followed is not None
    return float(np.abs(level_db).max()), float(np.abs(followed[is_felt] / speed[is_felt] - 1).max())


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize("name", MACHINES)
def test_a_known_machine_is_found(name: str, seed: int) -> None:
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
    steady = take.amplitude[found.first : found.end]
    assert len(steady) >= 0.9 * told.get("steady_s", 5.0) * RATE_HZ
    assert steady.min() > 0.8


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_of_air_the_level_is_found_and_the_pitch_is_not(seed: int) -> None:
    take = machine(start_s=2.0, n_harmonics=1, hiss_db=20.0, seed=seed)
    curve = recorded_runs(take.samples, RATE_HZ).start_up
    assert curve is not None
    assert curve.speed == ()
    assert curve.lasts_s == pytest.approx(2.0, rel=0.2)


def nothing(found: RecordedRuns, n: int) -> bool:
    return found == (None, None, 0, n)


def decay(t: Signal, begin_s: float, per_s: float) -> Signal:
    return np.where(t < begin_s, 0.0, np.exp(-per_s * np.maximum(t - begin_s, 0.0)))


def negatives(seed: int) -> dict[str, Signal]:
    """Sounds of 8 s without a start or a stop."""
    rng = np.random.default_rng(seed)
    n = 8 * RATE_HZ
    t = np.arange(n) / RATE_HZ
    room = 0.003 * rng.standard_normal(n)
    hum = np.sin(2 * np.pi * 100 * t)
    syllables = np.interp(t, np.arange(0, 8.3, 0.12), np.maximum(0.0, rng.standard_normal(70)))
    glide = 2 * np.pi * np.cumsum(120 * (1 + 0.2 * np.interp(t, np.arange(0, 8.3, 0.3), rng.standard_normal(28))))
    voice = syllables * np.sum([np.sin(k * glide / RATE_HZ) / k for k in range(1, 12)], axis=0)
    rev = np.interp(t, np.arange(0, 8.5, 0.5), rng.uniform(0.4, 1.0, 17))
    notes = np.sum(
        [
            np.sin(2 * np.pi * 110 * 2 ** (rng.integers(0, 24) / 12) * t) * decay(t, 0.2 * i, rng.uniform(2, 8))
            for i in range(40)
        ],
        axis=0,
    )
    ticks = np.sum([decay(t, i * rng.uniform(0.3, 1.0), 200.0) for i in range(8)], axis=0) * np.sin(2 * np.pi * 300 * t)
    fade = np.clip(np.minimum(t, 8 - t) / 0.05, 0.0, 1.0)
    return {
        "white": rng.standard_normal(n),
        "pink": coloured_noise(rng, n, 1.0),
        "brown": coloured_noise(rng, n, 2.0),
        "ticks": ticks + room,
        "rings": ((t * rng.uniform(0.4, 1.5)) % 1 < 0.5) * hum + room,
        "speech": voice + room,
        "speech, then a hum": np.where(t < 3, 0.5 * voice, hum) + room,
        "music": notes + room,
        "one event": hum * decay(t, rng.uniform(0.2, 3.0), rng.uniform(0.5, 8.0)) + room,
        "a bell that fades for long": hum * np.exp(-t / 2) + 0.01 * room,
        "revving": rev**2 * np.sin(2 * np.pi * np.cumsum(80 * rev) / RATE_HZ) + room,
        "a cut file, faded over 50 ms": fade * (hum + 30 * room),
        "turned up by 8 dB": np.interp(t, (0, 1, 2, 8), (0.4, 0.4, 1, 1)) * coloured_noise(rng, n, 1.0),
        "a drop in between": np.interp(t, (0, 1, 1.5, 2, 2.5, 8), (0.02, 1, 1, 0.02, 1, 1)) * hum + room,
    }


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("name", negatives(0))
def test_there_is_no_false_start(name: str, seed: int) -> None:
    x = negatives(seed)[name]
    assert nothing(recorded_runs(x, RATE_HZ), len(x))


@pytest.mark.parametrize("name", OWN_SOUNDS)
def test_machines_that_run_all_along_have_none(name: str) -> None:
    clip = own_sound(name)
    assert nothing(recorded_runs(clip.samples, clip.sample_rate_hz), len(clip.samples))


@pytest.mark.parametrize(
    "path",
    there(sorted(RECORDINGS.glob("*.*g")) + sorted(RECORDINGS.glob("*.wav")), lambda path: path),
    ids=lambda path: path.name,
)
def test_recordings_that_are_cut_from_the_middle_have_none(path: Any) -> None:
    clip = read_clip(path)
    assert nothing(recorded_runs(clip.samples, clip.sample_rate_hz), len(clip.samples))


@pytest.mark.parametrize(
    "x", [[1.0], [0.0] * 50_000, [0.5] * 50_000, [1.0] * 30, [0.0, 1.0]], ids=["one", "silent", "equal", "30", "two"]
)
@pytest.mark.parametrize("rate", [1, 40, 16_000, 192_000])
def test_what_has_nothing_to_find(x: list[float], rate: int) -> None:
    assert nothing(recorded_runs(x, rate), len(x))


@pytest.mark.parametrize("x", [[], [[1.0, 2.0]], 3.0])
def test_what_is_no_channel_is_refused(x: Any) -> None:
    with pytest.raises(AudioError, match="at least one sample"):
        recorded_runs(x, RATE_HZ)


@settings(max_examples=10, deadline=None)
@given(st.floats(0.5, 4.0), st.sampled_from(["motor", "linear"]), st.floats(1e-3, 1e3), st.integers(0, 99))
def test_backwards_a_start_is_a_stop_and_loudness_does_not_matter(
    start_s: float, rise: str, gain: float, seed: int
) -> None:
    x = machine(start_s=round(start_s, 1), rise=rise, seed=seed).samples
    found = recorded_runs(x, RATE_HZ)
    assert found.start_up is not None
    assert found.wind_down is None
    louder, backwards = recorded_runs(gain * x, RATE_HZ), recorded_runs(x[::-1], RATE_HZ)
    for other in (louder.start_up, backwards.wind_down):
        assert other is not None
        turned = (
            other if other is louder.start_up else RunCurve(other.lasts_s, other.amplitude[::-1], other.speed[::-1])
        )
        assert turned.lasts_s == pytest.approx(found.start_up.lasts_s, rel=0.02)
        shares = np.linspace(0, 1, 50)
        np.testing.assert_allclose(turned.amplitude_at(shares), found.start_up.amplitude_at(shares), atol=0.03)


@settings(max_examples=8, deadline=None)
@given(st.floats(0.6, 5.0), st.floats(60.0, 300.0), st.floats(-40.0, -20.0), st.integers(0, 999))
def test_a_start_is_found_whatever_its_time_pitch_and_room(
    start_s: float, frequency_hz: float, room_db: float, seed: int
) -> None:
    take = machine(start_s=start_s, frequency_hz=frequency_hz, room_db=room_db, steady_s=6.0, seed=seed)
    curve = recorded_runs(take.samples, RATE_HZ).start_up
    assert curve is not None
    assert curve.lasts_s == pytest.approx(start_s, rel=0.25)
    assert (np.diff(curve.amplitude) >= 0).all()
    assert (np.diff(curve.speed) >= 0).all()
