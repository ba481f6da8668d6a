"""Sounds on a resonant actuator, judged by its motion: the exact response of a resonator to the loop."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.lib.stride_tricks import sliding_window_view
from scipy.signal import bilinear, hilbert, lfilter

from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.scene_loops import SourceClip, felt_loop, plan_scene
from scene2hap.audio.tactile.auto import Auto
from scene2hap.audio.tactile.motion import modulation_gain, motion, ringing_s
from scene2hap.audio.tactile.stages import SosStage

RATE = 8000
T = np.arange(6 * RATE) / RATE
LRA = actuator_profile("lra")


def response(f: np.ndarray) -> np.ndarray:
    """Complex response of a resonator at 175 Hz with a Q of 12."""
    r = np.maximum(f / 175.0, 1e-3)
    return 1.0 / (1.0 + 12.0j * (r - 1.0 / r))


def moved(samples: np.ndarray) -> np.ndarray:
    """Motion of the actuator for a loop."""
    spectrum = np.fft.rfft(samples.astype(np.float64))
    return np.fft.irfft(spectrum * response(np.fft.rfftfreq(len(samples), 1 / RATE)), len(samples))


def loop_of(sound: np.ndarray, intensity: float = 0.3) -> np.ndarray:
    noise = 0.01 * np.random.default_rng(2).standard_normal(len(sound))
    clip = AudioClip((0.4 * (sound + noise)).astype(np.float32), RATE)
    converter = Auto()
    (plan,) = plan_scene([SourceClip(clip, intensity)], converter, LRA)
    return moved(felt_loop(clip, converter, plan).tactile.samples)


def range_db(x: np.ndarray) -> float:
    """Range of the level in 100 ms, 5th to 95th percentile."""
    level = 10 * np.log10((x[: len(x) // 800 * 800].reshape(-1, 800) ** 2).mean(axis=1))
    return float(np.subtract(*np.percentile(level, (95, 5))))


@pytest.mark.parametrize("hum_hz", [30.0, 49.0, 72.0, 100.0])
def test_a_hum_below_the_band_modulates_the_motion_at_its_rate(hum_hz: float) -> None:
    """Above 50 Hz, the resonance left less than a tenth of the modulation in an earlier version."""
    motion_of_loop = loop_of(np.sin(2 * np.pi * hum_hz * T))
    t = np.arange(len(motion_of_loop)) / RATE
    # Square law detector: a carrier with depth d has d of its squared amplitude at the rate, for small d.
    squared = motion_of_loop**2 * np.hanning(len(t))
    depth = 2 * abs((squared * np.exp(-2j * np.pi * hum_hz * t)).sum()) / squared.sum() / 2
    assert depth > 0.2


def test_a_pitch_that_moves_through_the_band_keeps_its_level() -> None:
    """In an earlier version the range of this sound grew by 18 dB."""
    pitch_hz = 40.0 * 4.0 ** (0.5 - 0.5 * np.cos(2 * np.pi * T / 3.0))
    phase = 2 * np.pi * np.cumsum(pitch_hz) / RATE
    sound = np.sin(phase) + 0.5 * np.sin(2 * phase) + 0.3 * np.sin(3 * phase)
    assert range_db(loop_of(sound)) < range_db(sound) + 6.0


def test_compensated_motion_is_that_of_the_inverse_and_the_response() -> None:
    stage = motion(LRA, RATE, is_compensated=True)
    assert isinstance(stage, SosStage)
    for hz in (140.0, 160.0, 175.0, 200.0, 220.0):
        x = np.sin(2 * np.pi * hz * T)
        felt_db = 10 * np.log10(2 * np.mean(stage.run(x)[RATE:] ** 2))
        # The inverse is exact up to 12 dB.
        exact_db = min(0.0, 20 * np.log10(abs(response(np.array([hz]))[0])) + 12.0)
        assert felt_db == pytest.approx(exact_db, abs=4.5)


def test_compensated_motion_rises_within_the_time_that_it_rings() -> None:
    """The inverse takes 12 dB, a factor of four, off a Q of 12."""
    rate, t = 96_000, np.arange(9600) / 96_000
    w = 2 * np.pi * 175.0
    section = bilinear([w / 3.0, 0.0], [1.0, w / 3.0, w**2], rate)
    height = np.abs(hilbert(lfilter(*section, np.sin(w * t))))
    assert height[round(ringing_s(LRA) * rate)] == pytest.approx(1.0 - np.exp(-1.0), abs=0.1)


def test_ticks_above_a_hum_are_felt_in_the_motion() -> None:
    """Bursts as short as on a flat actuator made the motion rise by 3.1 dB."""
    since = (T + 0.25) % 0.5
    felt = loop_of(0.3 * np.sin(2 * np.pi * 200.0 * T) + np.exp(-since / 0.002) * np.sin(2 * np.pi * 2500.0 * since))
    level = 10 * np.log10((felt[: len(felt) // 40 * 40].reshape(-1, 40) ** 2).mean(axis=1))
    rises = level[10:] - np.median(sliding_window_view(level, 10)[:-1], axis=1)
    assert np.sort(rises)[-8] > 3.8


def test_a_flat_actuator_moves_as_its_drive() -> None:
    assert ringing_s(actuator_profile("flat")) == 0.0
    assert motion(actuator_profile("flat"), RATE, is_compensated=True) is None
    assert modulation_gain(actuator_profile("flat"), 200.0, 60.0) == pytest.approx(1.0)


def test_fast_modulations_are_lost_between_the_flanks_of_a_resonance() -> None:
    """Side bands at 75 and 275 Hz lie outside the band that the inverse lifts."""
    sides = np.abs(response(np.array([75.0, 275.0])))
    assert modulation_gain(LRA, 175.0, 100.0) == pytest.approx(float(sides.mean()), rel=0.01)
