"""The flex service tier: half the price, with a fallback to the standard tier without capacity."""

import asyncio
from typing import Any

import pytest

from llm_asking import ask, openai
from llm_server import Asked, Scripted, refused, request, said
from openai_schema import openai_serving
from scene2hap import BackendWarning, BudgetBackend, RetryBackend
from scene2hap.errors import BackendUnavailable, ConfigError
from scene2hap.llm.backends.openai import FLEX_TIMEOUT_S, TIMEOUT_S
from scene2hap.llm.wrappers import reports

NO_CAPACITY = refused(
    429,
    {"message": "Resource unavailable.", "type": "resource_unavailable", "param": None, "code": "resource_unavailable"},
)
NOT_OFFERED = refused(
    400,
    {"message": "Flex is not available.", "type": "invalid_request_error", "param": "service_tier", "code": None},
)


def billed(tier: str, cached: int = 0) -> Scripted:
    reply = said()
    reply.body["service_tier"] = tier
    reply.body["model"] = "gpt-5"
    reply.body["usage"] = {
        "prompt_tokens": 2000,
        "completion_tokens": 100,
        "total_tokens": 2100,
        "prompt_tokens_details": {"cached_tokens": cached},
    }
    return reply


def tiers(bodies: list[dict[str, Any]]) -> list[str | None]:
    return [body.get("service_tier") for body in bodies]


def test_tier_is_sent_and_read_and_has_a_longer_timeout() -> None:
    with openai_serving(billed("flex")) as server:
        backend = openai(server, model="gpt-5", service_tier="flex")
        reply = ask(backend)
    assert tiers(server.bodies) == ["flex"]
    assert reply.service_tier == "flex"
    assert (FLEX_TIMEOUT_S, TIMEOUT_S) == (900.0, 120.0)
    assert backend.timeout_s == FLEX_TIMEOUT_S
    assert openai(server).timeout_s == TIMEOUT_S
    assert openai(server, service_tier="flex", timeout_s=30.0).timeout_s == 30.0


def test_tier_is_not_part_of_the_cache_key() -> None:
    with openai_serving(said()) as server:
        assert openai(server, service_tier="flex").identity == openai(server).identity


def test_missing_capacity_falls_back_to_standard_for_one_request() -> None:
    with openai_serving(NO_CAPACITY, billed("default"), billed("flex")) as server:
        backend = openai(server, model="gpt-5", service_tier="flex")
        assert ask(backend).service_tier == "default"
        assert ask(backend).service_tier == "flex"
    assert tiers(server.bodies) == ["flex", None, "flex"]
    assert reports(backend) == {"OpenAIBackend": {"without_capacity": 1}}


def test_tier_is_dropped_for_models_that_do_not_support_it() -> None:
    with openai_serving(NOT_OFFERED, billed("default"), billed("default")) as server:
        backend = openai(server, service_tier="flex")
        with pytest.warns(BackendWarning, match="does not take 'service_tier'.*cost the standard price"):
            ask(backend)
        ask(backend)
    assert tiers(server.bodies) == ["flex", None, None]


def test_rate_limit_is_waited_for_in_the_same_tier() -> None:
    limit = refused(429, {"message": "slow down", "type": "requests", "param": None, "code": "rate_limit_exceeded"})
    waits: list[float] = []

    async def sleep(wait_s: float) -> None:
        waits.append(wait_s)

    with openai_serving(limit, billed("flex")) as server:
        ask(RetryBackend(openai(server, service_tier="flex"), sleep=sleep))
    assert tiers(server.bodies) == ["flex", "flex"]
    assert len(waits) == 1


def test_missing_capacity_in_the_standard_tier_is_an_error() -> None:
    with openai_serving(NO_CAPACITY) as server, pytest.raises(BackendUnavailable, match="429") as caught:
        ask(openai(server))
    assert caught.value.retryable
    assert len(server.bodies) == 1


def test_concurrent_calls_fall_back_independently() -> None:
    def scarce(asked: Asked) -> Scripted:
        return NO_CAPACITY if "service_tier" in asked.body else billed("default")

    with openai_serving(by=scarce) as server:
        backend = openai(server, service_tier="flex")

        async def all_at_once() -> None:
            await asyncio.gather(*(backend.complete(request()) for _ in range(5)))

        asyncio.run(all_at_once())
    assert sorted(tiers(server.bodies), key=str) == [None] * 5 + ["flex"] * 5


@pytest.mark.parametrize(
    ("tier", "cached", "dollars"),
    [
        # Computed by hand for gpt-5: 1.25 in, 0.125 cached, 10 out, in dollars per million tokens.
        ("default", 0, 2000 * 1.25e-6 + 100 * 10e-6),
        ("flex", 0, (2000 * 1.25e-6 + 100 * 10e-6) / 2),
        ("default", 1024, 976 * 1.25e-6 + 1024 * 0.125e-6 + 100 * 10e-6),
        ("flex", 1024, (976 * 1.25e-6 + 1024 * 0.125e-6 + 100 * 10e-6) / 2),
        ("priority", 0, None),
    ],
)
def test_the_budget_counts_tiers_and_cached_input_at_their_price(tier: str, cached: int, dollars: float | None) -> None:
    with openai_serving(billed(tier, cached)) as server:
        budget = BudgetBackend(openai(server, model="gpt-5"))
        ask(budget)
    assert budget.cost == (None if dollars is None else pytest.approx(dollars, rel=1e-12))
    assert budget.report()["cached_input_tokens"] == cached


def test_an_unknown_tier_is_refused_before_anything_is_sent() -> None:
    with openai_serving(said()) as server, pytest.raises(ConfigError, match="service_tier is 'cheap'; it must be"):
        openai(server, service_tier="cheap")
