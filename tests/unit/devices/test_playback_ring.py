"""The ring buffer from which a sound card's callback copies samples."""

import gc
import tracemalloc
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray

from garbage import only_new_garbage
from scene2hap.devices.playback_ring import PlaybackRing

N_FADE = 40


@pytest.fixture(autouse=True)
def _only_new_garbage() -> Iterator[None]:
    with only_new_garbage():
        yield


def tone(n: int, begin: int = 0) -> NDArray[np.float32]:
    x = np.sin(2 * np.pi * np.arange(begin, begin + n) / 400)
    return np.stack([x, 0.5 * x], axis=1).astype(np.float32)


def played(ring: PlaybackRing, n: int) -> NDArray[np.float32]:
    out = np.full((n, 2), np.nan, dtype=np.float32)
    ring.play(out)
    return out


@settings(max_examples=60)
@given(st.lists(st.tuples(st.integers(0, 300), st.integers(1, 300)), min_size=1, max_size=60))
def test_ring_plays_written_samples_in_order(steps: list[tuple[int, int]]) -> None:
    ring = PlaybackRing(700, 2, 1)
    written, out = 0, []
    for n_write, n_play in steps:
        n_write = min(n_write, 700 - ring.level)
        ring.write(tone(n_write, written))
        written += n_write
        if ring.level >= n_play:
            out.append(played(ring, n_play))
    heard = np.concatenate([np.zeros((0, 2), dtype=np.float32), *out])
    np.testing.assert_array_equal(heard, tone(len(heard)))
    assert ring.gaps == 0


@settings(max_examples=100)
@given(
    st.lists(st.tuples(st.integers(0, 200), st.integers(1, 200)), min_size=1, max_size=40),
    st.integers(0, 40),
)
def test_underrun_and_close_fade_without_a_jump(steps: list[tuple[int, int]], close_at: int) -> None:
    ring = PlaybackRing(1000, 2, N_FADE)
    written, out = 0, [np.zeros((1, 2), dtype=np.float32)]
    for i, (n_write, n_play) in enumerate(steps):
        ring.closing = i >= close_at
        n_write = min(n_write, 1000 - ring.level)
        ring.write(tone(n_write, written))
        written += n_write
        out.append(played(ring, n_play))
    heard = np.concatenate(out)
    assert np.isfinite(heard).all()
    # The largest slopes of the tone and of the fade.
    assert np.abs(np.diff(heard, axis=0)).max() <= 2 * np.pi / 400 + np.pi / 2 / N_FADE + 1e-6


def test_a_gap_is_counted_once_and_faded_in_again() -> None:
    ring = PlaybackRing(1000, 2, N_FADE)
    ring.write(tone(300))
    played(ring, 290)
    assert not played(ring, 100)[10 + N_FADE :].any()
    assert not played(ring, 100).any()
    assert ring.gaps == 1
    ring.write(tone(300, 300))
    back = played(ring, 200)
    np.testing.assert_array_equal(back[N_FADE:], tone(200, 300)[N_FADE:])
    assert np.abs(back[0]).max() < 0.01


def test_a_gap_of_the_device_is_followed_by_a_fade_in() -> None:
    """The ring still holds samples after the program was stopped, while the device has played silence meanwhile."""
    ring = PlaybackRing(1000, 2, N_FADE)
    ring.write(tone(600))
    played(ring, 200)
    back = np.empty((200, 2), dtype=np.float32)
    ring.play(back, after_gap=True)
    assert np.abs(np.diff(back, axis=0, prepend=0.0)).max() <= 2 * np.pi / 400 + np.pi / 2 / N_FADE
    np.testing.assert_array_equal(back[N_FADE:], tone(200, 200)[N_FADE:])
    assert ring.gaps == 0


def test_silence_before_the_first_samples_is_no_gap() -> None:
    ring = PlaybackRing(1000, 2, N_FADE)
    assert not played(ring, 500).any()
    assert ring.gaps == 0
    assert ring.is_silent


def test_close_fades_out_and_drops_queued_samples() -> None:
    ring = PlaybackRing(1000, 2, N_FADE)
    ring.write(np.ones((900, 2), dtype=np.float32))
    played(ring, 100)
    ring.closing = True
    out = played(ring, 100)
    assert out[N_FADE - 2].all()
    assert not out[N_FADE - 1 :].any()
    assert ring.is_silent
    ring.restart()
    assert ring.level == 0
    assert not ring.closing


def test_callback_allocates_no_arrays() -> None:
    ring = PlaybackRing(4000, 2, N_FADE)
    out = np.empty((500, 2), dtype=np.float32)
    block = tone(500)
    ring.write(block)
    ring.play(out)
    gc.collect()
    tracemalloc.start()
    try:
        for _ in range(50):
            ring.write(block)
            before = tracemalloc.get_traced_memory()[0]
            tracemalloc.reset_peak()
            ring.play(out)
            # Views of arrays are small objects; Python 3.13 has some 600 bytes more of them than 3.11.
            assert tracemalloc.get_traced_memory()[1] - before < out.nbytes
    finally:
        tracemalloc.stop()


def test_more_frames_than_the_ring_holds_wrap() -> None:
    ring = PlaybackRing(100, 2, 1)
    for i in range(30):
        ring.write(tone(70, 70 * i))
        np.testing.assert_array_equal(played(ring, 70), tone(70, 70 * i))
    assert ring.level == 0
    assert ring.shape == (100, 2)
    assert pytest.approx(0) == ring.gaps
