"""Kernels of `render`: each compiled kernel gives the results of its plain twin."""

from __future__ import annotations

from collections import deque

import numpy as np
import pytest
from hypothesis import given, strategies as st

from kernels import both, seeds, steady
from scene2hap.audio.clip import AudioClip
from scene2hap.haptics import Bands
from scene2hap.render.loop_bank import CELL, LoopBank
from scene2hap.render.mixer import GainChange
from scene2hap.render.tactile_mix import Gains
from scene2hap.render.upsampler import Upsampler


@steady
@given(seed=seeds, begin=st.one_of(st.integers(0, 10**6), st.integers(2**58, 2**60)))
def test_kernels_read_the_same_cells_of_a_loop(seed: int, begin: int) -> None:
    rng = np.random.default_rng(seed)
    length = int(rng.integers(1, 200))
    samples = rng.normal(size=(length + CELL, 3)).astype(np.float32)
    fade = np.linspace(0, 1, CELL, dtype=np.float32)
    numerator, denominator = rng.choice([(1, 1), (441, 440), (40001, 44100)])
    cells = []
    for loop_kind, read in zip(both("render.loop_bank.StoredLoop"), both("render.loop_bank.read"), strict=True):
        loop = loop_kind(samples, length, int(numerator), int(denominator), fade)
        cell = np.full((9, CELL), np.nan, dtype=np.float32)
        read([loop, None, loop], begin, cell)
        again = np.empty((3, CELL), dtype=np.float32)
        read([loop], begin, again)
        np.testing.assert_array_equal(cell, np.concatenate([again, np.zeros_like(again), again]))
        cells.append(cell)
        read([], begin, np.empty((0, CELL), dtype=np.float32))
    np.testing.assert_allclose(cells[1], cells[0], atol=1e-6)


@pytest.mark.parametrize("shape", [(1, CELL), (3, CELL - 1)], ids=["bands", "samples"])
def test_kernels_refuse_to_write_a_loop_beside_its_block(shape: tuple[int, int]) -> None:
    samples, fade = np.ones((100 + CELL, 3), dtype=np.float32), np.ones(CELL, dtype=np.float32)
    for loop_kind, read in zip(both("render.loop_bank.StoredLoop"), both("render.loop_bank.read"), strict=True):
        with pytest.raises((AssertionError, ValueError)):
            read([loop_kind(samples, 100, 1, 1, fade)], 0, np.empty(shape, dtype=np.float32))


@steady
@given(seed=seeds, begin=st.integers(-100, 10**6), speed=st.floats(-2, 8))
def test_kernels_read_alike_between_samples(seed: int, begin: int, speed: float) -> None:
    rng = np.random.default_rng(seed)
    length, below = int(rng.integers(1, 200)), begin + np.floor(speed * np.arange(CELL)).astype(np.intp)
    samples = rng.normal(size=(length + CELL, 3)).astype(np.float32)
    weights = rng.normal(size=(4, 2 * CELL)).astype(np.float32)[:, 5 : 5 + CELL]
    found = []
    for loop_kind, read in zip(both("render.loop_bank.StoredLoop"), both("render.loop_bank.read_between"), strict=True):
        loop = loop_kind(samples, length, 441, 440, np.linspace(0, 1, CELL, dtype=np.float32))
        out = np.full((CELL, 3), np.nan, dtype=np.float32)
        read(loop, below, weights, np.empty((3, CELL), dtype=np.float32), out)
        found.append(out)
    np.testing.assert_allclose(found[1], found[0], atol=1e-5)


@steady
@given(seed=seeds)
def test_kernels_ramp_gains_alike(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n_loops, n_bands, n_hands, n_slots, ramp = 5, 4, 2, 6, 80
    rise = np.concatenate([np.zeros(CELL), np.linspace(0, 1, ramp), np.ones(CELL)]).astype(np.float32)
    n_rows = n_loops * n_bands
    products = [
        kind(n_rows, n_rows + n_bands, n_slots, n_hands, rise) for kind in both("render.tactile_mix.RampedProduct")
    ]
    held, begin = [(0, 0)], 0
    for _ in range(8):
        n_used = n_bands * int(rng.integers(0, n_loops + 1))
        samples, is_new = rng.normal(size=(n_rows, CELL)), rng.random() < 0.7 and len(held) < n_slots
        begin += CELL
        if is_new:
            held.append((len(held), begin + int(rng.integers(0, CELL))))
        values = rng.normal(size=(n_hands, 2, n_bands)).astype(np.float32)
        loops = rng.choice(n_loops + 1, 2, replace=False).tolist()
        first = int(rng.choice([0, 7]))
        mixes = []
        for product in products:
            product.loops[:] = samples
            if is_new:
                product.set(held[-1][0], values, loops, n_used)
            x = np.zeros((n_hands, CELL), dtype=np.float32)
            slots, starts = ([pair[k] for pair in held[-3:]] for k in (0, 1))
            starts = [max(start, begin - ramp) for start in starts]
            product.mix(x, n_used, slots, starts, begin, first)
            mixes.append(x)
        np.testing.assert_allclose(mixes[1], mixes[0], atol=1e-5)
        assert (mixes[1][:, :first] == 0).all()


def clips(rng: np.random.Generator, n: int) -> list[AudioClip]:
    return [AudioClip(rng.uniform(-0.4, 0.4, int(rng.integers(300, 900))).astype(np.float32), 8000) for _ in range(n)]


@pytest.mark.parametrize("rate_hz", [48000, 44100, 8000])
@pytest.mark.parametrize("is_skipping", [True, False])
def test_kernels_mix_alike_under_changing_gains(rate_hz: int, is_skipping: bool) -> None:
    rng = np.random.default_rng(rate_hz)
    bank, incoming, playheads, mixes = LoopBank(clips(rng, 4), Bands.dominant(), 8000), [], [], []
    for mix_kind, kind in zip(both("render.tactile_mix.TactileMix"), both("render.mixer.Playhead"), strict=True):
        upsampler = Upsampler(8000, rate_hz, 2)
        # Few slots, so that some changes of gain have to wait.
        mixes.append(mix_kind(bank, 2, 12, upsampler.cell, is_skipping=is_skipping))
        incoming.append(deque[GainChange]())
        playheads.append(kind(mixes[-1], upsampler, incoming[-1], (8000, rate_hz)))
    for _ in range(300):
        for _ in range(int(rng.choice([0, 1, 3]))):
            loops = sorted(rng.choice(4, int(rng.integers(0, 5)), replace=False).tolist())
            values = rng.uniform(0, 1.2, (2, len(loops), 1)).astype(np.float32)
            gains = Gains.of(values, loops, loops if is_skipping else range(4))
            assert gains is not None
            at_frame = playheads[0].position + int(rng.choice([-50, 0, 20, 300, 10**25]))
            for queue in incoming:
                if queue and queue[-1].at_frame > 10**20:
                    queue.pop()
                queue.append(GainChange(at_frame, gains))
        told = np.full((int(rng.integers(0, 300)), 2), np.nan, dtype=np.float32)
        compiled = np.full_like(told, np.nan)
        playheads[0].render_into(told)
        playheads[1].render_into(compiled)
        np.testing.assert_allclose(compiled, told, atol=2e-6)
    counts = [(mix.n_cells, mix.n_rows_mixed, mix.n_merged) for mix in mixes]
    assert counts[0] == counts[1]
    assert counts[0][0] > 100
    assert counts[0][2] > 0
    assert playheads[0].position == playheads[1].position


@pytest.mark.parametrize(("up", "down"), [(6, 1), (441, 80), (1, 1)])
def test_kernels_upsample_cells_alike(up: int, down: int) -> None:
    rng = np.random.default_rng(up)
    h = rng.normal(size=14 * up).astype(np.float32)
    x = rng.normal(size=(2, 13 + CELL)).astype(np.float32)
    n_frames = -(-CELL * up // down)
    plain, twin = (kind(h, up, down, n_frames, ()) for kind in both("render.upsampler.PolyphaseFilter"))
    for offset in range(0, down, 7):
        told, compiled = np.empty((2, 2, n_frames), dtype=np.float32)
        plain.fill(told, x, offset)
        twin.fill(compiled, x, offset)
        np.testing.assert_allclose(compiled, told, atol=1e-5)


@steady
@given(seed=seeds)
def test_limiter_kernels_agree(seed: int) -> None:
    mix = np.random.default_rng(seed).normal(size=(2, 50)).astype(np.float32)
    told, compiled = mix.copy(), mix.copy()
    for limit, block in zip(both("render.limiter.limit_in_place"), (told, compiled), strict=True):
        limit(block, np.empty_like(block), 0.7)
    np.testing.assert_allclose(compiled, told, atol=1e-6)


@steady
@given(seed=seeds)
def test_kernels_reduce_loud_mixes_alike(seed: int) -> None:
    rng = np.random.default_rng(seed)
    held = np.zeros((2, 2, 2))
    for _ in range(5):
        mix = (rng.uniform(0, 3) * rng.normal(size=(2, rng.integers(0, 60)))).astype(np.float32)
        told, compiled = mix.copy(), mix.copy()
        for turn_down, block, u in zip(both("render.limiter.turn_down_in_place"), (told, compiled), held, strict=True):
            frames = np.arange(1, block.shape[1] + 1)
            turn_down(block, u, np.empty((2, *block.shape)), 0.7, np.stack([0.99**frames, 0.95**frames]))
        np.testing.assert_allclose(compiled, told, atol=1e-6)
        np.testing.assert_allclose(held[1], held[0], atol=1e-9)
