"""Rate limits: the limit counts all concurrent requests together, so all of them wait."""

import asyncio
import contextlib
import dataclasses
import time
from collections.abc import Callable

import pytest

from llm_asking import ask, openai
from llm_server import Asked, Scripted, refused, request, said
from openai_schema import openai_serving
from scene2hap import OpenAIBackend, RetryBackend
from scene2hap.errors import BackendUnavailable
from scene2hap.llm.wrappers import standard_stack

WAIT_S = 0.4
BUSY = {"message": "Rate limit reached", "type": "requests", "code": "rate_limit_exceeded"}


def limited(**headers: str) -> Scripted:
    return refused(429, BUSY, **headers)


def timed(script: Callable[[int], Scripted]) -> tuple[list[float], Callable[[Asked], Scripted]]:
    """The arrival times of requests (a list that grows), and a script that selects the reply by request number."""
    came_s: list[float] = []

    def answer(_: Asked) -> Scripted:
        came_s.append(time.monotonic())
        return script(len(came_s) - 1)

    return came_s, answer


async def one_sent_away_then_eight(backend: OpenAIBackend) -> None:
    with contextlib.suppress(BackendUnavailable):
        await backend.complete(request())
    await asyncio.gather(*(backend.complete(request()) for _ in range(8)))


@pytest.mark.parametrize(
    "headers",
    [
        {"retry_after_ms": f"{WAIT_S * 1000:g}"},
        {"retry_after": f"{WAIT_S}"},
        {"x_ratelimit_remaining_requests": "0", "x_ratelimit_reset_requests": f"{WAIT_S * 1000:g}ms"},
        {"x_ratelimit_remaining_tokens": "0", "x_ratelimit_reset_tokens": f"{WAIT_S}s"},
    ],
    ids=lambda headers: next(iter(headers)),
)
def test_all_concurrent_calls_wait_for_a_requested_pause(headers: dict[str, str]) -> None:
    came_s, script = timed(lambda number: limited(**headers) if number == 0 else said())
    with openai_serving(by=script) as server:
        asyncio.run(one_sent_away_then_eight(openai(server)))
    assert len(came_s) == 9
    assert min(came_s[1:]) - came_s[0] >= WAIT_S


def test_exhausted_limit_in_a_reply_delays_the_next_request() -> None:
    headers = {"x-ratelimit-remaining-requests": "0", "x-ratelimit-reset-requests": f"{WAIT_S * 1000:g}ms"}
    came_s, script = timed(lambda number: dataclasses.replace(said(), headers=headers if number == 0 else {}))
    with openai_serving(by=script) as server:
        backend = openai(server)
        ask(backend)
        ask(backend)
    assert came_s[1] - came_s[0] >= WAIT_S


@pytest.mark.parametrize(
    "reply",
    [
        limited(),
        limited(retry_after="3600"),
        refused(429, {"message": "quota", "code": "insufficient_quota"}, retry_after="60"),
        refused(400, {"message": "wrong"}, retry_after="60"),
        limited(x_ratelimit_remaining_requests="5", x_ratelimit_reset_requests="60s"),
        dataclasses.replace(said(), headers={"x-ratelimit-remaining-tokens": "0", "x-ratelimit-reset-tokens": "6m0s"}),
    ],
    ids=["no header", "too long", "no money", "our fault", "some left", "answered, too long"],
)
def test_invalid_pause_does_not_delay_requests(reply: Scripted) -> None:
    """The second request is sent at once; a pause of a minute would exceed the timeout of the test."""
    with openai_serving(reply, said()) as server:
        backend = openai(server)

        async def both() -> None:
            with contextlib.suppress(BackendUnavailable):
                await backend.complete(request())
            await asyncio.wait_for(backend.complete(request()), 30.0)

        asyncio.run(both())


def test_reset_after_hours_is_not_waited_for() -> None:
    away = limited(x_ratelimit_remaining_requests="0", x_ratelimit_reset_requests="1h2m3s")
    with openai_serving(away) as server, pytest.raises(BackendUnavailable, match="asks to wait 3723 s") as caught:
        ask(RetryBackend(openai(server)))
    assert not caught.value.retryable
    assert len(server.asked) == 1


def test_eight_concurrent_calls_pass_a_limit_of_one_request_per_window() -> None:
    """Every call succeeds in the end, even after seven refusals, and calls wait while the window is closed."""
    window_s = 0.1
    passed_s: list[float] = []
    sent_away = 0

    def narrow(_: Asked) -> Scripted:
        nonlocal sent_away
        now_s = time.monotonic()
        if passed_s and now_s - passed_s[-1] < window_s:
            sent_away += 1
            return limited(retry_after_ms=f"{(window_s - now_s + passed_s[-1]) * 1000:.0f}")
        passed_s.append(now_s)
        return said()

    with openai_serving(by=narrow) as server:
        stack = standard_stack(openai(server))

        async def all_at_once() -> None:
            await asyncio.gather(*(stack.complete(request(subject=str(i))) for i in range(8)))

        asyncio.run(all_at_once())
    assert len(passed_s) == 8
    # Seven refusals in the first window, six in the second, ...; independent calls would retry many times within one.
    # The factor 2 allows for windows that open between two requests.
    assert sent_away <= 2 * sum(range(8))
