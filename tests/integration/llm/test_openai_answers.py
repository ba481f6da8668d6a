"""Replies of OpenAI that must not be parsed, in the order in which they are checked."""

import json
from typing import Any

import pytest

from llm_asking import ask, failed, openai
from llm_server import GOOD, Scripted, refused, said, serving
from openai_schema import openai_serving
from scene2hap import (
    RepairBackend,
)
from scene2hap.errors import AnswerRefused, BadAnswer
from scene2hap.llm.answers.usable import UnusableAnswer


def test_truncation_is_reported_before_other_faults() -> None:
    script = said('{"scene_category": "kit', "length", refusal="no")
    with openai_serving(script) as server, pytest.raises(BadAnswer, match="cut off at its token limit") as caught:
        ask(openai(server))
    assert caught.value.raw_text == '{"scene_category": "kit'


def test_content_filter_is_reported_before_refusal() -> None:
    script = said(None, "content_filter", refusal="no")
    with openai_serving(script) as server, pytest.raises(BadAnswer, match="content filter"):
        ask(openai(server))


def test_refusal_is_reported_and_not_repaired() -> None:
    script = said(None, refusal="I cannot help with that.")
    with (
        openai_serving(script) as server,
        pytest.raises(AnswerRefused, match="refused to answer: 'I cannot help") as caught,
    ):
        ask(RepairBackend(openai(server)))
    assert caught.value.raw_text == "I cannot help with that."
    assert len(server.asked) == 1


def test_null_content_is_a_bad_answer() -> None:
    with openai_serving(said(None)) as server, pytest.raises(BadAnswer, match="without content"):
        ask(openai(server))


_TEXT = json.dumps(GOOD["scene_analyzer"])
_CALL = {"name": "scene_analyzer", "arguments": _TEXT}


@pytest.mark.parametrize(
    "message",
    [
        {"content": [{"type": "text", "text": _TEXT[:9]}, {"type": "text", "text": _TEXT[9:]}]},
        {"content": None, "tool_calls": [{"id": "1", "type": "function", "function": _CALL}]},
        {"content": None, "tool_calls": [{"function": {**_CALL, "arguments": GOOD["scene_analyzer"]}}]},
        {"content": "", "function_call": _CALL},
    ],
    ids=["parts", "tool", "object of a tool", "function"],
)
def test_content_of_services_that_only_resemble_openai_is_read(message: dict[str, Any]) -> None:
    body = {"model": "m", "choices": [{"index": 0, "finish_reason": "stop", "message": message}]}
    with openai_serving(Scripted(body)) as server:
        assert ask(openai(server)).text == _TEXT


def test_a_tool_beside_a_refusal_is_no_answer() -> None:
    message = {"content": None, "refusal": "no", "tool_calls": [{"id": "1", "type": "function", "function": _CALL}]}
    script = Scripted({"choices": [{"index": 0, "finish_reason": "stop", "message": message}]})
    with openai_serving(script) as server, pytest.raises(AnswerRefused, match="refused to answer: 'no'"):
        ask(openai(server))


@pytest.mark.parametrize(
    "call",
    [None, 7, [], [None], [{"function": 7}], [{"function": {"arguments": 7}}], [{"function": {"arguments": {}}}]],
)
def test_a_tool_without_arguments_is_no_content(call: object) -> None:
    body = {"choices": [{"index": 0, "message": {"content": None, "tool_calls": call}}]}
    with openai_serving(Scripted(body)) as server, pytest.raises(BadAnswer, match="without content"):
        ask(openai(server))


def test_a_stream_that_was_not_requested_is_named() -> None:
    error = failed(Scripted(b'data: {"choices": [{"delta": {"content": "{"}}]}\n\ndata: [DONE]\n\n'))
    assert "It streams, which was not requested" in str(error)
    assert not error.retryable


def test_a_completion_without_choices_is_paid_for() -> None:
    body = {"model": "m", "choices": [], "usage": {"prompt_tokens": 9, "completion_tokens": 0}}
    with openai_serving(Scripted(body)) as server, pytest.raises(UnusableAnswer) as caught:
        ask(openai(server))
    assert (caught.value.model, caught.value.usage["prompt_tokens"]) == ("m", 9)


@pytest.mark.parametrize("body", [{}, {"choices": []}, {"choices": [{}]}, {"choices": ["a"]}, {"choices": {"a": 1}}])
def test_success_without_a_chat_completion(body: dict[str, Any]) -> None:
    with openai_serving(Scripted(body)) as server, pytest.raises(BadAnswer, match="no chat completion"):
        ask(openai(server))


@pytest.mark.parametrize("body", [b"<html>hello</html>", b"[1]", b"\xff\xfe", b"[" * 100_000, b""])
def test_success_status_without_json_is_not_a_model_server(body: bytes) -> None:
    error = failed(Scripted(body))
    assert "without a JSON object. Check base_url" in str(error)
    assert not error.retryable


def test_an_error_under_status_200_is_an_error() -> None:
    assert "provider is away" in str(failed(refused(200, {"message": "provider is away"})))


@pytest.mark.parametrize(("code", "retryable"), [(502, True), (429, True), ("503", True), (401, False), (1, False)])
def test_an_error_under_status_200_counts_as_the_status_that_it_names(code: int | str, retryable: bool) -> None:
    """A gateway sends its status before the provider of the model fails."""
    body = {"error": {"message": "Provider returned error", "code": code}}
    assert failed(Scripted(body)).retryable is retryable


def test_thoughts_that_only_the_total_counts_are_billed() -> None:
    reply = said()
    reply.body["usage"] = {"prompt_tokens": 100, "completion_tokens": 20, "total_tokens": 620}
    with openai_serving(reply) as server:
        assert ask(openai(server)).usage["completion_tokens"] == 520


@pytest.mark.parametrize(
    ("number", "counted"), [(100.0, 100), (1e300, None), (0.5, None), (True, None), ("100", None), (-1.0, None)]
)
def test_whole_numbers_of_tokens_count_however_they_are_written(number: object, counted: int | None) -> None:
    reply = said()
    reply.body["usage"] = {"prompt_tokens": number, "completion_tokens": 20}
    with serving(reply) as server:
        assert ask(openai(server)).usage.get("prompt_tokens") == counted
