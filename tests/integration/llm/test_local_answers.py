"""Local servers that ignore the schema under status 200."""

import json

import pytest

from llm_asking import ask, local, ollama
from llm_server import GOOD, ollama_said, said, serving
from scene2hap import (
    RepairBackend,
)
from scene2hap.errors import BadAnswer

ANSWER = json.dumps(GOOD["scene_analyzer"])


@pytest.mark.parametrize(
    "content",
    [
        f"```json\n{ANSWER}\n```",
        f'<think>Maybe {{"scene_category": "shop"}}?</think>{ANSWER}',
        f'it said {{"scene_category": "shop"}}</think>\n{ANSWER}',
        f"Sure, here is {{the}} JSON:\n{ANSWER}\nAnything else? {{}}",
    ],
    ids=["fences", "think", "half a think", "prose"],
)
def test_json_within_what_else_a_model_writes(content: str) -> None:
    with serving(said(content)) as server:
        assert ask(local(server)).text == ANSWER


@pytest.mark.parametrize("place", ["reasoning", "reasoning_content"])
def test_empty_content_is_looked_for_in_the_reasoning(place: str) -> None:
    with serving(said("", **{place: f"I think {ANSWER}"})) as server:
        assert ask(local(server)).text == ANSWER


def test_empty_content_is_looked_for_in_ollamas_thinking() -> None:
    with serving(ollama_said(message={"role": "assistant", "content": "", "thinking": ANSWER})) as server:
        assert ask(ollama(server)).text == ANSWER


def test_nothing_said_at_all() -> None:
    with serving(said("", reasoning="hm")) as server, pytest.raises(BadAnswer, match="without content") as caught:
        ask(local(server))
    assert caught.value.raw_text == "hm"


def test_prose_alone_is_handed_on_for_repair() -> None:
    with serving(said("A kitchen."), said()) as server:
        assert ask(RepairBackend(local(server))).text == ANSWER
    assert "Your last answer was:\nA kitchen." in server.bodies[1]["messages"][0]["content"][0]["text"]


def test_server_that_does_not_say_why_it_stopped() -> None:
    with serving(said(ANSWER, None)) as server:
        assert ask(local(server)).finish_reason == "stop"
