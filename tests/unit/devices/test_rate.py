"""Rate conversion block by block, against sines in closed form; and pacing by the wall clock."""

import time

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import firwin, kaiserord

from scene2hap.devices.due_frames import FrameClock
from scene2hap.devices.rate import RateConverter

RATES = [(48000, 4000), (48000, 2000), (44100, 4000), (48000, 8000), (8000, 44100), (48000, 3999), (4000, 8000)]


def converted(
    rate_in: int, rate_out: int, hz: float, sizes: list[int], seconds: float = 0.3
) -> tuple[RateConverter, NDArray[np.float32]]:
    converter = RateConverter(rate_in, rate_out, 2)
    rng = np.random.default_rng(0)
    position, out = 0, []
    while position < seconds * rate_in:
        n_out = int(rng.choice(sizes))
        n_in = converter.needed(n_out)
        phase = 2 * np.pi * hz * np.arange(position, position + n_in) / rate_in
        out.append(converter.convert(np.stack([np.sin(phase), np.cos(phase)], axis=1).astype(np.float32), n_out))
        assert out[-1].shape == (n_out, 2)
        position += n_in
    return converter, np.concatenate(out)


@pytest.mark.parametrize(("rate_in", "rate_out"), RATES)
@pytest.mark.parametrize("hz", [60.0, 500.0])
def test_rate_converter_passes_the_tactile_band_unchanged(rate_in: int, rate_out: int, hz: float) -> None:
    converter, out = converted(rate_in, rate_out, hz, [1, 7, 16, 64])
    phase = 2 * np.pi * hz * (np.arange(len(out)) / rate_out - converter.latency_s)
    settled = int(2 * converter.latency_s * rate_out) + 1
    # The tolerance covers 80 dB of ripple and single precision.
    np.testing.assert_allclose(out[settled:, 0], np.sin(phase[settled:]), atol=3e-4)
    np.testing.assert_allclose(out[settled:, 1], np.cos(phase[settled:]), atol=3e-4)


@pytest.mark.parametrize(("rate_in", "rate_out"), RATES)
def test_block_size_is_irrelevant(rate_in: int, rate_out: int) -> None:
    one = converted(rate_in, rate_out, 200.0, [64])[1]
    many = converted(rate_in, rate_out, 200.0, [0, 1, 3, 17])[1]
    n = min(len(one), len(many))
    np.testing.assert_array_equal(one[:n], many[:n])


@pytest.mark.parametrize("hz", [2100.0, 3900.0, 7900.0, 12000.0])
def test_rate_converter_removes_frequencies_that_would_alias(hz: float) -> None:
    out = converted(48000, 4000, hz, [16])[1]
    assert np.abs(out[100:]).max() < 10 ** (-79 / 20)


def test_equal_rates_leave_samples_unchanged() -> None:
    converter = RateConverter(4000, 4000, 1)
    block = np.random.default_rng(1).uniform(-1, 1, (10, 1)).astype(np.float32)
    assert converter.needed(10) == 10
    assert converter.latency_s == 0
    np.testing.assert_array_equal(converter.convert(block, 10), block)


def test_filter_equals_that_of_scipy() -> None:
    n_taps, beta = kaiserord(80, 1000 / 24000)
    pulse = np.zeros((300, 1), dtype=np.float32)
    answers = []
    for delay in range(12):  # each pass gives every twelfth tap
        converter = RateConverter(48000, 4000, 1)
        pulse[:] = 0
        pulse[delay] = 1
        answers.append(converter.convert(pulse[: converter.needed(24)], 24)[:, 0])
    taps = np.stack(answers, axis=1)[:, ::-1].reshape(-1)[11 : 11 + n_taps]
    assert converter.latency_s == pytest.approx((n_taps - 1) / 2 / 48000)
    np.testing.assert_allclose(taps, firwin(n_taps, 1500, window=("kaiser", beta), fs=48000), atol=1e-6)


def test_rate_converter_does_not_drift_over_days() -> None:
    converter = RateConverter(44100, 4000, 1)
    taken = 0
    for _ in range(30):
        n = converter.needed(1000)
        taken += n
        converter.convert(np.zeros((n, 1), dtype=np.float32), 1000)
    assert abs(taken - 30 * 1000 * 44100 / 4000) < 12
    assert converter._next_out < 2000


def test_pace_counts_frames() -> None:
    pace = FrameClock(1000, max_lag_s=0.5)
    pace.restart(10.0)
    assert pace.due(10.0) == 0
    assert pace.due(10.1001) == 100
    pace.take(60)
    assert pace.due(10.1001) == 40


def test_pace_waits_until_frames_are_due(monkeypatch: pytest.MonkeyPatch) -> None:
    now_s = 10.0

    def sleep(seconds: float) -> None:
        nonlocal now_s
        now_s += seconds

    monkeypatch.setattr(time, "monotonic", lambda: now_s)
    monkeypatch.setattr(time, "sleep", sleep)
    pace = FrameClock(1024)
    pace.restart(now_s)
    assert pace.wait(32, 0.0) == 0
    assert pace.wait(32, 1.0) == 32
    assert now_s == 10.0 + 32 / 1024


def test_pace_drops_a_backlog_above_its_limit() -> None:
    pace = FrameClock(1000, max_lag_s=0.5)
    pace.restart(0.0)
    assert pace.due(3600.0) == 500
    pace.take(500)
    assert pace.due(3600.0) == 0
    assert pace.due(3600.0101) == 10
