import numpy as np
from hypothesis import given, settings, strategies as st

from scene2hap.render.limiter import THRESHOLD, soft_limit


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


def test_limiter_does_not_modify_its_input() -> None:
    x = np.full((4, 2), 3.0, dtype=np.float32)
    soft_limit(x)
    assert (x == 3.0).all()
