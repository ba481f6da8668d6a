"""The timeout of `wait_prepared`, shared by all its waits."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from scene2hap import HapticSession
from scene2hap.common import deadline
from scene2hap.common.deadline import Deadline
from scenes import RATE, table_with_two_phones


class Clock:
    """A clock that each call of `later` advances by two seconds."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now_s, self.left_s = 100.0, list[float | None]()
        monkeypatch.setattr(deadline, "time", SimpleNamespace(monotonic=lambda: self.now_s))

    def later(self, end: Deadline) -> bool:
        self.left_s.append(end.left_s)
        self.now_s += 2.0
        return True


@pytest.mark.parametrize(
    ("timeout_s", "left_s"), [(5.0, [5.0, 3.0, 1.0, 0.0]), (3.0, [3.0, 1.0, 0.0, 0.0]), (None, [None] * 4)]
)
def test_all_waits_of_a_session_share_its_timeout(
    monkeypatch: pytest.MonkeyPatch, timeout_s: float | None, left_s: list[float | None]
) -> None:
    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE})
    clock = Clock(monkeypatch)
    for part in (s._mixers, s._impacts, s._hand_frames, s._shapes):
        monkeypatch.setattr(part, "wait", clock.later)
    assert s.wait_prepared(timeout_s)
    assert clock.left_s == left_s
