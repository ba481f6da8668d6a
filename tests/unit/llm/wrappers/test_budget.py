"""BudgetBackend: limits are checked before each call, and unknown costs do not count as zero."""

import asyncio
from pathlib import Path
from typing import Any

import pytest

from llm_server import request
from scene2hap import (
    BackendWarning,
    BudgetBackend,
    CacheBackend,
    FunctionBackend,
    LLMReply,
    LLMRequest,
    Price,
    RepairBackend,
)
from scene2hap.errors import BackendUnavailable, BadAnswer, BudgetExceeded, ConfigError
from scene2hap.llm.answers.usable import UnusableAnswer
from scene2hap.llm.wrappers import price_list

USAGE = {"prompt_tokens": 1000, "completion_tokens": 200}


def answering(model: str = "gpt-4o-2024-08-06", usage: dict[str, int] = USAGE) -> FunctionBackend:
    return FunctionBackend(lambda _: LLMReply("{}", model, usage=usage))


def spend(backend: BudgetBackend, calls: int) -> None:
    for _ in range(calls):
        asyncio.run(backend.complete(request()))


@pytest.mark.parametrize(
    ("limit", "calls"),
    [
        ({"max_calls": 3}, 3),
        ({"max_calls": 0}, 0),
        ({"max_tokens": 2400}, 2),
        ({"max_tokens": 2401}, 3),
        # 1000 tokens in at 2 and 200 out at 5 dollars per million: 0.003 per call
        ({"max_cost": 0.0029}, 1),
        ({"max_cost": 0.0031}, 2),
    ],
    ids=str,
)
def test_limits_are_checked_before_each_call(limit: dict[str, Any], calls: int) -> None:
    inner = answering()
    backend = BudgetBackend(inner, **limit, prices={"gpt-4o": (2.0, 5.0)})
    spend(backend, calls)
    with pytest.raises(BudgetExceeded, match=f"max_{next(iter(limit)).removeprefix('max_')} = "):
        spend(backend, 1)
    assert len(inner.requests) == calls


def test_running_calls_count_towards_limits() -> None:
    backend = BudgetBackend(answering(), max_calls=3)

    async def all_at_once() -> list[Any]:
        return await asyncio.gather(*(backend.complete(request()) for _ in range(8)), return_exceptions=True)

    assert sum(isinstance(result, BudgetExceeded) for result in asyncio.run(all_at_once())) == 5


def test_budget_reports_calls_tokens_and_cost() -> None:
    backend = BudgetBackend(answering(), prices={"gpt-4o": Price(2.0, 5.0)})
    spend(backend, 2)
    assert backend.report() == {
        "calls": 2,
        "failed_calls": 0,
        "calls_without_usage": 0,
        "input_tokens": 2000,
        "cached_input_tokens": 0,
        "output_tokens": 400,
        "cost": pytest.approx(0.006),
        "prices_of": price_list().date,
        "models_without_price": [],
    }


def test_a_limit_on_cost_warns_of_an_unknown_price_before_the_first_call() -> None:
    class Deployment(FunctionBackend):
        """A gateway calls a model by a name of its own."""

        @property
        def identity(self) -> dict[str, Any]:
            return {"model": "my-deployment", "base_url": "https://gateway.example"}

    inner = Deployment(lambda _: LLMReply("{}", "gpt-4o-2024-08-06", usage=USAGE))
    backend = BudgetBackend(inner, max_cost=1.0, prices={"gpt-4o": (2.0, 5.0)})
    with pytest.warns(BackendWarning, match="the price of 'my-deployment' is unknown") as caught:
        spend(backend, 2)  # its answers name a model with a price
    assert len(caught) == 1
    spend(BudgetBackend(answering(), max_calls=3), 1)


@pytest.mark.parametrize("model", ["llava", "gpt-4o-latest", "gpt-4o-mini-2024", ""])
def test_unknown_price_is_unknown_not_zero(model: str) -> None:
    backend = BudgetBackend(answering(model), prices={"gpt-4o": (2.0, 5.0)})
    spend(backend, 1)
    assert backend.report()["cost"] is None
    assert backend.report()["models_without_price"] == [model]


def test_price_of_a_snapshot_precedes_the_price_of_its_model() -> None:
    backend = BudgetBackend(answering(), prices={"gpt-4o": (9.0, 9.0), "gpt-4o-2024-08-06": (0.0, 1.0)})
    spend(backend, 1)
    assert backend.cost == pytest.approx(0.0002)


def test_cost_limit_needs_a_price() -> None:
    backend = BudgetBackend(answering("llava"), max_cost=1.0)
    spend(backend, 1)
    with pytest.raises(BudgetExceeded, match="unknown without a price for llava"):
        spend(backend, 1)


@pytest.mark.parametrize("limit", [{"max_tokens": 10_000}, {"max_cost": 1.0}], ids=str)
def test_limits_need_usage_in_replies(limit: dict[str, Any]) -> None:
    backend = BudgetBackend(answering(usage={}), **limit)
    spend(backend, 1)
    assert (backend.tokens, backend.cost) == (None, None)
    assert backend.report()["calls_without_usage"] == 1
    with pytest.raises(BudgetExceeded, match="unknown without the usage of an answer"):
        spend(backend, 1)


def test_failed_calls_are_counted_and_shown() -> None:
    def fail(_: LLMRequest) -> LLMReply:
        raise BackendUnavailable("away")

    backend = BudgetBackend(FunctionBackend(fail), max_calls=1)
    with pytest.raises(BackendUnavailable):
        spend(backend, 1)
    with pytest.raises(BudgetExceeded, match="1 calls used of max_calls = 1"):
        spend(backend, 1)
    assert backend.report()["failed_calls"] == 1


def test_given_prices_precede_listed_prices() -> None:
    listed, own = BudgetBackend(answering("gpt-4.1")), BudgetBackend(answering("gpt-4.1"), prices={"gpt-4.1": (0, 1)})
    for backend in (listed, own):
        spend(backend, 1)
    # Listed at 2 and 8 US dollars per million: 1000 tokens in and 200 out.
    assert listed.cost == pytest.approx(0.0036)
    assert own.cost == pytest.approx(0.0002)


def test_bad_answers_count_towards_the_cost() -> None:
    """The service also bills truncated, refused and empty answers."""

    def cut(_: LLMRequest) -> LLMReply:
        raise UnusableAnswer("cut", "{", model="gpt-4o", usage=USAGE)

    backend = BudgetBackend(FunctionBackend(cut), max_tokens=1200, prices={"gpt-4o": (2.0, 5.0)})
    with pytest.raises(UnusableAnswer):
        spend(backend, 1)
    assert (backend.tokens, backend.cost) == (1200, pytest.approx(0.003))
    assert backend.report()["failed_calls"] == 1
    with pytest.raises(BudgetExceeded, match="1200 tokens used of max_tokens = 1200"):
        spend(backend, 1)


def test_bad_answer_without_usage_makes_the_sum_unknown() -> None:
    def empty(_: LLMRequest) -> LLMReply:
        raise UnusableAnswer("empty")

    backend = BudgetBackend(FunctionBackend(empty))
    with pytest.raises(BadAnswer):
        spend(backend, 1)
    assert (backend.tokens, backend.cost) == (None, None)


def test_budget_around_repairs_counts_all_attempts() -> None:
    backend = BudgetBackend(RepairBackend(answering("gpt-4o")), prices={"gpt-4o": (2.0, 5.0)})
    with pytest.raises(BadAnswer, match="still wrong after 2 repairs"):
        spend(backend, 1)
    assert backend.tokens == 3 * 1200


def test_answers_from_an_inner_cache_are_free(tmp_path: Path) -> None:
    kitchen = FunctionBackend(lambda _: LLMReply('{"scene_category": "kitchen"}', "gpt-4o", usage=USAGE))
    backend = BudgetBackend(CacheBackend(kitchen, tmp_path), max_calls=1)
    spend(backend, 1)
    assert backend.tokens == 1200
    again = BudgetBackend(CacheBackend(kitchen, tmp_path), max_calls=1)
    spend(again, 3)
    assert (again.tokens, again.report()["calls"]) == (0, 0)


@pytest.mark.parametrize(
    ("settings", "named"),
    [
        ({"max_calls": -1}, "max_calls is -1"),
        ({"max_cost": float("nan")}, "max_cost is nan"),
        ({"prices": {"m": (1.0,)}}, "the price of 'm'"),
        ({"prices": {"m": 3}}, "the price of 'm'"),
        ({"prices": {"m": (1.0, -1.0)}}, "output_per_million is -1"),
    ],
)
def test_invalid_settings_are_refused(settings: dict[str, Any], named: str) -> None:
    with pytest.raises(ConfigError, match=named):
        BudgetBackend("lexicon", **settings)
