"""Stacks of backend wrappers, built by hand and from a configuration."""

import asyncio
import itertools
import json
from dataclasses import replace
from pathlib import Path

import pytest

from llm_server import GOOD, request
from scene2hap import (
    BudgetBackend,
    CacheBackend,
    FunctionBackend,
    LLMRequest,
    OpenAIBackend,
    RecordingBackend,
    RepairBackend,
    ReplayBackend,
    RetryBackend,
    infer_haptics,
)
from scene2hap.errors import BackendUnavailable, BadAnswer, BudgetExceeded, ConfigError
from scene2hap.llm import BACKENDS
from scene2hap.llm.protocol import LLMBackend
from scene2hap.llm.wrappers import build_backend, reports, standard_stack
from scenes import box, scene


def test_configuration_builds_a_whole_stack(tmp_path: Path) -> None:
    model = {"kind": "openai", "model": "gpt-4.1", "detail": "high"}
    guarded = {"kind": "budget", "max_calls": 9, "inner": {"kind": "retry", "retries": 3, "inner": model}}
    built = BACKENDS.build({"kind": "cache", "folder": tmp_path, "inner": {"kind": "repair", "inner": guarded}})
    assert isinstance(built, CacheBackend)
    assert repr(built) == (
        "CacheBackend(RepairBackend(BudgetBackend(RetryBackend("
        "OpenAIBackend('gpt-4.1', base_url='https://api.openai.com/v1')))))"
    )
    assert built.identity == OpenAIBackend("gpt-4.1", detail="high").identity


@pytest.mark.parametrize("inner", [3, object(), {"kind": "no such"}, "no such", {"model": "m"}])
def test_inner_must_be_a_backend(inner: object) -> None:
    with pytest.raises(ConfigError):
        RetryBackend(inner)


def test_each_repair_is_a_call_within_the_budget() -> None:
    backend = RepairBackend(BudgetBackend(FunctionBackend(lambda _: "no"), max_calls=2), repairs=5)
    with pytest.raises(BudgetExceeded):
        asyncio.run(backend.complete(request()))


def test_cache_stores_repaired_answers(tmp_path: Path) -> None:
    answers = iter(["no", json.dumps(GOOD["scene_analyzer"])])
    inner = FunctionBackend(lambda _: next(answers))
    backend = CacheBackend(RepairBackend(inner), tmp_path)
    first = asyncio.run(backend.complete(request()))
    assert asyncio.run(backend.complete(request())).text == first.text
    assert len(inner.requests) == 2


def test_answers_recorded_by_a_stack_can_be_replayed(tmp_path: Path) -> None:
    tape = tmp_path / "tape.jsonl"
    failures = [BackendUnavailable("away", retryable=True)]

    async def no_wait(_: float) -> None:
        pass

    async def answer(_: LLMRequest) -> dict[str, object]:
        if failures:
            raise failures.pop()
        return GOOD["scene_analyzer"]

    stack = RecordingBackend(RepairBackend(RetryBackend(FunctionBackend(answer), sleep=no_wait)), tape)
    recorded = asyncio.run(stack.complete(request()))
    assert asyncio.run(ReplayBackend(tape).complete(request())) == replace(recorded, is_kept=True)


ORDERS = [
    order
    for order in itertools.permutations(["cache", "recording", "repair", "budget", "retry"])
    if order.index("retry") > max(order.index("repair"), order.index("budget"))
]


@pytest.mark.parametrize("order", ORDERS, ids="-".join)
def test_wrappers_compose_in_every_sensible_order(order: tuple[str, ...], tmp_path: Path) -> None:
    """With retries next to the model, others in any order: a valid answer is cached, recorded and requested once."""
    answers = iter([json.dumps(GOOD["scene_analyzer"])])
    inner = FunctionBackend(lambda _: next(answers))
    wrap = {
        "cache": lambda backend: CacheBackend(backend, tmp_path / "cache"),
        "recording": lambda backend: RecordingBackend(backend, tmp_path / "tape.jsonl"),
        "repair": RepairBackend,
        "budget": lambda backend: BudgetBackend(backend, max_calls=2),
        "retry": RetryBackend,
    }
    stack: LLMBackend = inner
    for name in reversed(order):
        stack = wrap[name](stack)
    first, second = (asyncio.run(stack.complete(request())) for _ in range(2))
    assert first.text == second.text == json.dumps(GOOD["scene_analyzer"])
    assert len(inner.requests) == 1
    assert asyncio.run(ReplayBackend(tmp_path / "tape.jsonl").complete(request())).text == first.text
    assert stack.identity == {"model": "function"}


def test_error_names_a_wrapper_order_that_breaks_the_cache(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="no `identity`"):
        CacheBackend(RepairBackend("lexicon"), tmp_path)


def test_standard_stack_has_the_documented_wrappers(tmp_path: Path) -> None:
    stack = standard_stack({"kind": "openai", "model": "gpt-4.1"}, tmp_path, max_cost=5.0)
    model = "OpenAIBackend('gpt-4.1', base_url='https://api.openai.com/v1')"
    assert repr(stack) == f"CacheBackend(RepairBackend(BudgetBackend(RetryBackend({model}))))"
    assert repr(standard_stack("openai")).startswith("RepairBackend(BudgetBackend(")
    layers = ["CacheBackend", "RepairBackend", "BudgetBackend", "RetryBackend", "OpenAIBackend"]
    assert list(reports(stack)) == layers


def test_limits_of_the_standard_stack_hold(tmp_path: Path) -> None:
    stack = standard_stack(FunctionBackend(lambda _: "no"), tmp_path, repairs=1, max_calls=3)
    with pytest.raises(BadAnswer, match="after 1 repairs"):
        asyncio.run(stack.complete(request()))
    with pytest.raises(BudgetExceeded):
        asyncio.run(stack.complete(request()))
    assert reports(stack)["BudgetBackend"]["calls"] == 3


@pytest.mark.parametrize(
    ("spec", "built"),
    [
        ("openai", "RepairBackend"),
        ({"kind": "local", "model": "m", "base_url": "http://127.0.0.1/v1"}, "RepairBackend"),
        ("lexicon", "LexiconBackend"),
        ({"kind": "retry", "inner": "openai"}, "RetryBackend"),
        (OpenAIBackend(), "OpenAIBackend"),
        (FunctionBackend(lambda _: ""), "FunctionBackend"),
    ],
)
def test_configuration_of_a_remote_model_gets_the_standard_stack(spec: object, built: str) -> None:
    assert type(build_backend(spec)).__name__ == built


def test_configuration_gets_the_configured_cache(tmp_path: Path) -> None:
    assert isinstance(build_backend("openai", tmp_path), CacheBackend)


def test_chain_through_the_whole_stack_is_paid_once(tmp_path: Path) -> None:
    lexicon = BACKENDS.build("lexicon")

    async def answer(asked: LLMRequest) -> str:
        return (await lexicon.complete(asked)).text

    kitchen = scene(box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4)), box("phone", (0.1, 0.01, 0.1), (0.1, 0.725, 0.4)))
    inner = FunctionBackend(answer)
    found = [
        infer_haptics(kitchen, CacheBackend(RepairBackend(RetryBackend(inner)), tmp_path / "cache")) for _ in range(2)
    ]
    assert found[0] == found[1]
    bare = infer_haptics(kitchen, inner)
    # Provenance names the cache file if there is one; all other fields are equal.
    assert {name: replace(haptics, provenance=bare[name].provenance) for name, haptics in found[0].items()} == bare
    # The second run with a cache sent no request; the run without a cache sent all requests again.
    assert len(inner.requests) == 2 * len({asked.prompt for asked in inner.requests})
