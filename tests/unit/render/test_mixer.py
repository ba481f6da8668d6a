"""The mixer against a slow one written out sample by sample."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from scene2hap import AudioClip, Bands
from scene2hap.render.limiter import THRESHOLD, soft_limit
from scene2hap.render.loop_bank import LoopBank
from scene2hap.render.mixer import Mixer

RATE = 8000
RAMP = 80


def tone(frequency_hz: float, n: int, amplitude: float = 0.3) -> AudioClip:
    samples = amplitude * np.sin(2 * np.pi * frequency_hz * np.arange(n) / RATE)
    return AudioClip(samples.astype(np.float32), RATE)


def bank() -> LoopBank:
    return LoopBank([tone(100, 800), tone(250, 320), tone(40, 1000)], Bands.dominant(), RATE)


def slow_mix(changes: list[tuple[int, NDArray[np.float32]]], n_frames: int, n_hands: int) -> NDArray[np.float64]:
    """One frame at a time: every change of gain on its own raised cosine, then sources, hands, limiter."""
    loops = [clip.samples.astype(float) for clip in (tone(100, 800), tone(250, 320), tone(40, 1000))]
    out = np.zeros((n_frames, n_hands))
    for t in range(n_frames):
        gains = np.zeros((n_hands, 3))
        before = np.zeros((n_hands, 3))
        for start, target in changes:
            phase = min(max((t - start + 1) / RAMP, 0.0), 1.0)
            gains += (target - before) * (0.5 - 0.5 * math.cos(math.pi * phase))
            before = target.astype(float)
        for hand in range(n_hands):
            x = sum(gains[hand, s] * loop[t % len(loop)] for s, loop in enumerate(loops))
            if abs(x) > 10 ** (-3 / 20):
                rest = 1 - 10 ** (-3 / 20)
                x = math.copysign(10 ** (-3 / 20) + rest * math.tanh((abs(x) - 10 ** (-3 / 20)) / rest), x)
            out[t, hand] = x
    return out


CHANGES = st.lists(
    st.tuples(st.integers(0, 900), st.lists(st.floats(0.0, 4.0, width=32), min_size=6, max_size=6)), max_size=6
)


@settings(derandomize=True, deadline=None, max_examples=40)
@given(CHANGES, st.lists(st.integers(1, 4096), min_size=1, max_size=8))
def test_equals_the_slow_mixer_for_any_blocks(changes: list[tuple[int, list[float]]], blocks: list[int]) -> None:
    stamped = [(start, np.array(gains, dtype=np.float32).reshape(2, 3)) for start, gains in sorted(changes)]
    mixer = Mixer(bank(), 2, RAMP)
    for start, gains in stamped:
        mixer.set_gains(gains, start)
    n_frames = 1200
    parts, done = [], 0
    while done < n_frames:
        n = min(blocks[len(parts) % len(blocks)], n_frames - done)
        parts.append(mixer.render(n))
        done += n
    out = np.concatenate(parts)
    assert out.dtype == np.float32
    np.testing.assert_allclose(out, slow_mix(stamped, n_frames, 2), atol=1e-6)


def test_silence_before_the_first_gain() -> None:
    assert not Mixer(bank(), 2, RAMP).render(5000).any()


def test_a_late_change_starts_with_the_next_frame() -> None:
    mixer = Mixer(bank(), 1, RAMP)
    mixer.render(500)
    mixer.set_gains(np.ones((1, 3), dtype=np.float32), 100)
    out = mixer.render(200)[:, 0]
    assert np.abs(np.diff(out)).max() < 0.15
    assert np.abs(out[:3]).max() < 0.01


def test_position_counts_frames() -> None:
    mixer = Mixer(bank(), 1, RAMP)
    for n in (1, 128, 4096):
        mixer.render(n)
    assert mixer.position == 4225


@settings(derandomize=True, deadline=None, max_examples=200)
@given(st.lists(st.floats(-1e6, 1e6, width=32), min_size=1, max_size=50))
def test_limiter_stays_within_full_scale_and_keeps_order(values: list[float]) -> None:
    x = np.sort(np.array(values, dtype=np.float32))
    y = soft_limit(x)
    assert np.abs(y).max() <= 1.0
    assert (np.diff(y) >= 0).all()


def test_limiter_leaves_quiet_samples_untouched() -> None:
    x = np.linspace(-THRESHOLD, THRESHOLD, 1001).astype(np.float32) * np.float32(0.999999)
    np.testing.assert_array_equal(soft_limit(np.append(x, np.float32(2.0)))[:-1], x)


def test_limiter_has_no_corner() -> None:
    x = np.linspace(0.6, 0.9, 30001)
    slope = np.diff(soft_limit(x.astype(np.float64))) / np.diff(x)  # type: ignore[arg-type]
    assert np.abs(np.diff(slope)).max() < 0.01


def test_loops_wrap_by_themselves() -> None:
    short = LoopBank([tone(100, 80), tone(250, 32)], Bands.dominant(), RATE)
    read = short.read(70, 200)
    for row, (n, clip) in enumerate(((80, tone(100, 80)), (32, tone(250, 32)))):
        np.testing.assert_array_equal(read[row], clip.samples[(70 + np.arange(200)) % n])


@pytest.mark.parametrize("rate", [2000, 6000, 11025, 48000])
def test_a_loop_of_another_rate_keeps_its_sound(rate: int) -> None:
    # 80 Hz over 0.5 s: 40 whole cycles at any rate.
    resampled = LoopBank([tone(80, 4000)], Bands.dominant(), rate)
    n = resampled.length(0)
    assert n == round(0.5 * rate)
    t = np.arange(n) / n * 0.5
    np.testing.assert_allclose(resampled.read(0, n)[0], 0.3 * np.sin(2 * np.pi * 80 * t), atol=1e-5)


def test_bands_of_a_loop_are_rows_that_add_up() -> None:
    clip = AudioClip(np.random.default_rng(1).uniform(-0.5, 0.5, 4000).astype(np.float32), RATE)
    bands = Bands.third_octaves()
    read = LoopBank([clip], bands, RATE).read(0, 4000)
    assert read.shape == (20, 4000)
    np.testing.assert_allclose(read.sum(axis=0), clip.samples, atol=1e-5)
