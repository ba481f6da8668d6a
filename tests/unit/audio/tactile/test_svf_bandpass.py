from __future__ import annotations

import math

import numpy as np
import pytest

from scene2hap.audio.protocol import ConversionContext, TactileConverter
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.audio.tactile.stages import SosStage
from scene2hap.audio.tactile.svf_bandpass import SvfBandpass
from scene2hap.errors import ConfigError

RATE = 48_000
CONTEXT = ConversionContext()


def tpt(x: np.ndarray, center_hz: float, q: float, rate: float) -> np.ndarray:
    """Simper's recurrence, sample by sample: two trapezoidal integrators in a loop, band-pass output times 1/Q."""
    g = math.tan(math.pi * center_hz / rate)
    k = 1 / q
    a1 = 1 / (1 + g * (g + k))
    a2 = g * a1
    a3 = g * a2
    s1 = s2 = 0.0
    y = np.empty(len(x))
    for n, sample in enumerate(x):
        v3 = sample - s2
        v1 = a1 * s1 + a2 * v3
        v2 = s2 + a2 * s1 + a3 * v3
        s1 = 2 * v1 - s1
        s2 = 2 * v2 - s2
        y[n] = k * v1
    return y


def gain(section: np.ndarray, frequency_hz: float, rate: float) -> float:
    z = np.exp(-2j * np.pi * frequency_hz / rate)
    b0, b1, b2, a0, a1, a2 = section[0]
    return float(abs((b0 + b1 * z + b2 * z * z) / (a0 + a1 * z + a2 * z * z)))


@pytest.mark.parametrize(
    ("center_hz", "q", "rate"),
    [(250, 0.707, 48_000), (250, 5.0, 8000), (40, 0.1, 44_100), (3900, 1.0, 8000), (250, 100.0, 48_000)],
)
def test_bandpass_equals_the_state_variable_filter(center_hz: float, q: float, rate: int) -> None:
    x = np.random.default_rng(3).uniform(-1, 1, 4800)
    converter = SvfBandpass(center_hz, q)
    expected = tpt(x, center_hz, q, rate)
    np.testing.assert_allclose(SosStage(converter.section(rate)).run(x), expected, rtol=0, atol=1e-12)
    x32 = x.astype(np.float32)
    streamed = converter.stream(rate, CONTEXT).process(x32)
    assert streamed.dtype == np.float32
    np.testing.assert_allclose(streamed, tpt(x32.astype(float), center_hz, q, rate), rtol=0, atol=1e-7)


@pytest.mark.parametrize("q", [0.1, 0.707, 100.0])
@pytest.mark.parametrize("center_hz", [1.0, 250.0, 0.49 * RATE])
def test_bandpass_is_finite_at_the_bounds_of_its_settings(center_hz: float, q: float) -> None:
    x = np.sign(np.random.default_rng(8).standard_normal(20_000)).astype(np.float32)
    assert np.isfinite(SvfBandpass(center_hz, q).stream(RATE, CONTEXT).process(x)).all()


def test_bandpass_is_finite_and_settles_over_ten_million_samples() -> None:
    stream = SvfBandpass(q=100.0).stream(RATE, CONTEXT)
    n = np.arange(200_000)
    for start in range(0, 10_000_000, len(n)):
        block = stream.process(np.cos(2 * np.pi * 250.0 / RATE * (n + start)).astype(np.float32))
        assert np.isfinite(block).all()
    assert np.abs(block).max() == pytest.approx(1.0, abs=1e-3)


def test_denormal_input_and_ringing_out_stay_finite_and_end_at_zero() -> None:
    stream = SvfBandpass(q=0.1).stream(RATE, CONTEXT)
    tiny = np.full(1000, 1e-45, dtype=np.float32)
    assert np.isfinite(stream.process(tiny)).all()
    stream.process(np.ones(1000, np.float32))
    for _ in range(100):
        rest = stream.process(np.zeros(10_000, np.float32))
    assert not rest.any()
    (stage,) = stream.stages
    assert isinstance(stage, SosStage)
    assert not stage.state.any()


@pytest.mark.parametrize("q", [0.1, 0.707, 1.0, 5.0, 100.0])
@pytest.mark.parametrize(("center_hz", "rate"), [(250.0, 48_000), (250.0, 8000), (40.0, 44_100), (480.0, 1000)])
def test_bandpass_has_unit_gain_at_its_centre_and_stops_both_ends(center_hz: float, q: float, rate: float) -> None:
    section = SvfBandpass(center_hz, q).section(rate)
    assert gain(section, center_hz, rate) == pytest.approx(1.0, abs=1e-9)
    assert gain(section, 0.0, rate) == 0.0
    assert gain(section, rate / 2, rate) == pytest.approx(0.0, abs=1e-9)
    grid = np.linspace(0, rate / 2, 2001)
    assert max(gain(section, f, rate) for f in grid) <= 1.0 + 1e-9


def test_the_default_passes_129_to_483_hz() -> None:
    section = SvfBandpass().section(RATE)
    for edge_hz in (129.4, 483.0):
        assert 20 * math.log10(gain(section, edge_hz, RATE)) == pytest.approx(-3.01, abs=0.05)


def test_bandpass_output_is_bit_identical_for_any_block_size() -> None:
    x = np.random.default_rng(4).uniform(-1, 1, 20_000).astype(np.float32)
    whole = SvfBandpass().stream(RATE, CONTEXT).process(x)
    rng = np.random.default_rng(5)
    stream = SvfBandpass().stream(RATE, CONTEXT)
    cuts = np.sort(rng.integers(0, len(x), 300))
    parts = [stream.process(block) for block in np.split(x, cuts)]
    assert any(part.size == 0 for part in parts)
    np.testing.assert_array_equal(np.concatenate([*parts, stream.finish()]), whole)


def test_silence_stays_silence_and_streams_do_not_share_state() -> None:
    converter = SvfBandpass()
    loud = converter.stream(RATE, CONTEXT)
    loud.process(np.ones(100, np.float32))
    assert not converter.stream(RATE, CONTEXT).process(np.zeros(1000, np.float32)).any()
    assert loud.process(np.zeros(10, np.float32)).any()


def test_impossible_settings_are_refused() -> None:
    with pytest.raises(ConfigError, match="center_hz is 0 Hz"):
        SvfBandpass(center_hz=0)
    for q in (0.09, 101, math.nan):
        with pytest.raises(ConfigError, match="q is"):
            SvfBandpass(q=q)
    with pytest.raises(
        ConfigError, match=r"center_hz is 250 Hz; it must be at most 245.*At 500 Hz choose a lower centre"
    ):
        SvfBandpass().stream(500, CONTEXT)


def test_bandpass_is_registered_by_its_kind() -> None:
    assert "svf_bandpass" in CONVERTERS.kinds()
    assert CONVERTERS.load("svf_bandpass") is SvfBandpass
    assert isinstance(SvfBandpass(), TactileConverter)
