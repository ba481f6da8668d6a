"""The common pause of all calls to one server, on a clock that only waits move."""

from __future__ import annotations

import asyncio
from types import SimpleNamespace

import pytest

from scene2hap.llm.backends import pace
from scene2hap.llm.backends.pace import Pace
from scene2hap.web import WebReply


def full(reset: str) -> WebReply:
    """A good reply that used up the limit of requests."""
    return WebReply("", 200, b"{}", {"x-ratelimit-remaining-requests": "0", "x-ratelimit-reset-requests": reset})


def refused(retry_after: str, code: str = "rate_limit_exceeded") -> WebReply:
    return WebReply(
        "", 429, f'{{"error": {{"message": "m", "code": "{code}"}}}}'.encode(), {"retry-after": retry_after}
    )


@pytest.mark.parametrize(
    ("replies", "waits_s"),
    [
        ([WebReply("", 200, b"{}")], 0.0),
        ([full("1m2s")], 62.0),
        ([refused("7")], 7.0),
        ([full("9s"), refused("7")], 9.0),
        ([refused("7"), full("9s")], 9.0),
        ([full("2m1s")], 0.0),  # a longer pause than a call waits
        ([refused("7", "insufficient_quota")], 0.0),  # no pause helps
    ],
)
def test_all_calls_pause_as_a_reply_asks(
    replies: list[WebReply], waits_s: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    now_s = 1000.0

    async def sleep(duration_s: float) -> None:
        nonlocal now_s
        now_s += duration_s

    monkeypatch.setattr(pace, "time", SimpleNamespace(monotonic=lambda: now_s))
    monkeypatch.setattr(pace, "asyncio", SimpleNamespace(sleep=sleep))
    common = Pace()
    for reply in replies:
        common.heed(reply)
    for _ in range(2):
        asyncio.run(common.wait())
        assert now_s == pytest.approx(1000.0 + waits_s)
