"""Refusals of every backend are reported as refusals, and cost one call."""

import asyncio
import json

import pytest

from llm_asking import ask, local, openai
from llm_server import GOOD, refused, request, said, serving
from scene2hap import LLMReply, LLMRequest
from scene2hap.errors import AnswerRefused, BadAnswer
from scene2hap.llm.answers.refusals import refusal_in
from scene2hap.llm.wrappers.repair import RepairBackend
from scene2hap.llm.wrappers.standard import standard_stack
from scripted_backend import Scripted, run

REFUSALS = [
    "I'm sorry, but I can't assist with that request.",
    "I\u2019m sorry, I can\u2019t help with identifying this.",
    "Sorry, I can't.",
    "I am unable to analyze these images.",
    "I cannot comply with this request.",
    "As an AI language model, I do not judge pictures of people.",
    "This request violates our content policy.",
    '{"error": "I cannot help with that."}',
    '{"refusal": "no"}',
]
ANSWERS = [
    json.dumps(GOOD["scene_analyzer"]),
    "I'm sorry for the delay. " + json.dumps(GOOD["scene_analyzer"]),
    '{"scene_category": "I cannot help"}',
    '{"scene_category": "sorry I can',
    "I think it is a table. I can't tell its material.",
    "",
]


@pytest.mark.parametrize("text", REFUSALS)
def test_a_refusal_is_recognised(text: str) -> None:
    assert refusal_in(text)


@pytest.mark.parametrize("text", ANSWERS)
def test_normal_answers_are_not_taken_for_refusals(text: str) -> None:
    assert refusal_in(text) is None


class Says:
    """A backend with a fixed answer that counts its calls."""

    def __init__(self, text: str, finish_reason: str = "stop") -> None:
        self.reply = LLMReply(text, "m", finish_reason, {"prompt_tokens": 10})
        self.n_calls = 0

    async def complete(self, request: LLMRequest) -> LLMReply:
        self.n_calls += 1
        return self.reply


@pytest.mark.parametrize("text", REFUSALS)
def test_a_refusal_is_not_repaired(text: str) -> None:
    backend = Says(text)
    with pytest.raises(AnswerRefused, match="m refused to answer") as caught:
        ask(RepairBackend(backend), request(images=(b"a", b"b")))
    assert backend.n_calls == 1
    assert caught.value.raw_text
    assert caught.value.usage == {"prompt_tokens": 10}
    assert "JSON" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "reason", "sentence"),
    [
        ("", "content_filter", "withheld by a content filter"),
        (json.dumps(GOOD["scene_analyzer"]), "SAFETY", "withheld by a content filter"),
        ("", "stop", "answered without content"),
        (" \n", "stop", "answered without content"),
        ('{"scene_cat', "length", "ended by 'length'"),
    ],
)
def test_answers_beyond_repair_cost_one_call(text: str, reason: str, sentence: str) -> None:
    backend = Says(text, reason)
    with pytest.raises(BadAnswer, match=sentence) as caught:
        ask(RepairBackend(backend))
    assert backend.n_calls == 1
    assert isinstance(caught.value, AnswerRefused) == ("filter" in sentence)


@pytest.mark.parametrize("build", [openai, local])
@pytest.mark.parametrize(
    "script",
    [
        said("I'm sorry, but I can't assist with that."),
        said(None, refusal="I can't help with that."),
        said("", "content_filter"),
        refused(400, {"code": "content_filter", "message": "The prompt was filtered."}),
    ],
)
def test_a_served_refusal_costs_one_request(build: object, script: object) -> None:
    with serving(script, said()) as server:
        backend = standard_stack(build(server), None)
        with pytest.raises(AnswerRefused):
            asyncio.run(backend.complete(request()))
        assert len(server.asked) == 1


def test_requests_state_the_picture_detail() -> None:
    for build, detail in ((openai, "low"), (local, "auto")):
        with serving(said(), said(), said()) as server:
            ask(build(server), request(images=(b"\x89PNG", b"\x89PNG")))
            parts = server.asked[-1].body["messages"][0]["content"][1:]
        assert [part["image_url"]["detail"] for part in parts] == [detail, detail]


def test_refused_object_is_reported_and_others_are_inferred() -> None:
    refusal = LLMReply("I'm sorry, I can't help with that.", "scripted")
    backend = Scripted(object_analyzer=lambda r, a: refusal if r.subject == "cup" else a)
    found = run(backend)
    assert "refused to answer" in found.report.errors["cup"]
    assert found.objects["phone"].vibrates
    assert "refused to answer" in found.objects["cup"].provenance["object_category"]
