"""Invariants of conversion, loops and selection for random sounds."""

from __future__ import annotations

import numpy as np
from hypothesis import assume, given, settings, strategies as st

from scene2hap.audio import analysis
from scene2hap.audio.bands import split_bands
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.encoding import encoded
from scene2hap.audio.files import read_clip
from scene2hap.audio.loops import loop_pair
from scene2hap.audio.loops.seam_search import find_seam
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.seam import apply_seam
from scene2hap.audio.select import explain_choice
from scene2hap.audio.tactile.svf_bandpass import SvfBandpass
from scene2hap.haptics import Bands

RATE = 8000
quick = settings(max_examples=25)

seeds = st.integers(0, 2**32 - 1)


@st.composite
def sounds(draw: st.DrawFn, shortest_s: float = 0.3, longest_s: float = 1.5) -> np.ndarray:
    """Sounds with random partials, noise, clicks, offset and swell, each of which may be absent."""
    n = draw(st.integers(round(shortest_s * RATE), round(longest_s * RATE)))
    t = np.arange(n) / RATE
    rng = np.random.default_rng(draw(seeds))
    x = draw(st.sampled_from([0.0, 1e-3, 0.3])) * rng.standard_normal(n)
    for frequency_hz in draw(st.lists(st.floats(15.0, 3500.0), max_size=3)):
        x += rng.uniform(0.1, 1.0) * np.sin(2 * np.pi * (frequency_hz * t + rng.uniform()))
    if draw(st.booleans()):
        x[100 :: draw(st.integers(50, 4000))] += 1.0
    x *= 1.0 + draw(st.floats(-0.9, 3.0)) * t / t[-1]
    return x + draw(st.sampled_from([0.0, 0.4]))


@given(x=sounds(), cut=st.integers(0, 4000), seed=seeds)
@quick
def test_band_pass_does_not_depend_on_block_size(x: np.ndarray, cut: int, seed: int) -> None:
    block = x.astype(np.float32)
    whole = SvfBandpass().stream(RATE, ConversionContext()).process(block)
    stream = SvfBandpass().stream(RATE, ConversionContext())
    cuts = np.sort(np.random.default_rng(seed).integers(0, len(block), 5))
    parts = [stream.process(part) for part in np.split(block, [*cuts])]
    np.testing.assert_array_equal(np.concatenate(parts), whole)


@given(center_hz=st.floats(1.0, 3900.0), q=st.floats(0.1, 100.0), n=st.integers(0, 300))
@quick
def test_silence_in_is_silence_out(center_hz: float, q: float, n: int) -> None:
    out = SvfBandpass(center_hz, q).stream(RATE, ConversionContext()).process(np.zeros(n, np.float32))
    assert out.shape == (n,)
    assert not out.any()


@given(x=sounds())
@quick
def test_a_seam_lies_within_the_sound_and_its_wrap_is_a_step_of_the_sound(x: np.ndarray) -> None:
    seam = find_seam(x, RATE)
    assert seam.n_samples_needed <= len(x)
    assert seam.length >= 0.3 * len(x)
    assert abs(seam.tilt_db) <= 12.0
    loop = apply_seam(x, seam).astype(float)
    wrap = abs(loop[0] - loop[-1])
    # At the wrap the loop continues like the sound after the seam, scaled there by half of the tilt.
    end, mean = seam.start + seam.length, x.mean()
    before, behind = (10 ** (seam.tilt_db / 20 * (0.5 - ago / seam.length)) for ago in (1, 0))
    step = abs(behind * (x[end] - mean) - before * (x[end - 1] - mean))
    np.testing.assert_allclose(wrap, step, atol=1e-5)
    if seam.tilt_db == 0:
        assert wrap <= np.abs(np.diff(x)).max() + 1e-5


@given(frequency_hz=st.floats(20.0, 1000.0), phase=st.floats(0.0, 6.28))
@quick
def test_every_tone_wraps_within_a_degree(frequency_hz: float, phase: float) -> None:
    rate = 16_000
    seam = find_seam(np.sin(2 * np.pi * frequency_hz * np.arange(3 * rate) / rate + phase), rate)
    cycles = frequency_hz * seam.length / rate
    assert abs(cycles - round(cycles)) * 360 < 1.0


@given(x=sounds(), intensity=st.floats(0.01, 1.0))
@quick
def test_both_loops_of_any_sound_fit_each_other_and_full_scale(x: np.ndarray, intensity: float) -> None:
    assume(np.ptp(x) > 1e-2)
    loop = loop_pair(AudioClip(x, RATE), SvfBandpass(), ConversionContext(intensity=intensity))
    assert loop.audible.samples.shape == loop.tactile.samples.shape
    assert np.abs(loop.audible.samples).max() <= 10 ** (-1 / 20) + 1e-6
    assert np.abs(loop.tactile.samples).max() <= intensity * 10 ** (-6 / 20) + 1e-6
    assert loop.frequency_raw_hz <= RATE / 2


@given(
    n=st.integers(1, 3000),
    seed=seeds,
    edges=st.lists(st.floats(1.0, 5000.0), min_size=2, max_size=12, unique=True).map(sorted),
)
@quick
def test_bands_always_add_up(n: int, seed: int, edges: list[float]) -> None:
    x = np.random.default_rng(seed).uniform(-1, 1, n)
    parts = split_bands(x, RATE, Bands(tuple(edges)))
    assert np.abs(parts.sum(axis=0, dtype=float) - x).max() < 1e-5 * np.abs(x).max()
    # No band has more energy than the whole: the weights lie between 0 and 1.
    assert (np.sum(parts.astype(float) ** 2, axis=1) <= np.sum(x**2) * (1 + 1e-6)).all()


@given(x=sounds(), gain=st.floats(1e-3, 10.0))
@quick
def test_measures_do_not_depend_on_level(x: np.ndarray, gain: float) -> None:
    assume(np.ptp(x) > 1e-2)
    for measure in (analysis.dynamic_range_db, analysis.dominant_frequency_hz):
        np.testing.assert_allclose(measure(gain * x, RATE), measure(x, RATE), rtol=1e-5, atol=1e-6)
    a, b = (analysis.spectral_flatness(y, RATE, band_hz=(20, 3600)) for y in (x, gain * x))
    np.testing.assert_allclose(a, b, rtol=1e-5)
    assert 0.0 < a <= 1.0


@given(x=sounds(), before=st.integers(0, 3000), after=st.integers(0, 3000))
@quick
def test_silent_ends_hold_no_sound(x: np.ndarray, before: int, after: int) -> None:
    padded = np.concatenate([np.zeros(before), x - x.mean(), np.zeros(after)]).astype(np.float32)
    first, end = analysis.sounding_span(padded, RATE)
    assert 0 <= first <= end <= len(padded)
    left = padded[first:end]
    # Apart from a constant offset, the mean power of the removed samples is at least 40 dB below the squared peak.
    offset = np.median(padded)
    lost = np.sum((padded.astype(float) - offset) ** 2) - np.sum((left.astype(float) - offset) ** 2)
    if left.size:
        assert lost <= (len(padded) - len(left)) * 10 ** (-40 / 10) * np.abs(padded - offset).max() ** 2 + 1e-9


@given(picks=st.permutations([0, 1, 2]), levels=st.lists(st.floats(0.01, 1.0), min_size=3, max_size=3))
@settings(max_examples=10)
def test_selection_does_not_depend_on_order_or_level(picks: list[int], levels: list[float]) -> None:
    t = np.arange(3 * RATE) / RATE
    rng = np.random.default_rng(0)
    hum = np.sin(2 * np.pi * 60 * t)
    shapes = [hum + 0.1 * rng.standard_normal(len(t)), hum * np.exp(-3 * t), rng.standard_normal(len(t)) / 4]
    clips = [AudioClip(level * x, RATE) for level, x in zip(levels, shapes, strict=True)]
    choice = explain_choice([clips[i] for i in picks])
    assert choice.rows[picks.index(0)].verdict == "chosen"


@given(seed=seeds, n=st.integers(1, 500), channels=st.integers(1, 3))
@quick
def test_a_wav_file_comes_back_within_half_a_step(tmp_path_factory: object, seed: int, n: int, channels: int) -> None:
    path = tmp_path_factory.mktemp("wav") / "a.wav"
    x = np.random.default_rng(seed).uniform(-1, 1, (n, channels)).astype(np.float32)
    path.write_bytes(encoded(x, RATE))
    np.testing.assert_allclose(read_clip(path).samples, x.mean(axis=1, dtype=float), rtol=0, atol=2**-23)
