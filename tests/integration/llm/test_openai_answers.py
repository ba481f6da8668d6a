"""Replies of OpenAI that must not be parsed, in the order in which they are checked."""

from typing import Any

import pytest

from llm_asking import ask, failed, openai
from llm_server import Scripted, refused, said
from openai_schema import openai_serving
from scene2hap import (
    RepairBackend,
)
from scene2hap.errors import AnswerRefused, BadAnswer


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
