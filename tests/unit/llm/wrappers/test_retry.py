"""RetryBackend: which errors are retried, and the waits, which a stub records instead of waiting."""

import asyncio
import random

import pytest

from llm_server import GOOD, request
from scene2hap import FunctionBackend, LLMRequest, RetryBackend
from scene2hap.errors import BackendUnavailable, BadAnswer, ConfigError

AWAY = BackendUnavailable("away", retryable=True)


class Failing:
    """A backend that fails with each of the given errors, then answers; records the waits between retries."""

    def __init__(self, *errors: Exception) -> None:
        self.errors = list(errors)
        self.waits_s: list[float] = []
        self.backend = FunctionBackend(self.answer)

    def answer(self, asked: LLMRequest) -> dict[str, object]:
        if self.errors:
            raise self.errors.pop(0)
        return GOOD["scene_analyzer"]

    async def sleep(self, wait_s: float) -> None:
        self.waits_s.append(wait_s)

    def retrying(self, retries: int = 2) -> RetryBackend:
        return RetryBackend(self.backend, retries, rng=random.Random(0), sleep=self.sleep)


def test_waits_grow_from_half_a_second_to_eight_with_25_percent_jitter() -> None:
    failing = Failing(*[AWAY] * 7)
    backend = failing.retrying(7)
    asyncio.run(backend.complete(request()))
    full_s = [0.5, 1.0, 2.0, 4.0, 8.0, 8.0, 8.0]
    shares = [wait_s / full for wait_s, full in zip(failing.waits_s, full_s, strict=True)]
    assert all(0.75 <= share <= 1.0 for share in shares)
    assert len(set(shares)) == 7
    assert backend.report() == {"calls": 1, "retries": 7, "given_up": 0, "waited_s": sum(failing.waits_s)}


def test_retry_waits_as_long_as_the_server_requests() -> None:
    failing = Failing(BackendUnavailable("slow", retryable=True, retry_after_s=20.0), AWAY)
    asyncio.run(failing.retrying().complete(request()))
    assert failing.waits_s[0] == 20.0
    assert 0.75 <= failing.waits_s[1] <= 1.0


def test_last_error_is_raised_when_retries_are_used_up() -> None:
    last = BackendUnavailable("third", retryable=True)
    failing = Failing(AWAY, AWAY, last)
    backend = failing.retrying()
    with pytest.raises(BackendUnavailable) as caught:
        asyncio.run(backend.complete(request()))
    assert caught.value is last
    assert len(failing.backend.requests) == 3
    assert backend.report()["given_up"] == 1


@pytest.mark.parametrize("error", [BackendUnavailable("no money"), BadAnswer("refused"), KeyError("bug")], ids=repr)
def test_permanent_errors_are_raised_immediately(error: Exception) -> None:
    failing = Failing(error)
    with pytest.raises(type(error)):
        asyncio.run(failing.retrying().complete(request()))
    assert len(failing.backend.requests) == 1
    assert failing.waits_s == []


TOLD = BackendUnavailable("slow", retryable=True, retry_after_s=20.0)


def test_server_requested_waits_have_a_separate_count() -> None:
    failing = Failing(TOLD, AWAY, TOLD, AWAY, TOLD)
    backend = RetryBackend(failing.backend, 2, rate_limit_retries=3, rng=random.Random(0), sleep=failing.sleep)
    asyncio.run(backend.complete(request()))
    assert [wait_s for wait_s in failing.waits_s if wait_s != 20.0] == pytest.approx([0.5, 1.0], rel=0.25)
    assert failing.waits_s.count(20.0) == 3


@pytest.mark.parametrize(
    ("rate_limit_retries", "errors", "calls"),
    [(3, [TOLD] * 9, 4), (3, [AWAY] * 9, 3), (0, [TOLD] * 9, 1), (None, [TOLD] * 9, 3), (None, [TOLD, AWAY] * 5, 3)],
)
def test_retry_counts_are_never_exceeded(rate_limit_retries: int | None, errors: list[Exception], calls: int) -> None:
    failing = Failing(*errors)
    backend = RetryBackend(failing.backend, 2, rate_limit_retries=rate_limit_retries, sleep=failing.sleep)
    with pytest.raises(BackendUnavailable):
        asyncio.run(backend.complete(request()))
    assert len(failing.backend.requests) == calls
    assert backend.report()["given_up"] == 1


def test_a_stated_wait_of_0_s_is_no_reason_to_hurry() -> None:
    failing = Failing(*[BackendUnavailable("busy", retryable=True, retry_after_s=0.0)] * 40)
    backend = RetryBackend(failing.backend, 2, rate_limit_retries=30, rng=random.Random(0), sleep=failing.sleep)
    with pytest.raises(BackendUnavailable):
        asyncio.run(backend.complete(request()))
    assert failing.waits_s == pytest.approx([0.5, 1.0], rel=0.25)


@pytest.mark.parametrize("settings", [{"retries": -1}, {"rate_limit_retries": -1}], ids=str)
def test_negative_retries_are_refused(settings: dict[str, int]) -> None:
    with pytest.raises(ConfigError, match="retries is -1"):
        RetryBackend("lexicon", **settings)
