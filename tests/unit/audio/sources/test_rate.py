from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from scene2hap.audio.sources.freesound.rate_limit import RateLimit
from scene2hap.errors import BackendUnavailable


class Time:
    now_s = 50.0

    def clock(self) -> float:
        return self.now_s

    def sleep(self, seconds: float) -> None:
        assert seconds > 0.0
        self.now_s += seconds


@given(gaps=st.lists(st.floats(0.0, 30.0), max_size=60), per_minute=st.integers(1, 8))
def test_rate_limit_holds_for_any_minute(gaps: list[float], per_minute: int) -> None:
    time, sent = Time(), []
    limit = RateLimit(time.clock, time.sleep, per_minute=per_minute)
    for gap in gaps:
        time.now_s += gap
        limit.take()
        sent.append(time.now_s)
    # The last of any n + 1 requests in a row comes a minute or more after the first; 1 ns is for rounding.
    assert all(later - earlier >= 60.0 - 1e-9 for earlier, later in zip(sent, sent[per_minute:], strict=False))


def test_requests_within_the_limit_do_not_wait() -> None:
    time = Time()
    limit = RateLimit(time.clock, time.sleep)
    for _ in range(60):
        limit.take()
    assert time.now_s == 50.0
    limit.take()
    assert time.now_s == 110.0


def test_rate_limit_raises_when_the_requests_of_a_day_are_used_up() -> None:
    time = Time()
    limit = RateLimit(time.clock, time.sleep, per_minute=5, per_day=7)
    for _ in range(7):
        limit.take()
    with pytest.raises(BackendUnavailable, match="7 requests of a day are used up"):
        limit.take()
    time.now_s += 86_400.0
    limit.take()


def test_block_of_the_service_delays_all_requests() -> None:
    time = Time()
    limit = RateLimit(time.clock, time.sleep)
    limit.block(12.5)
    limit.take()
    assert time.now_s == 62.5
