"""FunctionBackend: every result that a function may return."""

import asyncio
import json
from typing import Any

import pytest

from llm_server import request
from scene2hap import FunctionBackend, LLMReply, LLMRequest


async def later(_: LLMRequest) -> dict[str, int]:
    return {"a": 1}


@pytest.mark.parametrize(
    ("function", "reply"),
    [
        (lambda _: {"a": 1}, LLMReply('{"a": 1}', "m")),
        (lambda asked: asked.prompt, LLMReply("What kind of place is this?", "m")),
        (lambda _: LLMReply("x", "own", "length"), LLMReply("x", "own", "length")),
        (later, LLMReply('{"a": 1}', "m")),
    ],
    ids=["values", "text", "reply", "async"],
)
def test_function_results_become_replies(function: Any, reply: LLMReply) -> None:
    backend = FunctionBackend(function, model="m")
    assert asyncio.run(backend.complete(request())) == reply
    assert backend.requests == [request()]
    assert backend.report() == {"calls": 1}


def test_raised_errors_pass_through() -> None:
    def fail(_: LLMRequest) -> str:
        raise KeyError(json.dumps("mine"))

    with pytest.raises(KeyError, match="mine"):
        asyncio.run(FunctionBackend(fail).complete(request()))
