"""The safety layer: signals that pass unchanged, and limits that no output exceeds."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings, strategies as st
from numpy.typing import NDArray
from scipy.signal import butter, sosfiltfilt

from scene2hap import ActuatorProfile
from scene2hap.errors import ConfigError
from scene2hap.render.guards import PeakGuard
from scene2hap.render.safety import FADE_OUT_S, SafetyLayer

RATE = 48000
WEAK = ActuatorProfile(max_amplitude=0.5, max_rms=0.15, rms_window_s=0.5, max_frequency_hz=200.0)
LIMITS = {
    "default": ActuatorProfile(),
    "weak": WEAK,
    "wide": ActuatorProfile(max_frequency_hz=5000.0),
    "cool": ActuatorProfile(max_rms=0.1),
}


def column(x: NDArray[np.float64]) -> NDArray[np.float32]:
    return x.astype(np.float32)[:, None]


def sine(frequency_hz: float, seconds: float, amplitude: float = 1.0, phase: float = 0.0) -> NDArray[np.float32]:
    t = np.arange(round(seconds * RATE)) / RATE
    return column(amplitude * np.sin(2 * np.pi * frequency_hz * t + phase))


def square(frequency_hz: float, seconds: float) -> NDArray[np.float32]:
    t = np.arange(round(seconds * RATE)) / RATE
    return column(np.where((t * frequency_hz) % 1 < 0.5, 1.0, -1.0))


def gain_jumps(seed: int, n: int) -> NDArray[np.float32]:
    """A tone whose gain jumps at random frames, far beyond full scale."""
    draw = np.random.default_rng(seed)
    gains = draw.choice([0.0, 1.0, -1.0, 1e-3, 30.0, 1e30], size=n)
    return column(gains * np.sin(2 * np.pi * 150 * np.arange(n) / RATE))


def assert_safe(y: NDArray[np.float32], limits: ActuatorProfile, rate: int = RATE) -> None:
    assert y.dtype == np.float32
    assert np.isfinite(y).all()
    exact = y.astype(np.float64)
    assert np.abs(exact).max() <= limits.max_amplitude
    slew = np.abs(np.diff(exact, axis=0, prepend=0.0)).max() * rate
    assert slew <= 2 * math.pi * limits.max_frequency_hz * limits.max_amplitude
    window = round(limits.rms_window_s * rate)
    energy = np.cumsum(np.pad(exact**2, ((window, 0), (0, 0))), axis=0)
    assert (energy[window:] - energy[:-window]).max() / window <= limits.max_rms**2


HOSTILE = {
    "nan": np.full((RATE, 1), np.nan, dtype=np.float32),
    "infinity": np.full((RATE, 1), np.inf, dtype=np.float32),
    "both infinities": column(np.where(np.arange(RATE) % 7 < 3, np.inf, -np.inf)),
    "holes": column(np.where(np.random.default_rng(1).random(RATE) < 0.01, np.nan, 0.9)),
    "largest": np.full((RATE, 1), np.finfo(np.float32).max, dtype=np.float32),
    "constant": np.ones((2 * RATE, 1), dtype=np.float32),
    "square of 1 Hz": square(1.0, 3.0),
    "square of 30 Hz": square(30.0, 2.0),
    "square of 250 Hz": square(250.0, 2.0),
    "square of 900 Hz": square(900.0, 1.0),
    "alternating": column((-1.0) ** np.arange(RATE)),
    "noise": column(np.sign(np.random.default_rng(2).standard_normal(2 * RATE))),
    "jumps": gain_jumps(3, RATE),
}


@pytest.mark.parametrize("limits", LIMITS.values(), ids=LIMITS)
@pytest.mark.parametrize("x", HOSTILE.values(), ids=HOSTILE)
def test_any_input_gives_finite_output_within_full_scale(x: NDArray[np.float32], limits: ActuatorProfile) -> None:
    layer = SafetyLayer(limits, RATE, 1)
    assert_safe(layer.process(x), limits)
    assert layer.stats.repaired == np.count_nonzero(~np.isfinite(x))
    assert layer.stats.clipped == np.count_nonzero(np.isfinite(x) & (np.abs(x) > 1))


def test_a_million_random_gain_jumps() -> None:
    for limits in (ActuatorProfile(), WEAK):
        layer = SafetyLayer(limits, RATE, 1)
        x = gain_jumps(4, 1_000_000)
        assert_safe(np.concatenate([layer.process(x[i : i + 4801]) for i in range(0, len(x), 4801)]), limits)


@settings(max_examples=25)
@given(
    st.sampled_from([1000, 2000, 8000, 44100, 96000]),
    st.sampled_from(list(LIMITS.values())),
    st.lists(st.tuples(st.floats(-2.0, 2.0), st.integers(1, 3000)), min_size=1, max_size=12),
    st.lists(st.booleans(), min_size=1, max_size=8),
)
def test_steps_and_deaths_at_any_rate(
    rate: int, limits: ActuatorProfile, steps: list[tuple[float, int]], alive: list[bool]
) -> None:
    x = column(np.concatenate([np.full(n, level) for level, n in steps]))
    now = 0.0
    layer = SafetyLayer(limits, rate, 1, watchdog_s=0.02, clock=lambda: now)
    parts = []
    for i, begin in enumerate(range(0, len(x), 311)):
        now += 311 / rate
        if alive[i % len(alive)]:
            layer.feed()
        parts.append(layer.process(x[begin : begin + 311]))
    assert_safe(np.concatenate(parts), limits, rate)


@settings(max_examples=12)
@given(
    st.integers(0, 2**32 - 1),
    st.lists(st.integers(0, 5000), min_size=1, max_size=6).filter(any),
    st.sampled_from(list(LIMITS.values())),
)
@example(0, [0, 1], ActuatorProfile(max_amplitude=0.5, max_rms=0.15))
def test_any_blocks_give_the_same_bits(seed: int, blocks: list[int], limits: ActuatorProfile) -> None:
    draw = np.random.default_rng(seed)
    loudness = np.repeat(draw.uniform(0, 1.5, 13), 1000)[:, None]
    x = (draw.standard_normal((13000, 2)) * loudness).astype(np.float32)
    x[draw.random(x.shape) < 1e-3] = np.nan
    whole = SafetyLayer(limits, RATE, 2).process(x)
    layer, parts, done = SafetyLayer(limits, RATE, 2), [], 0
    while done < len(x):
        n = blocks[len(parts) % len(blocks)]
        parts.append(layer.process(x[done : done + n]))
        done += n
    np.testing.assert_array_equal(np.concatenate(parts), whole)


@pytest.mark.parametrize("frequency_hz", [20.0, 23.0, 31.5, 63.0, 125.0, 250.0, 400.0, 500.0])
@pytest.mark.parametrize("phase", [0.0, 0.25 * np.pi, 0.5 * np.pi, 1.2 * np.pi])
def test_a_full_scale_sine_passes(frequency_hz: float, phase: float) -> None:
    layer = SafetyLayer(ActuatorProfile(), RATE, 1)
    y = layer.process(sine(frequency_hz, 2.0, phase=phase))[RATE:, 0].astype(np.float64)
    # A second holds a whole number of half cycles, over which the RMS is that of the tone.
    level_db = 20 * math.log10(math.sqrt(2 * np.mean(y**2)))
    assert abs(level_db) < 0.5
    s = layer.stats
    assert (s.repaired, s.clipped, s.peak_limited, s.power_limited, s.slew_limited) == (0, 0, 0, 0, 0)


@pytest.mark.parametrize("f_max", [50.0, 230.0, 800.0])
@pytest.mark.parametrize(("most", "passes"), [(0.8, 0.64), (0.5, 0.35), (0.1, 0.07)])
def test_a_sine_passes_other_actuators(f_max: float, most: float, passes: float) -> None:
    """Up to 3 dB below the limit, or as far below as full scale is above it: -1.9 dB for -1.9 dB."""
    layer = SafetyLayer(ActuatorProfile(max_amplitude=most, max_frequency_hz=f_max), RATE, 1)
    for f in (20.0, f_max / 2):
        y = layer.process(sine(f, 3.0, passes))[RATE:, 0].astype(np.float64)
        assert 20 * math.log10(y.max() / passes) > -0.5


def level_above_1khz_db(y: NDArray[np.float64]) -> float:
    """Largest sample of what is above 1 kHz, relative to the largest sample. The ends are left out."""
    high = sosfiltfilt(butter(6, 1000.0, "highpass", fs=RATE, output="sos"), y)
    inner = slice(RATE // 10, -RATE // 10)
    return 20 * math.log10(np.abs(high[inner]).max() / np.abs(y[inner]).max())


@pytest.mark.parametrize(("most", "f", "at_most_db"), [(0.3, 150.0, -38.0), (0.3, 60.0, -46.0)])
def test_a_source_too_loud_for_the_actuator_does_not_click(most: float, f: float, at_most_db: float) -> None:
    """It begins over 20 ms and needs up to 9.5 dB less. A limiter that acts at once has -25 dB to -35 dB."""
    x = sine(f, 2.0, 0.9).astype(np.float64)
    x *= (0.5 - 0.5 * np.cos(np.pi * np.clip(np.arange(len(x)) / RATE - 0.5, 0.0, 0.02) / 0.02))[:, None]
    guard = PeakGuard(most, RATE, 1)
    y = guard.pass_through(x)[:, 0]
    assert np.abs(y).max() <= most
    assert level_above_1khz_db(y) < at_most_db
    assert guard.n_limited > 0
    held = np.abs(np.fft.rfft(y[-RATE:] * np.hanning(RATE)))
    odd = [3 * round(f), 5 * round(f), 7 * round(f)]
    assert math.hypot(*held[odd]) < 2e-3 * held[round(f)]


def test_a_limit_that_changes_does_not_click_and_is_kept() -> None:
    """The limit of one hand changes, and that of the other does not."""
    guard = PeakGuard(np.ones(2), RATE, 2)
    x = np.repeat(sine(150.0, 3.0, 0.6).astype(np.float64), 2, axis=1)
    y = [guard.pass_through(x[:RATE])]
    guard.limit = np.array([0.1, 1.0])
    y.append(guard.pass_through(x[RATE : 2 * RATE]))
    guard.limit = np.ones(2)
    y.append(guard.pass_through(x[2 * RATE :]))
    assert np.abs(y[1][RATE // 20 :, 0]).max() <= 0.1
    assert level_above_1khz_db(np.concatenate(y)[:, 0]) < -50.0
    np.testing.assert_array_equal(np.concatenate(y)[:, 1], x[:, 1])


@pytest.mark.parametrize("rate", [8000, 44100, 48000])
@pytest.mark.parametrize("f_max", [50.0, 230.0, 800.0, 1000.0])
def test_the_whole_band_of_an_actuator_keeps_its_level(f_max: float, rate: int) -> None:
    """A loop's stated level is that at the actuator, also for an LRA, whose sources are all near its upper end."""
    for f in (f_max, 0.85 * f_max):
        layer = SafetyLayer(ActuatorProfile(max_frequency_hz=f_max), rate, 1)
        t = np.arange(3 * rate) / rate
        y = layer.process(column(0.5 * np.sin(2 * np.pi * f * t)))[rate:, 0].astype(np.float64)
        assert 20 * math.log10(math.sqrt(2 * np.mean(y**2)) / 0.5) > -0.3
        assert layer.stats.slew_limited == 0


def test_the_low_pass_falls_beyond_the_band() -> None:
    for f, at_most_db in ((460.0, -12.0), (920.0, -36.0)):
        y = SafetyLayer(ActuatorProfile(max_frequency_hz=230.0), RATE, 1).process(sine(f, 3.0, 0.2))[RATE:, 0]
        assert 20 * math.log10(math.sqrt(2 * np.mean(y.astype(np.float64) ** 2)) / 0.2) < at_most_db


def test_a_square_leaves_little_above_the_band() -> None:
    y = SafetyLayer(ActuatorProfile(), RATE, 1).process(square(250.0, 3.0))[RATE:, 0].astype(np.float64)
    power = np.abs(np.fft.rfft(y)) ** 2
    f = np.fft.rfftfreq(len(y), 1 / RATE)
    assert 10 * math.log10(power[f > 4000].sum() / power.sum()) < -40


def test_constant_input_decays_to_zero() -> None:
    y = SafetyLayer(ActuatorProfile(), RATE, 1).process(np.ones((2 * RATE, 1), dtype=np.float32))
    assert np.abs(y[round(0.2 * RATE) :]).max() < 10 ** (-40 / 20)
    # The same after steady running: a tone that turns into a constant.
    layer = SafetyLayer(ActuatorProfile(), RATE, 1)
    layer.process(sine(100.0, 1.0))
    y = layer.process(np.ones((RATE, 1), dtype=np.float32))
    assert np.abs(y[round(0.2 * RATE) :]).max() < 10 ** (-40 / 20)


def test_silence_stays_silence_and_becomes_exact() -> None:
    layer = SafetyLayer(ActuatorProfile(), RATE, 1)
    assert not layer.process(np.zeros((1000, 1), dtype=np.float32)).any()
    layer.process(sine(100.0, 0.5))
    layer.process(np.zeros((2 * RATE, 1), dtype=np.float32))
    assert not layer.process(np.zeros((1000, 1), dtype=np.float32)).any()


def test_hands_are_processed_independently() -> None:
    left = sine(100.0, 0.5, 0.3)
    both = SafetyLayer(WEAK, RATE, 2).process(np.hstack([left, gain_jumps(5, len(left))]))
    np.testing.assert_array_equal(both[:, :1], SafetyLayer(WEAK, RATE, 1).process(left))


def test_power_guard_settles_and_passes_power_within_the_limits() -> None:
    limits = ActuatorProfile(max_rms=0.2)
    layer = SafetyLayer(limits, RATE, 1)
    y = layer.process(sine(100.0, 6.0))[-RATE:, 0].astype(np.float64)
    rms = math.sqrt(np.mean(y**2))
    # tau / T = 1/4 and the knee use at most 1.3 dB of the limits.
    assert 0.2 * 10 ** (-1.3 / 20) < rms <= 0.2
    assert layer.stats.power_limited > 0
    quiet = SafetyLayer(limits, RATE, 1)
    amplitude = 0.7 * 0.2 * math.sqrt(2)
    np.testing.assert_array_equal(
        quiet.process(sine(100.0, 3.0, amplitude)),
        SafetyLayer(ActuatorProfile(), RATE, 1).process(sine(100.0, 3.0, amplitude)),
    )
    assert quiet.stats.power_limited == 0


def test_power_guard_takes_as_much_of_a_mix_at_its_limit_as_the_documentation_says() -> None:
    """Of V = 0.8 W the guard needs 0.3 V for its gain: g^2 = V / (0.3 V + W) in the long run."""
    layer = SafetyLayer(ActuatorProfile(max_rms=0.2), RATE, 1)
    y = layer.process(sine(100.0, 20.0, 0.2 * math.sqrt(2)))[-RATE:, 0].astype(np.float64)
    page = (Path(__file__).parents[3] / "docs/actuators.md").read_text(encoding="utf-8")
    stated = re.search(r"(-[\d.]+) dB at most in the long run", page)
    assert stated
    assert 20 * math.log10(math.sqrt(np.mean(y**2)) / 0.2) == pytest.approx(float(stated[1]), abs=0.05)


class Clock:
    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def play(layer: SafetyLayer, clock: Clock, seconds: float, alive_at: list[float] | None = None) -> NDArray[np.float32]:
    """Process a tone in blocks of 5 ms; updates come at the given times, or with every block if None."""
    parts, begin = [], clock.now
    waiting = None if alive_at is None else sorted(alive_at)
    tone = sine(125.0, seconds)
    for start in range(0, len(tone), 240):
        clock.now = begin + start / RATE
        if waiting is None:
            layer.feed()
        while waiting and waiting[0] <= clock.now - begin:
            waiting.pop(0)
            layer.feed()
        parts.append(layer.process(tone[start : start + 240]))
    clock.now = begin + seconds
    return np.concatenate(parts)


def test_output_fades_out_when_updates_stop() -> None:
    for watchdog_s in (0.02, 0.1, 1.0):
        clock = Clock()
        layer = SafetyLayer(ActuatorProfile(), RATE, 1, watchdog_s=watchdog_s, clock=clock)
        before = play(layer, clock, 0.5)
        y = play(layer, clock, 2.0, alive_at=[0.0])
        last = int(np.flatnonzero(y)[-1]) + 1
        # The gate changes only at the start of a block of 5 ms.
        assert watchdog_s <= last / RATE <= watchdog_s + FADE_OUT_S + 0.005 + 1e-9
        assert layer.stats.watchdog_trips == 1
        assert_safe(np.concatenate([before, y]), ActuatorProfile())
        back = play(layer, clock, 0.2)
        assert np.abs(back).max() > 0.9
        assert np.abs(np.diff(back[:, 0])).max() < 1.05 * 2 * math.pi * 125 / RATE
        assert np.abs(back[:48]).max() < 0.01


def test_silence_before_the_first_update() -> None:
    clock = Clock()
    layer = SafetyLayer(ActuatorProfile(), RATE, 1, watchdog_s=0.1, clock=clock)
    assert not play(layer, clock, 0.3, alive_at=[]).any()
    assert layer.stats.watchdog_trips == 0


def test_a_slow_game_with_hitches_plays_unbroken() -> None:
    updates, t = [], 0.0
    for i in range(60):
        updates.append(t)
        t += 1 / 30 + (0.06 if i % 7 == 3 else 0.0)
    clock = Clock()
    layer = SafetyLayer(ActuatorProfile(), RATE, 1, watchdog_s=0.1, clock=clock)
    broken = play(layer, clock, 2.0, alive_at=updates)
    np.testing.assert_array_equal(broken, SafetyLayer(ActuatorProfile(), RATE, 1).process(sine(125.0, 2.0)))
    assert layer.stats.watchdog_trips == 0


def test_release_fades_out_within_ten_milliseconds() -> None:
    layer = SafetyLayer(ActuatorProfile(), RATE, 1)
    before = layer.process(sine(100.0, 0.5))
    assert not layer.silent.is_set()
    layer.release()
    y = layer.process(sine(100.0, 0.5))
    assert y[:200].any()
    assert not y[round(FADE_OUT_S * RATE) :].any()
    assert_safe(np.concatenate([before, y]), ActuatorProfile())
    assert layer.silent.is_set()


def test_failing_fill_is_faded_out_before_the_error_is_reported() -> None:
    clock = Clock()
    layer = SafetyLayer(ActuatorProfile(), RATE, 1, watchdog_s=0.1, clock=clock)
    tone = sine(100.0, 1.0)
    state = {"at": 0}

    def fill(n: int) -> NDArray[np.float32]:
        if state["at"] > 24000:
            raise RuntimeError("the mix is gone")
        state["at"] += n
        return tone[state["at"] - n : state["at"]]

    safe = layer.guard(fill)
    layer.feed()
    parts = []
    with pytest.raises(RuntimeError, match="gone"):
        while True:
            parts.append(safe(240))
    y = np.concatenate(parts)
    assert_safe(y, ActuatorProfile())
    assert y[-1, 0] == 0.0
    assert np.abs(y[20000:24000]).max() > 0.9


def test_without_a_clock_a_failure_is_raised_at_once() -> None:
    def fill(n: int) -> NDArray[np.float32]:
        raise RuntimeError("no")

    with pytest.raises(RuntimeError):
        SafetyLayer(ActuatorProfile(), RATE, 1).guard(fill)(10)


def test_limits_and_watchdogs_out_of_bounds_are_refused() -> None:
    for wrong in (
        {"max_amplitude": 0.0},
        {"max_amplitude": 1.1},
        {"max_rms": 0.01},
        {"rms_window_s": 0.0},
        {"max_frequency_hz": math.nan},
    ):
        with pytest.raises(ConfigError, match=next(iter(wrong))):
            ActuatorProfile(**wrong)
    for watchdog_s in (0.0, 0.019, 1.01, math.nan):
        with pytest.raises(ConfigError, match=r"watchdog_s is .*\[s\]"):
            SafetyLayer(ActuatorProfile(), RATE, 1, watchdog_s=watchdog_s)
