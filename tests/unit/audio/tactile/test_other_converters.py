from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.signal import hilbert

from amplitudes import amplitude
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.scene_loops import SourceClip, felt_loop, plan_scene
from scene2hap.audio.tactile.envelope import EnvelopeCarrier
from scene2hap.audio.tactile.frequency_shift import FrequencyShift
from scene2hap.audio.tactile.lowpass import Lowpass
from scene2hap.audio.tactile.oscillator import Oscillator
from scene2hap.audio.tactile.perception_level import PerceptionLevel, amplitudes
from scene2hap.errors import ConfigError
from scene2hap.haptics import ActuatorProfile

RATE = 8000
PLAIN = ConversionContext()


def tone(frequency_hz: float, seconds: float = 3.0, a: float = 0.5) -> np.ndarray:
    return (a * np.sin(2 * np.pi * frequency_hz * np.arange(round(RATE * seconds)) / RATE)).astype(np.float32)


def rough(t: np.ndarray) -> np.ndarray:
    """A buzz: 24 partials 44 Hz apart, which beat with each other."""
    return 0.04 * sum(np.sin(2 * np.pi * 44 * k * t + k * k) for k in range(5, 29))


@pytest.mark.parametrize(("frequency_hz", "gain_db"), [(50, 0.0), (250, -3.01), (500, -24.1), (1000, -48.2)])
def test_lowpass_is_butterworth_of_order_four(frequency_hz: float, gain_db: float) -> None:
    y = (
        Lowpass()
        .stream(48_000, PLAIN)
        .process(np.sin(2 * np.pi * frequency_hz * np.arange(96_000) / 48_000).astype(np.float32))
    )
    peak = float(np.abs(y[-48_000:]).max())
    assert 20 * math.log10(peak) == pytest.approx(gain_db, abs=0.15)


def test_frequency_shift_moves_a_beep_by_hertz() -> None:
    y = FrequencyShift().stream(RATE, PLAIN).process(tone(800))
    assert amplitude(y, 550) == pytest.approx(0.5, rel=0.01)
    for elsewhere in (800, 1050, 1000, 250):
        assert amplitude(y, elsewhere) < 0.5 * 10 ** (-50 / 20)


def test_frequency_shift_keeps_an_envelope() -> None:
    t = np.arange(3 * RATE) / RATE
    x = (0.4 * (1 + 0.5 * np.sin(2 * np.pi * 5 * t)) * np.sin(2 * np.pi * 900 * t)).astype(np.float32)
    y = FrequencyShift(shift_hz=-700.0, low_hz=750.0).stream(RATE, PLAIN).process(x)
    assert amplitude(y, 200) == pytest.approx(0.4, rel=0.02)
    assert amplitude(y, 195) == pytest.approx(0.1, rel=0.02)
    assert amplitude(y, 205) == pytest.approx(0.1, rel=0.02)


def test_frequency_shift_gives_the_same_pitch_for_scene_and_file() -> None:
    clip = AudioClip(tone(600), RATE)
    (plan,) = plan_scene([SourceClip(clip, 0.5, "a")], FrequencyShift(), ActuatorProfile())
    loop = felt_loop(clip, FrequencyShift(), plan)
    assert loop.frequency_tactile_hz == pytest.approx(350, abs=0.5)


@pytest.mark.parametrize("frequency_hz", [5, 20, 60, 120, 190, 240, 250, 255, 259])
def test_frequency_shift_folds_nothing_and_leaves_nothing_below_ten_hertz(frequency_hz: int) -> None:
    y = FrequencyShift().stream(RATE, PLAIN).process(tone(frequency_hz, 4.0))[-RATE:].astype(float)
    assert 20 * math.log10(np.abs(np.fft.rfft(y)).max() * 2 / RATE / 0.5) < -60


@pytest.mark.parametrize("shift_hz", [-250.0, -120.0, 80.0])
def test_frequency_shift_is_that_of_the_analytic_signal(shift_hz: float) -> None:
    rng = np.random.default_rng(5)
    t = np.arange(4 * RATE) / RATE
    x = sum(0.05 * np.sin(2 * np.pi * f * t + rng.uniform(0, 6)) for f in range(310, 1240, 37))
    y = FrequencyShift(shift_hz=shift_hz).stream(RATE, PLAIN).process(x.astype(np.float32))
    expected = np.real(hilbert(x) * np.exp(2j * np.pi * shift_hz * t))
    got, wanted = (np.abs(np.fft.rfft(signal[-2 * RATE :])) / RATE for signal in (y.astype(float), expected))
    assert np.abs(got - wanted).max() < 0.05 * 0.015


def test_frequency_shift_refuses_to_fold_over() -> None:
    with pytest.raises(ConfigError, match="shift_hz is -295 Hz"):
        FrequencyShift(shift_hz=-295.0)
    with pytest.raises(ConfigError, match="high_hz is 200 Hz"):
        FrequencyShift(high_hz=200.0)


def test_envelope_carrier_keeps_the_amplitude_of_the_envelope() -> None:
    y = EnvelopeCarrier().stream(RATE, PLAIN).process(tone(900))
    assert amplitude(y, 250) == pytest.approx(0.5, rel=0.01)
    assert amplitude(y, 900) < 0.005


@pytest.mark.parametrize(
    ("converter", "context", "carrier_hz"),
    [
        (EnvelopeCarrier(), ConversionContext(target_hz=120.0), 120),
        (EnvelopeCarrier(), ConversionContext(ActuatorProfile("a", resonance_hz=175.0)), 175),
        (EnvelopeCarrier(90.0), ConversionContext(target_hz=120.0), 90),
    ],
)
def test_envelope_carrier_uses_the_configured_frequency(
    converter: EnvelopeCarrier, context: ConversionContext, carrier_hz: int
) -> None:
    assert amplitude(converter.stream(RATE, context).process(tone(700)), carrier_hz) == pytest.approx(0.5, rel=0.01)


@pytest.mark.parametrize("carrier_hz", [0.25, 5.0, 2000.0])
def test_envelope_carrier_that_nobody_feels_is_refused(carrier_hz: float) -> None:
    """0.25, which is meant in kHz, gave a vibration that nobody feels."""
    with pytest.raises(ConfigError, match=r"carrier_hz is .* Hz; it must be at"):
        EnvelopeCarrier(carrier_hz)


def test_perception_level_plays_two_sines_and_nothing_else() -> None:
    t = np.arange(4 * RATE) / RATE
    x = rough(t).astype(np.float32)
    stream = PerceptionLevel().stream(RATE, PLAIN)
    y = np.concatenate([stream.process(x), stream.finish()]).astype(float)
    spectrum = np.abs(np.fft.rfft(y * np.hanning(len(y)))) ** 2
    f = np.fft.rfftfreq(len(y), 1 / RATE)
    near = (np.abs(f - 175) < 12) | (np.abs(f - 210) < 12)
    assert spectrum.any()
    assert spectrum[near].sum() > 0.95 * spectrum.sum()


def test_perception_level_amplitudes_solve_the_published_equations() -> None:
    t = np.arange(4096) / 44_100
    frame = rough(t)
    low, high = amplitudes(frame, 44_100)
    total, share = low + high, high / (low + high)
    assert 0 < share < 1
    # Both fits of the paper must give the same roughness, from which the intensity follows.
    felt = 3.98 * math.sqrt(total) - 25.8 * share**2 + 25.5 * share + 0.203
    intensity = (felt + 28.15 * share**2 - 28.3 * share - 0.479) / 0.529
    magnitude = np.abs(np.fft.rfft(frame))
    assert intensity > 0
    loudness = ((intensity + 0.4) / (0.035 * felt**2)) ** 2
    plain = 0.065 * np.sum(20 * np.log10(1.37 * magnitude[3:595]) / 62.0)  # with a flat contour, accurate within 20 %
    assert loudness == pytest.approx(plain, rel=0.3)


def test_perception_level_is_louder_for_rougher_and_silent_for_silence() -> None:
    t = np.arange(4096) / 44_100
    pure = amplitudes(0.5 * np.sin(2 * np.pi * 220 * t), 44_100)
    assert sum(amplitudes(rough(t), 44_100)) > sum(pure)
    assert amplitudes(np.zeros(4096), 44_100) == (0.0, 0.0)


def test_an_oscillator_keeps_its_phase_for_hours() -> None:
    start = 192_000 * 3600
    cos, sin = Oscillator(175.0, 192_000).values(start, 5000)
    # 3600 s hold a whole number of cycles.
    angle = 2 * np.pi * 175.0 / 192_000 * np.arange(5000)
    np.testing.assert_allclose(cos, np.cos(angle), atol=1e-6)
    np.testing.assert_allclose(sin, np.sin(angle), atol=1e-6)


def test_bad_settings_are_refused() -> None:
    for wrong in (
        lambda: Lowpass(0.0),
        lambda: EnvelopeCarrier(envelope_hz=-1.0),
        lambda: PerceptionLevel(full_scale=0.0),
    ):
        with pytest.raises(ConfigError, match="above 0"):
            wrong()
    for converter in (Lowpass(5000.0), EnvelopeCarrier(envelope_hz=5000.0)):
        with pytest.raises(ConfigError, match="at most 3920"):
            converter.stream(RATE, PLAIN)
    with pytest.raises(ConfigError, match="low_hz is 4000 Hz"):
        FrequencyShift(low_hz=4000.0, high_hz=5000.0, shift_hz=-3000.0).stream(RATE, PLAIN)
