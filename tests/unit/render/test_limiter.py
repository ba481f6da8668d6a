import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray

from scene2hap.render.bursts import MOST_SUM
from scene2hap.render.limiter import THRESHOLD, decays, limit_in_place, soft_limit_sum, turn_down_in_place


def soft_limit(x: NDArray[np.float32]) -> NDArray[np.float32]:
    """The curve alone: the sum of silence and a signal."""
    return soft_limit_sum(np.zeros_like(x), x)


@settings(max_examples=200)
@given(st.lists(st.floats(-1e6, 1e6, width=32), min_size=1, max_size=50))
def test_stays_within_full_scale_and_keeps_order(values: list[float]) -> None:
    y = soft_limit(np.sort(np.array(values, dtype=np.float32)))
    assert np.abs(y).max() <= 1.0
    assert (np.diff(y) >= 0).all()


def test_leaves_quiet_samples_untouched() -> None:
    x = np.linspace(-THRESHOLD, THRESHOLD, 1001).astype(np.float32) * np.float32(0.999999)
    np.testing.assert_array_equal(soft_limit(np.append(x, np.float32(2.0)))[:-1], x)


def test_limiter_curve_is_smooth() -> None:
    x = np.linspace(0.6, 0.9, 30001)
    slope = np.diff(soft_limit(x)) / np.diff(x)
    assert np.abs(np.diff(slope)).max() < 0.01


def test_a_mix_is_limited_in_place_by_the_same_curve() -> None:
    x = np.linspace(-4, 4, 2001, dtype=np.float32)
    mix = np.stack([x, 0.1 * x])
    limit_in_place(mix, np.empty_like(mix), THRESHOLD)
    np.testing.assert_allclose(mix, soft_limit(np.stack([x, 0.1 * x])), atol=1e-6)


def test_limiter_does_not_modify_its_input() -> None:
    x = np.full((4, 2), 3.0, dtype=np.float32)
    soft_limit(x)
    assert (x == 3.0).all()


@settings(max_examples=200)
@given(st.lists(st.tuples(st.floats(-1, 1, width=32), st.floats(-1e3, 1e3, width=32)), min_size=1, max_size=50))
def test_a_sum_stays_within_full_scale_and_keeps_the_mix_where_nothing_is_added(
    pairs: list[tuple[float, float]],
) -> None:
    mix, added = np.array(pairs, dtype=np.float32).T
    added[::2] = 0.0
    y = soft_limit_sum(mix, mix + added)
    assert np.abs(y).max() <= 1.0
    np.testing.assert_array_equal(y[::2], mix[::2])
    quiet = np.abs(mix) <= THRESHOLD
    np.testing.assert_allclose(y[quiet], soft_limit(mix + added)[quiet], atol=1e-6)


def test_a_sum_follows_a_small_addition_to_a_loud_mix() -> None:
    """No step as an impact begins: its first samples change a mix by no more than themselves."""
    mix = np.linspace(-1, 1, 2001, dtype=np.float32)
    for added in (1e-4, -1e-4, 1e-3, -1e-3):
        change = soft_limit_sum(mix, mix + np.float32(added)) - mix
        assert np.abs(change).max() <= abs(added) * 1.001


@pytest.mark.parametrize("peak", [1.0, 3.0, 10.0])
def test_sources_that_last_leave_the_impacts_their_part(peak: float) -> None:
    """As docs/impacts.md says: 0.2 of full scale, from 30 ms after the source begins."""
    times_s = np.arange(24_000) / 48_000
    mix = (peak * np.sin(2 * np.pi * 40.0 * times_s)).astype(np.float32)[None]
    turn_down_in_place(mix, np.zeros((2, 1)), np.zeros((2, 1, mix.size)), THRESHOLD, decays(48_000, mix.size))
    limit_in_place(mix, np.empty_like(mix), THRESHOLD)
    assert np.abs(mix[0, times_s > 0.03]).max() < MOST_SUM - 0.2
