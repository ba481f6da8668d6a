"""Moving pitch: the converter's band is wide enough to keep the level of a pitch that changes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.conversion import convert, convert_clip
from scene2hap.audio.felt_component import felt_component_of
from scene2hap.audio.felt_component.moving_pitch import growth_db, moving_pitch
from scene2hap.audio.levels import sensation_level_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.scene_loops import SourceClip, felt_loop, plan_scene
from scene2hap.audio.tactile.adaptive import Adaptive
from scene2hap.audio.tactile.auto import Auto
from scene2hap.common.arrays import Floats

pytestmark = pytest.mark.filterwarnings("ignore::scene2hap.audio.conversion.LevelWarning")

RATE = 16_000
T = np.arange(16 * RATE) / RATE


def engine(low_hz: float, high_hz: float, n_orders: int = 12, seed: int = 3) -> Floats:
    """Orders of a speed that rises and falls in 8 s, each of constant amplitude, and a little noise."""
    middle, reach = 0.5 * (low_hz + high_hz), 0.5 * (high_hz - low_hz)
    phase = 2 * np.pi * np.cumsum(middle - reach * np.cos(2 * np.pi * T / 8)) / RATE
    x = sum((np.sin(k * phase + k * k) / k for k in range(1, n_orders + 1)), np.zeros(len(T)))
    sound: Floats = 0.6 * x / np.abs(x).max() + 0.002 * np.random.default_rng(seed).standard_normal(len(T))
    return sound


def range_db(x: Floats, rate: int = RATE) -> float:
    """Range from the 5th to the 95th percentile of the level in 0.1 s [dB]."""
    n = rate // 10
    level = 10 * np.log10((x[: len(x) // n * n].reshape(-1, n) ** 2).mean(axis=1) + 1e-12)
    return float(np.subtract(*np.percentile(level, (95, 5))))


@pytest.mark.parametrize("n_orders", [1, 4, 12])
def test_an_engine_that_revs_keeps_its_range_in_a_file(n_orders: int, tmp_path: Path) -> None:
    sound = engine(40.0, 160.0, n_orders)
    soundfile.write(tmp_path / "engine.wav", sound, RATE, subtype="PCM_24")
    convert(tmp_path / "engine.wav", tmp_path / "felt.wav")
    felt, _ = soundfile.read(tmp_path / "felt.wav")
    assert range_db(felt) <= range_db(sound) + 3.0


@pytest.mark.parametrize("neighbour_hz", [None, 85.0])
def test_an_engine_that_revs_keeps_its_range_in_a_scene(neighbour_hz: float | None) -> None:
    """Also for an engine that is moved away from a neighbour."""
    sound = engine(50.0, 150.0)
    sources = [SourceClip(AudioClip(sound.astype(np.float32), RATE), 0.5, "engine")]
    if neighbour_hz is not None:
        hum = (0.5 * np.sin(2 * np.pi * neighbour_hz * T)).astype(np.float32)
        sources.append(SourceClip(AudioClip(hum, RATE), 0.5, "hum", keep=True))
    context = plan_scene(sources, Auto(), actuator_profile("flat"))[0].context
    assert context.band_q is not None
    assert context.own_hz is not None
    assert context.target_hz is not None
    assert (abs(context.target_hz - context.own_hz) > 5.0) == (neighbour_hz is not None)
    felt = convert_clip(sources[0].clip, Auto(), context).samples.astype(float)
    assert range_db(felt) <= range_db(sound) + 3.0


def test_the_band_is_3_db_down_at_the_ends_of_the_pitch() -> None:
    """At the 5th and 95th percentile of a known sweep's pitch, the band is 3 dB below its centre."""
    t = np.arange(20 * RATE) / RATE
    hz = 60.0 * 4.0 ** (t / 20.0)
    x = np.sin(2 * np.pi * np.cumsum(hz) / RATE)
    found = moving_pitch(x, RATE, (20.0, 1000.0), 2.0)
    assert found is not None
    low, high = 60.0 * 4.0**0.05, 60.0 * 4.0**0.95
    assert found.centre_hz == pytest.approx(120.0, rel=0.02)
    n = RATE
    impulse = np.zeros(n, dtype=np.float32)
    impulse[0] = 1.0
    context = ConversionContext(own_hz=found.centre_hz, band_q=found.q)
    spectrum = np.abs(np.fft.rfft(Adaptive().stream(RATE, context).process(impulse)))
    assert 20 * np.log10(spectrum[round(120.0)]) == pytest.approx(0.0, abs=0.1)
    for edge in (low, high):
        assert 20 * np.log10(spectrum[round(edge)]) == pytest.approx(-3.0, abs=0.4)


@pytest.mark.parametrize("kind", ["steady", "noise", "impulses", "silence"])
def test_a_sound_without_moving_pitch_keeps_its_band(kind: str) -> None:
    rng = np.random.default_rng(4)
    noise = rng.standard_normal(len(T))
    sound = {
        "steady": engine(80.0, 84.0),
        "noise": 0.2 * noise,
        "impulses": 0.3 * np.exp(-(T % 0.1) / 1e-3) * noise.clip(-2, 2),
        "silence": np.zeros(len(T)),
    }[kind]
    found = felt_component_of(sound, RATE, sensation_level_db(1.0), actuator_profile("flat"))
    assert found is None or found.band_q is None


def test_beating_lines_are_not_a_pitch_that_moves() -> None:
    """A compressor's second order beats with the magnetic hum at 100 Hz: levels vary, but no frequency does."""
    shaft, order, pull = (np.sin(2 * np.pi * hz * T) for hz in (49.8, 99.6, 100.0))
    sound = 0.6 * (shaft + 0.3 * order + 0.2 * pull)
    beats = 0.6 * (0.3 * order + 0.2 * pull)
    assert growth_db(sound, beats, 16.0) > 3.0
    assert moving_pitch(sound, RATE, (20.0, 1000.0), 2.0) is None
    found = felt_component_of(sound, RATE, sensation_level_db(0.1), actuator_profile("flat"))
    assert found is not None
    assert found.felt_hz == pytest.approx(99.6, abs=0.5)


def test_growth_is_the_increase_of_the_level_range() -> None:
    """A band that is half as strong for half of the time has a range 6 dB above the sound's, at any rate."""
    sound = np.sin(2 * np.pi * 100.0 * T)
    band = np.sin(2 * np.pi * 100.0 * T[::4]) * np.where(T[::4] < 8.0, 1.0, 0.5)
    assert growth_db(sound, band, 16.0) == pytest.approx(20 * np.log10(2.0), abs=0.01)
    assert growth_db(sound, sound, 16.0) == 0.0
    assert growth_db(sound[: RATE // 2], band[: RATE // 8], 0.5) == 0.0


@pytest.mark.parametrize("neighbour_hz", [None, 85.0])
def test_a_melody_is_told_at_a_note_that_vibrates_and_sounds(neighbour_hz: float | None) -> None:
    """In an earlier version it was told at the middle of its notes, 88 Hz, where nothing vibrates."""
    notes_hz = (66.0, 117.0)
    hz = np.where(np.floor(T / 0.5) % 2 > 0, *notes_hz)
    sound = (0.5 * np.sin(2 * np.pi * np.cumsum(hz) / RATE)).astype(np.float32)
    sources = [SourceClip(AudioClip(sound, RATE), 0.3, "radio")]
    if neighbour_hz is not None:
        hum = (0.5 * np.sin(2 * np.pi * neighbour_hz * T)).astype(np.float32)
        sources.append(SourceClip(AudioClip(hum, RATE), 0.3, "hum", keep=True))
    plan = plan_scene(sources, Auto(), actuator_profile("flat"))[0]
    assert plan.context.band_q is not None
    loop = felt_loop(sources[0].clip, Auto(), plan)
    assert loop.felt is not None
    assert loop.felt.target_hz == loop.frequency_tactile_hz
    assert loop.felt.is_moved == (neighbour_hz is not None)
    assert min(abs(loop.felt.own_hz - note) for note in notes_hz) < 1.0
    power = np.abs(np.fft.rfft(loop.tactile.samples)) ** 2
    f = np.fft.rfftfreq(len(loop.tactile.samples), 1 / RATE)
    assert power[np.abs(f - loop.felt.target_hz) < 2.0].max() > 0.1 * power.max()


def test_a_moving_pitch_has_no_roughness() -> None:
    """On a narrow actuator, which plays none of its notes, a melody of 66 and 117 Hz was rough at 88 Hz, then at 66."""
    hz = np.where(np.floor(T / 0.5) % 2 > 0, 66.0, 117.0)
    found = felt_component_of(np.sin(2 * np.pi * np.cumsum(hz) / RATE), RATE, 20.0, actuator_profile("lra"))
    assert found is not None
    assert found.band_q is not None
    assert found.rough_hz is None
