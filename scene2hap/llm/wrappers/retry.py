"""RetryBackend: repeats a request when waiting can help."""

from __future__ import annotations

import asyncio
import random
from collections.abc import Awaitable, Callable

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.errors import BackendUnavailable, ConfigError
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scene2hap.llm.stack import Spec, Wrapper

FIRST_WAIT_S = 0.5
LONGEST_WAIT_S = 8.0
LEAST_SHARE = 0.75
"""Waits are min(0.5 * 2^n, 8) s times a random share of 0.75 to 1, as in OpenAI's own Python client."""


@clear_construction
class RetryBackend(Wrapper):
    """Repeat a call that failed with a retryable `BackendUnavailable`, up to `retries` times.

    Waits as long as the server states. Otherwise it waits with exponential back-off, times a random share that spreads
    the calls of many clients.
    rate_limit_retries : most repetitions after waits that the server stated, in addition to `retries`; None counts both
    together. If many calls share a low rate limit, the server rejects each of them many times.
    Bad answers are not repeated here; `RepairBackend` does that. `rng` and `sleep` are for tests.
    """

    def __init__(
        self,
        inner: Spec,
        retries: int = 2,
        *,
        rate_limit_retries: int | None = None,
        rng: random.Random | None = None,
        sleep: Callable[[float], Awaitable[object]] = asyncio.sleep,
    ) -> None:
        super().__init__(inner)
        checks.number("retries", retries, "-", at_least=0, error=ConfigError)
        if rate_limit_retries is not None:
            checks.number("rate_limit_retries", rate_limit_retries, "-", at_least=0, error=ConfigError)
        self._retries = retries
        self._rate_limit_retries = rate_limit_retries
        self._rng = rng or random.Random()
        self._sleep = sleep
        self._calls = self._retried = self._given_up = 0
        self._waited_s = 0.0

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the inner backend's answer. Raises: the last error of the inner backend."""
        self._calls += 1
        n_unstated = n_stated = 0
        while True:
            try:
                return await self.inner.complete(request)
            except BackendUnavailable as problem:
                if not problem.retryable:
                    raise
                if problem.retry_after_s and self._rate_limit_retries is not None:
                    n_stated += 1
                else:
                    n_unstated += 1
                if n_unstated > self._retries or n_stated > (self._rate_limit_retries or 0):
                    self._given_up += 1
                    raise
                wait_s = self._wait_s(n_unstated - 1, problem)
            self._retried += 1
            self._waited_s += wait_s
            await self._sleep(wait_s)

    def report(self) -> dict[str, float]:
        """Return counts: calls, retries, calls that failed after all retries, and seconds waited."""
        return {
            "calls": self._calls,
            "retries": self._retried,
            "given_up": self._given_up,
            "waited_s": self._waited_s,
        }

    def _wait_s(self, attempt: int, problem: BackendUnavailable) -> float:
        if problem.retry_after_s:  # a stated wait of 0 s states nothing: calls would follow one another at once
            return problem.retry_after_s
        return min(FIRST_WAIT_S * 2.0**attempt, LONGEST_WAIT_S) * self._rng.uniform(LEAST_SHARE, 1.0)
