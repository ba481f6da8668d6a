"""Wrappers around wrappers, by hand and from a configuration."""

import asyncio
import json
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
from scene2hap.errors import BackendUnavailable, BudgetExceeded, ConfigError
from scene2hap.llm import BACKENDS
from scenes import box, scene


def test_a_whole_stack_from_a_configuration(tmp_path: Path) -> None:
    model = {"kind": "openai", "model": "gpt-4.1", "detail": "high"}
    guarded = {"kind": "budget", "max_calls": 9, "inner": {"kind": "retry", "retries": 3, "inner": model}}
    built = BACKENDS.build({"kind": "cache", "folder": tmp_path, "inner": {"kind": "repair", "inner": guarded}})
    assert isinstance(built, CacheBackend)
    assert repr(built) == (
        "CacheBackend(RepairBackend(BudgetBackend(RetryBackend("
        "OpenAIBackend('gpt-4.1', base_url='https://api.openai.com/v1')))))"
    )
    assert built.identity == OpenAIBackend("gpt-4.1", detail="high").identity


@pytest.mark.parametrize("inner", [3, object(), {"kind": "no such"}, "no such", {"model": "m"}], ids=repr)
def test_inner_must_be_a_backend(inner: object) -> None:
    with pytest.raises(ConfigError):
        RetryBackend(inner)  # type: ignore[arg-type]


def test_each_repair_is_a_call_within_the_budget() -> None:
    backend = RepairBackend(BudgetBackend(FunctionBackend(lambda _: "no"), max_calls=2), repairs=5)
    with pytest.raises(BudgetExceeded):
        asyncio.run(backend.complete(request()))


def test_cache_keeps_what_was_repaired(tmp_path: Path) -> None:
    answers = iter(["no", json.dumps(GOOD["scene_analyzer"])])
    inner = FunctionBackend(lambda _: next(answers))
    backend = CacheBackend(RepairBackend(inner), tmp_path)
    first = asyncio.run(backend.complete(request()))
    assert asyncio.run(backend.complete(request())).text == first.text
    assert len(inner.requests) == 2


def test_what_a_stack_recorded_can_be_replayed(tmp_path: Path) -> None:
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
    assert asyncio.run(ReplayBackend(tape).complete(request())) == recorded


def test_a_chain_through_all_of_them_is_paid_for_once(tmp_path: Path) -> None:
    lexicon = BACKENDS.build("lexicon")

    async def answer(asked: LLMRequest) -> str:
        return (await lexicon.complete(asked)).text  # type: ignore[attr-defined,no-any-return]

    kitchen = scene(box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4)), box("phone", (0.1, 0.01, 0.1), (0.1, 0.725, 0.4)))
    inner = FunctionBackend(answer)
    found = [
        infer_haptics(kitchen, CacheBackend(RepairBackend(RetryBackend(inner)), tmp_path / "cache")) for _ in range(2)
    ]
    assert found[0] == found[1]
    assert found[0] == infer_haptics(kitchen, inner)
    # The second run with a cache asked nothing, the one without asked all of it again.
    assert len(inner.requests) == 2 * len({asked.prompt for asked in inner.requests})
