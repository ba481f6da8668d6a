"""One-shot bursts in a mix are played completely, once, and without a click."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from scene2hap.render.bursts import LEAST_SUM, MOST_SUM, Bursts, Fade, PlannedBurst, Samples, peak_of, summed, wave_of
from scene2hap.render.limiter import soft_limit_sum

RATE = 48_000


def above_1_khz_db(samples: Samples) -> float:
    power = np.abs(np.fft.rfft(samples, 1 << 17)) ** 2
    return float(10 * np.log10(power[np.fft.rfftfreq(1 << 17, 1 / RATE) > 1000].sum() / power.sum()))


@pytest.mark.parametrize(
    ("frequency_hz", "decay_s"),
    [(30.0, 0.035), (70.0, 0.015), (130.0, 0.1), (250.0, 0.0042), (400.0, 0.008), (400.0, 0.1)],
)
def test_a_wave_has_a_peak_of_1_and_no_click(frequency_hz: float, decay_s: float) -> None:
    wave = wave_of(frequency_hz, decay_s, RATE)
    assert np.abs(wave).max() == pytest.approx(1.0)
    assert wave[0] == 0.0
    assert abs(wave[-1]) < 1e-4
    assert above_1_khz_db(wave) < -60.0
    # A wave of the strongest impact, at -6 dB, also clicks less than a step of -60 dB of full scale.
    power = np.abs(np.fft.rfft(0.5 * wave, 1 << 17)) ** 2 / (1 << 16)
    step = 1e-6 * RATE / (2 * np.pi**2 * 1150)  # energy of 1 / (2 pi f)^2 above 1150 Hz, to both sides
    assert power[np.fft.rfftfreq(1 << 17, 1 / RATE) > 1150].sum() < step


def test_wave_is_a_decaying_sine_of_stated_frequency_and_decay() -> None:
    wave = wave_of(200.0, 0.05, RATE).astype(float)
    t = np.arange(len(wave)) / RATE
    inside = (t > 0.006) & (t < 0.2)
    expected = np.exp(-t / 0.05) * np.sin(2 * np.pi * 200.0 * t)
    scale = wave[inside] @ expected[inside] / (expected[inside] @ expected[inside])
    np.testing.assert_allclose(wave[inside], scale * expected[inside], atol=1e-5)


def test_waves_of_other_lengths_add_up() -> None:
    total = summed([np.ones(3, np.float32), np.ones(5, np.float32)], [0.5, 0.25])
    np.testing.assert_array_equal(total, np.float32([0.75, 0.75, 0.75, 0.25, 0.25]))


@pytest.mark.parametrize("seed", range(40))
def test_the_peak_is_that_of_all_samples(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 7))
    f, decays, weights = rng.uniform(30, 400, n), rng.uniform(0.008, 0.1, n), rng.uniform(0.001, 1, n)
    waves = [wave_of(a, b, RATE) for a, b in zip(f.tolist(), decays.tolist(), strict=True)]
    every = float(np.abs(summed(waves, weights.tolist())).max())
    assert peak_of(waves, weights, decays, RATE) == every
    assert every >= LEAST_SUM * weights.max()


def test_the_weakest_sum_has_the_least_peak() -> None:
    """Sines that cancel at the first peak of the strongest, as an optimiser found them."""
    f, decays = (233.1875, 92.2615, 149.3182), (0.0046, 0.0088, 0.008)
    waves = [wave_of(*one, RATE) for one in zip(f, decays, strict=True)]
    assert LEAST_SUM < np.abs(summed(waves, [0.471, 0.3687, 1.0])).max() < 0.5


def test_a_beat_may_peak_late() -> None:
    """Two sines that cancel at first have their peak long after the first cycles."""
    waves = [wave_of(100.0, 0.1, RATE), -wave_of(104.0, 0.1, RATE)]
    every = float(np.abs(summed(waves, [1.0, 1.0])).max())
    assert peak_of(waves, np.ones(2), np.full(2, 0.1), RATE) == every


@pytest.mark.parametrize("block", [1, 7, 64, 480, 5000])
def test_bursts_do_not_depend_on_block_size(block: int) -> None:
    wave, bursts = wave_of(100.0, 0.01, RATE), Bursts()
    bursts.start(PlannedBurst(100, [wave], {7: [1.0]}))
    bursts.start(PlannedBurst(300, [wave], {7: [1.0], 8: [2.0]}))
    found = np.zeros((6000, 3), np.float32)
    for begin in range(0, 6000, block):
        bursts.add_to(found[begin : begin + block], begin, (6, 7, 8))
    expected = np.zeros((6000, 3), np.float32)
    expected[100 : 100 + len(wave), 1] += wave
    expected[300 : 300 + len(wave), 1:] += np.outer(wave, [1, 2])
    np.testing.assert_array_equal(found, expected)
    assert bursts.are_silent


@pytest.mark.parametrize("block", [64, 480, 5000])
def test_long_burst_of_several_waves_is_their_sum(block: int) -> None:
    waves, weights = [wave_of(80.0, 0.1, RATE), wave_of(200.0, 0.03, RATE)], [0.5, 0.25]
    bursts, found = Bursts(), np.zeros((30_000, 2), np.float32)
    bursts.start(PlannedBurst(10, waves, {1: weights}))
    for begin in range(0, len(found), block):
        bursts.add_to(found[begin : begin + block], begin, (0, 1))
    expected = np.zeros(len(found))
    for wave, weight in zip(waves, weights, strict=True):
        expected[10 : 10 + len(wave)] += weight * wave.astype(np.float64)
    np.testing.assert_allclose(found[:, 1], expected, atol=1e-7)
    assert not found[:, 0].any()


def test_late_burst_starts_with_the_next_frame() -> None:
    wave, bursts, mix = wave_of(100.0, 0.01, RATE), Bursts(), np.zeros((64, 1), np.float32)
    bursts.start(PlannedBurst(10, [wave], {0: [1.0]}))
    bursts.add_to(mix, 1000, (0,))
    np.testing.assert_array_equal(mix[:, 0], wave[:64])


def played(
    level: float, n_heard: int, *, begin_at: int = 20_000, n_bursts: int = 1, apart: int = 0, block: int = 256
) -> Samples:
    """A tone at one of two outputs (48000, 2), and in its midst strong bursts at both."""
    tone = (level * np.sin(2 * np.pi * 90.0 * np.arange(48_000) / 48_000)).astype(np.float32)
    mixed, bursts = np.stack([tone, np.zeros_like(tone)], axis=1), Bursts(n_heard)
    for i in range(n_bursts):
        wave = wave_of(130.0 + 20 * i, 0.08, 48_000)
        bursts.start(PlannedBurst(begin_at + i * apart, [wave], {0: [0.5], 1: [0.5]}))
    for begin in range(0, len(mixed), block):
        mix = mixed[begin : begin + block].copy()
        bursts.add_to(mixed[begin : begin + block], begin, (0, 1))
        mixed[begin : begin + block] = soft_limit_sum(mix, mixed[begin : begin + block], MOST_SUM)
        bursts.hear(mix, (0, 1))
        mix[:] = 1.0  # the caller's own
    return mixed


def test_a_burst_on_a_loud_mix_is_not_limited() -> None:
    """In an earlier version the limiter's curve took the peaks of both: -63 dB above 1 kHz, a click."""
    for begin in range(20_000, 20_533, 67):  # a period of the tone
        loud = played(0.7, 1200, begin_at=begin)
        assert above_1_khz_db(loud[15_000:30_000, 0] * np.hanning(15_000)) < -100.0
        assert np.abs(loud[begin:, 0]).max() > 0.85
        np.testing.assert_array_equal(loud[:, 1], played(0.0, 0, begin_at=begin)[:, 1])


@pytest.mark.parametrize("apart", [0, 100, 400])
def test_bursts_that_begin_together_are_not_limited(apart: int) -> None:
    """The second began before the first had risen, and both had the same room: a click of -13 dB."""
    loud = played(0.6, 1200, n_bursts=4, apart=apart)
    assert above_1_khz_db(loud[15_000:30_000, 0] * np.hanning(15_000)) < -90.0
    assert 0.75 < np.abs(loud).max() < MOST_SUM + 1e-6


@pytest.mark.parametrize("later", range(0, 458, 57))  # in a period of 105 Hz
def test_a_burst_that_rises_late_leaves_less_room_for_another(later: int) -> None:
    """Two sines that cancel at first are loudest after 50 ms."""
    bursts, mix = Bursts(1200), np.zeros((9600, 1), np.float32)
    bursts.start(PlannedBurst(0, [wave_of(100.0, 0.3, RATE), wave_of(110.0, 0.3, RATE)], {0: [0.5, -0.5]}))
    bursts.start(PlannedBurst(later, [wave_of(105.0, 0.3, RATE)], {0: [0.9]}))
    for begin in range(0, len(mix), 64):
        bursts.add_to(mix[begin : begin + 64], begin, (0,))
    assert np.abs(mix).max() < MOST_SUM + 1e-6


@pytest.mark.parametrize("block", [1, 64, 4800, 48_000])
def test_the_room_of_bursts_does_not_depend_on_block_size(block: int) -> None:
    expected, found = (played(0.6, 1200, n_bursts=3, apart=300, block=size) for size in (256, block))
    np.testing.assert_allclose(found, expected, atol=1e-6)


def test_a_burst_on_a_quiet_mix_keeps_its_level() -> None:
    np.testing.assert_array_equal(played(0.4, 1200), played(0.4, 0))


def test_outputs_keep_their_levels_when_others_come_and_go() -> None:
    bursts, wave = Bursts(100), wave_of(130.0, 0.08, RATE)
    bursts.hear(np.full((64, 2), [0.8, 0.0], np.float32), (5, 6))
    bursts.hear(np.full((8, 3), [0.0, 0.6, 0.0], np.float32), (6, 5, 7))
    bursts.start(PlannedBurst(0, [wave], {token: [0.9] for token in (5, 6, 7, 8)}))
    mix = np.zeros((len(wave), 3), np.float32)
    bursts.add_to(mix, 0, (8, 7, 5))
    np.testing.assert_allclose(np.abs(mix).max(axis=0), [0.9, 0.9, MOST_SUM - 0.8], atol=1e-6)


def test_no_more_of_a_mix_is_kept_than_is_needed() -> None:
    bursts = Bursts(100)
    bursts.hear(np.full((1, 1), 0.9, np.float32), (0,))  # too long ago, after the next one
    tracemalloc.start()
    bursts.hear(np.zeros((1 << 20, 1), np.float32), (0,))
    assert tracemalloc.get_traced_memory()[0] < 100_000
    tracemalloc.stop()
    mix = np.zeros((2000, 1), np.float32)
    bursts.start(PlannedBurst(0, [wave_of(130.0, 0.08, RATE)], {0: [0.9]}))
    bursts.add_to(mix, 0, (0,))
    assert np.abs(mix).max() == pytest.approx(0.9)


def test_fade_ends_all_bursts_without_a_click() -> None:
    bursts, mix = Bursts(), np.zeros((9600, 1), np.float32)
    bursts.start(PlannedBurst(0, [wave_of(100.0, 0.1, RATE)], {0: [1.0]}))
    bursts.fade(Fade(1000, 1500))
    for begin in range(0, 9600, 480):
        bursts.add_to(mix[begin : begin + 480], begin, (0,))
    assert np.abs(mix[900:1000]).max() > 0.2
    assert not mix[2500:].any()
    assert above_1_khz_db(mix[:, 0]) < -60.0
    assert bursts.are_silent


@pytest.mark.parametrize("before", [0, 1])
def test_fade_does_not_end_bursts_that_start_after_it(before: int) -> None:
    wave, bursts, mix = wave_of(100.0, 0.1, RATE), Bursts(), np.zeros((1000, 1), np.float32)
    for _ in range(before):
        bursts.start(PlannedBurst(0, [wave], {0: [1.0]}))
    bursts.fade(Fade(0, 200))
    bursts.start(PlannedBurst(500, [wave], {0: [1.0]}))
    bursts.add_to(mix, 0, (0,))
    np.testing.assert_array_equal(mix[500:, 0], wave[:500])
    assert mix[:200].any() == bool(before)
    assert not mix[200:500].any()
