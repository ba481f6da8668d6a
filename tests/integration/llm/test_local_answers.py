"""Answers of local servers that ignore the schema, with status 200."""

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
def test_json_is_found_within_other_text(content: str) -> None:
    with serving(said(content)) as server:
        assert ask(local(server)).text == ANSWER


@pytest.mark.parametrize("place", ["reasoning", "reasoning_content"])
def test_empty_content_falls_back_to_the_reasoning_field(place: str) -> None:
    with serving(said("", **{place: f"I think {ANSWER}"})) as server:
        assert ask(local(server)).text == ANSWER


def test_empty_content_falls_back_to_the_thinking_field_of_ollama() -> None:
    with serving(ollama_said(message={"role": "assistant", "content": "", "thinking": ANSWER})) as server:
        assert ask(ollama(server)).text == ANSWER


def test_empty_reply_is_a_bad_answer() -> None:
    with serving(said("", reasoning="hm")) as server, pytest.raises(BadAnswer, match="without content") as caught:
        ask(local(server))
    assert caught.value.raw_text == "hm"


def test_prose_without_json_is_passed_to_repair() -> None:
    with serving(said("A kitchen."), said()) as server:
        assert ask(RepairBackend(local(server))).text == ANSWER
    assert "Your last answer was:\nA kitchen." in server.bodies[1]["messages"][0]["content"][0]["text"]


def test_missing_finish_reason_is_accepted() -> None:
    with serving(said(ANSWER, None)) as server:
        assert ask(local(server)).finish_reason == "stop"
