"""Loop-back latency: sweeps in recordings of known delay, level, polarity and noise; the clock of recorded blocks."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from scipy.signal import butter, chirp, sosfilt

from scene2hap.devices import loopback_latency
from scene2hap.devices.loopback_latency import (
    FOUND_FROM,
    LONGEST_S,
    Recording,
    correlation_peak,
    find_input,
    measure_latency,
)
from scene2hap.devices.portaudio import Card
from scene2hap.errors import DeviceNotFound

RATE = 4000
SWEEP = 0.1 * chirp(np.arange(2 * RATE) / RATE, 40.0, 2.0, 400.0, method="log")
POWER = float(np.mean(SWEEP**2))
ASKED_AT_S = 100.0


def noise(n: int, rms: float, seed: int) -> NDArray[np.float64]:
    return rms * np.random.default_rng(seed).standard_normal(n)


def placed(frame: int, gain: float, n: int) -> NDArray[np.float64]:
    x = np.zeros(n)
    x[frame : frame + len(SWEEP)] = gain * SWEEP
    return x


def take(*channels: NDArray[np.float64], block: int = 40, burst: int = 1, lost: int = 0) -> Recording:
    """A recording of blocks from 99.5 s on, delivered `burst` at a time; `lost` frames are missing after a second."""
    samples = np.stack(channels, axis=1).astype(np.float32)
    n_heard = np.arange(block, len(samples) + 1, block)
    at_s = 99.5 + (n_heard + np.where(n_heard > RATE, lost, 0)) / RATE
    last_of_burst = np.minimum(np.arange(len(n_heard)) // burst * burst + burst, len(n_heard)) - 1
    return Recording("line", RATE, samples[: n_heard[-1]], at_s[last_of_burst], n_heard, block / RATE)


@settings(max_examples=60)
@given(
    frame=st.integers(0, 4000),
    gain=st.floats(1e-4, 10.0),
    sign=st.sampled_from([-1.0, 1.0]),
    offset=st.floats(-0.5, 0.5),
    seed=st.integers(0, 2**32 - 1),
)
def test_sweep_gives_delay_level_and_polarity_of_a_quiet_line(
    frame: int, gain: float, sign: float, offset: float, seed: int
) -> None:
    quiet = noise(12000, 0.02 * gain * POWER**0.5, seed)
    match = correlation_peak(placed(frame, sign * gain, 12000) + quiet, SWEEP)
    assert match.frame == frame
    assert match.correlation == pytest.approx(sign, abs=2e-3)
    assert match.gain == pytest.approx(gain, rel=1e-2)


@settings(max_examples=40)
@given(frame=st.integers(0, 4000), seed=st.integers(0, 2**32 - 1))
def test_sweep_is_found_under_louder_noise(frame: int, seed: int) -> None:
    """White noise of four times the sweep's power gives a correlation of 1 / sqrt(1 + 4)."""
    match = correlation_peak(placed(frame, 1.0, 12000) + noise(12000, 2.0 * POWER**0.5, seed), SWEEP)
    assert abs(match.frame - frame) <= 2
    assert match.correlation == pytest.approx(5**-0.5, abs=0.06)


@given(
    x=st.lists(st.integers(-9, 9), min_size=1, max_size=30),
    p=st.lists(st.integers(-9, 9), min_size=1, max_size=8).filter(any),
)
def test_find_returns_the_largest_of_all_correlations(x: list[int], p: list[int]) -> None:
    match = correlation_peak(np.array(x, dtype=float), np.array(p, dtype=float))
    assert -1.0 <= match.correlation <= 1.0
    pieces = [np.array(x[k : k + len(p)]) for k in range(len(x) - len(p) + 1)]
    own = np.linalg.norm(p)
    r = [piece @ p / (own * np.linalg.norm(piece)) if piece.any() else 0.0 for piece in pieces]
    assert abs(match.correlation) == pytest.approx(max(map(abs, r), default=0.0), abs=1e-6)
    if r:
        assert match.correlation == pytest.approx(r[match.frame], abs=1e-6)


@pytest.mark.parametrize("seed", range(8))
def test_noise_in_the_band_of_the_sweep_is_not_detected(seed: int) -> None:
    band = sosfilt(butter(4, (40, 400), "bandpass", fs=RATE, output="sos"), noise(12000, 1.0, seed))
    assert abs(correlation_peak(band, SWEEP).correlation) < 0.15 < FOUND_FROM


@pytest.mark.parametrize("hz", [50.0, 60.0, 100.0, 120.0])
def test_hum_is_not_detected_as_a_sweep(hz: float) -> None:
    hum = np.sin(2 * np.pi * hz * np.arange(12000) / RATE)
    assert abs(correlation_peak(hum, SWEEP).correlation) < 0.1 < FOUND_FROM


def test_silence_and_short_recordings_contain_no_sweep() -> None:
    assert (
        correlation_peak(np.zeros(12000), SWEEP)
        == correlation_peak(SWEEP[:-1], SWEEP)
        == loopback_latency.CorrelationPeak(0, 0.0, 0.0)
    )
    after_a_click = np.zeros(20000)
    after_a_click[:100] = 1.0
    assert abs(correlation_peak(after_a_click, SWEEP).correlation) < FOUND_FROM


@pytest.mark.parametrize("burst", [1, 3, 20])
def test_late_blocks_do_not_change_the_arrival_time(burst: int) -> None:
    clock = take(np.zeros(16000), burst=burst)
    assert [clock.time_of(frame) for frame in (0, 4001, 15000)] == pytest.approx([99.5, 100.50025, 103.25])


def test_lost_frames_delay_only_later_frames() -> None:
    clock = take(np.zeros(16000), lost=400)
    assert clock.time_of(2000) == pytest.approx(100.0)
    assert clock.time_of(8000) == pytest.approx(101.5 + 0.1)


def test_clock_converts_a_time_to_its_frame() -> None:
    clock = take(np.zeros(16000), burst=7)
    assert [clock.frame_at(at_s) for at_s in (99.0, 99.50513, 102.00013, 1e6)] == [0, 20, 10000, 16000]


@settings(max_examples=40)
@given(delay=st.integers(0, RATE), block=st.integers(1, 150), seed=st.integers(0, 2**32 - 1))
def test_arrival_is_measured_on_the_clock_of_the_request(delay: int, block: int, seed: int) -> None:
    asked = RATE // 2
    heard = placed(asked + delay, -0.5, 20000) + noise(20000, 1e-4, seed)
    found = measure_latency(take(noise(20000, 1e-3, seed + 1), heard, block=block, burst=5), ASKED_AT_S, SWEEP)
    assert found.latency_s is not None
    # The last block of each burst is on time.
    assert found.latency_s == pytest.approx(delay / RATE, abs=1e-6)
    assert found.uncertainty_s == block / RATE
    assert found.channel == 2
    assert found.correlation < -0.99
    assert found.gain_db == pytest.approx(20 * np.log10(0.5), abs=0.01)


def test_sweeps_outside_the_search_window_are_ignored() -> None:
    early, late = placed(0, 1.0, 40000), placed(2000 + round((LONGEST_S + 0.5) * RATE), 1.0, 40000)
    for other in (early, late, np.zeros(40000)):
        found = measure_latency(take(other + noise(40000, 1e-6, 3)), ASKED_AT_S, SWEEP)
        assert found.latency_s is None
        assert found.gain_db is None
        assert abs(found.correlation) < FOUND_FROM


def test_sweeps_of_several_hands_are_distinguished_on_one_wire() -> None:
    both = placed(2000 + 400, 1.0, 40000) + placed(12000 + 480, 1.0, 40000)
    heard = take(both)
    left, right = (measure_latency(heard, at_s, SWEEP).latency_s for at_s in (ASKED_AT_S, ASKED_AT_S + 2.5))
    assert (left, right) == pytest.approx((0.1, 0.12))


def listed(monkeypatch: pytest.MonkeyPatch, *names: str, default: int) -> None:
    """Replace PortAudio's list of devices; "phones" have no input."""
    devices = [
        {"name": name, "hostapi": 0, "max_input_channels": 0 if name == "phones" else 2, "default_samplerate": 44100.0}
        for name in names
    ]
    sounddevice = SimpleNamespace(
        default=SimpleNamespace(device=(default, 0)),
        query_hostapis=lambda: [{"name": "ALSA", "default_input_device": default, "default_output_device": 0}],
        query_devices=lambda: devices,
        _terminate=lambda: None,
        _initialize=lambda: None,
    )
    monkeypatch.setattr("scene2hap.devices.portaudio._sounddevice", lambda: sounddevice)


@pytest.mark.parametrize("name", ["Loopback Audio", "loop-back", "Monitor of Speakers", "Stereo Mix (Realtek)"])
def test_find_input_prefers_a_loop_back_device_to_the_default(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    listed(monkeypatch, "phones", "Microphone", name, default=1)
    assert find_input(None) == Card(2, name, "ALSA", 2, 44100)
    assert find_input("micro").index == find_input(1).index == 1
    listed(monkeypatch, "phones", "Microphone", "Line", default=2)
    assert find_input(None).name == "Line"


@pytest.mark.parametrize(("device", "said"), [(None, "no default input"), (0, "no input 0"), ("x", "no input 'x'")])
def test_missing_input_is_refused(monkeypatch: pytest.MonkeyPatch, device: Any, said: str) -> None:
    listed(monkeypatch, "phones", "Microphone", default=-1)
    with pytest.raises(DeviceNotFound, match=rf"{said} among the sound cards. Known: 1: 'Microphone' \(ALSA, 2 "):
        find_input(device)
