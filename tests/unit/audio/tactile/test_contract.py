"""What every converter promises, held to by each of them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scene2hap.audio.clip import Samples
from scene2hap.audio.protocol import ConversionContext, TactileConverter
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile

CONTEXTS = {
    "told nothing": ConversionContext(),
    "told neighbours": ConversionContext(intensity=0.4, neighbours_hz=(170.0, 210.0)),
    "told all": ConversionContext(ActuatorProfile("lra", 100.0, 400.0, 175.0, 8.0), 0.5, (200.0,), 187.0, 230.0),
}
EVERY = [(kind, name) for kind in CONVERTERS.kinds() for name in CONTEXTS]
each = pytest.mark.parametrize(("kind", "context"), EVERY)


def converter(kind: str) -> TactileConverter:
    built = CONVERTERS.build(kind)
    assert isinstance(built, TactileConverter)
    return built


def machine(rate: int, seconds: float = 1.6) -> Samples:
    """A hum whose pitch jumps half-way, with noise; within full scale."""
    t = np.arange(round(rate * seconds)) / rate
    hum = np.where(t < 0.8, np.sin(2 * np.pi * 187 * t), np.sin(2 * np.pi * 120 * t))
    noise = np.random.default_rng(11).uniform(-1, 1, t.size)
    return (0.5 * hum + 0.2 * np.sin(2 * np.pi * 41 * t) + 0.3 * noise).astype(np.float32)


def converted(kind: str, context: str, x: Samples, rate: int, cuts: list[int] | None = None) -> Samples:
    stream = converter(kind).stream(rate, CONTEXTS[context])
    parts = [stream.process(block) for block in np.split(x, cuts or [])]
    return np.concatenate([*parts, stream.finish()])


@each
@pytest.mark.parametrize("seed", [0, 1])
def test_blocks_of_any_size_give_the_same_bits(kind: str, context: str, seed: int) -> None:
    rate = 8000
    x = machine(rate)
    sizes = np.random.default_rng(seed).choice([0, 1, 2, 3, 17, 128, 1000, 4096], 400)
    cuts = [int(cut) for cut in np.cumsum(sizes) if cut < len(x)]
    np.testing.assert_array_equal(
        converted(kind, context, x, rate, cuts).view(np.uint32), converted(kind, context, x, rate).view(np.uint32)
    )


@pytest.mark.parametrize("kind", CONVERTERS.kinds())
@settings(max_examples=15, deadline=None)
@given(sizes=st.lists(st.integers(1, 4096), min_size=1, max_size=12), seed=st.integers(0, 2**16))
def test_drawn_blocks_give_the_same_bits(kind: str, sizes: list[int], seed: int) -> None:
    x = np.random.default_rng(seed).uniform(-1, 1, sum(sizes)).astype(np.float32)
    cuts = [int(cut) for cut in np.cumsum(sizes)[:-1]]
    np.testing.assert_array_equal(
        converted(kind, "told neighbours", x, 8000, cuts), converted(kind, "told neighbours", x, 8000)
    )


@each
@pytest.mark.parametrize("rate", [8000, 16_000, 44_100, 48_000, 192_000])
def test_any_rate_gives_as_many_samples_within_full_scale(kind: str, context: str, rate: int) -> None:
    x = machine(rate, 0.3)
    y = converted(kind, context, x, rate)
    assert y.dtype == np.float32
    assert len(y) == len(x)
    assert np.abs(y).max() <= 1.0
    assert y.any()


@each
def test_the_loudest_sound_stays_within_full_scale(kind: str, context: str) -> None:
    square = np.sign(np.sin(2 * np.pi * 200 * np.arange(16_000) / 8000)).astype(np.float32)
    assert np.abs(converted(kind, context, 3 * square, 8000)).max() <= 1.0


@each
def test_silence_stays_silence(kind: str, context: str) -> None:
    assert not converted(kind, context, np.zeros(12_000, np.float32), 8000).any()


@each
def test_nothing_gives_nothing(kind: str, context: str) -> None:
    assert converted(kind, context, np.zeros(0, np.float32), 8000).size == 0


@each
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_refused_and_leaves_no_trace(kind: str, context: str, bad: float) -> None:
    x = machine(8000, 0.2)
    wrong = x.copy()
    wrong[12] = bad
    stream = converter(kind).stream(8000, CONTEXTS[context])
    with pytest.raises(AudioError, match="sample 12 of the block"):
        stream.process(wrong)
    after = np.concatenate([stream.process(x), stream.finish()])
    np.testing.assert_array_equal(after, converted(kind, context, x, 8000))


@pytest.mark.parametrize("kind", CONVERTERS.kinds())
def test_two_channels_are_refused(kind: str) -> None:
    with pytest.raises(AudioError, match="one channel"):
        converter(kind).stream(8000, ConversionContext()).process(np.zeros((10, 2), np.float32))


@pytest.mark.parametrize("kind", CONVERTERS.kinds())
def test_streams_share_nothing(kind: str) -> None:
    x = machine(8000, 0.4)
    one = converter(kind)
    first = one.stream(8000, ConversionContext())
    first.process(x)
    second = one.stream(8000, ConversionContext())
    np.testing.assert_array_equal(
        np.concatenate([second.process(x), second.finish()]), converted(kind, "told nothing", x, 8000)
    )
