"""Kernels of `audio`: each compiled kernel gives the results of its plain twin."""

from __future__ import annotations

import numpy as np
from hypothesis import given, strategies as st
from scipy.signal import butter

from kernels import both, seeds, steady


@steady
@given(seed=seeds, n_sections=st.integers(1, 5), n_rows=st.integers(1, 3))
def test_kernels_filter_cut_sounds_alike(seed: int, n_sections: int, n_rows: int) -> None:
    """During the silence within the sound the filter's state decays; each cut continues from the state before."""
    rng = np.random.default_rng(seed)
    low, high = np.sort(np.exp(rng.uniform(np.log(20.0), np.log(20_000.0), 2))) * (1.0, 1.05)
    sections = butter(n_sections, [low, min(high, 23_000.0)], "bandpass", fs=48_000, output="sos")
    x = rng.standard_normal((n_rows, 9000))
    x[:, 3000:8000] = 0.0
    cuts = np.sort(rng.integers(0, 9000, 4))
    answers = []
    for kernel in both("audio.tactile.sections.through_sections"):
        state = np.zeros((n_sections, n_rows, 2))
        y = [kernel(sections, np.ascontiguousarray(part), state) for part in np.split(x, cuts, axis=1) if part.size]
        answers.append((np.concatenate(y, axis=1), state))
    (plain, plain_state), (compiled, compiled_state) = answers
    np.testing.assert_allclose(compiled, plain, atol=1e-11 * np.abs(plain).max())
    np.testing.assert_allclose(compiled_state, plain_state, atol=1e-11 * max(np.abs(plain).max(), 1.0))


@steady
@given(seed=seeds, n_known=st.sampled_from([0, 5, 23, 24, 1000]))
def test_kernels_follow_the_same_mean_and_maximum(seed: int, n_known: int) -> None:
    rng = np.random.default_rng(seed)
    energies = np.exp(rng.uniform(-20.0, 0.0, (2, 200))) * (rng.random((2, 200)) < 0.8)
    answers = []
    for kernel in both("audio.tactile.onsets.followed"):
        memory = np.array([[1e-5, 1e-3], [1e-6, 1e-2]])
        answers.append((kernel(energies, memory, n_known), memory))
    for one, other in zip(*answers, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-13)


@steady
@given(seed=seeds, n_known=st.sampled_from([0, 20, 1000]), spares=st.booleans(), rate=st.sampled_from([0.02, 0.2]))
def test_kernels_find_the_same_onsets_and_lower_the_bed_alike(
    seed: int, n_known: int, spares: bool, rate: float
) -> None:
    """Steps of noise with strokes of up to eight steps, cut in two."""
    rng = np.random.default_rng(seed)
    n, beyond = 300, 8
    strokes = np.convolve(rng.random(n + beyond) * (rng.random(n + beyond) < rate), np.ones(rng.integers(1, 9)))
    sound = 1e-4 * rng.uniform(0.2, 2.0, n + beyond) + 0.1 * strokes[: n + beyond]
    ticks = sound * rng.uniform(0.0, 1.0, n + beyond)
    follow = both("audio.tactile.onsets.followed")[0]
    steps = follow(np.array([sound, ticks]), np.array([[1e-4, 1e-3], [1e-4, 1e-3]]), n_known)
    answers = []
    for kernel in both("audio.tactile.onsets.onsets_among"):
        memory, found, shares = np.array([-24.0, 0.0, 0.0, np.inf, 0.0, 0.0, 0.0]), [], []
        for begin, end in ((0, 130), (130, n)):
            part = np.ascontiguousarray(steps[:, :, begin : end + beyond])
            onsets, lowered = kernel(part, end - begin, n_known + begin, memory, spares)
            found += [(begin + k, height, left) for k, height, left in onsets]
            shares.append(np.ones(end - begin) if lowered is None else lowered)
        answers.append((found, np.concatenate(shares), memory))
    (plain, plain_shares, plain_memory), (compiled, compiled_shares, compiled_memory) = answers
    assert [k for k, *_ in compiled] == [k for k, *_ in plain]
    np.testing.assert_allclose(np.array(compiled), np.array(plain), rtol=1e-13)
    np.testing.assert_allclose(compiled_shares, plain_shares, rtol=1e-13)
    np.testing.assert_allclose(compiled_memory, plain_memory, rtol=1e-13)
    assert (plain_shares <= 1.0).all()


@steady
@given(seed=seeds, start=st.integers(0, 10**9), n=st.integers(1, 9000))
def test_kernels_multiply_by_an_oscillator_alike(seed: int, start: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    cycles = float(rng.uniform(1e-4, 0.5))
    angle = 2.0 * np.pi * cycles * np.arange(4096)
    table = np.array([np.cos(angle), np.sin(angle)])
    z = rng.standard_normal((2, n))
    plain, compiled = (kernel(z[0], table, cycles, start) for kernel in both("audio.tactile.oscillator.multiplied"))
    np.testing.assert_allclose(compiled, plain, atol=1e-12)
    plain, compiled = (kernel(z, table, cycles, start) for kernel in both("audio.tactile.oscillator.summed"))
    np.testing.assert_allclose(compiled, plain, atol=1e-12)


@steady
@given(seed=seeds, step=st.integers(1, 500), n=st.integers(0, 20))
def test_kernels_find_the_same_step_energies_and_fade_alike(seed: int, step: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    x, gains = rng.standard_normal(step * n), rng.uniform(0.1, 5.0, n + 1)
    plain, compiled = (kernel(x, step) for kernel in both("audio.tactile.step_energies.mean_squares"))
    np.testing.assert_allclose(compiled, plain, rtol=1e-12)
    rising = np.arange(step) / step
    plain, compiled = (kernel(x, gains, rising) for kernel in both("audio.tactile.following.faded"))
    np.testing.assert_allclose(compiled, plain, rtol=1e-13)


@steady
@given(
    seed=seeds,
    n_bands=st.sampled_from([2, 3]),
    n_ahead=st.sampled_from([0, 6]),
    usual_db=st.sampled_from([float("nan"), 0.0, -9.0]),
)
def test_kernels_find_the_same_gains(seed: int, n_bands: int, n_ahead: int, usual_db: float) -> None:
    """Levels from silence to full scale, so that beds are within the free range, too strong, too weak and absent."""
    rng = np.random.default_rng(seed)
    sound = 10 ** rng.uniform(-2.0, 2.0, 200).cumsum().clip(-8.0, 0.0) * (rng.random(200) < 0.95)
    bands = sound * 10 ** rng.choice([0.0, 0.1, 1.0, -2.0, -5.0], (n_bands, 1)) * rng.uniform(0.9, 1.1, (n_bands, 200))
    window = rng.uniform(0.1, 1.0, 12 if n_ahead else 24)
    answers = []
    for kernel in both("audio.tactile.following.gains_of"):
        means = np.array([1e-3, 1e-4])
        answers.append((kernel(bands, window / window.sum(), n_ahead, usual_db, means), means))
    for one, other in zip(*answers, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-12)


@steady
@given(seed=seeds)
def test_kernels_modulate_by_a_low_component_alike(seed: int) -> None:
    """The depth is bounded if the mean is below its minimum, or below 0, as after an overshooting filter."""
    rng = np.random.default_rng(seed)
    bed, low = rng.standard_normal((2, 500))
    mean = rng.uniform(-0.1, 1.0, 500) * (rng.random(500) < 0.9)
    plain, compiled = (kernel(bed, low, mean, 0.7) for kernel in both("audio.tactile.roughness.modulated"))
    np.testing.assert_allclose(compiled, plain, rtol=1e-13)
