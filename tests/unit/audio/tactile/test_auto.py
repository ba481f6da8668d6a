"""The default converter `auto`: roughness is kept at its rate; without it, it is `adaptive` of what is heard."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.infrasound import infrasound_filter
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.scene_loops import Plan, SourceClip, felt_loop, plan_scene
from scene2hap.audio.sensation import Sensation
from scene2hap.audio.tactile import CONVERTERS, DEFAULT_CONVERTER
from scene2hap.audio.tactile.stages import SosStage
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile

RATE = 8000
T = np.arange(4 * RATE) / RATE
ENGINE = (0.5 * np.sin(2 * np.pi * 40 * T) + 0.2 * np.sin(2 * np.pi * 150 * T)).astype(np.float32)


def felt(context: ConversionContext) -> np.ndarray:
    stream = CONVERTERS.build("auto").stream(RATE, context)
    return np.concatenate([stream.process(ENGINE), stream.finish()])[RATE:]


def line(samples: np.ndarray, frequency_hz: float) -> float:
    """Amplitude at one frequency."""
    t = np.arange(len(samples)) / RATE
    return float(2 * abs((samples * np.exp(-2j * np.pi * frequency_hz * t)).mean()))


def test_roughness_is_modulation_at_the_rate_of_the_low_component() -> None:
    rough = felt(ConversionContext(own_hz=150.0, rough_hz=40.0))
    plain = felt(ConversionContext(own_hz=150.0))
    assert line(rough, 150.0) == pytest.approx(line(plain, 150.0), rel=0.02)
    for side in (110.0, 190.0):
        assert line(rough, side) - line(plain, side) == pytest.approx(0.25 * line(plain, 150.0), rel=0.2)


@pytest.mark.parametrize("target_hz", [80.0, 98.0])
@pytest.mark.parametrize("phase", [0.0, 0.5, 1.0, 1.5])
def test_side_bands_of_a_roughness_do_not_exceed_the_tone(phase: float, target_hz: float) -> None:
    """The third harmonic of a compressor lies where a side band is; together they were felt more than the tone."""
    parts = (0.5, 49.0, 0.0), (0.15, 98.0, 0.0), (0.15, 147.0, phase * np.pi)
    x = sum((a * np.sin(2 * np.pi * hz * T + angle) for a, hz, angle in parts), np.zeros(len(T)))
    clip = AudioClip(x.astype(np.float32), RATE)
    context = ConversionContext(own_hz=98.0, target_hz=target_hz, rough_hz=49.0, band_db=-9.0)
    loop = felt_loop(clip, CONVERTERS.build("auto"), Plan(context, 15.0))
    assert loop.frequency_tactile_hz == pytest.approx(target_hz, abs=1.0)


@pytest.mark.parametrize("actuator", ["flat", "voice_coil"])
def test_the_bed_of_a_rough_source_is_one_tone(actuator: str) -> None:
    """Other components would add to the side bands of the roughness, or cancel them, as their phases happen to be."""
    x = (0.3 * np.sin(2 * np.pi * 60 * T) + 0.3 * np.sin(2 * np.pi * 85 * T)).astype(np.float32)
    context = ConversionContext(actuator_profile(actuator), own_hz=60.0, target_hz=250.0, rough_hz=60.0, band_db=-2.0)
    stream = CONVERTERS.build("auto").stream(RATE, context)
    y = np.concatenate([stream.process(x), stream.finish()])[RATE:]
    # Two band-passes of Q = 5 leave 7 % of a component at 85/60 of their frequency, those of Q = 2 would leave 33 %.
    assert line(y, 275.0) < 0.1 * line(y, 250.0)


def test_roughness_leaves_the_slow_envelope_unchanged() -> None:
    rough, plain = (felt(ConversionContext(own_hz=150.0, rough_hz=hz)) for hz in (40.0, None))

    def levels(samples: np.ndarray) -> np.ndarray:
        return 20 * np.log10(np.sqrt((samples[: len(samples) // 800 * 800].reshape(-1, 800) ** 2).mean(axis=1)))

    assert np.ptp(levels(rough)) < np.ptp(levels(plain)) + 0.5


def test_auto_equals_adaptive_without_roughness_and_onsets() -> None:
    context = ConversionContext(own_hz=150.0, target_hz=170.0)
    stream = CONVERTERS.build("adaptive").stream(RATE, context)
    heard = stream.process(SosStage(infrasound_filter(RATE)).run(ENGINE.astype(np.float64)))
    expected = np.concatenate([heard, stream.finish()])
    before_end = slice(0, -RATE // 10)  # the level follower mends the end, where the sound breaks off
    np.testing.assert_array_equal(felt(context)[before_end], expected[RATE:][before_end])


def test_a_band_that_exceeds_full_scale_is_not_clipped() -> None:
    """The first harmonic of a square wave is stronger than the wave."""
    square = (0.9 * np.sign(np.sin(2 * np.pi * 150 * T + 0.1))).astype(np.float32)
    stream = CONVERTERS.build("auto").stream(RATE, ConversionContext(own_hz=150.0, band_db=-0.9))
    assert np.abs(stream.process(square)).max() > 0.5
    assert stream.n_clipped == 0


def test_silence_stays_silent() -> None:
    stream = CONVERTERS.build("auto").stream(RATE, ConversionContext(own_hz=150.0, rough_hz=40.0))
    assert not stream.process(np.zeros(RATE, np.float32)).any()
    assert not stream.finish().any()


def test_scene_plan_works_with_auto_and_reports_the_felt_level() -> None:
    converter = CONVERTERS.build(DEFAULT_CONVERTER)
    source = SourceClip(AudioClip((0.5 * np.sin(2 * np.pi * 80 * T)).astype(np.float32), RATE), 0.9)
    (plan,) = plan_scene([source], converter, ActuatorProfile())
    loop = felt_loop(source.clip, converter, plan)
    assert loop.felt is not None
    assert loop.felt.rough_hz is None
    assert loop.felt.asked_level_db == plan.level_db
    assert loop.felt.own_hz == pytest.approx(80.0, abs=0.01)
    assert loop.felt.level_db < loop.felt.asked_level_db - 3.0
    assert f"({plan.level_db:.1f} dB planned)" in str(loop.felt)


def test_sensation_text_states_level_and_moved_frequency() -> None:
    assert str(Sensation(20.0, 21.0, 98.0, 80.0)) == "20.0 dB over the threshold at 80 Hz, moved from 98"
    assert str(Sensation(20.0, 20.0, 98.0, 98.2)) == "20.0 dB over the threshold at 98 Hz"
    rough = "20.0 dB over the threshold at 250 Hz, moved from 49, rough at 49 Hz"
    assert str(Sensation(20.0, 20.0, 49.0, 250.0, 49.0)) == rough
    assert str(Sensation(14.0, 20.0)) == "14.0 dB over the threshold (20.0 dB planned)"
    with pytest.raises(AudioError, match="level_db"):
        Sensation(float("nan"), 20.0)
