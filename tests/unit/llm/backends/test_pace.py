"""The common pause of all calls to one server, by a clock that only sleeping advances."""

import asyncio
import time
from typing import Any

import pytest

from scene2hap.common.web import WebReply
from scene2hap.llm.backends.pace import Pace


def reply(status: int, headers: dict[str, str], text: str = "") -> WebReply:
    return WebReply("http://a/v1", status, text.encode(), headers)


def spent(reset: str) -> dict[str, str]:
    """The headers of a reply that used up the limit of requests."""
    return {"x-ratelimit-remaining-requests": "0", "x-ratelimit-reset-requests": reset}


def paused_s(monkeypatch: pytest.MonkeyPatch, *replies: WebReply) -> float:
    """The pause before the request after some replies [s]."""
    now_s = [1000.0]

    async def sleep(seconds: float) -> None:
        now_s[0] += seconds

    async def wait() -> float:
        pace = Pace()
        for one in replies:
            pace.heed(one)
        await pace.wait()
        return now_s[0] - 1000.0

    with monkeypatch.context() as patched:
        patched.setattr(time, "monotonic", lambda: now_s[0])
        patched.setattr(asyncio, "sleep", sleep)
        made: Any = wait()
        with pytest.raises(StopIteration) as end:
            made.send(None)
    return float(end.value.value)


@pytest.mark.parametrize(
    ("answer", "pause_s"),
    [
        (reply(200, {}), 0.0),
        (reply(200, spent("7s")), 7.0),
        (reply(200, {"retry-after": "7"}), 0.0),
        (reply(200, spent("2m0s")), 120.0),
        (reply(200, spent("2m1s")), 0.0),
        (reply(429, {"retry-after": "7"}), 7.0),
        (reply(503, {"retry-after": "7"}), 7.0),
        (reply(429, {"retry-after": "120"}), 120.0),
        (reply(429, {"retry-after": "121"}), 0.0),
        (reply(400, {"retry-after": "7"}), 0.0),
        (reply(429, {"retry-after": "7"}, '{"error": {"code": "insufficient_quota"}}'), 0.0),
    ],
    ids=lambda one: f"{one.status} {one.headers} {one.text}" if isinstance(one, WebReply) else str(one),
)
def test_a_pause_that_can_help_is_kept(answer: WebReply, pause_s: float, monkeypatch: pytest.MonkeyPatch) -> None:
    assert paused_s(monkeypatch, answer) == pause_s


def test_a_later_reply_does_not_shorten_the_pause(monkeypatch: pytest.MonkeyPatch) -> None:
    replies = reply(429, {"retry-after": "9"}), reply(429, {"retry-after": "2"}), reply(200, {})
    assert paused_s(monkeypatch, *replies) == 9.0
